// SPDX-License-Identifier: BSD-3-Clause
// Iterations of the linear solves of whole analyses with the iterated operator, contact and Newton's method included,
// whatever the stiffness of the interfaces, the shape of the cells, and the number of interfaces.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "flexure.hpp"

using namespace delam;

namespace {

struct Count {
    std::int64_t solves = 0, iterations = 0, worst = 0;
};

struct Analysis {
    double stiffness = 1e13;  // N/m3
    double aspect = 5.0;      // length of a cell over its thickness
    std::size_t layers = 2;
    std::int64_t worst = 16;  // iterations allowed
};
constexpr double step_size = 0.25;
constexpr int most_steps = 240;  // cells that bend press less on stiff interfaces than those that lock
constexpr double stiffnesses[] = {1e9, 1e11, 1e13, 1e15, 1e17};
constexpr double aspects[] = {1.0, 10.0, 30.0};
constexpr std::size_t stacks[] = {3, 5, 9};

// A flexure in space, pressed until its cracks have grown in five steps. Solves that need no iteration,
// because the solution before is still right, are not counted.
Count analyse(const Analysis& m) {
    unit::Flexure f;
    f.dimension = 3;
    f.along = 24;
    f.across = 4;
    f.through = 2;
    f.layers = m.layers;
    f.length = 0.048;
    f.width = 0.008;
    f.notch = 0.016;
    f.thickness = 2.0 * 0.002 / m.aspect;
    f.law.normal_stiffness = f.law.tangential_stiffness = m.stiffness;
    // An onset at 450 MPa or, where that is softer, at 100 J/m2.
    f.law.normal_onset = f.law.tangential_onset = std::min(100.0, 450e6 * 450e6 / (2.0 * m.stiffness));
    // At time 1 the notch of an end-notched flexure with one crack in the middle would grow, by beam theory.
    const double half = 0.5 * f.thickness * static_cast<double>(f.layers);
    const double span = 0.5 * f.length;
    f.press =
        span * span * span / (3.0 * f.notch) * std::sqrt(f.law.tangential_toughness / (75e9 * half * half * half));
    Problem problem = unit::make_flexure(f);
    problem.patterns[0] = {
        "press", {0.0, most_steps * step_size}, {0.0, most_steps * step_size * f.press}, Pattern::Drives::displacement};
    problem.options.reduction = "iterated";
    Monitor monitor;
    Count count;
    monitor.progress_user = &count;
    monitor.progress_callback = [](const char* stage, std::int64_t done, std::int64_t, void* user) {
        if (std::strcmp(stage, "linear solve") != 0) return 0;
        Count& c = *static_cast<Count*>(user);
        c.solves += done == 1 ? 1 : 0;
        c.worst = std::max(c.worst, done);
        ++c.iterations;
        return 0;
    };
    Solver solver(problem, monitor, 0.0);
    const std::vector<double> before = solver.states().committed().adhesion;
    std::int64_t grown = 0;
    for (int step = 1, growing = 0; step <= most_steps && growing<5; ++step, growing += grown> 0 ? 1 : 0) {
        ck_assert_int_eq(solver.advance(step_size * step).status, DELAM_OK);
        solver.commit();
        grown = 0;
        for (std::size_t p = 0; p < before.size(); ++p)
            grown += solver.states().committed().adhesion[p] < before[p] ? 1 : 0;
    }
    std::printf(
        "k = %.0e, cells 1 : %g, %d interfaces: %d pairs of %d damaged; %d solves, iterations %.1f on average, "
        "%d at worst\n",
        m.stiffness, m.aspect, static_cast<int>(m.layers) - 1, static_cast<int>(grown), static_cast<int>(before.size()),
        static_cast<int>(count.solves), static_cast<double>(count.iterations) / static_cast<double>(count.solves),
        static_cast<int>(count.worst));
    std::fflush(stdout);
    ck_assert_int_gt(grown, 0);
    return count;
}

void expect_few(std::span<const Analysis> analyses) {
    for (const Analysis& m : analyses) {
        const Count c = analyse(m);
        ck_assert(static_cast<double>(c.iterations) <= 6.0 * static_cast<double>(c.solves));
        ck_assert_int_le(c.worst, m.worst);
    }
}

}  // namespace

TEST(whatever_the_stiffness) {
    std::vector<Analysis> analyses;
    for (const double k : stiffnesses) analyses.push_back({.stiffness = k});
    expect_few(analyses);
}

TEST(whatever_the_shape_of_the_cells) {
    std::vector<Analysis> analyses;
    for (const double aspect : aspects) analyses.push_back({.aspect = aspect});
    expect_few(analyses);
}

TEST(however_many_interfaces) {
    std::vector<Analysis> analyses;
    for (const std::size_t layers : stacks) analyses.push_back({.layers = layers});
    expect_few(analyses);
}
