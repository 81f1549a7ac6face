// SPDX-License-Identifier: BSD-3-Clause
// Fronts of an interface that is a line: the pairs as chains, each traversed from the open side of a front to the
// adhering side.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numbers.hpp"
#include "evolution/observe/crack_front.hpp"
#include "mesh/faces.hpp"

namespace delam {

namespace {

// Pairs in order. In a ring the first pair is also the last one, with half of its weight in each place.
struct EdgeChain {
    std::vector<std::int64_t> pair;
    std::vector<double> arc;  // distance from the first pair
    bool ring = false;
};

double distance(const Vector3& p, const Vector3& q) { return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]); }

// The edges of a line, which are taken one by one.
class Edges {
public:
    explicit Edges(const CrackedInterface& interface) : begin_(interface.adhesion.size() + 1, 0) {
        const std::vector<PairPiece> pieces = pair_pieces(interface.geometry, 2);
        for (const PairPiece& piece : pieces)
            for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) ++begin_[index(piece.pair[end]) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        other_.resize(begin_.back());
        std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
        for (const PairPiece& piece : pieces)
            for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
                other_[at[index(piece.pair[end])]++] = piece.pair[1 - end];
    }
    std::size_t degree(std::size_t pair) const { return begin_[pair + 1] - begin_[pair]; }
    // Takes the first edge left at a pair and returns its other end; -1: none is left.
    std::int64_t take(std::int64_t pair) {
        const auto left = std::find_if(first(pair), last(pair), [](std::int64_t other) { return other != taken; });
        if (left == last(pair)) return taken;
        const std::int64_t other = *left;
        std::replace(first(pair), last(pair), other, taken);
        std::replace(first(other), last(other), pair, taken);
        return other;
    }

private:
    static constexpr std::int64_t taken = -1;
    std::vector<std::int64_t>::iterator first(std::int64_t pair) {
        return other_.begin() + static_cast<std::ptrdiff_t>(begin_[index(pair)]);
    }
    std::vector<std::int64_t>::iterator last(std::int64_t pair) { return first(pair + 1); }

    std::vector<std::size_t> begin_;   // [pairs+1]
    std::vector<std::int64_t> other_;  // ends of the edges of each pair
};

// Chains of edges, beginning at pairs that do not have two edges; the remaining edges are rings. A ring is cut where
// the adhesion is largest.
std::vector<EdgeChain> chains(const CrackedInterface& interface) {
    const auto count = static_cast<std::int64_t>(interface.adhesion.size());
    Edges edges(interface);
    std::vector<EdgeChain> found;
    const auto walk = [&](std::int64_t first) {
        std::int64_t p = edges.take(first);
        if (p < 0) return false;
        EdgeChain chain{{first}, {}, false};
        chain.pair.reserve(index(count) + 1);
        for (; p >= 0; p = edges.take(p)) {
            chain.pair.push_back(p);
            if (edges.degree(index(p)) != 2) break;
        }
        chain.ring = chain.pair.size() > 2 && chain.pair.back() == first;
        found.push_back(std::move(chain));
        return true;
    };
    for (std::int64_t p = 0; p < count; ++p)
        while (edges.degree(index(p)) != 2 && walk(p)) {
        }
    for (std::int64_t p = 0; p < count; ++p) walk(p);

    for (EdgeChain& chain : found) {
        if (chain.ring && edges.degree(index(chain.pair.front())) == 2) {
            chain.pair.pop_back();
            const auto less = [&](std::int64_t p, std::int64_t q) {
                return interface.adhesion[index(p)] < interface.adhesion[index(q)];
            };
            std::rotate(chain.pair.begin(), std::max_element(chain.pair.begin(), chain.pair.end(), less),
                        chain.pair.end());
            chain.pair.push_back(chain.pair.front());
        }
        double arc = 0.0;
        chain.arc.reserve(chain.pair.size());
        for (std::size_t k = 0; k < chain.pair.size(); ++k) {
            if (k > 0) arc += distance(place_of(interface, chain.pair[k - 1]), place_of(interface, chain.pair[k]));
            chain.arc.push_back(arc);
        }
    }
    return found;
}

