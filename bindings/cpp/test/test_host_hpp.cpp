// SPDX-License-Identifier: BSD-3-Clause
// What an embedding host does with delam.hpp: its own bodies as sparse matrices, its own pairs, histories changed
// during the analysis, tangents, the condensed operator, states as files.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "delam/delam.hpp"
#include "expect.hpp"

namespace {

using Indices = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

// A strip of 30 mm, peeled and sheared at its left end by two devices.
constexpr std::array<const char*, 2> names{"lift", "pull"};
constexpr std::array<double, 2> ends{2.5e-4, -4e-5};

delam::Mesh strip_mesh(const delam::Context& context) {
    auto mesh = delam::Mesh::layers(context, {0.03}, {30}, {1e-3, 1e-3}, {1, 1}, DELAM_QUAD4);
    mesh.add_interface(0, 1);
    return mesh;
}

void load(const delam::Context& context, const delam::Mesh& mesh, delam::Problem& problem) {
    delam::Law law(context, "piecewise-linear");
    law.set("normal_stiffness", 1e13);
    law.set("tangential_stiffness", 1e13);
    law.set("normal_onset", 20.0);
    law.set("tangential_onset", 40.0);
    law.set("normal_toughness", 200.0);
    law.set("tangential_toughness", 500.0);
    problem.set_law(0, law);
    problem.set_adhesion(0, {0, 1, 2, 3, 4, 5}, Numbers(6, 0.0));
    const auto foot = mesh.find_nodes(0, {0.0, 0.0}, {0.03, 0.0});
    problem.prescribe_nodes(foot, {1.0, 0.0});
    problem.prescribe_nodes(foot, {0.0, 1.0});
    const auto tip = mesh.find_nodes(1, {0.0, 2e-3}, {0.0, 2e-3});
    const auto lift = problem.add_pattern(names[0], {0.0, 1.0}, {0.0, ends[0]});
    const auto pull = problem.add_pattern(names[1], {0.0, 1.0}, {0.0, ends[1]});
    problem.prescribe_nodes(tip, {0.0, 1.0}, {lift}, {1.0});
    problem.prescribe_nodes(tip, {1.0, 0.0}, {pull}, {1.0});
    problem.set("damage_tolerance", 1e-11);
    problem.set("kinematics", "linear");  // a stiffness that is given does not turn
}

delam::Problem strip(const delam::Context& context) {
    const auto mesh = strip_mesh(context);
    delam::Problem problem(context, mesh);
    problem.set_elastic(-1, 70e9, 0.3);
    load(context, mesh, problem);
    return problem;
}

Indices nodes_of(const delam::Mesh& mesh, std::int32_t body) {
    Indices nodes;
    const auto bodies = mesh.node_bodies();
    for (std::size_t n = 0; n < bodies.size(); ++n)
        if (bodies[n] == body) nodes.push_back(static_cast<std::int64_t>(n));
    return nodes;
}

// Its nodes and pairs; its bodies have no cells.
delam::Mesh without_cells(const delam::Context& context, const delam::Mesh& own, bool faces) {
    delam::Mesh mesh(context, 2, own.nodes());
    mesh.add_host_body(0, nodes_of(own, 0));
    mesh.add_host_body(1, nodes_of(own, 1));
    const auto pairs = own.interface_pairs(0);
    Numbers normals;
    for (std::size_t p = 0; p < pairs.nodes_a.size(); ++p)
        normals.insert(normals.end(), {3.0 * pairs.frames[4 * p], 3.0 * pairs.frames[4 * p + 1]});
    const auto made = faces ? mesh.add_pairs(0, 1, pairs.nodes_a, pairs.nodes_b, normals, pairs.weights,
                                             own.interface_faces(0), own.interface_size(0).nodes_per_face)
                            : mesh.add_pairs(0, 1, pairs.nodes_a, pairs.nodes_b, normals, pairs.weights);
    expect(made == 0 && mesh.interface_pairs(0).nodes_b == pairs.nodes_b && mesh.size().cells == 0, "pairs");
    expect(mesh.interface_faces(0) == (faces ? own.interface_faces(0) : Indices{}), "faces");
    return mesh;
}

std::vector<Numbers> march(const delam::Problem& problem) {
    delam::Solver solver(problem, 0.0);
    std::vector<Numbers> rows;
    for (int k = 1; k <= 10; ++k) {
        expect(solver.advance(0.1 * k) == delam::Outcome::done, "a step");
        solver.commit();
        rows.push_back({solver.value("reaction:lift"), solver.value("reaction:pull"), solver.value("dissipated")});
    }
    return rows;
}

void expect_same(const std::vector<Numbers>& rows, const std::vector<Numbers>& expected, const char* what) {
    for (std::size_t i = 0; i < 3; ++i) {
        double largest = 0.0, apart = 0.0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            largest = std::max(largest, std::abs(expected[k][i]));
            apart = std::max(apart, std::abs(rows[k][i] - expected[k][i]));
        }
        expect(largest > 0.0 && apart <= 1e-10 * largest, what);
    }
}

