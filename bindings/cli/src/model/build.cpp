// SPDX-License-Identifier: BSD-3-Clause
#include "model/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_set>

#include <fmt/format.h>

#include "model/build_constraints.hpp"
#include "model/build_contact.hpp"
#include "model/build_materials.hpp"
#include "model/build_mesh.hpp"
#include "model/library/call.hpp"
#include "model/library/named.hpp"
#include "model/library/selection.hpp"
#include "model/notes.hpp"
#include "model/sensitivities.hpp"

namespace cli {

namespace {

// The regions of a block of layers reach over its height.
void set_layer_regions(Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data) {
    const auto last = static_cast<std::size_t>(scene.geometry.dimension) - 1;
    for (Region region : data.regions) {
        region.lower[last] = -scene.geometry.height;
        region.upper[last] = 2.0 * scene.geometry.height;
        if (set_box(model, index, region) == 0)
            throw SceneFailure(region.place, "no pair of the interface is in this region");
    }
}

}  // namespace

Law law_of(const Model& model, const LawData& from) {
    delam_context* context = model.context.get();
    delam_law* handle = nullptr;
    const std::int32_t status = delam_law_create(context, from.kind.c_str(), &handle);
    Law law(handle);
    call(context, status, from.place);
    const auto at = [&](const std::string& key) { return from.places.at(key); };
    for (const auto& [key, value] : from.texts)
        call(context, delam_law_set_text(law.get(), key.c_str(), value.c_str()), at(key));
    for (const auto& [key, value] : from.parameters)
        call(context, delam_law_set(law.get(), key.c_str(), value), at(key));
    if (!from.table_xi.empty())
        call(context,
             delam_law_set_table(law.get(), static_cast<std::int64_t>(from.table_xi.size()), from.table_xi.data(),
                                 from.table_s.data()),
             at("softening"));
    call(context, delam_law_check(law.get()), from.place);
    return law;
}

namespace {

void set_interfaces(Model& model, const Scene& scene) {
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        const auto index = static_cast<std::int64_t>(i);
        const delam_context* context = model.context.get();
        if (data.bonded) {
            call(context, delam_problem_set_bonded(model.problem.get(), index), data.place);
            model.adheres.push_back(true);
            continue;
        }
        if (data.contact) {
            call(context, delam_problem_set_contact(model.problem.get(), index), data.place);
            model.adheres.push_back(true);
            continue;
        }
        const Law law = law_of(model, scene.laws[data.law]);
        call(context, delam_problem_set_law(model.problem.get(), index, law.get()), data.place);
        scene.mesh ? set_mesh_regions(model, scene, index, data) : set_layer_regions(model, scene, index, data);
        double spacing = 0;
        call(context, delam_problem_process_zone(model.problem.get(), index, nullptr, &spacing), data.place);
        model.adheres.push_back(spacing > 0);
    }
}

// Nodes by what is prescribed there: direction, patterns, coefficients and times.
using Times = std::array<std::optional<double>, 4>;
using Prescribed = std::map<std::tuple<std::vector<double>, std::vector<std::int64_t>, std::vector<double>, Times>,
                            std::unordered_set<std::int64_t>>;

// The patterns of supports that begin or end: 1 at a time, and gone by another.
class Changes {
public:
    Changes(const Model& model, const Scene& scene) : model_(model), scene_(scene) {}
    // Lets the constraints from `first` on begin and end as a support says.
    void set(const Prescription& data, std::size_t first) {
        if (!data.begin && !data.end) return;
        delam_problem* problem = model_.problem.get();
        std::int64_t rows = 0;
        call(model_.context.get(),
             delam_problem_constraints(problem, &rows, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr),
             data.place);
        const auto begin = static_cast<std::int64_t>(first), count = rows - begin;
        if (count == 0) return;
        if (data.begin)
            call(model_.context.get(),
                 delam_problem_begin_constraints(problem, begin, count, data.begin->at, pattern("begin", *data.begin)),
                 data.place);
        if (data.end)
            call(model_.context.get(),
                 delam_problem_end_constraints(problem, begin, count, data.end->at, pattern("end", *data.end)),
                 data.place);
    }

private:
    std::int64_t pattern(const std::string& kind, const Change& change) {
        const auto [at, made] = made_.try_emplace({kind, change.at, change.over.value_or(change.at)}, -1);
        if (!made) return at->second;
        std::string name = fmt::format("{}-{}", kind, made_.size());
        const auto taken = [&](const PatternData& other) { return other.name == name; };
        while (std::any_of(scene_.patterns.begin(), scene_.patterns.end(), taken)) name += "-";
        const std::array times{change.at, change.over.value_or(change.at)}, values{1.0, 0.0};
        call(model_.context.get(),
             delam_problem_add_pattern(model_.problem.get(), name.c_str(), change.over ? 2 : 1, times.data(),
                                       values.data(), &at->second),
             std::string("patterns"));
        return at->second;
    }

