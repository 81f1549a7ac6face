// SPDX-License-Identifier: BSD-3-Clause
// Energies of a zone in which contact is left undecided: those with contact lie within the bounds that are stated.
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/contact/energy_zone_system.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "zone_motions.hpp"

using namespace delam;

namespace {

constexpr std::int64_t pairs = 12, dimension = 2, rows = pairs * dimension;
constexpr std::int64_t steps = 200;

struct Case {
    DenseEnergy energy;
    std::vector<JumpRow> row;
    std::vector<std::int64_t> jump_row;
    std::vector<Zone::Coupling> springs;
    std::vector<double> theta{1.0};
    ContactScene scene;
};

Case make_case(std::mt19937& random) {
    std::uniform_real_distribution<double> real(-1.0, 1.0);
    Case c;
    DenseMatrix g(rows, rows);
    for (double& v : g.value) v = real(random);
    c.energy.stiffness = multiply_transposed(g, g);
    c.energy.load = DenseMatrix(rows, 1);
    for (double& v : c.energy.load.value) v = real(random);
    for (std::int64_t r = 0; r < rows; ++r) {
        c.row.push_back({{{r, 1.0}}, {}});
        c.jump_row.push_back(r);
        if (r / dimension % 4 != 0) c.springs.push_back({r, r, 30.0 + 20.0 * real(random)});
    }
    c.scene.bonded.assign(index(pairs), 0);
    c.scene.level.assign(index(pairs), 0);
    return c;
}

struct Found {
    double energy;
    EnergyZoneSystem::ContactDoubt doubt;
    std::int64_t solves;
};

Found find(const Case& c, double allowed) {
    TestMotions motions(DenseMatrix(rows, 0));
    DenseZone zone(c.energy, c.row, c.jump_row, motions.of(c.energy));
    const std::vector<std::uint8_t> none(index(rows), 0);
    EnergyZoneSystem system(zone, c.scene, none, none, c.theta);
    system.load(c.springs, {});
    system.allow_doubt(allowed);
    std::vector<std::uint8_t> closed(index(pairs), 0);
    for (std::size_t p = 0; p < closed.size(); p += 3) closed[p] = 1;
    const ActiveSet set = find_active_set(system, system.contact_rows(), closed, steps);
    ck_assert(set.settled);
    double energy = zone.energy_of(c.theta, system.solution().unknowns);
    for (const Zone::Coupling& s : c.springs)
        energy += 0.5 * s.value * system.jump()[index(s.row)] * system.jump()[index(s.row)];
    return {energy, system.doubt(), set.solves};
}

}  // namespace

LOOP_TEST(energies_lie_within_the_bounds, 0, 8) {
    std::mt19937 random(static_cast<unsigned>(loop));
    std::int64_t undecided = 0, saved = 0;
    for (int k = 0; k < 50; ++k) {
        const Case c = make_case(random);
        const Found exact = find(c, 0.0);
        ck_assert(exact.doubt.above == 0.0 && exact.doubt.below == 0.0);
        for (const double allowed : {1e-4, 1e-3, 1e-2, 1e-1}) {
            const Found rough = find(c, allowed * std::abs(exact.energy));
            const double rounding = 1e-10 * std::abs(exact.energy);
            ck_assert(rough.doubt.above + rough.doubt.below <= allowed * std::abs(exact.energy));
            ck_assert(exact.energy <= rough.energy + rough.doubt.above + rounding);
            ck_assert(exact.energy >= rough.energy - rough.doubt.below - rounding);
            undecided += rough.doubt.above + rough.doubt.below > 0.0 ? 1 : 0;
            saved += exact.solves - rough.solves;
        }
    }
    ck_assert(undecided > 10);
    ck_assert(saved > 10);
}
