// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/selection.hpp"

namespace {

using namespace delam;

template <class T>
std::span<const T> view(const T* data, std::int64_t count) {
    return {data, index(count)};
}

CellType require_cell_type(std::int32_t type, std::int32_t dimension) {
    const CellRow* row = find_cell_row(type);
    if (row == nullptr) fail(DELAM_ERROR_ARGUMENT, "cell_type = ", type, " is outside 1 .. ", cell_rows.size());
    if (row->topology.dimension != dimension) {
        fail(DELAM_ERROR_ARGUMENT, "cell_type = ", type, " is a cell of dimension ", row->topology.dimension,
             ", the mesh has dimension ", dimension);
    }
    return row->type;
}

void require_dimension(std::int32_t dimension) {
    if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension = ", dimension, ", must be 2 or 3");
}

void require_positive(const double* values, std::int64_t count, const char* name) {
    require_array(values, count, name);
    require_finite(values, count, name);
    for (std::int64_t i = 0; i < count; ++i) {
        if (values[i] <= 0.0) fail(DELAM_ERROR_ARGUMENT, name, "[", i, "] = ", values[i], " must be > 0");
    }
}

void require_divisions(const std::int64_t* values, std::int64_t count, const char* name) {
    require_array(values, count, name);
    for (std::int64_t i = 0; i < count; ++i) {
        if (values[i] < 1 || values[i] > (std::int64_t{1} << 31)) {
            fail(DELAM_ERROR_ARGUMENT, name, "[", i, "] = ", values[i], " is outside 1 .. ", std::int64_t{1} << 31);
        }
    }
}

std::int32_t require_body(const Mesh& mesh, std::int32_t label, const char* name, bool all) {
    if (all && label == -1) return -1;
    const std::int32_t body = label < 0 ? -1 : mesh.body_of_label(label);
    if (body < 0) fail(DELAM_ERROR_ARGUMENT, name, " = ", label, ": no body has this label");
    return body;
}

const InterfaceGeometry& require_interface(const Mesh& mesh, std::int64_t interface) {
    const auto count = static_cast<std::int64_t>(mesh.interfaces().size());
    return mesh.interfaces()[index(require_index(interface, count, 0, "interface_index"))];
}

struct Cells {
    CellType type;
    std::vector<std::int64_t> nodes;
    std::vector<std::int32_t> labels;
};

Cells take_cells(const Mesh& mesh, std::int32_t cell_type, std::int64_t cell_count, const std::int64_t* connectivity,
                 const std::int32_t* bodies, std::int32_t index_base) {
    Cells cells{require_cell_type(cell_type, mesh.dimension()), {}, {}};
    require_count(cell_count, "cell_count");
    require_array(connectivity, cell_count, "connectivity");
    require_base(index_base);
    const std::int64_t per_cell = topology(cells.type).nodes;
    cells.nodes.resize(index(cell_count * per_cell));
    for (std::int64_t i = 0; i < cell_count * per_cell; ++i) {
        if (connectivity[i] < index_base || connectivity[i] - index_base >= mesh.node_count()) {
            fail(DELAM_ERROR_ARGUMENT, "connectivity: cell ", i / per_cell + index_base, " has node ", connectivity[i],
                 ", outside ", index_base, " .. ", mesh.node_count() - 1 + index_base);
        }
        cells.nodes[index(i)] = connectivity[i] - index_base;
    }
    cells.labels.assign(index(cell_count), 0);
    for (std::int64_t c = 0; c < cell_count && bodies != nullptr; ++c) {
        if (bodies[c] < 0) fail(DELAM_ERROR_ARGUMENT, "bodies[", c, "] = ", bodies[c], " must be >= 0");
        cells.labels[index(c)] = bodies[c];
    }
    return cells;
}

double require_tolerance(double tolerance) {
    if (!(tolerance >= 0.0 && tolerance < 0.5)) {
        fail(DELAM_ERROR_ARGUMENT, "tolerance = ", tolerance, " is outside 0 <= tolerance < 0.5");
    }
    return tolerance;
}

void require_two_bodies(const Mesh& mesh, std::int32_t body_a, std::int32_t body_b) {
    require_body(mesh, body_a, "body_a", false);
    require_body(mesh, body_b, "body_b", false);
    if (body_a == body_b) fail(DELAM_ERROR_ARGUMENT, "body_a and body_b are both ", body_a, ", expected two bodies");
}

// add: one of the functions for bodies whose meshes do not match.
void add_unmatched(decltype(add_mortar_interface)& add, Mesh& mesh, std::int32_t body_a, std::int32_t body_b,
                   double gap, std::int64_t* out_interface) {
    require_pointer(out_interface, "out_interface");
    if (!(gap >= 0.0 && std::isfinite(gap))) fail(DELAM_ERROR_ARGUMENT, "gap = ", gap, " must be >= 0 and finite");
    require_two_bodies(mesh, body_a, body_b);
    *out_interface = add(mesh, body_a, body_b, gap);
}

// Writes as many as fit and returns how many there are.
template <class T>
void give(const std::vector<T>& list, std::int64_t capacity, T* out) {
    const auto count = std::min(capacity, static_cast<std::int64_t>(list.size()));
    if (out != nullptr) std::copy_n(list.begin(), count, out);
}

void hand_out(delam_context* context, Mesh&& core, delam_mesh** out) {
    auto mesh = std::make_unique<delam_mesh>();
    mesh->context = context->context;
    mesh->core = std::make_shared<Mesh>(std::move(core));
    *out = mesh.release();
}

}  // namespace

