// SPDX-License-Identifier: BSD-3-Clause
// Volume averages, rotations, predicted process zones, and the related warnings.
#include <array>
#include <cmath>

#include "mmf.hpp"

#include "support.hpp"

using namespace cases;

namespace {

constexpr const char* realisations[] = {"condensed", "feti", "iterated"};

using Slope = double[3][3];
constexpr Slope slope = {{1e-3, 2e-3, -5e-4}, {3e-3, -2e-3, 1e-3}, {7e-4, 4e-4, 1.5e-3}};

// Two stacked blocks, bonded, all nodes driven to u = G x times time.
reference::Scene affine(int dimension, std::int32_t cell, const char* plane, const Slope& g = slope) {
    const bool space = dimension == 3;
    reference::Scene scene(dimension, space ? std::vector<double>{2.0, 1.0} : std::vector<double>{2.0},
                           space ? std::vector<std::int64_t>{2, 2} : std::vector<std::int64_t>{2}, {1.0, 0.5}, {1, 1},
                           cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, 10.0, 0.3);
    scene.elastic(1, 20.0, 0.2);
    if (!space) REQUIRE(scene, delam_problem_set_plane, scene.problem(), plane);
    scene.bonded(0);
    const auto pattern = scene.pattern("stretch", {0.0, 1.0}, {0.0, 1.0});
    const std::vector<std::int64_t> nodes =
        scene.find(0, std::vector<double>(static_cast<std::size_t>(dimension), -1.0),
                   std::vector<double>(static_cast<std::size_t>(dimension), 9.0));
    const std::vector<std::int64_t> upper =
        scene.find(1, std::vector<double>(static_cast<std::size_t>(dimension), -1.0),
                   std::vector<double>(static_cast<std::size_t>(dimension), 9.0));
    for (int i = 0; i < dimension; ++i) {
        std::vector<double> direction(static_cast<std::size_t>(dimension), 0.0);
        direction[static_cast<std::size_t>(i)] = 1.0;
        for (const auto* list : {&nodes, &upper})
            for (const std::int64_t node : *list) {
                if (list == &upper && std::abs(scene.coordinate(node, dimension - 1) - 1.0) < 1e-9)
                    continue;  // bonded to the ones below
                double u = 0.0;
                for (int j = 0; j < dimension; ++j) u += g[i][j] * scene.coordinate(node, j);
                scene.drive({node}, direction, pattern, {u});
            }
    }
    return scene;
}

std::int64_t scene_pattern(const reference::Scene& scene, const char* name) {
    const double times[] = {0.0, 1.0};
    std::int64_t pattern = 0;
    REQUIRE(scene, delam_problem_add_pattern, scene.problem(), name, 2, times, times, &pattern);
    return pattern;
}

}  // namespace

