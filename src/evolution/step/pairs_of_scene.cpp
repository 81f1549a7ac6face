// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/pairs_of_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/numbers.hpp"
#include "evolution/contact/contact_levels.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

std::vector<std::shared_ptr<const GradientTerm>> gradient_terms(const Problem& problem) {
    std::vector<std::shared_ptr<const GradientTerm>> terms;
    std::size_t first = 0;
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceGeometry& face = problem.mesh->interfaces()[i];
        const InterfaceProperties& properties = problem.interfaces[i];
        if (properties.law && properties.law->gradient > 0.0)
            terms.push_back(std::make_shared<const GradientTerm>(
                properties.law->gradient, surface_stiffness(*problem.mesh, face, properties.adhesion), face.weight,
                first));
        first += face.weight.size();
    }
    return terms;
}

PairLaws pair_laws(const Problem& problem) {
    PairLaws pairs;
    pairs.dimension = problem.mesh->dimension();
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& own = problem.interfaces[i];
        std::optional<Toughness> fixed;
        const Law* law = own.law ? &*own.law : nullptr;  // none: bonded permanently, or contact alone
        if (law != nullptr && problem.options.mixity == "auto" && !law->depends_on_mixity())
            fixed = law->toughness(0.0);
        for (const double weight : problem.mesh->interfaces()[i].weight) {
            pairs.weight.push_back(weight);
            pairs.law.push_back(law);
            pairs.fixed.push_back(fixed);
        }
    }
    pairs.gradient = gradient_terms(problem);
    return pairs;
}

ContactScene contact_scene(const Problem& problem, const FreeParts& parts) {
    ContactScene contact;
    contact.dimension = problem.mesh->dimension();
    contact.bodies = index(problem.mesh->body_count());
    if (parts.any()) contact.parts = &parts;
    contact.limit = problem.options.contact_limit;
    contact.always = problem.options.contact == "always";
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i)
        contact.bonded.insert(contact.bonded.end(), problem.mesh->interfaces()[i].weight.size(),
                              problem.interfaces[i].bonded ? 1 : 0);
    contact.level = contact_levels(problem.mesh->interfaces());
    contact.prescribed_most.assign(problem.patterns.size(), 0.0);
    for (const Constraint& constraint : problem.constraints) {
        const double unit = max_abs(constraint.coefficient);
        for (std::size_t p = 0; p < constraint.prescribed.size(); ++p)
            contact.prescribed_most[p] =
                std::max(contact.prescribed_most[p], std::abs(constraint.prescribed[p]) / unit);
    }
    for (const GapRow& gap : problem.gap_rows()) {
        double& most = contact.prescribed_most[index(gap.pattern)];
        most = std::max(most, std::abs(gap.value));
    }
    if (!problem.eigenstrains.empty()) {
        StrainSizes sizes = strain_sizes(problem);
        contact.strain_jump = std::move(sizes.displacement);
        contact.strain_force = std::move(sizes.force);
    }
    if (problem.renewed && parts.any()) contact.place_size = problem.mesh->size();
    return contact;
}

double carried_force(const Problem& problem, const JumpOperator& op, const ContactScene& contact,
                     std::span<const double> theta, const Response& response) {
    double size = 0.0;
    for (const GapRow& gap : problem.gap_rows())
        if (theta[index(gap.pattern)] != 0.0) size = std::max(size, std::abs(response.force[index(gap.row)]));
    if (contact.parts == nullptr) return size;
    for (const NodalForce& dead : problem.forces)
        size = std::max(size, std::abs(dead.value * theta[index(dead.pattern)]));
    const auto dim = index(contact.dimension);
    const std::vector<double> u = op.displacement(theta, response);
    std::size_t pair = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_b.size(); ++p, ++pair)
            for (const std::int64_t node : {face.node_a[p], face.node_b[p]}) {
                const double moved = max_abs(std::span<const double>(u).subspan(index(node) * dim, dim));
                size = std::max(
                    size, moved * max_abs(std::span<const double>(contact.row_stiffness).subspan(pair * dim, dim)));
            }
    return size;
}

std::vector<std::int64_t> free_since(const JumpOperator& op, const ContactScene& contact, const PairLaws& pairs,
                                     const State& next, const State& before) {
    std::vector<std::int64_t> since(contact.bodies, -1);
    const DenseMatrix free =
        free_motions(op, contact, spring_stiffness(pairs, next.adhesion), next.theta, next.closed, next.response);
    if (free.columns == 0) return since;
    const std::vector<std::uint8_t> moves = contact.parts->moves(free);
    const std::size_t modes = moves.size() / since.size();
    for (std::size_t b = 0; b < since.size(); ++b) {
        const auto own = std::span<const std::uint8_t>(moves).subspan(b * modes, modes);
        if (std::all_of(own.begin(), own.end(), [](std::uint8_t m) { return m == 0; })) continue;
        const bool was = b < before.free_since.size() && before.free_since[b] >= 0;
        since[b] = was ? before.free_since[b] : next.step;
    }
    return since;
}

}  // namespace delam
