// SPDX-License-Identifier: BSD-3-Clause
// Two layers that touch, whose stiffness each rank knows a strip of, and the variables of a scene made of them by hand,
// as the library's core makes them: u = T v + U theta.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "delam/experimental.h"

namespace verify {

using Indices = std::vector<std::int64_t>;
using Values = std::vector<double>;

inline std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Layers {
    std::int64_t dimension = 2;
    std::int64_t along = 8;   // cells along x
    std::int64_t across = 1;  // along y, in 3D
    std::int64_t height = 2;  // through each layer
    double length = 0.08, width = 0.02, thickness = 0.002;

    std::int64_t row() const { return (along + 1) * (dimension == 3 ? across + 1 : 1); }
    std::int64_t layer_nodes() const { return row() * (height + 1); }
    std::int64_t nodes() const { return 2 * layer_nodes(); }
    std::int64_t node(std::int64_t layer, std::int64_t x, std::int64_t y, std::int64_t level) const {
        return layer * layer_nodes() + level * row() + y * (along + 1) + x;
    }
    std::int64_t dof(std::int64_t n, std::int64_t component) const { return dimension * n + component; }
};

// The contribution of one rank: the stiffness of the cells from column `first` to `last`.
struct Strip {
    Indices nodes, row_starts, columns;
    Values coordinates, values;
};

inline void require(std::int32_t status, const char* what) {
    if (status == DELAM_OK) return;
    std::fprintf(stderr, "%s: %s\n", what, delam_status_name(status));
    std::abort();
}

inline Strip make_strip(const Layers& m, std::int64_t first, std::int64_t last) {
    Strip strip;
    strip.row_starts.push_back(0);
    if (first == last) return strip;
    delam_context* context = nullptr;
    delam_mesh* mesh = nullptr;
    delam_problem* problem = nullptr;
    require(delam_context_create(&context), "context");
    const double cell = m.length / static_cast<double>(m.along);
    const Values lengths{cell * static_cast<double>(last - first), m.width}, thickness{m.thickness, m.thickness};
    const Indices divisions{last - first, m.across}, layers{m.height, m.height};
    require(
        delam_mesh_create_layers(context, static_cast<std::int32_t>(m.dimension), lengths.data(), divisions.data(), 2,
                                 thickness.data(), layers.data(), m.dimension == 2 ? DELAM_QUAD4 : DELAM_HEX8, &mesh),
        "layers");
    require(delam_problem_create(context, mesh, &problem), "problem");
    for (std::int32_t body = 0; body < 2; ++body)
        require(delam_problem_set_elastic(problem, body, body == 0 ? 70e9 : 120e9, 0.3), "elastic");
    // How far an old preconditioner may be off is measured with these.
    require(delam_problem_set_formulation(problem, -1, "standard"), "formulation");
    std::int64_t count = 0;
    require(delam_mesh_size(mesh, nullptr, &count, nullptr, nullptr, nullptr), "size");
    strip.coordinates.resize(at(count * m.dimension));
    require(delam_mesh_nodes(mesh, count * m.dimension, strip.coordinates.data()), "nodes");
    for (std::int64_t i = 0; i < count; ++i)
        strip.coordinates[at(i * m.dimension)] += cell * static_cast<double>(first);
    for (std::int64_t layer = 0; layer < 2; ++layer)
        for (std::int64_t level = 0; level <= m.height; ++level)
            for (std::int64_t y = 0; y <= (m.dimension == 3 ? m.across : 0); ++y)
                for (std::int64_t x = first; x <= last; ++x) strip.nodes.push_back(m.node(layer, x, y, level));
    for (std::int32_t body = 0; body < 2; ++body) {
        std::int64_t rows = 0, entries = 0;
        require(delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr), "body");
        Indices starts(at(rows) + 1), columns(at(entries));
        Values values(at(entries));
        require(delam_problem_body_matrix(problem, body, &rows, &entries, starts.data(), columns.data(), values.data()),
                "body");
        const std::int64_t before = strip.row_starts.back(), offset = body * rows;
        for (std::int64_t r = 1; r <= rows; ++r) strip.row_starts.push_back(before + starts[at(r)]);
        for (const std::int64_t c : columns) strip.columns.push_back(offset + c);
        strip.values.insert(strip.values.end(), values.begin(), values.end());
    }
    delam_problem_destroy(&problem);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    return strip;
}

// The variables: the left end of the lower layer is clamped, a point of the right end of the upper one is moved by
// pattern 0, and pattern 1 pulls at the lower one. One DOF is the mean of two others far away, and one that of a
// control node, which no part has.
struct Variables {
    std::int64_t dimension = 0, dofs = 0;
    Indices homes, replaced, starts{0}, columns;
    Values coefficients;
    Indices lift_starts{0}, lift_dofs, force_starts{0}, force_dofs, visible;
    Values lift_values, force_values;
    std::int64_t pairs = 0;
    std::int64_t control = 0;  // its place in `visible`; the jumps come first

