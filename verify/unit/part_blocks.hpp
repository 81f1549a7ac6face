// SPDX-License-Identifier: BSD-3-Clause
// Two blocks of crooked cells of all kinds, for tests of parts of a problem.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "check.hpp"
#include "delam/experimental.h"
#include "mesh/mesh.hpp"
#include "same_bits.hpp"
#include "scene/problem.hpp"

namespace delam::part_test {

inline constexpr double nan_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr int plies = 7,
                     core_layer = 3;  // labels; the plies come first in the mesh, last in the order of labels

using Place = std::array<std::int64_t, 3>;  // on a lattice with a node in the middle of every edge

struct Shape {
    int dimension;
    CellType box, simplex;
    const char *plane, *formulation;
    bool mixed;  // has the upper body simplices too?
};
inline const Shape shapes[] = {
    {2, CellType::quad4, CellType::tri3, "plane-strain", "incompatible", false},
    {2, CellType::quad8, CellType::tri6, "plane-strain", "mean-dilatation", true},
    {2, CellType::quad9, CellType::tri6, "plane-stress", "standard", true},
    {3, CellType::hex8, CellType::tet4, nullptr, "incompatible", false},
    {3, CellType::hex8, CellType::tet4, nullptr, "mean-dilatation", false},
    {3, CellType::hex20, CellType::tet10, nullptr, "mean-dilatation", true},
};
inline constexpr int shape_count = static_cast<int>(std::size(shapes));

// Two blocks of crooked cells, one above the other. Boxes and simplices take turns, so that no type comes in one run.
class Blocks {
public:
    explicit Blocks(const Shape& shape) : shape_(shape), size_{9, 5, shape.dimension == 3 ? 5 : 1} {
        ck_assert_int_eq(delam_context_create(&context), 0);
        std::vector<double> nodes;
        for (int body = 0; body < 2; ++body)
            for (std::int64_t k = 0; k < size_[2]; ++k)
                for (std::int64_t j = 0; j < size_[1]; ++j)
                    for (std::int64_t i = 0; i < size_[0]; ++i) add_node(body, {i, j, k}, nodes);
        expect(delam_mesh_create(context, shape.dimension, static_cast<std::int64_t>(nodes.size()) / shape.dimension,
                                 nodes.data(), &mesh));
        for (int body = 0; body < 2; ++body)
            for (std::int64_t k = 0; k + 1 < std::max<std::int64_t>(size_[2], 2); k += 2)
                for (std::int64_t j = 0; j + 1 < size_[1]; j += 2)
                    for (std::int64_t i = 0; i + 1 < size_[0]; i += 2) {
                        const bool split = (i + j + k) % 4 == 2 && (body == 1 || shape.mixed);
                        split ? add_simplices(body, {i, j, k}) : add_box(body, {i, j, k});
                    }
        expect(delam_problem_create(context, mesh, &problem));
        set_bodies();
    }
    ~Blocks() {
        delam_problem_destroy(&problem);
        delam_mesh_destroy(&mesh);
        delam_context_destroy(&context);
    }
    Blocks(const Blocks&) = delete;
    Blocks& operator=(const Blocks&) = delete;

    delam_context* context = nullptr;
    delam_mesh* mesh = nullptr;
    delam_problem* problem = nullptr;

