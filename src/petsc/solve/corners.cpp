// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/corners.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/numbers.hpp"

namespace delam::petsc {

namespace {

// Finds which of the first `count` nodes the stiffness connects: returns for each the lowest node of its body.
std::vector<std::size_t> bodies_of(const LocalMatrix& stiffness, std::size_t count, std::size_t dimension) {
    std::vector<std::size_t> parent(count);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t r = 0; r < count * dimension; ++r)
        for (auto e = index(stiffness.start[r]); e < index(stiffness.start[r + 1]); ++e) {
            const std::size_t other = index(stiffness.column[e]) / dimension;
            if (other >= count || stiffness.value[e] == 0.0) continue;
            const std::size_t a = root(r / dimension), b = root(other);
            parent[std::max(a, b)] = std::min(a, b);
        }
    for (std::size_t i = 0; i < count; ++i) parent[i] = root(i);
    return parent;
}

class Points {
public:
    Points(const std::vector<double>& coordinates, std::size_t dimension) : x_(coordinates), d_(dimension) {}
    double distance(std::size_t a, std::size_t b) const { return std::sqrt(square(a, b, a, b)); }
    // Twice the area of the triangle.
    double area(std::size_t a, std::size_t b, std::size_t c) const {
        const double product = square(a, b, a, c);
        return std::sqrt(std::max(0.0, square(a, b, a, b) * square(a, c, a, c) - product * product));
    }

private:
    double square(std::size_t a, std::size_t b, std::size_t c, std::size_t e) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < d_; ++i)
            sum += (x_[b * d_ + i] - x_[a * d_ + i]) * (x_[e * d_ + i] - x_[c * d_ + i]);
        return sum;
    }
    const std::vector<double>& x_;
    std::size_t d_;
};

// Returns three of these nodes (two in the plane), in an order that all ranks agree on. The first is the farthest from
// the first of the list, the second the farthest from that. In space, the third makes the largest triangle with both.
std::vector<std::size_t> spread_out(const std::vector<std::size_t>& nodes, const Points& points,
                                    std::size_t dimension) {
    const auto most = [&](const auto& measure) {
        return *std::max_element(nodes.begin(), nodes.end(), [&](std::size_t i, std::size_t k) {
            // Measures that differ by rounding count as equal.
            return measure(i) < measure(k) * (1.0 - 1e-9);
        });
    };
    const std::size_t a = most([&](std::size_t i) { return points.distance(nodes.front(), i); });
    const std::size_t b = most([&](std::size_t i) { return points.distance(a, i); });
    if (dimension == 2) return {a, b};
    return {a, b, most([&](std::size_t i) { return points.area(a, b, i); })};
}

}  // namespace

std::vector<PetscInt> corners(const Bodies& bodies, const DisplacementSystem& system, bool has_coordinates) {
    const auto d = index(bodies.local().dimension);
    const std::size_t count = bodies.part().nodes.size();
    const std::vector<PetscInt>& number = bodies.local().number;  // the part's nodes come first here and there
    PetscInt neighbours = 0, *ranks = nullptr, *counts = nullptr, **shared = nullptr;
    check(ISLocalToGlobalMappingGetBlockInfo(system.mapping(), &neighbours, &ranks, &counts, &shared));
    std::vector<PetscInt> chosen;
    bodies.comm().together([&] {
        const std::vector<std::size_t> body = bodies_of(system.stiffness(), count, d);
        const Points points(bodies.part().coordinates, d);
        for (PetscInt k = 0; k < neighbours; ++k) {
            if (ranks[k] == bodies.comm().rank()) continue;
            std::map<std::size_t, std::vector<std::size_t>> faces;  // by body
            for (PetscInt i = 0; i < counts[k]; ++i) {
                const std::size_t node = index(shared[k][i]);
                if (node < count && system.is_whole(node)) faces[body[node]].push_back(node);
            }
            for (auto& [which, nodes] : faces) {
                std::sort(nodes.begin(), nodes.end(),
                          [&](std::size_t a, std::size_t b) { return number[a * d] < number[b * d]; });
                if (!has_coordinates) nodes = {nodes.front(), nodes[nodes.size() / 2], nodes.back()};
                for (const std::size_t node : has_coordinates ? spread_out(nodes, points, d) : nodes)
                    for (std::size_t c = 0; c < d; ++c) chosen.push_back(number[node * d + c]);
            }
        }
        std::sort(chosen.begin(), chosen.end());
        chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    });
    check(ISLocalToGlobalMappingRestoreBlockInfo(system.mapping(), &neighbours, &ranks, &counts, &shared));
    return chosen;
}

}  // namespace delam::petsc