    const Model& model_;
    const Scene& scene_;
    std::map<std::tuple<std::string, double, double>, std::int64_t> made_;
};

Times times_of(const Prescription& data) {
    Times times;
    if (data.begin) times = {data.begin->at, data.begin->over, {}, {}};
    if (data.end) times[2] = data.end->at, times[3] = data.end->over;
    return times;
}

// before: what is prescribed at nodes already. Two entries may say the same of a node, as where sets overlap.
void prescribe(Model& model, const Scene& scene, const Prescription& data, Prescribed& before) {
    const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where, data.mean);
    note_place(model, scene, data.where, at);
    if (data.mean && at.weights.empty()) throw SceneFailure(data.place, "mean: a single node has no face");
    std::vector<std::int64_t> patterns;
    std::vector<double> coefficients;
    for (const Term& term : data.terms) {
        patterns.push_back(static_cast<std::int64_t>(term.pattern));
        coefficients.push_back(term.coefficient);
    }
    const auto pattern_count = static_cast<std::int64_t>(patterns.size());
    for (const std::vector<double>& direction : data.directions) {
        std::vector<std::int64_t> nodes = at.nodes;
        if (at.weights.empty()) {
            auto& alike = before[{direction, patterns, coefficients, times_of(data)}];
            std::erase_if(nodes, [&](std::int64_t node) { return alike.contains(node); });
            alike.insert(nodes.begin(), nodes.end());
        }
        const auto count = static_cast<std::int64_t>(nodes.size());
        std::vector<double> all;
        for (std::size_t i = 0; i < nodes.size(); ++i) all.insert(all.end(), coefficients.begin(), coefficients.end());
        const std::int32_t status =
            at.weights.empty()
                ? delam_problem_prescribe_nodes(model.problem.get(), count, nodes.data(), direction.data(),
                                                pattern_count, patterns.data(), all.data(), 0)
                : delam_problem_prescribe_mean(model.problem.get(), count, nodes.data(), at.weights.data(),
                                               direction.data(), pattern_count, patterns.data(), coefficients.data(),
                                               0);
        call(model.context.get(), status, data.place);
    }
}

void add_force(Model& model, const Scene& scene, const DeadForce& data) {
    const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where, true);
    note_place(model, scene, data.where, at);
    if (data.kind != ForceKind::total && at.weights.empty())
        throw SceneFailure(data.place, "a single node has no face: give force instead of a force per area");
    const double total = std::accumulate(at.weights.begin(), at.weights.end(), 0.0);
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    std::vector<double> forces;
    for (std::size_t i = 0; i < at.nodes.size(); ++i)
        for (std::size_t a = 0; a < dimension; ++a) {
            if (data.kind == ForceKind::pressure)
                forces.push_back(-data.force[0] * at.normals[i * dimension + a]);
            else if (data.kind == ForceKind::traction)
                forces.push_back(data.force[a] * at.weights[i]);
            else
                forces.push_back(at.weights.empty() ? data.force[a] : data.force[a] * at.weights[i] / total);
        }
    call(model.context.get(),
         delam_problem_add_forces(model.problem.get(), static_cast<std::int64_t>(data.pattern),
                                  static_cast<std::int64_t>(at.nodes.size()), at.nodes.data(), forces.data(), 0),
         data.place);
}

