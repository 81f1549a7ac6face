// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose stiffness the host provides: with the matrices that the library assembles itself, an analysis is the
// same; the host's own supports are found or declared.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "host_bodies.hpp"

namespace {

using namespace cases;
using reference::Solver;

// One matrix for all bodies, with rows and entries in the host's own order, from 1, each entry in two halves.
void give_shuffled(const Scene& scene, const Scene& own, const std::vector<std::int32_t>& bodies) {
    const auto dim = static_cast<std::size_t>(own.dimension());
    std::vector<std::int64_t> nodes;
    std::vector<std::vector<std::pair<std::size_t, double>>> entries;  // rows in the order of nodes
    for (const std::int32_t body : bodies) {
        const Csr k = body_matrix(own, body);
        const std::size_t first = entries.size();
        for (std::size_t r = 0; r + 1 < k.start.size(); ++r) {
            entries.emplace_back();
            for (auto e = static_cast<std::size_t>(k.start[r]); e < static_cast<std::size_t>(k.start[r + 1]); ++e)
                entries.back().emplace_back(first + static_cast<std::size_t>(k.column[e]), k.value[e]);
        }
        const auto list = nodes_of(own, body);
        nodes.insert(nodes.end(), list.begin(), list.end());
    }
    const std::size_t rows = entries.size();
    std::size_t stride = 7;
    while (std::gcd(stride, rows) != 1) ++stride;
    const auto place = [&](std::size_t r) { return (r * stride + 3) % rows; };
    std::vector<std::size_t> back(rows);
    for (std::size_t r = 0; r < rows; ++r) back[place(r)] = r;
    std::vector<std::int64_t> dofs(rows), one_based;
    for (std::size_t r = 0; r < rows; ++r) dofs[r] = static_cast<std::int64_t>(place(r)) + 1;
    for (const std::int64_t n : nodes) one_based.push_back(n + 1);
    Csr k{{1}, {}, {}};
    for (std::size_t at = 0; at < rows; ++at) {
        for (int half = 0; half < 2; ++half)
            for (auto e = entries[back[at]].rbegin(); e != entries[back[at]].rend(); ++e) {
                k.column.push_back(static_cast<std::int64_t>(place(e->first)) + 1);
                k.value.push_back(half == 0 ? 0.75 * e->second : 0.25 * e->second);
            }
        k.start.push_back(static_cast<std::int64_t>(k.column.size()) + 1);
    }
    cases::expect(nodes.size() * dim == rows, "rows");
    REQUIRE(scene, delam_problem_set_stiffness, scene.problem(), static_cast<std::int64_t>(nodes.size()),
            one_based.data(), dofs.data(), k.start.data(), k.column.data(), k.value.data(), -1, nullptr, 1);
}

constexpr const char* keys[] = {
    "stored_bulk",         "stored_interface", "dissipated",      "work",          "lower", "upper", "crack_length",
    "energy_release_rate", "contact_pairs",    "debonded_length", "reaction:drive"};

// Results of every step of an analysis.
struct Analysed {
    std::vector<std::map<std::string, double>> values;
    std::vector<std::vector<double>> displacement;
    double equilibrium = 0.0;  // of the last step
};

Analysed analysis_of(const Scene& scene, double end, int steps) {
    Solver solver(scene, 0.0);
    Analysed m;
    for (int k = 1; k <= steps; ++k) {
        solver.step(end * k / steps);
        solver.commit();
        m.values.emplace_back();
        for (const char* key : keys) m.values.back()[key] = solver.value(key);
        m.displacement.push_back(solver.field("displacement"));
    }
    m.equilibrium = solver.value("kkt_equilibrium");
    return m;
}

// Same analysis, same values and jumps, relative to the largest of the analysis.
void expect_same(const Analysed& own, const Analysed& other, double tolerance, const std::string& what) {
    std::map<std::string, double> largest;
    double opening = 0.0;
    for (std::size_t k = 0; k < own.values.size(); ++k) {
        for (const auto& [key, value] : own.values[k]) {
            largest[key] = std::max(largest[key], std::abs(value));
            cases::expect_near(other.values[k].at(key), value, tolerance, std::max(largest[key], 1e-300),
                               what + ", step " + std::to_string(k + 1) + ", " + key);
        }
        const auto &u = own.displacement[k], &v = other.displacement[k];
        for (std::size_t i = 0; i < u.size(); ++i) opening = std::max(opening, std::abs(u[i]));
        for (std::size_t i = 0; i < u.size(); ++i)
            cases::expect_near(v[i], u[i], tolerance, opening, what + ": displacement " + std::to_string(i));
    }
    const auto& last = own.values.back();
    cases::expect(last.at("dissipated") > 0.0 && last.at("debonded_length") > 0.0,
                  what + ": nothing debonded, nothing was tested");
    cases::expect_below(other.equilibrium, 1e-9, what + ": equilibrium");
}

struct Example {
    const char* name;
    std::function<Scene()> make;
    std::function<void(Scene&)> dress;
    std::vector<std::int32_t> bodies;
    double end;
};

void open_up_to(Scene& scene, std::int64_t interface, double x) {
    const auto pairs = scene.pairs(interface);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < x) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(interface, notch, std::vector<double>(notch.size(), 0.0));
}

