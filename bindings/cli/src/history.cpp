// SPDX-License-Identifier: BSD-3-Clause
#include "history.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "call.hpp"
#include "reader.hpp"

namespace cli {

namespace {
// Counted, so written without exponent or fraction; still exact as a double.
constexpr const char* counts[] = {"step",          "am_iterations", "linear_iterations",  "contact_iterations",
                                  "contact_pairs", "backtracks",    "displacement_solves"};
}  // namespace

History::History(const Model& model, const delam_solver* solver, const Scene& scene) : context_(model.context.get()) {
    const auto same = [this](const char* key) { columns_.emplace_back(key, key); };
    same("step");
    same("time");
    if (!scene.patterns.empty()) first_load_ = "load:" + scene.patterns.front().name;
    if (scene.patterns.empty()) {
        columns_.emplace_back("load", "");
        columns_.emplace_back("reaction", "");
    } else if (scene.patterns.size() == 1) {
        columns_.emplace_back("load", first_load_);
        columns_.emplace_back("reaction", "reaction:" + scene.patterns.front().name);
    } else {
        for (const PatternData& pattern : scene.patterns) {
            columns_.emplace_back("load_" + pattern.name, "load:" + pattern.name);
            columns_.emplace_back("reaction_" + pattern.name, "reaction:" + pattern.name);
        }
    }
    for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "stored_interface_slides",
                            "dissipated_slides", "work", "lower", "increment", "upper", "increment_lower",
                            "am_iterations", "linear_iterations", "contact_pairs", "debonded_length", "backtracks"})
        same(key);
    if (!scene.forces.empty()) same("load_potential");

    std::int64_t count = 0;
    call(context_, delam_solver_value_count(solver, &count), std::string("history"));
    std::vector<std::string> known;
    for (std::int64_t i = 0; i < count; ++i)
        if (const char* name = delam_solver_value_name(solver, i)) known.emplace_back(name);
    for (const std::string& key : scene.output.columns) {
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw SceneFailure(
                {scene.output.place.file, scene.output.place.path + ".columns", scene.output.place.line},
                fmt::format("\"{}\": no such value{}; one of {}", key, suggestion(key, known), listing(known)));
        const auto same_key = [&key](const auto& column) { return column.second == key; };
        if (std::none_of(columns_.begin(), columns_.end(), same_key)) columns_.emplace_back(key, key);
    }
}

std::string History::header() const {
    std::string out;
    for (const auto& [title, key] : columns_) out += (out.empty() ? "" : ",") + title;
    return out + "\n";
}

double History::value(delam_solver* solver, const std::string& key) const {
    double out = 0;
    if (!key.empty()) call(context_, delam_solver_value(solver, key.c_str(), &out), "value " + key);
    return out;
}

std::string History::row(delam_solver* solver) const {
    std::string out;
    for (const auto& [title, key] : columns_) {
        if (!out.empty()) out += ',';
        const double number = value(solver, key) + 0.0;  // no -0
        const bool counted = std::find(std::begin(counts), std::end(counts), key) != std::end(counts);
        out += counted ? fmt::format("{:.0f}", number) : fmt::format("{:.17g}", number);
    }
    return out + "\n";
}

double History::load(delam_solver* solver) const { return value(solver, first_load_); }

}  // namespace cli
