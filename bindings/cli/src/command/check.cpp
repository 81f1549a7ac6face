// SPDX-License-Identifier: BSD-3-Clause
// `delam check`: finds out what would be computed as one JSON object, which is printed as it is or in lines for people.
#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/drawing.hpp"
#include "command/interrupt.hpp"
#include "model/build.hpp"
#include "model/library/call.hpp"
#include "model/library/named.hpp"
#include "model/notes.hpp"
#include "result/closing/resolution.hpp"
#include "result/history/concept.hpp"
#include "result/history/history.hpp"
#include "result/result.hpp"
#include "scene/read_scene.hpp"
#include "scene/units/magnitudes.hpp"
#include "text/refusals.hpp"
#include "text/say.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

using Found = nlohmann::ordered_json;

// The bodies of a mesh with their cells, and its sets.
void find_mesh(const MeshData& mesh, const Scene& scene, Found& found) {
    std::vector<std::int64_t> cells(mesh.body_names.size());
    for (const CellBlock& block : mesh.blocks)
        for (const std::int32_t body : block.bodies) ++cells[static_cast<std::size_t>(body)];
    for (std::size_t i = 0; i < cells.size(); ++i)
        found["bodies"].push_back({{"name", mesh.body_names[i]},
                                   {"cells", cells[i]},
                                   {"material", scene.materials[scene.layers[i].material].name},
                                   {"formulation", scene.layers[i].formulation}});
    for (const auto& [name, nodes] : mesh.node_sets) {
        const auto faces = mesh.face_sets.find(name);
        found["sets"].push_back({{"name", name},
                                 {"nodes", nodes.size()},
                                 {"faces", faces == mesh.face_sets.end() ? 0 : faces->second.size()}});
    }
}

void find_interfaces(const Scene& scene, const Model& model, Found& found) {
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        std::int64_t pairs = 0;
        call(model.context.get(),
             delam_mesh_interface_size(model.mesh.get(), static_cast<std::int64_t>(i), nullptr, nullptr, &pairs,
                                       nullptr, nullptr),
             data.place);
        Found entry{{"name", data.name}, {"pairs", pairs}};
        entry["kind"] = data.bonded ? "bonded" : data.contact ? "contact" : "law";
        if (!data.bonded && !data.contact) entry["law"] = scene.laws[data.law].name;
        entry["regions"] = data.regions.size();
        found["interfaces"].push_back(std::move(entry));
    }
}

// Solvers whose factorisations take longer than this, s at the nominal rate, are planned, not built.
constexpr double short_setup = 2.0;

struct Planned {
    std::string text;
    double setup = 0.0, memory = 0.0;  // s, byte
    bool converged = true;
};

// Returns the seconds that the plan predicts for this subject: the cost of the item, which ends its line; 0 without
// one.
double seconds_of(const std::string& plan, const std::string& subject) {
    const std::size_t line = plan.find(subject + ": used");
    if (line == std::string::npos) return 0.0;
    const std::size_t cost = plan.rfind("(cost ", plan.find('\n', line));
    return cost == std::string::npos || cost < line ? 0.0 : std::strtod(plan.c_str() + cost + 6, nullptr);
}

// A small scene is solved at its initial state, which finds what a plan cannot.
Planned plan(const Model& model, const Scene& scene) {
    const char* text = "";
    Planned planned;
    double& setup = planned.setup;
    call(model.context.get(), delam_problem_plan(model.problem.get(), &text, &setup, &planned.memory),
         {scene.file, "", 0});
    planned.text = text;
    if (setup > short_setup) {
        planned.text += fmt::format(
            "initial state: left out, its factorisations are predicted to take {:.2g} s; delam run computes it\n",
            setup);
        return planned;
    }
    const Solver solver = new_solver(model, scene, nullptr, planned.converged);
    planned.text = delam_solver_plan(solver.get());
    return planned;
}

