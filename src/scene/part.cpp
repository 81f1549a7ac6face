// SPDX-License-Identifier: BSD-3-Clause
#include "scene/part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "base/archive.hpp"
#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "body/rotation.hpp"
#include "delam/delam.h"

namespace delam {

// clang-format off
template <>
inline constexpr auto saved_fields<Part> = saved_since(1,
    &Part::dimension, &Part::plane, &Part::nodes, &Part::coordinates, &Part::types, &Part::connectivity, &Part::body,
    &Part::labels, &Part::formulation, &Part::orthotropic, &Part::constants, &Part::axes, &Part::axes_of_cell);
// clang-format on
static_assert(complete<Part>(saved_fields<Part>));

namespace {

constexpr std::uint64_t part_magic = 0x31305450'4d4c4544;  // "DELMPT01" in memory on a little-endian machine
constexpr std::uint32_t part_version = 1;
constexpr std::size_t constants_of_body = 9;

template <class... Words>
[[noreturn]] void refuse(const Words&... words) {
    fail(DELAM_ERROR_SNAPSHOT, "part holds ", words...);
}

template <class T>
void require_size(const std::vector<T>& list, std::size_t size, const char* what) {
    if (list.size() != size) refuse(list.size(), " ", what, ", expected ", size);
}

// Numbers of a list from `least` to size - 1.
void require_range(const std::vector<std::int32_t>& list, std::int32_t least, std::size_t size, const char* what) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i] < least || (list[i] >= 0 && index(list[i]) >= size))
            refuse(what, "[", i, "] = ", list[i], ", allowed: ", least, " .. ", static_cast<std::int64_t>(size) - 1);
}

template <class T>
void require_ascending(const std::vector<T>& list, const char* what) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i] < 0 || (i > 0 && list[i] <= list[i - 1]))
            refuse(what, "[", i, "] = ", list[i], ", must be >= 0 and ascending");
}

void require_finite(const std::vector<double>& list, const char* what) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!std::isfinite(list[i])) refuse(what, "[", i, "] = ", list[i], ", not finite");
}

Material material_of(const Part& part, std::size_t body) {
    const double* own = &part.constants[body * constants_of_body];
    if (part.orthotropic[body] == 0) {
        if (!(own[0] > 0.0)) refuse("E = ", own[0], " of body ", part.labels[body], ", must be > 0");
        if (!(own[1] > -1.0 && own[1] < 0.5))
            refuse("nu = ", own[1], " of body ", part.labels[body], ", outside -1 < nu < 0.5");
        return Elastic{own[0], own[1]};
    }
    Orthotropic material;
    std::copy_n(own, constants_of_body, material.constant.begin());
    if (const std::string wrong = indefinite_constant(material); !wrong.empty())
        refuse("constants of body ", part.labels[body], ": ", wrong);
    return material;
}

// Axes that the library has made are orthonormal to rounding.
Axes axes_at(const Part& part, std::size_t i) {
    Axes axes{};
    std::copy_n(&part.axes[i * axes.size()], axes.size(), axes.begin());
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = 0; q <= p; ++q) {
            double product = 0.0;
            for (std::size_t k = 0; k < 3; ++k) product += axes[p * 3 + k] * axes[q * 3 + k];
            if (std::abs(product - (p == q ? 1.0 : 0.0)) > 1e-12) refuse("axes ", i, ", which are not orthonormal");
        }
    return axes;
}

void check_arrays(const Part& part) {
    if (part.dimension != 2 && part.dimension != 3) refuse("dimension ", part.dimension, ", must be 2 or 3");
    const bool stress = part.plane == static_cast<std::int32_t>(Plane::stress);
    if (part.plane != static_cast<std::int32_t>(Plane::strain) && !(stress && part.dimension == 2))
        refuse("plane assumption ", part.plane, " in ", part.dimension, "D");
    const std::size_t cells = part.types.size(), bodies = part.labels.size();
    if (cells == 0) refuse("no cells");
    require_ascending(part.nodes, "nodes");
    require_size(part.coordinates, part.nodes.size() * index(part.dimension), "coordinates");
    require_finite(part.coordinates, "coordinates");
    std::size_t corners = 0;
    for (std::size_t c = 0; c < cells; ++c) {
        const CellRow* row = find_cell_row(part.types[c]);
        if (row == nullptr || row->topology.dimension != part.dimension)
            refuse("cell type ", part.types[c], " in ", part.dimension, "D");
        corners += index(row->topology.nodes);
    }
    require_size(part.connectivity, corners, "nodes of cells");
    require_range(part.connectivity, 0, part.nodes.size(), "connectivity");
    require_size(part.body, cells, "bodies of cells");
    require_range(part.body, 0, bodies, "body");
    require_ascending(part.labels, "labels");
    require_size(part.formulation, bodies, "formulations");
    require_range(part.formulation, 0, static_cast<std::size_t>(Formulation::mean_dilatation) + 1, "formulation");
    require_size(part.orthotropic, bodies, "kinds of material");
    require_range(part.orthotropic, 0, 2, "orthotropic");
    require_size(part.constants, bodies * constants_of_body, "constants");
    require_finite(part.constants, "constants");
    const std::size_t axes = part.axes.size() / std::tuple_size_v<Axes>;
    require_size(part.axes, axes * std::tuple_size_v<Axes>, "numbers of axes");
    require_finite(part.axes, "axes");
    require_size(part.axes_of_cell, cells, "axes of cells");
    require_range(part.axes_of_cell, -1, axes, "axes_of_cell");
}

