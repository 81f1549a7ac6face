// SPDX-License-Identifier: BSD-3-Clause
// Hexahedra, wedges, pyramids and tetrahedra in one body, each sharing triangles and quadrilaterals with others, and an
// interface of both kinds of faces between two such bodies: patch tests on distorted cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "acceptance.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;
using Cells = Scene::Cells;

constexpr double young = 10e9, poisson = 0.3;
constexpr std::array<double, 3> size{0.3, 0.2, 0.25};

// A box is a hexahedron, two wedges on triangles of its lower and upper face, six tetrahedra (Kuhn), or has a node in
// its centre, from which pyramids and tetrahedra reach to its faces, as the neighbours want them.
enum class Fill { hexahedron, wedges, tetrahedra, centre };

using Place = std::array<int, 3>;  // of a lattice of half boxes
using Nodes = std::array<std::int64_t, 8>;

constexpr std::array<std::array<std::size_t, 4>, 6> sides{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
constexpr std::array<Place, 6> beyond{{{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}};

// 3 x 3 x 2 boxes; the two levels are bodies 0 and 1. `curved`: of quadratic hexahedra and wedges alone.
class Mixture {
public:
    explicit Mixture(bool curved) : curved_(curved) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 2; ++k) fill_box(i, j, k);
    }

    Scene scene(bool distorted) {
        std::mt19937 random(4);
        std::uniform_real_distribution<double> draw(-1.0, 1.0);
        std::vector<double> nodes(3 * number_.size());
        const double most = curved_ ? 0.04 : 0.12;  // of a box
        for (const auto& [place, node] : number_)
            for (std::size_t a = 0; a < 3; ++a) {
                const int last = a == 2 ? 4 : 6;
                const bool free = place[a] > 0 && place[a] < last && !(a == 2 && place[a] == 2);
                nodes[3 * static_cast<std::size_t>(node) + a] =
                    size[a] / last * (place[a] + (free && distorted ? 2.0 * most * draw(random) : 0.0));
            }
        std::vector<Cells> all;
        for (auto& [type, cells] : cells_) all.push_back(cells);
        return Scene::conforming(3, nodes, all);
    }

private:
    Fill fill(int i, int j, int k) const {
        if (curved_) return (i + j) % 2 == 0 ? Fill::wedges : Fill::hexahedron;
        if (i < 0 || j < 0 || k < 0 || i > 2 || j > 2 || k > 1) return Fill::centre;
        if (i == 0) return Fill::hexahedron;
        if (i == 1) return j == 1 ? Fill::wedges : Fill::centre;
        return j == 1 ? Fill::centre : Fill::tetrahedra;
    }
    std::int64_t node(const Place& place) {
        return number_.emplace(place, static_cast<std::int64_t>(number_.size())).first->second;
    }
    void add(std::int32_t type, int body, const std::vector<std::int64_t>& nodes) {
        Cells& cells = cells_[type];
        cells.type = type;
        cells.nodes.insert(cells.nodes.end(), nodes.begin(), nodes.end());
        cells.bodies.push_back(body);
    }
    // A cell by its corners, with the nodes midway.
    void add_curved(std::int32_t type, int body, const std::vector<Place>& corner) {
        constexpr std::array<std::array<std::size_t, 2>, 9> wedge{
            {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
        constexpr std::array<std::array<std::size_t, 2>, 12> box{
            {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
        std::vector<std::int64_t> nodes;
        for (const Place& p : corner) nodes.push_back(node(p));
        const auto between = [&](const std::array<std::size_t, 2>& ends) {
            const Place &p = corner[ends[0]], &q = corner[ends[1]];
            nodes.push_back(node({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2}));
        };
        if (type == DELAM_WEDGE15)
            std::for_each(wedge.begin(), wedge.end(), between);
        else
            std::for_each(box.begin(), box.end(), between);
        add(type, body, nodes);
    }
    void fill_box(int i, int j, int k) {
        std::array<Place, 8> at;
        constexpr std::array<std::array<int, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t c = 0; c < 8; ++c)
            at[c] = {2 * (i + square[c % 4][0]), 2 * (j + square[c % 4][1]), 2 * (k + (c < 4 ? 0 : 1))};
        const Fill what = fill(i, j, k);
        if (curved_) {
            if (what == Fill::hexahedron) return add_curved(DELAM_HEX20, k, {at.begin(), at.end()});
            add_curved(DELAM_WEDGE15, k, {at[4], at[5], at[6], at[0], at[1], at[2]});
            return add_curved(DELAM_WEDGE15, k, {at[4], at[6], at[7], at[0], at[2], at[3]});
        }
        Nodes n;
        std::transform(at.begin(), at.end(), n.begin(), [this](const Place& place) { return node(place); });
        if (what == Fill::hexahedron) add(DELAM_HEX8, k, {n.begin(), n.end()});
        if (what == Fill::wedges) {
            add(DELAM_WEDGE6, k, {n[4], n[5], n[6], n[0], n[1], n[2]});
            add(DELAM_WEDGE6, k, {n[4], n[6], n[7], n[0], n[2], n[3]});
        }
        if (what == Fill::tetrahedra)
            for (const auto& [a, b] : {std::pair{1, 2}, {5, 1}, {2, 3}, {3, 7}, {4, 5}, {7, 4}})
                add(DELAM_TET4, k, {n[0], n[static_cast<std::size_t>(a)], n[static_cast<std::size_t>(b)], n[6]});
        if (what == Fill::centre) fill_around(i, j, k, n);
    }
    void fill_around(int i, int j, int k, const Nodes& n) {
        const std::int64_t centre = node({2 * i + 1, 2 * j + 1, 2 * k + 1});
        for (std::size_t s = 0; s < 6; ++s) {
            const auto& [p, q, r, t] = sides[s];
            const Fill next = fill(i + beyond[s][0], j + beyond[s][1], k + beyond[s][2]);
            if (next != Fill::tetrahedra && !(next == Fill::wedges && s < 2)) {
                add(DELAM_PYRAMID5, k, {n[p], n[t], n[r], n[q], centre});
                continue;
            }
            // Kuhn's diagonals begin at corner 0 of the lists above, or end at corner 6, the third.
            add(DELAM_TET4, k, {n[p], n[r], n[q], centre});
            add(DELAM_TET4, k, {n[p], n[t], n[r], centre});
        }
    }

    bool curved_;
    std::map<Place, std::int64_t> number_;
    std::map<std::int32_t, Cells> cells_;
};

constexpr double gradient[3][3] = {{1.0e-3, 0.4e-3, -0.3e-3}, {-0.7e-3, -0.5e-3, 0.2e-3}, {0.6e-3, 0.9e-3, 0.8e-3}};

double exact(const Scene& scene, std::int64_t node, int component) {
    double u = 0.0;
    for (int k = 0; k < 3; ++k) u += gradient[component][k] * scene.coordinate(node, k);
    return u;
}

std::vector<std::int64_t> surface(const Scene& scene) {
    std::vector<std::int64_t> nodes;
    for (std::size_t a = 0; a < 3; ++a)
        for (const double side : {0.0, size[a]}) {
            std::vector<double> lower(3, -1.0), upper(3, 1.0);
            lower[a] = upper[a] = side;
            for (const auto n : scene.find(-1, lower, upper)) nodes.push_back(n);
        }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void linear_field(bool curved, const char* formulation, int subdomains) {
    Scene scene = Mixture(curved).scene(true);
    cases::expect(scene.all_interfaces() == 1, "one interface");
    const auto pairs = scene.pairs(0);
    double area = 0.0;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        area += pairs.weight[p];
        cases::expect(pairs.weight[p] > 0.0, "weights are positive");
        cases::expect_near(pairs.frame[9 * p + 2], 1.0, 1e-13, 1.0, "normal");
    }
    cases::expect_near(area, size[0] * size[1], 1e-13, area, "area of the interface");
    scene.begin();
    scene.elastic(-1, young, poisson);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, formulation);
    scene.bonded(0);
    const auto load = scene.pattern("stretch", {0.0, 1.0}, {0.0, 1.0});
    const auto nodes = surface(scene);
    cases::expect(nodes.size() < scene.node_count(), "some nodes are inside");
    for (int k = 0; k < 3; ++k) {
        std::vector<double> direction(3, 0.0), values;
        direction[static_cast<std::size_t>(k)] = 1.0;
        for (const auto n : nodes) values.push_back(exact(scene, n, k));
        scene.drive(nodes, direction, load, values);
    }
    scene.number("subdomains", subdomains);
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});

    const std::string where = std::string(curved ? "quadratic" : "linear") + ", " + formulation + ", " +
                              std::to_string(subdomains) + " subdomains";
    const auto u = solver.field("displacement");
    for (std::size_t i = 0; i < u.size(); ++i)
        cases::expect_near(u[i], exact(scene, static_cast<std::int64_t>(i / 3), static_cast<int>(i % 3)), 1e-10, 5e-4,
                           where + ": displacement " + std::to_string(i));
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
    const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
    const auto shear = [&](int i, int j) { return mu * (gradient[i][j] + gradient[j][i]); };
    const std::array<double, 6> expected{lambda * trace + shear(0, 0),
                                         lambda * trace + shear(1, 1),
                                         lambda * trace + shear(2, 2),
                                         shear(0, 1),
                                         shear(1, 2),
                                         shear(2, 0)};
    const auto stress = solver.field("stress");
    for (std::size_t i = 0; i < stress.size(); ++i)
        cases::expect_near(stress[i], expected[i % 6], 1e-10, young * 1e-3, where + ": stress");
    for (const double j : solver.field("jump")) cases::expect_near(j, 0.0, 1e-10, 5e-4, where + ": jump");
    cases::expect_below(std::abs(solver.value("mesh_error")), 1e-12, where + ": estimated error");
}