extern "C" void on_build_log(std::int32_t level, const char* text, void* said) {
    if (level == 1) static_cast<std::vector<std::string>*>(said)->emplace_back(text);
}

void fill(Model& model, const Scene& scene) {
    const delam_context* owner = model.context.get();
    build_mesh(model, scene);
    set_tangents(model, scene);
    delam_problem* handle = nullptr;
    const std::int32_t status = delam_problem_create(model.context.get(), model.mesh.get(), &handle);
    model.problem.reset(handle);
    call(owner, status, scene.geometry.place);
    delam_problem* problem = model.problem.get();
    if (scene.geometry.dimension == 2)
        call(owner, delam_problem_set_plane(problem, scene.geometry.plane.c_str()), scene.geometry.place);
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Material& material = scene.materials[scene.layers[i].material];
        set_material(owner, problem, static_cast<std::int32_t>(i), material, scene.layers[i]);
        set_plies(model, scene, i);
        if (has_cell_axes(scene, i))
            set_cell_axes(owner, problem, static_cast<std::int32_t>(i), *scene.mesh, scene.layers[i].place);
    }
    set_interfaces(model, scene);
    for (const PatternData& pattern : scene.patterns) {
        std::int64_t index = 0;
        call(owner,
             delam_problem_add_pattern(problem, pattern.name.c_str(), static_cast<std::int64_t>(pattern.times.size()),
                                       pattern.times.data(), pattern.values.data(), &index),
             pattern.place);
    }
    set_gaps(model, scene);
    Prescribed prescribed;
    Changes changes(model, scene);
    // Supports that end come first: what holds the same nodes after them is known to follow.
    for (const bool ends : {true, false})
        for (const Prescription& data : scene.prescriptions) {
            if (data.end.has_value() != ends) continue;
            const std::size_t first = model.constraint_places.size();
            prescribe(model, scene, data, prescribed);
            changes.set(data, first);
            note_constraints(model, data.place);
        }
    for (const DeadForce& data : scene.forces) add_force(model, scene, data);
    add_constraints(model, scene);
    for (const EigenstrainData& data : scene.eigenstrains)
        call(owner,
             delam_problem_add_eigenstrain(problem, static_cast<std::int64_t>(data.pattern), data.body,
                                           data.strain.data()),
             data.place);
    for (const SolverOption& option : scene.options) {
        const auto* number = std::get_if<double>(&option.value);
        call(owner,
             number != nullptr
                 ? delam_problem_set_number(problem, option.key.c_str(), *number)
                 : delam_problem_set_text(problem, option.key.c_str(), std::get<std::string>(option.value).c_str()),
             option.place);
    }
    call(owner, delam_problem_check(problem), {scene.file, "", 0});
}

}  // namespace

Model build(Context context, const Scene& scene) {
    Model model;
    model.context = std::move(context);
    delam_context_set_log(model.context.get(), on_build_log, &model.said);
    try {
        fill(model, scene);
    } catch (const Failure& failure) {
        const OfElements of = with_elements(named(failure.text(), scene, model), failure.place(), scene);
        if (of.place.file.empty()) throw Failure(failure.code(), of.message);
        throw Failure(failure.code(), of.place, of.message);
    }
    delam_context_set_log(model.context.get(), nullptr, nullptr);
    return model;
}

Solver new_solver(const Model& model, const Scene& scene, Solver former, bool& converged) {
    std::int32_t shares = 0;
    if (former != nullptr)
        call(model.context.get(), delam_solver_shares_bodies(former.get(), model.problem.get(), &shares), scene.file);
    if (shares == 0) former.reset();
    delam_solver* handle = nullptr;
    const std::int32_t status =
        delam_solver_create_like(model.problem.get(), former.get(), scene.times.front(), &handle);
    Solver solver(handle);
    converged = status != DELAM_NOT_CONVERGED;
    if (converged || solver == nullptr) call(model.context.get(), status, {scene.file, "", 0});
    follow_sensitivities(model, scene, solver.get());
    return solver;
}

}  // namespace cli
