// SPDX-License-Identifier: BSD-3-Clause
// The table of the solution concepts: local, with backtracking, energetic, on the same brittle scenes.
#include <cstdio>

#include "analysis.hpp"
#include "child.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "tables.hpp"

namespace bench {
namespace {

std::string range_of(const Json& m, const char* key, const char* format) {
    if (!m.contains(key)) return "";
    return number(m[key]["q1"].get<double>(), format) + ".." + number(m[key]["q3"].get<double>(), format);
}

std::string peak_of(const Json& memory, const std::string& key) {
    return memory.contains(key) && memory[key].contains("peak_MB")
               ? number(memory[key]["peak_MB"].get<double>(), "%.0f")
               : "";
}

double value_of(const Json& v) { return v.is_number() ? v.get<double>() : 0.0; }

// The cost.
void add_costs(std::vector<Row>& rows, const Json& series, const Json& memory, int threads) {
    const std::string scene = series["scene"], n = std::to_string(threads);
    const auto median_of = [](const Json& m, const char* key) { return number(m[key]["median"].get<double>()); };
    rows.push_back({scene, n, "one linear solve", median_of(series, "lse_s"), range_of(series, "lse_s", "%.3g"), "1",
                    "", "1", "", "", "", peak_of(memory, "lse"),
                    "A/A " + number(series["noise_floor"]["ratio_of_medians"].get<double>())});
    for (const auto& [key, m] : series["methods"].items()) {
        if (m.contains("skipped")) {
            rows.push_back({scene, n, key, "", "", "", "", "", "", "", "", "",
                            "skipped: " + m["skipped"].get<std::string>().substr(0, 60)});
            continue;
        }
        rows.push_back({scene, n, key, median_of(m, "total_s"), range_of(m, "total_s", "%.3g"),
                        number(m["lse"].get<double>(), "%.1f"), range_of(m, "lse_by_round", "%.1f"),
                        m.contains("lse_processor") ? number(m["lse_processor"].get<double>(), "%.1f") : "",
                        m.contains("to_local") ? number(m["to_local"]["median"].get<double>(), "%.2f") : "",
                        median_of(m, "before_first_step_s"), median_of(m, "steps_s"), peak_of(memory, key),
                        m["label"]});
    }
}

// The findings, which do not depend on the time measured.
void add_findings(std::vector<Row>& rows, const Json& series) {
    const std::string scene = series["scene"];
    for (const auto& [key, m] : series["methods"].items()) {
        if (m.contains("skipped")) continue;
        const auto spent = [&of = m["spent"]](const char* name) { return number(value_of(of[name]), "%.0f"); };
        Row row{scene, key};
        if (const Json& jump = m["jump"]; jump.is_object()) {
            row.insert(row.end(),
                       {number(value_of(jump["step"]), "%.0f"), number(1e3 * value_of(jump["load"]), "%.2f"),
                        number(1e3 * value_of(jump["advance"]), "%.1f"), number(value_of(jump["released"]))});
        } else {
            row.insert(row.end(), {"-", "-", "-", "-"});
        }
        row.insert(row.end(), {m.contains("defect_end") ? number(value_of(m["defect_end"])) : "-",
                               number(static_cast<double>(m["violated"].size()), "%.0f"),
                               number(value_of(m["worst_excess"]), "%.1e"), spent("am_iterations"),
                               spent("displacement_solves"), spent("newton_solves"), spent("search_candidates"),
                               spent("backtracks"), number(value_of(m["counts"]["not_converged"]), "%.0f")});
        if (m.contains("search")) {
            const Json& s = m["search"];
            const auto bound = [&](const char* name, const char* format) {
                return s[name].is_number() ? number(s[name].get<double>(), format) : std::string("none");
            };
            row.insert(row.end(), {bound("gap", "%.2g"), bound("gap_relative", "%.1e"), bound("margin", "%.1e")});
        } else {
            row.insert(row.end(), {"-", "-", "-"});
        }
        rows.push_back(std::move(row));
    }
}

}  // namespace

Json energetic_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : (settings.quick ? 3 : 7);
    const double cap = settings.cap > 0.0 ? settings.cap : (settings.quick ? 30.0 : 300.0);
    auto scenes = settings.scenes;
    if (scenes.empty() && settings.quick) scenes = {"enf-brittle-1", "enf-brittle-0.5"};
    if (scenes.empty()) scenes = {"enf-brittle-0.5", "enf-brittle-0.1"};
    const auto threads = settings.threads.empty() ? std::vector<int>{1, 2} : settings.threads;

    Json result;
    result["repeat"] = repeat;
    result["cap_s"] = cap;
    std::vector<Row> costs, found;
    for (const auto& name : scenes) {
        Json scene;
        std::vector<std::string> measured{"lse"};
        for (const Method& m : concepts()) measured.emplace_back(m.key);
        for (const auto& method : measured) {
            progress(name + ": memory, " + method);
            scene["memory"][method] = ask_child({"memory", name, method, std::to_string(cap)}, 1);
        }
        bool listed = false;
        for (const int n : threads) {
            progress(name + ": " + std::to_string(n) + " thread(s)");
            Json series = ask_child({"concepts", name, std::to_string(repeat), std::to_string(cap)}, n);
            if (series.contains("error")) {
                costs.push_back({name, std::to_string(n), "error: " + series["error"].get<std::string>()});
            } else {
                add_costs(costs, series, scene["memory"], n);
                if (!listed) add_findings(found, series);
                listed = true;
            }
            scene["threads"][std::to_string(n)] = std::move(series);
        }
        result["scenes"][name] = std::move(scene);
    }
    print_rows({"scene", "thr", "analysis", "total_s", "q1..q3", "LSE", "by round", "LSE_cpu", "/local", "setup_s",
                "steps_s", "peak_MB", "note"},
               costs);
    std::printf("\n");
    print_rows({"scene", "analysis", "jump_step", "load_mm", "advance_mm", "released", "defect_end", "violated",
                "excess", "AM", "displ", "Newton", "candidates", "returns", "refused", "gap", "gap_rel", "margin"},
               found);
    return result;
}

}  // namespace bench
