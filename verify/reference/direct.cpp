// SPDX-License-Identifier: BSD-3-Clause
#include "direct.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "factor.hpp"

namespace reference {
namespace {

// active-set steps that may exchange many pairs; then one pair at a time (Murty)
constexpr int simultaneous_limit = 50;
constexpr int exchange_limit = 5000;
// Smaller violations, relative to the largest jump or traction, are rounding.
constexpr double contact_tolerance = 1e-12;

template <class Vector>
long double value_of(const Affine& row, const Vector& x) {
    long double sum = row.constant;
    for (const auto& [i, c] : row.terms) sum += static_cast<long double>(c) * x[static_cast<std::size_t>(i)];
    return sum;
}

void scatter(const Affine& row, long double value, std::vector<long double>& target) {
    for (const auto& [i, c] : row.terms) target[static_cast<std::size_t>(i)] += static_cast<long double>(c) * value;
}

// K u in extended precision.
std::vector<long double> multiply(const Csr& k, const std::vector<long double>& u) {
    std::vector<long double> result(k.rows(), 0.0L);
    for (std::size_t i = 0; i < k.rows(); ++i) {
        for (auto e = k.start[i]; e < k.start[i + 1]; ++e) {
            const auto s = static_cast<std::size_t>(e);
            result[i] += static_cast<long double>(k.value[s]) * u[static_cast<std::size_t>(k.column[s])];
        }
    }
    return result;
}

}  // namespace

// Rows with a multiplier, over mesh DOFs, and the place to which each multiplier is written.
struct DirectReference::System {
    std::vector<std::vector<std::pair<std::int64_t, double>>> rows;
    std::vector<std::int64_t> constraint;  // index, or -1
    std::vector<std::int64_t> component;   // pair*dim + c, or -1
};

DirectReference::DirectReference(const Scene& scene) : scene_(&scene), exported_(scene) {
    const auto d = static_cast<std::size_t>(exported_.dimension);
    for (std::size_t i = 0; i < exported_.interfaces.size(); ++i) {
        const Pairs& p = exported_.interfaces[i];
        for (std::size_t k = 0; k < p.count(); ++k) {
            pairs_.push_back({i, p.node_a[k], p.node_b[k], p.weight[k], p.frame.data() + k * d * d});
        }
    }
    closed_.assign(pairs_.size(), false);
    choose_unknowns();
}

std::vector<std::pair<std::int64_t, double>> DirectReference::jump_dofs(std::size_t pair, int component) const {
    const int d = exported_.dimension;
    const Pair& p = pairs_[pair];
    std::vector<std::pair<std::int64_t, double>> terms;
    for (int k = 0; k < d; ++k) {
        const double f = p.frame[component * d + k];
        if (f == 0.0) continue;
        terms.emplace_back(d * p.node_b + k, f);
        terms.emplace_back(d * p.node_a + k, -f);
    }
    return terms;
}

Affine DirectReference::combination(const std::vector<std::pair<std::int64_t, double>>& dof_terms) const {
    std::map<std::int64_t, double> sum;
    for (const auto& [dof, factor] : dof_terms) {
        for (const auto& [i, c] : displacement_[static_cast<std::size_t>(dof)].terms) sum[i] += factor * c;
    }
    Affine row;
    for (const auto& term : sum) {
        if (std::abs(term.second) > contact_tolerance) row.terms.push_back(term);
    }
    return row;
}

// Nodes tied together by pairs form a graph. Its spanning trees give the unknowns: the displacement of the root, and
// the local jump of each tree pair. The jump of a pair that closes a cycle (blocks that meet at a cross point) follows
// from the others.
void DirectReference::choose_unknowns() {
    const int d = exported_.dimension;
    const std::size_t n = exported_.dofs;
    displacement_.assign(n, {});
    jump_.assign(pairs_.size() * static_cast<std::size_t>(d), {});
    is_jump_.clear();
    std::vector<std::vector<std::size_t>> pairs_at(n / static_cast<std::size_t>(d));
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        pairs_at[static_cast<std::size_t>(pairs_[p].node_a)].push_back(p);
        pairs_at[static_cast<std::size_t>(pairs_[p].node_b)].push_back(p);
    }
    std::vector<bool> reached(pairs_at.size(), false);
    std::vector<bool> in_tree(pairs_.size(), false);
    const auto dof = [d](std::int64_t node, int k) { return static_cast<std::size_t>(d * node + k); };
    for (std::size_t root = 0; root < pairs_at.size(); ++root) {
        if (reached[root]) continue;
        reached[root] = true;
        for (int k = 0; k < d; ++k) {
            displacement_[dof(static_cast<std::int64_t>(root), k)].terms = {
                {static_cast<std::int64_t>(is_jump_.size()), 1.0}};
            is_jump_.push_back(false);
        }
        std::vector<std::int64_t> front{static_cast<std::int64_t>(root)};
        while (!front.empty()) {
            const std::int64_t node = front.back();
            front.pop_back();
            for (const std::size_t p : pairs_at[static_cast<std::size_t>(node)]) {
                const bool forward = pairs_[p].node_a == node;
                const std::int64_t other = forward ? pairs_[p].node_b : pairs_[p].node_a;
                if (reached[static_cast<std::size_t>(other)]) continue;
                reached[static_cast<std::size_t>(other)] = true;
                in_tree[p] = true;
                front.push_back(other);
                const auto first = static_cast<std::int64_t>(is_jump_.size());
                for (int k = 0; k < d; ++k) {
                    Affine& u = displacement_[dof(other, k)];
                    u = displacement_[dof(node, k)];
                    for (int c = 0; c < d; ++c) {
                        const double f = pairs_[p].frame[c * d + k];
                        if (f != 0.0) u.terms.emplace_back(first + c, forward ? f : -f);
                    }
                }
                for (int c = 0; c < d; ++c) {
                    jump_[p * static_cast<std::size_t>(d) + static_cast<std::size_t>(c)].terms = {{first + c, 1.0}};
                    is_jump_.push_back(true);
                }
            }
        }
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        for (int c = 0; c < d && !in_tree[p]; ++c) {
            jump_[p * static_cast<std::size_t>(d) + static_cast<std::size_t>(c)] = combination(jump_dofs(p, c));
        }
    }
}

