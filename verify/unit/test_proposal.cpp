// SPDX-License-Identifier: BSD-3-Clause
// Proposed stiffness and strengths: set in the law, they lead to what was asked for, in any units.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "scene/advice/process_zone.hpp"
#include "scene/advice/proposal.hpp"
#include "scene/problem.hpp"

using namespace delam;

namespace {

using Numbers = std::vector<double>;
using Indices = std::vector<std::int64_t>;

// Units of length and force, in which all numbers of a scene are given.
struct Units {
    double length = 1.0, force = 1.0;
    double stress() const { return force / (length * length); }
};

struct Scene {
    CellType type = CellType::quad4;
    Numbers thickness{3e-3, 1.5e-3};
    double toughness = 250.0;
    Units units;
};

Law bilinear(const Scene& scene, double normal_strength, double tangential_strength) {
    const Units& u = scene.units;
    Law law;
    law.normal_stiffness = 2e14 * u.stress() / u.length;
    law.tangential_stiffness = 7e13 * u.stress() / u.length;
    law.normal_onset = normal_strength * normal_strength / (2.0 * law.normal_stiffness);
    law.tangential_onset = tangential_strength * tangential_strength / (2.0 * law.tangential_stiffness);
    law.normal_toughness = scene.toughness * u.force / u.length;
    law.tangential_toughness = 3.0 * law.normal_toughness;
    return law;
}

Problem problem_of(const Scene& scene, const std::vector<Material>& materials) {
    const int dimension = topology(scene.type).dimension;
    const double l = scene.units.length;
    const Numbers lengths = dimension == 2 ? Numbers{0.08 * l} : Numbers{0.08 * l, 0.02 * l};
    const Indices divisions = dimension == 2 ? Indices{40} : Indices{40, 8};
    Numbers thickness = scene.thickness;
    for (double& t : thickness) t *= l;
    Mesh mesh = make_layers(dimension, lengths, divisions, thickness, Indices{1, 1}, scene.type);
    add_interface(mesh, 0, 1, 0.0);
    Problem problem(std::make_shared<const Mesh>(std::move(mesh)));
    for (std::size_t i = 0; i < 2; ++i) problem.material[i] = materials[i];
    problem.interfaces[0].law = bilinear(scene, 40e6 * scene.units.stress(), 60e6 * scene.units.stress());
    return problem;
}

Material isotropic(const Scene& scene, double young) { return Elastic{young * scene.units.stress(), 0.3}; }
Material ply(const Scene& scene) {
    const double s = scene.units.stress();
    return Orthotropic{{130e9 * s, 9e9 * s, 8e9 * s, 0.3, 0.28, 0.4, 5e9 * s, 4.5e9 * s, 3e9 * s}};
}

// One mode has the strength proposed, the other less, and so a longer zone.
TEST(strengths_lead_to_the_pairs) {
    for (const CellType type : {CellType::quad4, CellType::tri6, CellType::hex8, CellType::hex20})
        for (const double pairs : {1.0, 3.0, 7.5})
            for (const double toughness : {20.0, 250.0, 5e4}) {  // thick arms and slender ones
                const Scene scene{type, {3e-3, 1.5e-3}, toughness, {}};
                Problem problem = problem_of(scene, {isotropic(scene, 75e9), ply(scene)});
                const Proposal found = proposal(problem, 0, pairs);
                for (const std::size_t mode : {std::size_t{0}, std::size_t{1}}) {
                    Numbers strength(found.strength.begin(), found.strength.end());
                    strength[1 - mode] *= 0.7;
                    problem.interfaces[0].law = bilinear(scene, strength[0], strength[1]);
                    const ProcessZone zone = predicted_process_zone(problem, 0);
                    ck_assert_double_eq_tol(zone.length / zone.spacing, pairs, 1e-12 * pairs);
                }
            }
}

TEST(stiffness_is_that_of_the_layer) {
    for (const CellType type : {CellType::quad4, CellType::hex8}) {
        const Scene scene{type, {3e-3, 1.5e-3}, 250.0, {}};
        const Proposal thin = proposal(problem_of(scene, {isotropic(scene, 75e9), isotropic(scene, 75e9)}), 0, 3.0);
        ck_assert_double_eq_tol(thin.stiffness / (50.0 * 75e9 / 1.5e-3), 1.0, 1e-12);
        ck_assert_double_eq_tol(thin.share, 1.0 / (1.0 + 75e9 / 1.5e-3 / 2e14), 1e-12);
        const Proposal stiff = proposal(problem_of(scene, {isotropic(scene, 200e9), isotropic(scene, 75e9)}), 0, 3.0);
        ck_assert_double_eq_tol(stiff.stiffness / (50.0 * 200e9 / 3e-3), 1.0, 1e-12);
        // With the stiffness proposed, the share is 50/51.
        Problem problem = problem_of(scene, {isotropic(scene, 75e9), isotropic(scene, 75e9)});
        problem.interfaces[0].law->normal_stiffness = thin.stiffness;
        ck_assert_double_eq_tol(proposal(problem, 0, 3.0).share, 50.0 / 51.0, 1e-12);
    }
}

// The modulus along the normal of plies: axis 3 without axes in space, axis 2 in the plane; of turned ones that of a
// bar cut along the normal, from the inverse of the elasticity in space.
TEST(stiffness_of_plies) {
    const Scene space{CellType::hex8, {1e-3, 1e-3}, 250.0, {}}, plane{CellType::quad4, {1e-3, 1e-3}, 250.0, {}};
    ck_assert_double_eq_tol(proposal(problem_of(space, {ply(space), ply(space)}), 0, 3.0).stiffness / (50.0 * 8e12),
                            1.0, 1e-12);
    ck_assert_double_eq_tol(proposal(problem_of(plane, {ply(plane), ply(plane)}), 0, 3.0).stiffness / (50.0 * 9e12),
                            1.0, 1e-12);
    Problem turned = problem_of(space, {ply(space), ply(space)});
    std::mt19937 random(3);
    std::normal_distribution<double> gauss;
    for (int trial = 0; trial < 20; ++trial) {
        const std::array<double, 3> first{gauss(random), gauss(random), gauss(random)},
            second{gauss(random), gauss(random), gauss(random)};
        Axes axes{};
        ck_assert(orthonormal_axes(first, second, axes));
        Indices cells(static_cast<std::size_t>(turned.mesh->cell_count()));
        std::iota(cells.begin(), cells.end(), 0);
        turned.orientation = std::make_shared<Orientation>(
            oriented({}, turned.mesh->cell_count(), cells, std::vector<Axes>(cells.size(), axes)));
        // Strains of a unit stress zz: elasticity times them is that stress.
        const SpaceElasticity c = rotated(space_elasticity(ply(space)), axes);
        std::array<std::array<double, 7>, 6> rows{};
        for (std::size_t i = 0; i < 6; ++i) {
            std::copy_n(c.begin() + static_cast<std::ptrdiff_t>(6 * i), 6, rows[i].begin());
            rows[i][6] = i == 2 ? 1.0 : 0.0;
        }
        for (std::size_t k = 0; k < 6; ++k)
            for (std::size_t i = 0; i < 6; ++i) {
                if (i == k) continue;
                const double factor = rows[i][k] / rows[k][k];
                for (std::size_t j = k; j < 7; ++j) rows[i][j] -= factor * rows[k][j];
            }
        const double modulus = rows[2][2] / rows[2][6];
        ck_assert_double_eq_tol(proposal(turned, 0, 3.0).stiffness / (50.0 * modulus / 1e-3), 1.0, 1e-9);
    }
}

TEST(units_do_not_matter) {
    for (const CellType type : {CellType::quad4, CellType::hex8}) {
        const Scene si{type, {3e-3, 1.5e-3}, 250.0, {}}, other{type, {3e-3, 1.5e-3}, 250.0, {1e3, 1e-3}};
        const Proposal a = proposal(problem_of(si, {isotropic(si, 75e9), ply(si)}), 0, 3.0);
        const Proposal b = proposal(problem_of(other, {isotropic(other, 75e9), ply(other)}), 0, 3.0);
        const double stress = other.units.stress();
        ck_assert_double_eq_tol(b.stiffness / a.stiffness, stress / 1e3, 1e-12 * stress / 1e3);
        ck_assert_double_eq_tol(b.share, a.share, 1e-12);
        for (const std::size_t mode : {std::size_t{0}, std::size_t{1}})
            ck_assert_double_eq_tol(b.strength[mode] / a.strength[mode], stress, 1e-12 * stress);
    }
}

TEST(nothing_to_propose) {
    const Scene scene;
    Problem problem = problem_of(scene, {isotropic(scene, 75e9), isotropic(scene, 75e9)});
    problem.interfaces[0].law->softening = GriffithSoftening{};
    const Proposal griffith = proposal(problem, 0, 3.0);
    ck_assert(griffith.stiffness > 0.0 && griffith.strength[0] == 0.0 && griffith.strength[1] == 0.0);
    problem.interfaces[0].law.reset();
    problem.interfaces[0].bonded = true;
    const Proposal bonded = proposal(problem, 0, 3.0);
    ck_assert(bonded.stiffness == 0.0 && bonded.share == 0.0 && bonded.strength[0] == 0.0);
}

}  // namespace
