// SPDX-License-Identifier: BSD-3-Clause
// Cuts bodies into subdomains with METIS. Every subdomain is connected through whole faces, so that its only
// stress-free motions are rigid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

struct Partition {
    std::vector<std::int32_t> cell_subdomain;  // [cells] subdomain of each cell; -1: of an omitted body
    std::vector<std::int32_t> subdomain_body;  // [subdomains] body index, ascending
};

// Returns at least one subdomain for each face-connected part of each body, or `subdomains` in total if that is more,
// distributed by the number of cells. The same input gives the same partition. A body whose cells are connected only by
// a node or an edge is cut there. left_out: [bodies] 1 for bodies that are not cut (empty: none).
Partition partition(const Mesh& mesh, std::int64_t subdomains, std::span<const std::uint8_t> left_out = {});

}  // namespace delam