int32_t delam_mesh_create(delam_context* context, int32_t dimension, int64_t node_count, const double* nodes,
                          delam_mesh** out) {
    if (out != nullptr) *out = nullptr;
    return guard(context, [&] {
        require_pointer(out, "out");
        require_dimension(dimension);
        require_count(node_count, "node_count", 1);
        require_array(nodes, node_count, "nodes");
        require_finite(nodes, node_count * dimension, "nodes");
        hand_out(context, Mesh(dimension, view(nodes, node_count * dimension)), out);
    });
}

int32_t delam_mesh_create_layers(delam_context* context, int32_t dimension, const double* lengths,
                                 const int64_t* divisions, int64_t layer_count, const double* thickness,
                                 const int64_t* layer_divisions, int32_t cell_type, delam_mesh** out) {
    if (out != nullptr) *out = nullptr;
    return guard_build(context, [&] {
        require_pointer(out, "out");
        require_dimension(dimension);
        require_positive(lengths, dimension - 1, "lengths");
        require_divisions(divisions, dimension - 1, "divisions");
        require_count(layer_count, "layer_count", 1);
        require_positive(thickness, layer_count, "thickness");
        require_divisions(layer_divisions, layer_count, "layer_divisions");
        // 1e11 cells fit no memory, and products of larger numbers might overflow an index.
        double cells = 0.0;
        for (std::int64_t i = 0; i < layer_count; ++i) cells += static_cast<double>(layer_divisions[i]);
        for (std::int32_t d = 0; d + 1 < dimension; ++d) cells *= static_cast<double>(divisions[d]);
        if (cells > 1e11) fail(DELAM_ERROR_ARGUMENT, "divisions give ", cells, " cells, allowed: up to 1e11");
        hand_out(context,
                 make_layers(dimension, view(lengths, dimension - 1), view(divisions, dimension - 1),
                             view(thickness, layer_count), view(layer_divisions, layer_count),
                             require_cell_type(cell_type, dimension)),
                 out);
    });
}

int32_t delam_mesh_add_cells(delam_mesh* mesh, int32_t cell_type, int64_t cell_count, const int64_t* connectivity,
                             const int32_t* bodies, int32_t index_base) {
    return guard_build(mesh, [&] {
        const Cells cells = take_cells(*mesh->core, cell_type, cell_count, connectivity, bodies, index_base);
        mesh->core->add_cells(cells.type, cells.nodes, cells.labels);
    });
}

int32_t delam_mesh_add_conforming_cells(delam_mesh* mesh, int32_t cell_type, int64_t cell_count,
                                        const int64_t* connectivity, const int32_t* bodies, int32_t index_base) {
    return guard_build(mesh, [&] {
        const Cells cells = take_cells(*mesh->core, cell_type, cell_count, connectivity, bodies, index_base);
        mesh->core->add_conforming_cells(cells.type, cells.nodes, cells.labels);
    });
}

