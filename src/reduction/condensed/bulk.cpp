// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/bulk.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/zone/rigid_jumps.hpp"
#include "scene/carriers.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

namespace {

// The stiffness of all bodies over all mesh DOFs; rows of nodes of no body are empty.
SparseMatrix assemble(const Problem& problem, const Poll& poll) {
    const Mesh& mesh = *problem.mesh;
    const std::int64_t dim = mesh.dimension();
    const std::int64_t dofs = mesh.node_count() * dim;
    std::vector<SparseMatrix> part;
    std::vector<std::vector<std::int64_t>> nodes;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        nodes.push_back(mesh.body_nodes(body));
        part.push_back(problem.body_stiffness(body, poll));
        call_if_set(poll);
    }
    SparseMatrix k;
    k.rows = k.columns = dofs;
    k.start.assign(index(dofs) + 1, 0);
    for (std::size_t b = 0; b < part.size(); ++b)
        for (std::int64_t r = 0; r < part[b].rows; ++r)
            k.start[index(nodes[b][index(r / dim)] * dim + r % dim) + 1] =
                part[b].start[index(r) + 1] - part[b].start[index(r)];
    std::partial_sum(k.start.begin(), k.start.end(), k.start.begin());
    k.column.resize(index(k.start.back()));
    k.value.resize(index(k.start.back()));
    for (std::size_t b = 0; b < part.size(); ++b) {
        for (std::int64_t r = 0; r < part[b].rows; ++r) {
            std::size_t at = index(k.start[index(nodes[b][index(r / dim)] * dim + r % dim)]);
            for (std::int64_t e = part[b].start[index(r)]; e < part[b].start[index(r) + 1]; ++e, ++at) {
                const std::int64_t c = part[b].column[index(e)];
                k.column[at] = nodes[b][index(c / dim)] * dim + c % dim;
                k.value[at] = part[b].value[index(e)];
            }
        }
        part[b] = SparseMatrix();
    }
    return k;
}

SparseMatrix jump_matrix(const Problem& problem) {
    const std::int64_t dim = problem.mesh->dimension();
    std::vector<Triplet> triplets;
    const Carriers carriers(problem);
    std::int64_t row = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (std::int64_t r = 0; r < dim; ++r, ++row)
                for (std::int64_t k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * index(dim) + index(r)) * index(dim) + index(k)];
                    if (q == 0.0) continue;
                    for (const auto& [node, weight] : carriers.of(face.node_b[p]))
                        triplets.push_back({row, node * dim + k, q * weight});
                    for (const auto& [node, weight] : carriers.of(face.node_a[p]))
                        triplets.push_back({row, node * dim + k, -q * weight});
                }
    return from_triplets(row, problem.mesh->node_count() * dim, std::move(triplets));
}

// Groups of at most this many constraints are solved densely.
constexpr std::size_t dense_reactions = 200;

// For rows of unit length, whatever the units of control nodes.
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

// A control node used only by long constraints has no stiffness at all; its diagonal entry must exist all the same.
SparseMatrix with_diagonal(SparseMatrix k, std::int64_t first) {
    std::vector<Triplet> missing;
    for (std::int64_t r = first; r < k.rows; ++r) {
        const auto begin = k.column.begin() + k.start[index(r)], end = k.column.begin() + k.start[index(r) + 1];
        if (!std::binary_search(begin, end, r)) missing.push_back({r, r, 0.0});
    }
    if (missing.empty()) return k;
    std::vector<Triplet> all;
    for (std::int64_t r = 0; r < k.rows; ++r)
        for (std::int64_t e = k.start[index(r)]; e < k.start[index(r) + 1]; ++e)
            all.push_back({r, k.column[index(e)], k.value[index(e)]});
    all.insert(all.end(), missing.begin(), missing.end());
    return from_triplets(k.rows, k.columns, std::move(all));
}

}  // namespace

