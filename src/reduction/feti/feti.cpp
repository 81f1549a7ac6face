// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/feti.hpp"

#include <algorithm>
#include <cmath>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/team.hpp"
#include "body/assembly.hpp"
#include "body/rigid_modes.hpp"
#include "mesh/partition.hpp"
#include "reduction/feti/projected_cg.hpp"
#include "scene/carriers.hpp"
#include "scene/pieces.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Largest part of a load's resultant that may be left unbalanced before the part counts as not held.
constexpr double unbalanced = 1e-8;
// Residuals below this part of the loads' own energy norm are rounding.
constexpr double rounding = 1e-14;

const HostPiece& piece_with(const HostStiffness& own, const std::vector<std::int64_t>& nodes) {
    return *std::find_if(own.pieces.begin(), own.pieces.end(), [&](const HostPiece& p) { return p.nodes == nodes; });
}

// The part of a matrix over the DOFs of `nodes` that belongs to some of them.
SparseMatrix restricted(const SparseMatrix& k, std::span<const std::int64_t> nodes, std::span<const std::int64_t> some,
                        std::int64_t dim) {
    std::vector<std::int64_t> place(index(k.rows), -1), rows;
    for (const std::int64_t node : some) {
        const std::int64_t i = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
        for (std::int64_t c = 0; c < dim; ++c) {
            place[index(i * dim + c)] = static_cast<std::int64_t>(rows.size());
            rows.push_back(i * dim + c);
        }
    }
    SparseMatrix part;
    part.rows = part.columns = static_cast<std::int64_t>(rows.size());
    for (const std::int64_t row : rows) {
        for (std::int64_t e = k.start[index(row)]; e < k.start[index(row) + 1]; ++e) {
            if (place[index(k.column[index(e)])] < 0) continue;  // a zero between pieces
            part.column.push_back(place[index(k.column[index(e)])]);
            part.value.push_back(k.value[index(e)]);
        }
        part.start.push_back(part.entries());
    }
    return part;
}

}  // namespace

// The dense boundary blocks pay as long as a subdomain stays small: about 20,000 DOFs in the plane, 4,000 in space.
std::int64_t feti_subdomains(const Problem& problem) {
    const std::int64_t bodies = problem.mesh->body_count();
    if (problem.options.subdomains > 0) return std::max<std::int64_t>(bodies, problem.options.subdomains);
    const std::int64_t dofs = problem.mesh->node_count() * problem.mesh->dimension();
    const std::int64_t size = problem.mesh->dimension() == 2 ? 20000 : 4000;
    return std::max<std::int64_t>(bodies, (dofs + size - 1) / size);
}