// A chain with the state of its pairs, and the surroundings of each of its fronts. Positions are those in the chain.
class Walk {
public:
    // corner: of quadratic faces, [pairs]
    Walk(const CrackedInterface& interface, const EdgeChain& chain, std::span<const std::uint8_t> corner)
        : interface_(interface), chain_(chain), first_corner_(corner[index(chain.pair.front())] != 0 ? 0 : 1) {}

    struct Found {
        std::int64_t open, adhering;  // the two pairs that it separates
        std::int64_t from, to;        // pairs that belong to it, from the open side on
        double arc;                   // position of the front
    };
    std::vector<Found> fronts() const {
        std::vector<Found> found;
        for (std::int64_t k = 0; k + 1 < size(); ++k) {
            if (below(k) && !below(k + 1)) found.push_back(front(k, k + 1));
            if (!below(k) && below(k + 1)) found.push_back(front(k + 1, k));
        }
        return found;
    }

    // Arc at which the crack of this front begins: that of its other front, else the end of the chain.
    double other_end(const std::vector<Found>& all, const Found& front) const {
        const std::int64_t end = run_end(front.open, front.open - front.adhering);
        for (const Found& other : all)
            if (other.open == end && other.adhering != front.adhering) return other.arc;
        return chain_.arc[index(end)];
    }

    FrontPoint point(const Found& front) const {
        FrontPoint out;
        const auto after =
            index(std::upper_bound(chain_.arc.begin(), chain_.arc.end() - 1, front.arc) - chain_.arc.begin());
        const std::size_t k = std::max<std::size_t>(after, 1);
        const Vector3 p = place(static_cast<std::int64_t>(k) - 1), q = place(static_cast<std::int64_t>(k));
        const double share = (front.arc - chain_.arc[k - 1]) / (chain_.arc[k] - chain_.arc[k - 1]);
        const double sign = front.adhering > front.open ? 1.0 : -1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            out.place[i] = p[i] + share * (q[i] - p[i]);
            out.direction[i] = sign * (q[i] - p[i]) / distance(p, q);
        }
        const std::int64_t step = front.adhering - front.open;
        for (std::int64_t i = front.from; i != front.to; i += step) add_links(i, i + step, out);
        for (std::int64_t i = front.from;; i += step) {
            if (in_process_zone(interface_, pair(i))) {
                out.zone += weight(i);
                out.zone_pairs += 1.0;
            }
            if (i == front.to) return out;
        }
    }

