// SPDX-License-Identifier: BSD-3-Clause
// The search works with rigid pieces, not nodes. Face-connected cells are one piece (pieces.hpp); pieces joined by
// enough tied pairs become one as well. What remains are a few pieces, hinges between them (such as a single pair),
// control nodes, which move by translations, and rows: constraints, pairs with control nodes, and the motions resisted
// by the host's own supports. Rows act on three or six motions per piece, and the null space of their small Gram matrix
// contains the motions that nothing resists.
#include "scene/check/supports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "mesh/points.hpp"
#include "scene/carriers.hpp"
#include "scene/pieces.hpp"

namespace delam {
namespace {

// Relative pivot below which a motion counts as unresisted. Rows enter squared: supports closer together than 1e-5 of
// the size of the supported part do not count as holding its rotation. (Measured by verify/bench/constants.py on 250
// random scenes: half and twice decide alike.)
constexpr double pivot_tolerance = 1e-10;

class Sets {
public:
    explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    bool join(std::size_t i, std::size_t j) {
        i = find(i);
        j = find(j);
        if (i == j) return false;
        parent_[std::max(i, j)] = std::min(i, j);
        return true;
    }

private:
    std::vector<std::size_t> parent_;
};

// Null space of a symmetric positive semidefinite n x n matrix by Cholesky factorisation with diagonal pivoting; one
// vector after another.
std::vector<std::vector<double>> null_space(std::vector<double> g, std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, g[i * n + i]);
    std::size_t rank = 0;
    for (; rank < n; ++rank) {
        poll_cancel("check", 1 + static_cast<std::int64_t>((n - rank) * (n - rank) / 256));
        std::size_t pivot = rank;
        for (std::size_t i = rank + 1; i < n; ++i) {
            if (g[i * n + i] > g[pivot * n + pivot]) pivot = i;
        }
        if (!(g[pivot * n + pivot] > pivot_tolerance * largest)) break;
        std::swap(order[rank], order[pivot]);
        for (std::size_t j = 0; j < n; ++j) std::swap(g[rank * n + j], g[pivot * n + j]);
        for (std::size_t i = 0; i < n; ++i) std::swap(g[i * n + rank], g[i * n + pivot]);
        // Row `rank` stores u = D L^T; the trailing block stores the Schur complement.
        for (std::size_t i = rank + 1; i < n; ++i) {
            const double factor = g[rank * n + i] / g[rank * n + rank];
            if (factor == 0.0) continue;
            for (std::size_t j = rank + 1; j < n; ++j) g[i * n + j] -= factor * g[rank * n + j];
        }
    }
    std::vector<std::vector<double>> basis;
    for (std::size_t free = rank; free < n; ++free) {
        std::vector<double> x(n, 0.0);
        x[free] = 1.0;
        for (std::size_t i = rank; i-- > 0;) {
            double sum = 0.0;
            for (std::size_t j = i + 1; j < n; ++j) sum += g[i * n + j] * x[j];
            x[i] = -sum / g[i * n + i];
        }
        std::vector<double> vector(n);
        for (std::size_t i = 0; i < n; ++i) vector[order[i]] = x[i];
        basis.push_back(std::move(vector));
    }
    return basis;
}

struct Tie {
    std::size_t piece_a;
    std::size_t piece_b;
    Point place;
};

using Row = Pieces::Row;

struct Frame {
    Point centre{};
    double length = 0.0;
};

struct Extent {
    std::array<Point, 2> corner{};
    bool empty = true;

    void take(const Point& p) {
        if (empty) corner = {p, p};
        empty = false;
        for (std::size_t d = 0; d < p.size(); ++d) {
            corner[0][d] = std::min(corner[0][d], p[d]);
            corner[1][d] = std::max(corner[1][d], p[d]);
        }
    }
};

class MotionFinder {
public:
    MotionFinder(const Problem& problem, bool tied)
        : problem_(problem),
          mesh_(*problem.mesh),
          carriers_(problem),
          dimension_(index(mesh_.dimension())),
          modes_(dimension_ == 2 ? 3 : 6),
          pieces_(rigid_pieces(problem)),
          groups_(pieces_.count() + carriers_.controls().size()) {
        take_pieces();
        find_ties(tied);
        merge();
    }
    std::vector<FreeMotion> run();

private:
    const Problem& problem_;
    const Mesh& mesh_;
    Carriers carriers_;
    std::size_t dimension_;
    std::size_t modes_;
    const Pieces& pieces_;
    Sets groups_;  // of the pieces, then of the control nodes
    std::vector<std::int64_t> node_piece_;
    std::vector<Tie> ties_;
    std::vector<Row> rows_;
    std::vector<Extent> box_;             // of the pieces, then of the control nodes
    std::map<std::size_t, Frame> frame_;  // of each group