double DirectReference::spring(std::size_t pair, int component, const std::vector<double>& adhesion) const {
    const InterfaceStiffness& s = scene_->stiffness()[pairs_[pair].interface_index];
    return s.bonded ? 0.0 : adhesion[pair] * s.of(component);
}

State DirectReference::solve_linear(const std::vector<double>& values, const std::vector<double>& force,
                                    const std::vector<double>& adhesion) const {
    const int d = exported_.dimension;
    const auto width = static_cast<std::size_t>(d);
    System system;
    Elimination elimination(is_jump_);
    const auto keep = [&](std::vector<std::pair<std::int64_t, double>> row, std::int64_t constraint,
                          std::int64_t component) {
        system.rows.push_back(std::move(row));
        system.constraint.push_back(constraint);
        system.component.push_back(component);
    };
    using Outcome = Elimination::Outcome;
    for (std::size_t i = 0; i < exported_.dofs; ++i) {
        if (!exported_.alive[i]) elimination.add(displacement_[i], 0.0);
    }
    for (const Exported::Tie& tie : exported_.ties) {
        for (int k = 0; k < d; ++k) {
            std::vector<std::pair<std::int64_t, double>> row{{d * tie.node + k, 1.0}};
            for (const auto& [node, weight] : tie.of) row.emplace_back(d * node + k, -weight);
            if (elimination.add(combination(row), 0.0) == Outcome::added) keep(std::move(row), -1, -1);
        }
    }
    for (std::size_t c = 0; c < exported_.constraints.rows(); ++c) {
        std::vector<std::pair<std::int64_t, double>> row;
        for (auto e = exported_.constraints.start[c]; e < exported_.constraints.start[c + 1]; ++e) {
            row.emplace_back(exported_.constraints.column[static_cast<std::size_t>(e)],
                             exported_.constraints.value[static_cast<std::size_t>(e)]);
        }
        const Outcome outcome = elimination.add(combination(row), values[c]);
        if (outcome == Outcome::contradictory) throw Failure(0, "direct reference: constraints contradict each other");
        if (outcome == Outcome::added) keep(std::move(row), static_cast<std::int64_t>(c), -1);
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const bool bonded = scene_->stiffness()[pairs_[p].interface_index].bonded;
        const int components = bonded ? d : (closed_[p] ? 1 : 0);
        for (int c = 0; c < components; ++c) {
            const std::size_t at = p * width + static_cast<std::size_t>(c);
            const Outcome outcome = elimination.add(jump_[at], 0.0);
            if (outcome == Outcome::contradictory && bonded) throw Failure(0, "direct reference: supports tear a bond");
            if (outcome == Outcome::added) keep(jump_dofs(p, c), -1, static_cast<std::int64_t>(at));
        }
    }
    elimination.close();

    std::vector<Affine> u_of(exported_.dofs);
    for (std::size_t i = 0; i < u_of.size(); ++i) u_of[i] = elimination.expand(displacement_[i]);
    std::vector<Affine> j_of(jump_.size());
    for (std::size_t i = 0; i < j_of.size(); ++i) j_of[i] = elimination.expand(jump_[i]);
    std::vector<double> stiffness(jump_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        for (int c = 0; c < d; ++c) {
            stiffness[p * width + static_cast<std::size_t>(c)] = pairs_[p].weight * spring(p, c, adhesion);
        }
    }

    Triplets lower;
    const auto couple = [&](const Affine& a, const Affine& b, double factor) {
        for (const auto& [i, x] : a.terms) {
            for (const auto& [j, y] : b.terms) lower.add(i, j, x * y * factor);
        }
    };
    for (std::size_t i = 0; i < exported_.dofs; ++i) {
        for (auto e = exported_.stiffness.start[i]; e < exported_.stiffness.start[i + 1]; ++e) {
            const auto s = static_cast<std::size_t>(e);
            couple(u_of[i], u_of[static_cast<std::size_t>(exported_.stiffness.column[s])],
                   exported_.stiffness.value[s]);
        }
    }
    for (std::size_t i = 0; i < j_of.size(); ++i) {
        if (stiffness[i] > 0.0) couple(j_of[i], j_of[i], stiffness[i]);
    }
    if (on_matrix) on_matrix(elimination.free_count(), lower);
    const Factor factor(elimination.free_count(), lower);

    const auto displacements = [&](const std::vector<long double>& x) {
        std::vector<long double> u(u_of.size());
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = value_of(u_of[i], x);
        return u;
    };
    const auto x = factor.refine([&](const std::vector<long double>& at) {
        std::vector<long double> r(at.size(), 0.0L);
        const auto ku = multiply(exported_.stiffness, displacements(at));
        for (std::size_t i = 0; i < u_of.size(); ++i) scatter(u_of[i], static_cast<long double>(force[i]) - ku[i], r);
        for (std::size_t i = 0; i < j_of.size(); ++i) {
            if (stiffness[i] > 0.0)
                scatter(j_of[i], -static_cast<long double>(stiffness[i]) * value_of(j_of[i], at), r);
        }
        return r;
    });

    State state;
    const auto u = displacements(x);
    auto unbalance = multiply(exported_.stiffness, u);
    long double bulk = 0.0L;
    for (std::size_t i = 0; i < u.size(); ++i) {
        bulk += 0.5L * u[i] * unbalance[i];
        unbalance[i] -= static_cast<long double>(force[i]);
    }
    for (std::size_t p = 0; p < exported_.patterns; ++p) {
        if (!exported_.strains(p)) continue;
        for (std::size_t i = 0; i < u.size(); ++i)
            bulk -= static_cast<long double>(factor_[p]) * exported_.forces[p][i] * u[i];
        for (std::size_t q = 0; q < exported_.patterns; ++q)
            bulk += 0.5L * factor_[p] * exported_.strain_energy[p * exported_.patterns + q] * factor_[q];
    }
    state.displacement.assign(u.begin(), u.end());
    state.jump.resize(j_of.size());
    state.traction.resize(j_of.size());
    long double interface_energy = 0.0L;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        for (int c = 0; c < d; ++c) {
            const std::size_t at = p * width + static_cast<std::size_t>(c);
            const long double jump = value_of(j_of[at], x);
            const long double pull = static_cast<long double>(stiffness[at]) * jump;
            interface_energy += 0.5L * pull * jump;
            state.jump[at] = static_cast<double>(jump);
            state.traction[at] = static_cast<double>(pull / static_cast<long double>(pairs_[p].weight));
            for (const auto& [dof, f] : jump_dofs(p, c))
                unbalance[static_cast<std::size_t>(dof)] += pull * static_cast<long double>(f);
        }
    }
    state.stored_bulk = static_cast<double>(bulk);
    state.stored_interface = static_cast<double>(interface_energy);
    recover_multipliers(system, unbalance, state);
    return state;
}

