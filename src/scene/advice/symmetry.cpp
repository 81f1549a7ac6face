// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/numbers.hpp"
#include "body/cell_elasticity.hpp"
#include "linalg/sparse/sparse_elimination.hpp"
#include "scene/advice/node_images.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Places, weights and values of files with seven digits; of the largest of their kind. (Measured by
// verify/bench/constants.py with unit_test_symmetry and case_test_symmetry_told: half and twice find the same
// symmetries.)
constexpr double same = 1e-6;

using Weights = std::map<std::int64_t, double>;

bool equal(double a, double b, double scale) { return std::abs(a - b) <= same * scale; }

bool equal(std::span<const double> a, std::span<const double> b) {
    const double scale = std::max(max_abs(a), max_abs(b));
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [scale](double x, double y) { return equal(x, y, scale); });
}

bool equal(const Weights& a, const Weights& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.first == y.first && equal(x.second, y.second, 1.0);
    });
}

// A pair, whichever interface it is of.
struct Pair {
    std::size_t interface, local;
    std::uint64_t kind;  // law, bond or contact
    Weights a, b;        // nodes of bodies and control nodes
    Point normal;        // from a to b
    Point axis;          // the first tangent where the law tells it from the second, else 0
    double gap;
};

class SymmetryCheck {
public:
    explicit SymmetryCheck(const Problem& problem);
    // The images of the pairs; none: the scene differs from its image.
    std::optional<std::vector<std::int64_t>> pairs_under(const Involution& involution) const;

private:
    bool may_exchange_pairs(const Involution& involution) const;
    std::optional<std::vector<std::int64_t>> pairs(const Involution& involution, const NodeImages& to) const;
    bool materials(const Involution& involution, const NodeImages& to) const;
    bool constraints(const Involution& involution, const NodeImages& to) const;
    bool forces(const Involution& involution, const NodeImages& to) const;
    bool eigenstrains(const Involution& involution, const NodeImages& to) const;
    bool same_pair(std::size_t p, std::size_t q, const Weights& a, const Weights& b, const Point& normal,
                   const Point& axis) const;

    const Problem& problem_;
    const Mesh& mesh_;
    std::size_t dim_;
    double tolerance_;
    Carriers carriers_;
    std::vector<Pair> pair_;
    std::map<std::int64_t, std::vector<std::size_t>> pairs_at_;  // the first node of either face
    std::vector<Point> place_;                                   // [pairs] of node b
    PlaceIndex places_;
};

SymmetryCheck::SymmetryCheck(const Problem& problem)
    : problem_(problem),
      mesh_(*problem.mesh),
      dim_(index(mesh_.dimension())),
      tolerance_(same * mesh_.size()),
      carriers_(problem),
      places_({}) {
    const auto nodes = [&](std::int64_t node) {
        Weights weights;
        for (const auto& [n, w] : carriers_.of(node)) weights[n] += w;
        return weights;
    };
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceGeometry& geometry = mesh_.interfaces()[i];
        const InterfaceProperties& own = problem.interfaces[i];
        const std::uint64_t kind = own.law ? hash(*own.law) : own.bonded ? 1 : 0;
        for (std::size_t p = 0; p < geometry.weight.size(); ++p) {
            Point normal{}, axis{};
            for (std::size_t k = 0; k < dim_; ++k) normal[k] = geometry.frame[p * dim_ * dim_ + k];
            if (own.law && has_axes(*own.law))
                for (std::size_t k = 0; k < dim_; ++k) axis[k] = geometry.frame[(p * dim_ + 1) * dim_ + k];
            pair_.push_back({i, p, kind, nodes(geometry.node_a[p]), nodes(geometry.node_b[p]), normal, axis,
                             own.gap.empty() ? 0.0 : own.gap[p]});
            for (const Weights* face : {&pair_.back().a, &pair_.back().b})
                pairs_at_[face->begin()->first].push_back(pair_.size() - 1);
            place_.push_back(position(mesh_, geometry.node_b[p]));
        }
    }
    places_ = PlaceIndex(place_);
}

// False if a pair has no place to go to, or if each stays where it is: most candidates need no pass over the cells.
bool SymmetryCheck::may_exchange_pairs(const Involution& involution) const {
    bool moves = false;
    for (std::size_t p = 0; p < pair_.size(); ++p) {
        const double adhesion = problem_.interfaces[pair_[p].interface].adhesion[pair_[p].local];
        bool stays = false, goes = false;
        for (const std::int64_t q : places_.at(involution.moved(place_[p]), tolerance_)) {
            const Pair& other = pair_[index(q)];
            if (other.kind != pair_[p].kind ||
                !equal(problem_.interfaces[other.interface].adhesion[other.local], adhesion, 1.0))
                continue;
            (index(q) == p ? stays : goes) = true;
        }
        if (!stays && !goes) return false;
        moves = moves || goes;
    }
    return moves;
}

