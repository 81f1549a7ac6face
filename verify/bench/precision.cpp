// SPDX-License-Identifier: BSD-3-Clause
// Error against time: ductile ENF with supports and load as means over patches of 2 mm (with point supports the
// solution does not converge as the mesh is refined), over mesh, step, element and tolerance.
//
// The reference is the best quadratic element on a mesh finer than those of all rows (reference_meshes), with twice the
// finest number of steps. There are two errors: from that reference, and from the same mesh at the row's own number of
// steps, which is the error of the mesh alone. Comparisons at equal error use the latter.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "analysis.hpp"
#include "curve.hpp"
#include "lse.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "tables.hpp"

namespace bench {
namespace {

SceneData scene_data(const Element& element, double h, int steps) {
    SceneData data = find_scene("enf-patch-1");
    data.element = &element;
    data.h = h * 1e-3;
    data.steps = steps;
    return data;
}

// The fastest setting of this library: its own choice, if it makes one.
const Method automatic{"auto", "auto", "auto"};

std::optional<Choice> choose(Stage& stage, double delta) {
    if (declare(stage, {automatic.reduction, automatic.minimisation, delta})) return Choice{"auto", "auto", delta};
    if (declare(stage, {nullptr, nullptr, delta})) return Choice{nullptr, nullptr, delta};
    return std::nullopt;
}

bool known(const Element& element) {
    try {
        Stage stage = make_mesh(scene_data(element, 3.0, 1));
        return choose(stage, 1e-5).has_value();
    } catch (const reference::Failure&) {
        return false;
    }
}

struct Run {
    const Element* element;
    double h;  // mm
    int steps;
    double delta;
    std::int64_t primal = 0, dual = 0;
    Analysis analysis;
    std::vector<double> seconds;
    std::vector<double> setup, factor, iterate;
    double lse = nan;  // s, of one linear solve
    bool complete() const { return !analysis.capped && static_cast<int>(analysis.steps.size()) == steps; }
};

Run run(const Element& element, double h, int steps, double delta, int repeat, double cap, bool with_lse) {
    progress(std::string("precision: ") + element.name + ", h " + std::to_string(h) + " mm, " + std::to_string(steps) +
             " steps, delta " + std::to_string(delta));
    Run r{&element, h, steps, delta, 0, 0, {}, {}, {}, {}, {}, nan};
    Stage stage = make_mesh(scene_data(element, h, steps));
    const auto choice = choose(stage, delta);
    if (!choice) throw reference::Failure(0, std::string(element.name) + ": refused");
    delam_problem_dofs(stage.scene.problem(), &r.primal, &r.dual);
    std::optional<Lse> lse;
    std::vector<double> unit;
    if (with_lse) {
        lse.emplace(stage);
        lse->choose();
    }
    for (int i = 0; i < repeat; ++i) {
        if (lse) unit.push_back(lse->measure());
        Analysis analysis = run_library(stage, *choice, cap);
        r.seconds.push_back(analysis.total());
        r.setup.push_back(analysis.setup);
        r.factor.push_back(analysis.factor);
        r.iterate.push_back(analysis.iterate);
        if (i == 0) r.analysis = std::move(analysis);
        if (!r.complete() || r.seconds.back() > 0.2 * cap) break;
    }
    if (lse) r.lse = median(unit);
    return r;
}

// The point where the error of an element meets the target: time by log-log interpolation over its meshes.
struct Meeting {
    double seconds = nan;
    double h = nan;
    std::string note;
};
Meeting meet(std::vector<std::pair<double, const Run*>> by_error, double target) {
    std::sort(by_error.begin(), by_error.end(), [](const auto& a, const auto& b) { return a.second->h > b.second->h; });
    Meeting m{nan, nan, "not reached by these meshes"};
    for (std::size_t i = 0; i < by_error.size(); ++i) {
        const auto& [error, row] = by_error[i];
        if (error > target) continue;
        const double seconds = median(row->seconds);
        if (i == 0) return {seconds, row->h, "met by the coarsest mesh: an upper bound of the time"};
        const auto& [error_before, before] = by_error[i - 1];
        const double part = std::log(error_before / target) / std::log(error_before / error);
        const double seconds_before = median(before->seconds);
        m.seconds = std::exp(std::log(seconds_before) * (1.0 - part) + std::log(seconds) * part);
        m.h = std::exp(std::log(before->h) * (1.0 - part) + std::log(row->h) * part);
        m.note = "interpolated";
        return m;
    }
    return m;
}

}  // namespace

Json precision_table(const Settings& settings) {
    const int repeat = settings.repeat > 0 ? settings.repeat : (settings.quick ? 1 : 5);
    const double cap = settings.cap > 0.0 ? settings.cap : (settings.quick ? 60.0 : 600.0);
    const std::vector<double> meshes =
        settings.quick ? std::vector<double>{1.0, 0.75, 0.5} : std::vector<double>{1.0, 0.75, 0.5, 0.25};
    const std::vector<int> steps = settings.quick ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80};
    constexpr int line_steps = 40;