int32_t delam_mesh_add_interface(delam_mesh* mesh, int32_t body_a, int32_t body_b, double tolerance,
                                 int64_t* out_interface) {
    return guard_build(mesh, [&] {
        require_pointer(out_interface, "out_interface");
        require_tolerance(tolerance);
        require_two_bodies(*mesh->core, body_a, body_b);
        *out_interface = add_interface(*mesh->core, body_a, body_b, tolerance);
    });
}

int32_t delam_mesh_add_all_interfaces(delam_mesh* mesh, double tolerance, int64_t* out_count) {
    return guard_build(mesh, [&] {
        require_pointer(out_count, "out_count");
        *out_count = add_all_interfaces(*mesh->core, require_tolerance(tolerance));
    });
}

int32_t delam_mesh_add_seams(delam_mesh* mesh, double tolerance, int64_t* out_count) {
    return guard_build(mesh, [&] {
        require_pointer(out_count, "out_count");
        *out_count = add_seams(*mesh->core, require_tolerance(tolerance));
    });
}

int32_t delam_mesh_add_self_contact(delam_mesh* mesh, double gap, int64_t* out_count) {
    return guard_build(mesh, [&] {
        require_pointer(out_count, "out_count");
        *out_count = add_self_contact(*mesh->core, gap);
    });
}

int32_t delam_mesh_add_projected_interface(delam_mesh* mesh, int32_t body_a, int32_t body_b, double gap,
                                           int64_t* out_interface) {
    return guard_build(
        mesh, [&] { add_unmatched(add_projected_interface, *mesh->core, body_a, body_b, gap, out_interface); });
}

int32_t delam_mesh_add_mortar_interface(delam_mesh* mesh, int32_t body_a, int32_t body_b, double gap,
                                        int64_t* out_interface) {
    return guard_build(mesh,
                       [&] { add_unmatched(add_mortar_interface, *mesh->core, body_a, body_b, gap, out_interface); });
}

int32_t delam_mesh_add_obstacle(delam_mesh* mesh, int64_t count, const int64_t* nodes, const double* normals,
                                const double* weights, int64_t control_node, int32_t index_base,
                                int64_t* out_interface) {
    return guard_build(mesh, [&] {
        Mesh& core = *mesh->core;
        require_pointer(out_interface, "out_interface");
        require_count(count, "count", 1);
        require_array(normals, count, "normals");
        require_base(index_base);
        const std::vector<std::int64_t> own = require_indices(nodes, count, core.node_count(), index_base, "nodes");
        require_index(control_node, core.node_count(), 0, "control_node");
        *out_interface = add_obstacle(core, own, view(normals, count * core.dimension()),
                                      view(weights, weights == nullptr ? 0 : count), control_node);
    });
}

int32_t delam_mesh_add_host_body(delam_mesh* mesh, int32_t body, int64_t count, const int64_t* nodes,
                                 int32_t index_base) {
    return guard_build(mesh, [&] {
        Mesh& core = *mesh->core;
        require_count(count, "count", 1);
        require_base(index_base);
        core.add_host_body(body, require_indices(nodes, count, core.node_count(), index_base, "nodes"));
    });
}

int32_t delam_mesh_add_pairs(delam_mesh* mesh, int32_t body_a, int32_t body_b, int64_t count, const int64_t* nodes_a,
                             const int64_t* nodes_b, const double* normals, const double* weights, int64_t face_count,
                             int32_t nodes_per_face, const int64_t* faces, int32_t index_base, int64_t* out_interface) {
    return guard_build(mesh, [&] {
        Mesh& core = *mesh->core;
        require_pointer(out_interface, "out_interface");
        require_body(core, body_a, "body_a", false);
        require_body(core, body_b, "body_b", false);
        require_count(count, "count", 1);
        require_array(normals, count, "normals");
        require_array(weights, count, "weights");
        require_count(face_count, "face_count");
        if (face_count > 0 && find_face_row(core.dimension(), nodes_per_face) == nullptr)
            fail(DELAM_ERROR_ARGUMENT, "nodes_per_face = ", nodes_per_face, ": must be ", face_sizes(core.dimension()));
        require_base(index_base);
        const std::int64_t corners = face_count > 0 ? face_count * nodes_per_face : 0;
        *out_interface =
            add_pairs(core, body_a, body_b, require_indices(nodes_a, count, core.node_count(), index_base, "nodes_a"),
                      require_indices(nodes_b, count, core.node_count(), index_base, "nodes_b"),
                      view(normals, count * core.dimension()), view(weights, count), nodes_per_face,
                      require_indices(faces, corners, count, index_base, "faces"));
    });
}

