// SPDX-License-Identifier: BSD-3-Clause
// The gradient term: its operator against integrals known beforehand, its damage step against brute force, optimality
// conditions and closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "check.hpp"
#include "evolution/increment/coupled_damage.hpp"
#include "evolution/increment/gradient.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"

using namespace delam;

namespace {

using Numbers = std::vector<double>;
using Point = std::array<double, 3>;
using Map = std::function<Point(const Point&)>;

constexpr CellType plane_types[] = {CellType::quad4, CellType::tri3, CellType::quad8, CellType::quad9, CellType::tri6};
constexpr CellType solid_types[] = {CellType::hex8, CellType::tet4, CellType::hex20, CellType::tet10};
bool quadratic(CellType type) { return topology(type).nodes > topology(type).corners; }

// Two layers of thickness 0.5, their nodes moved by `map`.
Mesh two_layers(CellType type, const Numbers& lengths, const std::vector<std::int64_t>& divisions,
                const Map& map = {}) {
    const Numbers thickness{0.5, 0.5};
    const std::vector<std::int64_t> through{1, 1};
    const Mesh straight = make_layers(topology(type).dimension, lengths, divisions, thickness, through, type);
    Numbers nodes(straight.nodes().begin(), straight.nodes().end());
    const auto dim = static_cast<std::size_t>(straight.dimension());
    for (std::size_t i = 0; map && i < nodes.size(); i += dim) {
        Point x{};
        std::copy_n(nodes.begin() + static_cast<std::ptrdiff_t>(i), dim, x.begin());
        const Point y = map(x);
        std::copy_n(y.begin(), dim, nodes.begin() + static_cast<std::ptrdiff_t>(i));
    }
    Mesh mesh(straight.dimension(), nodes);
    for (std::int64_t c = 0; c < straight.cell_count(); ++c)
        mesh.add_cells(type, straight.cell(c), std::vector<std::int32_t>{straight.cell_body(c)});
    add_interface(mesh, 0, 1, 0.0);
    return mesh;
}

const InterfaceGeometry& interface_of(const Mesh& mesh) { return mesh.interfaces()[0]; }
Numbers ones(const Mesh& mesh) { return Numbers(interface_of(mesh).weight.size(), 1.0); }
SparseMatrix stiffness_of(const Mesh& mesh) { return surface_stiffness(mesh, interface_of(mesh), ones(mesh)); }

Numbers field(const Mesh& mesh, const std::function<double(const Point&)>& f) {
    Numbers z;
    for (const std::int64_t node : interface_of(mesh).node_a) {
        Point x{};
        std::copy(mesh.node(node).begin(), mesh.node(node).end(), x.begin());
        z.push_back(f(x));
    }
    return z;
}

Numbers product(const SparseMatrix& a, const Numbers& z) {
    Numbers y(z.size());
    multiply(a, z, y);
    return y;
}
double quadratic_form(const SparseMatrix& a, const Numbers& z) {
    const Numbers y = product(a, z);
    double sum = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) sum += z[i] * y[i];
    return sum;
}

void ck_near(double value, double exact, double tolerance, const char* what) {
    ck_assert_msg(std::abs(value - exact) <= tolerance, "%s: %.17g instead of %.17g, off by %.2e, allowed %.2e", what,
                  value, exact, std::abs(value - exact), tolerance);
}

// Symmetric, rows sum to zero, positive for everything that is not constant.
void ck_laplacian(const SparseMatrix& a) {
    double largest = 0.0;
    for (const double v : a.value) largest = std::max(largest, std::abs(v));
    const SparseMatrix t = transpose(a);
    ck_assert(t.column == a.column && t.value == a.value);
    for (const double row : product(a, Numbers(static_cast<std::size_t>(a.rows), 1.0)))
        ck_near(row, 0.0, 1e-13 * largest, "row sum");
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Numbers z(static_cast<std::size_t>(a.rows));
    for (int k = 0; k < 20; ++k) {
        for (double& v : z) v = unit(random);
        ck_assert(quadratic_form(a, z) > 0.0);
    }
}

