// SPDX-License-Identifier: BSD-3-Clause
#include "scene/periodic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/dense/dense.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

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
        for (std::size_t d = 0; d < index(dimension_); ++d) {
            const double cells = std::floor(x[d] / width_);
            key[d] = cells >= 0x1p62 ? most : cells > -0x1p62 ? static_cast<std::int64_t>(cells) : -most;
        }
        return key;
    }
    double width_;
    int dimension_;
    std::map<Key, std::vector<std::pair<std::int64_t, Point>>> cells_;
};

// Finds partners face by face: a node on an upper face pairs with the node one period below.
class Matching {
public:
    Matching(const Mesh& mesh, std::span<const double> given, double tolerance)
        : mesh_(mesh),
          dimension_(mesh.dimension()),
          periods_(vectors(given, dimension_)),
          dual_(dual_basis(periods_)),
          upper_(index(mesh.node_count()), 0),
          met_(index(mesh.node_count()), 0) {
        for (std::int64_t n = 0; n < mesh.node_count(); ++n)
            if (mesh.node_body(n) >= 0) nodes_.push_back(n);
        distance_ = tolerance * extent();
        mark_upper();
    }

    std::vector<PeriodicPair> run() {
        for (const auto& [faces, group] : gather()) match(faces.first, faces.second, group);
        check_lower();
        if (missing_count_ > 0)
            fail(DELAM_ERROR_MESH, "periods: no partner for ", missing_,
                 missing_count_ > 8 ? text("; and ", missing_count_ - 8, " more") : "");
        std::sort(pairs_.begin(), pairs_.end(),
                  [](const PeriodicPair& a, const PeriodicPair& b) { return a.node < b.node; });
        return std::move(pairs_);
    }

private:
    using Nodes = std::vector<std::int64_t>;
    // Nodes by the upper faces on which they lie, as bits, and by the lower nodes at their shifted place.
    using Gathered = std::map<std::pair<unsigned, Nodes>, Nodes>;

    const Mesh& mesh_;
    int dimension_;
    std::vector<Point> periods_, dual_;
    Nodes nodes_;  // of bodies: control nodes may lie anywhere
    double distance_ = 0.0;
    std::vector<unsigned> upper_;    // upper faces on which each node lies, as bits
    std::vector<std::uint8_t> met_;  // from which faces each lower node was met, as bits
    std::vector<PeriodicPair> pairs_;
    std::string missing_;
    std::int64_t missing_count_ = 0;

    static std::vector<Point> vectors(std::span<const double> given, int dimension) {
        std::vector<Point> list(given.size() / index(dimension), Point{});
        for (std::size_t k = 0; k < list.size(); ++k)
            for (std::size_t d = 0; d < index(dimension); ++d) list[k][d] = given[k * index(dimension) + d];
        return list;
    }
    // dual . x changes by |dual| per length.
    double margin(std::size_t k) const { return 2.0 * distance_ * std::sqrt(dot(dual_[k], dual_[k])); }

    double extent() const;
    void mark_upper();
    Gathered gather();
    void match(unsigned directions, Nodes left, const Nodes& group);
    void join(std::int64_t node, std::int64_t base, unsigned directions);
    void check_lower();
    void miss(std::int64_t node, const char* why);
};

double Matching::extent() const {
    double size = 0.0;
    for (std::size_t d = 0; d < index(dimension_); ++d) {
        const auto [low, high] = std::minmax_element(nodes_.begin(), nodes_.end(), [&](std::int64_t a, std::int64_t b) {
            return mesh_.node(a)[d] < mesh_.node(b)[d];
        });
        if (!nodes_.empty()) size = std::max(size, mesh_.node(*high)[d] - mesh_.node(*low)[d]);
    }
    return size;
}