    Json result;
    std::vector<const Element*> available;
    for (const Element& e : elements()) {
        if (known(e)) {
            available.push_back(&e);
        } else {
            result["skipped"].push_back(std::string(e.name) + ": not known to this library");
        }
    }
    const Element* best = available.front();
    for (const Element* e : available) {
        if (e->order >= best->order) best = e;
    }

    // The reference at every number of steps, and the runs that estimate its error: two on coarser meshes, one with
    // fewer steps.
    const auto fine = reference_meshes(settings.quick);
    const double fine_h = fine.back();
    const int fine_steps = 2 * steps.back();
    std::map<int, Run> mesh_reference;
    for (const int n : steps) mesh_reference.emplace(n, run(*best, fine_h, n, 1e-5, 1, 10.0 * cap, false));
    mesh_reference.emplace(fine_steps, run(*best, fine_h, fine_steps, 1e-5, 1, 10.0 * cap, false));
    for (const auto& [n, r] : mesh_reference) {
        if (!r.complete()) throw reference::Failure(0, "the reference was stopped by the cap");
    }
    const Run& reference = mesh_reference.at(fine_steps);
    const Run middle = run(*best, fine[1], line_steps, 1e-5, 1, 10.0 * cap, false);
    const Run coarse = run(*best, fine[0], line_steps, 1e-5, 1, 10.0 * cap, false);
    const auto judge = [&](Curve (*curve)(const Analysis&)) {
        const auto& at_lines = mesh_reference.at(line_steps).analysis;
        const auto mesh = richardson(coarse.h, middle.h, fine_h, distance(curve(coarse.analysis), curve(at_lines)),
                                     distance(curve(middle.analysis), curve(at_lines)));
        const auto& fewest = mesh_reference.at(steps[steps.size() - 2]).analysis;
        const auto& fewer = mesh_reference.at(steps.back()).analysis;
        const auto step = richardson(4.0, 2.0, 1.0, distance(curve(fewest), curve(reference.analysis)),
                                     distance(curve(fewer), curve(reference.analysis)));
        return Json{{"observed_order_h", mesh.order},
                    {"error_h", mesh.error},
                    {"observed_order_tau", step.order},
                    {"error_tau", step.error}};
    };
    result["reference"] = {{"element", best->name},
                           {"h_mm", fine_h},
                           {"steps", fine_steps},
                           {"primal_dofs", reference.primal},
                           {"seconds", median(reference.seconds)},
                           {"reaction", judge(reaction_curve)},
                           {"dissipated", judge(dissipation_curve)},
                           {"judged_by",
                            "Richardson: differences of two coarser meshes (and of half and a quarter "
                            "of the steps) to the finest"}};