Bulk::Bulk(const Problem& problem, Monitor& monitor) : problem_(problem) {
    const Poll assembling = [&monitor] { monitor.progress("assemble", 0, 0); },
               analysing = [&monitor] { monitor.progress("analyse", 0, 0); };
    call_if_set(assembling);
    stiffness_ = assemble(problem_, assembling);
    call_if_set(assembling);
    jump_rows_ = jump_matrix(problem_);
    call_if_set(assembling);
    variables_ = make_jump_variables(problem_, assembling);
    call_if_set(assembling);
    transformed_ = with_diagonal(congruence(stiffness_, variables_.transform, assembling), variables_.leading);
    call_if_set(analysing);
    factor_ = std::make_unique<SparseCholesky>(transformed_, variables_.trailing(), analysing);
    size_ = factor_->size();
}

void Bulk::condense(Monitor& monitor) {
    const Poll condensing = [&monitor] { monitor.progress("condense", 0, 0); };
    monitor.progress("factor", 0, 0);
    factorise(condensing);
    StrainLoads strained = strain_loads(problem_);
    std::vector<std::vector<double>> bonded = condense_loads(strained, condensing);
    resolve_equations(condensing);
    call_if_set(condensing);
    find_pattern_stiffness(std::move(bonded), strained, condensing);
    const DenseMatrix motions = rigid_jumps(problem_);
    rigid_ = DenseMatrix(energy().rows(), motions.columns);
    for (std::int64_t c = 0; c < motions.columns; ++c)
        for (std::int64_t i = 0; i < rigid_.rows; ++i) rigid_(i, c) = motions(row_of_unknown_[index(i)], c);
    if (!base_) balance_strains();
    recoveries_ = 0;
}

// Factors T^T K T with a shift on the trailing diagonal, which the Schur complement of the trailing variables loses
// again.
void Bulk::factorise(const Poll& poll) {
    const std::int64_t leading = variables_.leading, trailing = variables_.trailing();
    std::vector<double> shift(index(trailing), 0.0);
    std::vector<std::int64_t> diagonal(index(trailing));
    for (std::int64_t t = 0; t < trailing; ++t) {
        const std::int64_t r = leading + t;
        for (std::int64_t e = transformed_.start[index(r)]; e < transformed_.start[index(r) + 1]; ++e)
            if (transformed_.column[index(e)] == r) diagonal[index(t)] = e;
        shift[index(t)] = transformed_.value[index(diagonal[index(t)])];
    }
    const double largest = trailing > 0 ? *std::max_element(shift.begin(), shift.end()) : 0.0;
    for (std::int64_t t = 0; t < trailing; ++t) {
        if (!(shift[index(t)] > 0.0)) shift[index(t)] = largest > 0.0 ? largest : 1.0;
        transformed_.value[index(diagonal[index(t)])] += shift[index(t)];
    }
    ++factorisations_;
    if (!factor_->factorise(transformed_))
        fail(DELAM_ERROR_NUMERICAL,
             "the stiffness of the bonded structure is not positive definite: check supports, materials and the shapes "
             "of cells");
    transformed_ = SparseMatrix();
    call_if_set(poll);
    energy_.stiffness = lower_times_transpose(factor_->trailing_factor(), poll);
    for (std::int64_t t = 0; t < trailing; ++t) energy_.stiffness(t, t) -= shift[index(t)];
}

// With all trailing variables at zero each pattern has the displacements u_p, which are returned; the remaining forces
// K u_p - f_p act on the trailing variables.
std::vector<std::vector<double>> Bulk::condense_loads(StrainLoads& strained, const Poll& poll) {
    const std::int64_t leading = variables_.leading, trailing = variables_.trailing();
    const std::size_t patterns = problem_.patterns.size();
    force_.assign(patterns, {});
    for (const NodalForce& f : problem_.forces) {
        auto& force = force_[index(f.pattern)];
        if (force.empty()) force.assign(index(dofs()), 0.0);
        force[index(f.dof)] += f.value;
    }
    for (std::size_t p = 0; p < patterns; ++p)
        if (!strained.force[p].empty()) force_[p] = std::move(strained.force[p]);
    energy_.load = DenseMatrix(trailing, static_cast<std::int64_t>(patterns));
    std::vector<double> nodal(index(dofs())), carried(index(variables_.count()));
    std::vector<std::vector<double>> bonded;
    for (std::size_t p = 0; p < patterns; ++p) {
        std::vector<double> u = variables_.lift[p];
        multiply(stiffness_, u, nodal);
        for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = (force_[p].empty() ? 0.0 : force_[p][i]) - nodal[i];
        std::vector<double> v = leading_solve(nodal);
        v.resize(carried.size(), 0.0);
        add_variables(v, u);
        multiply(stiffness_, u, nodal);
        for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = (force_[p].empty() ? 0.0 : force_[p][i]) - nodal[i];
        multiply_transposed(variables_.transform, nodal, carried);
        double squares = 0.0;
        for (std::size_t i = 0; i < index(leading); ++i) squares += carried[i] * carried[i] * v[i] * v[i];
        left_over_.push_back(std::sqrt(squares));
        std::copy(carried.begin() + leading, carried.end(),
                  energy_.load.value.begin() + static_cast<std::int64_t>(p) * trailing);
        bonded.push_back(std::move(u));
        call_if_set(poll);
    }
    return bonded;
}

