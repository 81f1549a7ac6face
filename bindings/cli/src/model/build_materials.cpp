// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_materials.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "delam/experimental.h"
#include "model/library/call.hpp"

namespace cli {

void set_material(const delam_context* owner, delam_problem* problem, std::int32_t body, const Material& material,
                  const Layer& made_of_it) {
    if (const auto* isotropic = std::get_if<Isotropic>(&material.elastic))
        call(owner, delam_problem_set_elastic(problem, body, isotropic->young, isotropic->poisson), material.place);
    else
        call(owner,
             delam_problem_set_orthotropic(problem, body, std::get<std::array<double, 9>>(material.elastic).data()),
             material.place);
    if (made_of_it.axes)
        call(owner, delam_problem_set_orientation(problem, body, 1, nullptr, made_of_it.axes->data(), 0),
             made_of_it.place);
    call(owner, delam_problem_set_formulation(problem, body, made_of_it.formulation.c_str()), material.place);
}

void set_plies(const Model& model, const Scene& scene, std::size_t body) {
    const Layer& layer = scene.layers[body];
    if (layer.plies.empty()) return;
    const delam_context* owner = model.context.get();
    std::int64_t all = 0;
    call(owner, delam_mesh_size(model.mesh.get(), nullptr, nullptr, &all, nullptr, nullptr), layer.place);
    std::int64_t levels = 0;
    std::int64_t below = 0;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        levels += scene.layers[i].divisions;
        if (i < body) below += scene.layers[i].divisions;
    }
    const std::int64_t in_a_level = all / levels;
    const std::int64_t in_a_ply = in_a_level * layer.divisions / static_cast<std::int64_t>(layer.plies.size());
    std::vector<std::int64_t> cells(static_cast<std::size_t>(in_a_ply));
    std::iota(cells.begin(), cells.end(), below * in_a_level);
    std::vector<double> axes;
    for (const std::array<double, 6>& ply : layer.plies) {
        axes.clear();
        for (std::int64_t c = 0; c < in_a_ply; ++c) axes.insert(axes.end(), ply.begin(), ply.end());
        call(owner,
             delam_problem_set_orientation(model.problem.get(), static_cast<std::int32_t>(body), in_a_ply, cells.data(),
                                           axes.data(), 0),
             layer.place);
        for (std::int64_t& c : cells) c += in_a_ply;
    }
}

bool has_cell_axes(const Scene& scene, std::size_t body) {
    const Material& material = scene.materials[scene.layers[body].material];
    const auto& along = material.expansion;
    const bool directed = !std::holds_alternative<Isotropic>(material.elastic) ||
                          (along && ((*along)[0] != (*along)[1] || (*along)[0] != (*along)[2]));
    return scene.mesh && directed && !scene.layers[body].axes && !scene.mesh->orientation.empty();
}

void set_cell_axes(const delam_context* owner, delam_problem* problem, std::int32_t body, const MeshData& mesh,
                   const Place& place) {
    std::vector<std::int64_t> cells;
    std::vector<double> axes;
    std::int64_t cell = 0;
    for (const CellBlock& block : mesh.blocks)
        for (const std::int32_t label : block.bodies) {
            if (label == body) {
                const auto& own = mesh.orientation[static_cast<std::size_t>(cell)];
                cells.push_back(cell);
                axes.insert(axes.end(), own.begin(), own.end());
            }
            ++cell;
        }
    call(owner,
         delam_problem_set_orientation(problem, body, static_cast<std::int64_t>(cells.size()), cells.data(),
                                       axes.data(), 0),
         place);
}

