// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/turned_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/rigid_modes.hpp"
#include "delam/delam.h"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/body_reactions.hpp"
#include "reduction/operator/jump_variables.hpp"
#include "scene/pieces.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

namespace {

// The kinds of points that a state remembers. States before the operator's memory was remembered have 0 for both.
constexpr double at_place = 2.0, after_move = 4.0;

bool is_loose(std::span<const std::uint8_t> loose, std::size_t body) { return !loose.empty() && loose[body] != 0; }

std::vector<BodyModel> models_of(const Problem& problem) {
    std::vector<BodyModel> models;
    for (std::int32_t body = 0; body < problem.mesh->body_count(); ++body) models.push_back(problem.model(body));
    return models;
}

// force += K u, K over the nodes of a body.
void add_product(const SparseMatrix& k, std::span<const std::int64_t> nodes, std::size_t dim,
                 std::span<const double> displacement, std::span<double> force) {
    std::vector<double> u(index(k.rows)), f(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = displacement[index(nodes[i / dim]) * dim + i % dim];
    multiply(k, u, f);
    for (std::size_t i = 0; i < u.size(); ++i) force[index(nodes[i / dim]) * dim + i % dim] += f[i];
}

// Returns the eigenstrains of the cells, each in the axes of the mesh, to which its frame turns back.
TurnedStrains strains_of(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    const std::size_t patterns = problem.patterns.size(), dim = index(mesh.dimension());
    std::vector<TurnedBodies::Pulls> pulls(patterns);
    std::vector<double> energy(patterns * patterns, 0.0);
    if (problem.eigenstrains.empty()) return {std::move(pulls), std::move(energy)};
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const auto cell = mesh.cell(c);
        std::vector<std::int64_t> nodes(cell.begin(), cell.end());
        std::sort(nodes.begin(), nodes.end());
        const StrainLoads own = strain_loads(problem, mesh.cell_body(c), std::span(&c, 1), nodes);
        for (std::size_t i = 0; i < energy.size(); ++i) energy[i] += own.energy[i];
        for (std::size_t p = 0; p < patterns; ++p) {
            if (own.force[p].empty()) continue;
            pulls[p].resize(index(mesh.cell_count()));
            std::vector<Vector3>& pull = pulls[p][index(c)];
            for (const std::int64_t node : cell) {
                const std::ptrdiff_t at = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
                std::copy_n(&own.force[p][index(at) * dim], dim, pull.emplace_back().begin());
            }
        }
    }
    return {std::move(pulls), std::move(energy)};
}

// Returns the rigid pieces of a body, with all their motions from where the nodes of a mesh are. Those that share a
// node count as one: what turns one about the other moves no support and no interface alone.
std::vector<HostPiece> loose_pieces(const Pieces& pieces, std::int32_t body, const Mesh& mesh) {
    std::vector<std::size_t> first(pieces.count());  // the piece that it is joined to
    std::iota(first.begin(), first.end(), 0U);
    for (const Pieces::Hinge& hinge : pieces.hinges) {
        const std::size_t a = first[index(hinge.piece_a)], b = first[index(hinge.piece_b)];
        std::replace(first.begin(), first.end(), std::max(a, b), std::min(a, b));
    }
    std::map<std::size_t, std::set<std::int64_t>> nodes;
    for (std::size_t p = 0; p < pieces.count(); ++p)
        if (pieces.body[p] == body) nodes[first[p]].insert(pieces.nodes[p].begin(), pieces.nodes[p].end());
    std::vector<HostPiece> loose;
    for (const auto& [piece, own] : nodes) {
        HostPiece& added = loose.emplace_back();
        added.nodes.assign(own.begin(), own.end());
        const std::vector<double> modes = rigid_modes(mesh, added.nodes);
        const std::int64_t rows = static_cast<std::int64_t>(added.nodes.size()) * mesh.dimension();
        added.free = DenseMatrix(rows, static_cast<std::int64_t>(modes.size()) / rows);
        std::copy(modes.begin(), modes.end(), added.free.value.begin());
    }
    return loose;
}

// Takes from forces on the nodes [mesh DOFs] what they do along the free motions of the scene's pieces.
void hold_still(const LinearScene& scene, std::span<double> force) {
    const auto dim = index(scene.mesh->dimension());
    for (const std::shared_ptr<HostStiffness>& body : scene.stiffness)
        for (const HostPiece& piece : body->pieces) {
            if (piece.fixed()) continue;
            std::vector<double> own, share(index(piece.free.columns));
            for (const std::int64_t node : piece.nodes)
                for (std::size_t k = index(node) * dim; k < (index(node) + 1) * dim; ++k) own.push_back(force[k]);
            multiply_transposed(piece.free, own, share);
            multiply(piece.free, share, own);
            for (std::size_t i = 0; i < own.size(); ++i) force[index(piece.nodes[i / dim]) * dim + i % dim] -= own[i];
        }
}

// Adds these forces to the dead ones, as the last pattern of the scene.
void add_forces(const Problem& problem, std::span<const double> force, LinearScene& scene) {
    scene.problem.forces = problem.forces;
    const auto pattern = static_cast<std::int64_t>(problem.patterns.size());
    for (std::size_t i = 0; i < force.size(); ++i)
        if (force[i] != 0.0) scene.problem.forces.push_back({pattern, static_cast<std::int64_t>(i), force[i]});
}

}  // namespace