void dress_flexure(Scene& scene) {
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    open_up_to(scene, 0, 0.0295);
    scene.hold(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, 1.0});
    scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {1.0, 0.0});
    scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {0.0, 1.0});
    const auto middle = scene.find(1, {0.06, 6e-3}, {0.06, 6e-3});
    scene.drive(middle, {0.0, -1.0}, scene.pattern("drive", {0.0, 2.0}, {0.0, 6e-3}),
                std::vector<double>(middle.size(), 1.0));
}

// Three plies in space, peeled from the left: only adhesion holds the middle one.
void load_peel(Scene& scene) {
    scene.law(0, {1e12, 1e12, 50.0, 50.0, 200.0, 400.0});
    scene.law(1, {1e12, 1e12, 60.0, 60.0, 220.0, 400.0});
    for (std::int64_t i = 0; i < 2; ++i) open_up_to(scene, i, 0.0075 - 0.002 * static_cast<double>(i));
    const auto top = scene.find(2, {0.0, 0.0, 0.003}, {0.0, 0.004, 0.003});
    scene.drive(top, {0.0, 0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 4e-4}),
                std::vector<double>(top.size(), 1.0));
}

void dress_peel(Scene& scene) {
    const auto bottom = scene.find(0, {0.0, 0.0, 0.0}, {0.0, 0.004, 0.0});
    for (const auto& along :
         {std::vector<double>{1.0, 0.0, 0.0}, std::vector<double>{0.0, 1.0, 0.0}, std::vector<double>{0.0, 0.0, 1.0}})
        scene.hold(bottom, along);
    const auto end = scene.find(0, {0.02, 0.0, 0.0}, {0.02, 0.004, 0.0});
    scene.hold(end, {0.0, 0.0, 1.0});
    load_peel(scene);
}

const std::vector<Example>& examples() {
    static const std::vector<Example> list{
        {"flexure", [] { return two_layers(0.12, 60, 3e-3, 2, 75e9, 0.3, 2); }, dress_flexure, {0, 1}, 2.0},
        {"peel",
         [] {
             Scene scene(3, {0.02, 0.004}, {12, 2}, {1e-3, 1e-3, 1e-3}, {1, 1, 1}, DELAM_HEX8);
             scene.interface(0, 1);
             scene.interface(1, 2);
             scene.begin();
             scene.elastic(-1, 70e9, 0.3);
             // The loads are chosen so that plies of standard cells debond.
             REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
             return scene;
         },
         dress_peel,
         {0, 1, 2},
         1.0},
    };
    return list;
}

constexpr int steps = 8;

