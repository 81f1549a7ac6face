// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of threads where other programs use the cores: four analyses of a scene file as four processes at
// once against one after another, and one analysis beside busy loops. Every analysis is a separate process.
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>

#include "child.hpp"
#include "clock.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "scene_file.hpp"
#include "tables.hpp"

namespace bench {

namespace {

constexpr int together = 4;

// Programs that use a core each and do nothing else.
class BusyLoops {
public:
    explicit BusyLoops(long count) {
        for (long i = 0; i < count; ++i) {
            const pid_t child = fork();
            if (child == 0) {
                prctl(PR_SET_PDEATHSIG, SIGKILL);
                for (std::atomic<unsigned> turns{0};;) ++turns;
            }
            if (child > 0) child_.push_back(child);
        }
    }
    ~BusyLoops() {
        for (const pid_t child : child_) {
            kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
        }
    }
    BusyLoops(const BusyLoops&) = delete;
    BusyLoops& operator=(const BusyLoops&) = delete;

private:
    std::vector<pid_t> child_;
};

struct Variant {
    std::string name;
    int host;    // threads of BLAS and OpenMP; 0: the environment says nothing
    long asked;  // option threads; 0: its default
    // Seconds of the clock and of the processors in each round.
    std::vector<double> turn{}, turn_processor{}, once{}, once_processor{}, alone{}, loaded{}, loaded_processor{};
};

struct Total {
    double clock = 0.0, processor = 0.0;
};

Child start(const std::string& scene, const Settings& settings, const Variant& variant) {
    std::vector<std::string> task{"analysis", scene};
    task.insert(task.end(), settings.settings.begin(), settings.settings.end());
    if (variant.asked > 0) task.push_back("solver.threads=" + std::to_string(variant.asked));
    return start_child(task, variant.host);
}

// The parent's clock, which starts before the first process and stops after the last.
Total run(int count, bool at_once, const std::string& scene, const Settings& settings, const Variant& variant) {
    Total total;
    const Clock clock;
    std::vector<Child> running;
    const auto finish = [&] {
        for (const Child& child : running) {
            const Json answer = answer_of(child);
            if (answer.contains("error")) throw reference::Failure(0, answer["error"].get<std::string>());
            total.processor += answer["processor_s"].get<double>();
        }
        running.clear();
    };
    for (int i = 0; i < count; ++i) {
        running.push_back(start(scene, settings, variant));
        if (!at_once) finish();
    }
    finish();
    total.clock = clock.seconds();
    return total;
}

void measure(const std::string& scene, const Settings& settings, long cores, Variant& v) {
    progress(scene + ", " + v.name);
    const Total turn = run(together, false, scene, settings, v), once = run(together, true, scene, settings, v);
    v.turn.push_back(turn.clock);
    v.turn_processor.push_back(turn.processor);
    v.once.push_back(once.clock);
    v.once_processor.push_back(once.processor);
    v.alone.push_back(turn.clock / together);
    const BusyLoops loops(cores);
    const Total loaded = run(1, true, scene, settings, v);
    v.loaded.push_back(loaded.clock);
    v.loaded_processor.push_back(loaded.processor);
}

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> r;
    for (std::size_t i = 0; i < a.size(); ++i) r.push_back(a[i] / b[i]);
    return r;
}

}  // namespace

Json measure_analysis(const std::string& path, const std::vector<std::string>& settings) {
    const reference::SceneFile file = reference::read_scene_file(path, settings);
    const ProcessorClock processor;
    const Clock clock;
    reference::Solver solver(file.scene, file.times.front());
    for (std::size_t k = 1; k < file.times.size(); ++k) {
        const std::int32_t status = solver.advance(file.times[k]);
        if (status != DELAM_NOT_CONVERGED) file.scene.require(status, "delam_solver_advance");
        solver.commit();
    }
    return {{"clock_s", clock.seconds()}, {"processor_s", processor.seconds()}};
}

Json side_by_side_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : 3;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    Json result = Json::array();
    std::vector<Row> rows;
    for (const std::string& scene : settings.scenes) {
        std::array<Variant, 3> variants{Variant{"one thread", 1, 1}, Variant{"default", 0, 0},
                                        Variant{"threads = " + std::to_string(cores), 0, cores}};
        for (int i = 0; i < repeat; ++i)
            for (Variant& v : variants) measure(scene, settings, cores, v);
        for (const Variant& v : variants) {
            const Variant& one = variants.front();
            const auto elapsed = ratios(v.once, v.turn), processor = ratios(v.once_processor, v.turn_processor),
                       idle = ratios(v.alone, one.alone), loaded = ratios(v.loaded, one.loaded);
            result.push_back({{"scene", scene},
                              {"settings", settings.settings},
                              {"threads", v.name},
                              {"in_turn_s", spread(v.turn)},
                              {"in_turn_processor_s", spread(v.turn_processor)},
                              {"at_once_s", spread(v.once)},
                              {"at_once_processor_s", spread(v.once_processor)},
                              {"at_once/in_turn", spread(elapsed)},
                              {"processor, at_once/in_turn", spread(processor)},
                              {"beside_loops_s", spread(v.loaded)},
                              {"beside_loops_processor_s", spread(v.loaded_processor)},
                              {"idle/one_thread", spread(idle)},
                              {"loaded/one_thread", spread(loaded)}});
            rows.push_back({scene.substr(scene.find_last_of('/') + 1), v.name, number(median(v.alone)),
                            number(median(v.turn)), number(median(v.once)), number(median(elapsed)),
                            number(median(processor)), number(median(v.loaded)), number(median(idle)),
                            number(median(loaded))});
        }
    }
    print_rows({"scene", "threads", "one_s", "in_turn_s", "at_once_s", "at_once/in_turn", "processor", "loaded_s",
                "idle/one", "loaded/one"},
               rows);
    return result;
}

}  // namespace bench