// Compares pair q with the image of pair p, which has these faces.
bool SymmetryCheck::same_pair(std::size_t p, std::size_t q, const Weights& a, const Weights& b, const Point& normal,
                              const Point& axis) const {
    const Pair &from = pair_[p], &to = pair_[q];
    const InterfaceProperties &mine = problem_.interfaces[from.interface], &other = problem_.interfaces[to.interface];
    const double weight = mesh_.interfaces()[from.interface].weight[from.local];
    return to.kind == from.kind && equal(to.a, a) && equal(to.b, b) && length(to.normal - normal) <= same &&
           std::min(length(to.axis - axis), length(to.axis - Point{-axis[0], -axis[1], -axis[2]})) <= same &&
           equal(mesh_.interfaces()[to.interface].weight[to.local], weight, weight) &&
           equal(other.adhesion[to.local], mine.adhesion[from.local], 1.0) && other.gap_pattern == mine.gap_pattern &&
           std::abs(to.gap - from.gap) <= tolerance_;
}

std::optional<std::vector<std::int64_t>> SymmetryCheck::pairs(const Involution& involution,
                                                              const NodeImages& to) const {
    const auto moved = [&](const Weights& face) {
        Weights image;
        for (const auto& [node, w] : face) image[to.node[index(node)]] += w;
        return image;
    };
    std::vector<std::int64_t> image;
    for (std::size_t p = 0; p < pair_.size(); ++p) {
        const Weights a = moved(pair_[p].a), b = moved(pair_[p].b);
        const Point along = involution.turned(pair_[p].normal), against{-along[0], -along[1], -along[2]};
        const Point axis = involution.turned(pair_[p].axis);
        std::int64_t found = -1;
        for (const std::int64_t first : {a.begin()->first, b.begin()->first}) {
            const auto there = pairs_at_.find(first);
            if (there == pairs_at_.end() || found >= 0) continue;
            for (const std::size_t q : there->second)
                if (same_pair(p, q, a, b, along, axis) || same_pair(p, q, b, a, against, axis))
                    found = static_cast<std::int64_t>(q);
        }
        if (found < 0) return std::nullopt;
        image.push_back(found);
    }
    return image;
}

bool SymmetryCheck::materials(const Involution& involution, const NodeImages& to) const {
    std::vector<BodyModel> models;
    std::vector<CellElasticity> of, image;
    for (std::int32_t b = 0; b < mesh_.body_count(); ++b) models.push_back(problem_.model(b));
    for (const BodyModel& model : models) {
        of.emplace_back(model, mesh_.dimension());
        image.emplace_back(model, mesh_.dimension());
    }
    const auto orientation = [&](std::int64_t c) {
        return problem_.orientation == nullptr ? -1 : problem_.orientation->of_cell[index(c)];
    };
    std::map<std::array<std::int32_t, 4>, bool> known;  // bodies and axes of a cell and its image
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
        const std::int64_t other = to.cell[index(c)];
        const std::int32_t body = mesh_.cell_body(c), goal = mesh_.cell_body(other);
        const auto [at, is_new] = known.try_emplace({body, orientation(c), goal, orientation(other)}, false);
        if (is_new)
            at->second = problem_.formulation[index(body)] == problem_.formulation[index(goal)] &&
                         equal(rotated(of[index(body)].space(c), involution.matrix()), image[index(goal)].space(other));
        if (!at->second) return false;
    }
    return true;
}