// Supports and closed pairs carry the forces that bodies, springs and loads leave unbalanced: M^T y = unbalance, solved
// by least squares (it has an exact solution). The multiplier y of a contact or bond pushes the faces apart, so the
// traction is -y / weight.
void DirectReference::recover_multipliers(const System& system, const std::vector<long double>& unbalance,
                                          State& state) const {
    std::vector<std::vector<std::pair<std::size_t, double>>> columns(exported_.dofs);
    for (std::size_t r = 0; r < system.rows.size(); ++r) {
        for (const auto& [dof, value] : system.rows[r]) columns[static_cast<std::size_t>(dof)].emplace_back(r, value);
    }
    Triplets lower;
    for (const auto& column : columns) {
        for (const auto& [i, a] : column) {
            for (const auto& [j, b] : column)
                lower.add(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), a * b);
        }
    }
    const Factor factor(system.rows.size(), lower);
    const auto y = factor.refine([&](const std::vector<long double>& at) {
        auto rest = unbalance;
        for (std::size_t r = 0; r < at.size(); ++r) {
            for (const auto& [dof, value] : system.rows[r]) {
                rest[static_cast<std::size_t>(dof)] -= static_cast<long double>(value) * at[r];
            }
        }
        std::vector<long double> projected(at.size(), 0.0L);
        for (std::size_t r = 0; r < at.size(); ++r) {
            for (const auto& [dof, value] : system.rows[r]) {
                projected[r] += static_cast<long double>(value) * rest[static_cast<std::size_t>(dof)];
            }
        }
        return projected;
    });
    const auto width = static_cast<std::size_t>(exported_.dimension);
    state.reaction.assign(exported_.constraints.rows(), 0.0);
    for (std::size_t r = 0; r < y.size(); ++r) {
        if (system.constraint[r] >= 0)
            state.reaction[static_cast<std::size_t>(system.constraint[r])] = static_cast<double>(y[r]);
        if (system.component[r] >= 0) {
            const auto at = static_cast<std::size_t>(system.component[r]);
            state.traction[at] = static_cast<double>(-y[r] / static_cast<long double>(pairs_[at / width].weight));
        }
    }
    state.pattern.assign(exported_.patterns, 0.0);
    for (std::size_t p = 0; p < exported_.patterns; ++p) {
        long double conjugate = 0.0L;
        for (std::size_t c = 0; c < state.reaction.size(); ++c) {
            conjugate += static_cast<long double>(state.reaction[c]) * exported_.prescribed[c * exported_.patterns + p];
        }
        for (std::size_t i = 0; i < exported_.dofs; ++i) {
            conjugate -= static_cast<long double>(exported_.forces[p][i]) * state.displacement[i];
        }
        for (std::size_t q = 0; q < exported_.patterns; ++q)
            conjugate += static_cast<long double>(exported_.strain_energy[p * exported_.patterns + q]) * factor_[q];
        state.pattern[p] = static_cast<double>(conjugate);
    }
}