    void expect(std::int32_t status) const {
        ck_assert_msg(status == 0, "%d: %s", status, delam_context_message(context));
    }
    // The last call was refused with words that say this.
    void refused(std::int32_t status, std::int32_t expected, const std::string& words) const {
        const std::string said = delam_context_message(context);
        ck_assert_msg(status == expected && said.find(words) != std::string::npos, "%d, not %d: '%s' without '%s'",
                      status, expected, said.c_str(), words.c_str());
    }
    const Mesh& core() const { return *problem->core->mesh; }
    std::vector<std::uint8_t> part(const std::vector<std::int64_t>& cells) const {
        std::int64_t size = 0;
        const auto count = static_cast<std::int64_t>(cells.size());
        expect(delam_experimental_problem_part(problem, count, cells.data(), 0, nullptr, &size));
        std::vector<std::uint8_t> bytes(index(size));
        expect(delam_experimental_problem_part(problem, count, cells.data(), size, bytes.data(), nullptr));
        return bytes;
    }

private:
    std::int64_t number(int body, const Place& p) const {
        return p[0] + size_[0] * (p[1] + size_[1] * (p[2] + size_[2] * body));
    }
    void add_node(int body, const Place& p, std::vector<double>& nodes) const {
        const double x = 0.5e-3 * static_cast<double>(p[0]), y = 0.4e-3 * static_cast<double>(p[1]),
                     z = 0.3e-3 * static_cast<double>(p[2]);
        const double bent[] = {x + 4e-5 * std::sin(2e3 * y), y + 3e-5 * std::sin(1.5e3 * x + 2e3 * z),
                               z + 2e-5 * std::sin(1e3 * (x + y))};
        for (int d = 0; d < shape_.dimension; ++d)
            nodes.push_back(bent[d] + (d == shape_.dimension - 1 ? 2e-3 * body : 0.0));
    }
    // Corners, then what lies in the middle between two of them.
    void add_cell(int body, CellType type, std::vector<Place> place) {
        const CellTopology& own = topology(type);
        for (int m = 0; own.corners + m < own.nodes; ++m) {
            const Place &a = place[index(own.middle[index(m)][0])], &b = place[index(own.middle[index(m)][1])];
            place.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
        }
        std::vector<std::int64_t> nodes;
        for (const Place& p : place) nodes.push_back(number(body, p));
        const std::int32_t label = body == 0 ? plies : core_layer;
        expect(delam_mesh_add_cells(mesh, static_cast<std::int32_t>(type), 1, nodes.data(), &label, 0));
    }
    void add_box(int body, const Place& p) {
        std::vector<Place> corners;
        for (std::int64_t k = 0; k < (shape_.dimension == 3 ? 4 : 2); k += 2)
            for (const auto& [i, j] : {std::pair{0, 0}, {2, 0}, {2, 2}, {0, 2}})
                corners.push_back({p[0] + i, p[1] + j, p[2] + k});
        add_cell(body, shape_.box, corners);
    }
    // One simplex for each order of the axes, from the lowest corner to the opposite one.
    void add_simplices(int body, const Place& p) {
        std::array<std::size_t, 3> order{0, 1, 2};
        const auto last = order.begin() + shape_.dimension;
        do {
            std::vector<Place> corners{p};
            int inversions = 0;
            for (auto axis = order.begin(); axis != last; ++axis) {
                corners.push_back(corners.back());
                corners.back()[*axis] += 2;
                inversions += static_cast<int>(std::count_if(order.begin(), axis, [&](auto a) { return a > *axis; }));
            }
            if (inversions % 2 == 1) std::swap(corners[1], corners[2]);
            add_cell(body, shape_.simplex, corners);
        } while (std::next_permutation(order.begin(), last));
    }
    // Orthotropic plies whose cells have axes of their own but for every third, on an isotropic core.
    void set_bodies() {
        const double ply[] = {135e9, 9e9, 8e9, 0.24, 0.26, 0.46, 5.2e9, 4.8e9, 3.1e9};
        if (shape_.plane != nullptr) expect(delam_problem_set_plane(problem, shape_.plane));
        expect(delam_problem_set_orthotropic(problem, plies, ply));
        expect(delam_problem_set_elastic(problem, core_layer, 3.4e9, 0.35));
        expect(delam_problem_set_formulation(problem, plies, shape_.formulation));
        std::vector<std::int64_t> cells;
        std::vector<double> axes;
        for (std::int64_t c = 0; c < core().cell_count(); ++c) {
            if (c % 3 == 2) continue;
            cells.push_back(c);
            const double angle = 0.3 * static_cast<double>(c % 4);
            for (const double x : {std::cos(angle), std::sin(angle), 0.1, 0.2, 1.0, -0.1}) axes.push_back(x);
        }
        expect(delam_problem_set_orientation(problem, -1, static_cast<std::int64_t>(cells.size()), cells.data(),
                                             axes.data(), 0));
    }

    const Shape& shape_;
    Place size_;
};

struct Matrix {
    std::int64_t dimension = 0, nodes = 0, entries = 0;
    std::vector<std::int64_t> node, start, column;
    std::vector<double> place, value;
};

inline Matrix matrix_of(const Blocks& b, const std::vector<std::uint8_t>& bytes) {
    Matrix m;
    const auto size = static_cast<std::int64_t>(bytes.size());
    b.expect(delam_experimental_part_matrix(b.context, size, bytes.data(), &m.dimension, &m.nodes, &m.entries, nullptr,
                                            nullptr, nullptr, nullptr, nullptr));
    m.node.resize(index(m.nodes));
    m.place.resize(index(m.nodes * m.dimension));
    m.start.resize(m.place.size() + 1);
    m.column.resize(index(m.entries));
    m.value.resize(m.column.size());
    std::int64_t again = 0;
    b.expect(delam_experimental_part_matrix(b.context, size, bytes.data(), nullptr, nullptr, &again, m.node.data(),
                                            m.place.data(), m.start.data(), m.column.data(), m.value.data()));
    ck_assert_int_eq(again, m.entries);
    ck_assert_int_eq(m.start.back(), m.entries);
    for (std::size_t i = 0; i < m.node.size(); ++i) {
        ck_assert(i == 0 || m.node[i] > m.node[i - 1]);
        const auto x = b.core().node(m.node[i]);
        ck_assert(std::equal(x.begin(), x.end(), m.place.begin() + static_cast<std::int64_t>(i) * m.dimension));
    }
    return m;
}

}  // namespace delam::part_test
