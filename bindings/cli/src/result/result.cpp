// SPDX-License-Identifier: BSD-3-Clause
#include "result/result.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <nlohmann/json.hpp>

#include "model/build_constraints.hpp"
#include "model/library/call.hpp"
#include "result/history/concept.hpp"

namespace cli {

namespace {

using Json = nlohmann::ordered_json;

Json options(const delam_solver* solver) {
    Json out = Json::object();
    for (const auto& [key, value] : options_of(solver))
        std::visit([&out, &key = key](const auto& v) { out[key] = v; }, value);
    return out;
}

Json jumps_json(const std::vector<Jump>& jumps, const Scene& scene) {
    double released = 0.0;
    double debonded = 0.0;
    for (const Jump& jump : jumps) {
        released += jump.released;
        debonded += jump.debonded;
    }
    Json largest = Json::array();
    for (const Jump& jump : largest_jumps(jumps)) {
        Json loads = Json::object();
        Json reactions = Json::object();
        for (std::size_t p = 0; p < jump.loads.size(); ++p) {
            loads[scene.patterns[p].name] = jump.loads[p];
            reactions[scene.patterns[p].name] = {{"before", jump.reaction_before[p]},
                                                 {"after", jump.reaction_after[p]}};
        }
        largest.push_back({{"step", jump.step},
                           {"time", jump.time},
                           {"loads", loads},
                           {"reactions", reactions},
                           {"interface", jump.interface},
                           {"name", jump.name},
                           {"debonded", jump.debonded},
                           {"dissipated", jump.dissipated},
                           {"released", jump.released}});
    }
    return {{"count", jumps.size()}, {"released", released}, {"debonded", debonded}, {"largest", largest}};
}

Json balance_json(const Balance& balance) {
    return {{"relative", balance.relative()},
            {"step", balance.step},
            {"time", balance.time},
            {"defect", balance.defect},
            {"last_defect", balance.last_defect},
            {"work", balance.work},
            {"last_work", balance.last_work},
            {"stored", balance.stored},
            {"dissipated", balance.dissipated},
            {"released", balance.released}};
}

Json mixity_error_json(const MixityError& error) {
    return {{"relative", error.relative}, {"step", error.step}, {"time", error.time}, {"dissipated", error.dissipated}};
}

Json mesh_error_json(const MeshError& error) {
    if (!std::isfinite(error.away)) return nullptr;
    return {{"error", error.away},
            {"fronts", error.fronts},
            {"excess", error.excess},
            {"step", error.step},
            {"time", error.time}};
}

Json small_rotations_json(const SmallRotations& small) {
    if (!small.assumed) return nullptr;
    const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
    return {{"error", number(small.error)}, {"buckling_ratio", number(small.buckling)}};
}

Json load_drops_json(const LoadDrops& drops) {
    if (drops.steps.empty()) return {{"steps", Json::array()}, {"largest", nullptr}};
    return {{"steps", drops.steps},
            {"largest",
             {{"step", drops.step},
              {"time", drops.time},
              {"column", drops.column},
              {"from", drops.from},
              {"to", drops.to}}}};
}

Json buckling_json(const std::vector<BuckledStep>& steps) {
    Json out = Json::array();
    for (const BuckledStep& step : steps)
        out.push_back({{"step", step.step},
                       {"modes", step.modes},
                       {"time", step.time},
                       {"load", step.load},
                       {"released", step.released}});
    return out;
}

Json free_bodies_json(const std::vector<FreeBody>& bodies) {
    Json out = Json::array();
    for (const FreeBody& body : bodies)
        out.push_back({{"name", body.name}, {"since", body.since}, {"axes", body.axes}, {"turns", body.turns}});
    return out;
}

// Infinite gaps become null.
Json search_json(const SearchLimits& limits) {
    Json gap = nullptr;
    if (!limits.gap_steps.empty())
        gap = {
            {"step", limits.gap_step}, {"time", limits.gap_time}, {"gap", limits.gap}, {"allowed", limits.gap_allowed}};
    Json margin = nullptr;
    if (!limits.margin_steps.empty())
        margin = {{"step", limits.margin_step}, {"time", limits.margin_time}, {"margin", limits.margin}};
    return {{"gap_steps", limits.gap_steps},
            {"largest_gap", gap},
            {"margin_steps", limits.margin_steps},
            {"largest_margin", margin}};
}

const char* name_of(Drives drives) {
    switch (drives) {
        case Drives::force:
            return "force";
        case Drives::strain:
            return "strain";
        case Drives::displacement:
            break;
    }
    return "displacement";
}

// The names of the scene, and the units in which pictures may show its numbers (text/unit.hpp).
Json units_json(const Units& units) {
    Json scales = Json::object();
    for (const Quantity quantity : all_quantities) {
        Json& list = scales[quantity_name(quantity)] = Json::array();
        for (const Scale& scale : scales_of(quantity, units.names))
            list.push_back({{"factor", scale.factor}, {"name", scale.name}});
    }
    return {{"length", units.names.length}, {"force", units.names.force}, {"time", units.time}, {"scales", scales}};
}

// Returns, for a periodic cell, its volume, and d2 E / d factor2 divided by it at the last state, at fixed adhesion and
// contact. If each pattern drives one strain with coefficient 1, these are the moduli.
Json cell_of(const Model& model, delam_solver* solver, const Scene& scene, bool complete) {
    if (!scene.cell) return nullptr;
    const double volume = cell_volume(model, scene);
    Json names = Json::array();
    for (const PatternData& pattern : scene.patterns) names.push_back(pattern.name);
    const std::size_t n = scene.patterns.size(), all = pattern_count(model);
    std::vector<double> matrix(all * all);
    Json rows = nullptr;
    // If a stress acts on a part that nothing holds any more, there is no tangent; a result must not be lost for that.
    if (complete && delam_solver_tangent(solver, static_cast<std::int64_t>(matrix.size()), matrix.data()) == DELAM_OK) {
        rows = Json::array();
        for (std::size_t p = 0; p < n; ++p) {
            Json row = Json::array();
            for (std::size_t q = 0; q < n; ++q) row.push_back(matrix[p * all + q] / volume);
            rows.push_back(std::move(row));
        }
    }
    return {{"volume", volume}, {"periods", scene.cell->periods}, {"tangent_patterns", names}, {"tangent", rows}};
}

}  // namespace

std::string now_text() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

std::string hash_of(const Model& model) {
    char text[17] = {};
    call(model.context.get(), delam_problem_hash(model.problem.get(), text), std::string("hash of the scene"));
    return text;
}

std::string result_text(const Model& model, delam_solver* solver, const Scene& scene, const Outcome& outcome) {
    std::int64_t primal = 0;
    std::int64_t dual = 0;
    call(model.context.get(), delam_problem_dofs(model.problem.get(), &primal, &dual),
         std::string("numbers of unknowns"));
    Json patterns = Json::array();
    const std::vector<Drives> drives = drives_of(scene);
    for (std::size_t i = 0; i < scene.patterns.size(); ++i)
        patterns.push_back({{"name", scene.patterns[i].name}, {"drives", name_of(drives[i])}});
    Json files = Json::object();
    for (const auto& [name, content] : outcome.files) files[name] = {{"bytes", content.bytes}, {"hash", content.hash}};
    Json layers = Json::array();
    for (const Layer& layer : scene.layers) layers.push_back(layer.name);
    Json named = Json::object();
    for (const auto& [key, value] : concept_of(solver)) named[key] = value;
    const Json out{
        {"program", "delam"},
        {"version", delam_version()},
        {"commit", delam_commit()},
        {"abi", delam_abi()},
        {"status", outcome.complete ? "complete" : "incomplete"},
        {"reason", outcome.reason},
        {"concept", named},
        {"steps_done", outcome.steps_done},
        {"steps", scene.step_count()},
        {"not_converged", outcome.not_converged},
        {"warnings", outcome.warnings},
        {"closing", outcome.closing_lines},
        {"jumps", jumps_json(outcome.closing.jumps, scene)},
        {"energy_balance", balance_json(outcome.closing.balance)},
        {"mixity_error", mixity_error_json(outcome.closing.mixity_error)},
        {"load_drops", load_drops_json(outcome.closing.load_drops)},
        {"buckling", buckling_json(outcome.closing.buckled)},
        {"search", search_json(outcome.closing.search)},
        {"estimate_violated", outcome.closing.estimate_violated},
        {"estimate_hollow", outcome.closing.estimate_inconclusive},
        {"front_unresolved", outcome.closing.front_unresolved},
        {"energy_release_rate_over_toughness",
         outcome.closing.waiting.times > 0 ? Json(outcome.closing.waiting.times) : Json(nullptr)},
        {"pops", {{"pairs", outcome.closing.pops.pairs}, {"released", outcome.closing.pops.released}}},
        {"free_bodies", free_bodies_json(outcome.closing.free_bodies)},
        {"rotation_max", outcome.closing.bulk.rotation_max},
        {"small_rotations", small_rotations_json(outcome.closing.small)},
        {"mesh_error", mesh_error_json(outcome.closing.bulk.mesh_error)},
        {"scene",
         {{"file", scene.file},
          {"title", scene.title},
          {"schema", 1},
          {"dimension", scene.geometry.dimension},
          {"shortest_edge", scene.geometry.smallest_edge},
          {"settings", scene.settings}}},
        {"scene_hash", outcome.problem_hash},
        {"scene_file_hash", scene.file_hash},
        {"scene_content_hash", scene.content_hash},
        {"options", options(solver)},
        {"unknowns", {{"primal", primal}, {"dual", dual}}},
        {"layers", layers},
        {"patterns", patterns},
        {"cell", cell_of(model, solver, scene, outcome.complete)},
        {"output",
         {{"snapshots", scene.output.snapshots},
          {"displacement_scale", scene.output.displacement_scale},
          {"fields", scene.output.fields}}},
        {"units", units_json(scene.units)},
        {"command", outcome.command},
        {"started", outcome.started},
        {"ended", now_text()},
        {"resumed", outcome.resumed},
        {"plan", delam_solver_plan(solver)},
        {"searched", delam_solver_searched(solver)},
        {"files", files},
    };
    return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cli