    std::vector<Run> runs;
    for (const Element* e : available) {
        auto sizes = meshes;
        // Second-order elements are worth testing where linear ones cannot bend at all.
        if (e->order > 1) sizes.insert(sizes.begin(), {3.0, 1.5});
        for (const double h : sizes) {
            for (const int n : steps) runs.push_back(run(*e, h, n, 1e-5, repeat, cap, n == line_steps));
        }
        // On the finest mesh quadratic elements have ten times the unknowns, for digits that nobody needs.
        if (!settings.quick && e->order < 2) runs.push_back(run(*e, 0.1, line_steps, 1e-5, repeat, cap, true));
    }
    const double delta_h = settings.quick ? 1.0 : 0.5;
    for (const double delta : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
        runs.push_back(run(*available.front(), delta_h, line_steps, delta, repeat, cap, false));
    std::map<std::pair<std::string, double>, double> unit;
    for (const Run& r : runs) {
        if (!std::isnan(r.lse)) unit[{r.element->name, r.h}] = r.lse;
    }

    std::vector<Row> rows;
    const double reach_h = 10.0 * result["reference"]["reaction"]["error_h"].get<double>();
    std::map<std::string, std::vector<std::pair<double, const Run*>>> lines;
    for (const Run& r : runs) {
        Json row{{"element", r.element->name}, {"h_mm", r.h},         {"steps", r.steps},        {"delta", r.delta},
                 {"primal_dofs", r.primal},    {"dual_dofs", r.dual}, {"complete", r.complete()}};
        if (!r.complete()) {
            row["note"] = "stopped by the cap";
            result["rows"].push_back(row);
            continue;
        }
        const double lse = median(r.seconds) / unit[{r.element->name, r.h}];
        const Curve f = reaction_curve(r.analysis);
        const Curve d = dissipation_curve(r.analysis);
        const Analysis& same = mesh_reference.at(r.steps).analysis;
        const double error = distance(f, reaction_curve(reference.analysis));
        const double error_h = distance(f, reaction_curve(same));
        const double dissipated = distance(d, dissipation_curve(reference.analysis));
        const double dissipated_h = distance(d, dissipation_curve(same));
        row["seconds"] = spread(r.seconds);
        row["setup_s"] = median(r.setup);
        row["factor_s"] = median(r.factor);
        row["iterate_s"] = median(r.iterate);
        row["lse"] = lse;
        row["error_reaction"] = error;
        row["error_reaction_mesh"] = error_h;
        row["error_dissipated"] = dissipated;
        row["error_dissipated_mesh"] = dissipated_h;
        row["within_reach_of_reference"] = error_h >= reach_h;
        row["counts"] = counts(r.analysis);
        result["rows"].push_back(row);
        rows.push_back({r.element->name, number(r.h), std::to_string(r.steps), number(r.delta),
                        std::to_string(r.primal), number(median(r.seconds)), number(lse), number(error, "%.2e"),
                        number(error_h, "%.2e"), number(dissipated, "%.2e"), number(dissipated_h, "%.2e"),
                        error_h < reach_h ? "less than 10 errors of the reference" : ""});
        if (r.steps == line_steps && r.delta == 1e-5) lines[r.element->name].emplace_back(error_h, &r);
    }
    print_rows({"element", "h_mm", "steps", "delta", "DOFs", "seconds", "LSE", "err_F", "err_F_mesh", "err_D",
                "err_D_mesh", "note"},
               rows);
    std::printf("\nreference: %s\n", result["reference"].dump().c_str());

    // Equal error: time of each element to reach the error of quad4 at h = 0.25 mm (quick: 0.5 mm).
    const double anchor_h = settings.quick ? 0.5 : 0.25;
    double target = nan;
    double anchor = nan;
    for (const auto& [error, r] : lines["quad4"]) {
        if (r->h != anchor_h) continue;
        target = error;
        anchor = median(r->seconds);
    }
    if (std::isnan(target)) return result;
    std::printf("\nEqual error (reaction, mesh alone, %d steps): quad4 at h = %.3g mm has %.2e in %.3g s\n", line_steps,
                anchor_h, target, anchor);
    result["equal_error"] = {{"anchor", "quad4"}, {"h_mm", anchor_h}, {"error", target}, {"seconds", anchor}};
    for (const auto& [name, points] : lines) {
        const Meeting m = meet(points, target);
        std::printf("  %-20s h %-8s %-8s s, quad4/this %-8s %s\n", name.c_str(), number(m.h).c_str(),
                    number(m.seconds).c_str(), number(anchor / m.seconds).c_str(), m.note.c_str());
        Json line{{"element", name}, {"note", m.note}};
        if (!std::isnan(m.seconds)) {
            line["h_mm"] = m.h;
            line["seconds"] = m.seconds;
            line["quad4_over_this"] = anchor / m.seconds;
        }
        result["equal_error"]["lines"].push_back(line);
    }
    return result;
}

}  // namespace bench
