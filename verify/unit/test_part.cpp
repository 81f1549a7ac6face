// SPDX-License-Identifier: BSD-3-Clause
// Parts of a problem as bytes: their matrices add up to those of the bodies, and damaged bytes are refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "check.hpp"
#include "delam/experimental.h"
#include "part_blocks.hpp"
#include "scene/part.hpp"

using namespace delam;
using namespace delam::part_test;

namespace {

Matrix body_matrix(const Blocks& b, std::int32_t label) {
    Matrix m;
    m.dimension = b.core().dimension();
    m.node = b.core().body_nodes(b.core().body_of_label(label));
    std::int64_t rows = 0;
    b.expect(delam_problem_body_matrix(b.problem, label, &rows, &m.entries, nullptr, nullptr, nullptr));
    ck_assert_int_eq(rows, static_cast<std::int64_t>(m.node.size()) * m.dimension);
    m.start.resize(index(rows) + 1);
    m.column.resize(index(m.entries));
    m.value.resize(m.column.size());
    b.expect(
        delam_problem_body_matrix(b.problem, label, nullptr, nullptr, m.start.data(), m.column.data(), m.value.data()));
    return m;
}

using Sum = std::map<std::pair<std::int64_t, std::int64_t>, double>;  // by DOFs of the mesh

void add(const Matrix& m, Sum& sum) {
    const auto dof = [&](std::int64_t i) { return m.node[index(i / m.dimension)] * m.dimension + i % m.dimension; };
    for (std::size_t r = 0; r + 1 < m.start.size(); ++r)
        for (std::int64_t e = m.start[r]; e < m.start[r + 1]; ++e)
            sum[{dof(static_cast<std::int64_t>(r)), dof(m.column[index(e)])}] += m.value[index(e)];
}

void correct_checksum(std::vector<std::uint8_t>& bytes) {
    const std::uint64_t sum = checksum(std::span(bytes).first(bytes.size() - sizeof(sum)));
    std::memcpy(&bytes[bytes.size() - sizeof(sum)], &sum, sizeof(sum));
}

// All outputs; what is left of them must be as before after an error.
std::int32_t read(const Blocks& b, const std::vector<std::uint8_t>& bytes) {
    std::int64_t dimension = -5, nodes = -5, entries = -5;
    const std::int32_t status =
        delam_experimental_part_matrix(b.context, static_cast<std::int64_t>(bytes.size()), bytes.data(), &dimension,
                                       &nodes, &entries, nullptr, nullptr, nullptr, nullptr, nullptr);
    if (status != 0) ck_assert(dimension == -5 && nodes == -5 && entries == -5);
    return status;
}

// A short part with both bodies: its first and its last cells.
std::vector<std::int64_t> ends(const Blocks& b) {
    const std::int64_t last = b.core().cell_count() - 1;
    return {0, 1, 2, last - 1, last};
}

}  // namespace

LOOP_TEST(a_whole_body_has_the_bits_of_its_matrix, 0, shape_count) {
    const Blocks b(shapes[loop]);
    for (const std::int32_t label : {plies, core_layer}) {
        const std::vector<std::int64_t> cells = b.core().body_cells(b.core().body_of_label(label));
        const Matrix part = matrix_of(b, b.part(cells)), whole = body_matrix(b, label);
        ck_assert(part.node == whole.node && part.start == whole.start && part.column == whole.column);
        ck_assert(same_bits(part.value, whole.value));
    }
}

// Every third cell is in the same part, so that parts share nodes and each has cells of both bodies.
LOOP_TEST(parts_add_up_to_the_bodies, 0, shape_count) {
    const Blocks b(shapes[loop]);
    Sum parts, bodies;
    std::int64_t nodes = 0;
    for (std::int64_t p = 0; p < 3; ++p) {
        std::vector<std::int64_t> cells;
        for (std::int64_t c = p; c < b.core().cell_count(); c += 3) cells.push_back(c);
        const Matrix m = matrix_of(b, b.part(cells));
        nodes += m.nodes;
        add(m, parts);
    }
    double largest = 0.0;
    for (const std::int32_t label : {plies, core_layer}) {
        const Matrix m = body_matrix(b, label);
        nodes -= static_cast<std::int64_t>(m.node.size());
        largest = std::max(largest, max_abs(m.value));
        add(m, bodies);
    }
    ck_assert_int_gt(nodes, 0);
    ck_assert_uint_eq(parts.size(), bodies.size());
    for (const auto& [place, value] : bodies) {
        ck_assert_uint_eq(parts.count(place), 1);
        ck_assert_msg(std::abs(parts[place] - value) <= 1e-14 * largest, "(%ld, %ld): %.17g, not %.17g",
                      static_cast<long>(place.first), static_cast<long>(place.second), parts[place], value);
    }
}