Point rotated(const Point& x) {
    const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), e = std::sin(-1.1);
    const Point y{c * x[0] - s * x[2], x[1], s * x[0] + c * x[2]};
    return {d * y[0] - e * y[1] + 3.0, e * y[0] + d * y[1] - 2.0, y[2] + 5.0};
}
Point turned(const Point& x) { return {0.6 * x[0] - 0.8 * x[1] + 3.0, 0.8 * x[0] + 0.6 * x[1], 0.0}; }

}  // namespace

// ---- operator -------------------------------------------------------------------------------------------------------

TEST(lines) {
    for (const CellType type : plane_types) {
        const double length = 1.5;
        const Mesh mesh = two_layers(type, {length}, {3});
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return 2.0 - 3.0 * x[0]; })), 9.0 * length,
                1e-13 * 9.0, "linear");
        if (quadratic(type))
            ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return x[0] * x[0]; })),
                    4.0 * std::pow(length, 3) / 3.0, 1e-13, "quadratic");
        // Element matrices 1/h [1 -1; -1 1] and 1/(3h) [7 1 -8; 1 7 -8; -8 -8 16] (ends, middle), h = 0.5, pairs along
        // x.
        const Numbers row = product(a, [&] {
            Numbers e(ones(mesh).size(), 0.0);
            e[0] = 1.0;
            return e;
        }());
        const Numbers exact = quadratic(type) ? Numbers{14.0 / 3.0, -16.0 / 3.0, 2.0 / 3.0} : Numbers{2.0, -2.0};
        for (std::size_t i = 0; i < row.size(); ++i)
            ck_near(row[i], i < exact.size() ? exact[i] : 0.0, 1e-13, "row of the first pair");
        // A rotated line gives the same.
        const SparseMatrix other = stiffness_of(two_layers(type, {length}, {3}, turned));
        ck_assert(other.column == a.column);
        for (std::size_t e = 0; e < a.value.size(); ++e) ck_near(other.value[e], a.value[e], 1e-12, "turned");
    }
}

TEST(faces) {
    for (const CellType type : solid_types) {
        const Mesh mesh = two_layers(type, {1.5, 0.8}, {3, 2});
        const double area = 1.2;
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        const auto linear = [](const Point& x) { return 1.0 + 2.0 * x[0] - 3.0 * x[1]; };
        ck_near(quadratic_form(a, field(mesh, linear)), 13.0 * area, 1e-12, "linear");
        // Patch test: inside, a linear field has no force.
        const Numbers force = product(a, field(mesh, linear)), x = field(mesh, [](const Point&p) { return p[0]; }),
                      across = field(mesh, [](const Point&p) { return p[1]; });
        for (std::size_t i = 0; i < force.size(); ++i)
            if (x[i] > 1e-9 && x[i] < 1.5 - 1e-9 && across[i] > 1e-9 && across[i] < 0.8 - 1e-9)
                ck_near(force[i], 0.0, 1e-12, "inside");
        if (quadratic(type))
            ck_near(quadratic_form(a, field(mesh, [](const Point& p) { return p[0] * p[1]; })),
                    1.5 * std::pow(0.8, 3) / 3.0 + 0.8 * std::pow(1.5, 3) / 3.0, 1e-12, "x y");
        // Rotated: the same. Sheared to the plane z = x/2 + y/3: the projection of the field's gradient onto that
        // plane.
        const auto wave = [](double u, double v) { return std::sin(2.0 * u) * std::exp(v); };
        const Mesh turned_mesh = two_layers(type, {1.5, 0.8}, {3, 2}, rotated);
        const auto original = [&](const Point& p) {  // by its distances, whatever the order of the pairs
            const auto node =
                std::find_if(interface_of(mesh).node_a.begin(), interface_of(mesh).node_a.end(), [&](std::int64_t n) {
                    const Point y = rotated({mesh.node(n)[0], mesh.node(n)[1], mesh.node(n)[2]});
                    return std::hypot(y[0] - p[0], y[1] - p[1], y[2] - p[2]) < 1e-9;
                });
            ck_assert(node != interface_of(mesh).node_a.end());
            return wave(mesh.node(*node)[0], mesh.node(*node)[1]);
        };
        const double straight = quadratic_form(a, field(mesh, [&](const Point& p) { return wave(p[0], p[1]); }));
        ck_near(quadratic_form(stiffness_of(turned_mesh), field(turned_mesh, original)), straight, 1e-12 * straight,
                "rotated");
        const Mesh tilted = two_layers(type, {1.5, 0.8}, {3, 2}, [](const Point& p) {
            return Point{p[0], p[1], p[2] + p[0] / 2.0 + p[1] / 3.0};
        });
        const Point c{2.0, -1.0, 0.5}, normal{-0.5, -1.0 / 3.0, 1.0};
        const double n2 = 0.25 + 1.0 / 9.0 + 1.0, along = c[0] * normal[0] + c[1] * normal[1] + c[2] * normal[2];
        ck_near(quadratic_form(stiffness_of(tilted),
                               field(tilted, [&](const Point& p) { return c[0] * p[0] + c[1] * p[1] + c[2] * p[2]; })),
                (5.25 - along * along / n2) * area * std::sqrt(n2), 1e-12, "tilted");
        // Cells moved within their plane.
        const Mesh distorted = two_layers(type, {1.5, 0.8}, {3, 2}, [](const Point& p) {
            return Point{p[0] + 0.15 * p[1] * p[0] * (1.5 - p[0]), p[1] + 0.2 * p[0] * p[1] * (0.8 - p[1]), p[2]};
        });
        const double size =
            quadratic_form(stiffness_of(distorted), field(distorted, [](const Point& p) { return p[0]; }));
        ck_near(size, area, type == CellType::tet10 || type == CellType::hex20 ? 2e-3 : 1e-12, "distorted: area");
    }
}

