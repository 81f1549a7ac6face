// SPDX-License-Identifier: BSD-3-Clause
// Fronts of an interface that is a surface: the contour of the adhesion, and the J integral beside it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "evolution/observe/crack_front.hpp"
#include "mesh/faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

Vector3 operator+(const Vector3& p, const Vector3& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
Vector3 operator*(double s, const Vector3& p) { return {s * p[0], s * p[1], s * p[2]}; }
double norm(const Vector3& p) { return std::sqrt(dot(p, p)); }
Vector3 unit(const Vector3& p) {
    const double length = norm(p);
    return length > 0.0 ? (1.0 / length) * p : p;
}

// The point where the contour crosses the line between two neighbouring pairs, and its neighbours on the contour.
struct Crossing {
    Vector3 place{};
    Vector3 ahead{};    // sum of the directions into the adhering part
    Vector3 normal{};   // of the interface
    Vector3 between{};  // from one pair to the other
    std::vector<std::size_t> next;
};

// A polygon has an even number of crossings on its sides, and the contour connects them in pairs. Where a quadrilateral
// has four, the mean of its corners decides: the contour cuts off the corners on the other side of the mean.
class Contour {
public:
    Contour(const CrackedInterface& interface, std::span<const PairPiece> pieces) : interface_(interface) {
        for (const PairPiece& piece : pieces) add(piece);
    }
    std::vector<Crossing> crossings;

private:
    double adhesion(std::int64_t pair) const { return interface_.adhesion[index(pair)]; }
    bool below(std::int64_t pair) const { return adhesion(pair) < front_adhesion; }

    void add(const PairPiece& piece) {
        const int n = piece.pairs;
        std::vector<std::size_t> found;  // sides that are crossed, ascending
        std::vector<int> side;
        for (int k = 0; k < n; ++k)
            if (below(piece.pair[index(k)]) != below(piece.pair[index((k + 1) % n)])) {
                found.push_back(crossing(piece.pair[index(k)], piece.pair[index((k + 1) % n)]));
                side.push_back(k);
            }
        if (found.size() == 2) return join(found[0], found[1], piece);
        if (found.size() != 4) return;
        double mean = 0.0;
        for (int k = 0; k < n; ++k) mean += adhesion(piece.pair[index(k)]) / n;
        // Corner 0 lies between the sides 3 and 0, corner 1 between 0 and 1.
        const bool cut_first = below(piece.pair[0]) != (mean < front_adhesion);
        join(found[0], found[cut_first ? 3 : 1], piece);
        join(found[2], found[cut_first ? 1 : 3], piece);
    }

    std::size_t crossing(std::int64_t p, std::int64_t q) {
        const auto key = std::minmax(p, q);
        const auto [entry, inserted] = number_.try_emplace(std::pair{key.first, key.second}, crossings.size());
        if (inserted) {
            const Vector3 x = place_of(interface_, p), y = place_of(interface_, q);
            const double share = (front_adhesion - adhesion(p)) / (adhesion(q) - adhesion(p));
            Crossing made;
            made.place = x + share * (y - x);
            made.between = y - x;
            for (std::size_t i = 0; i < 3; ++i)
                made.normal[i] =
                    interface_.geometry.frame[index(p) * 9 + i] + interface_.geometry.frame[index(q) * 9 + i];
            crossings.push_back(std::move(made));
        }
        return entry->second;
    }

    // The direction ahead is that of the mean gradient of the adhesion; only its sign matters.
    void join(std::size_t a, std::size_t b, const PairPiece& piece) {
        if (crossings[a].next.size() > 1 || crossings[b].next.size() > 1) return;  // faces that do not form a surface
        crossings[a].next.push_back(b);
        crossings[b].next.push_back(a);
        const Vector3 middle = 0.5 * (crossings[a].place + crossings[b].place);
        Vector3 ahead{};
        for (int k = 0; k < piece.pairs; ++k)
            ahead = ahead +
                    (below(piece.pair[index(k)]) ? -1.0 : 1.0) * (place_of(interface_, piece.pair[index(k)]) - middle);
        crossings[a].ahead = crossings[a].ahead + ahead;
        crossings[b].ahead = crossings[b].ahead + ahead;
    }

    const CrackedInterface& interface_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> number_;
};

struct Line {
    std::vector<std::size_t> crossing;
    bool closed = false;
};

std::vector<Line> lines(std::span<const Crossing> crossings) {
    std::vector<Line> found;
    std::vector<std::uint8_t> seen(crossings.size(), 0);
    const auto walk = [&](std::size_t first) {
        Line line;
        for (std::size_t at_point = first;;) {
            seen[at_point] = 1;
            line.crossing.push_back(at_point);
            const auto& next = crossings[at_point].next;
            const auto on = std::find_if(next.begin(), next.end(), [&](std::size_t n) { return seen[n] == 0; });
            if (on == next.end()) break;
            at_point = *on;
        }
        const auto& ends = crossings[line.crossing.back()].next;
        line.closed = line.crossing.size() > 2 && std::find(ends.begin(), ends.end(), first) != ends.end();
        found.push_back(std::move(line));
    };
    for (std::size_t c = 0; c < crossings.size(); ++c)
        if (seen[c] == 0 && crossings[c].next.size() == 1) walk(c);
    for (std::size_t c = 0; c < crossings.size(); ++c)
        if (seen[c] == 0 && crossings[c].next.size() == 2) walk(c);
    return found;
}

// Points much closer to each other than pairs are carry no information of their own and are removed, except the ends of
// a line.
void thin(Line& line, std::span<const Crossing> crossings) {
    double spacing = 0.0;
    for (const std::size_t c : line.crossing)
        spacing += norm(crossings[c].between) / static_cast<double>(line.crossing.size());
    std::vector<std::size_t> kept{line.crossing.front()};
    const auto apart = [&](std::size_t a, std::size_t b) {
        return norm(crossings[a].place - crossings[b].place) > 0.5 * spacing;
    };
    for (std::size_t k = 1; k < line.crossing.size(); ++k) {
        const std::size_t c = line.crossing[k];
        const bool last = k + 1 == line.crossing.size() && !line.closed;
        if (last && kept.size() > 1 && !apart(kept.back(), c)) kept.pop_back();
        if (last || (apart(kept.back(), c) && (!line.closed || apart(kept.front(), c)))) kept.push_back(c);
    }
    if (kept.size() >= (line.closed ? 3U : 2U)) line.crossing = std::move(kept);
}

struct Near {
    std::size_t front, first, second;  // a segment of a front
    double share;                      // of its second point
};

// The front, segment and share to which a point of the interface belongs.
class Nearest {
public:
    explicit Nearest(std::span<const CrackFront> fronts) : fronts_(fronts) {}
    Near operator()(const Vector3& x) const {
        Near best{0, 0, 0, 0.0};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t f = 0; f < fronts_.size(); ++f) {
            const auto& points = fronts_[f].points;
            const std::size_t segments = points.size() - (fronts_[f].closed ? 0 : 1);
            for (std::size_t s = 0; s < segments; ++s) {
                const std::size_t e = (s + 1) % points.size();
                const Vector3 along = points[e].place - points[s].place, to = x - points[s].place;
                const double square = dot(along, along);
                const double share = square > 0.0 ? std::clamp(dot(to, along) / square, 0.0, 1.0) : 0.0;
                const Vector3 off = to - share * along;
                if (dot(off, off) < least) {
                    least = dot(off, off);
                    best = {f, s, e, share};
                }
            }
        }
        return best;
    }

private:
    std::span<const CrackFront> fronts_;
};