private:
    std::int64_t size() const { return static_cast<std::int64_t>(chain_.pair.size()); }
    std::int64_t pair(std::int64_t i) const { return chain_.pair[index(i)]; }
    double adhesion(std::int64_t i) const { return interface_.adhesion[index(pair(i))]; }
    double initial(std::int64_t i) const { return interface_.initial[index(pair(i))]; }
    bool below(std::int64_t i) const { return adhesion(i) < front_adhesion; }
    double weight(std::int64_t i) const {
        const double whole = interface_.geometry.weight[index(pair(i))];
        return chain_.ring && (i == 0 || i == size() - 1) ? 0.5 * whole : whole;
    }
    Vector3 place(std::int64_t i) const { return place_of(interface_, pair(i)); }
    bool inside(std::int64_t i) const { return i >= 0 && i < size(); }

    // The last pair on the same side of 1/2, beginning at i.
    std::int64_t run_end(std::int64_t i, std::int64_t step) const {
        while (inside(i + step) && below(i + step) == below(i)) i += step;
        return i;
    }
    // The region of one of two fronts ends where the run from i to end has its extreme adhesion, in the middle if there
    // are several.
    std::int64_t share_of(std::int64_t i, std::int64_t end, std::int64_t step) const {
        if (!inside(end + step)) return end;
        double extreme = adhesion(i);
        std::int64_t first = i, last = i;
        for (std::int64_t j = i; j != end + step; j += step) {
            const double zeta = adhesion(j);
            if (below(i) ? zeta < extreme : zeta > extreme) first = j;
            if (below(i) ? zeta <= extreme : zeta >= extreme) {
                extreme = zeta;
                last = j;
            }
        }
        return first + (last - first) / 2;
    }

    Found front(std::int64_t open, std::int64_t adhering) const {
        const std::int64_t step = adhering - open;
        const std::int64_t open_end = run_end(open, -step);
        Found found{open, adhering, share_of(open, open_end, -step), share_of(adhering, run_end(adhering, step), step),
                    0.0};
        // Counted from the tip of the notch; otherwise from the end of the chain or the middle of a crack that began
        // inside.
        std::int64_t anchor = open;
        while (anchor != open_end && initial(anchor) > 0.0) anchor -= step;
        double opened = 0.0;
        if (!(initial(anchor) > 0.0)) {
            anchor += step;
        } else {
            anchor = found.from;
            if (inside(open_end - step)) opened = -0.5 * weight(anchor) * (1.0 - adhesion(anchor));
        }
        for (std::int64_t i = anchor;; i += step) {
            opened += weight(i) * (1.0 - adhesion(i));
            if (i == found.to) break;
        }
        found.arc = std::clamp(chain_.arc[index(anchor)] + static_cast<double>(step) * opened, 0.0, chain_.arc.back());
        return found;
    }

    // Adds the links from a pair to the next. The weights of quadratic cells alternate, and with them the tractions.
    // There every pair is combined with the next one of its kind. Corners have the factor one third (Simpson's share of
    // an edge), middle nodes two thirds. A sharp tip thus gives the virtual crack closure of quadratic cells, 1/(2 l)
    // (F_corner.[u] one cell behind + F_middle.[u] one cell behind).
    void add_links(std::int64_t i0, std::int64_t i1, FrontPoint& out) const {
        if (interface_.geometry.nodes_per_face == 2) return add_link(i0, i1, 1.0, out);
        const std::int64_t i2 = 2 * i1 - i0;
        const bool corner = (i0 - first_corner_) % 2 == 0;
        if (inside(i2)) return add_link(i0, i2, corner ? 1.0 / 3.0 : 2.0 / 3.0, out);
        if (!corner) add_link(i0, i1, 2.0 / 3.0, out);  // the end of the interface replaces a middle node beyond it
    }
    // 1/2 (t_1.[u]_0 - t_0.[u]_1)
    void add_link(std::int64_t i0, std::int64_t i1, double share, FrontPoint& out) const {
        if (!parted(interface_, pair(i0), pair(i1))) return;
        Vector3 rate{};
        add_closure(interface_, pair(i0), pair(i1), 0.5 * share, out.direction, rate);
        out.rate[0] += rate[0];
        out.rate[1] += rate[1] + rate[2];  // the tangents of curved interfaces turn from pair to pair
    }

    const CrackedInterface& interface_;
    const EdgeChain& chain_;
    std::int64_t first_corner_;  // 0 or 1
};

}  // namespace

std::vector<CrackFront> crack_fronts_on_lines(const CrackedInterface& interface) {
    const InterfaceGeometry& geometry = interface.geometry;
    std::vector<std::uint8_t> corner(interface.adhesion.size(), 1);
    for (std::size_t f = 2; geometry.nodes_per_face == 3 && f < geometry.face.size(); f += 3)
        corner[index(geometry.face[f])] = 0;
    std::vector<CrackFront> fronts;
    for (const EdgeChain& chain : chains(interface)) {
        const Walk walk(interface, chain, corner);
        const std::vector<Walk::Found> found = walk.fronts();
        for (const Walk::Found& front : found) {
            FrontPoint point = walk.point(front);
            point.length = std::abs(front.arc - walk.other_end(found, front));
            fronts.push_back({false, {point}});
        }
    }
    return fronts;
}

}  // namespace delam