LOOP_TEST(bonded, 0, 2) {
    for (const int subdomains : {1, 3}) linear_field(loop == 1, "standard", subdomains);
    if (loop == 0) linear_field(false, "incompatible", 1);  // of the hexahedra
}

// Triangles and quadrilaterals of linear cells carry a uniform traction without any error; the bodies contract freely.
TEST(compliant_interface) {
    constexpr double k = 3e11, opening = 1e-5;
    Scene scene = Mixture(false).scene(true);
    scene.all_interfaces();
    scene.begin();
    scene.elastic(-1, young, poisson);
    scene.law(0, {k, 0.5 * k, 1e3, 1e3, 2e3, 2e3});
    scene.hold(scene.find(0, {-1, -1, 0}, {1, 1, 0}), {0, 0, 1});
    const auto top = scene.find(1, {-1, -1, size[2]}, {1, 1, size[2]});
    const auto origin = scene.find(0, {0, 0, 0}, {0, 0, 0});
    scene.hold(origin, {1, 0, 0});
    scene.hold(origin, {0, 1, 0});
    scene.hold(scene.find(0, {size[0], 0, 0}, {size[0], 0, 0}), {0, 1, 0});
    const auto load = scene.pattern("pull", {0.0, 1.0, 2.0}, {0.0, opening, -opening});
    scene.drive(top, {0, 0, 1}, load, std::vector<double>(top.size(), 1.0));
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const double t = opening / (size[2] / young + 1.0 / k), area = size[0] * size[1];
    const auto accepted = reference::accept(solver, reference::Exported(scene));
    cases::expect_below(accepted.worst(), 1e-10, accepted.text());
    const auto jump = solver.field("jump"), traction = solver.field("traction");
    for (std::size_t i = 0; i < jump.size(); ++i) {
        cases::expect_near(jump[i], i % 3 == 0 ? t / k : 0.0, 1e-10, t / k, "jump");
        cases::expect_near(traction[i], i % 3 == 0 ? t : 0.0, 1e-10, t, "traction");
    }
    cases::expect_near(solver.value("reaction:pull"), t * area, 1e-10, t * area, "reaction");
    solver.commit();
    // Pushed together, the faces are in contact: the two bodies act as one bar.
    solver.step(2.0);
    for (const double j : solver.field("jump")) cases::expect_near(j, 0.0, 1e-10, t / k, "closed");
    const double pressed = -opening * young / size[2] * area;
    cases::expect_near(solver.value("reaction:pull"), pressed, 1e-10, -pressed, "reaction in contact");
}

}  // namespace