bool TurnedPoint::loosen(const std::vector<std::uint8_t>& more) {
    const std::vector<std::uint8_t> before = loose;
    if (loose.empty()) loose = more;
    for (std::size_t b = 0; b < more.size(); ++b) loose[b] = std::max(loose[b], more[b]);
    return loose != before;
}

// The first number is `after_move` where the point is the end of a move, or `at_place`, and one more where stresses
// count.
std::vector<double> TurnedMemory::numbers() const {
    std::vector<double> numbers{(point.from.empty() ? at_place : after_move) +
                                (point.stresses == TurnedCell::Stresses::count ? 1.0 : 0.0)};
    for (const std::vector<double>* part : {&point.displacement, &point.from, &point.along, &of_operator})
        numbers.insert(numbers.end(), part->begin(), part->end());
    return numbers;
}

TurnedMemory TurnedMemory::of(std::span<const double> numbers, std::span<const double> displacement,
                              std::span<const double> theta) {
    TurnedPoint point{{displacement.begin(), displacement.end()}, {}, {}};
    point.theta.assign(theta.begin(), theta.end());
    if (numbers.empty()) return {std::move(point), {}};
    const double kind = numbers.front();
    point.stresses = std::fmod(kind, 2.0) != 0.0 ? TurnedCell::Stresses::count : TurnedCell::Stresses::left_out;
    const std::size_t dofs = displacement.size();
    numbers = numbers.subspan(1);
    const auto take = [&](std::vector<double>& part) {
        part.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(dofs));
        numbers = numbers.subspan(dofs);
    };
    take(point.displacement);
    if (kind < at_place ? !numbers.empty() : kind >= after_move) {
        take(point.from);
        take(point.along);
    }
    return {std::move(point), {numbers.begin(), numbers.end()}};
}

TurnedOperator::TurnedOperator(const Problem& problem, const Poll& poll)
    : problem_(problem),
      bodies_(std::make_unique<BodySystem>(problem, poll, BodySystem::Stiffness::elsewhere)),
      carriers_(problem),
      jumps_(std::make_unique<TurnedJumps>(problem, carriers_)),
      prescribed_(delam::prescribed_rows(bodies_->variables())),
      no_row_force_(index(problem.jump_count()), 0.0),
      turned_(std::make_unique<TurnedBodies>(*problem.mesh, models_of(problem))),
      strains_(std::make_unique<const TurnedStrains>(strains_of(problem))) {
    bodies_->find_dead_forces();
    call_if_set(poll);
}

TurnedBodies& TurnedOperator::at(std::span<const double> displacement) const {
    if (!std::equal(at_.begin(), at_.end(), displacement.begin(), displacement.end())) {
        at_.clear();
        turned_->move(displacement);
        jumps_->move(*turned_, displacement);
        at_.assign(displacement.begin(), displacement.end());
    }
    return *turned_;
}

TurnedBodies::Pulls TurnedOperator::pulls(std::span<const double> theta, std::span<const double> displacement) const {
    TurnedBodies::Pulls pulls = at(displacement).pulls();
    strains_->subtract(theta, pulls);
    return pulls;
}

LinearScene TurnedOperator::scene(const TurnedPoint& point) const {
    LinearScene scene{problem_, std::make_shared<Mesh>(*problem_.mesh), {}};
    Problem& about = scene.problem;
    about.options.kinematics = "linear";
    about.options.solution = "local";  // evolution/step/turned/lower_states.hpp
    about.renewed = true;
    about.mesh = scene.mesh;
    for (Pattern& pattern : about.patterns)  // strains are forces on nodes there
        if (pattern.drives == Pattern::Drives::strain) pattern.drives = Pattern::Drives::force;
    about.patterns.push_back({"linearisation", {0.0}, {1.0}, Pattern::Drives::force});
    for (std::int32_t body = 0; body < scene.mesh->body_count(); ++body) {
        auto given = std::make_shared<HostStiffness>();
        const std::vector<std::int64_t> nodes = scene.mesh->body_nodes(body);
        if (!point.loose.empty()) move_nodes(*scene.mesh, nodes, point.displacement);
        // Stresses resist rotations, so that no rigid motion is free of energy where something holds the body.
        const std::int64_t rows = static_cast<std::int64_t>(nodes.size()) * scene.mesh->dimension();
        if (is_loose(point.loose, index(body)))
            given->pieces = loose_pieces(rigid_pieces(problem_), body, *scene.mesh);
        else
            given->pieces.push_back({nodes, DenseMatrix(rows, 0), {}});
        about.stiffness[index(body)] = given;
        scene.stiffness.push_back(std::move(given));
    }
    return scene;
}

