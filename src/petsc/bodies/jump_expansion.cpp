// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/jump_expansion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.hpp"

namespace delam::petsc {

namespace {

// Gauss' elimination with pivots: m and rest become 1 and m^-1 rest. At most three rows.
void eliminate(std::vector<std::vector<double>>& m, std::vector<std::map<std::int64_t, double>>& rest) {
    const std::size_t n = m.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c; r < n; ++r)
            if (std::abs(m[r][c]) > std::abs(m[best][c])) best = r;
        if (m[best][c] == 0.0) fail(DELAM_ERROR_ARGUMENT, "homes: the displacements there do not determine the jumps");
        std::swap(m[c], m[best]);
        std::swap(rest[c], rest[best]);
        const double pivot = m[c][c];
        for (double& value : m[c]) value /= pivot;
        for (auto& [home, value] : rest[c]) value /= pivot;
        for (std::size_t r = 0; r < n; ++r) {
            const double share = m[r][c];
            if (r == c || share == 0.0) continue;
            for (std::size_t k = 0; k < n; ++k) m[r][k] -= share * m[c][k];
            for (const auto& [home, value] : rest[c]) rest[r][home] -= share * value;
        }
    }
}

}  // namespace

const JumpExpansion::Row& JumpExpansion::row(std::int64_t home) {
    if (const auto found = rows_.find(home); found != rows_.end()) return found->second;
    if (scene_.place(home) < 0)
        rows_[home] = {{home, 1.0}};
    else
        expand_node(home / scene_.dimension);
    return rows_.at(home);
}

// The rows at a node: w_h = sum over its own jumps M_hk j_k + the rest, with j = M^-1 (w - rest). Jumps in the rest
// have their homes at other nodes, and no two nodes need each other.
void JumpExpansion::expand_node(std::int64_t node) {
    std::vector<std::int64_t> homes;
    for (std::int64_t dof = node * scene_.dimension; dof < (node + 1) * scene_.dimension; ++dof)
        if (const std::int64_t r = scene_.place(dof); r >= 0 && scene_.is_home[index(r)] != 0) homes.push_back(dof);
    std::vector<std::vector<double>> own(homes.size(), std::vector<double>(homes.size(), 0.0));
    std::vector<std::map<std::int64_t, double>> rest(homes.size());
    for (std::size_t i = 0; i < homes.size(); ++i) {
        rest[i][homes[i]] = 1.0;
        const std::int64_t r = scene_.place(homes[i]);
        for (std::int64_t e = scene_.start[index(r)]; e < scene_.start[index(r) + 1]; ++e) {
            const std::int64_t variable = scene_.home[index(e)];
            const double coefficient = scene_.coefficient[index(e)];
            if (const auto k = std::find(homes.begin(), homes.end(), variable); k != homes.end())
                own[i][index(k - homes.begin())] += coefficient;
            else
                for (const auto& [home, value] : row(variable)) rest[i][home] -= coefficient * value;
        }
    }
    eliminate(own, rest);
    for (std::size_t i = 0; i < homes.size(); ++i) {
        Row& row = rows_[homes[i]];
        for (const auto& [home, value] : rest[i])
            if (value != 0.0) row.emplace_back(home, value);
    }
}

}  // namespace delam::petsc