// Affine displacements: averages and rotations are those of the gradient, stresses those of Hooke's law, in each body
// and in all together. loop: scene, then realisation.
LOOP_TEST(affine_averages, 0, 18) {
    struct {
        int dimension;
        std::int32_t cell;
        const char* plane;
    } const of[] = {{2, DELAM_QUAD4, "plane-strain"},
                    {2, DELAM_QUAD8, "plane-stress"},
                    {2, DELAM_TRI6, "plane-stress"},
                    {3, DELAM_HEX8, ""},
                    {3, DELAM_TET10, ""},
                    {3, DELAM_HEX20, ""}};
    const auto& own = of[loop % 6];
    const int dim = own.dimension;
    reference::Scene scene = affine(dim, own.cell, own.plane);
    scene.text("reduction", realisations[loop / 6]);
    reference::Solver solver(scene, 0.0);
    solver.step(1.0);
    const auto& g = slope;
    std::array<double, 6> sum{};
    double all = 0.0;
    for (std::int32_t body = 0; body < 2; ++body) {
        const double young = body == 0 ? 10.0 : 20.0, nu = body == 0 ? 0.3 : 0.2, mu = young / (2 * (1 + nu)),
                     lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
        std::array<double, 6> exact{g[0][0], g[1][1], 0.0, g[0][1] + g[1][0], 0.0, 0.0};
        if (dim == 3) exact = {g[0][0], g[1][1], g[2][2], g[0][1] + g[1][0], g[1][2] + g[2][1], g[0][2] + g[2][0]};
        if (own.plane == std::string("plane-stress")) exact[2] = -nu / (1 - nu) * (g[0][0] + g[1][1]);
        std::array<double, 6> strain{}, stress{};
        double volume = 0.0;
        REQUIRE(scene, delam_solver_average, solver.get(), body, &volume, strain.data(), stress.data());
        expect_near(volume, body == 0 ? 2.0 : 1.0, 1e-12, 1.0, "volume");
        for (std::size_t i = 0; i < 6; ++i) {
            expect_near(strain[i], exact[i], 1e-12, 1.0, "strain");
            const double trace = exact[0] + exact[1] + exact[2];
            expect_near(stress[i], i < 3 ? lambda * trace + 2 * mu * exact[i] : mu * exact[i], 1e-11, 1.0, "stress");
            sum[i] += volume * stress[i];
        }
        all += volume;
    }
    std::array<double, 6> stress{};
    REQUIRE(scene, delam_solver_average, solver.get(), -1, nullptr, nullptr, stress.data());
    for (std::size_t i = 0; i < 6; ++i) expect_near(stress[i], sum[i] / all, 1e-12, 1.0, "stress of all bodies");
    expect(delam_solver_average(solver.get(), 7, nullptr, nullptr, nullptr) == DELAM_ERROR_ARGUMENT, "no such body");

    const double rotation[] = {0.5 * (g[2][1] - g[1][2]), 0.5 * (g[0][2] - g[2][0]), 0.5 * (g[1][0] - g[0][1])};
    const std::vector<double> field = solver.field("rotation");
    const std::size_t columns = dim == 2 ? 1 : 3;
    for (std::size_t i = 0; i < field.size(); ++i)
        expect_near(field[i], rotation[dim == 2 ? 2 : i % columns], 1e-12, 1.0, "rotation");
    expect_near(solver.value("rotation_max"),
                dim == 2 ? std::abs(rotation[2]) : std::hypot(rotation[0], rotation[1], rotation[2]), 1e-12, 1.0,
                "rotation_max");
}

// All nodes are moved by R (I + E): strains and stresses are those of E, turned by R, up to squares of E, by which the
// frames of cells differ from R. loop: plane strain, plane stress, space.
LOOP_TEST(turned_averages, 0, 3) {
    const int dim = loop == 2 ? 3 : 2;
    const double c = std::cos(0.7), s = std::sin(0.7);
    const Slope turn = {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}};
    Slope small = {{1e-3, 2e-3, 0.0}, {2e-3, -3e-3, 0.0}, {0.0, 0.0, 0.0}};
    if (dim == 3) small[0][2] = small[2][0] = -1e-3, small[1][2] = small[2][1] = 5e-4, small[2][2] = 2e-3;
    const double in_plane = small[0][0] + small[1][1];
    if (loop == 1) small[2][2] = -0.3 / 0.7 * in_plane;
    Slope g = {};
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) {
            g[i][j] = turn[i][j] - (i == j ? 1.0 : 0.0);
            for (int k = 0; k < dim; ++k) g[i][j] += turn[i][k] * small[k][j];
        }
    constexpr std::int32_t cell[] = {DELAM_QUAD4, DELAM_QUAD8, DELAM_HEX8};
    reference::Scene scene = affine(dim, cell[loop], loop == 0 ? "plane-strain" : loop == 1 ? "plane-stress" : "", g);
    scene.text("kinematics", "corotational");
    reference::Solver solver(scene, 0.0);
    solver.step(1.0);
    const double mu = 10.0 / 2.6, lambda = 10.0 * 0.3 / (1.3 * 0.4);
    const double trace = small[0][0] + small[1][1] + small[2][2];
    std::array<double, 6> strain{}, stress{};
    REQUIRE(scene, delam_solver_average, solver.get(), 0, nullptr, strain.data(), stress.data());
    constexpr std::size_t row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
    for (std::size_t i = 0; i < 6; ++i) {
        double exact = i < 3 ? lambda * trace : 0.0, of_strain = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l) of_strain += turn[row[i]][k] * small[k][l] * turn[column[i]][l];
        exact += 2.0 * mu * of_strain;
        expect_near(strain[i], (i < 3 ? 1.0 : 2.0) * of_strain, 1e-5, 1.0, "strain");
        expect_near(stress[i], exact, 1e-4, 1.0, "stress");
    }
}

