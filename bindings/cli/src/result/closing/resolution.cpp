// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/resolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "model/build.hpp"
#include "model/library/call.hpp"
#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr double resolving_pairs = 3.0;
constexpr double told_pops = 0.01;  // of the work
// Times the toughness: cracks that grow in resolved zones have an energy release rate of it within some per cent.
constexpr double told_times = 1.25;
constexpr double stiffest =
    100.0;  // times the least: a further digit of the layer's stiffness is not worth its rounding

struct Prediction {
    double length = 0;  // 0: nothing softens
    double spacing = 0;
};

Prediction prediction(const Model& model, std::size_t index) {
    Prediction out;
    call(model.context.get(),
         delam_problem_process_zone(model.problem.get(), static_cast<std::int64_t>(index), &out.length, &out.spacing),
         std::string("process zone"));
    return out;
}

// A law without an onset of its own has no process zone.
bool has_onset(const std::string& kind) {
    const std::int64_t count = delam_law_parameter_count(kind.c_str());
    for (std::int64_t i = 0; i < count; ++i) {
        const char* key = "";
        delam_law_parameter_info(kind.c_str(), i, &key, nullptr, nullptr, nullptr, nullptr, nullptr);
        if (std::string_view(key) == "normal_onset") return true;
    }
    return false;
}

// Rounds to three digits, so that a proposal still holds when it is pasted.
double rounded(double value, double (*towards)(double)) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
    return towards(value / unit) * unit;
}
double rounded_down(double value) {
    return rounded(value, [](double x) { return std::floor(x); });
}
double rounded_up(double value) {
    return rounded(value, [](double x) { return std::ceil(x); });
}

bool energetic(const Model& model) {
    const char* solution = delam_problem_option(model.problem.get(), "solution");
    return solution != nullptr && std::string_view(solution) == "energetic";
}

}  // namespace

bool any_softens(const Model& model, const Scene& scene) {
    return std::any_of(model.interfaces.begin(), model.interfaces.end(), [&scene](const InterfaceData& data) {
        return !data.bonded && !data.contact && has_onset(scene.laws[data.law].kind);
    });
}

std::vector<std::string> process_zones(const Model& model) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const Prediction zone = prediction(model, i);
        if (zone.length > 0 && zone.spacing > 0)
            out.push_back(fmt::format("\"{}\", about {:.3g}, {:.2g} pairs of spacing {:.3g}", model.interfaces[i].name,
                                      zone.length, zone.length / zone.spacing, zone.spacing));
    }
    return out;
}

namespace {

// The requirements of all interfaces of a law together.
struct Needs {
    std::vector<std::string> interfaces;
    double stiffness = 0, share = 1;
    std::array<double, 2> strength{};
    double pairs = 0;  // in the shortest process zone; 0: none is predicted
};

void add(double& least, double value) {
    if (value > 0) least = least > 0 ? std::min(least, value) : value;
}

Needs needs_of(const Model& model, std::size_t law) {
    Needs out;
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        if (data.bonded || data.contact || data.law != law) continue;
        double stiffness = 0, share = 0, normal = 0, tangential = 0;
        call(model.context.get(),
             delam_problem_propose(model.problem.get(), static_cast<std::int64_t>(i), resolving_pairs, &stiffness,
                                   &share, &normal, &tangential),
             std::string("proposal"));
        out.interfaces.push_back(data.name);
        out.stiffness = std::max(out.stiffness, stiffness);
        add(out.share, share);
        add(out.strength[0], normal);
        add(out.strength[1], tangential);
        const Prediction zone = prediction(model, i);
        if (zone.spacing > 0) add(out.pairs, zone.length / zone.spacing);
    }
    return out;
}

Advice advice_for(const Model& model, const LawData& law, const Needs& needs) {
    Advice out{law.name, needs.interfaces, {}, ""};
    const double own = law_number(law, "normal_stiffness");
    const bool unresolved = !energetic(model) && needs.pairs > 0 && needs.pairs < resolving_pairs;
    const bool apart = needs.stiffness > 0 && (own < needs.stiffness || own > stiffest * needs.stiffness);
    if (apart) {
        for (const char* key : {"normal_stiffness", "tangential_stiffness"})
            out.keys.emplace_back(key, rounded_up(needs.stiffness));
        out.reason = fmt::format(
            "50 E3/t of the adjacent layer, which then keeps 98 % of its stiffness instead of "
            "{:.3g} % (Turon et al. 2007; in range up to {:.2g})",
            100 * needs.share, stiffest * needs.stiffness);
    }
    // Another stiffness would change the peaks of a law with given onsets.
    const bool onsets = law_number(law, "normal_onset") + law_number(law, "tangential_onset") +
                            law_number(law, "second_tangential_onset") >
                        0;
    if (!unresolved && !(apart && onsets)) return out;
    for (const auto& [name, mode] :
         {std::pair(std::string("normal"), std::size_t{0}), std::pair(std::string("tangential"), std::size_t{1}),
          std::pair(std::string("second_tangential"), std::size_t{1})}) {
        const double peak = law_peak(law, name);
        if (!(peak > 0)) continue;
        const bool lower = unresolved && needs.strength[mode] < peak;
        out.keys.emplace_back(name + "_strength", lower ? rounded_down(needs.strength[mode]) : peak);
    }
    if (unresolved)
        out.reason += fmt::format(
            "{}{:g} pairs in the process zone instead of {:.2g}: damage then begins at a lower "
            "load, but cracks grow at the same, which follows from the toughness",
            out.reason.empty() ? "" : "; ", resolving_pairs, needs.pairs);
    else
        out.reason += "; the strengths are those of now";
    return out;
}

}  // namespace