// Rows from the last to the first, and the rows of the displacements.
struct Turned {
    delam::Matrix matrix;
    Indices dofs;
};

Turned turned(const delam::Matrix& matrix) {
    const std::size_t rows = matrix.row_starts.size() - 1;
    Turned result;
    result.matrix.row_starts.push_back(0);
    for (std::size_t r = rows; r-- > 0;) {
        for (auto e = static_cast<std::size_t>(matrix.row_starts[r]);
             e < static_cast<std::size_t>(matrix.row_starts[r + 1]); ++e) {
            result.matrix.columns.push_back(static_cast<std::int64_t>(rows) - 1 - matrix.columns[e]);
            result.matrix.values.push_back(matrix.values[e]);
        }
        result.matrix.row_starts.push_back(static_cast<std::int64_t>(result.matrix.columns.size()));
        result.dofs.push_back(static_cast<std::int64_t>(r));
    }
    return result;
}

Numbers rigid_motions(const delam::Mesh& mesh, const Indices& nodes) {
    const auto places = mesh.nodes();
    Numbers kernel;
    for (int motion = 0; motion < 3; ++motion)
        for (const auto n : nodes) {
            const auto at = static_cast<std::size_t>(2 * n);
            kernel.push_back(motion == 0 ? 1.0 : motion == 1 ? 0.0 : -places[at + 1]);
            kernel.push_back(motion == 0 ? 0.0 : motion == 1 ? 1.0 : places[at]);
        }
    return kernel;
}

void test_host_bodies() {
    const delam::Context context;
    const auto own_mesh = strip_mesh(context);
    const auto own = strip(context);
    const auto expected = march(own);
    expect(expected.back()[2] > 0.0, "something was damaged");
    const auto mesh = without_cells(context, own_mesh, true);
    for (int way = 0; way < 3; ++way) {
        delam::Problem problem(context, mesh);
        for (const std::int32_t body : {0, 1}) {
            const auto nodes = nodes_of(mesh, body);
            const auto matrix = own.body_matrix(body);
            if (way == 0) problem.set_stiffness(nodes, matrix);
            if (way == 1) problem.set_stiffness(nodes, matrix, {}, rigid_motions(mesh, nodes));
            if (way == 2) problem.set_stiffness(nodes, turned(matrix).matrix, turned(matrix).dofs);
        }
        load(context, mesh, problem);
        expect_same(march(problem), expected, "the bodies handed over");
    }
    // Without faces there are no fronts, and steps are taken whole. Otherwise, the analysis is the same.
    const auto bare = without_cells(context, own_mesh, false);
    delam::Problem problem(context, bare);
    for (const std::int32_t body : {0, 1}) problem.set_stiffness(nodes_of(bare, body), own.body_matrix(body));
    load(context, bare, problem);
    auto whole = strip(context);
    whole.set("step_control", "fixed");
    expect_same(march(problem), march(whole), "without faces");
    expect(delam::Solver(problem, 0.0).fronts(0).lengths.empty(), "no fronts without faces");

    // One square on the host's own springs, which leave no motion free.
    delam::Mesh square(context, 2, {0., 0., 1., 0., 0., 1., 1., 1.});
    square.add_cells(DELAM_QUAD4, {0, 1, 3, 2});
    delam::Problem column(context, square);
    column.set_elastic(-1, 3.0, 0.0);
    auto matrix = column.body_matrix(0);
    for (std::size_t r = 0; r < 4; ++r)
        for (auto e = static_cast<std::size_t>(matrix.row_starts[r]);
             e < static_cast<std::size_t>(matrix.row_starts[r + 1]); ++e)
            if (matrix.columns[e] == static_cast<std::int64_t>(r)) matrix.values[e] += 2.5;
    column.set_stiffness({0, 1, 2, 3}, matrix, {}, Numbers{});
    const auto lift = column.add_pattern("lift", {0.0, 1.0}, {0.0, 1.0});
    column.prescribe_nodes({2, 3}, {0.0, 1.0}, {lift}, {1.0, 1.0});
    delam::Solver solver(column, 0.0);
    expect(solver.advance(1.0) == delam::Outcome::done, "a step");
    expect(std::abs(solver.value("reaction:lift") - 1.0 / (1.0 / 3.0 + 1.0 / 5.0)) < 1e-12, "springs in series");
}

