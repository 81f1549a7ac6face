// SPDX-License-Identifier: BSD-3-Clause
// Periodic cells: the stiffness of layered media in closed form (Backus 1962), with bonded and with elastic interfaces,
// under prescribed strain and prescribed stress, in both realisations; the tangent against differences of reactions;
// refused input.
#include <array>
#include <vector>

#include "controlled_scenes.hpp"
#include "support.hpp"

namespace {

using cases::Scene;
using reference::LawData;
using reference::Solver;

constexpr double lx = 0.03, ly = 0.02, lz = 0.01, share = 0.4;  // of the lower layer
constexpr double young[2] = {70e9, 5e9}, poisson[2] = {0.3, 0.4};
constexpr LawData soft{4e11, 2e11, 150.0, 200.0, 300.0, 500.0};
constexpr double extent[3] = {lx, ly, lz};

const char* names[3][3] = {{"xx", "xy", "xz"}, {"yx", "yy", "yz"}, {"zx", "zy", "zz"}};

double volume(int d) { return d == 2 ? lx * ly : lx * ly * lz; }

// Two layers across y; nodes 0 .. d-1 are the control nodes.
Scene layers(int d, bool alike, bool glued) {
    Scene scene = cases::make_blocks(
        d, {{{0.0, 0.0, 0.0}, {lx, share * ly, lz}, {3, 2, 2}}, {{0.0, share * ly, 0.0}, {lx, ly, lz}, {3, 3, 2}}},
        nullptr, d);
    scene.interface(0, 1);
    scene.begin();
    for (int b = 0; b < 2; ++b) scene.elastic(b, young[alike ? 0 : b], poisson[alike ? 0 : b]);
    if (glued)
        scene.bonded(0);
    else
        scene.law(0, soft);
    std::vector<double> periods(static_cast<std::size_t>(d * d), 0.0);
    std::vector<std::int64_t> controls;
    for (int k = 0; k < d; ++k) {
        periods[static_cast<std::size_t>(k * d + k)] = extent[k];
        controls.push_back(k);
    }
    scene.periodic(periods, controls);
    for (int k = 0; k < d; ++k) scene.hold({d}, cases::unit(d, k));  // the first node of the lower layer
    return scene;
}

// Stiffness of the layered medium among gradient components (i, k): sigma_ik = C sum over (j, l).
std::array<std::array<double, 9>, 9> closed_form(int d, bool alike, bool glued) {
    const double part[2] = {share, 1.0 - share};
    double m_inverse = 0.0, ratio = 0.0, plane = 0.0, off = 0.0, mu_inverse = 0.0, mu_mean = 0.0;
    for (int b = 0; b < 2; ++b) {
        const double e = young[alike ? 0 : b], nu = poisson[alike ? 0 : b];
        const double lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu)), m = lambda + 2 * mu;
        m_inverse += part[b] / m;
        ratio += part[b] * lambda / m;
        plane += part[b] * (m - lambda * lambda / m);
        off += part[b] * (lambda - lambda * lambda / m);
        mu_inverse += part[b] / mu;
        mu_mean += part[b] * mu;
    }
    if (!glued) {
        m_inverse += 1.0 / (soft.normal_stiffness * ly);
        mu_inverse += 1.0 / (soft.tangential_stiffness * ly);
    }
    std::array<std::array<double, 9>, 9> c{};
    const auto at = [](int i, int k) { return static_cast<std::size_t>(3 * i + k); };
    const double across = 1.0 / m_inverse;
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) {
            double value = 0.0;
            if (i == 1 && j == 1)
                value = across;
            else if (i == 1 || j == 1)
                value = ratio * across;
            else
                value = (i == j ? plane : off) + ratio * ratio * across;
            c[at(i, i)][at(j, j)] = value;
            if (i == j) continue;
            const double shear = i == 1 || j == 1 ? 1.0 / mu_inverse : mu_mean;
            c[at(i, j)][at(i, j)] = c[at(i, j)][at(j, i)] = shear;
        }
    return c;
}

void realise(Scene& scene, int which) {
    constexpr const char* ways[] = {"condensed", "feti", "iterated"};
    scene.text("reduction", ways[which]);
    if (which == 1) scene.number("subdomains", 4);
}

std::vector<double> tangent(const Solver& solver, std::size_t patterns) {
    std::vector<double> matrix(patterns * patterns);
    REQUIRE(solver.scene(), delam_solver_tangent, solver.get(), static_cast<std::int64_t>(matrix.size()),
            matrix.data());
    return matrix;
}