void delam_mesh_destroy(delam_mesh** mesh) { destroy(mesh); }

int32_t delam_mesh_size(const delam_mesh* mesh, int32_t* dimension, int64_t* node_count, int64_t* cell_count,
                        int64_t* body_count, int64_t* interface_count) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        if (dimension != nullptr) *dimension = core.dimension();
        if (node_count != nullptr) *node_count = core.node_count();
        if (cell_count != nullptr) *cell_count = core.cell_count();
        if (body_count != nullptr) *body_count = core.body_count();
        if (interface_count != nullptr) *interface_count = static_cast<std::int64_t>(core.interfaces().size());
    });
}

int32_t delam_mesh_nodes(const delam_mesh* mesh, int64_t capacity, double* nodes) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        require_pointer(nodes, "nodes");
        require_capacity(capacity, core.node_count() * core.dimension(), "nodes");
        std::copy(core.nodes().begin(), core.nodes().end(), nodes);
    });
}

int32_t delam_mesh_node_bodies(const delam_mesh* mesh, int64_t capacity, int32_t* bodies) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        require_pointer(bodies, "bodies");
        require_capacity(capacity, core.node_count(), "bodies");
        for (std::int64_t node = 0; node < core.node_count(); ++node) {
            const std::int32_t body = core.node_body(node);
            bodies[node] = body < 0 ? -1 : core.body_label(body);
        }
    });
}

int32_t delam_mesh_node_origins(const delam_mesh* mesh, int64_t capacity, int64_t* origins) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        require_pointer(origins, "origins");
        require_capacity(capacity, core.node_count(), "origins");
        for (std::int64_t node = 0; node < core.node_count(); ++node) origins[node] = core.node_origin(node);
    });
}

int32_t delam_mesh_node_ties(const delam_mesh* mesh, int64_t* count, int64_t* entries, int64_t* nodes, int64_t* starts,
                             int64_t* of, double* weights) {
    return guard(mesh, [&] {
        const std::vector<NodeTie>& ties = mesh->core->ties();
        std::int64_t entry = 0;
        for (std::size_t i = 0; i < ties.size(); ++i) {
            if (nodes != nullptr) nodes[i] = ties[i].node;
            if (starts != nullptr) starts[i] = entry;
            for (const auto& [node, weight] : ties[i].of) {
                if (of != nullptr) of[entry] = node;
                if (weights != nullptr) weights[entry] = weight;
                ++entry;
            }
        }
        if (starts != nullptr) starts[ties.size()] = entry;
        if (count != nullptr) *count = static_cast<std::int64_t>(ties.size());
        if (entries != nullptr) *entries = entry;
    });
}

int32_t delam_mesh_cells(const delam_mesh* mesh, int32_t* types, int32_t* bodies, int64_t* offsets, int64_t capacity,
                         int64_t* connectivity, int64_t* needed) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        std::int64_t entries = 0;
        for (std::int64_t c = 0; c < core.cell_count(); ++c) entries += static_cast<std::int64_t>(core.cell(c).size());
        require_capacity_if(connectivity != nullptr, capacity, entries, "connectivity");
        if (needed != nullptr) *needed = entries;
        std::int64_t offset = 0;
        for (std::int64_t c = 0; c < core.cell_count(); ++c) {
            const std::span<const std::int64_t> cell = core.cell(c);
            if (types != nullptr) types[c] = static_cast<std::int32_t>(core.cell_type(c));
            if (bodies != nullptr) bodies[c] = core.body_label(core.cell_body(c));
            if (offsets != nullptr) offsets[c] = offset;
            if (connectivity != nullptr) std::copy(cell.begin(), cell.end(), connectivity + offset);
            offset += static_cast<std::int64_t>(cell.size());
        }
        if (offsets != nullptr) offsets[core.cell_count()] = offset;
    });
}

