// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose stiffness the host provides: with the matrices that the library assembles itself, an analysis is the
// same; the host's own supports are found or declared; a matrix that is no solid is refused by name.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "enf.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

struct Csr {
    std::vector<std::int64_t> start, column;
    std::vector<double> value;
};

Csr body_matrix(const Scene& scene, std::int32_t body) {
    std::int64_t rows = 0, entries = 0;
    scene.require(delam_problem_body_matrix(scene.problem(), body, &rows, &entries, nullptr, nullptr, nullptr),
                  "delam_problem_body_matrix");
    Csr k{std::vector<std::int64_t>(static_cast<std::size_t>(rows) + 1),
          std::vector<std::int64_t>(static_cast<std::size_t>(entries)),
          std::vector<double>(static_cast<std::size_t>(entries))};
    scene.require(delam_problem_body_matrix(scene.problem(), body, nullptr, nullptr, k.start.data(), k.column.data(),
                                            k.value.data()),
                  "delam_problem_body_matrix");
    return k;
}

std::vector<std::int64_t> nodes_of(const Scene& scene, std::int32_t body) {
    std::vector<std::int32_t> bodies(scene.node_count());
    scene.require(delam_mesh_node_bodies(scene.mesh(), static_cast<std::int64_t>(bodies.size()), bodies.data()),
                  "delam_mesh_node_bodies");
    std::vector<std::int64_t> nodes;
    for (std::size_t n = 0; n < bodies.size(); ++n)
        if (bodies[n] == body) nodes.push_back(static_cast<std::int64_t>(n));
    return nodes;
}

void check(std::int32_t status, delam_context* context) {
    if (status != DELAM_OK) throw reference::Failure(status, delam_context_message(context));
}

// Nodes and interfaces of a scene, its bodies without cells.
Scene without_cells(const Scene& own, const std::vector<std::int32_t>& bodies) {
    reference::Context context;
    delam_context* c = nullptr;
    check(delam_context_create(&c), c);
    context.reset(c);
    delam_mesh* m = nullptr;
    check(delam_mesh_create(c, own.dimension(), static_cast<std::int64_t>(own.node_count()), own.nodes().data(), &m),
          c);
    reference::Mesh mesh(m);
    for (const std::int32_t body : bodies) {
        const auto nodes = nodes_of(own, body);
        check(delam_mesh_add_host_body(m, body, static_cast<std::int64_t>(nodes.size()), nodes.data(), 0), c);
    }
    const auto dim = static_cast<std::size_t>(own.dimension());
    std::int64_t interfaces = 0;
    own.require(delam_mesh_size(own.mesh(), nullptr, nullptr, nullptr, nullptr, &interfaces), "delam_mesh_size");
    for (std::int64_t i = 0; i < interfaces; ++i) {
        const reference::Pairs pairs = own.pairs(i);
        std::vector<double> normals;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            normals.insert(normals.end(), pairs.frame.begin() + static_cast<std::ptrdiff_t>(p * dim * dim),
                           pairs.frame.begin() + static_cast<std::ptrdiff_t>(p * dim * dim + dim));
        std::int32_t a = 0, b = 0, per_face = 0;
        std::int64_t faces = 0, added = -1;
        check(delam_mesh_interface_size(own.mesh(), i, &a, &b, nullptr, &faces, &per_face), own.context());
        std::vector<std::int64_t> face(static_cast<std::size_t>(faces * per_face));
        check(delam_mesh_interface_faces(own.mesh(), i, face.data()), own.context());
        check(delam_mesh_add_pairs(m, a, b, static_cast<std::int64_t>(pairs.count()), pairs.node_a.data(),
                                   pairs.node_b.data(), normals.data(), pairs.weight.data(), faces, per_face,
                                   face.data(), 0, &added),
              c);
        cases::expect(added == i, "index of the interface");
    }
    delam_problem* p = nullptr;
    check(delam_problem_create(c, m, &p), c);
    reference::Problem problem(p);
    return Scene::adopt(std::move(context), std::move(mesh), std::move(problem),
                        std::vector<reference::InterfaceStiffness>(4));
}

