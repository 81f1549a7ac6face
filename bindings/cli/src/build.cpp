// SPDX-License-Identifier: BSD-3-Clause
#include "build.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "build_constraints.hpp"
#include "build_materials.hpp"
#include "build_mesh.hpp"
#include "call.hpp"
#include "named.hpp"
#include "selection.hpp"
#include "sensitivities.hpp"

namespace cli {

namespace {

// Inside, or on an end shared with the interface: an end within the interface is a crack tip, whose pair stays bonded.
bool inside(double x, double lower, double upper, double length, double slack) {
    const bool from = lower <= slack ? x >= lower - slack : x > lower + slack;
    const bool to = upper >= length - slack ? x <= upper + slack : x < upper - slack;
    return from && to;
}

// Whether any pair adheres.
bool set_adhesion(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data) {
    const delam_context* context = model.context.get();
    std::int64_t pairs = 0;
    std::int64_t nodes = 0;
    call(context, delam_mesh_interface_size(model.mesh.get(), index, nullptr, nullptr, &pairs, nullptr, nullptr),
         data.place);
    call(context, delam_mesh_size(model.mesh.get(), nullptr, &nodes, nullptr, nullptr, nullptr), data.place);
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    std::vector<std::int64_t> face_a(static_cast<std::size_t>(pairs));
    std::vector<double> coordinates(static_cast<std::size_t>(nodes) * dimension);
    call(context, delam_mesh_interface_pairs(model.mesh.get(), index, face_a.data(), nullptr, nullptr, nullptr),
         data.place);
    call(context, delam_mesh_nodes(model.mesh.get(), nodes * scene.geometry.dimension, coordinates.data()), data.place);
    const double slack = 1e-6 * scene.geometry.smallest_edge;
    std::vector<double> initial(face_a.size(), 1.0);
    for (const Region& region : data.regions) {
        std::vector<std::int64_t> chosen;
        for (std::size_t i = 0; i < face_a.size(); ++i) {
            const double* at = coordinates.data() + static_cast<std::size_t>(face_a[i]) * dimension;
            bool in = true;
            for (std::size_t axis = 0; axis + 1 < dimension; ++axis)
                in =
                    in && inside(at[axis], region.lower[axis], region.upper[axis], scene.geometry.lengths[axis], slack);
            if (in) chosen.push_back(static_cast<std::int64_t>(i));
        }
        if (chosen.empty()) throw SceneFailure(region.place, "no pair of the interface is in this region");
        const std::vector<double> adhesion(chosen.size(), region.adhesion);
        call(context,
             delam_problem_set_adhesion(model.problem.get(), index, static_cast<std::int64_t>(chosen.size()),
                                        chosen.data(), adhesion.data(), 0),
             region.place);
        for (const std::int64_t pair : chosen) initial[static_cast<std::size_t>(pair)] = region.adhesion;
    }
    return std::any_of(initial.begin(), initial.end(), [](double zeta) { return zeta > 0; });
}

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
        const LawData& from = scene.laws[data.law];
        delam_law* handle = nullptr;
        const std::int32_t status = delam_law_create(model.context.get(), from.kind.c_str(), &handle);
        const Law law(handle);
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
        call(context, delam_problem_set_law(model.problem.get(), index, law.get()), data.place);
        model.adheres.push_back(scene.mesh ? set_mesh_adhesion(model, scene, index, data)
                                           : set_adhesion(model, scene, index, data));
    }
}

void prescribe(const Model& model, const Scene& scene, const Prescription& data) {
    const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where, data.mean);
    if (data.mean && at.weights.empty()) throw SceneFailure(data.place, "mean: a single node has no face");
    std::vector<std::int64_t> patterns;
    std::vector<double> coefficients;
    for (const Term& term : data.terms) {
        patterns.push_back(static_cast<std::int64_t>(term.pattern));
        coefficients.push_back(term.coefficient);
    }
    const auto count = static_cast<std::int64_t>(at.nodes.size());
    const auto pattern_count = static_cast<std::int64_t>(patterns.size());
    std::vector<double> all;
    for (std::size_t i = 0; i < at.nodes.size(); ++i) all.insert(all.end(), coefficients.begin(), coefficients.end());
    for (const std::vector<double>& direction : data.directions) {
        const std::int32_t status =
            at.weights.empty()
                ? delam_problem_prescribe_nodes(model.problem.get(), count, at.nodes.data(), direction.data(),
                                                pattern_count, patterns.data(), all.data(), 0)
                : delam_problem_prescribe_mean(model.problem.get(), count, at.nodes.data(), at.weights.data(),
                                               direction.data(), pattern_count, patterns.data(), coefficients.data(),
                                               0);
        call(model.context.get(), status, data.place);
    }
}

void add_force(const Model& model, const Scene& scene, const DeadForce& data) {
    const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where, true);
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

}  // namespace

Context new_context() {
    delam_context* handle = nullptr;
    if (delam_context_create(&handle) != DELAM_OK) throw Failure(exit_numerical, "out of memory");
    return Context(handle);
}

void note_constraints(Model& model, const Place& place) {
    std::int64_t rows = 0;
    call(model.context.get(),
         delam_problem_constraints(model.problem.get(), &rows, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr),
         place);
    model.constraint_places.resize(static_cast<std::size_t>(rows), place);
}

namespace {

void fill(Model& model, const Scene& scene) {
    const delam_context* owner = model.context.get();
    build_mesh(model, scene);
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
        const bool directed = !std::holds_alternative<Isotropic>(material.elastic);
        if (scene.mesh && directed && !scene.layers[i].axes && !scene.mesh->orientation.empty())
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
    for (const Prescription& data : scene.prescriptions) {
        prescribe(model, scene, data);
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
    try {
        fill(model, scene);
    } catch (const Failure& failure) {
        const std::string text = named(failure.text(), scene, model);
        if (failure.place().file.empty()) throw Failure(failure.code(), text);
        throw Failure(failure.code(), failure.place(), text);
    }
    return model;
}

Solver new_solver(const Model& model, const Scene& scene, bool& converged) {
    delam_solver* handle = nullptr;
    const std::int32_t status = delam_solver_create(model.problem.get(), scene.times.front(), &handle);
    Solver solver(handle);
    converged = status != DELAM_NOT_CONVERGED;
    if (converged || solver == nullptr) call(model.context.get(), status, {scene.file, "", 0});
    follow_sensitivities(model, scene, solver.get());
    return solver;
}

}  // namespace cli
