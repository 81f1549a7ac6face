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
#include "mesh/rule/pair_links.hpp"
#include "scene/advice/process_zone.hpp"

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

// Points much closer to each other than pairs are (spacing) carry no information of their own and are removed, except
// the ends of a line.
void thin(Line& line, double spacing, std::span<const Crossing> crossings) {
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
    std::size_t front = 0, first = 0, second = 0;  // a segment of a front
    double share = 0.0;                            // of its second point
};

// The front, segment and share to which a point of the interface belongs.
class Nearest {
public:
    explicit Nearest(std::span<const CrackFront> fronts) : fronts_(fronts) {}
    Near operator()(const Vector3& x) const {
        Near best;
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
    // part: of the triangle that counts
    Triangle(const CrackedInterface& interface, const std::array<std::int64_t, 3>& pair, double part)
        : interface_(interface), pair_(pair) {
        std::array<Vector3, 3> x;
        for (std::size_t i = 0; i < 3; ++i) x[i] = place_of(interface, pair[i]);
        normal_ = cross(x[1] - x[0], x[2] - x[0]);
        const double area = 0.5 * norm(normal_);
        if (!(area > 0.0)) return;
        area_ = part * area;
        for (std::size_t i = 0; i < 3; ++i)
            gradient_[i] = (1.0 / (4.0 * area * area)) * cross(normal_, x[(i + 2) % 3] - x[(i + 1) % 3]);
        centre_ = (1.0 / 3.0) * (x[0] + x[1] + x[2]);
    }
    const Vector3& centre() const { return centre_; }
    const std::array<std::int64_t, 3>& pairs() const { return pair_; }
    bool works() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (works(i)) return true;
        return false;
    }
    // - int grad s dA of a field of the pairs.
    Vector3 fall(std::span<const double> s) const {
        Vector3 sum{};
        for (std::size_t i = 0; i < 3; ++i) sum = sum + (-area_ * s[index(pair_[i])]) * gradient_[i];
        return sum;
    }
    // A direction without its component along the normal, as a unit vector.
    Vector3 along(const Vector3& direction) const {
        const Vector3 normal = unit(normal_);
        return unit(direction - dot(direction, normal) * normal);
    }
    // int Y grad zeta . n dA, in modes.
    Vector3 work(const Vector3& n) const {
        Vector3 rate{};
        for (std::size_t i = 0; i < 3; ++i)
            if (works(i))
                add_closure(interface_, pair_[i], pair_[(i + 1) % 3],
                            area_ / 6.0 * dot(gradient_[(i + 1) % 3] - gradient_[i], n), n, rate);
        return rate;
    }

private:
    bool works(std::size_t side) const { return parted(interface_, pair_[side], pair_[(side + 1) % 3]); }

    const CrackedInterface& interface_;
    std::array<std::int64_t, 3> pair_;
    Vector3 normal_{};
    double area_ = 0.0;
    std::array<Vector3, 3> gradient_{};
    Vector3 centre_{};
};

// Half of the width of the band of a point, in sides of faces. Measured on circular fronts that grow, with 5 pairs in
// the zone: rates of single points within 5 % of the toughness (hex8, hex20, tet10). With 1 they fall to a quarter of
// it. 3 and 4 give the same as 2, but smear the edge of a wide beam more, where the rate falls within few cells.
constexpr double half_band = 2.0;

// Each point of a front has a band. Whatever lies within half_band along the front counts with a weight that falls
// linearly from 1 at the point to 0. The band is mirrored at an end, and goes round in a loop. Everything thus counts
// as much in the mean along the front.
class Bands {
public:
    // spacing: between pairs
    Bands(const CrackFront& front, double spacing, bool quadratic) : closed_(front.closed) {
        const auto& points = front.points;
        for (std::size_t k = 0; k < points.size(); ++k) {
            arc_.push_back(whole_);
            const bool last = k + 1 == points.size();
            if (!last || closed_) whole_ += norm(points[last ? 0 : k + 1].place - points[k].place);
        }
        const double apart = whole_ / static_cast<double>(std::max<std::size_t>(points.size() - (closed_ ? 0 : 1), 1));
        half_ = half_band * (quadratic ? 2.0 : 1.0) * std::max(spacing, apart);
        // A band in a small loop ends an eighth of it away, where the direction has turned by 45 degrees; it reaches
        // to the next point, so that what lies between two points counts.
        if (closed_) half_ = std::max(std::min(half_, whole_ / 8.0), apart);
    }
    // Calls to(point, weight).
    template <class To>
    void give(const Near& near, To&& to) const {
        const double next = near.second > near.first ? arc_[near.second] : whole_;
        const double at = arc_[near.first] + near.share * (next - arc_[near.first]);
        for (std::size_t k = 0; k < arc_.size(); ++k) {
            double share = hat(at - arc_[k]);
            share += closed_ ? hat(at - arc_[k] - whole_) + hat(at - arc_[k] + whole_)
                             : hat(at + arc_[k]) + hat(2.0 * whole_ - at - arc_[k]);
            if (share > 0.0) to(k, share);
        }
    }

private:
    double hat(double away) const { return std::max(1.0 - std::abs(away) / half_, 0.0); }