Feti::Feti(const Problem& problem, Monitor& monitor) : problem_(problem), monitor_(monitor) {
    const auto parting = [this] { monitor_.progress("partition", 0, 0); };
    parting();
    const std::vector<std::vector<std::int64_t>> cells = cut();
    parting();
    DualRowBuilder builder(problem_, subdomains_, problem_.options.gluing);
    parting();
    const auto touched = builder.touched(subdomains_.size());
    const bool with_schur =
        problem_.options.preconditioner == "dirichlet" || problem_.options.preconditioner == "series";
    const auto parts = static_cast<std::int64_t>(subdomains_.size());
    const Poll poll = monitor_.poll_at("condense", parts, parts);
    const auto condense = [&](std::int64_t i) {
        const std::size_t s = index(i);
        Subdomain& subdomain = subdomains_[s];
        if (subdomain.body < 0) {
            subdomain.hold_controls(
                builder.scale(static_cast<std::int32_t>(s),
                              static_cast<std::int64_t>(subdomain.nodes.size()) * problem_.mesh->dimension()));
            return;
        }
        subdomain.boundary = touched[s];
        if (const auto& own = problem_.stiffness[index(subdomain.body)]; own == nullptr) {
            subdomain.stiffness =
                assemble_stiffness(*problem_.mesh, cells[s], subdomain.nodes, problem_.model(subdomain.body), poll);
            subdomain.rigid = DenseMatrix(subdomain.stiffness.rows, problem_.mesh->dimension() == 2 ? 3 : 6);
            subdomain.rigid.value = rigid_modes(*problem_.mesh, subdomain.nodes);
        } else {
            const HostPiece& piece = piece_with(*own, subdomain.nodes);
            subdomain.stiffness = restricted(own->matrix, problem_.mesh->body_nodes(subdomain.body), piece.nodes,
                                             problem_.mesh->dimension());
            subdomain.rigid = piece.free;
        }
        subdomain.condense(problem_.mesh->body_label(subdomain.body), with_schur, poll);
    };
    Team(problem_.options.threads).run(parts, condense, [&](std::int64_t done) {
        monitor_.progress("condense", done, parts);
    });
    call_if_set(poll);
    rows_ = builder.finish(subdomains_);
    call_if_set(poll);
    copies_ = builder.copies();
    b_transposed_ = transpose(rows_.b);
    scaling_ = make_scaling(rows_, subdomains_, problem_.options.scaling);
    call_if_set(poll);
    preconditioner_ =
        std::make_unique<FetiPreconditioner>(rows_, subdomains_, scaling_, problem_.options.preconditioner, poll);
    call_if_set(poll);
    coarse_ = std::make_unique<CoarseProblem>(rows_, subdomains_);

    flexibility_diagonal_.assign(index(rows_.count()), 0.0);
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
        call_if_set(poll);
        const std::int64_t first = rows_.offset[s], last = rows_.offset[s + 1];
        for (std::int64_t r = 0; r < rows_.b.rows; ++r)
            for (std::int64_t i = rows_.b.start[index(r)]; i < rows_.b.start[index(r) + 1]; ++i)
                for (std::int64_t j = rows_.b.start[index(r)]; j < rows_.b.start[index(r) + 1]; ++j) {
                    const std::int64_t di = rows_.b.column[index(i)], dj = rows_.b.column[index(j)];
                    if (di < first || di >= last || dj < first || dj >= last) continue;
                    flexibility_diagonal_[index(r)] += rows_.b.value[index(i)] * rows_.b.value[index(j)] *
                                                       subdomains_[s].flexibility(di - first, dj - first);
                }
    }
    // Rows among control nodes alone know no flexibility; the coarse problem decides their forces, whatever their
    // weight.
    double sum = 0.0;
    std::int64_t known = 0;
    for (const double f : flexibility_diagonal_) {
        sum += f;
        known += f > 0.0 ? 1 : 0;
    }
    for (double& f : flexibility_diagonal_)
        if (!(f > 0.0)) f = known > 0 ? sum / static_cast<double>(known) : 1.0;
    prescribed_ = problem_.prescribed_matrix();
    call_if_set(poll);
    precompute_forces(cells, poll);
}