// Bytes do not depend on what else the problem holds, and survive reading and writing.
LOOP_TEST(bytes_are_what_they_say, 0, shape_count) {
    const Blocks b(shapes[loop]);
    const std::vector<std::uint8_t> bytes = b.part(ends(b));
    const Part part = load_part(bytes);
    ck_assert(save(part) == bytes);
    ck_assert((part.labels == std::vector<std::int32_t>{core_layer, plies}));
    ck_assert((part.orthotropic == std::vector<std::int32_t>{0, 1}));
    ck_assert((part.body == std::vector<std::int32_t>{1, 1, 1, 0, 0}));
    std::vector<std::int32_t> axes;
    std::int32_t next = 0;
    for (const std::int64_t cell : ends(b)) axes.push_back(cell % 3 == 2 ? -1 : next++);
    ck_assert(part.axes_of_cell == axes);
    ck_assert(b.part(ends(b)) == bytes);
}

LOOP_TEST(damaged_bytes_are_refused, 0, shape_count) {
    const Blocks b(shapes[loop]);
    const std::vector<std::uint8_t> bytes = b.part(ends(b));
    b.expect(read(b, bytes));
    for (std::size_t at = 0; at < bytes.size(); at += 7) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1u << (at / 7 % 8)));
        b.refused(read(b, damaged), DELAM_ERROR_SNAPSHOT, "part");
        damaged.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
        b.refused(read(b, damaged), DELAM_ERROR_SNAPSHOT, "part");
        // A fitting checksum: what is wrong must be found in what the bytes say, and some changes are harmless.
        if (at >= sizeof(std::uint64_t)) {
            correct_checksum(damaged);
            b.refused(read(b, damaged), DELAM_ERROR_SNAPSHOT, "part");
        }
        if (at + sizeof(std::uint64_t) >= bytes.size()) continue;
        for (const int bits : {0x01, 0x40, 0x80, 0xff}) {
            damaged = bytes;
            damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ bits);
            correct_checksum(damaged);
            if (const std::int32_t status = read(b, damaged); status != 0)
                b.refused(status, DELAM_ERROR_SNAPSHOT, "part");
        }
    }
    std::vector<std::uint8_t> longer = bytes;
    longer.push_back(0);
    b.refused(read(b, longer), DELAM_ERROR_SNAPSHOT, "checksum");
    correct_checksum(longer);
    b.refused(read(b, longer), DELAM_ERROR_SNAPSHOT, "part has 1 bytes too many");
}