    bool closed_;
    std::vector<double> arc_;  // of each point
    double whole_ = 0.0, half_ = 0.0;
};

// Holds what the bands of the points of one front collect, each [points].
struct Collected {
    std::vector<Vector3> ahead;  // - int grad s dA, s the spent share
    std::vector<double> front;   // its component along the directions: length of front times the spent share behind
    std::vector<double> behind;  // largest spent share
    std::vector<Vector3> work;   // int Y grad zeta . n dA
    // The same two over links of pairs of one kind.
    std::vector<double> front_of_links;
    std::vector<Vector3> work_of_links;
    std::vector<double> zone;     // weight of the process zone
    std::vector<double> crossed;  // sum of the weights of the crossings
    std::vector<double> spacing;  // between pairs along the directions, times these weights
};

// Rates and process zones of all fronts of an interface.
class Rates {
public:
    Rates(const CrackedInterface& interface, std::vector<CrackFront>& fronts, std::vector<Bands> bands)
        : interface_(interface),
          fronts_(fronts),
          bands_(std::move(bands)),
          nearest_(fronts),
          spent_(spent(interface)),
          links_(pair_links(interface.mesh, interface.geometry)) {
        for (const CrackFront& front : fronts) {
            const std::size_t n = front.points.size();
            const std::vector<double> none(n, 0.0);
            const std::vector<Vector3> nowhere(n, Vector3{});
            collected_.push_back({nowhere, none, none, nowhere, none, nowhere, none, none, none});
        }
    }