// Cells of each subdomain.
std::vector<std::vector<std::int64_t>> Feti::cut() {
    const Mesh& mesh = *problem_.mesh;
    const std::vector<std::uint8_t> given = given_by_host(problem_);
    std::int64_t whole = 0, cut_cells = 0;  // pieces of the host's, each a subdomain; cells of the other bodies
    for (const auto& own : problem_.stiffness)
        whole += own != nullptr ? static_cast<std::int64_t>(own->pieces.size()) : 0;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) cut_cells += given[index(mesh.cell_body(c))] == 0 ? 1 : 0;
    const std::int64_t wanted = whole == 0 ? feti_subdomains(problem_)
                                           : std::clamp<std::int64_t>(feti_subdomains(problem_) - whole, 0, cut_cells);
    const Partition parts = partition(mesh, wanted, given);
    subdomains_.resize(parts.subdomain_body.size());
    for (std::size_t s = 0; s < subdomains_.size(); ++s) subdomains_[s].body = parts.subdomain_body[s];
    std::vector<std::vector<std::int64_t>> cells(subdomains_.size());
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        if (parts.cell_subdomain[index(c)] < 0) continue;
        const std::size_t s = index(parts.cell_subdomain[index(c)]);
        cells[s].push_back(c);
        subdomains_[s].nodes.insert(subdomains_[s].nodes.end(), mesh.cell(c).begin(), mesh.cell(c).end());
    }
    for (Subdomain& s : subdomains_) {
        std::sort(s.nodes.begin(), s.nodes.end());
        s.nodes.erase(std::unique(s.nodes.begin(), s.nodes.end()), s.nodes.end());
    }
    for (std::size_t b = 0; b < problem_.stiffness.size(); ++b) {
        if (problem_.stiffness[b] == nullptr) continue;
        for (const HostPiece& piece : problem_.stiffness[b]->pieces) {
            Subdomain& own = subdomains_.emplace_back();
            own.body = static_cast<std::int32_t>(b);
            own.nodes = piece.nodes;
            cells.emplace_back();
        }
    }
    if (const Carriers carriers(problem_); !carriers.controls().empty()) {
        subdomains_.emplace_back().nodes = carriers.controls();
        cells.emplace_back();
    }
    return cells;
}

void Feti::precompute_forces(std::span<const std::vector<std::int64_t>> cells, const Poll& poll) {
    const std::size_t patterns = problem_.patterns.size();
    const int dim = problem_.mesh->dimension();
    force_.assign(patterns, std::vector<std::vector<double>>(subdomains_.size()));
    for (const NodalForce& f : problem_.forces) {
        const NodeCopy& copy = copies_[index(f.dof / dim)].front();
        auto& local = force_[index(f.pattern)][index(copy.subdomain)];
        if (local.empty()) local.assign(index(subdomains_[index(copy.subdomain)].dofs()), 0.0);
        local[index(copy.local * dim + f.dof % dim)] += f.value;
    }
    strain_energy_ = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t s = 0; s < subdomains_.size() && !problem_.eigenstrains.empty(); ++s) {
        StrainLoads own = strain_loads(problem_, subdomains_[s].body, cells[s], subdomains_[s].nodes);
        for (std::size_t p = 0; p < patterns; ++p)
            if (!own.force[p].empty()) force_[p][s] = std::move(own.force[p]);
        for (std::size_t i = 0; i < own.energy.size(); ++i) strain_energy_.value[i] += own.energy[i];
    }
    force_jump_.assign(patterns, {});
    force_resultant_.assign(patterns, {});
    force_work_ = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t p = 0; p < patterns; ++p) {
        const bool strained = problem_.patterns[p].drives == Pattern::Drives::strain;
        if (!strained && problem_.patterns[p].drives != Pattern::Drives::force) continue;
        std::vector<double> boundary(index(rows_.boundary_count()), 0.0);
        force_jump_[p].assign(index(rows_.count()), 0.0);
        force_resultant_[p].assign(index(coarse_->size()), 0.0);
        std::size_t first = 0;
        for (std::size_t s = 0; s < subdomains_.size(); ++s) {
            const Subdomain& sub = subdomains_[s];
            const auto& f = force_[p][s];
            if (!f.empty()) {
                const std::vector<double> load = sub.condense_load(f);
                std::vector<double> u(load.size());
                multiply_symmetric(sub.flexibility, load, u);
                std::copy(u.begin(), u.end(), boundary.begin() + rows_.offset[s]);
                for (std::int64_t k = 0; k < sub.rigid_count && !strained; ++k)  // eigenstrains have none
                    for (std::size_t i = 0; i < f.size(); ++i)
                        force_resultant_[p][first + index(k)] += sub.rigid(static_cast<std::int64_t>(i), k) * f[i];
                for (std::size_t q = 0; q < patterns; ++q)
                    if (!force_[q][s].empty())
                        force_work_(static_cast<std::int64_t>(q), static_cast<std::int64_t>(p)) +=
                            dot(sub.condense_load(force_[q][s]), u) + sub.interior_work(force_[q][s], f);
            }
            first += index(sub.rigid_count);
            call_if_set(poll);
        }
        multiply(rows_.b, boundary, force_jump_[p]);
    }
}

