// SPDX-License-Identifier: BSD-3-Clause
// Error against cost by method: the ductile ENF on patches, 4-node cells, the four methods of the table `analysis` on
// each of a few meshes. Errors are those of the mesh: all analyses and the reference (quadratic cells on a fine mesh)
// have the same steps.
#include <cmath>
#include <cstdio>

#include "analysis.hpp"
#include "child.hpp"
#include "curve.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "tables.hpp"

namespace bench {
namespace {

struct Fine {
    Curve reaction, dissipated;
    double h;  // mm
    std::int64_t unknowns = 0;
};

Fine analyse_fine(const Element& element, double h, double cap) {
    progress(std::string("methods: reference, ") + element.name + ", h " + number(h) + " mm");
    SceneData data = find_scene("enf-patch-1");
    data.element = &element;
    data.h = h * 1e-3;
    Stage stage = make_mesh(data);
    const Analysis analysis = run_library(stage, {"auto", "auto"}, cap);
    if (analysis.capped) throw reference::Failure(0, "the reference was stopped by the cap");
    Fine fine{reaction_curve(analysis), dissipation_curve(analysis), h};
    std::int64_t dual = 0;
    delam_problem_dofs(stage.scene.problem(), &fine.unknowns, &dual);
    return fine;
}

Curve curve_of(const Json& history, const char* key) {
    Curve c;
    for (const auto& v : history["load"]) c.x.push_back(v.get<double>());
    for (const auto& v : history[key]) c.y.push_back(v.get<double>());
    return c;
}

}  // namespace

Json methods_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : 3;
    const double cap = settings.cap > 0.0 ? settings.cap : (settings.quick ? 5.0 : 20.0);
    const std::vector<double> meshes =
        settings.quick ? std::vector<double>{1.5, 1.0, 0.5} : std::vector<double>{1.5, 1.0, 0.75, 0.5, 0.25};

    const Element& element = *find_element("quad9");
    std::vector<Fine> fine;
    for (const double h : reference_meshes(settings.quick)) fine.push_back(analyse_fine(element, h, 600.0));
    const Fine& best = fine.back();
    const auto judge = [&](Curve Fine::*curve) {
        const auto e = richardson(fine[0].h, fine[1].h, best.h, distance(fine[0].*curve, best.*curve),
                                  distance(fine[1].*curve, best.*curve));
        return Json{{"observed_order_h", e.order}, {"error_h", e.error}};
    };
    Json result;
    result["cap_s"] = cap;
    result["reference"] = {{"element", element.name},
                           {"h_mm", best.h},
                           {"steps", best.reaction.x.size() - 1},
                           {"primal_dofs", best.unknowns},
                           {"reaction", judge(&Fine::reaction)},
                           {"dissipated", judge(&Fine::dissipated)}};

    std::vector<Row> rows;
    for (const double h : meshes) {
        Json series = ask_child({"series", "enf-patch-" + number(h), std::to_string(repeat), std::to_string(cap)}, 1);
        if (series.contains("error")) throw reference::Failure(0, series["error"].get<std::string>());
        series["h_mm"] = h;
        for (auto& [key, m] : series["methods"].items()) {
            // An analysis that was stopped, or priced and not run, has no error of its own.
            if (m.contains("history") && m["history"]["load"].size() == series["steps"].get<std::size_t>()) {
                m["error_reaction"] = distance(curve_of(m["history"], "reaction"), best.reaction);
                m["error_dissipated"] = distance(curve_of(m["history"], "dissipated"), best.dissipated);
            }
            m.erase("history");
            if (m.contains("skipped")) continue;
            const auto error = [&of = m](const char* name) { return number(of.value(name, std::nan("")), "%.2e"); };
            rows.push_back({number(h), key, number(m["total_s"]["median"].get<double>()),
                            number(m["lse"].get<double>(), "%.4g"), error("error_reaction"), error("error_dissipated"),
                            m["label"].get<std::string>()});
        }
        result["meshes"].push_back(std::move(series));
    }
    print_rows({"h_mm", "method", "seconds", "LSE", "err_F", "err_D", "note"}, rows);
    std::printf("\nreference: %s\n", result["reference"].dump().c_str());
    return result;
}

}  // namespace bench