void TurnedOperator::turn(LinearScene& scene, const TurnedPoint& point) const {
    TurnedBodies::Pulls pulls;
    if (!point.from.empty()) {
        pulls = this->pulls(point.theta, point.from);
        std::vector<double> moved = point.displacement;
        add_scaled(-1.0, point.from, moved);
        at(point.along).add_pulls_along(moved, pulls);
    }
    const TurnedBodies& bodies = at(point.displacement);
    if (point.from.empty()) pulls = this->pulls(point.theta, point.displacement);
    for (std::size_t i = 0; i < problem_.interfaces.size(); ++i) turn_frames(*scene.mesh, i, jumps_->frames(i));
    for (std::size_t b = 0; b < scene.stiffness.size(); ++b)
        bodies.set_tangent(static_cast<std::int32_t>(b),
                           is_loose(point.loose, b) ? TurnedCell::Stresses::left_out : point.stresses, pulls,
                           scene.stiffness[b]->matrix);
}

void TurnedOperator::load(LinearScene& scene, std::span<const double> displacement,
                          std::span<const double> row_force) const {
    const TurnedBodies& bodies = at(displacement);
    std::vector<double> force = bodies.force();
    add_scaled(-1.0, forces(scene, displacement), force);
    // Along free motions, what cells and slides do is rounding, or comes to an end with the iteration.
    jumps_->add_slides(bodies, row_force, force);
    hold_still(scene, force);
    jumps_->add_couples(bodies, row_force, force);
    jumps_->add_pulls(row_force, force);
    jumps_->subtract_pulls(*scene.mesh, row_force, force);
    for (double& f : force) f = -f;
    add_forces(problem_, force, scene);
    const std::vector<std::vector<double>> of_strains = strains_->forces(bodies);
    for (std::size_t p = 0; p < of_strains.size(); ++p)
        for (std::size_t i = 0; i < of_strains[p].size(); ++i)
            if (const double f = of_strains[p][i]; f != 0.0)
                scene.problem.forces.push_back({static_cast<std::int64_t>(p), static_cast<std::int64_t>(i), f});
    scene.problem.jump_offset = jumps_->beyond(*scene.mesh);
}

std::vector<double> TurnedOperator::forces(const LinearScene& scene, std::span<const double> displacement) const {
    std::vector<double> force(displacement.size(), 0.0);
    for (std::size_t b = 0; b < scene.stiffness.size(); ++b)
        add_product(scene.stiffness[b]->matrix, scene.mesh->body_nodes(static_cast<std::int32_t>(b)),
                    index(problem_.mesh->dimension()), displacement, force);
    return force;
}

void TurnedOperator::load_forces(LinearScene& scene, std::span<const double> force) const {
    add_forces(problem_, force, scene);
    scene.problem.jump_offset.assign(index(problem_.jump_count()), 0.0);
}

std::vector<SparseMatrix> TurnedOperator::softening(std::span<const double> theta, std::span<const double> displacement,
                                                    std::span<const std::uint8_t> loose) const {
    const TurnedBodies::Pulls pulls = this->pulls(theta, displacement);
    const TurnedBodies& bodies = at(displacement);
    std::vector<SparseMatrix> soft(index(problem_.mesh->body_count()));
    for (std::size_t b = 0; b < soft.size(); ++b) {
        const auto body = static_cast<std::int32_t>(b);
        SparseMatrix stressed;
        bodies.set_tangent(body, TurnedCell::Stresses::left_out, pulls, soft[b]);
        bodies.set_tangent(body, TurnedCell::Stresses::count, pulls, stressed);
        for (std::size_t e = 0; e < soft[b].value.size(); ++e)
            soft[b].value[e] = is_loose(loose, b) ? 0.0 : soft[b].value[e] - stressed.value[e];
    }
    return soft;
}

std::vector<double> TurnedOperator::multiply_bodies(std::span<const SparseMatrix> of_bodies,
                                                    std::span<const double> displacement) const {
    std::vector<double> force(displacement.size(), 0.0);
    for (std::size_t b = 0; b < of_bodies.size(); ++b)
        add_product(of_bodies[b], problem_.mesh->body_nodes(static_cast<std::int32_t>(b)),
                    index(problem_.mesh->dimension()), displacement, force);
    return force;
}

