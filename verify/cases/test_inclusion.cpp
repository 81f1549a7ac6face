// SPDX-License-Identifier: BSD-3-Clause
// One circular fibre: the exact fields of an inclusion that is bonded, held by springs, loose under tension (an open
// gap) or pressed against its matrix without friction; and the bulk modulus of a composite cylinder.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "api.hpp"
#include "inclusion.hpp"
#include "support.hpp"

namespace {

using cases::expect;
using cases::expect_below;
using cases::expect_near;
using reference::Inclusion;
using reference::Phase;
using reference::Scene;
using reference::Solver;

constexpr double radius = 5e-6, outer = 15e-6;
constexpr Phase fibre{74e9, 0.2}, matrix{3.5e9, 0.35};

// Quadrilaterals of four or eight nodes: a disc (a square inside four patches that become round) and a ring around it,
// n cells on a quarter of the circle. Nodes of the quadratic mesh lie on the circle.
struct FibreMesh {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;  // 0 fibre, 1 matrix
    std::int32_t cell = DELAM_QUAD4;
};

class Mesher {
public:
    Mesher(int n, bool quadratic) : step_(quadratic ? 2 : 1) {
        mesh_.cell = quadratic ? DELAM_QUAD8 : DELAM_QUAD4;
        constexpr double core = 0.5 * radius;
        patch(n, n, 0, [&](double s, double t) { return std::array{core * (2 * s - 1), core * (2 * t - 1)}; });
        for (int quarter = 0; quarter < 4; ++quarter) {
            // s outwards, t anticlockwise
            const auto ray = [quarter](double r, double t, double round) {
                const double angle = 0.25 * std::numbers::pi * (2 * t - 1);
                const double x = (1 - round) * core + round * r * std::cos(angle);
                const double y = (1 - round) * core * (2 * t - 1) + round * r * std::sin(angle);
                const double c = std::cos(0.5 * std::numbers::pi * quarter),
                             z = std::sin(0.5 * std::numbers::pi * quarter);
                return std::array{c * x - z * y, z * x + c * y};
            };
            patch(std::max(1, n / 2), n, 0, [&](double s, double t) { return ray(radius, t, s); });
            patch(n, n, 1, [&](double s, double t) { return ray(radius * std::pow(outer / radius, s), t, 1.0); });
        }
    }
    FibreMesh take() { return std::move(mesh_); }

private:
    // Nodes of one body at the same position are merged.
    std::int64_t node(int body, std::array<double, 2> p) {
        const std::array<std::int64_t, 3> key{body, std::llround(p[0] / radius * 1e7),
                                              std::llround(p[1] / radius * 1e7)};
        const auto at = std::lower_bound(known_.begin(), known_.end(), std::pair(key, std::int64_t{0}));
        if (at != known_.end() && at->first == key) return at->second;
        const auto index = static_cast<std::int64_t>(mesh_.nodes.size() / 2);
        mesh_.nodes.insert(mesh_.nodes.end(), p.begin(), p.end());
        known_.insert(at, {key, index});
        return index;
    }
    template <class Map>
    void patch(int across, int along, int body, Map&& map) {
        for (int i = 0; i < across; ++i)
            for (int j = 0; j < along; ++j) {
                const auto at = [&](double s, double t) { return node(body, map((i + s) / across, (j + t) / along)); };
                const std::int64_t corner[4] = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
                mesh_.cells.insert(mesh_.cells.end(), corner, corner + 4);
                if (step_ == 2) {
                    const std::int64_t middle[4] = {at(0.5, 0), at(1, 0.5), at(0.5, 1), at(0, 0.5)};
                    mesh_.cells.insert(mesh_.cells.end(), middle, middle + 4);
                }
                mesh_.bodies.push_back(body);
            }
    }