LOOP_TEST(analysis_is_the_same, 0, 2 * static_cast<int>(examples().size())) {
    const Example& example = examples()[static_cast<std::size_t>(loop / 2)];
    const bool feti = loop % 2 == 1;
    const auto options = [&](Scene& scene) {
        scene.text("reduction", feti ? "feti" : "condensed");
        scene.text("minimisation", feti ? "auto" : "accelerated");
        scene.number("damage_tolerance", 1e-10);
    };
    Scene own = example.make();
    example.dress(own);
    options(own);
    const std::string name = std::string(example.name) + (feti ? ", FETI" : ", condensed");
    const double tolerance = feti ? 1e-6 : 1e-9;  // FETI alternates, to its own tolerance

    const Analysed expected = analysis_of(own, example.end, steps);
    const auto same_analysis = [&](const Scene& other, const char* what) {
        expect_same(expected, analysis_of(other, example.end, steps), tolerance, name + what);
    };

    // Bodies without cells, one call for each.
    Scene bare = without_cells(own, example.bodies);
    for (const std::int32_t body : example.bodies)
        bare.require(give(bare, nodes_of(own, body), body_matrix(own, body)), "delam_problem_set_stiffness");
    example.dress(bare);
    options(bare);
    same_analysis(bare, ", without cells");

    // One call for all, with another numbering.
    Scene shuffled = without_cells(own, example.bodies);
    give_shuffled(shuffled, own, example.bodies);
    example.dress(shuffled);
    options(shuffled);
    same_analysis(shuffled, ", shuffled");

    // Bodies with cells, one of them stiffened by the host: cells only provide the faces.
    Scene mixed = example.make();
    mixed.elastic(example.bodies.back(), 1.0, 0.0);
    mixed.require(give(mixed, nodes_of(own, example.bodies.back()), body_matrix(own, example.bodies.back())),
                  "delam_problem_set_stiffness");
    example.dress(mixed);
    options(mixed);
    same_analysis(mixed, ", cells");
}

// A bar on the host's own springs: the host adds them to the diagonal, and the library finds the motions that they
// hold. One cell per body, no Poisson effect: springs in series, c (ground) + 1/E + 1/k + 1/E to 1 per unit area.
LOOP_TEST(grounded_bar, 0, 6) {
    const int dim = loop < 3 ? 2 : 3;
    const int way = loop % 3;  // condensed, found; FETI, found; condensed, declared that no motion is free
    const double young = 1e12, stiffness = 1e12, ground = 4e11;
    Scene own = dim == 2 ? Scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4)
                         : Scene(3, {1.0, 1.0}, {1, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, young, 0.0);
    Scene scene = without_cells(own, {0, 1});
    scene.require(give(scene, nodes_of(own, 1), body_matrix(own, 1)), "upper body");
    Csr k = body_matrix(own, 0);
    const auto nodes = nodes_of(own, 0);
    const std::vector<double> low(static_cast<std::size_t>(dim), 0.0);
    std::vector<double> high(static_cast<std::size_t>(dim), 1.0);
    high.back() = 0.0;
    const auto bottom = own.find(0, low, high);
    const double share = ground / static_cast<double>(bottom.size());
    for (std::size_t r = 0; r + 1 < k.start.size(); ++r)
        for (auto e = k.start[r]; e < k.start[r + 1]; ++e)
            if (k.column[static_cast<std::size_t>(e)] == static_cast<std::int64_t>(r) &&
                std::find(bottom.begin(), bottom.end(), nodes[r / static_cast<std::size_t>(dim)]) != bottom.end())
                k.value[static_cast<std::size_t>(e)] += share;
    scene.require(give(scene, nodes, k, way == 2 ? 0 : -1), "lower body");
    scene.law(0, {stiffness, stiffness, 1e30, 1e30, 2e30, 2e30});
    scene.text("reduction", way == 1 ? "feti" : "condensed");
    std::vector<double> lift(static_cast<std::size_t>(dim), 0.0), up = low, top = high;
    lift.back() = 1.0;
    up.back() = top.back() = 2.0;
    const auto upper = scene.find(1, up, top);
    scene.drive(upper, lift, scene.pattern("drive", {0.0, 1.0}, {0.0, 1.0}), std::vector<double>(upper.size(), 1.0));
    // Only the host's springs hold the bar against sliding and rotation.
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const double exact = 1.0 / (1.0 / ground + 1.0 / young + 1.0 / stiffness + 1.0 / young);
    cases::expect_near(solver.value("reaction:drive"), exact, 1e-10, exact, "springs in series");
    cases::expect_below(solver.value("kkt_equilibrium"), 1e-10, "equilibrium");
    const auto stress = solver.field("traction");
    cases::expect_near(stress[0], exact, 1e-9, exact, "traction");
}