    std::size_t group(std::int64_t node) { return groups_.find(index(node_piece_[index(node)])); }
    bool control(std::int64_t node) const { return carriers_.kind(node) == Carriers::Kind::control; }
    bool control_group(std::size_t group) const { return group >= pieces_.count(); }

    // Component c of rigid mode m at p: translations, then rotations about the centre that have unit displacement at
    // distance `length`.
    static double mode(const Frame& f, std::size_t dimension, std::size_t m, std::size_t c, const Point& p) {
        if (m < dimension) return m == c ? 1.0 : 0.0;
        const std::size_t axis = dimension == 2 ? 2 : m - dimension;
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        if (c == u) return -(p[v] - f.centre[v]) / f.length;
        if (c == v) return (p[u] - f.centre[u]) / f.length;
        return 0.0;
    }

    void take_pieces();
    void find_ties(bool tied);
    void merge();
    void measure();
    bool rigid(const std::vector<Point>& places, double length) const;
    std::vector<FreeMotion> examine(const std::vector<std::size_t>& cluster);
    std::vector<double> gram(const std::vector<std::size_t>& cluster);
    FreeMotion describe(const std::vector<std::size_t>& cluster, const std::vector<double>& motion);
    std::string words(const Frame& f, const double* motion) const;
};

void MotionFinder::take_pieces() {
    node_piece_ = pieces_.of_node;
    for (const Pieces::Hinge& hinge : pieces_.hinges)
        ties_.push_back({index(hinge.piece_a), index(hinge.piece_b), position(mesh_, hinge.node)});
    rows_ = pieces_.resisted;
    for (std::size_t c = 0; c < carriers_.controls().size(); ++c)
        node_piece_[index(carriers_.controls()[c])] = static_cast<std::int64_t>(pieces_.count() + c);
}

// A tied node moves with the piece to which it is tied, because its combination is exact for rigid motions. A control
// node has no position, so pairs with one are rows.
void MotionFinder::find_ties(bool tied) {
    for (std::size_t i = 0; i < problem_.interfaces.size(); ++i) {
        const InterfaceGeometry& face = mesh_.interfaces()[i];
        const InterfaceProperties& interface = problem_.interfaces[i];
        for (std::size_t p = 0; p < face.node_a.size(); ++p) {
            poll_cancel("check");
            const bool glued = tied || interface.bonded || (!interface.contact && interface.adhesion[p] > 0.0);
            if (!glued && !interface.contact) continue;
            const std::int64_t a = carriers_.of(face.node_a[p]).front().first,
                               b = carriers_.of(face.node_b[p]).front().first;
            if (glued && !control(a) && !control(b)) {
                ties_.push_back(
                    {index(node_piece_[index(a)]), index(node_piece_[index(b)]), position(mesh_, face.node_a[p])});
                continue;
            }
            for (std::size_t c = 0; c < (glued ? dimension_ : 1); ++c) {
                Row row;
                for (std::size_t d = 0; d < dimension_; ++d) {
                    const double q = face.frame[(p * dimension_ + c) * dimension_ + d];
                    if (q == 0.0) continue;
                    for (const auto& [node, weight] : carriers_.of(face.node_b[p]))
                        row.emplace_back(mesh_.dimension() * node + static_cast<std::int64_t>(d), q * weight);
                    for (const auto& [node, weight] : carriers_.of(face.node_a[p]))
                        row.emplace_back(mesh_.dimension() * node + static_cast<std::int64_t>(d), -q * weight);
                }
                rows_.push_back(std::move(row));
            }
        }
    }
    for (const Constraint& constraint : problem_.constraints) {
        poll_cancel("check");
        Row row;
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            row.emplace_back(constraint.dof[i], constraint.coefficient[i]);
        rows_.push_back(std::move(row));
    }
}

void MotionFinder::measure() {
    // Boxes of the pieces and control nodes are found once, and united for each grouping.
    if (box_.empty()) {
        box_.resize(pieces_.count() + carriers_.controls().size());
        for (std::int64_t node = 0; node < mesh_.node_count(); ++node) {
            if (node_piece_[index(node)] < 0) continue;
            poll_cancel("check");
            box_[index(node_piece_[index(node)])].take(position(mesh_, node));
        }
    }
    std::map<std::size_t, Extent> box;
    for (std::size_t piece = 0; piece < box_.size(); ++piece) {
        if (box_[piece].empty) continue;
        Extent& united = box[groups_.find(piece)];
        united.take(box_[piece].corner[0]);
        united.take(box_[piece].corner[1]);
    }
    frame_.clear();
    for (const auto& [g, extent] : box) {
        const std::array<Point, 2>& corners = extent.corner;
        Frame f;
        for (std::size_t d = 0; d < dimension_; ++d) {
            f.centre[d] = 0.5 * (corners[0][d] + corners[1][d]);
            f.length = std::max(f.length, 0.5 * (corners[1][d] - corners[0][d]));
        }
        if (control_group(g) || !(f.length > 0.0)) f.length = 1.0;
        frame_[g] = f;
    }
}

// True if ties at these positions leave no relative motion.
bool MotionFinder::rigid(const std::vector<Point>& places, double length) const {
    Frame f;
    f.length = length;
    for (const Point& p : places) {
        for (std::size_t d = 0; d < 3; ++d) f.centre[d] += p[d] / static_cast<double>(places.size());
    }
    std::vector<double> g(modes_ * modes_, 0.0);
    for (const Point& p : places) {
        poll_cancel("check");
        for (std::size_t c = 0; c < dimension_; ++c) {
            for (std::size_t i = 0; i < modes_; ++i) {
                for (std::size_t j = 0; j < modes_; ++j) {
                    g[i * modes_ + j] += mode(f, dimension_, i, c, p) * mode(f, dimension_, j, c, p) /
                                         static_cast<double>(places.size());
                }
            }
        }
    }
    return null_space(std::move(g), modes_).empty();
}

void MotionFinder::merge() {
    for (bool merged = true; merged;) {
        merged = false;
        measure();
        std::map<std::pair<std::size_t, std::size_t>, std::vector<Point>> joint;
        for (const Tie& tie : ties_) {
            poll_cancel("check");
            const std::size_t a = groups_.find(tie.piece_a);
            const std::size_t b = groups_.find(tie.piece_b);
            if (a != b) joint[std::minmax(a, b)].push_back(tie.place);
        }
        for (const auto& [pair, places] : joint) {
            if (rigid(places, std::min(frame_[pair.first].length, frame_[pair.second].length))) {
                merged = groups_.join(pair.first, pair.second) || merged;
            }
        }
    }
}

std::vector<double> MotionFinder::gram(const std::vector<std::size_t>& cluster) {
    const std::size_t n = cluster.size() * modes_;
    std::map<std::size_t, std::size_t> offset;
    for (std::size_t i = 0; i < cluster.size(); ++i) offset[cluster[i]] = i * modes_;
    std::vector<double> g(n * n, 0.0);
    std::vector<double> row(n);
    const auto add = [&](std::size_t group, std::size_t component, const Point& p, double factor) {
        for (std::size_t m = 0; m < modes_; ++m) {
            row[offset.at(group) + m] += factor * mode(frame_[group], dimension_, m, component, p);
        }
    };
    const auto close = [&] {
        poll_cancel("check", 1 + static_cast<std::int64_t>(n) / 8);
        for (std::size_t i = 0; i < n; ++i) {
            if (row[i] == 0.0) continue;
            for (std::size_t j = 0; j < n; ++j) g[i * n + j] += row[i] * row[j];
        }
        std::fill(row.begin(), row.end(), 0.0);
    };
    for (const Tie& tie : ties_) {
        const std::size_t a = groups_.find(tie.piece_a);
        const std::size_t b = groups_.find(tie.piece_b);
        if (a == b || offset.find(a) == offset.end()) continue;
        for (std::size_t c = 0; c < dimension_; ++c) {
            add(a, c, tie.place, -1.0);
            add(b, c, tie.place, 1.0);
            close();
        }
    }
    for (const Row& constraint : rows_) {
        if (offset.find(group(constraint.front().first / mesh_.dimension())) == offset.end()) continue;
        for (const auto& [dof, coefficient] : constraint)
            add(group(dof / mesh_.dimension()), index(dof % mesh_.dimension()),
                position(mesh_, dof / mesh_.dimension()), coefficient);
        close();
    }
    for (std::size_t i = 0; i < cluster.size(); ++i)
        for (std::size_t m = dimension_; control_group(cluster[i]) && m < modes_; ++m)
            g[(i * modes_ + m) * (n + 1)] = 1.0;
    for (std::size_t piece = 0; piece < pieces_.count(); ++piece) {
        const auto held = pieces_.fixed[piece] != 0 ? offset.find(groups_.find(piece)) : offset.end();
        for (std::size_t m = 0; held != offset.end() && m < modes_; ++m) g[(held->second + m) * (n + 1)] += 1.0;
    }
    return g;
}

std::string MotionFinder::words(const Frame& f, const double* motion) const {
    Point t{};
    Point w{};
    for (std::size_t d = 0; d < dimension_; ++d) t[d] = motion[d];
    for (std::size_t r = 0; r + dimension_ < modes_; ++r)
        w[dimension_ == 2 ? 2 : r] = motion[dimension_ + r] / f.length;
    const auto norm = [](const Point& a) { return std::sqrt(dot(a, a)); };
    const auto tidy = [&](Point a, double scale) {
        for (double& value : a) value = std::abs(value) < 1e-6 * scale ? 0.0 : value;
        return place(static_cast<int>(dimension_), a);
    };
    const auto direction = [&](Point a) {
        const double length = norm(a);
        for (std::size_t d = 0; d < 3; ++d) {
            if (std::abs(a[d]) > (1.0 - 1e-8) * length) return std::string(1, "xyz"[d]);
        }
        for (double& value : a) value /= length;
        return tidy(a, 1.0);
    };
    const double turn = norm(w);
    if (turn * f.length < 1e-6 * norm(t)) return "translate along " + direction(t);
    // The centre of the motion (the foot of its axis): c + w x t / |w|^2.
    Point foot = f.centre;
    const Point arm = cross(w, t);
    for (std::size_t d = 0; d < 3; ++d) foot[d] += arm[d] / (turn * turn);
    if (dimension_ == 2) return "rotate about the point " + tidy(foot, f.length);
    const double slide = dot(t, w) / turn;
    return text(std::abs(slide) > 1e-6 * turn * f.length ? "screw" : "rotate", " about the axis along ", direction(w),
                " through ", tidy(foot, f.length));
}

FreeMotion MotionFinder::describe(const std::vector<std::size_t>& cluster, const std::vector<double>& motion) {
    FreeMotion free{{}, {}, "", 0.0, -1};
    double largest = 0.0;
    std::size_t mover = 0;
    std::vector<double> size(cluster.size(), 0.0);
    for (std::size_t i = 0; i < cluster.size(); ++i) {
        size[i] = max_abs({motion.data() + i * modes_, modes_});
        largest = std::max(largest, size[i]);
        // Bodies are more informative than control nodes, which follow them.
        const bool tells = control_group(cluster[mover]) == control_group(cluster[i]) ? size[i] > size[mover]
                                                                                      : control_group(cluster[mover]);
        if (tells && size[i] > 1e-6 * largest) mover = i;
    }
    for (std::size_t i = 0; i < cluster.size(); ++i)
        if (size[mover] <= 1e-6 * largest && size[i] > size[mover]) mover = i;
    free.description = words(frame_[cluster[mover]], &motion[mover * modes_]);
    for (std::size_t piece = 0; piece < pieces_.count(); ++piece) {
        const auto found = std::find(cluster.begin(), cluster.end(), groups_.find(piece));
        if (found != cluster.end() && size[index(found - cluster.begin())] > 1e-6 * largest) {
            free.bodies.push_back(pieces_.body[piece]);
        }
    }
    for (std::size_t i = 0; i < cluster.size(); ++i)
        if (control_group(cluster[i]) && size[i] > 1e-6 * largest)
            free.controls.push_back(carriers_.controls()[cluster[i] - pieces_.count()]);
    std::sort(free.bodies.begin(), free.bodies.end());
    free.bodies.erase(std::unique(free.bodies.begin(), free.bodies.end()), free.bodies.end());

    std::vector<double> work(problem_.patterns.size(), 0.0);
    std::vector<double> scale(problem_.patterns.size(), 0.0);
    for (const NodalForce& force : problem_.forces) {
        const std::int64_t node = force.dof / mesh_.dimension();
        const auto found = std::find(cluster.begin(), cluster.end(), group(node));
        if (found == cluster.end()) continue;
        const std::size_t first = index(found - cluster.begin()) * modes_;
        for (std::size_t m = 0; m < modes_; ++m) {
            work[index(force.pattern)] +=
                force.value * motion[first + m] / largest *
                mode(frame_[*found], dimension_, m, index(force.dof % mesh_.dimension()), position(mesh_, node));
        }
        scale[index(force.pattern)] += std::abs(force.value);
    }
    for (std::size_t p = 0; p < work.size(); ++p) {
        const double relative = scale[p] > 0.0 ? std::abs(work[p]) / scale[p] : 0.0;
        if (relative > free.force_work) {
            free.force_work = relative;
            free.force_pattern = static_cast<std::int64_t>(p);
        }
    }
    return free;
}

// Free translations of the whole cluster come first, because they are easiest to read; the rest is made orthogonal to
// them.
std::vector<FreeMotion> MotionFinder::examine(const std::vector<std::size_t>& cluster) {
    const std::size_t n = cluster.size() * modes_;
    const std::vector<double> g = gram(cluster);
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, g[i * n + i]);
    std::vector<std::vector<double>> told;
    const std::vector<std::vector<double>> basis = null_space(g, n);
    const auto tell = [&](std::vector<double> motion) {
        double before = 0.0;
        for (const double value : motion) before += value * value;
        for (const std::vector<double>& other : told) {
            double along = 0.0;
            for (std::size_t i = 0; i < n; ++i) along += motion[i] * other[i];
            for (std::size_t i = 0; i < n; ++i) motion[i] -= along * other[i];
        }
        double after = 0.0;
        for (const double value : motion) after += value * value;
        if (after < 1e-12 * before) return;
        for (double& value : motion) value /= std::sqrt(after);
        told.push_back(std::move(motion));
    };
    for (std::size_t d = 0; d < dimension_ && !basis.empty(); ++d) {
        std::vector<double> motion(n, 0.0);
        for (std::size_t i = 0; i < cluster.size(); ++i) motion[i * modes_ + d] = 1.0;
        double energy = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) energy += motion[i] * g[i * n + j] * motion[j];
        }
        if (energy <= pivot_tolerance * largest) tell(std::move(motion));
    }
    for (const std::vector<double>& motion : basis) tell(motion);
    std::vector<FreeMotion> list;
    for (const std::vector<double>& motion : told) list.push_back(describe(cluster, motion));
    return list;
}

std::vector<FreeMotion> MotionFinder::run() {
    Sets clusters(pieces_.count() + carriers_.controls().size());
    for (const Tie& tie : ties_) clusters.join(groups_.find(tie.piece_a), groups_.find(tie.piece_b));
    for (const Row& row : rows_)
        for (const auto& [dof, coefficient] : row)
            clusters.join(group(row.front().first / mesh_.dimension()), group(dof / mesh_.dimension()));
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (const auto& [g, f] : frame_) members[clusters.find(g)].push_back(g);
    std::vector<FreeMotion> list;
    for (const auto& [root, cluster] : members) {
        for (FreeMotion& motion : examine(cluster)) list.push_back(std::move(motion));
    }
    return list;
}

}  // namespace

std::vector<FreeMotion> free_motions(const Problem& problem, bool tied) { return MotionFinder(problem, tied).run(); }

}  // namespace delam
