// SPDX-License-Identifier: BSD-3-Clause
#include "model/notes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mesh/cell_shape.hpp"
#include "mesh/near_bodies.hpp"
#include "model/library/call.hpp"
#include "scene/units/magnitudes.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

// Returns the unit of coordinates after a blank; nothing if the scene names none.
std::string after_length(const Scene& scene) {
    const std::string& name = scene.units.names.length;
    return name.empty() ? "" : " " + name;
}

// Appends "ends at 30, the interface at 0.12 m" and the like.
void beyond(const Region& region, const Scene& scene, std::vector<std::string>& out) {
    const Geometry& geometry = scene.geometry;
    const std::string unit = after_length(scene);
    const double slack = 1e-6 * geometry.smallest_edge;
    for (std::size_t axis = 0; axis < geometry.lengths.size(); ++axis) {
        const std::string along = geometry.lengths.size() > 1 ? (axis == 0 ? " along x" : " along y") : "";
        if (region.lower[axis] < -slack)
            out.push_back(fmt::format("begins at {}{}, the interface at 0{}", region.lower[axis], unit, along));
        if (region.upper[axis] > geometry.lengths[axis] + slack)
            out.push_back(fmt::format("ends at {}, the interface at {}{}{}", region.upper[axis], geometry.lengths[axis],
                                      unit, along));
    }
}

void interface_warnings(const Model& model, const Scene& scene, std::vector<std::string>& out) {
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        bool said = model.adheres[i];
        for (const Region& region : data.regions) {
            if (scene.mesh) break;
            std::vector<std::string> texts;
            beyond(region, scene, texts);
            for (const std::string& text : texts) {
                out.push_back(region.place.path + " " + text + (model.adheres[i] ? "" : ": nothing adheres"));
                said = true;
            }
        }
        if (!said) out.push_back(data.place.path + ": nothing adheres");
    }
}

void patch_warnings(const Scene& scene, const Selection& where, std::vector<std::string>& out) {
    const auto* patch = std::get_if<Patch>(&where.shape);
    if (patch == nullptr || scene.mesh) return;
    const Geometry& geometry = scene.geometry;
    const double slack = 1e-6 * geometry.smallest_edge;
    for (std::size_t axis = 0; axis < patch->lower.size(); ++axis) {
        // The thickness of the patch along its normal is a tolerance, not an extent.
        if (std::abs(patch->normal[axis]) > 0.5) continue;
        double lower = 0;
        double upper = axis < geometry.lengths.size() ? geometry.lengths[axis] : geometry.height;
        if (axis >= geometry.lengths.size() && where.body >= 0) {
            upper = 0;
            for (std::size_t i = 0; i <= static_cast<std::size_t>(where.body); ++i) {
                lower = upper;
                upper += scene.layers[i].thickness;
            }
        }
        const char* letter = axis + 1 < patch->lower.size() ? (axis == 0 ? "x" : "y") : (axis == 1 ? "y" : "z");
        if (patch->lower[axis] < lower - slack || patch->upper[axis] > upper + slack)
            out.push_back(fmt::format(
                "{}.patch reaches from {} = {:.6g} to {:.6g}, the body from {:.6g} to {:.6g}{}: "
                "only what is on the body counts",
                where.place.path, letter, patch->lower[axis], patch->upper[axis], lower, upper, after_length(scene)));
    }
}

void cohesive_warning(const Model& model, const Scene& scene, std::vector<std::string>& out) {
    if (!scene.mesh || std::any_of(model.interfaces.begin(), model.interfaces.end(),
                                   [](const InterfaceData& data) { return !data.bonded && !data.contact; }))
        return;
    std::int64_t left = 0;
    for (const CohesiveSet& set : scene.mesh->cohesive) left += static_cast<std::int64_t>(set.lower.size());
    if (left > 0)
        out.push_back(fmt::format("{} of the mesh left out: no interface of the scene has a law",
                                  counted(left, "cohesive element")));
}

// Bodies that general contact leaves alone pass through the others.
void contact_warning(const Model& model, const Scene& scene, std::vector<std::string>& out) {
    if (!scene.general_contact || scene.layers.size() < 2) return;
    std::vector<bool> held(scene.layers.size(), false);
    for (const InterfaceData& data : model.interfaces) held[data.lower] = held[data.upper] = true;
    const auto free = std::find(held.begin(), held.end(), false);
    if (free == held.end()) return;
    const auto body = static_cast<std::size_t>(free - held.begin());
    const NearBody near = nearest_body(*scene.mesh, static_cast<std::int32_t>(body));
    if (near.body < 0) return;
    const auto others = std::count(free + 1, held.end(), false);
    out.push_back(fmt::format(
        "general contact takes in no face of body \"{}\"{}, so that it passes through other bodies: its nearest node "
        "is {:.4g} away from \"{}\", and contact.gap is {:.4g}; {:.3g} would take it in",
        scene.layers[body].name, others > 0 ? fmt::format(" and of {} other{}", others, others > 1 ? "s" : "") : "",
        near.distance, scene.layers[static_cast<std::size_t>(near.body)].name, scene.general_contact->gap,
        1.01 * near.distance));
}

}  // namespace