// Reports what a mesh or a model refuses as damage of the part: the scene that the part comes from was valid.
template <class Body>
auto refusing(Body&& body) {
    try {
        return body();
    } catch (const Error& e) {
        if (e.status() != DELAM_ERROR_ARGUMENT && e.status() != DELAM_ERROR_MESH) throw;
        fail(DELAM_ERROR_SNAPSHOT, "part is not sound: ", e.what());
    }
}

Mesh empty_mesh(const Part& part) {
    check_arrays(part);
    return refusing([&] { return Mesh(part.dimension, part.coordinates); });
}

// The cells' nodes, in ascending order and in the places of a part.
void take_nodes(const Mesh& mesh, std::span<const std::int64_t> cells, Part& part) {
    for (const std::int64_t c : cells) {
        poll_cancel("copy");
        const auto own = mesh.cell(c);
        part.nodes.insert(part.nodes.end(), own.begin(), own.end());
    }
    const std::vector<std::int64_t> corners = part.nodes;
    poll_cancel_now("copy");
    std::sort(part.nodes.begin(), part.nodes.end());
    part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()), part.nodes.end());
    poll_cancel_now("copy");
    if (part.nodes.size() > index(std::numeric_limits<std::int32_t>::max()))
        fail(DELAM_ERROR_ARGUMENT, "cells: ", part.nodes.size(), " nodes in one part, allowed: at most 2^31 - 1");
    part.connectivity.reserve(corners.size());
    for (const std::int64_t n : corners) {
        poll_cancel("copy");
        part.connectivity.push_back(
            static_cast<std::int32_t>(std::lower_bound(part.nodes.begin(), part.nodes.end(), n) - part.nodes.begin()));
    }
    for (const std::int64_t n : part.nodes) {
        poll_cancel("copy");
        const auto x = mesh.node(n);
        part.coordinates.insert(part.coordinates.end(), x.begin(), x.end());
    }
}

void take_body(const Problem& problem, std::int32_t body, Part& part) {
    if (problem.stiffness[index(body)] != nullptr)
        fail(DELAM_ERROR_PROBLEM, "body ", problem.mesh->body_label(body),
             " has the host's stiffness (delam_problem_set_stiffness): its cells can be in no part");
    require_material(problem, body);
    const BodyModel model = problem.model(body);
    part.labels.push_back(problem.mesh->body_label(body));
    part.formulation.push_back(static_cast<std::int32_t>(model.formulation));
    std::array<double, constants_of_body> constants{};
    if (const auto* orthotropic = std::get_if<Orthotropic>(&model.material)) {
        constants = orthotropic->constant;
        part.orthotropic.push_back(1);
    } else {
        const Elastic& isotropic = std::get<Elastic>(model.material);
        constants[0] = isotropic.young;
        constants[1] = isotropic.poisson;
        part.orthotropic.push_back(0);
    }
    part.constants.insert(part.constants.end(), constants.begin(), constants.end());
}

}  // namespace

Part part_of(const Problem& problem, std::span<const std::int64_t> cells) {
    const Mesh& mesh = *problem.mesh;
    Part part;
    part.dimension = mesh.dimension();
    part.plane = static_cast<std::int32_t>(problem.plane);
    take_nodes(mesh, cells, part);
    std::vector<std::int32_t> place(index(mesh.body_count()), -1);
    for (const std::int64_t c : cells) {
        poll_cancel("copy");
        part.types.push_back(static_cast<std::int32_t>(mesh.cell_type(c)));
        part.body.push_back(mesh.cell_body(c));
        place[index(part.body.back())] = 0;
    }
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        if (place[index(body)] < 0) continue;
        place[index(body)] = static_cast<std::int32_t>(part.labels.size());
        take_body(problem, body, part);
    }
    for (std::int32_t& body : part.body) body = place[index(body)];

    part.axes_of_cell.assign(cells.size(), -1);
    if (problem.orientation == nullptr) return part;
    std::vector<std::int32_t> number(problem.orientation->axes.size(), -1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::int32_t own = problem.orientation->of_cell[index(cells[i])];
        if (own < 0) continue;  // isotropic cells have axes, too: those of their eigenstrains
        if (number[index(own)] < 0) {
            const Axes& axes = problem.orientation->axes[index(own)];
            number[index(own)] = static_cast<std::int32_t>(part.axes.size() / axes.size());
            part.axes.insert(part.axes.end(), axes.begin(), axes.end());
        }
        part.axes_of_cell[i] = number[index(own)];
    }
    return part;
}

std::vector<std::uint8_t> save(const Part& part) {
    Writer w(part_version);
    w.item(part_magic);
    w.item(part_version);
    walk(w, part);
    w.item(checksum(w.bytes));
    return std::move(w.bytes);
}