// Length of front that belongs to each point, and the direction ahead: along the interface, across the front.
void lay_out(CrackFront& front, const Line& line, std::span<const Crossing> crossings) {
    const std::size_t n = line.crossing.size();
    front.closed = line.closed;
    front.points.resize(n);
    for (std::size_t k = 0; k < n; ++k) front.points[k].place = crossings[line.crossing[k]].place;
    for (std::size_t k = 0; k < n; ++k) {
        FrontPoint& point = front.points[k];
        const std::size_t before = k > 0         ? k - 1
                                   : line.closed ? n - 1
                                                 : k,
                          after = k + 1 < n     ? k + 1
                                  : line.closed ? 0
                                                : k;
        point.length =
            0.5 * (norm(point.place - front.points[before].place) + norm(front.points[after].place - point.place));
        const Crossing& own = crossings[line.crossing[k]];
        const Vector3 across = unit(cross(unit(own.normal), front.points[after].place - front.points[before].place));
        point.direction = dot(across, own.ahead) < 0.0 ? -1.0 * across : across;
    }
}

// A triangle of pairs. With the gradients g_i of its shape functions, grad zeta = sum over its sides (zeta_j -
// zeta_i)(g_j - g_i)/3; each side is multiplied by the product of the jumps at its ends, as between two pairs of a
// line.
class Triangle {
public:
    Triangle(const CrackedInterface& interface, const std::array<std::int64_t, 3>& pair)
        : interface_(interface), pair_(pair) {
        std::array<Vector3, 3> x;
        for (std::size_t i = 0; i < 3; ++i) x[i] = place_of(interface, pair[i]);
        const Vector3 normal = cross(x[1] - x[0], x[2] - x[0]);
        area_ = 0.5 * norm(normal);
        if (!(area_ > 0.0)) return;
        for (std::size_t i = 0; i < 3; ++i)
            gradient_[i] = (1.0 / (4.0 * area_ * area_)) * cross(normal, x[(i + 2) % 3] - x[(i + 1) % 3]);
        centre_ = (1.0 / 3.0) * (x[0] + x[1] + x[2]);
    }
    const Vector3& centre() const { return centre_; }
    bool works() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (works(i)) return true;
        return false;
    }
    // Adds share times int Y grad zeta . n dA, in modes.
    void add_to(FrontPoint& point, double share) const {
        const Vector3& n = point.direction;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!works(i)) continue;
            const std::int64_t p = pair_[i], q = pair_[(i + 1) % 3];
            const double change = interface_.adhesion[index(q)] - interface_.adhesion[index(p)];
            const double c = share * area_ / 6.0 * change * dot(gradient_[(i + 1) % 3] - gradient_[i], n);
            const SpaceJump u = jump_of(interface_, p), v = jump_of(interface_, q);
            const double ahead = dot(u.tangential, n) * dot(v.tangential, n);
            point.rate[0] += c * interface_.law.normal_stiffness * u.normal * v.normal;
            point.rate[1] += c * interface_.law.tangential_stiffness * ahead;
            point.rate[2] += c * interface_.law.tangential_stiffness * (dot(u.tangential, v.tangential) - ahead);
        }
    }

