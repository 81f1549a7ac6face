// SPDX-License-Identifier: BSD-3-Clause
//
// calls_cpp CALLS STEPS: the program of calls.c through delam.hpp.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <vector>

#include "delam/delam.hpp"

namespace {

double now() { return 1e9 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

delam::Solver make_solver(const delam::Context& context) {
    auto mesh = delam::Mesh::layers(context, {0.1}, {20}, {2e-3, 2e-3}, {1, 1}, DELAM_QUAD4);
    mesh.add_interface(0, 1);
    delam::Law law(context, "piecewise-linear");
    law.set("normal_stiffness", 1e12);
    law.set("tangential_stiffness", 1e12);
    law.set("normal_onset", 50.0);
    law.set("tangential_onset", 50.0);
    law.set("normal_toughness", 250.0);
    law.set("tangential_toughness", 250.0);
    delam::Problem problem(context, mesh);
    problem.set_elastic(-1, 70e9, 0.3);
    problem.set_law(0, law);
    const std::int64_t pull = problem.add_pattern("pull", {0.0, 1.0, 2.0}, {0.0, 1e-6, 4e-3});
    const auto at = [&](double x, double y) { return mesh.find_nodes(-1, {x, y}, {x, y}).at(0); };
    problem.prescribe_nodes({at(0.0, 0.0)}, {1.0, 0.0});
    problem.prescribe_nodes({at(0.0, 0.0)}, {0.0, 1.0});
    problem.prescribe_nodes({at(0.1, 0.0)}, {0.0, 1.0});
    problem.prescribe_nodes({at(0.05, 4e-3)}, {0.0, -1.0}, {pull}, {1.0});
    return delam::Solver(problem, 0.0);
}

void run(int calls, int steps) {
    const delam::Context context;
    auto solver = make_solver(context);
    double sum = 0.0;
    double begin = now();
    for (int i = 0; i < calls; ++i) sum += solver.value("time");
    const double per_call = (now() - begin) / calls;
    begin = now();
    const auto step = [&](double time) {
        if (solver.advance(time) != delam::Outcome::done) throw std::runtime_error(context.message());
        solver.commit();
    };
    for (int i = 1; i <= steps; ++i) step(static_cast<double>(i) / steps);
    const double per_step = (now() - begin) / steps;
    std::printf("%.6g %.6g %.17g", per_call, per_step, sum);
    for (int i = 1; i <= 10; ++i) step(1.0 + i / 10.0);
    for (const char* key : {"reaction:pull", "stored_bulk", "stored_interface", "dissipated", "work"})
        std::printf(" %.17g", solver.value(key));
    for (const double adhesion : solver.field("adhesion").values) std::printf(" %.17g", adhesion);
    std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc > 2 ? std::atoi(argv[1]) : 1, argc > 2 ? std::atoi(argv[2]) : 1);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "calls: %s\n", error.what());
        return 1;
    }
    return 0;
}