// Bytes with a fitting checksum that no library has written.
LOOP_TEST(parts_of_no_problem_are_refused, 0, shape_count) {
    const Blocks b(shapes[loop]);
    const Part sound = load_part(b.part(ends(b)));
    const auto nodes = static_cast<std::int32_t>(sound.nodes.size());
    const std::vector<std::pair<const char*, std::function<void(Part&)>>> changes = {
        {"dimension 4", [](Part& p) { p.dimension = 4; }},
        {"plane assumption 2", [](Part& p) { p.plane = 2; }},
        {"no cells", [](Part& p) { p.types.clear(); }},
        {"nodes[1] = ", [](Part& p) { std::swap(p.nodes[0], p.nodes[1]); }},
        {"nodes[0] = -1", [](Part& p) { p.nodes[0] = -1; }},
        {"coordinates, expected ", [](Part& p) { p.coordinates.pop_back(); }},
        {"coordinates[3] = nan", [](Part& p) { p.coordinates[3] = nan_number; }},
        {"coordinates[0] = inf", [](Part& p) { p.coordinates[0] = infinite; }},
        {"cell type 0", [](Part& p) { p.types[1] = 0; }},
        {"cell type 77", [](Part& p) { p.types[1] = 77; }},
        {"cell type ", [](Part& p) { p.types[0] = p.dimension == 2 ? DELAM_TET4 : DELAM_TRI3; }},
        {"nodes of cells, expected ", [](Part& p) { p.connectivity.push_back(0); }},
        {"connectivity[2] = ", [=](Part& p) { p.connectivity[2] = nodes; }},
        {"connectivity[2] = -1", [](Part& p) { p.connectivity[2] = -1; }},
        {"bodies of cells, expected 5", [](Part& p) { p.body.pop_back(); }},
        {"body[4] = 2, allowed: 0 .. 1", [](Part& p) { p.body[4] = 2; }},
        {"labels[1] = ", [](Part& p) { p.labels[1] = p.labels[0]; }},
        {"labels[0] = -3", [](Part& p) { p.labels[0] = -3; }},
        {"formulation[0] = 3", [](Part& p) { p.formulation[0] = 3; }},
        {"orthotropic[0] = 2", [](Part& p) { p.orthotropic[0] = 2; }},
        {"constants, expected 18", [](Part& p) { p.constants.resize(17); }},
        {"constants[12] = nan", [](Part& p) { p.constants[12] = nan_number; }},
        {"E = 0 of body 3", [](Part& p) { p.constants[0] = 0.0; }},
        {"nu = 0.5 of body 3", [](Part& p) { p.constants[1] = 0.5; }},
        {"constants of body 7: nu12", [](Part& p) { p.constants[12] = 99.0; }},
        {"numbers of axes, expected ", [](Part& p) { p.axes.pop_back(); }},
        {"axes[4] = nan", [](Part& p) { p.axes[4] = nan_number; }},
        {"axes 1, which are not orthonormal", [](Part& p) { p.axes[9] *= 2.0; }},
        {"axes_of_cell[1] = 99, allowed: -1 .. ", [](Part& p) { p.axes_of_cell[1] = 99; }},
        {"axes of cells, expected 5", [](Part& p) { p.axes_of_cell.push_back(0); }},
        {"2 bodies, of which 1", [](Part& p) { p.body.assign(5, 0); }},
        {"node ",
         [](Part& p) {
             p.nodes.push_back(p.nodes.back() + 1);
             p.coordinates.resize(p.coordinates.size() + index(p.dimension));
         }},
        {"part is not sound: ", [](Part& p) { p.connectivity[1] = p.connectivity[0]; }},
        {"part is not sound: node ", [](Part& p) { p.body[0] = 0; }},
    };
    for (const auto& [words, change] : changes) {
        Part part = sound;
        change(part);
        b.refused(read(b, save(part)), DELAM_ERROR_SNAPSHOT, words);
    }
}

TEST(formulations_that_cells_do_not_have) {
    const Blocks linear(shapes[0]), stress(shapes[2]);
    const auto formulation = [](const Blocks& b, Formulation f) {
        Part part = load_part(b.part(ends(b)));
        part.formulation.assign(2, static_cast<std::int32_t>(f));
        return read(b, save(part));
    };
    linear.refused(formulation(linear, Formulation::mean_dilatation), DELAM_ERROR_SNAPSHOT, "locks as before");
    stress.refused(formulation(stress, Formulation::mean_dilatation), DELAM_ERROR_SNAPSHOT, "in plane stress");
}

TEST(bytes_of_something_else) {
    const Blocks b(shapes[0]);
    std::vector<std::uint8_t> bytes = b.part({0});
    bytes[7] ^= 3;
    b.refused(read(b, bytes), DELAM_ERROR_SNAPSHOT, "not a part of a libdelam problem");
    bytes[7] ^= 3;
    bytes[8] = 2;
    b.refused(read(b, bytes), DELAM_ERROR_SNAPSHOT, "part of version 2, this library reads 1");
    b.refused(read(b, std::vector<std::uint8_t>(1)), DELAM_ERROR_SNAPSHOT, "part ends early at byte 1");
    std::uint8_t none = 0;
    b.refused(delam_experimental_part_matrix(b.context, 0, &none, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                                             nullptr, nullptr),
              DELAM_ERROR_SNAPSHOT, "part ends early at byte 0");
}

