// SPDX-License-Identifier: BSD-3-Clause
// The main comparison: four methods on the same scenes with the same stopping test.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "analysis.hpp"
#include "child.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "tables.hpp"

namespace bench {
namespace {

double median_of(const Json& m, const char* key) {
    return m.contains(key) ? m[key]["median"].get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string range_of(const Json& m, const char* key) {
    if (!m.contains(key) || !m[key].contains("q1")) return "";
    return number(m[key]["q1"].get<double>()) + ".." + number(m[key]["q3"].get<double>());
}

void add_rows(std::vector<Row>& rows, const Json& series, const Json& memory, int threads) {
    if (series.contains("error")) {
        rows.push_back({"error: " + series["error"].get<std::string>()});
        return;
    }
    const std::string scene = series["scene"];
    rows.push_back({scene, std::to_string(threads), "one linear solve", number(median_of(series, "lse_s")),
                    range_of(series, "lse_s"), "1", "", "", "", "", "", "", "", "", "", "",
                    memory.contains("lse") ? number(memory["lse"].value("peak_MB", 0.0), "%.0f") : "",
                    "A/A " + number(series["noise_floor"]["ratio_of_medians"].get<double>())});
    for (const auto& [key, m] : series["methods"].items()) {
        if (m.contains("skipped")) {
            rows.push_back({scene, std::to_string(threads), key, "", "", "", "", "", "", "", "", "", "", "", "", "", "",
                            "skipped: " + m["skipped"].get<std::string>().substr(0, 60)});
            continue;
        }
        const Json& c = m["counts"];
        const auto count = [&](const char* name) { return number(c[name].get<double>(), "%.0f"); };
        const bool has_memory = memory.contains(key) && memory[key].contains("peak_MB");
        rows.push_back({scene, std::to_string(threads), key, number(median_of(m, "total_s")), range_of(m, "total_s"),
                        number(m["lse"].get<double>(), "%.4g"),
                        m.contains("baseline_over_this") ? number(m["baseline_over_this"].get<double>()) : "",
                        number(median_of(m, "setup_s")), number(median_of(m, "factor_s")),
                        number(median_of(m, "iterate_s")), count("am_iterations"), count("displacement_solves"),
                        count("active_set_steps"), count("linear_iterations"), count("bulk_factorisations"),
                        count("not_converged"), has_memory ? number(memory[key]["peak_MB"].get<double>(), "%.0f") : "",
                        m["label"].get<std::string>()});
    }
}

void print_agreement(const char* title, const Json& part) {
    if (!part.contains("agreement")) return;
    std::printf("\n%s\n", title);
    std::vector<Row> rows;
    for (const auto& [pair, d] : part["agreement"].items()) {
        rows.push_back({pair, number(d["common_steps"].get<double>(), "%.0f"),
                        number(d["reaction"].get<double>(), "%.1e"), number(d["stored_bulk"].get<double>(), "%.1e"),
                        number(d["stored_interface"].get<double>(), "%.1e"),
                        number(d["dissipated"].get<double>(), "%.1e")});
    }
    print_rows({"methods", "steps", "reaction", "stored_bulk", "stored_interface", "dissipated"}, rows);
}

}  // namespace

Json analysis_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : (settings.quick ? 3 : 7);
    const double cap = settings.cap > 0.0 ? settings.cap : (settings.quick ? 30.0 : 300.0);
    auto scenes = settings.scenes;
    if (scenes.empty() && settings.quick) scenes = {"enf-ductile-1", "enf-ductile-0.5"};
    if (scenes.empty()) scenes = {"enf-ductile-0.5", "enf-ductile-0.1", "enf-brittle-0.1"};
    const auto threads = settings.threads.empty() ? std::vector<int>{1, 2} : settings.threads;

    Json result;
    result["repeat"] = repeat;
    result["cap_s"] = cap;
    std::vector<Row> rows;
    for (const auto& name : scenes) {
        Json scene;
        const bool brittle = find_scene(name).brittle;
        std::vector<std::string> measured{"lse"};
        for (const Method& m : methods()) measured.emplace_back(m.key);
        for (const auto& method : measured) {
            progress(name + ": memory, " + method);
            // The peak occurs early in an analysis, so a part of it suffices.
            const double part = std::min(cap, settings.quick ? 10.0 : 60.0);
            scene["memory"][method] = ask_child({"memory", name, method, std::to_string(part)}, 1);
        }
        for (const int n : threads) {
            progress(name + ": " + std::to_string(n) + " thread(s)");
            Json series = ask_child({"series", name, std::to_string(repeat), std::to_string(cap)}, n);
            add_rows(rows, series, scene["memory"], n);
            scene["threads"][std::to_string(n)] = std::move(series);
        }
        if (brittle) {
            scene["critical"] = ask_child({"critical", name, std::to_string(cap)}, threads.back());
        } else {
            scene["agreement_1e-10"] = ask_child({"agreement", name, "1e-10", std::to_string(cap)}, threads.back());
        }
        result["scenes"][name] = std::move(scene);
    }

    print_rows({"scene", "thr", "method", "total_s", "q1..q3", "LSE", "(a)/this", "setup_s", "factor_s", "iterate_s",
                "AM", "displ", "active", "Krylov", "bulk_f", "refused", "peak_MB", "note"},
               rows);
    for (const auto& [name, scene] : result["scenes"].items()) {
        for (const auto& [n, series] : scene["threads"].items()) {
            print_agreement((name + ", delta 1e-5, " + n + " thread(s): largest relative differences").c_str(), series);
            break;  // the histories depend on the threads only by rounding
        }
        if (scene.contains("agreement_1e-10"))
            print_agreement((name + ", delta 1e-10: largest relative differences").c_str(), scene["agreement_1e-10"]);
        if (!scene.contains("critical") || !scene["critical"].contains("methods")) continue;
        std::printf("\n%s: critical points\n", name.c_str());
        for (const auto& [key, m] : scene["critical"]["methods"].items()) {
            if (!m.contains("damage_fixed_point") || m["damage_fixed_point"].empty()) continue;
            long beyond = 0;
            for (const auto& defect : m["damage_fixed_point"]) beyond += defect.get<double>() > 1e-5 ? 1 : 0;
            std::printf(
                "%-10s %s steps; one more damage step moves %.1e at the end, %.1e at worst, beyond 1e-5 in %ld steps; ",
                key.c_str(), m["steps"].dump().c_str(), m["damage_fixed_point"].back().get<double>(),
                m["damage_fixed_point_worst_of_steps"].get<double>(), beyond);
            if (m.contains("jump_against_library")) {
                std::printf("jump against the library's %.1e\n", m["jump_against_library"].get<double>());
            } else {
                const Json& kkt = m["end_state_kkt"];
                std::printf("end state: %s\n",
                            kkt.is_object() ? kkt["text"].get<std::string>().c_str() : "not reached");
            }
        }
    }
    return result;
}

}  // namespace bench
