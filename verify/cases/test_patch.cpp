// SPDX-License-Identifier: BSD-3-Clause
// Patch tests of two blocks: a linear displacement on the boundary of perfectly bonded blocks gives its constant
// stress; a compliant interface under uniform tension opens by exactly t/k. Both for any number of subdomains up to 8,
// some of them in the long tier.
#include <algorithm>

#include "acceptance.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

struct Shape {
    int dimension;
    std::int32_t cell;
    const char* name;
};
constexpr Shape shapes[] = {{2, DELAM_TRI3, "tri3"},      {2, DELAM_QUAD4, "quad4"},   {3, DELAM_TET4, "tet4"},
                            {3, DELAM_HEX8, "hex8"},      {2, DELAM_TRI6, "tri6"},     {2, DELAM_QUAD8, "quad8"},
                            {2, DELAM_QUAD9, "quad9"},    {3, DELAM_TET10, "tet10"},   {3, DELAM_HEX20, "hex20"},
                            {3, DELAM_HEX27, "hex27"},    {3, DELAM_WEDGE6, "wedge6"}, {3, DELAM_PYRAMID5, "pyramid5"},
                            {3, DELAM_WEDGE15, "wedge15"}};
constexpr double young = 10e9;
constexpr double poisson = 0.3;

Scene blocks(const Shape& shape) {
    const bool plane = shape.dimension == 2;
    return Scene(shape.dimension, plane ? std::vector<double>{0.3} : std::vector<double>{0.3, 0.2},
                 plane ? std::vector<std::int64_t>{4} : std::vector<std::int64_t>{3, 2}, {0.1, 0.15}, {2, 2},
                 shape.cell);
}

std::vector<double> upper_corner(const Shape& shape) {
    return shape.dimension == 2 ? std::vector<double>{0.3, 0.25} : std::vector<double>{0.3, 0.2, 0.25};
}

// Nodes on the outer surface; for bonded pairs there, both nodes or only the lower block's.
std::vector<std::int64_t> surface(const Scene& scene, const Shape& shape, bool both_of_a_pair) {
    const auto corner = upper_corner(shape);
    const std::size_t d = corner.size();
    std::vector<std::int64_t> nodes;
    for (std::size_t k = 0; k < d; ++k) {
        for (const double side : {0.0, corner[k]}) {
            auto lower = std::vector<double>(d, 0.0);
            auto upper = corner;
            lower[k] = upper[k] = side;
            for (const auto n : scene.find(-1, lower, upper)) nodes.push_back(n);
        }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (!both_of_a_pair) {
        const auto paired = scene.pairs(0).node_b;
        std::erase_if(nodes,
                      [&](std::int64_t n) { return std::find(paired.begin(), paired.end(), n) != paired.end(); });
    }
    return nodes;
}

// A full gradient, rotation included; rows are displacement components.
constexpr double gradient[3][3] = {{1.0e-3, 0.4e-3, -0.3e-3}, {-0.7e-3, -0.5e-3, 0.2e-3}, {0.6e-3, 0.9e-3, 0.8e-3}};

double exact(const Scene& scene, std::int64_t node, int component) {
    double u = 0.0;
    for (int k = 0; k < scene.dimension(); ++k) u += gradient[component][k] * scene.coordinate(node, k);
    return u;
}

std::vector<double> exact_stress(int dimension) {
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    const double mu = young / (2 * (1 + poisson));
    double trace = 0.0;
    for (int k = 0; k < dimension; ++k) trace += gradient[k][k];
    const auto normal = [&](int k) { return lambda * trace + (k < dimension ? 2 * mu * gradient[k][k] : 0.0); };
    const auto shear = [&](int i, int j) { return mu * (gradient[i][j] + gradient[j][i]); };
    if (dimension == 2) return {normal(0), normal(1), normal(2), shear(0, 1)};
    return {normal(0), normal(1), normal(2), shear(0, 1), shear(1, 2), shear(2, 0)};
}

void linear_field(const Shape& shape, int subdomains, bool both_of_a_pair) {
    Scene scene = blocks(shape);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    scene.bonded(0);
    const auto load = scene.pattern("stretch", {0.0, 1.0}, {0.0, 1.0});
    const auto nodes = surface(scene, shape, both_of_a_pair);
    for (int k = 0; k < shape.dimension; ++k) {
        std::vector<double> direction(static_cast<std::size_t>(shape.dimension), 0.0);
        direction[static_cast<std::size_t>(k)] = 1.0;
        std::vector<double> values;
        for (const auto n : nodes) values.push_back(exact(scene, n, k));
        scene.drive(nodes, direction, load, values);
    }
    scene.number("subdomains", subdomains);
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});

    const std::string where = std::string(shape.name) + ", " + std::to_string(subdomains) + " subdomains" +
                              (both_of_a_pair ? ", redundant supports" : "");
    const auto u = solver.field("displacement");
    double size = 0.0;
    for (const double v : u) size = std::max(size, std::abs(v));
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto d = static_cast<std::size_t>(shape.dimension);
        cases::expect_near(u[i], exact(scene, static_cast<std::int64_t>(i / d), static_cast<int>(i % d)), 1e-10, size,
                           where + ": displacement " + std::to_string(i));
    }
    const auto expected = exact_stress(shape.dimension);
    double stress_size = 0.0;
    for (const double s : expected) stress_size = std::max(stress_size, std::abs(s));
    const auto stress = solver.field("stress");
    for (std::size_t i = 0; i < stress.size(); ++i) {
        cases::expect_near(stress[i], expected[i % expected.size()], 1e-10, stress_size,
                           where + ": stress " + std::to_string(i));
    }
    for (const double j : solver.field("jump")) cases::expect_near(j, 0.0, 1e-10, size, where + ": jump");
}