// A prescribed strain in a fixed body: the strain stays that of the displacements, the stress lacks C e*; the same out
// of the plane. loop: scene, then realisation.
LOOP_TEST(eigenstrains, 0, 9) {
    const bool stress = loop % 3 == 1;
    const int dim = loop % 3 == 2 ? 3 : 2;
    reference::Scene scene = affine(dim, dim == 3 ? DELAM_HEX8 : DELAM_QUAD4, stress ? "plane-stress" : "plane-strain");
    const double warm = 2e-3, strain[] = {warm, warm, warm, 0.0, 0.0, 0.0};
    const auto heat = scene_pattern(scene, "heat");
    REQUIRE(scene, delam_problem_add_eigenstrain, scene.problem(), heat, 0, strain);
    std::array<double, 6> with{}, without{}, cold{}, all{};
    scene.text("reduction", realisations[loop / 3]);
    reference::Solver solver(scene, 0.0);
    solver.step(1.0);
    REQUIRE(scene, delam_solver_average, solver.get(), 0, nullptr, all.data(), with.data());
    const reference::Scene plain =
        affine(dim, dim == 3 ? DELAM_HEX8 : DELAM_QUAD4, stress ? "plane-stress" : "plane-strain");
    reference::Solver other(plain, 0.0);
    other.step(1.0);
    REQUIRE(scene, delam_solver_average, other.get(), 0, nullptr, cold.data(), without.data());
    const double young = 10.0, nu = 0.3, bulk = stress ? young / (1 - nu) : young / (1 - 2 * nu);
    for (std::size_t i = 0; i < 6; ++i) {
        const bool zero = i > 2 || (stress && i == 2);
        expect_near(with[i], without[i] - (zero ? 0.0 : bulk * warm), 1e-11, 1.0, "stress with a prescribed strain");
        const double zz = stress && i == 2 ? warm * (1 + 2 * nu / (1 - nu)) : 0.0;
        expect_near(all[i], cold[i] + zz, 1e-12, 1.0, "strain with a prescribed strain");
    }
}

// Warns once: of a rotation of more than 0.1, and only when it is read; of a process zone that the mesh does not
// resolve, as predicted and as found; of a step outside its two-sided estimate.
LOOP_TEST(warnings, 0, 3) {
    const bool brittle = loop == 0;
    reference::Scene scene = make_mmf(1e-3, brittle ? mmf_brittle : mmf_ductile, "converged");
    if (loop == 2) scene.text("reduction", "iterated");
    const Warnings heard(scene);
    reference::Solver solver(scene, 0.0);
    const auto count = [&](const char* word) {
        return std::count_if(heard.lines.begin(), heard.lines.end(),
                             [&](const std::string& line) { return line.find(word) != std::string::npos; });
    };
    for (int k = 1; k <= 40; ++k) {
        expect(solver.advance(enf_end_time * k / 40) >= 0, "step");
        solver.commit();
    }
    expect(count("the process zone, about") == (brittle ? 1 : 0), "a warning of a zone that is predicted to be short");
    expect(count("pairs in its process zone") == (brittle ? 1 : 0),
           "a warning of an unresolved front where there is one, once");
    expect(count("two-sided estimate") == (brittle ? 1 : 0), "a warning of a step outside its estimate, once");
    expect(count("rad") == 0 && solver.value("field_recoveries") == 0.0, "rotations are not computed unasked");
    expect(solver.value("rotation_max") > 0.1 && solver.value("rotation_max") > 0.1, "large rotations");
    expect(count("rad") == 1, "a warning of rotations, once");
    double length = 0.0, spacing = 0.0;
    REQUIRE(scene, delam_problem_process_zone, scene.problem(), 0, &length, &spacing);
    const double modulus = 75e9 / 0.91,
                 thick = brittle ? modulus * 25.0 / (50e6 * 50e6) : modulus * 250.0 / (5e6 * 5e6);
    const double exact = brittle ? thick : std::pow(thick, 0.25) * std::pow(3e-3, 0.75);
    expect_near(length, exact, 1e-9, exact, "predicted process zone");
    expect_near(spacing, 1e-3, 0.01, 1e-3, "spacing of the pairs");
}
