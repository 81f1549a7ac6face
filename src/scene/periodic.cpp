// SPDX-License-Identifier: BSD-3-Clause
#include "scene/periodic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "linalg/dense.hpp"

namespace delam {

namespace {

using Point = std::array<double, 3>;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::string words(const Point& x, int dimension) {
    return dimension == 2 ? text("(", x[0], ", ", x[1], ")") : text("(", x[0], ", ", x[1], ", ", x[2], ")");
}

// Vectors d_k in the span of the periods with d_k . p_l = 1 for k = l, else 0.
std::vector<Point> dual_basis(const std::vector<Point>& periods) {
    const auto n = static_cast<std::int64_t>(periods.size());
    DenseMatrix gram(n, n);
    double volume = 1.0;
    for (std::size_t k = 0; k < periods.size(); ++k) {
        volume *= dot(periods[k], periods[k]);
        for (std::size_t l = 0; l < periods.size(); ++l)
            gram(static_cast<std::int64_t>(k), static_cast<std::int64_t>(l)) = dot(periods[k], periods[l]);
    }
    DenseMatrix factor = gram;
    double determinant = 1.0;
    const bool definite = factor_definite(factor);
    for (std::int64_t k = 0; k < n; ++k) determinant *= factor(k, k) * factor(k, k);
    if (!definite || !(determinant > 1e-12 * volume))
        fail(DELAM_ERROR_ARGUMENT, "periods: they are linearly dependent, or one has length 0");
    const DenseMatrix inverse = inverse_definite(std::move(gram));
    std::vector<Point> dual(periods.size(), Point{});
    for (std::size_t k = 0; k < periods.size(); ++k)
        for (std::size_t l = 0; l < periods.size(); ++l)
            for (std::size_t d = 0; d < 3; ++d)
                dual[k][d] += inverse(static_cast<std::int64_t>(k), static_cast<std::int64_t>(l)) * periods[l][d];
    return dual;
}

// Nodes by position: a grid of cells a little larger than the tolerance; a search visits all neighbouring cells.
class Places {
public:
    Places(double width, int dimension) : width_(width), dimension_(dimension) {}
    void add(std::int64_t node, const Point& x) { cells_[cell(x)].push_back({node, x}); }
    std::vector<std::int64_t> near(const Point& x, double distance) const {
        std::vector<std::int64_t> found;
        const Key centre = cell(x);
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t j = -1; j <= 1; ++j)
                for (std::int64_t k = dimension_ == 3 ? -1 : 0; k <= (dimension_ == 3 ? 1 : 0); ++k) {
                    const auto entry = cells_.find({centre[0] + i, centre[1] + j, centre[2] + k});
                    if (entry == cells_.end()) continue;
                    for (const auto& [node, y] : entry->second) {
                        const Point apart{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
                        if (dot(apart, apart) <= distance * distance) found.push_back(node);
                    }
                }
        std::sort(found.begin(), found.end());
        return found;
    }

private:
    using Key = std::array<std::int64_t, 3>;
    Key cell(const Point& x) const {
        Key key{};
        constexpr std::int64_t most = std::int64_t{1} << 62;  // far nodes of a tiny grid share its last cells
        for (std::size_t d = 0; d < at(dimension_); ++d) {
            const double cells = std::floor(x[d] / width_);
            key[d] = cells >= 0x1p62 ? most : cells > -0x1p62 ? static_cast<std::int64_t>(cells) : -most;
        }
        return key;
    }
    double width_;
    int dimension_;
    std::map<Key, std::vector<std::pair<std::int64_t, Point>>> cells_;
};

}  // namespace

std::vector<PeriodicPair> periodic_pairs(const Mesh& mesh, std::span<const double> given, double tolerance) {
    const int dim = mesh.dimension();
    std::vector<Point> periods(given.size() / at(dim), Point{});
    for (std::size_t k = 0; k < periods.size(); ++k)
        for (std::size_t d = 0; d < at(dim); ++d) periods[k][d] = given[k * at(dim) + d];
    const std::vector<Point> dual = dual_basis(periods);
    const auto place = [&](std::int64_t node) {
        Point x{};
        for (std::size_t d = 0; d < at(dim); ++d) x[d] = mesh.node(node)[d];
        return x;
    };

    // The upper faces on which each node lies, as bits.
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n)
        if (mesh.node_body(n) >= 0) nodes.push_back(n);
    double size = 0.0;  // largest extent of the cells: control nodes may lie anywhere
    for (std::size_t d = 0; d < at(dim); ++d) {
        const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end(), [&](std::int64_t a, std::int64_t b) {
            return mesh.node(a)[d] < mesh.node(b)[d];
        });
        if (!nodes.empty()) size = std::max(size, mesh.node(*high)[d] - mesh.node(*low)[d]);
    }
    const double distance = tolerance * size;
    std::vector<unsigned> upper(at(mesh.node_count()), 0);
    for (std::size_t k = 0; k < periods.size(); ++k) {
        double low = INFINITY, high = -INFINITY;
        for (const std::int64_t n : nodes) {
            poll_cancel("loads");
            low = std::min(low, dot(dual[k], place(n)));
            high = std::max(high, dot(dual[k], place(n)));
        }
        // dual . x changes by |dual| per length
        const double margin = 2.0 * distance * std::sqrt(dot(dual[k], dual[k]));
        if (std::abs(high - low - 1.0) > margin)
            fail(DELAM_ERROR_MESH, "periods: the mesh is ", high - low, " periods long in direction ", k, ", not 1");
        for (const std::int64_t n : nodes)
            if (dot(dual[k], place(n)) >= high - margin) upper[at(n)] |= 1u << k;
    }

    Places lower(4.0 * std::max(distance, 1e-300), dim);
    for (const std::int64_t n : nodes) {
        poll_cancel("loads");
        if (upper[at(n)] == 0) lower.add(n, place(n));
    }
    const auto shifted = [&](std::int64_t node) {
        Point x = place(node);
        for (std::size_t k = 0; k < periods.size(); ++k)
            if ((upper[at(node)] >> k & 1u) != 0)
                for (std::size_t d = 0; d < 3; ++d) x[d] -= periods[k][d];
        return x;
    };
    // Nodes at one position on one face find their partners together.
    std::map<std::pair<unsigned, std::vector<std::int64_t>>, std::vector<std::int64_t>> gathered;
    std::string missing;
    std::int64_t missing_count = 0;
    const auto miss = [&](std::int64_t node, const char* why) {
        if (++missing_count > 8) return;
        missing += text(missing_count == 1 ? "" : "; ", "node ", node, " of body ",
                        mesh.body_label(mesh.node_body(node)), " at ", words(place(node), dim), why);
    };
    std::vector<std::uint8_t> met(at(mesh.node_count()), 0);
    for (const std::int64_t n : nodes) {
        if (upper[at(n)] == 0) continue;
        poll_cancel("loads", 4);
        std::vector<std::int64_t> candidates = lower.near(shifted(n), distance);
        if (candidates.empty())
            miss(n, "");
        else
            gathered[{upper[at(n)], std::move(candidates)}].push_back(n);
    }
    std::vector<PeriodicPair> pairs;
    for (const auto& [key, group] : gathered) {
        poll_cancel("loads");
        const auto directions = key.first;  // lambdas of clang cannot capture parts of a structured binding
        std::vector<std::int64_t> left = key.second, rest;
        const auto join = [&](std::int64_t node, std::int64_t base) {
            PeriodicPair pair{node, base, {}};
            for (std::size_t k = 0; k < periods.size(); ++k)
                if ((directions >> k & 1u) != 0) pair.directions.push_back(k);
            pairs.push_back(std::move(pair));
            met[at(base)] |= static_cast<std::uint8_t>(1u << directions);
            std::erase(left, base);
        };
        for (const std::int64_t node : group) {
            std::vector<std::int64_t> own;
            for (const std::int64_t base : left)
                if (mesh.node_body(base) == mesh.node_body(node)) own.push_back(base);
            const auto twins = std::count_if(group.begin(), group.end(),
                                             [&](std::int64_t n) { return mesh.node_body(n) == mesh.node_body(node); });
            if (own.size() > 1 || twins > 1)
                miss(node, " (several nodes of this body at one place)");
            else if (own.empty())
                rest.push_back(node);
            else
                join(node, own.front());
        }
        if (rest.size() == 1 && left.size() == 1)
            join(rest.front(), std::int64_t{left.front()});
        else
            for (const std::int64_t node : rest) miss(node, " (only other bodies)");
    }
    // And conversely: every node of a lower face must have been reached from each upper face opposite to it.
    for (std::size_t k = 0; k < periods.size(); ++k) {
        double low = INFINITY;
        for (const std::int64_t n : nodes) low = std::min(low, dot(dual[k], place(n)));
        const double margin = 2.0 * distance * std::sqrt(dot(dual[k], dual[k]));
        for (const std::int64_t n : nodes)
            if (upper[at(n)] == 0 && dot(dual[k], place(n)) <= low + margin && (met[at(n)] >> (1u << k) & 1u) == 0)
                miss(n, "");
    }
    if (missing_count > 0)
        fail(DELAM_ERROR_MESH, "periods: no partner for ", missing,
             missing_count > 8 ? text("; and ", missing_count - 8, " more") : "");
    std::sort(pairs.begin(), pairs.end(), [](const PeriodicPair& a, const PeriodicPair& b) { return a.node < b.node; });
    return pairs;
}

}  // namespace delam