void Feti::apply_flexibility(Team& team, std::span<const double> lambda, std::span<double> jumps) const {
    std::vector<double> f(index(rows_.boundary_count())), u(f.size());
    multiply(b_transposed_, lambda, f);
    const auto apply = [&](std::int64_t i) {
        const std::size_t s = index(i), first = index(rows_.offset[s]), size = subdomains_[s].boundary.size();
        multiply_symmetric(subdomains_[s].flexibility, std::span<const double>(f).subspan(first, size),
                           std::span<double>(u).subspan(first, size));
    };
    team.run(static_cast<std::int64_t>(subdomains_.size()), apply);
    multiply(rows_.b, u, jumps);
}

void Feti::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    const std::size_t rows = index(rows_.count()), jumps = index(rows_.jump_count), patterns = theta.size();
    const std::size_t first_constraint = rows - index(rows_.constraint_count);
    monitor_.progress("displacement", 0, 0);
    Team team(problem_.options.threads);

    // Rows whose jump the device prescribes have a known force s j: the system is solved without them, and that force
    // is shared out between spring and device afterwards (B_i = sum_k y_k B_k).
    const auto pulled = [&springs](std::size_t row) {
        return springs.force.empty() || springs.held[row] != 0 ? 0.0 : springs.force[row];
    };
    Springs unknown = springs;
    for (const Scaling::Prescribed& p : scaling_.prescribed_jumps) {
        unknown.stiffness[index(p.jump_row)] = 0.0;
        unknown.held[index(p.jump_row)] = 0;
    }
    std::vector<double> compliance(rows, 0.0), weight(rows);
    std::vector<std::uint8_t> active(rows, 1);
    for (std::size_t i = 0; i < jumps; ++i) {
        if (unknown.held[i] != 0) continue;
        if (pulled(i) != 0.0 && !(springs.stiffness[i] > 0.0))
            fail(DELAM_ERROR_NUMERICAL, "interface row ", i, " carries a force of its own but has no spring");
        if (unknown.stiffness[i] > 0.0)
            compliance[i] = 1.0 / unknown.stiffness[i];
        else
            active[i] = 0;
    }
    for (std::size_t i = 0; i < rows; ++i)
        weight[i] = active[i] != 0 ? 1.0 / (flexibility_diagonal_[i] + compliance[i]) : 0.0;
    coarse_->set_weights(weight);
    preconditioner_->update(unknown);

    std::vector<double> b(rows, 0.0), prescribed(index(rows_.constraint_count), 0.0), e(index(coarse_->size()), 0.0);
    for (std::size_t p = 0; p < patterns; ++p) {
        if (theta[p] == 0.0) continue;
        for (std::size_t d = 0; d < prescribed.size(); ++d) prescribed[d] += prescribed_[d * patterns + p] * theta[p];
        if (force_jump_[p].empty()) continue;
        add_scaled(theta[p], force_jump_[p], b);
        add_scaled(theta[p], force_resultant_[p], e);
    }
    for (std::size_t d = 0; d < prescribed.size(); ++d) b[first_constraint + d] -= prescribed[d];
    const auto mask = [&active](std::span<double> x) {
        for (std::size_t i = 0; i < x.size(); ++i)
            if (active[i] == 0) x[i] = 0.0;
    };
    std::vector<double> rhs = b;
    // A spring with a force of its own has the rest jump C h.
    for (std::size_t i = 0; i < jumps; ++i) rhs[i] -= compliance[i] * pulled(i);
    mask(rhs);

    double resultant = 0.0;
    for (const double v : e) resultant = std::max(resultant, std::abs(v));
    // Without a load nothing moves, exactly; a warm start would leave its rounding behind.
    const bool loaded = resultant > 0.0 || std::any_of(b.begin(), b.end(), [](double v) { return v != 0.0; }) ||
                        std::any_of(rhs.begin(), rhs.end(), [](double v) { return v != 0.0; });
    std::vector<double> lambda = loaded ? response.multipliers : std::vector<double>();
    lambda.resize(rows, 0.0);
    for (const Scaling::Prescribed& p : scaling_.prescribed_jumps)
        for (std::size_t i = 0; i < p.row.size(); ++i) lambda[index(p.row[i])] += p.y[i] * lambda[index(p.jump_row)];
    mask(lambda);
    const double left = coarse_->balance(e, lambda, resultant);
    response.balanced = resultant == 0.0 || left <= unbalanced;
    if (!response.balanced) return;

    const bool unpreconditioned = problem_.options.preconditioner == "none";
    double stiffness_scale = 0.0;
    for (const double w : weight) stiffness_scale = std::max(stiffness_scale, w);
    ProjectedSystem system;
    system.apply = [&](std::span<const double> x, std::span<double> y) {
        apply_flexibility(team, x, y);
        for (std::size_t i = 0; i < rows; ++i) y[i] = active[i] != 0 ? y[i] + compliance[i] * x[i] : 0.0;
    };
    system.precondition = [&](std::span<const double> r, std::span<double> z) {
        preconditioner_->apply(team, r, z);
        if (unpreconditioned)  // in units of a stiffness, like the others
            for (double& v : z) v *= stiffness_scale;
        mask(z);
    };
    system.balance = [&](std::span<double> x) { coarse_->balance(e, x, resultant); };
    system.project = [&](std::span<double> x) { coarse_->project(x); };
    system.project_transposed = [&](std::span<double> x) {
        coarse_->project_transposed(x);
        mask(x);
    };
    double load = 0.0;  // energy of the loads if nothing could give way: the scale of rounding
    for (std::size_t i = 0; i < rows; ++i) load += weight[i] * rhs[i] * rhs[i];
    // Eigenstrains that are free to act cancel in B u: their rounding is that of larger numbers.
    const double floor = (problem_.eigenstrains.empty() ? 1.0 : 100.0) * rounding * std::sqrt(load);
    const CgResult cg =
        projected_cg(system, rhs, lambda, problem_.options.linear_tolerance, floor, problem_.options.linear_limit,
                     [&](std::int64_t iteration) { monitor_.progress("linear solve", iteration, 0); });
    response.iterations = cg.iterations;
    response.residual = cg.residual;
    response.converged = cg.converged;

    // A lambda - b = G^T alpha, and B u = B K^+ f - F lambda + G^T alpha.
    std::vector<double> f_lambda(rows), residual(rows);
    apply_flexibility(team, lambda, f_lambda);
    for (std::size_t i = 0; i < rows; ++i)
        residual[i] = active[i] != 0 ? f_lambda[i] + compliance[i] * lambda[i] - rhs[i] : 0.0;
    response.rigid = coarse_->rigid_coefficients(residual);
    const std::vector<double> rigid_jump = coarse_->apply_transposed(response.rigid);

    response.jump.assign(jumps, 0.0);
    for (std::size_t i = 0; i < jumps; ++i) {
        // A stiff spring knows its jump best from its force, a soft one (or none) from the bodies.
        if (active[i] == 0 || compliance[i] > flexibility_diagonal_[i])
            response.jump[i] = b[i] - f_lambda[i] + rigid_jump[i];
        else
            response.jump[i] = compliance[i] * (lambda[i] + pulled(i));
    }
    for (const Scaling::Prescribed& p : scaling_.prescribed_jumps) {
        const auto row = index(p.jump_row);
        double jump = 0.0;
        for (std::size_t i = 0; i < p.row.size(); ++i)
            if (index(p.row[i]) >= first_constraint) jump += p.y[i] * prescribed[index(p.row[i]) - first_constraint];
        if (springs.held[row] == 0) lambda[row] = springs.stiffness[row] * jump - pulled(row);
        for (std::size_t i = 0; i < p.row.size(); ++i) lambda[index(p.row[i])] -= p.y[i] * lambda[row];
        response.jump[row] = springs.held[row] == 0 ? jump : 0.0;
    }
    response.force.assign(lambda.begin(), lambda.begin() + rows_.jump_count);
    double work_of_multipliers = dot(response.force, response.jump);
    for (std::size_t d = 0; d < prescribed.size(); ++d)
        work_of_multipliers += lambda[first_constraint + d] * prescribed[d];
    response.conjugate.assign(patterns, 0.0);
    response.load_potential = 0.0;
    double stretched = 0.0;  // f.u of eigenstrains less theta^T W theta
    for (std::size_t p = 0; p < patterns; ++p) {
        if (force_jump_[p].empty()) {
            for (std::size_t d = 0; d < prescribed.size(); ++d)
                response.conjugate[p] -= prescribed_[d * patterns + p] * lambda[first_constraint + d];
            continue;
        }
        double displacement = dot(force_resultant_[p], response.rigid) - dot(force_jump_[p], lambda);
        for (std::size_t q = 0; q < patterns; ++q)
            displacement += force_work_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) * theta[q];
        response.conjugate[p] = -displacement;
        if (problem_.patterns[p].drives == Pattern::Drives::force) {
            response.load_potential -= theta[p] * displacement;
            continue;
        }
        for (std::size_t q = 0; q < patterns; ++q)
            response.conjugate[p] +=
                strain_energy_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) * theta[q];
        stretched -= theta[p] * response.conjugate[p];
    }
    // 1/2 int (eps - e*) : C : (eps - e*) = 1/2 (f_dead - f_strain).u - 1/2 lambda.B u + 1/2 theta^T W theta; zero but
    // for rounding where the strains are free to follow e*.
    response.stored_bulk = 0.5 * (-response.load_potential - stretched - work_of_multipliers);
    if (!problem_.eigenstrains.empty()) response.stored_bulk = std::max(0.0, response.stored_bulk);
    response.multipliers = std::move(lambda);
}

