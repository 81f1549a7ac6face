// SPDX-License-Identifier: BSD-3-Clause
// The contracts of delam.hpp; prints their number, and ends with 1 if one is broken.
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "delam/delam.hpp"
#include "expect.hpp"

namespace {

struct Stop : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class Call>
bool stopped(Call&& call) {
    try {
        call();
    } catch (const Stop& stop) {
        return std::string(stop.what()) == "enough";
    }
    return false;
}

// The bilinear law with the same toughness in both modes: by the library, or by functions of the host.
struct Bilinear {
    double onset, toughness;
    delam::AdhesionValue adhesion(double driving) const {
        const double r = toughness / onset;
        if (driving >= onset * r * r) return {0.0, 0.0};
        if (driving <= onset) return {1.0, 0.0};
        return {(r * std::sqrt(onset / driving) - 1.0) / (r - 1.0),
                -0.5 * r / (r - 1.0) * std::sqrt(onset) / std::pow(driving, 1.5)};
    }
    delam::DissipationValue dissipation(double adhesion) const {
        const double r = toughness / onset;
        const double below = 1.0 + adhesion * (r - 1.0);
        return {toughness - onset * r * r * adhesion / below, -onset * (r / below) * (r / below), 0.0};
    }
};

delam::Law make_law(const delam::Context& context, bool by_host, const bool* failing = nullptr) {
    constexpr Bilinear bilinear{100.0, 250.0};
    auto law = by_host ? delam::Law(
                             context, "bilinear",
                             [=](double, double driving) {
                                 if (failing != nullptr && *failing) throw Stop("enough");
                                 return bilinear.adhesion(driving);
                             },
                             [=](double, double adhesion) { return bilinear.dissipation(adhesion); })
                       : delam::Law(context, "piecewise-linear");
    if (!by_host) {
        law.set("normal_onset", bilinear.onset);
        law.set("tangential_onset", bilinear.onset);
        law.set("normal_toughness", bilinear.toughness);
        law.set("tangential_toughness", bilinear.toughness);
        law.set("criterion", "power");
        law.set("onset_exponent", 1);
        law.set("toughness_exponent", 1);
    }
    law.set("normal_stiffness", 1e13);
    law.set("tangential_stiffness", 1e13);
    return law;
}

// A double cantilever beam; everything except the solver is destroyed here.
delam::Solver make_solver(const delam::Context& context, bool by_host, const bool* failing = nullptr) {
    auto mesh = delam::Mesh::layers(context, {30e-3}, {60}, {1e-3, 1e-3}, {2, 2}, DELAM_QUAD4);
    mesh.add_interface(0, 1);
    delam::Problem problem(context, mesh);
    problem.set_elastic(-1, 70e9, 0.3);
    problem.set_law(0, make_law(context, by_host, failing));
    const auto opening = problem.add_pattern("opening", {0.0, 1.0}, {0.0, 1e-3});
    const auto left = mesh.find_nodes(-1, {0.0, 0.0}, {0.0, 2e-3});
    problem.prescribe_nodes(left, {1.0, 0.0});
    problem.prescribe_nodes({left.data(), 1}, {0.0, 1.0});
    problem.prescribe_nodes(mesh.find_nodes(0, {30e-3, 0.0}, {30e-3, 0.0}), {0.0, 1.0}, {opening}, {-0.5});
    problem.prescribe_nodes(mesh.find_nodes(1, {30e-3, 2e-3}, {30e-3, 2e-3}), {0.0, 1.0}, {opening}, {0.5});
    problem.set("solution", "local");
    problem.check();
    const auto forecast = problem.plan();
    delam::Solver solver(problem, 0.0);
    expect(forecast.plan == solver.plan(), "the plan beforehand");
    expect(forecast.setup > 0.0 && forecast.memory > 0.0, "its time and memory");
    return solver;
}

void test_errors() {
    static_assert(!std::is_copy_constructible_v<delam::Solver> && std::is_nothrow_move_constructible_v<delam::Solver>);
    static_assert(!std::is_copy_constructible_v<delam::Context> && !std::is_copy_assignable_v<delam::Law>);
    const delam::Context context;
    std::string message;
    expect(status_of([&] { delam::Law(context, "no-such-law"); }, &message) == DELAM_ERROR_ARGUMENT, "an unknown law");
    expect(message.find("no-such-law") != std::string::npos && message == context.message(),
           "the message has the value");
    delam::Law law(context, "piecewise-linear");
    expect(status_of([&] { law.set("normal_onset", -1.0); }) == DELAM_ERROR_ARGUMENT, "a value outside its range");
    expect(status_of([&] { law.check(); }) == DELAM_ERROR_PROBLEM, "an incomplete law");
    expect(status_of([&] { law.set_table({0.0, 1.0}, {1.0}); }) == DELAM_ERROR_ARGUMENT, "unequal sizes");
    delam::Mesh mesh(context, 2, {0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0});
    expect(status_of([&] { mesh.add_cells(DELAM_QUAD4, {0, 1, 2}); }) == DELAM_ERROR_ARGUMENT, "three nodes of four");
    expect(status_of([&] { mesh.add_cells(77, {0, 1, 2}); }) == DELAM_ERROR_ARGUMENT, "an unknown type of cell");
    mesh.add_cells(DELAM_QUAD4, {0, 1, 2, 3});
    expect(mesh.size().cells == 1 && mesh.node_bodies() == std::vector<std::int32_t>(4, 0), "no bodies are body 0");
    delam::Problem problem(context, mesh);
    expect(status_of([&] { problem.prescribe_nodes({0}, {1.0, 0.0, 0.0}); }) == DELAM_ERROR_ARGUMENT, "three of two");
    delam::Mesh other = std::move(mesh);
    expect(other.size().nodes == 4, "a mesh moves");
}

void test_descriptions() {
    bool found = false;
    for (const auto& option : delam::options()) found = found || (option.key == "solution" && !option.meaning.empty());
    expect(found, "options are described");
    found = false;
    for (const auto& one : delam::law_parameters("tabulated"))
        found = found || (one.key == "normal_onset" && one.type == "real");
    expect(found && delam::law_parameters("no-such-law").empty(), "parameters are described");
    const auto kinds = delam::law_kinds();
    expect(kinds.front().kind == "piecewise-linear" && !kinds.front().hosted && kinds.back().hosted, "kinds of laws");
    const auto parameters = delam::law_parameters("trapezoidal");
    const auto bounds = delam::law_bounds("trapezoidal");
    expect(bounds.size() == parameters.size(), "bounds of each");
    for (std::size_t i = 0; i < bounds.size(); ++i)
        if (parameters[i].key == "plateau")
            expect(bounds[i].lower == 0.0 && bounds[i].upper == 1.0 && !bounds[i].lower_open && bounds[i].upper_open,
                   "bounds of the plateau");
}

// Two squares side by side with an interface of two pairs, and two nodes without cells.
delam::Mesh make_squares(const delam::Context& context) {
    delam::Mesh mesh(context, 2, {0., 0., 1., 0., 0., 1., 1., 1., 1., 0., 2., 0., 1., 1., 2., 1., 9., 9., 9., 8.});
    mesh.add_cells(DELAM_QUAD4, {0, 1, 3, 2, 4, 5, 7, 6}, {0, 1});
    mesh.add_interface(0, 1);
    return mesh;
}

void test_mesh() {
    using Indices = std::vector<std::int64_t>;
    const delam::Context context;
    auto mesh = make_squares(context);
    const auto size = mesh.size();
    expect(size.dimension == 2 && size.nodes == 10 && size.cells == 2 && size.bodies == 2 && size.interfaces == 1,
           "sizes");
    expect(mesh.nodes()[10] == 2.0 && mesh.node_bodies()[7] == 1 && mesh.node_bodies()[9] == -1, "nodes");
    const auto cells = mesh.cells();
    expect(cells.offsets == Indices{0, 4, 8} && cells.connectivity == Indices{0, 1, 3, 2, 4, 5, 7, 6}, "cells");
    expect(cells.types == std::vector<std::int32_t>(2, DELAM_QUAD4) && cells.bodies == std::vector<std::int32_t>{0, 1},
           "types");
    const auto of = mesh.interface_size(0);
    expect(of.body_a == 0 && of.body_b == 1 && of.pairs == 2 && of.faces == 1 && of.nodes_per_face == 2,
           "an interface");
    const auto pairs = mesh.interface_pairs(0);
    expect(pairs.nodes_a == Indices{1, 3} && pairs.nodes_b == Indices{4, 6} && pairs.frames[0] == 1.0, "pairs");
    expect(mesh.interface_faces(0).size() == 2 && std::abs(pairs.weights[0] - 0.5) < 1e-14, "faces and weights");
    const auto patch = mesh.find_patch(0, {0.0, 0.0}, {0.5, 0.0}, {0.0, -1.0});
    expect(patch.nodes == Indices{0, 1} && std::abs(patch.weights[0] + patch.weights[1] - 0.5) < 1e-14, "a patch");
    const auto whole = mesh.find_patch(-1, {0.0, 0.0}, {2.0, 0.0}, {0.0, -1.0});
    expect(whole.nodes == Indices{0, 1, 4, 5} && std::abs(whole.weights[1] - 0.5) < 1e-14, "a patch of all bodies");
    expect(mesh.add_obstacle({0, 1}, {0.0, 1.0, 0.0, 1.0}, 9) == 1, "an obstacle");
    expect(mesh.interface_size(1).body_a == -1 && mesh.interface_pairs(1).nodes_b == Indices{0, 1}, "its pairs");

    // One cell below two, whose common node at the bottom lies on the edge of the first.
    delam::Mesh stack(context, 2, {0., 0., 2., 0., 0., 1., 2., 1., 0., 1., 1., 1., 2., 1., 0., 2., 1., 2., 2., 2.});
    stack.add_cells(DELAM_QUAD4, {0, 1, 3, 2, 4, 5, 8, 7, 5, 6, 9, 8}, {0, 1, 1});
    expect(stack.add_projected_interface(0, 1) == 0, "a projected interface");
    const auto ties = stack.node_ties();
    expect(!ties.nodes.empty() && ties.nodes.front() == 10 && ties.starts.size() == ties.nodes.size() + 1, "ties");
    expect(ties.starts.back() == static_cast<std::int64_t>(ties.of.size()) && ties.weights.size() == ties.of.size(),
           "entries");

    delam::Mesh coarse(context, 2, {0., 0., 2., 0., 0., 1., 2., 1., 0., 1., 1., 1., 2., 1., 0., 2., 1., 2., 2., 2.});
    coarse.add_cells(DELAM_QUAD4, {0, 1, 3, 2, 4, 5, 8, 7, 5, 6, 9, 8}, {0, 1, 1});
    expect(coarse.add_mortar_interface(1, 0) == 0, "a mortar interface");
    expect(coarse.node_ties().of == Indices{4, 5, 6, 4, 5, 6}, "means over both edges");

    delam::Mesh touching(context, 2, {0., 0., 1., 0., 2., 0., 0., 1., 1., 1., 2., 1.});
    touching.add_conforming_cells(DELAM_QUAD4, {0, 1, 4, 3, 1, 2, 5, 4}, {3, 7});
    expect(touching.add_all_interfaces() == 1 && touching.node_origins() == Indices{0, 1, 2, 3, 4, 5, 1, 4},
           "doubled nodes");

    // A row of three cells on another, with nodes of its own on the left: node 6 is the tip, 12 and 13 are doubled.
    delam::Mesh slit(context, 2, {0., 0., 1., 0., 2., 0., 3., 0., 0., 1., 1., 1., 2., 1.,
                                  3., 1., 0., 2., 1., 2., 2., 2., 3., 2., 0., 1., 1., 1.});
    slit.add_cells(DELAM_QUAD4, {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 12, 13, 9, 8, 13, 6, 10, 9, 6, 7, 11, 10});
    expect(slit.add_seams() == 1 && slit.interface_pairs(0).nodes_a == Indices{4, 5} &&
               slit.interface_pairs(0).nodes_b == Indices{12, 13},
           "a seam");
    expect(slit.interface_size(0).body_a == 0 && slit.interface_size(0).body_b == 0, "both sides are of one body");

    // Three rows of four cells, without the last two of the middle row: the walls of this slot are 1 apart.
    delam::Mesh slot(context, 2, {0., 0., 1., 0., 2., 0., 3., 0., 4., 0., 0., 1., 1., 1., 2., 1., 3., 1., 4., 1.,
                                  0., 2., 1., 2., 2., 2., 3., 2., 4., 2., 0., 3., 1., 3., 2., 3., 3., 3., 4., 3.});
    slot.add_cells(DELAM_QUAD4, {0, 1, 6,  5,  1,  2,  7,  6,  2,  3,  8,  7,  3,  4,  9,  8,  5,  6,  11, 10,
                                 6, 7, 12, 11, 10, 11, 16, 15, 11, 12, 17, 16, 12, 13, 18, 17, 13, 14, 19, 18});
    expect(slot.add_self_contact(0.5) == 0 && slot.add_self_contact(1.1) == 1, "the walls of a slot");
    expect(slot.interface_size(0).body_a == 0 && slot.interface_size(0).body_b == 0, "walls of one body");
    expect(status_of([&] { slot.add_self_contact(0.0); }) == DELAM_ERROR_ARGUMENT, "a gap of 0");
}

void test_problem() {
    const delam::Context context;
    auto mesh = make_squares(context);
    delam::Problem problem(context, mesh);
    problem.set_plane("plane-stress");
    problem.set_elastic(-1, 1.0, 0.3);
    problem.set_orthotropic(1, {3.0, 1.0, 1.0, 0.2, 0.2, 0.2, 0.5, 0.5, 0.5});
    problem.set_orientation(1, {1}, {0.0, 1.0, 0.0, 1.0, 0.0, 0.0});
    problem.set_orientation(1, {0.0, 1.0, 0.0, 1.0, 0.0, 0.0});
    problem.set_formulation(0, "incompatible");
    problem.set_bonded(0);
    problem.set_contact(0);
    problem.set_law(0, make_law(context, false));
    problem.set_adhesion(0, {1}, {0.5});
    expect(problem.process_zone(0).spacing > 0.0, "the distance of pairs");
    expect(problem.set_adhesion_box(0, {-9.0, -9.0}, {9.0, 9.0}, 0.5) == 2, "the pairs in a box");
    expect(problem.set_adhesion_box(0, {8.0, 8.0}, {9.0, 9.0}) == 0, "no pair in a box");
    const auto proposal = problem.propose(0);
    expect(proposal.stiffness > 0.0 && proposal.share > 0.0 && proposal.share < 1.0, "a stiffness is proposed");
    const auto pull = problem.add_pattern("pull", {0.0}, {1.0});
    const auto push = problem.add_pattern("push", {0.0, 1.0}, {0.0, 2.0});
    const auto heat = problem.add_pattern("heat", {0.0}, {3.0});
    expect(problem.pattern_count() == 3 && problem.pattern_name(heat) == "heat", "patterns");
    expect(problem.factors(0.5) == std::vector<double>{1.0, 1.0, 3.0}, "factors");
    problem.add_forces(push, {7}, {4.0, 5.0});
    expect(problem.forces(push)[14] == 4.0 && problem.forces(push)[15] == 5.0, "forces of the last node");
    problem.add_eigenstrain(heat, 1, {1e-3, 0.0, 0.0, 0.0, 0.0, 0.0});
    expect(problem.eigenstrain_energy()[8] > 0.0, "energy of strains");
    problem.prescribe_nodes({0, 9}, {0.0, 1.0});
    problem.prescribe_nodes({9}, {1.0, 0.0}, {pull}, {7.0});
    problem.prescribe_mean({8, 9}, {1.0, 3.0}, {1.0, 0.0}, {pull}, {2.0});
    problem.add_equation({7, 9}, {0.0, 1.0, 1.0, 0.0}, {pull}, {6.0});
    const auto all = problem.constraints();
    expect(all.matrix.row_starts == std::vector<std::int64_t>{0, 1, 2, 3, 5, 7}, "rows of constraints");
    expect(all.matrix.columns == std::vector<std::int64_t>{1, 19, 18, 16, 18, 15, 18}, "their DOFs");
    expect(all.coefficients[6] == 7.0 && all.coefficients[9] == 2.0 && all.coefficients[12] == 6.0,
           "what they prescribe");
    const auto matrix = problem.body_matrix(0);
    expect(matrix.row_starts.size() == 9 && matrix.row_starts.back() == static_cast<std::int64_t>(matrix.values.size()),
           "a body");
    expect(problem.hash().size() == 16 && problem.dofs().dual == 4, "hash and DOFs");

    delam::Mesh square(context, 2, {0., 0., 1., 0., 0., 1., 1., 1., 9., 9., 9., 8.});
    square.add_cells(DELAM_QUAD4, {0, 1, 3, 2});
    delam::Problem cell(context, square);
    cell.add_periodic({1.0, 0.0, 0.0, 1.0}, {4, 5});
    expect(cell.constraints().matrix.row_starts.size() > 1, "a periodic cell");
    const auto found = cell.add_pattern("found", {0.0}, {1.0}), left = cell.add_pattern("left", {0.0}, {1.0});
    cell.begin_constraints(0, 2, 0.5, found);
    cell.end_constraints(1, 1, 1.5, left);
}

void test_gaps() {
    const delam::Context context;
    delam::Mesh mesh(context, 2, {0., 0., 1., 0., 0., 1., 1., 1., 0., 1.125, 1., 1.125, 0., 2., 1., 2.});
    mesh.add_cells(DELAM_QUAD4, {0, 1, 3, 2, 4, 5, 7, 6}, {0, 1});
    mesh.add_mortar_interface(0, 1, 0.25);
    delam::Problem problem(context, mesh);
    problem.set_elastic(-1, 1.0, 0.3);
    problem.set_contact(0);
    const auto apart = problem.add_pattern("apart", {0.0}, {1.0});
    const auto with = [&](delam::View<double> gaps, double adjust) {
        problem.set_gaps(0, apart, gaps, adjust);
        return problem.hash();
    };
    problem.set_gaps(0, apart);
    const std::string known = problem.hash();
    expect(known == with({0.125, 0.125}, 0.0) && known == with({}, 0.0), "the distances in the mesh");
    expect(with({0.125, 0.5}, 0.25) == with({0.0, 0.5}, 0.0), "small gaps count as 0");
    expect(with({}, 0.25) == with({0.0, 0.0}, 0.0), "those of the mesh, too");
    expect(status_of([&] { problem.set_gaps(0, apart, {0.125}); }) == DELAM_ERROR_ARGUMENT, "one gap of two");
    expect(status_of([&] { problem.set_gaps(1, apart, {0.125}); }) == DELAM_ERROR_ARGUMENT, "there is no interface 1");
}

void test_law() {
    const delam::Context context;
    bool failing = false;
    auto ours = make_law(context, true, &failing);
    auto theirs = make_law(context, false);
    ours.check();
    const std::vector<double> jump{1e-6, 0.0, 5e-6, 1e-6, 8e-6, 2e-6, 1e-3, 0.0};
    const std::vector<double> mixity{0.0, 0.1, 0.3, 0.0};
    const auto a = ours.respond(2, jump, mixity, {1.0, 1.0, 1.0, 1.0});
    const auto b = theirs.respond(2, jump, mixity, {1.0, 1.0, 1.0, 1.0});
    for (std::size_t i = 0; i < 4; ++i) expect(std::abs(a.adhesion[i] - b.adhesion[i]) < 1e-12, "a host's law");
    expect(a.adhesion[1] > 0.1 && a.adhesion[1] < 0.9, "softening was met");
    failing = true;
    expect(stopped([&] { ours.check(); }), "what a law throws comes out of the call");
    failing = false;
    ours.check();

    std::optional<delam::Context> gone(std::in_place);
    auto host = make_solver(*gone, true, &failing);
    auto library = make_solver(*gone, false);
    gone.reset();
    for (int step = 1; step <= 5; ++step) {
        expect(host.advance(0.16 * step) == delam::Outcome::done, "a step");
        expect(library.advance(0.16 * step) == delam::Outcome::done, "a step");
        host.commit();
        library.commit();
    }
    const double dissipated = library.value("dissipated");
    expect(dissipated > 0.1 && std::abs(host.value("dissipated") - dissipated) < 1e-8 * dissipated, "the same march");
    failing = true;
    expect(stopped([&] { (void)host.advance(1.0); }), "what a law throws comes out of a step");
    failing = false;
    expect(host.advance(1.0) == delam::Outcome::done, "and the solver is usable");
}

void test_solver() {
    const delam::Context context;
    auto solver = make_solver(context, false);
    expect(solver.initial() == delam::Outcome::done, "the first displacement");
    expect(solver.advance(0.5) == delam::Outcome::done, "a step");
    expect(status_of([&] { (void)solver.advance(0.6); }) == DELAM_ERROR_STATE, "a step is pending");
    const double reaction = solver.value("reaction:opening");
    solver.rollback();
    expect(solver.advance(0.5) == delam::Outcome::done && solver.value("reaction:opening") == reaction,
           "the same again");
    solver.commit();
    const auto jump = solver.field("jump", 0);
    expect(jump.rows == 61 && jump.columns == 2 && jump.values.size() == 122, "a field is [rows][columns]");
    std::vector<double> buffer(122);
    solver.field("jump", 0, buffer.data(), buffer.size());
    expect(buffer == jump.values, "a field in the caller's buffer");
    expect(status_of([&] { solver.field("jump", 0, buffer.data(), 5); }) == DELAM_ERROR_ARGUMENT, "a small buffer");
    const auto fronts = solver.fronts(0);
    expect(fronts.starts.front() == 0 && fronts.rates.size() == 3 * fronts.lengths.size(), "fronts");
    expect(std::abs(solver.average().volume - 60e-6) < 1e-15, "the volume");
    expect(solver.tangent().size() == 1, "the tangent");
    bool listed = false;
    for (const auto& name : solver.value_names()) listed = listed || name == "reaction:opening";
    expect(listed, "names of values");
    expect(solver.option("solution") == "local" && solver.option("no such option").empty(), "options");
    const auto items = solver.plan_items();
    expect(!items.empty() && solver.plan().rfind(items[0].subject, 0) == 0, "the plan");
    expect(solver.jumps().empty(), "no jumps were looked for");

    auto bytes = solver.save();
    auto again = make_solver(context, false);
    again.load(bytes);
    expect(again.advance(1.0) == delam::Outcome::done && solver.advance(1.0) == delam::Outcome::done, "a step");
    expect(again.value("dissipated") == solver.value("dissipated"), "saved and gone on with");
    bytes[bytes.size() / 2] ^= 0xff;
    auto third = make_solver(context, false);
    expect(status_of([&] { third.load(bytes); }) == DELAM_ERROR_SNAPSHOT, "damaged bytes are refused");
    solver.rollback();
    expect(status_of([&] {
               (void)solver.equilibrate(0.5, {1.0, 1.0});
           }) == DELAM_ERROR_ARGUMENT,
           "adhesion of two pairs");
    solver = std::move(again);
    expect(solver.value("time") == 1.0, "a solver moves");
}

void test_callbacks() {
    delam::Context context;
    int calls = 0;
    int last = -1;
    bool throwing = false;
    context.on_progress([&](std::string_view stage, std::int64_t, std::int64_t) {
        ++calls;
        if (throwing) throw Stop("enough");
        return !stage.empty() && calls != last;
    });
    auto solver = make_solver(context, false);
    expect(solver.advance(0.5) == delam::Outcome::done && calls > 0, "progress is told");
    solver.rollback();
    last = calls + 2;
    expect(solver.advance(0.5) == delam::Outcome::cancelled && calls == last, "cancelled at the second call");
    throwing = true;
    expect(stopped([&] { (void)solver.advance(0.5); }) && calls == last + 1, "what it throws comes out of the call");
    throwing = false;
    context.on_progress(nullptr);
    expect(solver.advance(0.5) == delam::Outcome::done && calls == last + 1, "switched off, and the solver is usable");
    solver.rollback();
    context.cancel();
    expect(solver.advance(0.5) == delam::Outcome::cancelled, "a request for the next call");
    // From inside, nothing can be switched off or read; the step is not affected, and neither is the next.
    int refused = 0;
    const auto meddle = [&](const std::function<void()>& action) {
        refused += status_of(action) == DELAM_ERROR_STATE ? 1 : 0;
    };
    context.on_progress([&](std::string_view, std::int64_t, std::int64_t) {
        meddle([&] { context.on_progress({}); });
        meddle([&] { context.on_log({}); });
        meddle([&] { (void)solver.value("time"); });
        return true;
    });
    for (int step = 0; step < 2; ++step) {
        const int before = refused;
        expect(solver.advance(0.5) == delam::Outcome::done && refused > before && refused % 3 == 0,
               "a callback that meddles");
        solver.rollback();
    }
    context.on_progress({});
    std::string said;
    context.on_log([&](std::int32_t, std::string_view text) { said = text; });
    context.on_log({});
}

}  // namespace

int main() {
    expect(delam_abi() == DELAM_ABI && !delam::version().empty(), "the library has the interface of the header");
    test_errors();
    test_descriptions();
    test_mesh();
    test_problem();
    test_gaps();
    test_law();
    test_solver();
    test_callbacks();
    return ended();
}