// Everything but the plan.
Found find(const std::string& scene_file, const Scene& scene, const Model& model) {
    std::int64_t primal = 0, dual = 0, constraints = 0, entries = 0, patterns = 0;
    const delam_problem* problem = model.problem.get();
    call(model.context.get(), delam_problem_dofs(problem, &primal, &dual), std::string("numbers of unknowns"));
    call(model.context.get(),
         delam_problem_constraints(problem, &constraints, &entries, &patterns, nullptr, nullptr, nullptr, nullptr),
         std::string("constraints"));
    Found found{{"correct", true}, {"file", scene_file}, {"title", scene.title}};
    for (const auto& [option, value] : concept_of(problem)) found["concept"][option] = value;
    found["scene_hash"] = hash_of(model);
    found["unknowns"] = {{"primal", primal}, {"dual", dual}};
    for (const char* list :
         {"bodies", "sets", "interfaces", "patterns", "process_zones", "proposals", "plan", "notes", "warnings"})
        found[list] = Found::array();
    if (scene.mesh) find_mesh(*scene.mesh, scene, found);
    for (const Layer& layer : scene.mesh ? std::vector<Layer>{} : scene.layers)
        found["bodies"].push_back(
            {{"name", layer.name}, {"thickness", layer.thickness}, {"material", scene.materials[layer.material].name}});
    find_interfaces(scene, model, found);
    found["prescribed_displacements"] = constraints;
    for (const PatternData& pattern : scene.patterns)
        found["patterns"].push_back({{"name", pattern.name},
                                     {"instants", pattern.times.size()},
                                     {"from", pattern.times.front()},
                                     {"to", pattern.times.back()}});
    found["time"] = {{"from", scene.times.front()}, {"to", scene.times.back()}, {"steps", scene.step_count()}};
    found["process_zones"] = process_zones(model);
    for (const Advice& one : advice(model, scene)) {
        Found keys = Found::object();
        for (const auto& [key, value] : one.keys) keys[key] = value;
        found["proposals"].push_back(
            {{"law", one.law}, {"interfaces", one.interfaces}, {"keys", keys}, {"reason", one.reason}});
    }
    found["units"] = {{"length", scene.units.names.length}, {"force", scene.units.names.force}};
    if (const UnitsFound units = units_found(scene); units.proposed)
        found["units"]["proposed"] = {
            {"length", units.proposed->length}, {"force", units.proposed->force}, {"reason", units.reason}};
    found["notes"] = notes_of(scene);
    return found;
}

constexpr std::size_t plan_width = 120;  // columns: a window beside an editor has as many

// "body" or "layer", with everything that is known of it.
void say_bodies(const Found& found) {
    for (const Found& body : found["bodies"]) {
        const auto text = [&](const char* key) { return body[key].get<std::string>(); };
        if (body.contains("cells"))
            say("body        \"{}\", {}, material \"{}\", formulation {}\n", text("name"),
                counted(body["cells"], "cell"), text("material"), text("formulation"));
        else
            say("layer       \"{}\", thickness {}, material \"{}\"\n", text("name"), body["thickness"].get<double>(),
                text("material"));
    }
    for (const Found& set : found["sets"])
        say("set         \"{}\", {}{}\n", set["name"].get<std::string>(), counted(set["nodes"], "node"),
            set["faces"] == 0 ? "" : ", " + counted(set["faces"], "face"));
}

// Says what an analysis takes, in the words of those who run it.
void say_effort(const Found& effort) {
    const auto seconds = effort["seconds"].get<double>();
    const double mebibytes = effort["bytes"].get<double>() / 1048576.0;
    const std::string time = seconds < 120    ? fmt::format("{:.2g} s", seconds)
                             : seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60)
                                              : fmt::format("{:.2g} h", seconds / 3600);
    const std::string memory =
        mebibytes < 1024 ? fmt::format("{:.0f} MiB", mebibytes) : fmt::format("{:.3g} GiB", mebibytes / 1024);
    say("effort      about {} and {} of memory (predicted as if half of the interfaces broke; searches, jumps and "
        "large rotations take longer)\n",
        time, memory);
}

void say_plan(const Found& plan) {
    say("\nHow it is computed (nothing to be done about): what the method uses and leaves out, why, and what that "
        "costs or saves.\n\n");
    for (const Found& line : plan) say("{}\n", wrapped(line.get<std::string>(), plan_width));
}