std::vector<double> Feti::reaction(std::span<const double>, const Response& response) const {
    std::vector<double> force(response.multipliers.end() - rows_.constraint_count, response.multipliers.end());
    for (double& f : force) f = -f;
    return force;
}

std::vector<double> Feti::local_displacement(std::size_t subdomain, std::span<const double> theta,
                                             const Response& response) const {
    const Subdomain& sub = subdomains_[subdomain];
    std::vector<double> f(index(sub.dofs()), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force_[p][subdomain].empty()) add_scaled(theta[p], force_[p][subdomain], f);
    const bool loaded = std::any_of(f.begin(), f.end(), [](double v) { return v != 0.0; });
    std::vector<double> on_boundary = loaded ? sub.condense_load(f) : std::vector<double>(sub.boundary.size(), 0.0);
    for (std::size_t i = 0; i < sub.boundary.size(); ++i) {
        const std::size_t d = index(rows_.offset[subdomain]) + i;
        double pull = 0.0;
        for (std::int64_t e = b_transposed_.start[d]; e < b_transposed_.start[d + 1]; ++e)
            pull += b_transposed_.value[index(e)] * response.multipliers[index(b_transposed_.column[index(e)])];
        on_boundary[i] -= pull;
        f[index(sub.boundary[i])] -= pull;
    }
    std::vector<double> u_boundary(sub.boundary.size());
    multiply_symmetric(sub.flexibility, on_boundary, u_boundary);
    std::size_t first = 0;
    for (std::size_t s = 0; s < subdomain; ++s) first += index(subdomains_[s].rigid_count);
    for (std::int64_t k = 0; k < sub.rigid_count; ++k)
        for (std::size_t i = 0; i < u_boundary.size(); ++i)
            u_boundary[i] += sub.rigid_boundary(static_cast<std::int64_t>(i), k) * response.rigid[first + index(k)];
    return sub.extend(u_boundary, f);
}

