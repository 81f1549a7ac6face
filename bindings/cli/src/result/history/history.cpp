// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/history.hpp"

#include <algorithm>

#include <string_view>

#include <fmt/format.h>

#include "model/library/call.hpp"
#include "model/sensitivities.hpp"
#include "result/history/concept.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

// Columns that exist if the library has the value.
constexpr const char* where_known[] = {"revisions",   "search_candidates", "search_margin", "search_gap",
                                       "jumps",       "released",          "defect",        "defect_slides",
                                       "mixity_error"};

// Columns of scenes in which an interface may break.
constexpr const char* of_cracks[] = {"crack_length", "energy_release_rate", "front_mixity", "process_zone_pairs"};

// These follow in space, where single points of a front depend on the mesh more than the means along it.
constexpr const char* of_cracks_in_space[] = {"crack_area", "energy_release_rate_mean", "front_mixity_mean",
                                              "process_zone_pairs_mean"};

// Columns of pairs that came apart one by one, in steps that follow their load.
constexpr const char* of_pops[] = {"pops", "popped"};

// Columns of bodies that may buckle, because they rotate.
constexpr const char* of_buckling[] = {"buckling_modes", "buckling_time", "buckling_released"};

constexpr const char* unknown_title = "sensitivities_unknown";

}  // namespace

std::string title_of(const std::string& value, const Scene& scene, std::size_t pattern) {
    return scene.patterns.size() == 1 ? value : value + "_" + scene.patterns[pattern].name;
}

std::string load_title(const Scene& scene, std::size_t pattern) { return title_of("load", scene, pattern); }
std::string reaction_title(const Scene& scene, std::size_t pattern) { return title_of("reaction", scene, pattern); }

History::History(const Model& model, const Scene& scene, const delam_solver* solver)
    : model_(model), scene_(scene), context_(model.context.get()) {
    std::int64_t count = 0;
    call(context_, delam_problem_value_count(model.problem.get(), &count), std::string("history"));
    std::vector<std::string> known, aliases;
    for (std::int64_t i = 0; i < count; ++i) {
        const char *name = "", *alias = "";
        call(context_, delam_problem_value_info(model.problem.get(), i, &name, &alias), std::string("history"));
        known.emplace_back(name);
        if (*alias != '\0') aliases.emplace_back(alias);
    }
    const auto knows = [&](const std::string& key) {
        return std::find(known.begin(), known.end(), key) != known.end() ||
               std::find(aliases.begin(), aliases.end(), key) != aliases.end();
    };

    add("step", "step");
    add("time", "time");
    if (!scene.patterns.empty()) first_load_ = "load:" + scene.patterns.front().name;
    if (scene.patterns.empty()) {
        add("load", "", "0");
        add("reaction", "", "0");
    }
    for (std::size_t p = 0; p < scene.patterns.size(); ++p) {
        add(load_title(scene, p), "load:" + scene.patterns[p].name);
        add(reaction_title(scene, p), "reaction:" + scene.patterns[p].name);
    }
    for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "stored_interface_slides",
                            "dissipated_slides", "work", "lower", "increment", "upper", "increment_lower",
                            "am_iterations", "linear_iterations", "contact_pairs", "debonded_length", "backtracks"})
        add(key, key);
    for (const char* key : where_known)
        if (knows(key)) add(key, key);
    const bool cracks = std::any_of(model.interfaces.begin(), model.interfaces.end(),
                                    [](const InterfaceData& data) { return !data.bonded && !data.contact; });
    if (cracks)
        for (const char* key : of_cracks)
            if (knows(key)) add(key, key);
    const std::vector<Drives> drives = drives_of(scene);
    const bool leaves = std::any_of(scene.prescriptions.begin(), scene.prescriptions.end(),
                                    [](const Prescription& data) { return data.end.has_value(); });
    if (leaves || std::find(drives.begin(), drives.end(), Drives::force) != drives.end())
        add("load_potential", "load_potential");
    for (const std::string& key : scene.output.columns) {
        const std::optional<AverageColumn> average = average_column(key, scene);
        if (average) averages_[key] = *average;
        if (!knows(key) && !average)
            throw SceneFailure(
                scene.output.columns_place,
                fmt::format("\"{}\": no such value{}; one of {}, strain_xx or stress_xx (any component) and with :{} "
                            "behind it{}",
                            key, suggestion(key, known), listing(known), scene.mesh ? "BODY" : "LAYER",
                            scene.cell ? ", cell_strain_xx, cell_stress_xx (strains along its periods)" : ""));
        if (!has(key)) add(key, key);
    }
    const std::vector<LawNumber> numbers = sensitivities_of(model, scene);
    followed_ = numbers.size();
    for (std::size_t k = 0; k < numbers.size(); ++k)
        for (std::size_t p = 0; p < scene.patterns.size(); ++p) {
            const std::string title = reaction_title(scene, p) + "/" + numbers[k].path;
            sensitivities_[title] = p * numbers.size() + k;
            add(title, title);
        }
    if (!numbers.empty()) add(unknown_title, unknown_title);
    // Words after the numbers: a row that is copied elsewhere still states its solution concept.
    for (const auto& [key, value] : concept_of(model.problem.get()))
        if (key == "solution" || key == "mixity_rule") add(key, "", value);
    // Columns keep their order for ever, so that these came to the end.
    if (cracks && scene.geometry.dimension == 3)
        for (const char* key : of_cracks_in_space)
            if (knows(key) && !has(key)) add(key, key);
    const std::string control = solver != nullptr ? option_text(solver, "step_control") : "";
    if (cracks && control == "load")
        for (const char* key : of_pops)
            if (knows(key) && !has(key)) add(key, key);
    // The problem tells, for a solver of `auto` has small rotations until it turns.
    const char* kinematics = delam_problem_option(model.problem.get(), "kinematics");
    if (solver != nullptr && kinematics != nullptr && std::string_view(kinematics) != "linear")
        for (const char* key : of_buckling)
            if (knows(key) && !has(key)) add(key, key);
}

