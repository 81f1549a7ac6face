// SPDX-License-Identifier: BSD-3-Clause
// The library's own threads: every piece once, what pieces may do within pieces, exceptions, and an analysis with the
// same bits whatever their number.
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/machine/blas_threads.hpp"
#include "base/monitor.hpp"
#include "base/team.hpp"
#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "flexure.hpp"

extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
}

using namespace delam;

namespace {

constexpr std::int64_t count = 200;

TEST(every_piece_once) {
    for (const std::int64_t threads : {1, 2, 3}) {
        const TeamScope team(threads);
        for (int round = 0; round < 50; ++round) {
            std::vector<std::atomic<int>> times(count);
            std::int64_t last = 0;
            share(
                count, [&](std::int64_t i) { ++times[static_cast<std::size_t>(i)]; },
                [&](std::int64_t done) {
                    ck_assert_int_ge(done, last);
                    last = done;
                });
            for (const auto& t : times) ck_assert_int_eq(t, 1);
        }
    }
}

// Pieces within pieces run one after another; a single piece is none.
TEST(within) {
    const TeamScope team(2);
    std::atomic<int> inner{0};
    share(4, [&](std::int64_t) {
        ck_assert(in_a_piece());
        share(3, [&](std::int64_t) { ++inner; });
        ck_assert(in_a_piece());
    });
    ck_assert_int_eq(inner, 12);
    ck_assert(!in_a_piece());
    share(1, [](std::int64_t) { ck_assert(!in_a_piece()); });
}

// A callback of the host, between two pieces, may call the library again.
TEST(between) {
    const TeamScope team(2);
    std::atomic<int> outer{0};
    int inner = 0;
    share(
        50, [&](std::int64_t) { ++outer; }, [&](std::int64_t) { share(3, [&](std::int64_t) { ++inner; }); });
    ck_assert_int_eq(outer, 50);
    ck_assert_int_ge(inner, 3);
    ck_assert_int_eq(inner % 3, 0);
}

TEST(exceptions) {
    for (const std::int64_t threads : {1, 2, 3}) {
        const TeamScope team(threads);
        std::string caught;
        try {
            share(count, [](std::int64_t i) {
                if (i >= 7) throw std::runtime_error(std::to_string(i));
            });
        } catch (const std::runtime_error& error) {
            caught = error.what();
        }
        ck_assert_str_eq(caught.c_str(), "7");
        std::atomic<int> after{0};
        share(count, [&](std::int64_t) { ++after; });
        ck_assert_int_eq(after, count);
    }
}

TEST(one_thread_of_the_blas) {
    if (openblas_get_num_threads == nullptr || openblas_set_num_threads == nullptr) return;
    openblas_set_num_threads(2);
    if (openblas_get_num_threads() != 2) return;
    for (const std::int64_t threads : {1, 2}) {
        const TeamScope team(threads);
        share(count, [](std::int64_t) { ck_assert_int_eq(openblas_get_num_threads(), 1); });
        ck_assert_int_eq(openblas_get_num_threads(), 2);
    }
}

TEST(analysis) {
    unit::Flexure scene;
    scene.dimension = 3;
    scene.along = 30;
    scene.across = 6;
    const Problem problem = unit::make_flexure(scene);
    const auto analyse = [&](std::int64_t threads) {
        const TeamScope team(threads);
        Monitor monitor;
        Solver solver(problem, monitor, 0.0);
        for (int k = 1; k <= 4; ++k) {
            ck_assert_int_ge(solver.advance(k / 4.0).status, 0);
            solver.commit();
        }
        return solver.states().shown().adhesion;
    };
    const std::vector<double> one = analyse(1);
    ck_assert(analyse(2) == one);
    ck_assert(analyse(3) == one);
}

}  // namespace