    int step_;
    FibreMesh mesh_;
    std::vector<std::pair<std::array<std::int64_t, 3>, std::int64_t>> known_;
};

enum class Bond { perfect, springs, none };

struct Loaded {
    Scene scene;
    std::vector<std::int64_t> rim;
};

constexpr double normal_stiffness = 2e15, tangential_stiffness = 5e14;

Scene make(int n, bool quadratic, Bond bond) {
    const FibreMesh mesh = Mesher(n, quadratic).take();
    Scene scene(2, mesh.nodes, mesh.cell, mesh.cells, mesh.bodies);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, fibre.young, fibre.poisson);
    scene.elastic(1, matrix.young, matrix.poisson);
    if (bond == Bond::perfect) {
        scene.bonded(0);
        return scene;
    }
    scene.law(0, {normal_stiffness, tangential_stiffness, 1e3, 1e3, 2e3, 2e3});  // far from its onset
    if (bond == Bond::none) {
        std::vector<std::int64_t> all;
        for (std::size_t p = 0; p < scene.pairs(0).count(); ++p) all.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(0, all, std::vector<double>(all.size(), 0.0));
    }
    return scene;
}

std::vector<std::int64_t> rim_nodes(const Scene& scene) {
    std::vector<std::int64_t> rim;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(scene.node_count()); ++i)
        if (std::hypot(scene.coordinate(i, 0), scene.coordinate(i, 1)) > outer * (1 - 1e-9)) rim.push_back(i);
    return rim;
}

// The rim moves as in the exact field.
void move_rim(Scene& scene, const Inclusion& exact) {
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
    const std::vector<std::int64_t> rim = rim_nodes(scene);
    std::vector<double> ux, uy;
    for (const std::int64_t i : rim) {
        const auto u = exact.displacement(false, scene.coordinate(i, 0), scene.coordinate(i, 1));
        ux.push_back(u[0]);
        uy.push_back(u[1]);
    }
    scene.drive(rim, {1.0, 0.0}, load, ux);
    scene.drive(rim, {0.0, 1.0}, load, uy);
}

// Relative L2-like errors at nodes and cells.
struct Errors {
    double displacement, stress, uniformity;
};

// A loose fibre may lie anywhere within its gap, so its displacements are not compared.
Errors errors(const Scene& scene, Solver& solver, const FibreMesh& mesh, const Inclusion& exact, bool with_fibre) {
    const std::vector<double> u = solver.field("displacement"), s = solver.field("stress");
    const std::size_t per_cell = mesh.cells.size() / mesh.bodies.size();
    double du = 0.0, size = 0.0, ds = 0.0, pull = 0.0, spread = 0.0;
    for (std::size_t c = 0; c < mesh.bodies.size(); ++c) {
        const bool inside = mesh.bodies[c] == 0;
        double x = 0.0, y = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto node = static_cast<std::size_t>(mesh.cells[c * per_cell + k]);
            x += 0.25 * scene.coordinate(static_cast<std::int64_t>(node), 0);
            y += 0.25 * scene.coordinate(static_cast<std::int64_t>(node), 1);
            if (inside && !with_fibre) continue;
            const auto e = exact.displacement(inside, scene.coordinate(static_cast<std::int64_t>(node), 0),
                                              scene.coordinate(static_cast<std::int64_t>(node), 1));
            for (std::size_t d = 0; d < 2; ++d) {
                du += (u[2 * node + d] - e[d]) * (u[2 * node + d] - e[d]);
                size += e[d] * e[d];
            }
        }
        const auto e = exact.stress(inside, x, y);
        const std::array<double, 3> mine{s[4 * c], s[4 * c + 1], s[4 * c + 3]};
        double off = 0.0;
        for (std::size_t d = 0; d < 3; ++d) {
            off += (mine[d] - e[d]) * (mine[d] - e[d]);
            pull += e[d] * e[d];
        }
        ds += off;
        if (inside) spread = std::max(spread, std::sqrt(off));
    }
    const auto middle = exact.stress(true, 0.0, 0.0);
    return {std::sqrt(du / size), std::sqrt(ds / pull), spread / std::max(std::hypot(middle[0], middle[1]), 1e6)};
}

struct Setting {
    const char* name;
    Bond bond;
    std::array<double, 2> remote;  // Pa
};
// Tension and pressure such that no part of the fibre's surface changes between open and closed.
constexpr std::array<Setting, 5> settings{{{"glued, uniaxial tension", Bond::perfect, {50e6, 0.0}},
                                           {"springs, tension", Bond::springs, {50e6, 25e6}},
                                           {"loose, tension", Bond::none, {50e6, 40e6}},
                                           {"loose, pressed", Bond::none, {-50e6, -40e6}},
                                           {"springs, pressed", Bond::springs, {-50e6, -40e6}}}};