TEST(wrong_arguments) {
    const Blocks b(shapes[1]);
    const std::int64_t last = b.core().cell_count() - 1;
    std::vector<std::uint8_t> bytes(1 << 16, 77);
    const auto part = [&](std::vector<std::int64_t> cells, std::int64_t capacity) {
        std::int64_t size = -5;
        const std::int32_t status = delam_experimental_problem_part(b.problem, static_cast<std::int64_t>(cells.size()),
                                                                    cells.data(), capacity, bytes.data(), &size);
        ck_assert((status == 0) == (size != -5));
        return status;
    };
    const std::string range = " is outside 0 .. " + std::to_string(last);
    b.refused(part({}, 1 << 16), DELAM_ERROR_ARGUMENT, "count = 0 is outside 1");
    b.refused(part({0, last + 1}, 1 << 16), DELAM_ERROR_ARGUMENT, "cells[1] = " + std::to_string(last + 1) + range);
    b.refused(part({-1}, 1 << 16), DELAM_ERROR_ARGUMENT, "cells[0] = -1" + range);
    b.refused(part({0, 4, 3}, 1 << 16), DELAM_ERROR_ARGUMENT, "cells[2] = 3 must be > cells[1] = 4");
    b.refused(part({2, 2}, 1 << 16), DELAM_ERROR_ARGUMENT, "cells[1] = 2 must be > cells[0] = 2");
    b.refused(part({0}, 10), DELAM_ERROR_ARGUMENT, "bytes: capacity 10 < ");
    ck_assert(std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 77; }));
    b.expect(part({0}, 1 << 16));
    b.refused(delam_experimental_problem_part(b.problem, 1, nullptr, 0, nullptr, nullptr), DELAM_ERROR_ARGUMENT,
              "cells is NULL");
    b.refused(delam_experimental_part_matrix(b.context, 8, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                                             nullptr, nullptr, nullptr),
              DELAM_ERROR_ARGUMENT, "bytes is NULL");
    b.refused(delam_experimental_part_matrix(b.context, -1, bytes.data(), nullptr, nullptr, nullptr, nullptr, nullptr,
                                             nullptr, nullptr, nullptr),
              DELAM_ERROR_ARGUMENT, "size = -1");
    ck_assert_int_eq(delam_experimental_problem_part(nullptr, 0, nullptr, 0, nullptr, nullptr), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_experimental_part_matrix(nullptr, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                                                    nullptr, nullptr, nullptr),
                     DELAM_ERROR_HANDLE);
}

TEST(bodies_without_a_stiffness_of_their_own) {
    const Blocks b(shapes[1]);
    const auto part = [&](std::int32_t label) {
        const std::vector<std::int64_t> cells = b.core().body_cells(b.core().body_of_label(label));
        return delam_experimental_problem_part(b.problem, 2, cells.data(), 0, nullptr, nullptr);
    };
    const Matrix own = body_matrix(b, plies);
    b.expect(delam_problem_set_stiffness(b.problem, static_cast<std::int64_t>(own.node.size()), own.node.data(),
                                         nullptr, own.start.data(), own.column.data(), own.value.data(), -1, nullptr,
                                         0));
    b.refused(part(plies), DELAM_ERROR_PROBLEM, "body 7 has the host's stiffness");
    b.expect(part(core_layer));
    delam_problem* bare = nullptr;
    b.expect(delam_problem_create(b.context, b.mesh, &bare));
    const std::int64_t cell = 0;
    b.refused(delam_experimental_problem_part(bare, 1, &cell, 0, nullptr, nullptr), DELAM_ERROR_PROBLEM,
              "body 7: no material");
    b.expect(delam_problem_set_elastic(bare, plies, 1e9, 0.3));
    b.expect(delam_experimental_problem_part(bare, 1, &cell, 0, nullptr, nullptr));
    delam_problem_destroy(&bare);
    b.expect(delam_problem_set_plane(b.problem, "plane-stress"));
    b.expect(part(core_layer));
}
