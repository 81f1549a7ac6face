// SPDX-License-Identifier: BSD-3-Clause
// Growth of the cost with the number of unknowns n: fitted exponents of c n^p, part by part, in 2D and 3D.
#include <cmath>
#include <cstdio>
#include <map>

#include "analysis.hpp"
#include "child.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "tables.hpp"

namespace bench {
namespace {

struct Points {
    std::vector<double> unknowns, seconds;
};

}  // namespace

Json growth_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : (settings.quick ? 1 : 3);
    const double cap = settings.cap > 0.0 ? settings.cap : (settings.quick ? 20.0 : 300.0);
    const int threads = settings.threads.empty() ? 1 : settings.threads.front();
    struct Family {
        const char* name;
        std::vector<std::string> scenes;
    };
    std::vector<Family> families = {
        {"2D, ductile ENF, quad4",
         {"enf-ductile-1", "enf-ductile-0.75", "enf-ductile-0.5", "enf-ductile-0.25", "enf-ductile-0.1"}},
        {"3D, ductile block, hex8", {"block-2", "block-1", "block-0.6666667", "block-0.5"}}};
    if (settings.quick) {
        families[0].scenes.resize(3);
        families[1].scenes.resize(2);
    }
    if (!settings.scenes.empty()) families = {{"scenes of the command line", settings.scenes}};

    Json result;
    result["threads"] = threads;
    for (const Family& family : families) {
        std::map<std::string, std::map<std::string, Points>> parts;  // method, part
        std::vector<Row> rows;
        const auto add = [&](const std::string& method, const char* part, double n, const Json& seconds) {
            parts[method][part].unknowns.push_back(n);
            parts[method][part].seconds.push_back(seconds["median"].get<double>());
        };
        for (const auto& name : family.scenes) {
            progress("growth: " + name);
            Json series = ask_child({"series", name, std::to_string(repeat), std::to_string(cap)}, threads);
            result["families"][family.name]["scenes"][name] = series;
            if (series.contains("error")) {
                rows.push_back({name, "error: " + series["error"].get<std::string>()});
                continue;
            }
            const double n = series["primal_dofs"];
            add("one linear solve", "total", n, series["lse_s"]);
            rows.push_back(
                {name, "one linear solve", number(n, "%.0f"), number(series["lse_s"]["median"].get<double>())});
            for (const auto& [key, m] : series["methods"].items()) {
                if (m.contains("skipped")) continue;
                const std::string label = m["label"];
                rows.push_back({name, key, number(n, "%.0f"), number(m["total_s"]["median"].get<double>()),
                                number(m["setup_s"]["median"].get<double>()),
                                number(m["factor_s"]["median"].get<double>()),
                                number(m["iterate_s"]["median"].get<double>()), number(m["lse"].get<double>()), label});
                if (label.rfind("stopped", 0) == 0) continue;  // an incomplete analysis has no place in a fit
                add(key, "total", n, m["total_s"]);
                add(key, "setup", n, m["setup_s"]);
                add(key, "factor", n, m["factor_s"]);
                add(key, "iterate", n, m["iterate_s"]);
            }
        }
        std::printf("%s\n", family.name);
        print_rows({"scene", "method", "DOFs", "total_s", "setup_s", "factor_s", "iterate_s", "LSE", "note"}, rows);
        std::printf("exponents of n\n");
        std::vector<Row> fits;
        for (const auto& [method, by_part] : parts) {
            Row row{method};
            for (const char* part : {"total", "setup", "factor", "iterate"}) {
                const auto found = by_part.find(part);
                double p = std::nan("");
                if (found != by_part.end()) p = exponent(found->second.unknowns, found->second.seconds);
                row.push_back(number(p, "%.2f"));
                if (!std::isnan(p)) result["families"][family.name]["exponents"][method][part] = p;
            }
            const auto& points = by_part.at("total");
            row.push_back(std::to_string(points.unknowns.size()));
            fits.push_back(row);
        }
        print_rows({"method", "total", "setup", "factor", "iterate", "points"}, fits);
        std::printf("\n");
    }
    return result;
}

}  // namespace bench