// loop: dimension, material, interface, realisation
LOOP_TEST(homogenised_stiffness, 0, 24) {
    const int d = loop % 2 == 0 ? 2 : 3;
    const bool alike = loop / 2 % 2 == 0, glued = loop / 4 % 2 == 0;
    Scene scene = layers(d, alike, glued);
    realise(scene, loop / 8);
    std::vector<std::array<int, 2>> component;
    for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) {
            const auto p =
                scene.pattern(names[i][k], {0.0, 1.0}, {0.0, 1e-6 * (1.0 + static_cast<double>(component.size()))});
            scene.drive({k}, cases::unit(d, i), p, {extent[k]});
            component.push_back({i, k});
        }
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const auto c = closed_form(d, alike, glued);
    const auto t = tangent(solver, component.size());
    const double size = volume(d) * c[0][0];
    for (std::size_t p = 0; p < component.size(); ++p) {
        double reaction = 0.0;
        for (std::size_t q = 0; q < component.size(); ++q) {
            const double exact = volume(d) * c[static_cast<std::size_t>(3 * component[p][0] + component[p][1])]
                                              [static_cast<std::size_t>(3 * component[q][0] + component[q][1])];
            cases::expect_near(
                t[p * component.size() + q], exact, 1e-9, size,
                std::string(names[component[p][0]][component[p][1]]) + ", " + names[component[q][0]][component[q][1]]);
            reaction += exact * 1e-6 * (1.0 + static_cast<double>(q));
        }
        cases::expect_near(solver.value(std::string("reaction:") + names[component[p][0]][component[p][1]]), reaction,
                           1e-9, size * 1e-6, "reaction");
    }
    // The average stress over the cell's volume equals that of the control nodes' forces.
    const auto stress = solver.field("stress");
    const std::size_t columns = d == 2 ? 4 : 6, per_layer = static_cast<std::size_t>(d == 2 ? 6 : 12),
                      cells = stress.size() / columns;
    double mean = 0.0;
    for (std::size_t e = 0; e < cells; ++e) {
        const double part = e < per_layer ? share / static_cast<double>(per_layer)
                                          : (1.0 - share) / static_cast<double>(cells - per_layer);
        mean += part * stress[e * columns + 1];
    }
    cases::expect_near(solver.value("reaction:yy") / volume(d), mean, 1e-9, size / volume(d) * 1e-6, "average stress");
}

// Tension along y by a dead force on control node 1, with sides free to contract; the cell's rotation is fixed at
// control nodes.
LOOP_TEST(prescribed_stress, 0, 6) {
    const int d = loop % 2 == 0 ? 2 : 3;
    Scene scene = layers(d, false, false);
    realise(scene, loop / 2);
    scene.hold({0}, cases::unit(d, 1));
    if (d == 3) {
        scene.hold({0}, cases::unit(d, 2));
        scene.hold({1}, cases::unit(d, 2));
    }
    const double s = 1e5;
    const auto load = scene.pattern("tension", {0.0, 1.0}, {0.0, 1.0});
    std::vector<double> force(static_cast<std::size_t>(d), 0.0);
    force[1] = s * volume(d) / ly;
    cases::forces(scene, load, {1}, force);
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const auto c = closed_form(d, false, false);
    // sigma_xx = 0 (= sigma_zz in space, and then eps_zz = eps_xx)
    const double c11 = c[0][0] + (d == 3 ? c[0][8] : 0.0), c12 = c[0][4], c22 = c[4][4];
    const double ratio = -c12 / c11, strain = s / (c22 + (d == 3 ? 2.0 : 1.0) * c12 * ratio);
    const auto u = solver.field("displacement");
    cases::expect_near(u[static_cast<std::size_t>(d + 1)], strain * ly, 1e-8, strain * ly, "elongation");
    cases::expect_near(u[0], ratio * strain * lx, 1e-8, strain * lx, "contraction");
    cases::expect_near(u[static_cast<std::size_t>(d)], 0.0, 1e-8, strain * lx, "shear");
    if (d == 3) cases::expect_near(u[8], ratio * strain * lz, 1e-8, strain * lz, "contraction across");
    cases::expect_near(solver.value("reaction:tension"), -force[1] * strain * ly, 1e-8, force[1] * strain * ly,
                       "conjugate");
    cases::expect_near(tangent(solver, 1).front(), -force[1] * strain * ly, 1e-8, force[1] * strain * ly, "compliance");
}