// Springs along one direction hold only that translation; the library's supports hold the rest. The same bar, driven
// sideways too.
TEST(partly_grounded) {
    Scene own = two_layers(1.0, 1, 1.0, 1, 1e12, 0.0);
    for (const bool told : {false, true}) {
        Scene scene = without_cells(own, {0, 1});
        scene.require(give(scene, nodes_of(own, 1), body_matrix(own, 1)), "upper body");
        Csr k = body_matrix(own, 0);
        const auto nodes = nodes_of(own, 0);
        for (std::size_t r = 1; r + 1 < k.start.size();
             r += 2)  // y of every node: y and the rotation are held, x is free
            for (auto e = k.start[r]; e < k.start[r + 1]; ++e)
                if (k.column[static_cast<std::size_t>(e)] == static_cast<std::int64_t>(r))
                    k.value[static_cast<std::size_t>(e)] += 1e11;
        std::vector<double> along_x(2 * nodes.size(), 0.0);
        for (std::size_t i = 0; i < along_x.size(); i += 2) along_x[i] = 3.0;
        scene.require(told ? give(scene, nodes, k, 1, along_x.data()) : give(scene, nodes, k), "lower body");
        scene.law(0, {1e12, 1e12, 1e30, 1e30, 2e30, 2e30});
        const auto top = scene.find(1, {0.0, 2.0}, {1.0, 2.0});
        scene.drive(top, {0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 1.0}), {1.0, 1.0});
        const std::int32_t unheld = delam_problem_check(scene.problem());
        const std::string message = delam_context_message(scene.context());
        cases::expect(unheld == DELAM_ERROR_PROBLEM && message.find("translate along x") != std::string::npos,
                      "free along x: " + message);
        scene.hold(top, {1.0, 0.0});
        for (const char* reduction : {"condensed", "iterated", "feti"}) {
            scene.text("reduction", reduction);
            Solver solver(scene, 0.0);
            solver.step(1.0);
            // The springs act on both rows of nodes; by hand: a chain of springs at y = 0, 1, 2 with the jump at 1.
            const double e = 1e12, g = 2e11, j = 1e12;
            const double below = g + 1.0 / (1.0 / e + 1.0 / g), chain = 1.0 / (1.0 / below + 1.0 / j + 1.0 / e);
            cases::expect_near(solver.value("reaction:drive"), chain, 1e-10, chain,
                               std::string("chain of springs, ") + reduction);
        }
        // A declared kernel that is none is refused, and so is one that is not independent.
        std::vector<double> along_y(along_x.size(), 0.0), bent = along_x;
        for (std::size_t i = 1; i < along_y.size(); i += 2) along_y[i] = 1.0;
        bent[0] = -3.0;
        const auto refused = [&](const std::vector<double>& kernel, std::int64_t count, const char* words) {
            const std::int32_t status = give(scene, nodes, k, count, kernel.data());
            const std::string text = delam_context_message(scene.context());
            cases::expect(status == DELAM_ERROR_ARGUMENT && text.find(words) != std::string::npos,
                          std::string(words) + ": " + text);
        };
        refused(along_y, 1, "forces");
        refused(bent, 1, "not a rigid motion");
        std::vector<double> twice = along_x;
        twice.insert(twice.end(), along_x.begin(), along_x.end());
        refused(twice, 2, "independent");
    }
}

