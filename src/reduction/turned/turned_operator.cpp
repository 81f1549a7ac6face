// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/turned_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/body_reactions.hpp"
#include "reduction/operator/jump_variables.hpp"

namespace delam {

namespace {

std::vector<BodyModel> models_of(const Problem& problem) {
    std::vector<BodyModel> models;
    for (std::int32_t body = 0; body < problem.mesh->body_count(); ++body) models.push_back(problem.model(body));
    return models;
}

}  // namespace

TurnedOperator::TurnedOperator(const Problem& problem, const Poll& poll)
    : problem_(problem),
      bodies_(std::make_unique<BodySystem>(problem, poll, BodySystem::Stiffness::elsewhere)),
      carriers_(problem),
      jumps_(problem, carriers_),
      prescribed_(delam::prescribed_rows(bodies_->variables())),
      no_row_force_(index(problem.jump_count()), 0.0),
      turned_(std::make_unique<TurnedBodies>(*problem.mesh, models_of(problem))) {
    bodies_->find_loads();
    call_if_set(poll);
}

TurnedBodies& TurnedOperator::at(std::span<const double> displacement) const {
    if (!std::equal(at_.begin(), at_.end(), displacement.begin(), displacement.end())) {
        at_.clear();
        turned_->move(displacement);
        at_.assign(displacement.begin(), displacement.end());
    }
    return *turned_;
}

Problem TurnedOperator::linearised(std::span<const double> displacement, std::span<const double> row_force,
                                   TurnedCell::Stresses stresses) const {
    const TurnedBodies& bodies = at(displacement);
    const auto dim = index(problem_.mesh->dimension());
    Problem about = problem_;
    about.options.kinematics = "linear";
    auto mesh = std::make_shared<Mesh>(*problem_.mesh);
    for (std::size_t i = 0; i < problem_.interfaces.size(); ++i) turn_frames(*mesh, i, jumps_.frames(bodies, i));
    std::vector<double> force = bodies.force();
    jumps_.add_couples(bodies, displacement, row_force, force);
    for (double& f : force) f = -f;
    for (std::int32_t body = 0; body < mesh->body_count(); ++body) {
        HostStiffness given;
        given.matrix = bodies.tangent(body, stresses);
        const std::vector<std::int64_t> nodes = mesh->body_nodes(body);
        std::vector<double> u(index(given.matrix.rows)), f(u.size());
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = displacement[index(nodes[i / dim]) * dim + i % dim];
        multiply(given.matrix, u, f);
        for (std::size_t i = 0; i < u.size(); ++i) force[index(nodes[i / dim]) * dim + i % dim] += f[i];
        // Stresses resist rotations, so that no rigid motion is free of energy.
        given.pieces.push_back({nodes, DenseMatrix(given.matrix.rows, 0), {}});
        about.stiffness[index(body)] = std::make_shared<const HostStiffness>(std::move(given));
    }
    about.mesh = std::move(mesh);
    about.patterns.push_back({"linearisation", {0.0}, {1.0}, Pattern::Drives::force});
    const auto pattern = static_cast<std::int64_t>(problem_.patterns.size());
    for (std::size_t i = 0; i < force.size(); ++i)
        if (force[i] != 0.0) about.forces.push_back({pattern, static_cast<std::int64_t>(i), force[i]});
    return about;
}

void TurnedOperator::complete(std::span<const double> theta, std::vector<double> displacement,
                              Response& response) const {
    const TurnedBodies& bodies = at(displacement);
    response.jump = jumps_.jumps(bodies, theta, displacement);
    response.stored_bulk = bodies.energy();
    response.load_potential = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (const std::vector<double>& force = bodies_->force()[p]; !force.empty())
            response.load_potential -= theta[p] * dot(force, displacement);
    response.multipliers = std::move(displacement);
    response.rigid.clear();
    response.support = {};
}

std::vector<double> TurnedOperator::internal_force(const Response& response) const {
    const TurnedBodies& bodies = at(response.multipliers);
    std::vector<double> force = bodies.force();
    jumps_.add_pulls(bodies, response.force, force);
    jumps_.add_couples(bodies, response.multipliers, response.force, force);
    return force;
}

TurnedOperator::Unbalanced TurnedOperator::unbalanced(std::span<const double> theta, const Response& response) const {
    const std::vector<double> force = internal_force(response);
    double load = max_abs(body_reactions(*bodies_, theta, force, no_row_force_));
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!bodies_->force()[p].empty()) load = std::max(load, std::abs(theta[p]) * max_abs(bodies_->force()[p]));
    load = std::max(load, std::numeric_limits<double>::min());
    // Forces are differences of places, which have the rounding of the largest; a node adds some ten of them.
    constexpr double terms = 10.0;
    const double farthest = max_abs(problem_.mesh->nodes()) + max_abs(response.multipliers);
    return {delam::equilibrium_defect(*bodies_, theta, force, no_row_force_) / load,
            terms * std::numeric_limits<double>::epsilon() * turned_->largest_stiffness() * farthest / load};
}

void TurnedOperator::solve(const Springs&, std::span<const double>, Response&) {
    fail(DELAM_ERROR_INTERNAL, "bodies with large rotations are solved in linearised scenes");
}

std::vector<double> TurnedOperator::reaction(std::span<const double> theta, const Response& response) const {
    return body_reactions(*bodies_, theta, internal_force(response), no_row_force_);
}

std::vector<double> TurnedOperator::displacement(std::span<const double>, const Response& response) const {
    return response.multipliers;
}

double TurnedOperator::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    return delam::equilibrium_defect(*bodies_, theta, internal_force(response), no_row_force_);
}

std::string TurnedOperator::description() const {
    return text("bodies of ", problem_.mesh->cell_count(),
                " cells, each in a frame that turns with it; every step linearises them, and reduces them to their "
                "interfaces, anew until the forces balance");
}

}  // namespace delam