int32_t delam_mesh_interface_size(const delam_mesh* mesh, int64_t interface_index, int32_t* body_a, int32_t* body_b,
                                  int64_t* pair_count, int64_t* face_count, int32_t* nodes_per_face) {
    return guard(mesh, [&] {
        const InterfaceGeometry& face = require_interface(*mesh->core, interface_index);
        if (body_a != nullptr) *body_a = face.body_a < 0 ? -1 : mesh->core->body_label(face.body_a);
        if (body_b != nullptr) *body_b = mesh->core->body_label(face.body_b);
        if (pair_count != nullptr) *pair_count = face.pair_count();
        if (face_count != nullptr) *face_count = face.face_count();
        if (nodes_per_face != nullptr) *nodes_per_face = face.nodes_per_face;
    });
}

int32_t delam_mesh_interface_pairs(const delam_mesh* mesh, int64_t interface_index, int64_t* nodes_a, int64_t* nodes_b,
                                   double* weights, double* frames) {
    return guard(mesh, [&] {
        const InterfaceGeometry& face = require_interface(*mesh->core, interface_index);
        if (nodes_a != nullptr) std::copy(face.node_a.begin(), face.node_a.end(), nodes_a);
        if (nodes_b != nullptr) std::copy(face.node_b.begin(), face.node_b.end(), nodes_b);
        if (weights != nullptr) std::copy(face.weight.begin(), face.weight.end(), weights);
        if (frames != nullptr) std::copy(face.frame.begin(), face.frame.end(), frames);
    });
}

int32_t delam_mesh_interface_faces(const delam_mesh* mesh, int64_t interface_index, int64_t* faces) {
    return guard(mesh, [&] {
        const InterfaceGeometry& face = require_interface(*mesh->core, interface_index);
        require_array(faces, static_cast<std::int64_t>(face.face.size()), "faces");
        std::copy(face.face.begin(), face.face.end(), faces);
    });
}

int32_t delam_mesh_find_nodes(const delam_mesh* mesh, int32_t body, const double* lower, const double* upper,
                              int64_t capacity, int64_t* nodes, int64_t* count) {
    return guard(mesh, [&] {
        const Mesh& core = *mesh->core;
        require_pointer(count, "count");
        require_count(capacity, "capacity");
        require_array(nodes, capacity, "nodes");
        require_box(core.dimension(), lower, upper);
        const std::vector<std::int64_t> found = find_nodes(
            core, require_body(core, body, "body", true), view(lower, core.dimension()), view(upper, core.dimension()));
        give(found, capacity, nodes);
        *count = static_cast<std::int64_t>(found.size());
    });
}

int32_t delam_mesh_find_patch(const delam_mesh* mesh, int32_t body, const double* lower, const double* upper,
                              const double* direction, int64_t capacity, int64_t* nodes, double* weights,
                              int64_t* count) {
    return guard_read(mesh, [&] {
        const Mesh& core = *mesh->core;
        const int dimension = core.dimension();
        require_pointer(count, "count");
        require_count(capacity, "capacity");
        require_array(nodes, capacity, "nodes");
        require_array(weights, capacity, "weights");
        require_box(core.dimension(), lower, upper);
        require_pointer(direction, "direction");
        require_finite(direction, dimension, "direction");
        if (std::all_of(direction, direction + dimension, [](double d) { return d == 0.0; })) {
            fail(DELAM_ERROR_ARGUMENT, "direction has length 0");
        }
        const Patch patch = find_patch(core, require_body(core, body, "body", true), view(lower, dimension),
                                       view(upper, dimension), view(direction, dimension));
        give(patch.nodes, capacity, nodes);
        give(patch.weights, capacity, weights);
        *count = static_cast<std::int64_t>(patch.nodes.size());
    });
}