std::vector<Advice> advice(const Model& model, const Scene& scene) {
    std::vector<Advice> out;
    for (std::size_t law = 0; law < scene.laws.size(); ++law) {
        const Needs needs = needs_of(model, law);
        if (needs.interfaces.empty()) continue;
        Advice one = advice_for(model, scene.laws[law], needs);
        if (!one.keys.empty()) out.push_back(std::move(one));
    }
    return out;
}

std::vector<std::int64_t> unresolved_steps(const Rows& rows, const Model& model, const Scene& scene) {
    std::vector<std::int64_t> out;
    if (energetic(model) || !any_softens(model, scene)) return out;
    // In space the mean along the fronts; histories of earlier versions have that of one point alone.
    const bool means = !rows.empty() && rows.front().contains("process_zone_pairs_mean");
    const char* pairs = means ? "process_zone_pairs_mean" : "process_zone_pairs";
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto best = [&](const char* key) {
            return std::max(number_of(rows[i - 1], key), number_of(rows[i], key));
        };
        const bool grew = number_of(rows[i], "debonded_length") > number_of(rows[i - 1], "debonded_length");
        if (grew && best("energy_release_rate") > 0 && best(pairs) < resolving_pairs)
            out.push_back(static_cast<std::int64_t>(number_of(rows[i], "step")));
    }
    return out;
}

std::string unresolved_line(const std::vector<std::int64_t>& steps) {
    if (steps.empty()) return "";
    return fmt::format(
        "warning: in {} (the first is step {}) a crack grew with fewer than {:g} pairs in its process zone: the load "
        "and the length of its growth depend on the mesh",
        steps.size() == 1 ? "1 step" : fmt::format("{} steps", steps.size()), steps.front(), resolving_pairs);
}

Waiting waiting_of(const Rows& rows, const Model& model, const Scene& scene) {
    Waiting out;
    if (energetic(model)) return out;
    constexpr int parts = 20;  // of the modes between opening and shear, of which one may be the toughest
    std::vector<double> mixities(parts + 1);
    for (std::size_t k = 0; k < mixities.size(); ++k) mixities[k] = static_cast<double>(k) / parts;
    for (const InterfaceData& data : model.interfaces) {
        if (data.bonded || data.contact) continue;
        const LawData& law = scene.laws[data.law];
        for (const LawData& along : {law, with_second_shear(law)}) {  // either shear
            std::vector<double> onset(mixities.size()), total(mixities.size());
            call(model.context.get(),
                 delam_law_toughness(law_of(model, along).get(), static_cast<std::int64_t>(mixities.size()),
                                     mixities.data(), onset.data(), total.data()),
                 std::string("toughness"));
            out.toughness = std::max(out.toughness, *std::max_element(total.begin(), total.end()));
        }
    }
    const bool means = !rows.empty() && rows.front().contains("energy_release_rate_mean");
    for (std::size_t i = 1; i < rows.size(); ++i) {  // the initial state is not minimised
        const Row& row = rows[i];
        const double rate = number_of(row, means ? "energy_release_rate_mean" : "energy_release_rate");
        if (!(out.toughness > 0) || !(rate > told_times * out.toughness) || !(rate > out.rate)) continue;
        out.step = static_cast<std::int64_t>(number_of(row, "step"));
        out.time = number_of(row, "time");
        out.rate = rate;
        out.times = rate / out.toughness;
    }
    return out;
}

std::string waiting_line(const Waiting& waiting, const Scene& scene) {
    if (!(waiting.times > 0)) return "";
    return fmt::format(
        "warning: the energy release rate of a crack is up to {:.2g} times the largest toughness ({}; {}): its growth "
        "waits until the spring of one pair holds the toughness, at a load that depends on the mesh and the stiffness: "
        "give the law strengths that the mesh resolves, or take solution = \"energetic\"",
        waiting.times, release_rate_text(waiting.rate, scene), instant_text(waiting.step, waiting.time));
}

Pops pops_of(const Rows& rows, bool softening) {
    Pops out;
    out.softening = softening;
    for (const Row& row : rows) {
        out.pairs += static_cast<std::int64_t>(number_of(row, "pops"));
        out.released += number_of(row, "popped");
        out.work = std::max(out.work, std::abs(number_of(row, "work")));
    }
    return out;
}

std::string pops_line(const Pops& pops) {
    if (!(pops.released > told_pops * pops.work)) return "";
    return fmt::format(
        "warning: {} popped one by one and released {} of the work: the mesh does not resolve the process zone ({})",
        counted(pops.pairs, "pair"), percent_text(pops.released / pops.work),
        pops.softening ? "use smaller cells or less strength, which `delam check` proposes"
                       : "a law that does not soften has none: use one with strengths");
}

}  // namespace cli