// Lengths and kappa scaled by powers of two: the same digits.
TEST(units_of_the_operator) {
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8, CellType::tet10, CellType::hex20}) {
        const bool plane = topology(type).dimension == 2;
        const auto mesh = [&](double s) {
            return two_layers(type, plane ? Numbers{1.3} : Numbers{1.3, 0.9},
                              plane ? std::vector<std::int64_t>{5} : std::vector<std::int64_t>{3, 2},
                              [s](const Point& x) {
                                  return Point{s * x[0], s * x[1], s * x[2]};
                              });
        };
        const SparseMatrix a = stiffness_of(mesh(1.0)), b = stiffness_of(mesh(1024.0)), c = stiffness_of(mesh(1e3));
        for (std::size_t e = 0; e < a.value.size(); ++e) {
            ck_assert(b.value[e] * (plane ? 1024.0 : 1.0) == a.value[e]);
            ck_near(c.value[e] * (plane ? 1e3 : 1.0), a.value[e], 1e-11, "mm");
        }
    }
}

// A quarter of a circle and of a cylinder of radius 2, zeta = sin(phi): int cos^2(phi)/R^2 dA = pi/4 (times width) / R.
TEST(curved_faces) {
    constexpr double radius = 2.0;
    for (const CellType type :
         {CellType::quad8, CellType::tri6, CellType::hex20, CellType::tet10, CellType::quad4, CellType::hex8}) {
        const bool plane = topology(type).dimension == 2;
        const double exact = std::numbers::pi / 4.0 / radius * (plane ? 1.0 : 0.8);
        double error[3];
        for (int level = 0; level < 3; ++level) {
            const std::int64_t n = 4 << level;
            const Mesh mesh =
                two_layers(type, plane ? Numbers{1.0} : Numbers{1.0, 0.8},
                           plane ? std::vector<std::int64_t>{n} : std::vector<std::int64_t>{n, 2}, [&](const Point& x) {
                               const double phi = 0.5 * std::numbers::pi * x[0], r = radius + 0.5 - x[plane ? 1 : 2];
                               return plane ? Point{r * std::cos(phi), r * std::sin(phi), 0.0}
                                            : Point{r * std::cos(phi), x[1], r * std::sin(phi)};
                           });
            error[level] =
                std::abs(quadratic_form(stiffness_of(mesh),
                                        field(mesh, [&](const Point& x) { return x[plane ? 1 : 2] / radius; })) -
                         exact);
        }
        const double order = std::log2(error[1] / error[2]);
        std::printf("curved, type %d: errors %.1e %.1e %.1e, order %.2f\n", static_cast<int>(type), error[0], error[1],
                    error[2], order);
        ck_assert(order > (quadratic(type) ? 3.5 : 1.9));
    }
}