void say_lines_of(const Found& found) {
    const auto text = [](const Found& of, const char* key) { return of[key].get<std::string>(); };
    say("{}: correct\n", text(found, "file"));
    if (!text(found, "title").empty()) say("title       {}\n", text(found, "title"));
    Concept chosen;
    for (const auto& [option, value] : found["concept"].items()) chosen.emplace_back(option, value.get<std::string>());
    say("concept     {}\n", concept_text(chosen));
    say("scene hash  {}\n", text(found, "scene_hash"));
    say("unknowns    {} primal, {} dual\n", found["unknowns"]["primal"].get<std::int64_t>(),
        found["unknowns"]["dual"].get<std::int64_t>());
    say_bodies(found);
    for (const Found& interface : found["interfaces"]) {
        const std::string kind = text(interface, "kind");
        say("interface   \"{}\", {}, {}, {} with adhesion of their own\n", text(interface, "name"),
            counted(interface["pairs"], "pair"),
            kind == "bonded"    ? "bonded permanently"
            : kind == "contact" ? "contact without adhesion"
                                : "law \"" + text(interface, "law") + "\"",
            counted(interface["regions"], "region"));
    }
    say("supports    {} (supports and loads)\n", counted(found["prescribed_displacements"], "prescribed displacement"));
    for (const Found& pattern : found["patterns"])
        say("pattern     \"{}\", {} from {} to {}\n", text(pattern, "name"), counted(pattern["instants"], "instant"),
            pattern["from"].get<double>(), pattern["to"].get<double>());
    say("time        {} to {} in {}\n", found["time"]["from"].get<double>(), found["time"]["to"].get<double>(),
        counted(found["time"]["steps"], "step"));
    for (const Found& zone : found["process_zones"]) say("zone        {}\n", zone.get<std::string>());
    for (const Found& proposal : found["proposals"]) {
        std::vector<std::string> keys;
        for (const auto& [key, value] : proposal["keys"].items())
            keys.push_back(fmt::format("{} = {:.4g}", key, value.get<double>()));
        const std::string line = fmt::format("propose     law \"{}\", {}: {}", text(proposal, "law"),
                                             fmt::join(keys, ", "), text(proposal, "reason"));
        say("{}\n", wrapped(line, plan_width));
    }
    if (found["units"].contains("proposed")) {
        const Found& units = found["units"]["proposed"];
        say("propose     [units] length = \"{}\", force = \"{}\": the scene names none, and its numbers suggest them "
            "({})\n",
            text(units, "length"), text(units, "force"), text(units, "reason"));
    }
    if (found.contains("effort")) say_effort(found["effort"]);
    for (const Found& note : found["notes"]) say("note: {}\n", note.get<std::string>());
    if (!found["plan"].empty()) say_plan(found["plan"]);
    // Not on standard output, where they are lost when that goes to a file.
    for (const Found& warning : found["warnings"]) complain("warning: {}\n", warning.get<std::string>());
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

// An error ends the call, whose caller says it.
struct Said {
    const Model& model;
    std::vector<std::string> warnings;
};
// A prediction and a solver say the same.
extern "C" void on_check_log(std::int32_t level, const char* text, void* user) {
    Said& said = *static_cast<Said*>(user);
    if (level != 1) return;
    std::string warning = said_of_scene(text, said.model);
    if (std::find(said.warnings.begin(), said.warnings.end(), warning) == said.warnings.end())
        said.warnings.push_back(std::move(warning));
}

Found errors_of(const Failure& failure) {
    const auto* several = dynamic_cast<const Refusals*>(&failure);
    const std::vector<SceneFailure> all = several == nullptr ? std::vector<SceneFailure>{} : several->all();
    Found out = Found::array();
    const auto add = [&](const Failure& each) {
        const Place& place = each.place();
        out.push_back({{"file", place.file}, {"line", nullptr}, {"key", place.path}, {"message", each.text()}});
        if (place.line > 0) out.back()["line"] = place.line;
    };
    if (several == nullptr) add(failure);
    for (const SceneFailure& each : all) add(each);
    return out;
}

// drawing: is filled if it is there.
Found examined(const std::string& scene_file, const std::vector<std::string>& settings, bool with_plan,
               const Caller& caller, nlohmann::json* drawing) {
    const Scene scene = read_scene(scene_file, settings);
    std::vector<std::string> imported;
    if (scene.imported) imported = import_lines(*scene.imported);
    Context context = new_context();
    const Interrupt interrupt(context.get());
    const Model model = build(std::move(context), scene);
    Said said{model, {}};
    delam_context_set_log(model.context.get(), on_check_log, &said);
    const History history(model, scene);
    Planned planned;
    const auto make_plan = [&] {
        if (with_plan)
            planned = plan(model, scene);
        else
            call(model.context.get(), delam_problem_check(model.problem.get()), {scene.file, "", 0});
        return 0;
    };
    (void)(caller.around ? caller.around(model, make_plan) : make_plan());
    Found found = find(scene_file, scene, model);
    found["imported"] = imported;
    if (const double step = seconds_of(planned.text, "time of a load step"); step > 0)
        found["effort"] = {{"seconds", planned.setup + static_cast<double>(scene.step_count()) * step +
                                           seconds_of(planned.text, "parts of the steps")},
                           {"bytes", planned.memory}};
    found["plan"] = lines_of(said_of_scene(planned.text, model));
    std::vector<std::string>& warnings = said.warnings;
    const std::vector<std::string> more = warnings_of(model, scene);
    warnings.insert(warnings.end(), more.begin(), more.end());
    if (!planned.converged) warnings.emplace_back("the displacement of the initial state did not converge");
    found["warnings"] = warnings;
    if (drawing != nullptr) *drawing = drawing_of(model, scene);
    return found;
}

}  // namespace

int check(const std::string& scene_file, const std::vector<std::string>& settings, const CheckWishes& wishes,
          const Caller& caller) {
    const std::string& drawing = wishes.drawing;
    constexpr auto replace = Found::error_handler_t::replace;
    if (!drawing.empty()) require_drawable(drawing, caller);
    nlohmann::json drawn;
    nlohmann::json* wanted = drawing.empty() ? nullptr : &drawn;
    const auto find_all = [&] { return examined(scene_file, settings, !wishes.no_plan, caller, wanted); };
    if (!wishes.json) {
        const Found found = find_all();
        for (const Found& line : found["imported"]) say("{}\n", line.get<std::string>());
        say_lines_of(found);
        if (wanted != nullptr) draw(drawn, drawing);
        return exit_done;
    }
    try {
        say("{}\n", find_all().dump(2, ' ', false, replace));
    } catch (const Failure& failure) {
        if (failure.code() != exit_scene) throw;  // the scene may be right
        const Found found{{"correct", false}, {"file", scene_file}, {"errors", errors_of(failure)}};
        say("{}\n", found.dump(2, ' ', false, replace));
        return failure.code();
    }
    if (wanted != nullptr) draw(drawn, drawing);
    return exit_done;
}

}  // namespace cli