private:
    bool works(std::size_t side) const {
        const std::size_t p = index(pair_[side]), q = index(pair_[(side + 1) % 3]);
        return interface_.adhesion[p] != interface_.adhesion[q] &&
               !(undamaged(interface_.initial[p], interface_.adhesion[p]) &&
                 undamaged(interface_.initial[q], interface_.adhesion[q]));
    }

    const CrackedInterface& interface_;
    std::array<std::int64_t, 3> pair_;
    double area_ = 0.0;
    std::array<Vector3, 3> gradient_{};
    Vector3 centre_{};
};

}  // namespace

std::vector<CrackFront> crack_fronts_on_faces(const CrackedInterface& interface) {
    const std::vector<PairPiece> pieces = pair_pieces(interface.geometry, 3);
    const Contour contour(interface, pieces);
    std::vector<Line> found = lines(contour.crossings);
    std::vector<CrackFront> fronts(found.size());
    for (std::size_t f = 0; f < found.size(); ++f) {
        thin(found[f], contour.crossings);
        lay_out(fronts[f], found[f], contour.crossings);
    }
    if (fronts.empty()) return fronts;

    const Nearest nearest(fronts);
    const auto give = [&](const Vector3& x, auto&& to) {
        const Near near = nearest(x);
        auto& points = fronts[near.front].points;
        if (near.share < 1.0) to(points[near.first], 1.0 - near.share);
        if (near.share > 0.0) to(points[near.second], near.share);
    };
    // Quadrilaterals as two triangles, in both ways.
    constexpr std::array<std::array<int, 3>, 4> split{{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
    for (const PairPiece& piece : pieces)
        for (std::size_t s = 0; s < (piece.pairs == 3 ? 1U : 4U); ++s) {
            const Triangle triangle(interface, {piece.pair[index(split[s][0])], piece.pair[index(split[s][1])],
                                                piece.pair[index(split[s][2])]});
            if (!triangle.works()) continue;
            const double part = piece.pairs == 3 ? 1.0 : 0.5;
            give(triangle.centre(), [&](FrontPoint& point, double share) { triangle.add_to(point, part * share); });
        }
    for (std::size_t p = 0; p < interface.adhesion.size(); ++p)
        if (in_process_zone(interface, static_cast<std::int64_t>(p)))
            give(place_of(interface, static_cast<std::int64_t>(p)),
                 [&](FrontPoint& point, double share) { point.zone += share * interface.geometry.weight[p]; });
    for (std::size_t f = 0; f < fronts.size(); ++f)
        for (std::size_t k = 0; k < fronts[f].points.size(); ++k) {
            FrontPoint& point = fronts[f].points[k];
            if (!(point.length > 0.0)) continue;
            for (double& rate : point.rate) rate /= point.length;
            point.zone /= point.length;
            const double spacing = std::abs(dot(contour.crossings[found[f].crossing[k]].between, point.direction));
            if (spacing > 0.0) point.zone_pairs = point.zone / spacing;
        }
    return fronts;
}

}  // namespace delam