void test_refusals() {
    const delam::Context context;
    const auto own_mesh = strip_mesh(context);
    const auto own = strip(context);
    auto mesh = without_cells(context, own_mesh, true);
    expect(status_of([&] { mesh.add_host_body(0, {0}); }) == DELAM_ERROR_MESH, "a body that is there");
    expect(status_of([&] {
               mesh.add_pairs(0, 1, {0}, {62, 63}, {0.0, 1.0}, {1.0});
           }) == DELAM_ERROR_ARGUMENT,
           "unequal sizes");
    expect(status_of([&] {
               mesh.add_pairs(0, 1, {0}, {62}, {0.0, 1.0}, {1.0}, {0});
           }) == DELAM_ERROR_ARGUMENT,
           "faces of no nodes");
    delam::Problem problem(context, mesh);
    const auto nodes = nodes_of(mesh, 0);
    const auto refused = [&](auto&& change) {
        auto matrix = own.body_matrix(0);
        change(matrix);
        return status_of([&] { problem.set_stiffness(nodes, matrix); }) == DELAM_ERROR_ARGUMENT;
    };
    expect(refused([](delam::Matrix& matrix) { matrix.row_starts.pop_back(); }), "a row too few");
    expect(refused([](delam::Matrix& matrix) { matrix.columns.pop_back(); }), "a column too few");
    expect(refused([](delam::Matrix& matrix) { matrix.row_starts.back() += 1; }), "an entry too few");
    expect(refused([](delam::Matrix& matrix) { matrix.values[1] *= 1.001; }), "not symmetric");
    const auto matrix = own.body_matrix(0);
    expect(status_of([&] { problem.set_stiffness(nodes, matrix, {0}); }) == DELAM_ERROR_ARGUMENT, "one row alone");
    expect(status_of([&] { problem.set_stiffness(nodes, matrix, {}, Numbers{1.0}); }) == DELAM_ERROR_ARGUMENT,
           "a part of a motion");
    expect(status_of([&] { problem.check(); }) == DELAM_ERROR_PROBLEM, "no stiffness was taken");
}

void test_step_tangent() {
    const delam::Context context;
    const auto problem = strip(context);
    delam::Solver solver(problem, 0.0);
    solver.record("time");
    solver.record("reaction:lift");
    // What the matrices mean is tested in C; here they are those of C.
    const auto as_in_c = [&](const Numbers& matrix, auto function) {
        Numbers flat(4);
        return function(solver.get(), 4, flat.data()) == DELAM_OK && matrix == flat;
    };
    bool damaged = false;
    for (int k = 1; k <= 10; ++k) {
        const double time = 0.1 * k;
        for (const bool kept : {false, true}) {
            for (std::size_t p = 0; p < 2; ++p)
                solver.set_history(static_cast<std::int64_t>(p), {time}, {ends[p] * time});
            expect(solver.advance(time) == delam::Outcome::done && solver.pending(), "a step is pending");
            expect(as_in_c(solver.step_tangent(), delam_solver_step_tangent), "the tangent of a step");
            expect(as_in_c(solver.tangent(), delam_solver_tangent), "the tangent");
            damaged = damaged || solver.tangent() != solver.step_tangent();
            kept ? solver.commit() : solver.rollback();
            expect(!solver.pending(), "none is pending");
        }
        expect(solver.recorded("reaction:lift").back() == solver.value("reaction:lift"), "the last step is recorded");
    }
    const auto steps = solver.recorded_steps();
    const auto times = solver.recorded("time");
    expect(steps.first == 0 && steps.count == 11 && times.size() == 11 && times[3] == 0.1 * 3, "what was committed");
    expect(status_of([&] { (void)solver.recorded("work"); }) == DELAM_ERROR_ARGUMENT, "a value that is not recorded");
    const auto infos = solver.value_infos();
    const auto known = solver.value_names();
    for (std::size_t i = 0; i < infos.size(); ++i) {
        if (known[i] == "kkt_gap") expect(infos[i].cost == "recovers" && !infos[i].recorded, "a dear value");
        if (!infos[i].alias.empty()) expect(solver.value(infos[i].alias) == solver.value(known[i]), "a second name");
    }
    expect(infos.size() == known.size(), "each value is described");
    expect(status_of([&] { solver.record("kkt_gap"); }) == DELAM_ERROR_ARGUMENT, "a value that costs a recovery");
    expect(damaged, "damage was met");
    expect(status_of([&] { (void)solver.step_tangent(); }) == DELAM_ERROR_STATE, "no step is pending");
    expect(status_of([&] { solver.set_history(0, {2.0, 3.0}, {1.0}); }) == DELAM_ERROR_ARGUMENT, "unequal sizes");
}

