// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

namespace cli {

namespace {

using Point = std::array<double, 2>;

// Random equal discs jam at 0.84 (O'Hern, Silbert, Liu, Nagel, Phys. Rev. E 68, 2003). With half a gap around each,
// they must stay below.
constexpr double densest = 0.82;
constexpr std::int64_t most_discs = 2000;
constexpr int attempts = 40;
constexpr int sweeps = 4000;
constexpr int drops = 2000;
// Discs are pushed this fraction beyond the required distance, so that finitely many pushes reach it.
constexpr double margin = 1e-3;

// The standard leaves the mapping to doubles in its distributions to the implementation, but not the generator itself.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0, 1)

private:
    std::mt19937_64 engine_;
};

// x in [0, period).
double wrapped(double x, double period) {
    const double inside = x - period * std::floor(x / period);
    return inside < period ? inside : 0.0;
}

// The shortest difference between periodic images.
double nearest(double difference, double period) { return difference - period * std::round(difference / period); }

// Not std::hypot, whose last bits differ between machines.
double length_of(const Point& d) { return std::sqrt(d[0] * d[0] + d[1] * d[1]); }

class Cell {
public:
    Cell(const PackingRequest& request, double width, double height)
        : size_{width, height}, distance_(2.0 + request.gap), edge_gap_(request.edge_gap) {}

    [[nodiscard]] bool apart(const Point& a, const Point& b) const {
        const Point d = between(a, b);
        return d[0] * d[0] + d[1] * d[1] >= distance_ * distance_;
    }

    // No circle comes within edge_gap of touching an edge or passing through a corner.
    [[nodiscard]] bool clear_of_edges(const Point& p) const {
        for (std::size_t axis = 0; axis < 2; ++axis)
            if (grazes(std::abs(nearest(p[axis], size_[axis])))) return false;
        return !grazes(length_of({nearest(p[0], size_[0]), nearest(p[1], size_[1])}));
    }

    [[nodiscard]] bool sound(const std::vector<Point>& centres) const {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            if (!clear_of_edges(centres[i])) return false;
            for (std::size_t j = 0; j < i; ++j)
                if (!apart(centres[i], centres[j])) return false;
        }
        return true;
    }

    [[nodiscard]] Point anywhere(Random& random) const {
        const double x = random() * size_[0];
        return {x, random() * size_[1]};
    }

    // Both discs of an overlapping pair move by half of the missing distance, along the line between them.
    void separate(Point& a, Point& b, Random& random) const {
        Point d = between(a, b);
        double length = length_of(d);
        if (length >= distance_) return;
        while (length < 1e-9) {
            d = {random() - 0.5, random() - 0.5};
            length = length_of(d);
        }
        const double push = 0.5 * (distance_ * (1.0 + margin) - length) / length;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            a[axis] = wrapped(a[axis] - push * d[axis], size_[axis]);
            b[axis] = wrapped(b[axis] + push * d[axis], size_[axis]);
        }
    }

    // A circle that grazes an edge or a corner moves straight towards or away from it, to the nearer end of the
    // forbidden range.
    void clear_edges(Point& p) const {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double d = nearest(p[axis], size_[axis]);
            if (grazes(std::abs(d)))
                p[axis] = wrapped(p[axis] + (wanted(std::abs(d)) - std::abs(d)) * (d < 0 ? -1.0 : 1.0), size_[axis]);
        }
        const Point d{nearest(p[0], size_[0]), nearest(p[1], size_[1])};
        const double length = length_of(d);
        if (grazes(length))
            for (std::size_t axis = 0; axis < 2; ++axis)
                p[axis] = wrapped(p[axis] + (wanted(length) / length - 1.0) * d[axis], size_[axis]);
    }

    void shake(Point& p, double by, Random& random) const {
        for (std::size_t axis = 0; axis < 2; ++axis) p[axis] = wrapped(p[axis] + by * (random() - 0.5), size_[axis]);
    }

private:
    [[nodiscard]] Point between(const Point& a, const Point& b) const {
        return {nearest(b[0] - a[0], size_[0]), nearest(b[1] - a[1], size_[1])};
    }
    [[nodiscard]] bool grazes(double d) const { return d > 1.0 - edge_gap_ && d < 1.0 + edge_gap_; }
    [[nodiscard]] double wanted(double d) const {
        return d < 1.0 ? 1.0 - edge_gap_ - margin : 1.0 + edge_gap_ + margin;
    }

    Point size_;
    double distance_;
    double edge_gap_;
};