    delam_experimental_variables view() const {
        delam_experimental_variables v{};
        v.dimension = dimension;
        v.dofs = dofs;
        v.pattern_count = static_cast<std::int64_t>(lift_starts.size()) - 1;
        v.jump_count = static_cast<std::int64_t>(homes.size());
        v.homes = homes.data();
        v.replaced_count = static_cast<std::int64_t>(replaced.size());
        v.replaced = replaced.data();
        v.row_starts = starts.data();
        v.columns = columns.data();
        v.coefficients = coefficients.data();
        v.lift_starts = lift_starts.data();
        v.lift_dofs = lift_dofs.data();
        v.lift_values = lift_values.data();
        v.force_starts = force_starts.data();
        v.force_dofs = force_dofs.data();
        v.force_values = force_values.data();
        v.visible_count = static_cast<std::int64_t>(visible.size());
        v.visible = visible.data();
        return v;
    }
    void end_row(std::int64_t dof) {
        replaced.push_back(dof);
        starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
    void add(std::int64_t column, double coefficient) {
        columns.push_back(column);
        coefficients.push_back(coefficient);
    }
};

// hidden: nodes at the end that only the engine knows; the control node has the first number after the known ones,
// which moves the hidden ones up by one.
inline std::int64_t control_node(const Layers& m, std::int64_t hidden) { return m.nodes() - hidden; }
inline void move_hidden(const Layers& m, std::int64_t hidden, Indices& nodes) {
    for (std::int64_t& n : nodes)
        if (n >= control_node(m, hidden)) ++n;
}

inline Variables make_variables(const Layers& m, std::int64_t hidden) {
    Variables v;
    const std::int64_t d = m.dimension, deep = d == 3 ? m.across : 0, control = control_node(m, hidden);
    v.dimension = d;
    v.dofs = d * (control + 1);
    const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
    const double frame2[2][2] = {{-s, c}, {c, s}}, frame3[3][3] = {{0, -s, c}, {1, 0, 0}, {0, c, s}};
    for (std::int64_t y = 0; y <= deep; ++y)
        for (std::int64_t level = 0; level <= m.height; ++level)
            for (std::int64_t k = 0; k < d; ++k) v.end_row(m.dof(m.node(0, 0, y, level), k));
    for (std::int64_t y = 0; y <= deep; ++y)
        for (std::int64_t x = 0; x <= m.along; ++x) {
            const std::int64_t a = m.node(0, x, y, m.height), b = m.node(1, x, y, 0), first = d * v.pairs++;
            for (std::int64_t k = 0; k < d; ++k) {
                if (x > 0) v.add(m.dof(a, k), 1.0);
                for (std::int64_t i = 0; i < d; ++i) {
                    const double q = d == 2 ? frame2[i][k] : frame3[i][k];
                    if (q != 0.0) v.add(v.dofs + first + i, q);
                }
                v.end_row(m.dof(b, k));
                v.visible.push_back(v.dofs + first + k);
            }
            for (std::int64_t i = 0; i < d; ++i) v.homes.push_back(m.dof(b, d == 3 ? std::int64_t{2 - i} : 1 - i));
            if (d == 3) {  // normal: z; then x; then y
                v.homes[at(first)] = m.dof(b, 2);
                v.homes[at(first) + 1] = m.dof(b, 0);
                v.homes[at(first) + 2] = m.dof(b, 1);
            }
        }
    const std::int64_t moved = m.dof(m.node(1, m.along, 0, 1), d - 1);
    v.end_row(moved);
    v.add(m.dof(m.node(1, 1, 0, 1), 0), 0.5);
    v.add(m.dof(m.node(0, m.along - 1, deep, 0), 0), 0.5);
    v.end_row(m.dof(m.node(1, m.along / 2, 0, 1), 0));
    v.add(m.dof(control, 0), 1.0);
    v.end_row(m.dof(m.node(1, 0, 0, 1), 0));
    v.control = static_cast<std::int64_t>(v.visible.size());
    v.visible.push_back(m.dof(control, 0));
    v.visible.push_back(m.dof(m.node(1, 1, 0, 1), 0));
    v.visible.push_back(m.dof(m.node(0, m.along - 1, deep, 0), 0));
    v.lift_dofs = {moved};
    v.lift_values = {1e-4};
    v.lift_starts = {0, 1, 1};
    v.force_dofs = {m.dof(m.node(0, m.along, 0, 0), d - 1)};
    v.force_values = {-300.0};
    v.force_starts = {0, 0, 1};
    return v;
}

}  // namespace verify