bool DirectReference::update_contact(const State& state, const std::vector<double>& adhesion, bool one_at_a_time) {
    const auto width = static_cast<std::size_t>(exported_.dimension);
    double jump_size = 0.0;
    double traction_size = 0.0;
    for (const double j : state.jump) jump_size = std::max(jump_size, std::abs(j));
    for (const double t : state.traction) traction_size = std::max(traction_size, std::abs(t));
    bool changed = false;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        if (scene_->stiffness()[pairs_[p].interface_index].bonded) continue;
        const double gap = state.jump[p * width];
        const double pull = state.traction[p * width];
        const bool penetrates =
            gap < -contact_tolerance * jump_size || spring(p, 0, adhesion) * gap < -contact_tolerance * traction_size;
        const bool exchange = closed_[p] ? pull > contact_tolerance * traction_size : penetrates;
        if (!exchange) continue;
        closed_[p] = !closed_[p];
        changed = true;
        if (one_at_a_time) return true;
    }
    return changed;
}

State DirectReference::solve(double time, const std::vector<double>& adhesion) {
    if (adhesion.size() != pairs_.size()) throw Failure(0, "direct reference: adhesion has a wrong length");
    // A ply without adhesion may rest on nothing but its contacts, so these are the first guess.
    for (std::size_t p = 0; first_ && p < pairs_.size(); ++p) {
        closed_[p] = adhesion[p] == 0.0 && !scene_->stiffness()[pairs_[p].interface_index].bonded;
    }
    first_ = false;
    std::vector<double> values;
    std::vector<double> force;
    exported_.load(*scene_, time, values, force);
    factor_ = exported_.factors(*scene_, time);
    for (int iteration = 1; iteration <= simultaneous_limit + exchange_limit; ++iteration) {
        State state = solve_linear(values, force, adhesion);
        if (!update_contact(state, adhesion, iteration > simultaneous_limit)) {
            const auto width = static_cast<std::size_t>(exported_.dimension);
            double jump_size = 0.0;
            for (const double j : state.jump) jump_size = std::max(jump_size, std::abs(j));
            // Where supports alone determine the gap, closing a pair has no effect.
            state.contact = closed_;
            for (std::size_t p = 0; p < pairs_.size(); ++p) {
                if (!closed_[p]) continue;
                const double gap = state.jump[p * width];
                if (gap < -contact_tolerance * jump_size)
                    throw Failure(0, "direct reference: supports press faces together");
                if (gap > contact_tolerance * jump_size) state.contact[p] = false;
            }
            state.contact_iterations = iteration;
            return state;
        }
    }
    throw Failure(DELAM_NOT_CONVERGED, "direct reference: the contact set was not found");
}

}  // namespace reference
