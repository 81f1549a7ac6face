// SPDX-License-Identifier: BSD-3-Clause
// Scene files run with the library's own choice of operator and with FETI: time in linear-solve equivalents, counts,
// peak memory. Runs in this process, with its threads. The matrix of the LSE is the direct reference's at the undamaged
// initial state, with all constraints eliminated.
#include <cstdio>

#include "clock.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "scene_file.hpp"
#include "scene_matrix.hpp"
#include "tables.hpp"

namespace bench {

namespace {

struct Outcome {
    double setup = 0.0, analysis = 0.0, peak = 0.0;  // s, s, bytes above the use before
    std::size_t steps = 0;
    double alternations = 0.0, linear = 0.0, solves = 0.0, dissipated = 0.0;
};

Outcome run(reference::SceneFile& file, const char* reduction, double cap) {
    file.scene.text("reduction", reduction);
    Outcome out;
    reset_peak_memory();
    const double before = peak_memory();
    Clock clock;
    reference::Solver solver(file.scene, file.times.front());
    out.setup = clock.seconds();
    for (std::size_t k = 1; k < file.times.size() && clock.seconds() < cap; ++k) {
        const std::int32_t status = solver.advance(file.times[k]);
        if (status != DELAM_NOT_CONVERGED) file.scene.require(status, "delam_solver_advance");
        solver.commit();
        out.alternations += solver.value("am_iterations");
        out.linear += solver.value("linear_iterations");
        out.solves += solver.value("displacement_solves");
        ++out.steps;
    }
    out.analysis = clock.seconds();
    out.peak = peak_memory() - before;
    out.dissipated = solver.value("dissipated");
    return out;
}

}  // namespace

Json scene_file_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : 3;
    const double cap = settings.cap > 0.0 ? settings.cap : 60.0;
    Json result = Json::array();
    std::vector<Row> rows;
    for (const std::string& path : settings.scenes) {
        progress(path);
        reference::SceneFile file = reference::read_scene_file(path, settings.settings);
        const UpperMatrix matrix = undamaged_matrix(file);
        const std::vector<double> right(matrix.size(), 1.0);
        double factor_bytes = 0.0, entries = 0.0;
        const auto lse = [&] {
            std::vector<double> x;
            const Clock clock;
            SparseFactor factor(matrix);
            factor.factorise();
            factor.solve(right, x);
            factor_bytes = factor.peak_bytes();
            entries = factor.entries();
            return clock.seconds();
        };
        lse();
        std::vector<double> solves{lse()};
        for (const char* reduction : {"auto", "feti"}) {
            std::vector<double> analyses;
            Outcome out;
            // The FETI analysis takes too long to be repeated.
            for (int i = 0; i < (reduction[0] == 'a' ? repeat : 1); ++i) {
                progress(std::string("  ") + reduction);
                out = run(file, reduction, reduction[0] == 'a' ? 1e9 : cap);
                analyses.push_back(out.analysis);
                solves.push_back(lse());
            }
            const double unit = median(solves);
            const bool whole = out.steps + 1 == file.times.size();
            result.push_back({{"scene", path},
                              {"settings", settings.settings},
                              {"reduction", reduction},
                              {"nodes", file.scene.node_count()},
                              {"pairs", file.scene.pair_count()},
                              {"unknowns", matrix.size()},
                              {"entries_L", entries},
                              {"lse_s", spread(solves)},
                              {"analysis_s", spread(analyses)},
                              {"setup_s", out.setup},
                              {"steps", out.steps},
                              {"whole", whole},
                              {"alternations", out.alternations},
                              {"displacement_solves", out.solves},
                              {"linear_iterations", out.linear},
                              {"dissipated", out.dissipated},
                              {"peak_MB", 1e-6 * out.peak},
                              {"lse_MB", 1e-6 * factor_bytes}});
            rows.push_back({path.substr(path.find_last_of('/') + 1), reduction, std::to_string(matrix.size()),
                            std::to_string(file.scene.pair_count()),
                            std::to_string(out.steps) + (whole ? "" : " (cap)"), number(unit), number(median(analyses)),
                            number(out.setup / unit), number(median(analyses) / unit), number(out.alternations),
                            number(out.solves), number(out.linear), number(1e-6 * out.peak),
                            number(1e-6 * factor_bytes), number(out.dissipated, "%.8g")});
        }
    }
    print_rows({"scene", "reduction", "unknowns", "pairs", "steps", "LSE_s", "analysis_s", "setup/LSE", "analysis/LSE",
                "alternations", "solves", "linear", "peak_MB", "LSE_MB", "dissipated"},
               rows);
    return result;
}

}  // namespace bench