std::vector<Point> drop(const Cell& cell, std::int64_t count, Random& random) {
    std::vector<Point> centres;
    for (std::int64_t i = 0; i < count; ++i) {
        Point at = cell.anywhere(random);
        for (int k = 0; k < drops; ++k) {
            const bool free =
                std::all_of(centres.begin(), centres.end(), [&](const Point& c) { return cell.apart(c, at); });
            if (free && cell.clear_of_edges(at)) break;
            at = cell.anywhere(random);
        }
        centres.push_back(at);
    }
    return centres;
}

// Gauss-Seidel iteration over the overlaps; now and then random shifts free discs locked between edges and neighbours.
bool push_apart(const Cell& cell, std::vector<Point>& centres, Random& random) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        if (cell.sound(centres)) return true;
        for (std::size_t i = 0; i < centres.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) cell.separate(centres[i], centres[j], random);
        for (Point& centre : centres) cell.clear_edges(centre);
        if (sweep % 200 == 199)
            for (Point& centre : centres) cell.shake(centre, 0.4, random);
    }
    return false;
}

void require(bool holds, const std::string& text) {
    if (!holds) throw std::domain_error(text);
}

}  // namespace

Packing pack_discs(const PackingRequest& request) {
    const auto inside = [](double x, double low, double high) { return x >= low && x <= high; };  // false for NaN
    require(request.count >= 1 && request.count <= most_discs,
            fmt::format("fibres = {}: must be in 1..{}", request.count, most_discs));
    require(inside(request.gap, 0.0, 2.0), fmt::format("gap = {} radii: must be in [0, 2]", request.gap));
    require(inside(request.edge_gap, 0.0, 0.5),
            fmt::format("edge_gap = {} radii: must be in [0, 0.5]", request.edge_gap));
    require(inside(request.aspect, 0.1, 10.0), fmt::format("aspect = {}: must be in [0.1, 10]", request.aspect));
    const double swollen = (1.0 + request.gap / 2.0) * (1.0 + request.gap / 2.0);
    require(request.fraction > 0.0 && request.fraction * swollen <= densest,
            fmt::format("fraction = {}: must be in (0, {:.4f}] with gaps of {} radii", request.fraction,
                        densest / swollen, request.gap));
    const double area = static_cast<double>(request.count) * std::numbers::pi / request.fraction;
    Packing packing{std::sqrt(area / request.aspect), std::sqrt(area * request.aspect), {}};
    const double shortest = std::min(packing.width, packing.height);
    require(shortest >= 2.0 + request.gap,
            fmt::format("fibres = {}: the cell would be {:.3f} radii across, and a fibre would meet its own image: {} "
                        "are needed; take more fibres, a smaller fraction or another aspect",
                        request.count, shortest, 2.0 + request.gap));

    const Cell cell(request, packing.width, packing.height);
    Random random(request.seed);
    for (int attempt = 0; attempt < attempts; ++attempt) {
        packing.centres = drop(cell, request.count, random);
        if (push_apart(cell, packing.centres, random)) return packing;
    }
    throw std::domain_error(
        fmt::format("fraction = {}: no arrangement of {} fibres was found with seed {}, gap {} and "
                    "edge_gap {} radii in {} attempts; take another seed, smaller gaps or a "
                    "smaller fraction",
                    request.fraction, request.count, request.seed, request.gap, request.edge_gap, attempts));
}

Packing square_packing(double fraction, double aspect) {
    require(aspect >= 0.1 && aspect <= 10.0, fmt::format("aspect = {}: must be in [0.1, 10]", aspect));
    const double limit = std::numbers::pi / 4.0 * std::min(aspect, 1.0 / aspect);
    require(fraction > 0.0 && fraction < limit,
            fmt::format("fraction = {}: must be in (0, {:.4f}) in a square arrangement", fraction, limit));
    const double area = std::numbers::pi / fraction;
    const double width = std::sqrt(area / aspect);
    const double height = std::sqrt(area * aspect);
    return {width, height, {{width / 2, height / 2}}};
}

Packing hexagonal_packing(double fraction) {
    const double limit = std::numbers::pi / (2.0 * std::numbers::sqrt3);
    require(fraction > 0.0 && fraction < limit,
            fmt::format("fraction = {}: must be in (0, {:.4f}) in a hexagonal arrangement", fraction, limit));
    const double width = std::sqrt(2.0 * std::numbers::pi / (fraction * std::numbers::sqrt3));
    const double height = std::numbers::sqrt3 * width;
    return {width, height, {{width / 2, height / 2}, {0.0, 0.0}}};
}

}  // namespace cli