bool History::has(const std::string& key) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) { return column.key == key; });
}

void History::add(const std::string& title, const std::string& key, const std::string& text) {
    columns_.push_back({title, key, text});
}

std::string History::header() const {
    std::string out;
    for (const Column& column : columns_) out += (out.empty() ? "" : ",") + column.title;
    return out + "\n";
}

void History::go_on_under(std::string_view header) {
    const auto later = [](const std::string& key) {
        return std::ranges::count(of_cracks_in_space, key) + std::ranges::count(of_pops, key) +
                   std::ranges::count(of_buckling, key) >
               0;
    };
    History older = *this;
    while (older.header() != header && !older.columns_.empty() && later(older.columns_.back().key))
        older.columns_.pop_back();
    if (older.header() == header) columns_ = older.columns_;
}

double History::value(delam_solver* solver, const std::string& key) const {
    double out = 0;
    if (const auto average = averages_.find(key); average != averages_.end())
        return average_of(model_, scene_, solver, average->second);
    if (const auto found = sensitivities_.find(key); found != sensitivities_.end())
        return read_sensitivities(model_, solver, followed_).matrix[found->second];
    if (key == unknown_title && followed_ > 0)
        return static_cast<double>(read_sensitivities(model_, solver, followed_).unknown);
    if (!key.empty()) call(context_, delam_solver_value(solver, key.c_str(), &out), "value " + key);
    return out;
}

std::string History::row(delam_solver* solver) const {
    std::string out;
    for (const auto& [title, key, text] : columns_) {
        if (!out.empty()) out += ',';
        if (key.empty()) {
            out += text;
            continue;
        }
        const double number = value(solver, key) + 0.0;  // turns -0 into 0
        out += fmt::format("{:.17g}", number);           // a count has neither exponent nor fraction
    }
    return out + "\n";
}

double History::load(delam_solver* solver) const { return value(solver, first_load_); }

}  // namespace cli