void Matching::mark_upper() {
    for (std::size_t k = 0; k < periods_.size(); ++k) {
        double low = INFINITY, high = -INFINITY;
        for (const std::int64_t n : nodes_) {
            poll_cancel("loads");
            low = std::min(low, dot(dual_[k], position(mesh_, n)));
            high = std::max(high, dot(dual_[k], position(mesh_, n)));
        }
        if (std::abs(high - low - 1.0) > margin(k))
            fail(DELAM_ERROR_MESH, "periods: the mesh is ", high - low, " periods long in direction ", k, ", not 1");
        for (const std::int64_t n : nodes_)
            if (dot(dual_[k], position(mesh_, n)) >= high - margin(k)) upper_[index(n)] |= 1u << k;
    }
}

// Nodes at one position on one face find their partners together.
Matching::Gathered Matching::gather() {
    Places lower(4.0 * std::max(distance_, 1e-300), dimension_);
    for (const std::int64_t n : nodes_) {
        poll_cancel("loads");
        if (upper_[index(n)] == 0) lower.add(n, position(mesh_, n));
    }
    Gathered gathered;
    for (const std::int64_t n : nodes_) {
        const unsigned faces = upper_[index(n)];
        if (faces == 0) continue;
        poll_cancel("loads", 4);
        Point shifted = position(mesh_, n);
        for (std::size_t k = 0; k < periods_.size(); ++k)
            if ((faces >> k & 1u) != 0)
                for (std::size_t d = 0; d < 3; ++d) shifted[d] -= periods_[k][d];
        Nodes candidates = lower.near(shifted, distance_);
        if (candidates.empty())
            miss(n, "");
        else
            gathered[{faces, std::move(candidates)}].push_back(n);
    }
    return gathered;
}

// left: the lower nodes at the place of the group. Partners belong to one body, unless one node is left on each side.
void Matching::match(unsigned directions, Nodes left, const Nodes& group) {
    poll_cancel("loads");
    Nodes rest;
    for (const std::int64_t node : group) {
        const auto same_body = [&](std::int64_t n) { return mesh_.node_body(n) == mesh_.node_body(node); };
        Nodes own;
        std::copy_if(left.begin(), left.end(), std::back_inserter(own), same_body);
        if (own.size() > 1 || std::count_if(group.begin(), group.end(), same_body) > 1) {
            miss(node, " (several nodes of this body at one place)");
        } else if (own.empty()) {
            rest.push_back(node);
        } else {
            join(node, own.front(), directions);
            std::erase(left, own.front());
        }
    }
    if (rest.size() == 1 && left.size() == 1)
        join(rest.front(), left.front(), directions);
    else
        for (const std::int64_t node : rest) miss(node, " (only other bodies)");
}

void Matching::join(std::int64_t node, std::int64_t base, unsigned directions) {
    PeriodicPair pair{node, base, {}};
    for (std::size_t k = 0; k < periods_.size(); ++k)
        if ((directions >> k & 1u) != 0) pair.directions.push_back(k);
    pairs_.push_back(std::move(pair));
    met_[index(base)] |= static_cast<std::uint8_t>(1u << directions);
}

// Every node of a lower face must have been reached from each upper face opposite to it.
void Matching::check_lower() {
    for (std::size_t k = 0; k < periods_.size(); ++k) {
        double low = INFINITY;
        for (const std::int64_t n : nodes_) low = std::min(low, dot(dual_[k], position(mesh_, n)));
        for (const std::int64_t n : nodes_)
            if (upper_[index(n)] == 0 && dot(dual_[k], position(mesh_, n)) <= low + margin(k) &&
                (met_[index(n)] >> (1u << k) & 1u) == 0)
                miss(n, "");
    }
}

// The message names the first eight.
void Matching::miss(std::int64_t node, const char* why) {
    if (++missing_count_ > 8) return;
    missing_ += text(missing_count_ == 1 ? "" : "; ", "node ", node, " of body ",
                     mesh_.body_label(mesh_.node_body(node)), " at ", place(mesh_, node), why);
}

}  // namespace

std::vector<PeriodicPair> periodic_pairs(const Mesh& mesh, std::span<const double> given, double tolerance) {
    return Matching(mesh, given, tolerance).run();
}

}  // namespace delam