// A_pq = u_p^T K u_q - f_p^T u_q - f_q^T u_p + W_pq, W of the eigenstrains: no difference of large numbers, whatever
// the lift is.
void Bulk::find_pattern_stiffness(std::vector<std::vector<double>> bonded, const StrainLoads& strained,
                                  const Poll& poll) {
    const std::size_t patterns = problem_.patterns.size();
    std::vector<double> nodal(index(dofs()));
    const std::vector<double> closed(index(energy().rows()), 0.0);
    std::vector<std::vector<double>> stressed;
    for (std::size_t p = 0; p < patterns; ++p) {
        if (variables_.kept > 0 || !pivot_.empty()) {
            std::vector<double> unit(patterns, 0.0);
            unit[p] = 1.0;
            bonded[p] = displacement(unit, closed);
        }
        multiply(stiffness_, bonded[p], nodal);
        stressed.push_back(nodal);
        call_if_set(poll);
    }
    pattern_stiffness_ = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t p = 0; p < patterns; ++p)
        for (std::size_t q = 0; q < patterns; ++q) {
            double a = dot(bonded[p], stressed[q]) + strained.energy[p * patterns + q];
            if (!force_[p].empty()) a -= dot(force_[p], bonded[q]);
            if (!force_[q].empty()) a -= dot(force_[q], bonded[p]);
            pattern_stiffness_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) = a;
        }
}

double Bulk::rounding_energy(std::span<const double> theta) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p) sum += theta[p] * theta[p] * left_over_[p];
    return sum;
}

// Eigenstrains do no work in rigid motions. If nothing resists these, the load along them is only rounding, and this
// removes it.
void Bulk::balance_strains() {
    const auto rows = index(rigid_.rows);
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        if (problem_.patterns[p].drives != Pattern::Drives::strain) continue;
        const auto load = std::span<double>(energy_.load.value).subspan(p * rows, rows);
        for (int pass = 0; pass < 2; ++pass)
            for (std::int64_t c = 0; c < rigid_.columns; ++c) {
                const auto motion = std::span<const double>(rigid_.value).subspan(index(c) * rows, rows);
                add_scaled(-dot(motion, load), motion, load);
            }
    }
}

std::vector<double> Bulk::leading_solve(std::span<const double> nodal) const {
    std::vector<double> carried(index(variables_.count())), v(index(variables_.leading), 0.0);
    multiply_transposed(variables_.transform, nodal, carried);
    carried.resize(v.size());
    if (std::any_of(carried.begin(), carried.end(), [](double x) { return x != 0.0; }))
        factor_->solve_leading(carried, v);
    return v;
}

void Bulk::add_variables(std::span<const double> variables, std::span<double> displacement) const {
    std::vector<double> moved(displacement.size());
    multiply(variables_.transform, variables, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) displacement[i] += moved[i];
}

