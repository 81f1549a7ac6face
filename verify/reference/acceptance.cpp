// SPDX-License-Identifier: BSD-3-Clause
#include "acceptance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace reference {
namespace {

// A violation of exactly zero is accepted even if its scale is zero.
double relative(double violation, double scale) {
    if (!(violation > 0.0)) return std::isnan(violation) ? std::numeric_limits<double>::infinity() : 0.0;
    return scale > 0.0 ? violation / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

double Acceptance::worst() const {
    return std::max(
        {gap, gap_displacement, jump_mismatch, pressure, complementarity, equilibrium, supports, law, adhesion});
}

std::string Acceptance::text() const {
    char line[400];
    std::snprintf(line, sizeof line,
                  "gap %.1e, gap of displacements %.1e, jump mismatch %.1e, pressure sign %.1e, complementarity %.1e, "
                  "equilibrium %.1e, supports %.1e, law %.1e, adhesion %.1e",
                  gap, gap_displacement, jump_mismatch, pressure, complementarity, equilibrium, supports, law,
                  adhesion);
    return line;
}

Acceptance accept(const Solver& solver, const Exported& exported) {
    Fields fields{solver.value("time"),
                  solver.field("displacement"),
                  solver.field("jump"),
                  solver.field("traction"),
                  solver.field("adhesion"),
                  solver.field("reaction"),
                  {}};
    for (const double flag : solver.field("contact")) fields.contact.push_back(flag != 0.0);
    return accept(solver.scene(), fields, exported);
}

Acceptance accept(const Scene& scene, const Fields& fields, const Exported& exported, const Least& least) {
    const auto d = static_cast<std::size_t>(exported.dimension);
    const auto& [time, u, jump, traction, adhesion, reaction, contact] = fields;
    std::vector<double> prescribed;
    std::vector<double> force;
    exported.load(scene, time, prescribed, force);

    Acceptance result;
    const double u_size = largest(u);
    const double jump_size = std::max(largest(jump), least.jump);
    const double traction_size = std::max(largest(traction), least.traction);
    const double between_size = std::max(jump_size, least.between_displacements);
    // u_b - u_a of stiff interfaces suffers cancellation: the tolerance is at least some ulps of u.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * u_size;

    // The out-of-balance force, summed in extended precision so that the check adds no rounding of its own.
    std::vector<long double> unbalance(exported.dofs);
    std::vector<double> size(exported.dofs);  // of the summands
    for (std::size_t i = 0; i < exported.dofs; ++i) {
        unbalance[i] = -static_cast<long double>(force[i]);
        for (auto e = exported.stiffness.start[i]; e < exported.stiffness.start[i + 1]; ++e) {
            const auto s = static_cast<std::size_t>(e);
            unbalance[i] += static_cast<long double>(exported.stiffness.value[s]) *
                            static_cast<long double>(u[static_cast<std::size_t>(exported.stiffness.column[s])]);
            size[i] +=
                std::abs(exported.stiffness.value[s] * u[static_cast<std::size_t>(exported.stiffness.column[s])]);
        }
    }
    for (std::size_t c = 0; c < exported.constraints.rows(); ++c) {
        long double value = 0.0L;
        for (auto e = exported.constraints.start[c]; e < exported.constraints.start[c + 1]; ++e) {
            const auto s = static_cast<std::size_t>(e);
            const auto dof = static_cast<std::size_t>(exported.constraints.column[s]);
            value += static_cast<long double>(exported.constraints.value[s]) * static_cast<long double>(u[dof]);
            unbalance[dof] -=
                static_cast<long double>(exported.constraints.value[s]) * static_cast<long double>(reaction[c]);
        }
        const double miss = std::abs(static_cast<double>(value - static_cast<long double>(prescribed[c])));
        result.supports = std::max(result.supports, relative(miss, u_size));
    }

    double largest_force = 0.0;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < exported.interfaces.size(); ++i) {
        const Pairs& pairs = exported.interfaces[i];
        const InterfaceStiffness& stiffness = scene.stiffness()[i];
        for (std::size_t k = 0; k < pairs.count(); ++k, ++pair) {
            const bool closed = contact[pair];
            const double zeta = adhesion[pair];
            result.adhesion = std::max({result.adhesion, -zeta, zeta - 1.0});
            for (std::size_t c = 0; c < d; ++c) {
                const double* axis = pairs.frame.data() + (k * d + c) * d;
                const std::size_t at = pair * d + c;
                long double from_displacement = 0.0L;
                const long double nodal =
                    static_cast<long double>(pairs.weight[k]) * static_cast<long double>(traction[at]);
                largest_force = std::max(largest_force, std::abs(static_cast<double>(nodal)));
                for (std::size_t x = 0; x < d; ++x) {
                    const auto a = static_cast<std::size_t>(pairs.node_a[k]) * d + x;
                    const auto b = static_cast<std::size_t>(pairs.node_b[k]) * d + x;
                    const auto f = static_cast<long double>(axis[x]);
                    from_displacement += f * (static_cast<long double>(u[b]) - static_cast<long double>(u[a]));
                    unbalance[a] -= f * nodal;
                    unbalance[b] += f * nodal;
                }
                const auto opening = static_cast<double>(from_displacement);
                const double mismatch = std::abs(opening - jump[at]) - rounding;
                result.jump_mismatch = std::max(result.jump_mismatch, relative(mismatch, between_size));
                if (!stiffness.bonded && c == 0) {
                    result.gap = std::max(result.gap, relative(-jump[at], jump_size));
                    result.gap_displacement =
                        std::max(result.gap_displacement, relative(-opening - rounding, between_size));
                }
                if (stiffness.bonded || (closed && c == 0)) continue;
                const double spring = zeta * stiffness.of(static_cast<int>(c));
                result.law = std::max(result.law, relative(std::abs(traction[at] - spring * jump[at]), traction_size));
            }
            if (stiffness.bonded || !closed) continue;
            result.pressure = std::max(result.pressure, relative(traction[pair * d], traction_size));
            const double product = std::abs(jump[pair * d] * traction[pair * d]);
            result.complementarity = std::max(result.complementarity, relative(product, jump_size * traction_size));
        }
    }

    // Forces on a tied node act on the nodes to which it is tied.
    for (const Exported::Tie& tie : exported.ties)
        for (std::size_t k = 0; k < d; ++k) {
            long double& own = unbalance[static_cast<std::size_t>(tie.node) * d + k];
            for (const auto& [node, weight] : tie.of) {
                unbalance[static_cast<std::size_t>(node) * d + k] += static_cast<long double>(weight) * own;
                size[static_cast<std::size_t>(node) * d + k] +=
                    std::abs(weight) * size[static_cast<std::size_t>(tie.node) * d + k];
            }
            own = 0.0L;
        }

    double worst = 0.0, beyond_rounding = 0.0;
    for (std::size_t i = 0; i < unbalance.size(); ++i) {
        const double rest = std::abs(static_cast<double>(unbalance[i]));
        worst = std::isnan(rest) ? rest : std::max(worst, rest);
        beyond_rounding =
            std::max(beyond_rounding, rest - least.ulps * std::numeric_limits<double>::epsilon() * size[i]);
    }
    const double own = largest(reaction) > 0.0 ? largest(reaction) : std::max(largest_force, largest(force));
    const double scale = std::max(own, least.force);
    result.equilibrium = relative(worst, scale);
    result.balance = std::isnan(worst) ? result.equilibrium : relative(beyond_rounding, scale);
    return result;
}

}  // namespace reference
