// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/body_reactions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Groups of at most this many constraints are solved densely.
constexpr std::size_t dense_reactions = 200;

// Computes the reactions with rows scaled to unit length, whatever the units of control nodes.
std::vector<double> direct_reactions(std::span<const Constraint* const> list, std::span<const double> left) {
    const auto n = static_cast<std::int64_t>(list.size());
    std::vector<std::map<std::int64_t, double>> row(list.size());
    DenseMatrix gram(n, n);
    std::vector<double> right(list.size(), 0.0), rho(list.size(), 0.0), length(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t k = 0; k < list[i]->dof.size(); ++k) row[i][list[i]->dof[k]] += list[i]->coefficient[k];
        double square = 0.0;
        for (const auto& [dof, c] : row[i]) square += c * c;
        length[i] = std::sqrt(square);
        for (auto& [dof, c] : row[i]) {
            c /= length[i];
            right[i] += c * left[index(dof)];
        }
        for (std::size_t j = 0; j <= i; ++j)
            for (const auto& [dof, c] : row[i])
                if (const auto other = row[j].find(dof); other != row[j].end())
                    gram(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)) += c * other->second;
    }
    mirror_lower(gram);
    const Eigen eigen = eigen_symmetric(std::move(gram));
    for (std::int64_t e = 0; e < n; ++e) {
        if (!(eigen.value[index(e)] > dependent_equation * eigen.value.back())) continue;
        double along = 0.0;
        for (std::int64_t i = 0; i < n; ++i) along += eigen.vector(i, e) * right[index(i)];
        for (std::int64_t i = 0; i < n; ++i) rho[index(i)] += along / eigen.value[index(e)] * eigen.vector(i, e);
    }
    for (std::size_t i = 0; i < list.size(); ++i) rho[i] /= length[i];
    return rho;
}

// CGLS (M. Hestenes, E. Stiefel, 1952) on rows of unit length.
std::vector<double> iterated_reactions(std::span<const Constraint* const> list, std::span<const double> left) {
    std::map<std::int64_t, std::int64_t> place;
    std::vector<Triplet> triplets;
    std::vector<double> length;
    for (std::size_t i = 0; i < list.size(); ++i) {
        double square = 0.0;
        for (const double c : list[i]->coefficient) square += c * c;
        length.push_back(std::sqrt(square));
        for (std::size_t k = 0; k < list[i]->dof.size(); ++k) {
            const auto at = place.try_emplace(list[i]->dof[k], static_cast<std::int64_t>(place.size())).first->second;
            triplets.push_back({static_cast<std::int64_t>(i), at, list[i]->coefficient[k] / length.back()});
        }
    }
    const auto n = static_cast<std::int64_t>(list.size());
    const SparseMatrix d = from_triplets(n, static_cast<std::int64_t>(place.size()), std::move(triplets));
    std::vector<double> residual(place.size()), step(place.size()), s(list.size()), p, rho(list.size(), 0.0);
    for (const auto& [dof, at] : place) residual[index(at)] = left[index(dof)];
    const int power = exponent(max_abs(residual));  // squares of the smallest and largest forces leave the doubles
    scale_by_power(residual, -power);
    multiply(d, residual, s);
    p = s;
    double size = dot(s, s);
    const double enough = 1e-30 * size;
    for (std::int64_t iteration = 0; iteration < 4 * n && size > enough; ++iteration) {
        multiply_transposed(d, p, step);
        const double length_of_step = size / dot(step, step);
        add_scaled(length_of_step, p, rho);
        add_scaled(-length_of_step, step, residual);
        multiply(d, residual, s);
        const double next = dot(s, s);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = s[i] + next / size * p[i];
        size = next;
    }
    scale_by_power(rho, power);
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] /= length[i];
    return rho;
}

}  // namespace

// D^T rho = residual on the DOFs of the constraints, in the least-squares sense, with the smallest forces if the
// constraints are dependent. Constraints that share DOFs of bodies are solved together, densely. A control node may
// connect thousands of them; these are solved by conjugate gradients on D D^T, which then has few distinct eigenvalues
// (rows of few nodes, and one direction for each control DOF).
std::vector<double> body_reactions(const BodySystem& bodies, std::span<const double> theta,
                                   std::span<const double> stressed, std::span<const double> force) {
    const Problem& problem = bodies.problem();
    const std::vector<double> left = bodies.residual(theta, stressed, force);
    const std::size_t count = problem.constraints.size();
    const Carriers carriers(problem);
    const std::int64_t dim = problem.mesh->dimension();
    std::vector<std::size_t> group(count);
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (group[i] != i) i = group[i] = group[group[i]];
        return i;
    };
    std::map<std::int64_t, std::size_t> user;
    for (std::size_t c = 0; c < count; ++c) {
        poll_cancel("recover", static_cast<std::int64_t>(problem.constraints[c].dof.size()));
        for (const std::int64_t dof : problem.constraints[c].dof)
            if (const auto [at, inserted] = user.try_emplace(dof, c); !inserted) group[find(c)] = find(at->second);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t c = 0; c < count; ++c) members[find(c)].push_back(c);

    std::vector<double> rho(count, 0.0);
    for (const auto& [root, list] : members) {
        poll_cancel("recover", static_cast<std::int64_t>(list.size()));
        const bool controlled = std::any_of(list.begin(), list.end(), [&](std::size_t c) {
            const auto& dofs = problem.constraints[c].dof;
            return std::any_of(dofs.begin(), dofs.end(),
                               [&](std::int64_t dof) { return carriers.kind(dof / dim) == Carriers::Kind::control; });
        });
        std::vector<const Constraint*> rows;
        for (const std::size_t c : list) rows.push_back(&problem.constraints[c]);
        const std::vector<double> own =
            controlled && list.size() > dense_reactions ? iterated_reactions(rows, left) : direct_reactions(rows, left);
        for (std::size_t i = 0; i < list.size(); ++i) rho[list[i]] = own[i];
    }
    return rho;
}

double equilibrium_defect(const BodySystem& bodies, std::span<const double> theta, std::span<const double> stressed,
                          std::span<const double> force) {
    const std::vector<double> reaction = body_reactions(bodies, theta, stressed, force);
    std::vector<double> left = bodies.residual(theta, stressed, force);
    const std::vector<Constraint>& constraints = bodies.problem().constraints;
    for (std::size_t c = 0; c < constraints.size(); ++c) {
        const Constraint& constraint = constraints[c];
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            left[index(constraint.dof[i])] -= reaction[c] * constraint.coefficient[i];
    }
    return max_abs(left);
}

}  // namespace delam