Inclusion exact_field(const Setting& setting) {
    const bool pressed = setting.remote[0] < 0.0;
    const bool springs = setting.bond == Bond::springs;
    // Closed contact is rigid along the normal; faces that do not adhere slide.
    const double normal = springs && !pressed ? 1.0 / normal_stiffness : 0.0;
    const double tangential = springs                         ? 1.0 / tangential_stiffness
                              : setting.bond == Bond::perfect ? 0.0
                                                              : 1e6 * outer / matrix.young;
    return Inclusion(fibre, matrix, radius, setting.remote, normal, tangential, setting.bond == Bond::none && !pressed);
}

// Halving the cells lowers the errors by the orders of the elements: displacements 2 (linear) and more than 2.5
// (quadratic), stresses at the centres of cells 1.5 and 2.
LOOP_TEST(fields_converge_to_the_exact_inclusion, 0, 2 * static_cast<int>(settings.size())) {
    const Setting& setting = settings[static_cast<std::size_t>(loop) % settings.size()];
    const bool quadratic = static_cast<std::size_t>(loop) >= settings.size();
    if (quadratic && loop % 2 == 1 && !cases::whole()) return;
    const Inclusion exact = exact_field(setting);
    std::array<Errors, 3> found{};
    for (int level = 0; level < 3; ++level) {
        const int n = 4 << level;
        Scene scene = make(n, quadratic, setting.bond);
        move_rim(scene, exact);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        found[static_cast<std::size_t>(level)] =
            errors(scene, solver, Mesher(n, quadratic).take(), exact, setting.bond != Bond::none);
        expect_below(solver.value("dissipated"), 0.0, "damage far from the onset");
    }
    const std::string name = std::string(setting.name) + (quadratic ? ", quad8" : ", quad4");
    if (std::getenv("DELAM_TABLES") != nullptr)
        for (const Errors& e : found)
            std::printf("%-34s %.3e %.3e %.3e\n", name.c_str(), e.displacement, e.stress, e.uniformity);
    const auto order = [](double coarse, double fine) { return std::log2(coarse / fine); };
    expect(order(found[1].displacement, found[2].displacement) > (quadratic ? 2.5 : 1.8),
           name + ": order of the displacement");
    expect(order(found[1].stress, found[2].stress) > (quadratic ? 1.8 : 1.4), name + ": order of the stress");
    expect_below(found[2].displacement, quadratic ? 2e-4 : 5e-3, name + ": displacement");
    expect_below(found[2].stress, quadratic ? 2e-3 : 1e-2, name + ": stress");
    expect_below(found[2].uniformity, quadratic ? 1e-2 : 4e-2,
                 name + ": stress in the fibre, which is uniform or quadratic");
}

// The rim of a composite cylinder moves outwards uniformly: force over displacement is the bulk modulus, order 2 and 4.
LOOP_TEST(bulk_modulus_of_a_composite_cylinder, 0, 6) {
    if ((loop == 1 || loop == 5) && !cases::whole()) return;
    const bool quadratic = loop % 2 == 1;
    const Bond bond = loop / 2 == 0 ? Bond::perfect : loop / 2 == 1 ? Bond::springs : Bond::none;
    for (const double sign : {1.0, -1.0}) {
        // Contact is rigid: pressed springs and loose fibres act like bonded ones, because nothing slides.
        const bool rigid = bond == Bond::perfect || sign < 0.0;
        const double exact = reference::composite_cylinder_bulk(
            fibre, matrix, radius, outer, rigid ? 0.0 : 1.0 / normal_stiffness, bond == Bond::none && !rigid);
        std::array<double, 3> error{};
        for (int level = 0; level < 3; ++level) {
            Scene scene = make(4 << level, quadratic, bond);
            const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1e-3 * sign});
            const std::vector<std::int64_t> rim = rim_nodes(scene);
            std::vector<double> x, y;
            for (const std::int64_t i : rim) {
                x.push_back(scene.coordinate(i, 0));
                y.push_back(scene.coordinate(i, 1));
            }
            scene.drive(rim, {1.0, 0.0}, load, x);
            scene.drive(rim, {0.0, 1.0}, load, y);
            Solver solver(scene, 0.0);
            solver.step(1.0);
            // work conjugate = int sigma_rr b = 2 k e b * 2 pi b
            const double bulk = solver.value("reaction:load") / (1e-3 * sign * 4.0 * std::numbers::pi * outer * outer);
            error[static_cast<std::size_t>(level)] = std::abs(bulk - exact) / exact;
        }
        if (std::getenv("DELAM_TABLES") != nullptr)
            std::printf("bulk modulus, bond %d, sign %+.0f, %s: %.3e %.3e %.3e\n", static_cast<int>(bond), sign,
                        quadratic ? "quad8" : "quad4", error[0], error[1], error[2]);
        expect_below(error[2], quadratic ? 2e-5 : 3e-3, "bulk modulus");
        expect(std::log2(error[0] / error[1]) > (quadratic ? 3.0 : 1.8), "order of the bulk modulus");
    }
}