// The host's supports as empty rows with any diagonal, as finite element programs make them: the same analysis as the
// scene whose supports the library knows.
Scene emptied_scene(const Example& example, const Scene& own, double diagonal) {
    Scene scene = without_cells(own, example.bodies);
    const auto dim = static_cast<std::size_t>(own.dimension());
    const auto foot = own.find(0, {0.0, 0.0, 0.0}, {0.0, 0.004, 0.0}),
               end = own.find(0, {0.02, 0.0, 0.0}, {0.02, 0.004, 0.0});
    Csr k = body_matrix(own, 0);
    const auto nodes = nodes_of(own, 0);
    const auto emptied = [&](std::size_t dof) {
        const std::int64_t node = nodes[dof / dim];
        return std::find(foot.begin(), foot.end(), node) != foot.end() ||
               (dof % dim == 2 && std::find(end.begin(), end.end(), node) != end.end());
    };
    for (std::size_t r = 0; r + 1 < k.start.size(); ++r)
        for (auto e = static_cast<std::size_t>(k.start[r]); e < static_cast<std::size_t>(k.start[r + 1]); ++e) {
            const auto c = static_cast<std::size_t>(k.column[e]);
            if (emptied(r) || emptied(c)) k.value[e] = r == c ? diagonal : 0.0;
        }
    scene.require(give(scene, nodes, k), "lower ply");
    for (const std::int32_t body : {1, 2})
        scene.require(give(scene, nodes_of(own, body), body_matrix(own, body)), "plies");
    load_peel(scene);
    return scene;
}

LOOP_TEST(emptied_rows, 0, 2) {
    const Example& example = examples()[1];
    const bool feti = loop == 1;
    Scene own = example.make();
    example.dress(own);
    own.text("reduction", feti ? "feti" : "condensed");
    own.number("damage_tolerance", 1e-10);
    const Analysed expected = analysis_of(own, example.end, steps);
    for (const double diagonal : {1.0, 1e-3, 1e25}) {
        Scene scene = emptied_scene(example, own, diagonal);
        scene.text("reduction", feti ? "feti" : "condensed");
        scene.number("damage_tolerance", 1e-10);
        expect_same(expected, analysis_of(scene, example.end, steps), feti ? 1e-6 : 1e-9,
                    std::string(feti ? "FETI" : "condensed") + ", diagonal " + std::to_string(diagonal));
    }
}

// More rows than a dense square block may have, because a body is sparse.
TEST(large_body) {
    Scene own = two_layers(1.0, 152, 1.0, 152, 1e9, 0.3);
    Scene scene = without_cells(own, {0, 1});
    const auto nodes = nodes_of(own, 0);
    cases::expect(2 * nodes.size() > 46340, "not large");
    const Csr k = body_matrix(own, 0);
    scene.require(give(scene, nodes, k), "found");
    std::vector<double> kernel(6 * nodes.size(), 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        kernel[2 * i] = kernel[2 * nodes.size() + 2 * i + 1] = 1.0;
        kernel[4 * nodes.size() + 2 * i] = -own.coordinate(nodes[i], 1);
        kernel[4 * nodes.size() + 2 * i + 1] = own.coordinate(nodes[i], 0);
    }
    scene.require(give(scene, nodes, k, 3, kernel.data()), "told");
    // It can be cancelled, and then nothing is taken over.
    char before[17], after[17];
    scene.require(delam_problem_hash(scene.problem(), before), "hash");
    const auto stop = [](const char*, std::int64_t, std::int64_t, void*) -> std::int32_t { return 1; };
    scene.require(delam_context_set_progress(scene.context(), stop, nullptr), "progress");
    cases::expect(give(scene, nodes_of(own, 1), body_matrix(own, 1)) == DELAM_CANCELLED, "not cancelled");
    scene.require(delam_context_set_progress(scene.context(), nullptr, nullptr), "progress");
    scene.require(delam_problem_hash(scene.problem(), after), "hash");
    cases::expect(std::string(before) == after, "a cancelled call has changed the problem");
}