    void collect(std::span<const PairPiece> pieces, std::span<const Crossing> crossings) {
        for (const PairPiece& piece : pieces)
            for (std::size_t s = 0; s < (piece.pairs == 3 ? 1U : 4U); ++s) {
                const auto pair = [&](std::size_t corner) { return piece.pair[index(quad_halves[s][corner])]; };
                const Triangle triangle(interface_, {pair(0), pair(1), pair(2)}, piece.pairs == 3 ? 1.0 : 0.5);
                if (triangle.works()) working_.push_back({triangle, nearest_(triangle.centre())});
            }
        turn();
        for (const auto& [triangle, near] : working_) {
            const auto pairs = triangle.pairs();
            const Vector3 n = triangle.along(direction(near));
            const double front = dot(triangle.fall(spent_), n);
            const Vector3 work = triangle.work(n);
            give(near, [&](Collected& to, std::size_t k, double share) {
                to.front[k] += share * front;
                to.work[k] = to.work[k] + share * work;
                for (const std::int64_t p : pairs) to.behind[k] = std::max(to.behind[k], spent_[index(p)]);
            });
        }
        for (const PairLink& link : links_) {
            const double fall = spent_[index(link.from)] - spent_[index(link.to)];
            const bool working = parted(interface_, link.from, link.to);
            if (!working && fall == 0.0) continue;
            const Near near = nearest_(0.5 * (place_of(interface_, link.from) + place_of(interface_, link.to)));
            const Vector3 n = unit(direction(near));
            const double area = dot(link.area, n);
            Vector3 work{};
            if (working) add_closure(interface_, link.from, link.to, 0.5 * area, n, work);
            give(near, [&](Collected& to, std::size_t k, double share) {
                to.front_of_links[k] += share * area * fall;
                to.work_of_links[k] = to.work_of_links[k] + share * work;
            });
        }
        for (std::size_t p = 0; p < interface_.adhesion.size(); ++p)
            if (const auto pair = static_cast<std::int64_t>(p); in_process_zone(interface_, pair))
                give(nearest_(place_of(interface_, pair)), [&](Collected& to, std::size_t k, double share) {
                    to.zone[k] += share * interface_.geometry.weight[p];
                });
        for (const Crossing& crossing : crossings) {
            const Near near = nearest_(crossing.place);
            const double spacing = std::abs(dot(crossing.between, direction(near)));
            give(near, [&](Collected& to, std::size_t k, double share) {
                to.crossed[k] += share;
                to.spacing[k] += share * spacing;
            });
        }
        for (std::size_t f = 0; f < fronts_.size(); ++f)
            for (std::size_t k = 0; k < fronts_[f].points.size(); ++k) set(collected_[f], k, fronts_[f].points[k]);
    }

private:
    struct Working {
        Triangle triangle;
        Near near;
    };
    template <class To>
    void give(const Near& near, To&& to) {
        bands_[near.front].give(near, [&](std::size_t k, double share) { to(collected_[near.front], k, share); });
    }
    Vector3 direction(const Near& near) const {
        const auto& points = fronts_[near.front].points;
        return (1.0 - near.share) * points[near.first].direction + near.share * points[near.second].direction;
    }
    // Turns the directions to the mean of - grad s over the bands: those of the contour alone follow its corners.
    void turn() {
        for (const auto& [triangle, near] : working_) {
            const Vector3 ahead = triangle.fall(spent_);
            give(near, [&](Collected& to, std::size_t k, double share) { to.ahead[k] = to.ahead[k] + share * ahead; });
        }
        for (std::size_t f = 0; f < fronts_.size(); ++f)
            for (std::size_t k = 0; k < fronts_[f].points.size(); ++k) {
                FrontPoint& point = fronts_[f].points[k];
                const Vector3& ahead = collected_[f].ahead[k];
                if (dot(ahead, point.direction) > 0.0) point.direction = unit(ahead);
            }
    }
    // A zone has as much length of front as its spent share falls across it; where the front is curved this is the
    // length in the middle of the zone. A crack that is not open yet has not spent all behind its front.
    static void set(const Collected& from, std::size_t k, FrontPoint& point) {
        const double length = from.behind[k] > 0.0 ? from.front[k] / from.behind[k] : 0.0;
        if (!(length > 0.0)) return;
        point.rate = (1.0 / length) * from.work[k];
        point.zone = from.zone[k] / length;
        if (from.spacing[k] > 0.0) point.zone_pairs = point.zone * from.crossed[k] / from.spacing[k];
        const double length_of_links = from.front_of_links[k] / from.behind[k];
        if (!(length_of_links > 0.0)) return;
        // In a zone that is resolved, the error of the path integral falls with the square of the distance of
        // neighbours; closure over whole cells, twice as far, is right at sharp fronts. In between both have shares.
        // (case/test_front_space, single points of a circular front of 13 tet10 cells, 5.3 pairs: off by 0.021, with
        // half of the pairs 0.021, with twice 0.022.)
        const double smooth = std::min(point.zone_pairs / resolving_pairs, 1.0);
        point.rate = smooth * point.rate + ((1.0 - smooth) / length_of_links) * from.work_of_links[k];
    }

    const CrackedInterface& interface_;
    std::vector<CrackFront>& fronts_;
    std::vector<Bands> bands_;
    Nearest nearest_;
    std::vector<double> spent_;
    std::vector<PairLink> links_;       // of quadratic faces
    std::vector<Collected> collected_;  // of each front
    std::vector<Working> working_;
};

}  // namespace

std::vector<CrackFront> crack_fronts_on_faces(const CrackedInterface& interface) {
    const std::vector<PairPiece> pieces = pair_pieces(interface.geometry, 3);
    const Contour contour(interface, pieces);
    std::vector<Line> found = lines(contour.crossings);
    std::vector<CrackFront> fronts(found.size());
    std::vector<Bands> bands;
    const bool quadratic = interface.geometry.nodes_per_face > 4;
    for (std::size_t f = 0; f < found.size(); ++f) {
        double spacing = 0.0;
        for (const std::size_t c : found[f].crossing)
            spacing += norm(contour.crossings[c].between) / static_cast<double>(found[f].crossing.size());
        thin(found[f], spacing, contour.crossings);
        lay_out(fronts[f], found[f], contour.crossings);
        bands.emplace_back(fronts[f], spacing, quadratic);
    }
    if (fronts.empty()) return fronts;
    Rates(interface, fronts, std::move(bands)).collect(pieces, contour.crossings);
    return fronts;
}

}  // namespace delam