// The image moves by u'(image of n) = R u(n): the equation sum of c u_k(n) = p says the sum of c R_jk u'_j = p of it.
bool SymmetryCheck::constraints(const Involution& involution, const NodeImages& to) const {
    const auto row = [&](const Constraint& constraint, bool image) {
        SparseElimination::Row out{{}, constraint.prescribed};
        out.right.resize(problem_.patterns.size(), 0.0);
        for (std::size_t e = 0; e < constraint.dof.size(); ++e) {
            const std::int64_t dim = mesh_.dimension(), node = constraint.dof[e] / dim, k = constraint.dof[e] % dim;
            if (!image) out.terms[constraint.dof[e]] += constraint.coefficient[e];
            for (std::int64_t j = 0; j < dim && image; ++j)
                if (const double r = involution.matrix()[index(3 * j + k)]; r != 0.0)
                    out.terms[dim * to.node[index(node)] + j] += constraint.coefficient[e] * r;
        }
        return out;
    };
    SparseElimination known;
    for (const Constraint& constraint : problem_.constraints) {
        SparseElimination::Row equation = row(constraint, false);
        known.reduce(equation);
        if (equation.terms.empty()) continue;
        const auto pivot =
            std::max_element(equation.terms.begin(), equation.terms.end(),
                             [](const auto& x, const auto& y) { return std::abs(x.second) < std::abs(y.second); });
        known.solve(equation, pivot->first);
    }
    known.close();
    return std::all_of(problem_.constraints.begin(), problem_.constraints.end(), [&](const Constraint& constraint) {
        SparseElimination::Row equation = row(constraint, true);
        const double scale = known.reduce(equation);
        return max_abs(equation.right) <= same * scale &&
               std::all_of(equation.terms.begin(), equation.terms.end(),
                           [](const auto& term) { return std::abs(term.second) <= same; });
    });
}

bool SymmetryCheck::forces(const Involution& involution, const NodeImages& to) const {
    std::vector<std::map<std::int64_t, Point>> force(problem_.patterns.size());
    std::vector<double> size(force.size(), 0.0);
    for (const NodalForce& f : problem_.forces)
        for (const auto& [node, w] : carriers_.of(f.dof / mesh_.dimension()))
            force[index(f.pattern)][node][index(f.dof % mesh_.dimension())] += w * f.value;
    for (std::size_t p = 0; p < force.size(); ++p)
        for (const auto& [node, f] : force[p]) size[p] = std::max(size[p], length(f));
    for (std::size_t p = 0; p < force.size(); ++p)
        for (const auto& [node, f] : force[p]) {
            const auto there = force[p].find(to.node[index(node)]);
            const Point other = there == force[p].end() ? Point{} : there->second;
            if (length(involution.turned(f) - other) > same * size[p]) return false;
        }
    return true;
}

bool SymmetryCheck::eigenstrains(const Involution& involution, const NodeImages& to) const {
    if (problem_.eigenstrains.empty()) return true;
    constexpr Axes global{1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        std::vector<Strain> strain(index(mesh_.body_count()), Strain{});
        for (const Eigenstrain& e : problem_.eigenstrains)
            if (index(e.pattern) == p)
                for (std::size_t k = 0; k < e.strain.size(); ++k) strain[index(e.body)][k] += e.strain[k];
        const auto in_space = [&](std::int64_t c) {
            const std::int32_t turned = problem_.orientation == nullptr ? -1 : problem_.orientation->of_cell[index(c)];
            return rotated_strain(strain[index(mesh_.cell_body(c))],
                                  turned < 0 ? global : problem_.orientation->axes[index(turned)]);
        };
        for (std::int64_t c = 0; c < mesh_.cell_count(); ++c)
            if (!equal(rotated_strain(in_space(c), involution.matrix()), in_space(to.cell[index(c)]))) return false;
    }
    return true;
}

std::optional<std::vector<std::int64_t>> SymmetryCheck::pairs_under(const Involution& involution) const {
    if (!may_exchange_pairs(involution)) return std::nullopt;
    std::optional<NodeImages> to = images(mesh_, involution, tolerance_);
    if (!to) return std::nullopt;
    // A control node is nowhere: its translation turns.
    for (const std::int64_t control : carriers_.controls()) to->node[index(control)] = control;
    std::optional<std::vector<std::int64_t>> found = pairs(involution, *to);
    if (!found || !materials(involution, *to) || !forces(involution, *to) || !eigenstrains(involution, *to) ||
        !constraints(involution, *to))
        return std::nullopt;
    return found;
}

}  // namespace

std::vector<Symmetry> symmetries(const Problem& problem) {
    std::vector<Symmetry> found;
    const bool inside_known =
        problem.engine == nullptr &&
        std::all_of(problem.stiffness.begin(), problem.stiffness.end(),
                    [](const auto& own) { return own == nullptr; }) &&
        std::all_of(problem.material.begin(), problem.material.end(), [](const auto& own) { return own.has_value(); });
    if (!inside_known || problem.pair_count() == 0) return found;
    std::vector<std::int64_t> identity(index(problem.pair_count()));
    std::iota(identity.begin(), identity.end(), std::int64_t{0});
    const SymmetryCheck check(problem);
    for (const Involution& involution : candidates(*problem.mesh)) {
        std::optional<std::vector<std::int64_t>> image = check.pairs_under(involution);
        if (image && *image != identity)
            found.push_back({involution.name(problem.mesh->dimension()), std::move(*image)});
    }
    return found;
}

}  // namespace delam
