// SPDX-License-Identifier: BSD-3-Clause
#include "resolution.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "call.hpp"

namespace cli {

namespace {

constexpr double resolving_pairs = 3.0;
constexpr double small_rotation = 0.1;

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

// Without an onset of its own a law has no process zone.
bool has_onset(const std::string& kind) {
    const std::int64_t count = delam_law_parameter_count(kind.c_str());
    for (std::int64_t i = 0; i < count; ++i) {
        const char* key = "";
        delam_law_parameter_info(kind.c_str(), i, &key, nullptr, nullptr, nullptr, nullptr, nullptr);
        if (std::string_view(key) == "normal_onset") return true;
    }
    return false;
}

bool energetic(const Model& model) {
    const char* solution = delam_problem_option(model.problem.get(), "solution");
    return solution != nullptr && std::string_view(solution) == "energetic";
}

}  // namespace

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

std::vector<std::string> resolution_warnings(const Model& model) {
    std::vector<std::string> out;
    if (energetic(model)) return out;
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const Prediction zone = prediction(model, i);
        if (!(zone.length > 0) || zone.length >= resolving_pairs * zone.spacing) continue;
        out.push_back(fmt::format(
            "interface \"{}\": the process zone, about {:.2g}, is shorter than {:g} pairs of spacing "
            "{:.2g}: a local solution then depends on the mesh; a spacing of {:.2g} would do, or "
            "solution = \"energetic\"",
            model.interfaces[i].name, zone.length, resolving_pairs, zone.spacing, zone.length / resolving_pairs));
    }
    return out;
}

std::vector<std::int64_t> unresolved_steps(const Rows& rows, const Model& model, const Scene& scene) {
    std::vector<std::int64_t> out;
    const auto softens = [&scene](const InterfaceData& data) {
        return !data.bonded && !data.contact && has_onset(scene.laws[data.law].kind);
    };
    if (energetic(model) || std::none_of(model.interfaces.begin(), model.interfaces.end(), softens)) return out;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto best = [&](const char* key) {
            return std::max(number_of(rows[i - 1], key), number_of(rows[i], key));
        };
        const bool grew = number_of(rows[i], "debonded_length") > number_of(rows[i - 1], "debonded_length");
        if (grew && best("energy_release_rate") > 0 && best("process_zone_pairs") < resolving_pairs)
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

std::string rotation_line(double largest) {
    if (!(largest > small_rotation)) return "";
    return fmt::format("warning: cells rotate by up to {:.3g} rad: the error of the strains is about {:.2g}", largest,
                       0.5 * largest * largest);
}

}  // namespace cli