// Bricks and tetrahedra side by side: triangles among quadrilaterals repeat corners.
TEST(mixed_faces) {
    for (const bool second : {false, true}) {
        const Mesh bricks = two_layers(second ? CellType::hex20 : CellType::hex8, {1.0, 1.0}, {1, 1});
        const Mesh tetrahedra = two_layers(second ? CellType::tet10 : CellType::tet4, {1.0, 1.0}, {1, 1});
        Numbers nodes(bricks.nodes().begin(), bricks.nodes().end());
        for (std::size_t i = 0; i < tetrahedra.nodes().size(); ++i)
            nodes.push_back(tetrahedra.nodes()[i] + (i % 3 == 0 ? 5.0 : 0.0));
        Mesh mesh(3, nodes);
        for (std::int64_t c = 0; c < bricks.cell_count(); ++c)
            mesh.add_cells(bricks.cell_type(c), bricks.cell(c), std::vector<std::int32_t>{bricks.cell_body(c)});
        for (std::int64_t c = 0; c < tetrahedra.cell_count(); ++c) {
            std::vector<std::int64_t> cell(tetrahedra.cell(c).begin(), tetrahedra.cell(c).end());
            for (std::int64_t& n : cell) n += bricks.node_count();
            mesh.add_cells(tetrahedra.cell_type(c), cell, std::vector<std::int32_t>{tetrahedra.cell_body(c)});
        }
        add_interface(mesh, 0, 1, 0.0);
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return 2.0 * x[0] + x[1]; })), 10.0, 1e-12,
                "mixed, linear");
        const std::int64_t separate = stiffness_of(bricks).entries() + stiffness_of(tetrahedra).entries();
        ck_assert_int_eq(a.entries(), separate);
    }
}

TEST(notches_are_left_out) {
    const Mesh mesh = two_layers(CellType::quad4, {1.0}, {10});
    Numbers adhesion = ones(mesh);
    adhesion[0] = adhesion[1] = adhesion[2] = 0.0;
    adhesion[7] = 0.3;  // low initial adhesion is not a notch
    const GradientTerm term(3.0, surface_stiffness(mesh, interface_of(mesh), adhesion), interface_of(mesh).weight, 0);
    ck_assert_int_eq(term.coupled_pairs(), 8);
    for (std::size_t i = 0; i < 11; ++i) ck_assert(term.coupled(i) == (i >= 3));
    ck_near(term.diagonal(3), 3.0 * 10.0, 1e-12, "the tip has one face");
    ck_near(term.diagonal(7), 3.0 * 20.0, 1e-12, "inside");
    Numbers z(11, 1.0);
    z[0] = z[1] = z[2] = 0.0;
    ck_assert(term.energy(z) == 0.0);
}

// ---- damage step ----------------------------------------------------------------------------------------------------

namespace {

// A damage step on an interface of a mesh, with independent code for its energy and gradient.
struct Step {
    GradientTerm term;
    std::vector<Toughness> toughness;
    Numbers driving, old, least;

    Step(const Mesh& mesh, double kappa, const Toughness& t)
        : term(kappa, stiffness_of(mesh), interface_of(mesh).weight, 0),
          toughness(term.pairs(), t),
          driving(term.pairs(), 0.0),
          old(term.pairs(), 1.0),
          least(term.pairs(), 0.0) {}