void compliant_interface(const Shape& shape, int subdomains) {
    const auto d = static_cast<std::size_t>(shape.dimension);
    const double k = 3e11;
    const double w = 1e-5;
    const double height = 0.25;
    Scene scene = blocks(shape);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    if (shape.dimension == 2) scene.require(delam_problem_set_plane(scene.problem(), "plane-stress"), "plane");
    scene.law(0, {k, 0.5 * k, 1e3, 1e3, 2e3, 2e3});
    const auto corner = upper_corner(shape);
    auto lower = std::vector<double>(d, 0.0);
    auto upper = corner;
    upper[d - 1] = 0.0;
    std::vector<double> axial(d, 0.0);
    axial[d - 1] = 1.0;
    scene.hold(scene.find(0, lower, upper), axial);
    const auto origin = scene.find(0, std::vector<double>(d, 0.0), std::vector<double>(d, 0.0));
    std::vector<double> direction(d, 0.0);
    direction[0] = 1.0;
    scene.hold(origin, direction);
    if (d == 3) {
        scene.hold(origin, {0.0, 1.0, 0.0});
        scene.hold(scene.find(0, {corner[0], 0.0, 0.0}, {corner[0], 0.0, 0.0}), {0.0, 1.0, 0.0});
    }
    lower[d - 1] = upper[d - 1] = height;
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, w});
    const auto end = scene.find(1, lower, upper);
    scene.drive(end, axial, load, std::vector<double>(end.size(), 1.0));
    scene.number("subdomains", subdomains);
    Solver solver(scene, 0.0);
    solver.step(1.0);

    // Uniaxial stress: the bar's stiffness is E/height, whatever the lateral contraction.
    const double t = w / (height / young + 1.0 / k);
    const std::string where = std::string(shape.name) + ", " + std::to_string(subdomains) + " subdomains";
    const auto jump = solver.field("jump");
    const auto traction = solver.field("traction");
    const double area = d == 2 ? corner[0] : corner[0] * corner[1];
    const auto accepted = reference::accept(solver, reference::Exported(scene));
    cases::expect_below(accepted.worst(), 1e-10, where + ": " + accepted.text());
    for (std::size_t i = 0; i < jump.size(); ++i) {
        cases::expect_near(jump[i], i % d == 0 ? t / k : 0.0, 1e-10, t / k, where + ": jump");
        cases::expect_near(traction[i], i % d == 0 ? t : 0.0, 1e-10, t, where + ": traction");
    }
    cases::expect_near(solver.value("reaction:pull"), t * area, 1e-10, t * area, where + ": reaction");
    cases::expect_near(solver.value("stored_interface"), 0.5 * t * t / k * area, 1e-10, t * t / k * area,
                       where + ": energy");
}

// The numbers of subdomains.
template <class Check>
void for_each_count(Check&& check) {
    for (const int n : {1, 3, 5, 8}) check(n);
    for (const int n : {2, 4, 6, 7})
        if (cases::whole()) check(n);
}

LOOP_TEST(bonded_blocks, 0, std::size(shapes)) {
    for_each_count([&](int n) { linear_field(shapes[loop], n, false); });
}

// Both nodes of a bonded pair are prescribed: the bond there is redundant.
LOOP_TEST(bonded_blocks_redundant, 0, std::size(shapes)) {
    for_each_count([&](int n) { linear_field(shapes[loop], n, true); });
}

LOOP_TEST(compliant_interface_in_series, 0, std::size(shapes)) {
    for_each_count([&](int n) { compliant_interface(shapes[loop], n); });
}

}  // namespace