Part load_part(std::span<const std::uint8_t> bytes) {
    Reader r(bytes, part_version, "part");
    std::uint64_t found_magic = 0, found_sum = 0;
    std::uint32_t found_version = 0;
    r.item(found_magic);
    if (found_magic != part_magic) fail(DELAM_ERROR_SNAPSHOT, "not a part of a libdelam problem");
    r.item(found_version);
    if (found_version != part_version)
        fail(DELAM_ERROR_SNAPSHOT, "part of version ", found_version, ", this library reads ", part_version);
    if (r.left() < sizeof(found_sum)) fail(DELAM_ERROR_SNAPSHOT, "part ends early at byte ", bytes.size());
    const auto checked = bytes.first(bytes.size() - sizeof(found_sum));
    std::memcpy(&found_sum, bytes.data() + checked.size(), sizeof(found_sum));
    if (found_sum != checksum(checked))
        fail(DELAM_ERROR_SNAPSHOT, "part is damaged: its checksum does not match its ", bytes.size(), " bytes");
    Part part;
    walk(r, part);
    if (r.left() < sizeof(found_sum)) fail(DELAM_ERROR_SNAPSHOT, "part ends early at byte ", bytes.size());
    if (r.left() > sizeof(found_sum))
        fail(DELAM_ERROR_SNAPSHOT, "part has ", r.left() - sizeof(found_sum), " bytes too many");
    return part;
}

SoundPart::SoundPart(const Part& part) : mesh_(empty_mesh(part)), nodes_(part.nodes.size()) {
    std::iota(nodes_.begin(), nodes_.end(), std::int64_t{0});
    refusing([&] { add_cells(part); });
    if (index(mesh_.body_count()) != part.labels.size())
        refuse(part.labels.size(), " bodies, of which ", mesh_.body_count(), " have cells");
    for (const std::int64_t n : nodes_)
        if (mesh_.node_body(n) < 0) refuse("node ", part.nodes[index(n)], ", which no cell has");

    std::shared_ptr<Orientation> orientation;
    if (!part.axes.empty()) {
        orientation = std::make_shared<Orientation>();
        for (std::size_t i = 0; i * std::tuple_size_v<Axes> < part.axes.size(); ++i)
            orientation->axes.push_back(axes_at(part, i));
        orientation->of_cell.resize(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) orientation->of_cell[index(cells_[i])] = part.axes_of_cell[i];
    }
    const auto plane = static_cast<Plane>(part.plane);
    for (std::size_t body = 0; body < part.labels.size(); ++body) {
        const auto formulation = static_cast<Formulation>(part.formulation[body]);
        // A part of a body with cells of several types may have none with incompatible modes.
        if (formulation != Formulation::incompatible)
            refusing([&] {
                require_formulation(mesh_, static_cast<std::int32_t>(body), formulation, DELAM_ERROR_ARGUMENT);
            });
        if (formulation == Formulation::mean_dilatation && plane == Plane::stress)
            refuse("formulation '", name_of(formulation), "' in plane stress");
        models_.push_back({material_of(part, body), plane, formulation, orientation});
    }
}

// Type by type, because a mesh takes cells of one type at a time.
void SoundPart::add_cells(const Part& part) {
    cells_.resize(part.types.size());
    for (const CellRow& row : cell_rows) {
        std::vector<std::int64_t> connectivity;
        std::vector<std::int32_t> labels;
        std::size_t first = 0;
        for (std::size_t c = 0; c < part.types.size(); ++c) {
            const auto type = static_cast<CellType>(part.types[c]);
            const std::size_t nodes = index(topology(type).nodes);
            if (type == row.type) {
                for (std::size_t k = 0; k < nodes; ++k) connectivity.push_back(part.connectivity[first + k]);
                cells_[c] = mesh_.cell_count() + static_cast<std::int64_t>(labels.size());
                labels.push_back(part.labels[index(part.body[c])]);
            }
            first += nodes;
        }
        if (!labels.empty()) mesh_.add_cells(row.type, connectivity, labels);
    }
}

SparseMatrix SoundPart::stiffness(const Poll& poll) const {
    return assemble_stiffness(mesh_, cells_, nodes_, models_, 1, poll);
}

std::vector<double> SoundPart::in_order(const std::vector<double>& of_mesh) const {
    const std::size_t columns = of_mesh.size() / cells_.size();
    std::vector<double> rows(of_mesh.size());
    for (std::size_t c = 0; c < cells_.size(); ++c)
        std::copy_n(of_mesh.begin() + static_cast<std::ptrdiff_t>(index(cells_[c]) * columns), columns,
                    rows.begin() + static_cast<std::ptrdiff_t>(c * columns));
    return rows;
}

std::vector<double> SoundPart::stress(std::span<const double> displacement, std::span<const Strain> strain) const {
    return in_order(centre_stress(mesh_, models_, displacement, strain));
}

std::vector<double> SoundPart::rotation(std::span<const double> displacement) const {
    return in_order(centre_rotation(mesh_, displacement));
}

std::int64_t SoundPart::entries() const { return stiffness_entries(mesh_, cells_, nodes_); }

}  // namespace delam