std::vector<double> Bulk::displacement(std::span<const double> theta, std::span<const double> unknowns) const {
    std::vector<double> rest(rest_.size());
    if (base_)
        base_->recover(theta, unknowns, rest);
    else
        std::copy(unknowns.begin(), unknowns.end(), rest.begin());
    std::vector<double> v(index(variables_.count()), 0.0), bound(pivot_.size()), driven(pivot_.size());
    multiply(bound_, rest, bound);
    multiply(prescribed_, theta, driven);
    for (std::size_t i = 0; i < rest.size(); ++i) v[index(variables_.leading + rest_[i])] = rest[i];
    for (std::size_t i = 0; i < pivot_.size(); ++i) v[index(variables_.leading + pivot_[i])] = bound[i] + driven[i];

    std::vector<double> u(index(dofs()), 0.0), nodal(u.size());
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0) add_scaled(theta[p], variables_.lift[p], u);
    add_variables(v, u);
    multiply(stiffness_, u, nodal);
    for (double& f : nodal) f = -f;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force_[p].empty()) add_scaled(theta[p], force_[p], nodal);
    poll_cancel("recover", dofs() / 64);
    std::vector<double> inside = leading_solve(nodal);
    poll_cancel("recover", dofs() / 64);
    inside.resize(v.size(), 0.0);
    add_variables(inside, u);
    ++recoveries_;
    return u;
}

std::vector<double> Bulk::residual(std::span<const double> theta, std::span<const double> displacement,
                                   std::span<const double> force) const {
    std::vector<double> r(displacement.size()), pull(displacement.size());
    multiply(stiffness_, displacement, r);
    multiply_transposed(jump_rows_, force, pull);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += pull[i];
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force_[p].empty()) add_scaled(-theta[p], force_[p], r);
    return r;
}

// D^T rho = residual on the DOFs of the constraints, in the least-squares sense, with the smallest forces if the
// constraints are dependent. Constraints that share DOFs of bodies are solved together, densely. A control node may
// connect thousands of them; these are solved by conjugate gradients on D D^T, which then has few distinct eigenvalues
// (rows of few nodes, and one direction for each control DOF).
std::vector<double> Bulk::reaction(std::span<const double> theta, std::span<const double> displacement,
                                   std::span<const double> force) const {
    const std::vector<double> left = residual(theta, displacement, force);
    const std::size_t count = problem_.constraints.size();
    const Carriers carriers(problem_);
    const std::int64_t dim = problem_.mesh->dimension();
    std::vector<std::size_t> group(count);
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (group[i] != i) i = group[i] = group[group[i]];
        return i;
    };
    std::map<std::int64_t, std::size_t> user;
    for (std::size_t c = 0; c < count; ++c) {
        poll_cancel("recover", static_cast<std::int64_t>(problem_.constraints[c].dof.size()));
        for (const std::int64_t dof : problem_.constraints[c].dof)
            if (const auto [at, fresh] = user.try_emplace(dof, c); !fresh) group[find(c)] = find(at->second);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t c = 0; c < count; ++c) members[find(c)].push_back(c);

    std::vector<double> rho(count, 0.0);
    for (const auto& [root, list] : members) {
        poll_cancel("recover", static_cast<std::int64_t>(list.size()));
        const bool controlled = std::any_of(list.begin(), list.end(), [&](std::size_t c) {
            const auto& dofs = problem_.constraints[c].dof;
            return std::any_of(dofs.begin(), dofs.end(),
                               [&](std::int64_t dof) { return carriers.kind(dof / dim) == Carriers::Kind::control; });
        });
        std::vector<const Constraint*> rows;
        for (const std::size_t c : list) rows.push_back(&problem_.constraints[c]);
        const std::vector<double> own =
            controlled && list.size() > dense_reactions ? iterated_reactions(rows, left) : direct_reactions(rows, left);
        for (std::size_t i = 0; i < list.size(); ++i) rho[list[i]] = own[i];
    }
    return rho;
}

double Bulk::defect(std::span<const double> theta, std::span<const double> displacement, std::span<const double> force,
                    std::span<const double> reaction) const {
    std::vector<double> left = residual(theta, displacement, force);
    for (std::size_t c = 0; c < problem_.constraints.size(); ++c) {
        const Constraint& constraint = problem_.constraints[c];
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            left[index(constraint.dof[i])] -= reaction[c] * constraint.coefficient[i];
    }
    return max_abs(left);
}

}  // namespace delam