// The exact field is exact: equilibrium and Hooke's law by differences, the remote stress, the interface conditions.
TEST(the_reference_is_a_solution) {
    const Inclusion exact(fibre, matrix, radius, {50e6, -20e6}, 1.0 / normal_stiffness, 1.0 / tangential_stiffness);
    for (const bool inside : {true, false}) {
        const Phase phase = inside ? fibre : matrix;
        const double x = (inside ? 0.6 : 1.3) * radius, y = (inside ? -0.4 : 0.7) * radius, e = 1e-4 * radius;
        std::array<std::array<double, 2>, 2> gradient{};
        std::array<double, 2> force{};
        for (std::size_t j = 0; j < 2; ++j) {
            const double dx = j == 0 ? e : 0.0, dy = j == 1 ? e : 0.0;
            const auto up = exact.displacement(inside, x + dx, y + dy),
                       down = exact.displacement(inside, x - dx, y - dy);
            const auto more = exact.stress(inside, x + dx, y + dy), less = exact.stress(inside, x - dx, y - dy);
            for (std::size_t i = 0; i < 2; ++i) {
                gradient[i][j] = (up[i] - down[i]) / (2 * e);
                force[i] += (more[i == j ? i : 2] - less[i == j ? i : 2]) / (2 * e) * radius;
            }
        }
        const double mu = phase.shear(), lambda = phase.bulk() - mu, trace = gradient[0][0] + gradient[1][1];
        const auto s = exact.stress(inside, x, y);
        expect_near(s[0], lambda * trace + 2 * mu * gradient[0][0], 1e-6, 50e6, "sigma_xx");
        expect_near(s[1], lambda * trace + 2 * mu * gradient[1][1], 1e-6, 50e6, "sigma_yy");
        expect_near(s[2], mu * (gradient[0][1] + gradient[1][0]), 1e-6, 50e6, "sigma_xy");
        expect_near(std::hypot(force[0], force[1]), 0.0, 1e-6, 50e6, "equilibrium");
    }
    const auto far = exact.stress(false, 1e4 * radius, 2e4 * radius);
    expect_near(far[0], 50e6, 1e-6, 50e6, "remote sigma_xx");
    expect_near(far[1], -20e6, 1e-6, 50e6, "remote sigma_yy");
    const double t = 0.7, c = std::cos(t), z = std::sin(t);
    const auto s = exact.stress(true, radius * c, radius * z), o = exact.stress(false, radius * c, radius * z);
    const std::array<double, 2> pull{s[0] * c + s[2] * z, s[2] * c + s[1] * z},
        other{o[0] * c + o[2] * z, o[2] * c + o[1] * z};
    const auto u = exact.displacement(true, radius * c, radius * z),
               v = exact.displacement(false, radius * c, radius * z);
    for (std::size_t d = 0; d < 2; ++d) expect_near(pull[d], other[d], 1e-12, 50e6, "traction");
    const double normal = pull[0] * c + pull[1] * z, tangential = pull[1] * c - pull[0] * z;
    const double opening = (v[0] - u[0]) * c + (v[1] - u[1]) * z, sliding = (v[1] - u[1]) * c - (v[0] - u[0]) * z;
    expect_near(opening * normal_stiffness, normal, 1e-11, 50e6, "normal spring");
    expect_near(sliding * tangential_stiffness, tangential, 1e-11, 50e6, "tangential spring");
}

}  // namespace
