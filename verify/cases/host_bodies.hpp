// SPDX-License-Identifier: BSD-3-Clause
// Scenes whose bodies are sparse matrices of the host.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace cases {

using reference::Scene;

struct Csr {
    std::vector<std::int64_t> start, column;
    std::vector<double> value;
};

inline Csr body_matrix(const Scene& scene, std::int32_t body) {
    std::int64_t rows = 0, entries = 0;
    REQUIRE(scene, delam_problem_body_matrix, scene.problem(), body, &rows, &entries, nullptr, nullptr, nullptr);
    Csr k{std::vector<std::int64_t>(static_cast<std::size_t>(rows) + 1),
          std::vector<std::int64_t>(static_cast<std::size_t>(entries)),
          std::vector<double>(static_cast<std::size_t>(entries))};
    REQUIRE(scene, delam_problem_body_matrix, scene.problem(), body, nullptr, nullptr, k.start.data(), k.column.data(),
            k.value.data());
    return k;
}

inline std::vector<std::int64_t> nodes_of(const Scene& scene, std::int32_t body) {
    std::vector<std::int32_t> bodies(scene.node_count());
    REQUIRE(scene, delam_mesh_node_bodies, scene.mesh(), static_cast<std::int64_t>(bodies.size()), bodies.data());
    std::vector<std::int64_t> nodes;
    for (std::size_t n = 0; n < bodies.size(); ++n)
        if (bodies[n] == body) nodes.push_back(static_cast<std::int64_t>(n));
    return nodes;
}

inline void check(std::int32_t status, delam_context* context) {
    if (status != DELAM_OK) throw reference::Failure(status, delam_context_message(context));
}

// A mesh of nodes, and the scene that is made of it.
struct Made {
    reference::Context context;
    reference::Mesh mesh;
    delam_mesh* m = nullptr;

    Made(std::int32_t dimension, const std::vector<double>& nodes) {
        delam_context* c = nullptr;
        check(delam_context_create(&c), c);
        context.reset(c);
        expect(delam_mesh_create(c, dimension, static_cast<std::int64_t>(nodes.size()) / dimension, nodes.data(), &m));
        mesh = reference::Mesh(m);
    }
    void expect(std::int32_t status) const { check(status, context.get()); }
    void add_host_body(std::int32_t label, const std::vector<std::int64_t>& nodes) const {
        expect(delam_mesh_add_host_body(m, label, static_cast<std::int64_t>(nodes.size()), nodes.data(), 0));
    }
    Scene scene() {
        delam_problem* p = nullptr;
        expect(delam_problem_create(context.get(), m, &p));
        return Scene::adopt(std::move(context), std::move(mesh), reference::Problem(p),
                            std::vector<reference::InterfaceStiffness>(4));
    }
};

// Two layers, elastic.
inline Scene two_layers(double length, std::int64_t cells, double thickness, std::int64_t across, double young,
                        double poisson, std::int64_t upper = 1) {
    Scene scene(2, {length}, {cells}, {thickness, thickness}, {across, upper}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    return scene;
}

// Nodes and interfaces of a scene, its bodies without cells.
inline Scene without_cells(const Scene& own, const std::vector<std::int32_t>& bodies) {
    Made made(own.dimension(), {own.nodes().begin(), own.nodes().end()});
    for (const std::int32_t body : bodies) made.add_host_body(body, nodes_of(own, body));
    const auto dim = static_cast<std::size_t>(own.dimension());
    std::int64_t interfaces = 0;
    REQUIRE(own, delam_mesh_size, own.mesh(), nullptr, nullptr, nullptr, nullptr, &interfaces);
    for (std::int64_t i = 0; i < interfaces; ++i) {
        const reference::Pairs pairs = own.pairs(i);
        std::vector<double> normals;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            normals.insert(normals.end(), pairs.frame.begin() + static_cast<std::ptrdiff_t>(p * dim * dim),
                           pairs.frame.begin() + static_cast<std::ptrdiff_t>(p * dim * dim + dim));
        std::int32_t a = 0, b = 0, per_face = 0;
        std::int64_t faces = 0, added = -1;
        check(delam_mesh_interface_size(own.mesh(), i, &a, &b, nullptr, &faces, &per_face), own.context());
        std::vector<std::int64_t> face(static_cast<std::size_t>(faces * per_face));
        check(delam_mesh_interface_faces(own.mesh(), i, face.data()), own.context());
        made.expect(delam_mesh_add_pairs(made.m, a, b, static_cast<std::int64_t>(pairs.count()), pairs.node_a.data(),
                                         pairs.node_b.data(), normals.data(), pairs.weight.data(), faces, per_face,
                                         face.data(), 0, &added));
        expect(added == i, "index of the interface");
    }
    return made.scene();
}

// Two matrices as one that does not couple them.
inline Csr stacked(Csr both, const Csr& other) {
    const std::int64_t rows = static_cast<std::int64_t>(both.start.size()) - 1, entries = both.start.back();
    for (std::size_t r = 1; r < other.start.size(); ++r) both.start.push_back(entries + other.start[r]);
    for (const auto column : other.column) both.column.push_back(column + rows);
    both.value.insert(both.value.end(), other.value.begin(), other.value.end());
    return both;
}

inline std::vector<std::int64_t> joined(std::vector<std::int64_t> a, const std::vector<std::int64_t>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

inline std::int32_t give(const Scene& scene, const std::vector<std::int64_t>& nodes, const Csr& k,
                         std::int64_t kernel_count = -1, const double* kernel = nullptr) {
    return delam_problem_set_stiffness(scene.problem(), static_cast<std::int64_t>(nodes.size()), nodes.data(), nullptr,
                                       k.start.data(), k.column.data(), k.value.data(), kernel_count, kernel, 0);
}

}  // namespace cases