void test_condensed() {
    const delam::Context context;
    auto problem = strip(context);
    const auto press = problem.add_pattern("press", {0.0, 1.0}, {0.0, 1.0});
    const auto middle = strip_mesh(context).find_nodes(1, {0.012, 2e-3}, {0.012, 2e-3});
    problem.add_forces(press, middle, {0.0, 2000.0});
    delam::Solver solver(problem, 0.0);
    const auto all = solver.condensed();
    const auto n = static_cast<std::size_t>(all.unknowns);
    const std::size_t rows = all.jump.row_starts.size() - 1;
    expect(rows == 62 && all.stiffness.size() == n * n && all.load.size() == 3 * n && all.constant.size() == 9 &&
               all.offset.size() == 3 * rows,
           "sizes");
    expect(all.jump.row_starts.back() == static_cast<std::int64_t>(all.jump.values.size()), "entries");
    auto flat = all;
    for (Numbers* of : {&flat.stiffness, &flat.load, &flat.constant, &flat.jump.values, &flat.offset})
        std::fill(of->begin(), of->end(), -1.0);
    expect(delam_solver_condensed(solver.get(), static_cast<std::int64_t>(n * n), flat.stiffness.data(),
                                  flat.load.data(), flat.constant.data(), flat.jump.row_starts.data(),
                                  flat.jump.columns.data(), flat.jump.values.data(), flat.offset.data()) == DELAM_OK &&
               flat.stiffness == all.stiffness && flat.load == all.load && flat.constant == all.constant &&
               flat.jump.row_starts == all.jump.row_starts && flat.jump.columns == all.jump.columns &&
               flat.jump.values == all.jump.values && flat.offset == all.offset,
           "the arrays of C");
    problem.set("reduction", "feti");
    delam::Solver feti(problem, 0.0);
    expect(status_of([&] { (void)feti.condensed(); }) == DELAM_ERROR_STATE, "FETI has no such operator");
    expect(delam::blas_threads() >= 0, "threads of the linear algebra");
}

struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "delam-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
        path = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

template <class Call>
bool file_error(Call&& call, const std::filesystem::path& named) {
    try {
        call();
    } catch (const delam::FileError& error) {
        return error.status() == DELAM_ERROR_FILE && std::string(error.name()) == "DELAM_ERROR_FILE" &&
               std::string(error.what()).find(named.string()) != std::string::npos;
    }
    return false;
}

void test_files() {
    const Folder folder;
    const delam::Context context;
    const auto problem = strip(context);
    delam::Solver solver(problem, 0.0);
    expect(solver.advance(0.4) == delam::Outcome::done, "a step");
    solver.commit();
    const auto path = folder.path / "état 1.state";
    solver.save(path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const auto saved = solver.save();
    expect(std::equal(bytes.begin(), bytes.end(), saved.begin(), saved.end(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }),
           "the file has the bytes");
    delam::Solver again(problem, 0.0);
    expect(again.advance(0.1) == delam::Outcome::done, "a step");
    again.load(path.string());
    expect(!again.pending() && again.value("time") == 0.4 && again.save() == saved, "loaded, in the place of a step");
    const auto nowhere = folder.path / "none" / "state";
    expect(file_error([&] { solver.save(nowhere); }, nowhere), "no folder to save to");
    expect(file_error([&] { solver.load(nowhere); }, nowhere), "no file to load");
    expect(file_error([&] { solver.load(folder.path); }, folder.path), "a folder is no file");
    std::ofstream(folder.path / "foreign") << "<?xml version=\"1.0\"?>";
    expect(status_of([&] { solver.load(folder.path / "foreign"); }) == DELAM_ERROR_SNAPSHOT, "a foreign file");
    expect(solver.save() == saved, "refusals change nothing");
}

}  // namespace

int main() {
    test_host_bodies();
    test_refusals();
    test_step_tangent();
    test_condensed();
    test_files();
    return ended();
}