    std::size_t size() const { return old.size(); }
    Numbers pointwise() const {
        Numbers z;
        for (std::size_t i = 0; i < size(); ++i)
            z.push_back(std::max(least[i], Law{}.minimiser(toughness[i], driving[i], old[i])));
        return z;
    }
    CoupledDamage solve() const {
        return coupled_damage(term, Law{}, toughness, driving, least, old, pointwise(), old);
    }
    double energy(const Numbers& z) const {
        double sum = term.energy(z);
        for (std::size_t i = 0; i < size(); ++i)
            sum += term.weight()[i] * (z[i] * driving[i] + Law{}.dissipated(toughness[i], z[i]));
        return sum;
    }
    Numbers gradient(const Numbers& z) const {
        Numbers d = term.force(z);
        for (std::size_t i = 0; i < size(); ++i)
            d[i] += term.weight()[i] * (driving[i] - Law{}.driving(toughness[i], z[i]));
        return d;
    }
    // The larger of its terms: the scale for the gradient of a pair.
    Numbers size_of_gradient(const Numbers& z) const {
        Numbers s = term.force(z);
        for (std::size_t i = 0; i < size(); ++i)
            s[i] = std::max(
                {std::abs(s[i]), term.weight()[i] * driving[i], term.weight()[i] * Law{}.driving(toughness[i], z[i])});
        return s;
    }
    void ck_optimal(const Numbers& z, double tolerance, const std::string& where) const {
        const Numbers d = gradient(z), s = size_of_gradient(z);
        for (std::size_t i = 0; i < size(); ++i) {
            ck_assert_msg(z[i] >= least[i] && z[i] <= old[i], "%s: pair %zu at %.17g of %g to %g", where.c_str(), i,
                          z[i], least[i], old[i]);
            const double down = z[i] < old[i] ? std::max(0.0, -d[i]) : 0.0,
                         up = z[i] > least[i] ? std::max(0.0, d[i]) : 0.0;
            // The remaining gradient, also measured by how far the pair's own curvature lets it move.
            const double stiff = term.diagonal(i) - term.weight()[i] * Law{}.driving_slope(toughness[i], z[i]);
            const double move = std::min(std::max(down, up) / stiff, down > 0.0 ? old[i] - z[i] : z[i] - least[i]);
            ck_assert_msg(std::max(down, up) <= tolerance * s[i] || move <= tolerance,
                          "%s: pair %zu of %zu, z = %.6g of %g, gradient %.3e of %.3e, move %.2e", where.c_str(), i,
                          size(), z[i], old[i], d[i], s[i], move);
        }
    }
};

// Energy of many random loads and bounds.
void randomise(Step& s, std::mt19937& random, bool notched) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double wave = 1.0 + 5.0 * unit(random), phase = 6.0 * unit(random);
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(s.size());
        s.driving[i] = s.toughness[i].total * std::exp(4.0 * std::sin(wave * t + phase) + 2.0 * (unit(random) - 0.5));
        if (unit(random) < 0.1) s.driving[i] = 0.0;
        s.old[i] = unit(random) < 0.5 ? 1.0 : unit(random);
        if (notched && unit(random) < 0.15) s.old[i] = 0.0;
    }
}

}  // namespace

// Three pairs: no point of a grid over the whole box has less energy, and the best grid point lies beside the solution.
TEST(three_pairs_by_exhaustion) {
    const Mesh mesh = two_layers(CellType::quad4, {2.0}, {2});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int n = 36;  // the bounds below follow the spacing
    for (int k = 0; k < 60; ++k) {
        Step s(mesh, std::exp(8.0 * (unit(random) - 0.5)), {1.0, k % 3 == 0 ? 1.0 : 1.0 + 3.0 * unit(random)});
        for (std::size_t i = 0; i < 3; ++i) {
            s.driving[i] = s.toughness[i].total * std::exp(3.0 * (unit(random) - 0.5));
            s.old[i] = unit(random) < 0.6 ? 1.0 : unit(random);
        }
        if (k % 2 == 1)  // and a lower bound
            for (std::size_t i = 0; i < 3; ++i) s.least[i] = 0.9 * s.old[i] * unit(random);
        const auto place = [&s](std::size_t i, int a) { return s.least[i] + (s.old[i] - s.least[i]) * a / n; };
        const CoupledDamage found = s.solve();
        ck_assert(found.converged);
        const double least = s.energy(found.adhesion);
        double grid = 1e300;
        for (int a = 0; a <= n; ++a)
            for (int b = 0; b <= n; ++b)
                for (int c = 0; c <= n; ++c) grid = std::min(grid, s.energy({place(0, a), place(1, b), place(2, c)}));
        ck_assert_msg(least <= grid + 1e-12, "case %d: %.17g, grid %.17g", k, least, grid);
        // Second derivatives are below 2 Gc^2 + 4 kappa here.
        const double curved = 2.0 * s.toughness[0].total * s.toughness[0].total + 4.0 * s.term.kappa();
        ck_assert_msg(grid - least <= 6.0 * curved / (n * n),
                      "case %d: grid %.3e above, more than its spacing explains", k, grid - least);
    }
}