std::vector<std::string> warnings_of(const Model& model, const Scene& scene) {
    std::vector<std::string> out = model.said;
    interface_warnings(model, scene, out);
    cohesive_warning(model, scene, out);
    contact_warning(model, scene, out);
    if (std::string units = units_found(scene).warning; !units.empty()) out.push_back(std::move(units));
    for (const Prescription& data : scene.prescriptions) patch_warnings(scene, data.where, out);
    for (const DeadForce& data : scene.forces) patch_warnings(scene, data.where, out);
    std::vector<double> factors(pattern_count(model));
    const double start = scene.times.front();
    if (!factors.empty())
        call(model.context.get(),
             delam_problem_factors(model.problem.get(), start, static_cast<std::int64_t>(factors.size()),
                                   factors.data()),
             std::string("factors"));
    for (std::size_t i = 0; i < scene.patterns.size(); ++i)
        if (std::fpclassify(factors[i]) != FP_ZERO)
            out.push_back(
                fmt::format("{} \"{}\" is {} at the start, time {}: the initial state is loaded: its stored "
                            "energy is not in `work`",
                            scene.patterns[i].place.path, scene.patterns[i].name, factors[i], start));
    return out;
}

std::vector<std::string> notes_of(const Scene& scene) {
    std::vector<std::string> out;
    const Geometry& geometry = scene.geometry;
    if (scene.mesh) out = scene.mesh->notes;
    // Not of a deck whose materials, constraints and steps are in the scene.
    if (scene.imported) std::erase_if(out, [](const std::string& note) { return note.starts_with("ignored: "); });
    const CellShape* cell = scene.mesh ? nullptr : &shape_of(geometry.cell_type);
    for (const Layer& layer : scene.layers) {
        const Material& material = scene.materials[layer.material];
        // Nothing locks in plane stress, because the thickness can change freely.
        const auto* isotropic = std::get_if<Isotropic>(&material.elastic);
        if (isotropic != nullptr && isotropic->poisson > 0.49 && layer.formulation != "mean-dilatation" &&
            geometry.plane != "plane-stress")
            out.push_back(
                fmt::format("{} \"{}\": poisson = {} locks with full integration: far too stiff (use formulation = "
                            "\"mean-dilatation\")",
                            scene.mesh ? "body" : "layer", layer.name, isotropic->poisson));
        if (cell != nullptr && cell->locks() && layer.divisions < 4)
            out.push_back(
                fmt::format("layer \"{}\": {} of {} across the thickness: far too stiff in bending (use {}, "
                            "or 4 cells and more)",
                            layer.name, counted(layer.divisions, "cell"), cell->name,
                            geometry.dimension == 2 ? "tri6 or quad8" : instead_of(*cell).name + " or hex20"));
    }
    return out;
}

void note_place(Model& model, const Scene& scene, const Selection& where, const Selected& taken) {
    if (const auto* point = std::get_if<Point>(&where.shape)) {
        double square = 0;
        for (std::size_t a = 0; a < point->at.size(); ++a) square += std::pow(taken.at[a] - point->at[a], 2);
        if (std::sqrt(square) > 1e-3 * scene.geometry.smallest_edge)
            model.said.push_back(fmt::format("{}.point is [{:.6g}], its node is at [{:.6g}], {:.3g}{} away",
                                             where.place.path, fmt::join(point->at, ", "), fmt::join(taken.at, ", "),
                                             std::sqrt(square), after_length(scene)));
    }
    const auto* patch = std::get_if<Patch>(&where.shape);
    if (patch == nullptr || !scene.mesh) return;  // patch_warnings knows the extent of layers
    double asked = 1;
    for (std::size_t axis = 0; axis < patch->lower.size(); ++axis)
        if (std::abs(patch->normal[axis]) < 0.5) asked *= patch->upper[axis] - patch->lower[axis];
    const double covered = std::accumulate(taken.weights.begin(), taken.weights.end(), 0.0);
    const std::string unit = after_length(scene);
    if (covered < (1 - 1e-6) * asked)
        model.said.push_back(fmt::format("{}.patch covers {:.6g} of {:.6g}{}{}: only what is on the boundary counts",
                                         where.place.path, covered, asked, unit,
                                         scene.geometry.dimension == 3 && !unit.empty() ? "²" : ""));
}

}  // namespace cli