std::int32_t give(const Scene& scene, const std::vector<std::int64_t>& nodes, const Csr& k,
                  std::int64_t kernel_count = -1, const double* kernel = nullptr) {
    return delam_problem_set_stiffness(scene.problem(), static_cast<std::int64_t>(nodes.size()), nodes.data(), nullptr,
                                       k.start.data(), k.column.data(), k.value.data(), kernel_count, kernel, 0);
}

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
    scene.require(
        delam_problem_set_stiffness(scene.problem(), static_cast<std::int64_t>(nodes.size()), one_based.data(),
                                    dofs.data(), k.start.data(), k.column.data(), k.value.data(), -1, nullptr, 1),
        "delam_problem_set_stiffness");
}

constexpr const char* keys[] = {
    "stored_bulk",         "stored_interface", "dissipated",      "work",          "lower", "upper", "crack_length",
    "energy_release_rate", "contact_pairs",    "debonded_length", "reaction:drive"};

// Results of every step of an analysis.
struct Marched {
    std::vector<std::map<std::string, double>> values;
    std::vector<std::vector<double>> displacement;
    double equilibrium = 0.0;  // of the last step
};

Marched march_of(const Scene& scene, double end, int steps) {
    Solver solver(scene, 0.0);
    Marched m;
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
void expect_same(const Marched& own, const Marched& other, double tolerance, const std::string& what) {
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

void dress_flexure(Scene& scene) {
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < 0.0295) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    scene.hold(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, 1.0});
    scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {1.0, 0.0});
    scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {0.0, 1.0});
    const auto middle = scene.find(1, {0.06, 6e-3}, {0.06, 6e-3});
    scene.drive(middle, {0.0, -1.0}, scene.pattern("drive", {0.0, 2.0}, {0.0, 6e-3}),
                std::vector<double>(middle.size(), 1.0));
}

// Three plies in space, peeled from the left: only adhesion holds the middle one.
void dress_peel(Scene& scene) {
    scene.law(0, {1e12, 1e12, 50.0, 50.0, 200.0, 400.0});
    scene.law(1, {1e12, 1e12, 60.0, 60.0, 220.0, 400.0});
    for (std::int64_t i = 0; i < 2; ++i) {
        const auto pairs = scene.pairs(i);
        std::vector<std::int64_t> notch;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (scene.coordinate(pairs.node_a[p], 0) < 0.0075 - 0.002 * static_cast<double>(i))
                notch.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(i, notch, std::vector<double>(notch.size(), 0.0));
    }
    const auto bottom = scene.find(0, {0.0, 0.0, 0.0}, {0.0, 0.004, 0.0});
    for (const auto& along :
         {std::vector<double>{1.0, 0.0, 0.0}, std::vector<double>{0.0, 1.0, 0.0}, std::vector<double>{0.0, 0.0, 1.0}})
        scene.hold(bottom, along);
    const auto end = scene.find(0, {0.02, 0.0, 0.0}, {0.02, 0.004, 0.0});
    scene.hold(end, {0.0, 0.0, 1.0});
    const auto top = scene.find(2, {0.0, 0.0, 0.003}, {0.0, 0.004, 0.003});
    scene.drive(top, {0.0, 0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 4e-4}),
                std::vector<double>(top.size(), 1.0));
}