// Optimality on all kinds of faces, for laws from Griffith's to Gc/Go = 1e8 and kappa over twelve decades.
LOOP_TEST(random_steps_are_optimal, 0, 6) {
    const CellType type[] = {CellType::quad4, CellType::quad8, CellType::hex8,
                             CellType::tet4,  CellType::tet10, CellType::hex20};
    const bool plane = loop < 2;
    const Mesh mesh = two_layers(type[loop], plane ? Numbers{1.0} : Numbers{1.0, 1.0},
                                 plane ? std::vector<std::int64_t>{60} : std::vector<std::int64_t>{8, 7});
    std::mt19937 random(static_cast<unsigned>(5 + loop));
    std::int64_t worst = 0, total = 0, count = 0;
    for (const double ratio : {1.0, 1.0 + 1e-9, 1.0 + 1e-3, 2.5, 1e3, 1e8})
        for (int decade = -10; decade <= 2; ++decade)
            for (int k = 0; k < 4; ++k) {
                Step s(mesh, std::pow(10.0, decade), {1.0 / ratio, 1.0});
                randomise(s, random, k % 2 == 0);
                if (k >= 2)  // a part of a step: no pair may go further
                    for (std::size_t i = 0; i < s.size(); ++i)
                        s.least[i] = s.old[i] * std::uniform_real_distribution<double>(0.0, 1.0)(random);
                const CoupledDamage found = s.solve();
                const std::string where = "type " + std::to_string(loop) + ", Gc/Go " + std::to_string(ratio) +
                                          ", kappa 1e" + std::to_string(decade) + ", case " + std::to_string(k) + ", " +
                                          std::to_string(found.iterations) + " iterations, residual " +
                                          std::to_string(found.residual);
                ck_assert_msg(found.converged, "%s", where.c_str());
                s.ck_optimal(found.adhesion, 1e-7, where);
                worst = std::max(worst, found.iterations);
                total += found.iterations;
                ++count;
            }
    std::printf("random steps, kind %d: %.1f factorisations, at most %lld\n", loop,
                static_cast<double>(total) / static_cast<double>(count), static_cast<long long>(worst));
}

// Plain projected gradients, thousands of them, end in the same point.
TEST(projected_gradients) {
    const Mesh mesh = two_layers(CellType::quad8, {1.0}, {6});
    std::mt19937 random(23);
    for (int k = 0; k < 40; ++k) {
        Step s(mesh, k % 2 == 0 ? 0.02 : 1.0, {1.0, 1.0 + 0.1 * (k % 8)});
        randomise(s, random, true);
        double stiff = 0.0;  // of F in the metric of the weights, an upper bound
        for (std::size_t i = 0; i < s.size(); ++i)
            stiff = std::max(stiff, 3.0 * s.term.diagonal(i) / s.term.weight()[i] +
                                        2.0 * s.toughness[i].total * s.toughness[i].total);
        Numbers z = s.old, before = z;
        double momentum = 1.0, moved = 1.0;
        for (int step = 0; step < 200000 && moved > 1e-15;
             ++step) {  // with momentum (Nesterov; Beck and Teboulle, 2009), restarted
            const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
            Numbers ahead = z;
            for (std::size_t i = 0; i < z.size(); ++i)
                ahead[i] = std::clamp(z[i] + (momentum - 1.0) / next * (z[i] - before[i]), 0.0, s.old[i]);
            const Numbers d = s.gradient(ahead);
            before = z;
            double turn = 0.0;
            moved = 0.0;
            for (std::size_t i = 0; i < z.size(); ++i) {
                z[i] = std::clamp(ahead[i] - d[i] / (s.term.weight()[i] * stiff), 0.0, s.old[i]);
                turn += d[i] * (z[i] - before[i]);
                moved = std::max(moved, std::abs(z[i] - before[i]));
            }
            momentum = turn > 0.0 ? 1.0 : next;
        }
        const Numbers found = s.solve().adhesion;
        for (std::size_t i = 0; i < z.size(); ++i) ck_near(found[i], z[i], 1e-10, "adhesion");
    }
}

