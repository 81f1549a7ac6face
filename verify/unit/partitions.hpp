// SPDX-License-Identifier: BSD-3-Clause
// Partitions of a mesh of every cell type into up to 64 parts, and what every partition must fulfil.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "all_types.hpp"
#include "base/numbers.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/partition.hpp"

namespace unit {

using delam::Mesh;
using delam::Partition;

using Faces = std::vector<std::size_t>;  // of a cell, by numbers that cells share

inline std::vector<Faces> cell_faces(const Mesh& mesh) {
    std::map<std::set<std::int64_t>, std::size_t> number;  // of a face, by its nodes
    std::vector<Faces> list;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const delam::CellTopology& shape = delam::topology(mesh.cell_type(c));
        Faces faces;
        for (std::size_t f = 0; f < delam::index(shape.faces); ++f) {
            std::set<std::int64_t> nodes;
            for (const int k : shape.face[f].all()) nodes.insert(mesh.cell(c)[delam::index(k)]);
            faces.push_back(number.emplace(nodes, number.size()).first->second);
        }
        list.push_back(std::move(faces));
    }
    return list;
}

// Non-empty, of one body each, connected through whole faces (by flooding over them).
inline void check_partition(const Mesh& mesh, const std::vector<Faces>& faces, const Partition& parts) {
    const std::size_t count = parts.subdomain_body.size();
    ck_assert(std::is_sorted(parts.subdomain_body.begin(), parts.subdomain_body.end()));
    ck_assert_uint_eq(parts.cell_subdomain.size(), delam::index(mesh.cell_count()));
    std::vector<std::vector<std::int64_t>> cells(count);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const std::int32_t s = parts.cell_subdomain[delam::index(c)];
        ck_assert(s >= 0 && delam::index(s) < count);
        ck_assert_int_eq(parts.subdomain_body[delam::index(s)], mesh.cell_body(c));
        cells[delam::index(s)].push_back(c);
    }
    for (const std::vector<std::int64_t>& members : cells) {
        ck_assert(!members.empty());
        std::set<std::size_t> reached;
        reached.insert(faces[delam::index(members[0])].begin(), faces[delam::index(members[0])].end());
        std::set<std::int64_t> left(members.begin() + 1, members.end());
        for (bool moved = true; moved;) {
            moved = false;
            for (auto c = left.begin(); c != left.end();) {
                const Faces& own = faces[delam::index(*c)];
                if (std::any_of(own.begin(), own.end(), [&](std::size_t f) { return reached.contains(f); })) {
                    reached.insert(own.begin(), own.end());
                    c = left.erase(c);
                    moved = true;
                } else {
                    ++c;
                }
            }
        }
        ck_assert(left.empty());
    }
}

// Two layers of one cell type, in up to 64 parts: in as many as `wanted` says, twice where `repeated` says so.
template <class Wanted, class Repeated>
void check_partitions(delam::CellType type, Wanted&& wanted, Repeated&& repeated) {
    const bool plane = delam::topology(type).dimension == 2;
    const std::vector<double> lengths = plane ? std::vector{4.0} : std::vector{4.0, 2.0}, thickness{1, 0.5};
    const std::vector<std::int64_t> through{6, 3},
        along = plane ? std::vector<std::int64_t>{40} : std::vector<std::int64_t>{10, 5};
    const Mesh mesh = delam::make_layers(delam::topology(type).dimension, lengths, along, thickness, through, type);
    const std::vector<Faces> faces = cell_faces(mesh);
    for (std::int64_t n = 0; n <= 64; ++n) {
        if (!wanted(n)) continue;
        const Partition parts = partition(mesh, n);
        ck_assert_uint_eq(parts.subdomain_body.size(), delam::index(std::max<std::int64_t>(n, 2)));
        check_partition(mesh, faces, parts);
        if (repeated(n)) ck_assert(parts.cell_subdomain == partition(mesh, n).cell_subdomain);
        if (n != 16) continue;
        std::vector<std::int64_t> size(16, 0);
        for (const std::int32_t s : parts.cell_subdomain) ++size[delam::index(s)];
        const auto [smallest, largest] = std::minmax_element(size.begin(), size.end());
        ck_assert_msg(*largest <= 2 * *smallest, "%lld .. %lld cells", static_cast<long long>(*smallest),
                      static_cast<long long>(*largest));
    }
}

}  // namespace unit
