// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/node_images.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

constexpr Point oblique{0.6133, 0.5411, 0.5753};  // of unit length, to four digits
constexpr double same_direction = 1.0 - 1e-9;     // of the cosine

Point centroid(const Mesh& mesh, std::int64_t cell) {
    Point sum{};
    for (const std::int64_t node : mesh.cell(cell))
        for (std::size_t k = 0; k < 3; ++k)
            sum[k] += position(mesh, node)[k] / static_cast<double>(mesh.cell(cell).size());
    return sum;
}

}  // namespace

Involution::Involution(const Point& centre, const Point& axis, bool turn)
    : centre_(centre), axis_(axis), turn_(turn), matrix_{} {
    const double sign = turn ? -1.0 : 1.0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            matrix_[3 * i + j] = sign * ((i == j ? 1.0 : 0.0) - 2.0 * axis[i] * axis[j]);
}

Point Involution::turned(const Point& direction) const {
    Point out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out[i] += matrix_[3 * i + j] * direction[j];
    return out;
}

Point Involution::moved(const Point& at) const {
    Point out = turned(at - centre_);
    for (std::size_t k = 0; k < 3; ++k) out[k] += centre_[k];
    return out;
}

std::string Involution::name(int dimension) const {
    const std::string through = " through " + place(dimension, centre_);
    if (turn_ && dimension == 2) return "the half-turn about " + place(dimension, centre_);
    if (turn_) return "the half-turn about the axis" + through + " along " + place(dimension, axis_);
    return std::string("the reflection in the ") + (dimension == 2 ? "line" : "plane") + through + " normal to " +
           place(dimension, axis_);
}

std::vector<Involution> candidates(const Mesh& mesh) {
    const int dimension = mesh.dimension();
    Point centre{};
    double count = 0.0;
    std::vector<std::uint8_t> used(index(mesh.node_count()), 0);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (const std::int64_t node : mesh.cell(c)) used[index(node)] = 1;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        if (used[index(n)] == 0) continue;
        count += 1.0;
        for (std::size_t k = 0; k < 3; ++k) centre[k] += position(mesh, n)[k];
    }
    if (!(count > 0.0)) return {};
    for (double& x : centre) x /= count;
    DenseMatrix spread(dimension, dimension);
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        if (used[index(n)] == 0) continue;
        const Point from = position(mesh, n) - centre;
        for (std::int64_t i = 0; i < dimension; ++i)
            for (std::int64_t j = 0; j < dimension; ++j) spread(i, j) += from[index(i)] * from[index(j)];
    }
    std::vector<Point> axes;
    const auto add = [&](const Point& axis) {
        if (std::none_of(axes.begin(), axes.end(),
                         [&](const Point& known) { return std::abs(dot(known, axis)) > same_direction; }))
            axes.push_back(axis);
    };
    for (std::size_t i = 0; i < index(dimension); ++i) {
        Point axis{};
        axis[i] = 1.0;
        add(axis);
    }
    const double half = std::sqrt(0.5);
    for (std::size_t i = 0; i < index(dimension); ++i)
        for (std::size_t j = i + 1; j < index(dimension); ++j)
            for (const double sign : {half, -half}) {
                Point axis{};
                axis[i] = half, axis[j] = sign;
                add(axis);
            }
    const Eigen principal = eigen_symmetric(spread);
    for (std::int64_t e = 0; e < dimension; ++e) {
        Point axis{};
        for (std::int64_t i = 0; i < dimension; ++i) axis[index(i)] = principal.vector(i, e);
        add(axis);
    }
    std::vector<Involution> found;
    for (const Point& axis : axes) {
        found.emplace_back(centre, axis, false);
        if (dimension == 3) found.emplace_back(centre, axis, true);
    }
    if (dimension == 2) found.emplace_back(centre, Point{0.0, 0.0, 1.0}, true);
    return found;
}

std::optional<NodeImages> images(const Mesh& mesh, const Involution& involution, double tolerance) {
    std::vector<Point> centroids;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) centroids.push_back(centroid(mesh, c));
    const PlaceIndex cells(centroids);
    NodeImages found{std::vector<std::int64_t>(index(mesh.node_count()), -1), {}};
    std::vector<std::int32_t> body(index(mesh.body_count()), -1);
    std::vector<std::int64_t> matched;
    const auto becomes = [&](std::int64_t cell, std::int64_t other) {
        std::int32_t& goal = body[index(mesh.cell_body(cell))];
        if (mesh.cell_type(other) != mesh.cell_type(cell) || (goal >= 0 && goal != mesh.cell_body(other))) return false;
        matched.clear();
        for (const std::int64_t node : mesh.cell(cell)) {
            const Point goes = involution.moved(position(mesh, node));
            const auto to = std::find_if(mesh.cell(other).begin(), mesh.cell(other).end(),
                                         [&](std::int64_t n) { return length(position(mesh, n) - goes) <= tolerance; });
            const std::int64_t known = found.node[index(node)];
            if (to == mesh.cell(other).end() || (known >= 0 && known != *to)) return false;
            matched.push_back(*to);
        }
        goal = mesh.cell_body(other);
        for (std::size_t k = 0; k < matched.size(); ++k) found.node[index(mesh.cell(cell)[k])] = matched[k];
        return true;
    };
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const std::vector<std::int64_t> there = cells.at(involution.moved(centroids[index(c)]), tolerance);
        const auto other =
            std::find_if(there.begin(), there.end(), [&](std::int64_t candidate) { return becomes(c, candidate); });
        if (other == there.end()) return std::nullopt;
        found.cell.push_back(*other);
    }
    return found;
}

PlaceIndex::PlaceIndex(std::vector<Point> places) : places_(std::move(places)) {
    for (std::size_t i = 0; i < places_.size(); ++i)
        along_.emplace_back(dot(oblique, places_[i]), static_cast<std::int64_t>(i));
    std::sort(along_.begin(), along_.end());
}

std::vector<std::int64_t> PlaceIndex::at(const Point& place, double tolerance) const {
    const double along = dot(oblique, place), reach = 1.01 * tolerance;
    std::vector<std::int64_t> found;
    for (auto i = std::lower_bound(along_.begin(), along_.end(), std::pair<double, std::int64_t>(along - reach, -1));
         i != along_.end() && i->first <= along + reach; ++i)
        if (length(places_[index(i->second)] - place) <= tolerance) found.push_back(i->second);
    return found;
}

}  // namespace delam