// Where the pointwise adhesion is smooth and inside the bounds, it changes by kappa times a fixed amount.
TEST(small_kappa_recovers_the_pointwise_law) {
    for (const double ratio : {2.5, 1e4}) {
        const Mesh mesh = two_layers(CellType::quad4, {1.0}, {40});
        Numbers moved;
        for (const double kappa : {1e-4, 1e-5, 1e-6}) {
            Step s(mesh, kappa / ratio, {1.0 / ratio, 1.0});
            for (std::size_t i = 0; i < s.size(); ++i) {
                const double z = 0.5 + 0.3 * std::cos(std::numbers::pi * static_cast<double>(i) / 40.0);
                s.driving[i] = Law{}.driving(s.toughness[i], z);
            }
            const Numbers with = s.solve().adhesion, without = s.pointwise();
            moved.push_back(0.0);
            for (std::size_t i = 0; i < with.size(); ++i)
                moved.back() = std::max(moved.back(), std::abs(with[i] - without[i]));
        }
        std::printf("Gc/Go %g: kappa moves the adhesion by %.2e, %.2e, %.2e\n", ratio, moved[0], moved[1], moved[2]);
        ck_assert(std::abs(std::log10(moved[1] / moved[2]) - 1.0) < 0.02);
    }
}

// Uniform adhesion: the minimiser of the sum over all pairs, clipped by the lowest bound.
TEST(large_kappa_is_uniform) {
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8, CellType::tet10}) {
        const bool plane = topology(type).dimension == 2;
        const Mesh mesh = two_layers(type, plane ? Numbers{1.0} : Numbers{1.0, 1.0},
                                     plane ? std::vector<std::int64_t>{30} : std::vector<std::int64_t>{5, 4});
        std::mt19937 random(31);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (const double ratio : {1.0, 2.5, 1e6}) {
            Step s(mesh, 1e6 / ratio,
                   {1.0 / ratio, 1.0});  // a million times what the law's curvature, about Go, stands against
            double mean = 0.0, size = 0.0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                s.driving[i] = (ratio == 1.0 ? 0.5 : 1.5 * s.toughness[i].onset) * (0.5 + unit(random));
                mean += s.term.weight()[i] * s.driving[i];
                size += s.term.weight()[i];
            }
            for (double& o : s.old) o = 0.9;
            const double uniform = Law{}.minimiser(s.toughness[0], mean / size, 0.9);
            const CoupledDamage found = s.solve();
            ck_assert(found.converged);
            for (const double z : found.adhesion) ck_near(z, uniform, 1e-6, "uniform adhesion");
        }
    }
}