const std::vector<Example>& examples() {
    static const std::vector<Example> list{
        {"flexure",
         [] {
             Scene scene(2, {0.12}, {60}, {3e-3, 3e-3}, {2, 2}, DELAM_QUAD4);
             scene.interface(0, 1);
             scene.begin();
             scene.elastic(-1, 75e9, 0.3);
             return scene;
         },
         dress_flexure,
         {0, 1},
         2.0},
        {"peel",
         [] {
             Scene scene(3, {0.02, 0.004}, {12, 2}, {1e-3, 1e-3, 1e-3}, {1, 1, 1}, DELAM_HEX8);
             scene.interface(0, 1);
             scene.interface(1, 2);
             scene.begin();
             scene.elastic(-1, 70e9, 0.3);
             return scene;
         },
         dress_peel,
         {0, 1, 2},
         1.0},
    };
    return list;
}

constexpr int steps = 8;

LOOP_TEST(march_is_the_same, 0, 2 * static_cast<int>(examples().size())) {
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

    const Marched expected = march_of(own, example.end, steps);
    const auto same_march = [&](const Scene& other, const char* what) {
        expect_same(expected, march_of(other, example.end, steps), tolerance, name + what);
    };

    // Bodies without cells, one call for each.
    Scene bare = without_cells(own, example.bodies);
    for (const std::int32_t body : example.bodies)
        bare.require(give(bare, nodes_of(own, body), body_matrix(own, body)), "delam_problem_set_stiffness");
    example.dress(bare);
    options(bare);
    same_march(bare, ", without cells");

    // One call for all, with another numbering.
    Scene shuffled = without_cells(own, example.bodies);
    give_shuffled(shuffled, own, example.bodies);
    example.dress(shuffled);
    options(shuffled);
    same_march(shuffled, ", shuffled");

    // Bodies with cells, one of them stiffened by the host: cells only provide the faces.
    Scene mixed = example.make();
    mixed.elastic(example.bodies.back(), 1.0, 0.0);
    mixed.require(give(mixed, nodes_of(own, example.bodies.back()), body_matrix(own, example.bodies.back())),
                  "delam_problem_set_stiffness");
    example.dress(mixed);
    options(mixed);
    same_march(mixed, ", cells");
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
    Scene own(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, 1e12, 0.0);
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
    const std::vector<std::vector<double>> axes{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
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
    // dress_peel without its supports.
    scene.law(0, {1e12, 1e12, 50.0, 50.0, 200.0, 400.0});
    scene.law(1, {1e12, 1e12, 60.0, 60.0, 220.0, 400.0});
    for (std::int64_t i = 0; i < 2; ++i) {
        const auto pairs = scene.pairs(i);
        std::vector<std::int64_t> notch;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (scene.coordinate(pairs.node_a[p], 0) < 0.0075 - 0.002 * static_cast<double>(i))
                notch.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(i, notch, std::vector<double>(notch.size(), 0.0));
    }
    const auto top = scene.find(2, {0.0, 0.0, 0.003}, {0.0, 0.004, 0.003});
    scene.drive(top, axes[2], scene.pattern("drive", {0.0, 1.0}, {0.0, 4e-4}), std::vector<double>(top.size(), 1.0));
    return scene;
}

LOOP_TEST(emptied_rows, 0, 2) {
    const Example& example = examples()[1];
    const bool feti = loop == 1;
    Scene own = example.make();
    example.dress(own);
    own.text("reduction", feti ? "feti" : "condensed");
    own.number("damage_tolerance", 1e-10);
    const Marched expected = march_of(own, example.end, steps);
    for (const double diagonal : {1.0, 1e-3, 1e25}) {
        Scene scene = emptied_scene(example, own, diagonal);
        scene.text("reduction", feti ? "feti" : "condensed");
        scene.number("damage_tolerance", 1e-10);
        expect_same(expected, march_of(scene, example.end, steps), feti ? 1e-6 : 1e-9,
                    std::string(feti ? "FETI" : "condensed") + ", diagonal " + std::to_string(diagonal));
    }
}

// More rows than a dense square block may have, because a body is sparse.
TEST(large_body) {
    Scene own(2, {1.0}, {152}, {1.0, 1.0}, {152, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, 1e9, 0.3);
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

// A kernel declared for two bodies in one call, three motions of each.
TEST(kernel_of_two_bodies) {
    Scene own(2, {2.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, 1e9, 0.3);
    Scene scene = without_cells(own, {0, 1});
    Csr both = body_matrix(own, 0);
    const Csr upper = body_matrix(own, 1);
    const auto rows = both.start.size() - 1;
    for (std::size_t r = 1; r < upper.start.size(); ++r)
        both.start.push_back(static_cast<std::int64_t>(both.value.size()) + upper.start[r]);
    for (const auto c : upper.column) both.column.push_back(c + static_cast<std::int64_t>(rows));
    both.value.insert(both.value.end(), upper.value.begin(), upper.value.end());
    auto nodes = nodes_of(own, 0);
    const auto more = nodes_of(own, 1);
    nodes.insert(nodes.end(), more.begin(), more.end());
    std::vector<double> kernel(6 * 2 * rows, 0.0);
    for (std::size_t body = 0; body < 2; ++body)
        for (std::size_t i = 0; i < rows / 2; ++i) {
            const std::int64_t node = nodes[body * rows / 2 + i];
            const std::size_t x = body * rows + 2 * i;
            kernel[(3 * body) * 2 * rows + x] = kernel[(3 * body + 1) * 2 * rows + x + 1] = 1.0;
            kernel[(3 * body + 2) * 2 * rows + x] = -own.coordinate(node, 1);
            kernel[(3 * body + 2) * 2 * rows + x + 1] = own.coordinate(node, 0);
        }
    scene.require(give(scene, nodes, both, 6, kernel.data()), "six motions of two bodies");
}

// One label, two plies that the matrix does not connect: two pieces, each with its own motions.
TEST(two_pieces_of_one_body) {
    Scene own(2, {0.12}, {30}, {2e-3, 2e-3, 2e-3}, {1, 1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.interface(1, 2);
    own.begin();
    own.elastic(-1, 75e9, 0.3);
    const auto dress = [](Scene& scene, std::int32_t top_body) {
        for (std::int64_t i = 0; i < 2; ++i) {
            scene.law(i, {1e12, 1e12, 20.0, 20.0, 2000.0, 2000.0});
            scene.adhesion(i, {0, 1, 2, 3}, std::vector<double>(4, 0.0));
        }
        const auto foot = scene.find(0, {0.0, 0.0}, {0.0, 0.0});
        scene.hold(foot, {1.0, 0.0});
        scene.hold(foot, {0.0, 1.0});
        scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {0.0, 1.0});
        scene.drive(scene.find(top_body, {0.0, 6e-3}, {0.0, 6e-3}), {0.0, 1.0},
                    scene.pattern("drive", {0.0, 1.0}, {0.0, 1.5e-3}), {1.0});
    };
    dress(own, 2);
    // Bodies 0 and 2 become body 0; interface 1 connects 1 and 0.
    reference::Context context;
    delam_context* c = nullptr;
    check(delam_context_create(&c), c);
    context.reset(c);
    delam_mesh* m = nullptr;
    check(delam_mesh_create(c, 2, static_cast<std::int64_t>(own.node_count()), own.nodes().data(), &m), c);
    reference::Mesh mesh(m);
    auto outer = nodes_of(own, 0);
    const auto upper = nodes_of(own, 2), middle = nodes_of(own, 1);
    const Csr lower = body_matrix(own, 0), top = body_matrix(own, 2);
    Csr both = lower;
    for (std::size_t r = 1; r < top.start.size(); ++r) both.start.push_back(lower.start.back() + top.start[r]);
    for (const auto column : top.column)
        both.column.push_back(column + static_cast<std::int64_t>(lower.start.size()) - 1);
    both.value.insert(both.value.end(), top.value.begin(), top.value.end());
    outer.insert(outer.end(), upper.begin(), upper.end());
    check(delam_mesh_add_host_body(m, 0, static_cast<std::int64_t>(outer.size()), outer.data(), 0), c);
    check(delam_mesh_add_host_body(m, 1, static_cast<std::int64_t>(middle.size()), middle.data(), 0), c);
    const auto a = own.pairs(0), b = own.pairs(1);
    // Both interfaces are between bodies 0 and 1: one list of pairs, with the second reversed.
    std::vector<std::int64_t> of_0 = a.node_a, of_1 = a.node_b;
    of_0.insert(of_0.end(), b.node_b.begin(), b.node_b.end());
    of_1.insert(of_1.end(), b.node_a.begin(), b.node_a.end());
    std::vector<double> weights = a.weight, normals;
    weights.insert(weights.end(), b.weight.begin(), b.weight.end());
    for (std::size_t p = 0; p < of_0.size(); ++p) {
        normals.push_back(0.0);
        normals.push_back(p < a.count() ? 2.0 : -0.5);
    }
    std::int64_t index = -1;
    check(delam_mesh_add_pairs(m, 0, 1, static_cast<std::int64_t>(of_0.size()), of_0.data(), of_1.data(),
                               normals.data(), weights.data(), 0, 0, nullptr, 0, &index),
          c);
    delam_problem* p = nullptr;
    check(delam_problem_create(c, m, &p), c);
    Scene scene = Scene::adopt(std::move(context), std::move(mesh), reference::Problem(p),
                               std::vector<reference::InterfaceStiffness>(4));
    scene.require(give(scene, outer, both), "both plies");
    scene.require(give(scene, middle, body_matrix(own, 1)), "middle");
    scene.law(0, {1e12, 1e12, 20.0, 20.0, 2000.0, 2000.0});
    std::vector<std::int64_t> notch;
    for (std::int64_t k = 0; k < 4; ++k) {
        notch.push_back(k);
        notch.push_back(k + static_cast<std::int64_t>(a.count()));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const auto foot = scene.find(0, {0.0, 0.0}, {0.0, 0.0});
    scene.hold(foot, {1.0, 0.0});
    scene.hold(foot, {0.0, 1.0});
    scene.hold(scene.find(0, {0.12, 0.0}, {0.12, 0.0}), {0.0, 1.0});
    scene.drive(scene.find(0, {0.0, 6e-3}, {0.0, 6e-3}), {0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 1.5e-3}),
                {1.0});
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        own.text("reduction", reduction);
        scene.text("reduction", reduction);
        for (Scene* s : {&own, &scene}) s->number("damage_tolerance", 1e-10);
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

// Errors are named, and the problem stays unchanged.
TEST(refusals) {
    Scene own(2, {2.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, 1e9, 0.3);
    const Csr k = body_matrix(own, 0);
    const auto nodes = nodes_of(own, 0);
    Scene scene = without_cells(own, {0, 1});
    const auto refused = [&](std::int32_t status, std::int32_t expected, const char* words) {
        const std::string text = delam_context_message(scene.context());
        cases::expect(status == expected && text.find(words) != std::string::npos,
                      std::string(words) + ": " + delam_status_name(status) + ", " + text);
    };
    const auto changed = [&](const std::function<void(Csr&, std::vector<std::int64_t>&)>& change, const char* words) {
        Csr other = k;
        auto list = nodes;
        change(other, list);
        refused(give(scene, list, other), DELAM_ERROR_ARGUMENT, words);
    };
    changed([](Csr& c, auto&) { c.value[1] *= 1.001; }, "not symmetric");
    changed([](Csr& c, auto&) { c.value[2] = NAN; }, "values[2]");
    changed([](Csr& c, auto&) { c.column[2] = 99; }, "columns[2] = 99");
    changed([](Csr& c, auto&) { c.start[3] = 1; }, "row_starts[3] = 1");
    changed([](Csr&, auto& list) { list[1] = list[0]; }, "occurs twice");
    changed([](Csr&, auto& list) { list[1] = 999; }, "nodes[1] = 999");
    changed([&](Csr&, auto& list) { list[1] = nodes_of(own, 1)[0]; }, "is missing");
    changed(
        [](Csr& c, auto&) {
            for (double& v : c.value) v = -v;
        },
        "diagonal");
    // Twice the shear coupling: symmetric, a positive diagonal, indefinite.
    changed(
        [](Csr& c, auto&) {
            for (std::size_t r = 0; r + 1 < c.start.size(); ++r)
                for (auto e = static_cast<std::size_t>(c.start[r]); e < static_cast<std::size_t>(c.start[r + 1]); ++e)
                    if (static_cast<std::size_t>(c.column[e]) != r) c.value[e] *= 3.0;
        },
        "indefinite");
    // Two squares that share one node: a hinge.
    {
        reference::Context context;
        delam_context* c = nullptr;
        check(delam_context_create(&c), c);
        context.reset(c);
        const std::vector<double> places{0, 0, 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 2, 2};
        delam_mesh* m = nullptr;
        check(delam_mesh_create(c, 2, 7, places.data(), &m), c);
        reference::Mesh mesh(m);
        const std::vector<std::int64_t> cells{0, 1, 3, 2, 3, 4, 6, 5};
        check(delam_mesh_add_cells(m, DELAM_QUAD4, 2, cells.data(), nullptr, 0), c);
        delam_problem* p = nullptr;
        check(delam_problem_create(c, m, &p), c);
        Scene hinged = Scene::adopt(std::move(context), std::move(mesh), reference::Problem(p),
                                    std::vector<reference::InterfaceStiffness>(4));
        hinged.elastic(-1, 1e9, 0.3);
        const Csr h = body_matrix(hinged, 0);
        const std::int32_t status = give(hinged, nodes_of(hinged, 0), h);
        const std::string text = delam_context_message(hinged.context());
        cases::expect(status == DELAM_ERROR_ARGUMENT && text.find("mechanism") != std::string::npos, "hinge: " + text);
    }
    // A support that is neither stiff nor absent.
    changed([&](Csr& c, auto&) { c.value[0] *= 1.0 + 3e-10; }, "give the kernel");
    // One matrix that couples two bodies.
    {
        Csr two = k;
        const Csr other = body_matrix(own, 1);
        for (std::size_t r = 1; r < other.start.size(); ++r) two.start.push_back(k.start.back() + other.start[r]);
        for (const auto column : other.column)
            two.column.push_back(column + static_cast<std::int64_t>(k.start.size()) - 1);
        two.value.insert(two.value.end(), other.value.begin(), other.value.end());
        two.column[5] = static_cast<std::int64_t>(two.start.size()) - 2;
        auto list = nodes;
        const auto upper = nodes_of(own, 1);
        list.insert(list.end(), upper.begin(), upper.end());
        refused(give(scene, list, two), DELAM_ERROR_ARGUMENT, "couples bodies 0 and 1");
    }
    // Nothing was taken over.
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "body 0: no cells and no stiffness");
    scene.require(give(scene, nodes, k), "a sound one");
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "body 1: no cells and no stiffness");
    scene.require(give(scene, nodes_of(own, 1), body_matrix(own, 1)), "a sound one");
    const auto heat = scene.pattern("heat", {0.0}, {1.0});
    const std::vector<double> strain{1e-3, 1e-3, 0, 0, 0, 0};
    scene.law(0, {1e9, 1e9, 1.0, 1.0, 2.0, 2.0});
    scene.require(delam_problem_add_eigenstrain(scene.problem(), heat, -1, strain.data()), "eigenstrain");
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "has the host's stiffness and an eigenstrain");
    // Meshes.
    delam_mesh* mesh = scene.mesh();
    const std::vector<std::int64_t> one{0}, cell{0, 1, 4, 3};
    refused(delam_mesh_add_host_body(mesh, 0, 1, one.data(), 0), DELAM_ERROR_MESH, "body 0 exists already");
    refused(delam_mesh_add_host_body(mesh, 7, 1, one.data(), 0), DELAM_ERROR_MESH, "belongs to body 0");
    refused(delam_mesh_add_cells(mesh, DELAM_QUAD4, 1, cell.data(), nullptr, 0), DELAM_ERROR_MESH,
            "made without cells");
    std::int64_t index = 0;
    const double normal[2] = {0.0, 1.0}, good = 1.0;
    refused(delam_mesh_add_pairs(mesh, 0, 1, 1, one.data(), one.data(), normal, &good, 0, 0, nullptr, 0, &index),
            DELAM_ERROR_ARGUMENT, "joined by interface");
}

// Without faces there are no fronts, and nothing for a gradient term to act on.
TEST(no_faces) {
    Scene own(2, {2.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    own.interface(0, 1);
    own.begin();
    own.elastic(-1, 1e9, 0.3);
    const auto pairs = own.pairs(0);
    reference::Context context;
    delam_context* c = nullptr;
    check(delam_context_create(&c), c);
    context.reset(c);
    delam_mesh* m = nullptr;
    check(delam_mesh_create(c, 2, static_cast<std::int64_t>(own.node_count()), own.nodes().data(), &m), c);
    reference::Mesh mesh(m);
    for (const std::int32_t body : {0, 1}) {
        const auto nodes = nodes_of(own, body);
        check(delam_mesh_add_host_body(m, body, static_cast<std::int64_t>(nodes.size()), nodes.data(), 0), c);
    }
    const std::vector<double> normals{0, 1, 0, 1, 0, 1};
    std::vector<double> weights = pairs.weight;
    std::int64_t index = -1;
    weights[1] = -1.0;
    cases::expect(delam_mesh_add_pairs(m, 0, 1, 3, pairs.node_a.data(), pairs.node_b.data(), normals.data(),
                                       weights.data(), 0, 0, nullptr, 0, &index) == DELAM_ERROR_ARGUMENT &&
                      std::string(delam_context_message(c)).find("weights[1] = -1") != std::string::npos,
                  delam_context_message(c));
    weights[1] = pairs.weight[1];
    check(delam_mesh_add_pairs(m, 0, 1, 3, pairs.node_a.data(), pairs.node_b.data(), normals.data(), weights.data(), 0,
                               0, nullptr, 0, &index),
          c);
    delam_problem* p = nullptr;
    check(delam_problem_create(c, m, &p), c);
    Scene scene = Scene::adopt(std::move(context), std::move(mesh), reference::Problem(p),
                               std::vector<reference::InterfaceStiffness>(4));
    for (const std::int32_t body : {0, 1})
        scene.require(give(scene, nodes_of(own, body), body_matrix(own, body)), "stiffness");
    reference::LawData law{1e9, 1e9, 1.0, 1.0, 2.0, 2.0};
    law.gradient = 1e-3;
    scene.law(0, law);
    const auto foot = scene.find(0, {0.0, 0.0}, {2.0, 0.0});
    scene.hold(foot, {1.0, 0.0});
    scene.hold(foot, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {0.0, 2.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 3e-4}), {1.0});
    cases::expect(delam_problem_check(scene.problem()) == DELAM_ERROR_PROBLEM &&
                      std::string(delam_context_message(scene.context())).find("no faces") != std::string::npos,
                  delam_context_message(scene.context()));
    law.gradient = 0.0;
    scene.law(0, law);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    std::int64_t fronts = -1;
    scene.require(delam_solver_front_count(solver.get(), 0, &fronts, nullptr), "delam_solver_front_count");
    cases::expect(fronts == 0, "fronts without faces");
    const auto stress = solver.field("stress");
    cases::expect(stress.empty(), "stresses without cells");
    cases::expect(delam_mesh_interface_faces(m, index, nullptr) == DELAM_OK, "NULL for no faces");
}

}  // namespace