namespace {

using Numbers = std::vector<std::int64_t>;

// The cells of a mesh at its nodes, also at tied nodes: there those of the node of the largest weight.
class CellsAtNodes {
public:
    CellsAtNodes(const Model& model, std::int32_t body, const Place& place) {
        const delam_context* owner = model.context.get();
        const delam_mesh* mesh = model.mesh.get();
        std::int64_t nodes = 0, cells = 0, needed = 0;
        call(owner, delam_mesh_size(mesh, nullptr, &nodes, &cells, nullptr, nullptr), place);
        std::vector<std::int32_t> bodies(static_cast<std::size_t>(cells));
        Numbers offsets(bodies.size() + 1);
        (void)delam_mesh_cells(mesh, nullptr, bodies.data(), offsets.data(), 0, nullptr, &needed);
        Numbers corners(static_cast<std::size_t>(needed));
        call(owner, delam_mesh_cells(mesh, nullptr, bodies.data(), offsets.data(), needed, corners.data(), nullptr),
             place);
        cell_.assign(static_cast<std::size_t>(nodes), -1);
        for (std::size_t c = 0; c < bodies.size(); ++c)
            for (std::int64_t k = offsets[c]; k < offsets[c + 1] && bodies[c] == body; ++k) {
                std::int64_t& first = cell_[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])];
                if (first < 0) first = static_cast<std::int64_t>(c);
            }
        follow_ties(owner, mesh, place);
    }
    // Returns the first cell of the body at a node; -1: there is none.
    [[nodiscard]] std::int64_t at(std::int64_t node) const { return cell_[static_cast<std::size_t>(node)]; }

private:
    void follow_ties(const delam_context* owner, const delam_mesh* mesh, const Place& place) {
        std::int64_t count = 0, entries = 0;
        call(owner, delam_mesh_node_ties(mesh, &count, &entries, nullptr, nullptr, nullptr, nullptr), place);
        Numbers nodes(static_cast<std::size_t>(count)), starts(nodes.size() + 1), of(static_cast<std::size_t>(entries));
        std::vector<double> weights(of.size());
        call(owner,
             delam_mesh_node_ties(mesh, nullptr, nullptr, nodes.data(), starts.data(), of.data(), weights.data()),
             place);
        for (std::size_t t = 0; t < nodes.size(); ++t) {
            const auto first = weights.begin() + starts[t], last = weights.begin() + starts[t + 1];
            const auto most = std::max_element(first, last);
            if (most != last)
                cell_[static_cast<std::size_t>(nodes[t])] = at(of[static_cast<std::size_t>(most - weights.begin())]);
        }
    }

    Numbers cell_;  // by node
};

// Directions of axis 1 of side a, [1][3] or [pairs][3]; empty: it has no axes.
std::vector<double> axes_of_material(const Model& model, const Scene& scene, std::int64_t index, const Place& place) {
    const delam_context* owner = model.context.get();
    std::int32_t body = -1;
    std::int64_t pairs = 0;
    call(owner, delam_mesh_interface_size(model.mesh.get(), index, &body, nullptr, &pairs, nullptr, nullptr), place);
    if (body < 0) return {};
    const Layer& layer = scene.layers[static_cast<std::size_t>(body)];
    // Side a of an interface of layers is the lower one, whose last ply is at the top.
    const auto* own = layer.axes ? &*layer.axes : layer.plies.empty() ? nullptr : &layer.plies.back();
    if (own != nullptr) return {own->begin(), own->begin() + 3};
    if (!has_cell_axes(scene, static_cast<std::size_t>(body))) return {};
    const CellsAtNodes cells(model, body, place);
    Numbers nodes(static_cast<std::size_t>(pairs));
    call(owner, delam_mesh_interface_pairs(model.mesh.get(), index, nodes.data(), nullptr, nullptr, nullptr), place);
    std::vector<double> out;
    for (const std::int64_t node : nodes) {
        const std::int64_t cell = cells.at(node);
        if (cell < 0) return {};
        const auto& axes = scene.mesh->orientation[static_cast<std::size_t>(cell)];
        out.insert(out.end(), axes.begin(), axes.begin() + 3);
    }
    return out;
}

}  // namespace

void set_tangents(Model& model, const Scene& scene) {
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        if (data.bonded || data.contact) continue;
        const auto index = static_cast<std::int64_t>(i);
        std::vector<double> directions;
        if (data.shear_axis)
            directions.assign(data.shear_axis->begin(), data.shear_axis->end());
        else if (has_axes(scene.laws[data.law]))
            directions = axes_of_material(model, scene, index, data.place);
        if (directions.empty()) continue;
        call(model.context.get(),
             delam_experimental_mesh_set_tangents(model.mesh.get(), index,
                                                  static_cast<std::int64_t>(directions.size() / 3), directions.data()),
             data.place);
    }
}

}  // namespace cli