// Reactions follow the tangent as long as adhesion and contact do not change.
LOOP_TEST(tangent_of_a_damaged_cell, 0, 12) {
    const int d = loop % 2 == 0 ? 2 : 3;
    Scene scene = loop / 6 == 0 ? cases::make_periodic_plies(d, true) : cases::make_lever(d);
    realise(scene, loop / 2 % 3);
    Solver solver(scene, 0.0);
    std::vector<double> zeta = solver.field("adhesion");
    for (std::size_t p = 0; p < zeta.size(); ++p) zeta[p] = 0.1 + 0.8 * static_cast<double>(p % 5) / 4.0;
    const char* names_of[] = {loop / 6 == 0 ? "stress" : "lever", loop / 6 == 0 ? "lift" : "dead"};
    std::array<double, 2> factor[2], reaction[2];
    std::vector<double> contact[2], t;
    for (int k = 0; k < 2; ++k) {
        solver.equilibrate(k == 0 ? 0.5 : 0.501, zeta);
        for (std::size_t p = 0; p < 2; ++p) {
            factor[k][p] = solver.value(std::string("load:") + names_of[p]);
            reaction[k][p] = solver.value(std::string("reaction:") + names_of[p]);
        }
        contact[k] = solver.field("contact");
        t = tangent(solver, 2);
        solver.commit();
    }
    cases::expect(contact[0] == contact[1], "the contact set stays");
    for (std::size_t p = 0; p < 2; ++p) {
        const double change = reaction[1][p] - reaction[0][p];
        const double predicted =
            t[p * 2] * (factor[1][0] - factor[0][0]) + t[p * 2 + 1] * (factor[1][1] - factor[0][1]);
        cases::expect_near(change, predicted, 1e-6, std::abs(change), std::string("change of ") + names_of[p]);
    }
    cases::expect_near(t[1], t[2], 1e-7, std::abs(t[0]) + std::abs(t[1]) + std::abs(t[3]), "symmetry");
}

TEST(refused) {
    const auto status = [](Scene& scene, std::vector<double> periods, std::vector<std::int64_t> controls) {
        return delam_problem_add_periodic(scene.problem(), static_cast<std::int64_t>(controls.size()), periods.data(),
                                          controls.data(), 0.0, 0);
    };
    const auto says = [](Scene& scene, const char* words) {
        const std::string message = delam_context_message(scene.context());
        cases::expect(message.find(words) != std::string::npos, message + " does not say " + words);
    };
    Scene scene = cases::plies_with_controls(2, 2);
    cases::expect(status(scene, {0.04, 0.0, 0.08, 0.0}, {0, 1}) == DELAM_ERROR_ARGUMENT, "dependent periods");
    says(scene, "linearly dependent");
    cases::expect(status(scene, {0.05, 0.0}, {0}) == DELAM_ERROR_MESH, "another length");
    says(scene, "periods long in direction 0");
    cases::expect(status(scene, {0.04, 0.0}, {7}) == DELAM_ERROR_ARGUMENT, "a node of a body as control node");
    says(scene, "belongs to a body");
    // Missing partners: the right end is moved up by the map.
    Scene skew = cases::plies_with_controls(2, 1, [](const std::array<double, 3>& x) {
        return std::array<double, 3>{x[0], x[1] + (x[0] > 0.039 && x[1] > 0.004 ? 1e-3 : 0.0), x[2]};
    });
    cases::expect(status(skew, {0.04, 0.0}, {0}) == DELAM_ERROR_MESH, "no partner");
    says(skew, "no partner for node");
    // A free control node, and an equation implied by others.
    Scene loose = cases::plies_with_controls(2, 1);
    cases::clamp_left(loose);
    const auto load = loose.pattern("pull", {0.0, 1.0}, {0.0, 1.0});
    cases::forces(loose, load, {0}, {1.0, 0.0});
    cases::expect(delam_problem_check(loose.problem()) == DELAM_ERROR_PROBLEM,
                  "a loaded control node that nothing holds");
    says(loose, "control node 0 can translate");
    Scene twice = cases::plies_with_controls(2, 0);
    cases::clamp_left(twice);
    twice.equation({4, 5}, {1.0, 0.0, -1.0, 0.0});
    twice.equation({5, 6}, {1.0, 0.0, -1.0, 0.0});
    twice.equation({4, 6}, {1.0, 0.0, -1.0, 0.0});
    cases::expect(delam_problem_check(twice.problem()) == DELAM_ERROR_PROBLEM, "a dependent equation");
    says(twice, "follows from other constraints");
}

}  // namespace