std::vector<double> Feti::displacement(std::span<const double> theta, const Response& response) const {
    const int dim = problem_.mesh->dimension();
    std::vector<double> u(index(problem_.mesh->node_count() * dim), 0.0);
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
        poll_cancel("recover", subdomains_[s].dofs() / 16);
        const std::vector<double> local = local_displacement(s, theta, response);
        for (std::size_t i = 0; i < subdomains_[s].nodes.size(); ++i) {
            const std::size_t node = index(subdomains_[s].nodes[i]);
            for (int k = 0; k < dim; ++k)  // copies agree up to the tolerance of the solve: their mean
                u[node * index(dim) + index(k)] +=
                    local[i * index(dim) + index(k)] / static_cast<double>(copies_[node].size());
        }
    }
    for (const NodeTie& tie : problem_.mesh->ties())
        for (const auto& [node, weight] : tie.of)
            for (int k = 0; k < dim; ++k) u[index(tie.node * dim + k)] += weight * u[index(node * dim + k)];
    ++recoveries_;
    return u;
}

double Feti::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    const int dim = problem_.mesh->dimension();
    const std::vector<double> u = displacement(theta, response);
    std::vector<double> defect(u.size(), 0.0);
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
        const Subdomain& sub = subdomains_[s];
        const auto global = [&](std::int64_t local) {
            return index(sub.nodes[index(local / dim)] * dim + local % dim);
        };
        std::vector<double> mine(index(sub.dofs())), force(mine.size());
        for (std::size_t i = 0; i < mine.size(); ++i) mine[i] = u[global(static_cast<std::int64_t>(i))];
        multiply(sub.stiffness, mine, force);
        for (std::size_t p = 0; p < theta.size(); ++p)
            if (!force_[p][s].empty()) add_scaled(-theta[p], force_[p][s], force);
        for (std::size_t i = 0; i < force.size(); ++i) defect[global(static_cast<std::int64_t>(i))] += force[i];
        for (std::size_t i = 0; i < sub.boundary.size(); ++i) {
            const std::size_t d = index(rows_.offset[s]) + i;
            for (std::int64_t e = b_transposed_.start[d]; e < b_transposed_.start[d + 1]; ++e) {
                const std::int64_t row = b_transposed_.column[index(e)];
                if (row >= rows_.jump_count && row < rows_.jump_count + rows_.glue_count) continue;  // inner forces
                defect[global(sub.boundary[i])] += b_transposed_.value[index(e)] * response.multipliers[index(row)];
            }
        }
    }
    double worst = 0.0;
    for (const double v : defect) worst = std::max(worst, std::abs(v));
    return worst;
}

std::string Feti::description() const {
    std::int64_t largest = 0;
    double bytes = 0.0;
    for (const Subdomain& s : subdomains_) {
        const auto n = static_cast<std::int64_t>(s.boundary.size());
        largest = std::max(largest, n);
        bytes += 8.0 * static_cast<double>(n) * static_cast<double>(n) * (s.schur.rows > 0 ? 2.0 : 1.0);
    }
    const bool controls = subdomains_.back().body < 0;
    return text("total FETI: ", subdomains_.size() - (controls ? 1 : 0), " subdomains",
                controls ? " and control nodes, " : ", ", rows_.jump_count, " jump + ", rows_.glue_count, " gluing + ",
                rows_.constraint_count, " constraint multipliers, coarse problem ", coarse_->size(),
                ", preconditioner ", problem_.options.preconditioner, ", largest boundary ", largest,
                " DOFs, dense blocks ", bytes / 1048576.0, " MiB");
}

}  // namespace delam