void TurnedOperator::complete(std::span<const double> theta, std::vector<double> displacement,
                              Response& response) const {
    const TurnedBodies& bodies = at(displacement);
    response.jump = jumps_->jumps(theta);
    response.stored_bulk = bodies.energy() + strains_->energy(theta, bodies);
    strains_->set_conjugate(theta, bodies, response.conjugate);
    response.load_potential = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (const std::vector<double>& force = bodies_->force()[p]; !force.empty())
            response.load_potential -= theta[p] * dot(force, displacement);
    response.multipliers = std::move(displacement);
    response.rigid.clear();
    response.support = {};
}

std::vector<double> TurnedOperator::internal_force(std::span<const double> theta, const Response& response) const {
    const TurnedBodies& bodies = at(response.multipliers);
    std::vector<double> force = bodies.force();
    const std::vector<std::vector<double>> of_strains = strains_->forces(bodies);
    for (std::size_t p = 0; p < of_strains.size(); ++p)
        if (!of_strains[p].empty()) add_scaled(-theta[p], of_strains[p], force);
    jumps_->add_pulls(response.force, force);
    jumps_->add_couples(bodies, response.force, force);
    jumps_->add_slides(bodies, response.force, force);
    return force;
}

double TurnedOperator::load_size(std::span<const double> theta, const Response& response) const {
    return load_size(theta, response, internal_force(theta, response));
}

double TurnedOperator::load_size(std::span<const double> theta, const Response& response,
                                 std::span<const double> force) const {
    double load = max_abs(body_reactions(*bodies_, theta, force, no_row_force_));
    const std::vector<std::vector<double>> of_strains = strains_->forces(at(response.multipliers));
    for (const auto* forces : {&bodies_->force(), &of_strains})
        for (std::size_t p = 0; p < theta.size(); ++p)
            if (!(*forces)[p].empty()) load = std::max(load, std::abs(theta[p]) * max_abs((*forces)[p]));
    return std::max(load, std::numeric_limits<double>::min());
}

TurnedOperator::Unbalanced TurnedOperator::unbalanced(std::span<const double> theta, const Response& response) const {
    const std::vector<double> force = internal_force(theta, response);
    const double load = load_size(theta, response, force);
    return {delam::equilibrium_defect(*bodies_, theta, force, no_row_force_) / load,
            rounding_of_forces(response.multipliers) / load};
}

double TurnedOperator::longest_slide(const Response& response) const {
    (void)at(response.multipliers);
    return jumps_->longest_slide(response.force);
}

Vector3 TurnedOperator::pull_of(std::size_t interface, const Response& response) const {
    (void)at(response.multipliers);
    return jumps_->pull_of(interface, response.force);
}

// Forces are differences of places, which have the rounding of the largest; a node adds some ten of them.
double TurnedOperator::rounding_of_forces(std::span<const double> displacement) const {
    constexpr double terms = 10.0;
    const double farthest = max_abs(problem_.mesh->nodes()) + max_abs(displacement);
    return terms * std::numeric_limits<double>::epsilon() * turned_->largest_stiffness() * farthest;
}

void TurnedOperator::solve(const Springs&, std::span<const double>, Response&) {
    fail(DELAM_ERROR_INTERNAL, "bodies with large rotations are solved in linearised scenes");
}

std::vector<double> TurnedOperator::reaction(std::span<const double> theta, const Response& response) const {
    return body_reactions(*bodies_, theta, internal_force(theta, response), no_row_force_);
}

std::vector<double> TurnedOperator::displacement(std::span<const double>, const Response& response) const {
    return response.multipliers;
}

double TurnedOperator::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    return delam::equilibrium_defect(*bodies_, theta, internal_force(theta, response), no_row_force_);
}

void TurnedOperator::require_memory(std::span<const double> memory) const {
    if (memory.empty()) return;
    const std::size_t one = dofs() + 1, three = 3 * dofs() + 1;
    const double kind = memory.front();
    const bool known = kind >= 0.0 && kind < after_move + 2.0 && kind == std::floor(kind);
    const bool complete = kind < at_place ? memory.size() == one || memory.size() == three
                                          : memory.size() >= (kind < after_move ? one : three);
    if (!known || !complete)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds ", memory.size(), " numbers of a linearisation of kind ", kind,
             ", allowed: ", one, " or more of kinds 2 and 3, ", three, " or more of kinds 4 and 5");
}

std::string TurnedOperator::description() const {
    return text("bodies of ", problem_.mesh->cell_count(),
                " cells, each in a frame that turns with it; every step linearises them, and reduces them to their "
                "interfaces, anew until the forces balance");
}

}  // namespace delam