// One label, two plies that the matrix does not connect: two pieces, each with its own motions.
TEST(two_pieces_of_one_body) {
    Scene own(2, {0.12}, {30}, {2e-3, 2e-3, 2e-3}, {1, 1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.interface(1, 2);
    own.begin();
    own.elastic(-1, 75e9, 0.3);
    const auto dress = [](Scene& scene, std::int32_t top_body, std::int64_t interfaces,
                          const std::vector<std::int64_t>& notch) {
        for (std::int64_t i = 0; i < interfaces; ++i) {
            scene.law(i, {1e12, 1e12, 20.0, 20.0, 2000.0, 2000.0});
            scene.adhesion(i, notch, std::vector<double>(notch.size(), 0.0));
        }
        scene.number("damage_tolerance", 1e-10);
        scene.text("step_control", "fixed");  // as it is for pairs without faces
        const auto foot = scene.find(0, {0.0, 0.0}, {0.0, 0.0});
        scene.hold(foot, {1.0, 0.0});
        scene.hold(foot, {0.0, 1.0});
        scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {0.0, 1.0});
        scene.drive(scene.find(top_body, {0.0, 6e-3}, {0.0, 6e-3}), {0.0, 1.0},
                    scene.pattern("drive", {0.0, 1.0}, {0.0, 1.5e-3}), {1.0});
    };
    dress(own, 2, 2, {0, 1, 2, 3});
    // Bodies 0 and 2 become body 0; interface 1 connects 1 and 0.
    Made made(2, {own.nodes().begin(), own.nodes().end()});
    const auto outer = joined(nodes_of(own, 0), nodes_of(own, 2)), middle = nodes_of(own, 1);
    made.add_host_body(0, outer);
    made.add_host_body(1, middle);
    const auto a = own.pairs(0), b = own.pairs(1);
    // Both interfaces are between bodies 0 and 1: one list of pairs, with the second reversed.
    const auto of_0 = joined(a.node_a, b.node_b), of_1 = joined(a.node_b, b.node_a);
    std::vector<double> weights = a.weight, normals;
    weights.insert(weights.end(), b.weight.begin(), b.weight.end());
    for (std::size_t p = 0; p < of_0.size(); ++p) {
        normals.push_back(0.0);
        normals.push_back(p < a.count() ? 2.0 : -0.5);
    }
    std::int64_t index = -1;
    made.expect(delam_mesh_add_pairs(made.m, 0, 1, static_cast<std::int64_t>(of_0.size()), of_0.data(), of_1.data(),
                                     normals.data(), weights.data(), 0, 0, nullptr, 0, &index));
    Scene scene = made.scene();
    scene.require(give(scene, outer, stacked(body_matrix(own, 0), body_matrix(own, 2))), "both plies");
    scene.require(give(scene, middle, body_matrix(own, 1)), "middle");
    std::vector<std::int64_t> notch;
    for (std::int64_t k = 0; k < 4; ++k) notch.insert(notch.end(), {k, k + static_cast<std::int64_t>(a.count())});
    dress(scene, 0, 1, notch);
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        own.text("reduction", reduction);
        scene.text("reduction", reduction);
        Solver mine(own, 0.0), theirs(scene, 0.0);
        for (int k = 1; k <= 4; ++k) {
            mine.step(k / 4.0);
            theirs.step(k / 4.0);
            mine.commit();
            theirs.commit();
            for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "work", "reaction:drive"})
                cases::expect_near(theirs.value(key), mine.value(key), 1e-6,
                                   std::abs(mine.value("reaction:drive")) + mine.value("work"),
                                   std::string(reduction) + ": " + key);
        }
        cases::expect(mine.value("dissipated") > 0.0, "nothing was damaged");
    }
}

}  // namespace