// With a Griffith law the damage step is an obstacle problem. Y = G + p on the left half, G - q on the right: kappa
// zeta'' = p or -q between the contact with 0 and that with 1, so two parabolas that meet with the slope s = sqrt(2 /
// (kappa (1/p + 1/q))).
TEST(griffith_profile) {
    const double length = 3.0, kappa = 0.05, p = 0.4, q = 0.9, g = 1.0;
    const double slope = std::sqrt(2.0 / (kappa * (1.0 / p + 1.0 / q))), left = kappa * slope / p,
                 right = kappa * slope / q;
    ck_assert(left < 0.5 * length && right < 0.5 * length);
    const auto exact = [&](double x) {
        const double t = x - 0.5 * length;
        if (t <= -left) return 0.0;
        if (t >= right) return 1.0;
        return t <= 0.0 ? 0.5 * p / kappa * (t + left) * (t + left) : 1.0 - 0.5 * q / kappa * (right - t) * (right - t);
    };
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8}) {
        Numbers error;
        for (const std::int64_t n : {15, 45, 135, 405}) {  // odd: the load changes midway between two pairs
            if (type == CellType::hex8 && n > 135) continue;
            const Mesh mesh =
                two_layers(type, type == CellType::hex8 ? Numbers{length, 0.3} : Numbers{length},
                           type == CellType::hex8 ? std::vector<std::int64_t>{n, 2} : std::vector<std::int64_t>{n});
            Step s(mesh, kappa, {g, g});
            const Numbers x = field(mesh, [](const Point& at) { return at[0]; });
            // On 3-node edges the middle pair of the middle edge lies on the change: half of each value.
            for (std::size_t i = 0; i < x.size(); ++i)
                s.driving[i] = std::abs(x[i] - 0.5 * length) < 1e-9 ? g + 0.5 * (p - q)
                               : x[i] < 0.5 * length                ? g + p
                                                                    : g - q;
            const CoupledDamage found = s.solve();
            ck_assert(found.converged);
            error.push_back(0.0);
            for (std::size_t i = 0; i < x.size(); ++i)
                error.back() = std::max(error.back(), std::abs(found.adhesion[i] - exact(x[i])));
            std::printf("obstacle, type %d, %lld cells: error %.2e, %lld factorisations\n", static_cast<int>(type),
                        static_cast<long long>(n), error.back(), static_cast<long long>(found.iterations));
            ck_assert_int_le(found.iterations, 20);
        }
        const double order = std::log(error[0] / error.back()) / std::log(3.0) / static_cast<double>(error.size() - 1);
        std::printf("obstacle, type %d: order %.2f\n", static_cast<int>(type), order);
        ck_assert(order > 1.8);
    }
}

// Energies in other units: the same digits, or differences that rounding leaves.
TEST(units_of_the_step) {
    const Mesh mesh = two_layers(CellType::quad8, {1.0}, {20});
    for (const double ratio : {1.0, 2.5, 1e8}) {
        Numbers base;
        for (const double unit : {1.0, 4096.0, 1.0 / 1048576.0, 1e3}) {
            std::mt19937 random(41);
            Step s(mesh, 1e-3, {1.0 / ratio, 1.0});
            randomise(s, random, true);
            Step scaled(mesh, 1e-3 * unit, {unit * (1.0 / ratio), unit});
            scaled.driving = s.driving;
            for (double& y : scaled.driving) y *= unit;
            scaled.old = s.old;
            const Numbers z = scaled.solve().adhesion;
            if (base.empty()) base = z;
            for (std::size_t i = 0; i < z.size(); ++i) {
                if (unit == 1e3)
                    ck_near(z[i], base[i], 1e-8, "other units");
                else
                    ck_assert(z[i] == base[i]);
            }
        }
    }
}

// The result does not depend on where the search starts, and a solved step is a fixed point.
TEST(any_start) {
    const Mesh mesh = two_layers(CellType::hex8, {1.0, 1.0}, {9, 9});
    std::mt19937 random(43);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double ratio : {1.0, 2.5, 1e4}) {
        Step s(mesh, 1e-2, {1.0 / ratio, 1.0});
        randomise(s, random, true);
        for (std::size_t i = 0; i < s.size(); i += 3) s.least[i] = 0.4 * s.old[i];
        const Numbers base = s.solve().adhesion;
        for (int k = 0; k < 10; ++k) {
            Numbers start = s.old;
            for (double& z : start) z *= k == 0 ? 0.0 : unit(random);
            const Numbers z =
                coupled_damage(s.term, Law{}, s.toughness, s.driving, s.least, s.old, s.pointwise(), start).adhesion;
            for (std::size_t i = 0; i < z.size(); ++i) ck_near(z[i], base[i], 1e-9, "start");
        }
        const CoupledDamage again =
            coupled_damage(s.term, Law{}, s.toughness, s.driving, s.least, s.old, s.pointwise(), base);
        ck_assert_int_le(again.iterations, 2);
        for (std::size_t i = 0; i < base.size(); ++i) ck_near(again.adhesion[i], base[i], 1e-12, "fixed point");
    }
}
