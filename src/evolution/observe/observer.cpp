// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "body/rotation.hpp"
#include "body/turned/turned_bodies.hpp"
#include "evolution/observe/balance.hpp"
#include "reduction/sparse/engine/engine_operator.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double largest_share = 0.99;  // of the energy: larger estimates say no more
}  // namespace

void Observer::show(const State& state) {
    shown_ = &state;
    displacement_.clear();
    slopes_.clear();
    fronts_.clear();
    mesh_error_.reset();
    small_rotations_.reset();
}

std::optional<CrackedInterface> Observer::cracked(const State& state, std::int64_t interface) const {
    const Mesh& mesh = *problem_.mesh;
    const InterfaceProperties& properties = problem_.interfaces[index(interface)];
    if (properties.bonded || !properties.law) return std::nullopt;
    const InterfaceGeometry& geometry = mesh.interfaces()[index(interface)];
    std::size_t first = 0;
    const std::size_t count = index(geometry.pair_count());
    for (std::int64_t i = 0; i < interface; ++i) first += index(mesh.interfaces()[index(i)].pair_count());
    const auto dim = index(mesh.dimension());
    return CrackedInterface{mesh,
                            geometry,
                            *properties.law,
                            std::span(properties.adhesion),
                            std::span(state.adhesion).subspan(first, count),
                            std::span(state.response.jump).subspan(first * dim, count * dim),
                            std::span(state.response.force).subspan(first * dim, count * dim)};
}

double Observer::largest_rotation(const State& state) {
    if (problem_.mesh->cell_count() == 0) return unknown;
    if (const TurnedBodies* turned = op_.turned(state.response))
        return largest_length(turned->rotation_vectors(), problem_.mesh->dimension() == 2 ? 1 : 3);
    const std::size_t dim = index(problem_.mesh->dimension());
    const std::vector<double> rotation =
        rotations(&state == shown_ ? slopes() : centres().slopes(displacement(state)), dim);
    return largest_length(rotation, dim == 2 ? 1 : 3);
}

std::vector<double> Observer::rotation() {
    const TurnedBodies* turned = op_.turned(state().response);
    return turned != nullptr ? turned->rotation_vectors() : rotations(slopes(), index(problem_.mesh->dimension()));
}

std::vector<BodyModel> Observer::models() const {
    std::vector<BodyModel> models;
    for (std::int32_t body = 0; body < problem_.mesh->body_count(); ++body)
        models.push_back(known(body) ? problem_.model(body)
                                     : BodyModel{Elastic{1.0, 0.0}, problem_.plane, Formulation::standard, nullptr});
    return models;
}

std::vector<Strain> Observer::eigenstrains(const State& state) const {
    std::vector<Strain> strains;
    for (std::int32_t body = 0; body < problem_.mesh->body_count() && !problem_.eigenstrains.empty(); ++body)
        strains.push_back(strain_at(problem_, body, state.theta));
    return strains;
}

MeshError Observer::estimate(const State& state) {
    if (estimates_ == nullptr) {
        std::vector<std::uint8_t> with_material;
        for (std::int32_t body = 0; body < problem_.mesh->body_count(); ++body)
            with_material.push_back(known(body) ? 1 : 0);
        estimates_ = mesh_error_estimate(*problem_.mesh, models(), std::move(with_material));
    }
    if (const TurnedBodies* turned = op_.turned(state.response)) return estimates_->of(*turned, eigenstrains(state));
    return &state == shown_ ? estimates_->of(displacement(), eigenstrains())
                            : estimates_->of(displacement(state), eigenstrains(state));
}

const CentreGradients& Observer::centres() {
    if (!centres_) centres_.emplace(*problem_.mesh);
    return *centres_;
}

const std::vector<double>& Observer::slopes() {
    if (slopes_.empty()) slopes_ = centres().slopes(displacement());
    return slopes_;
}

std::vector<double> Observer::mesh_error_of_cells() { return estimate(state()).of_cell; }

MeshErrorShares Observer::mesh_error(const State& state) {
    if (&state == shown_ && mesh_error_) return *mesh_error_;
    const MeshError error = estimate(state);
    std::vector<std::uint8_t> at_front(error.of_cell.size(), 0);
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(problem_.interfaces.size()); ++i)
        if (const std::optional<CrackedInterface> of = cracked(state, i)) mark_cells_at_fronts(*of, at_front);
    MeshErrorShares shares;
    for (std::size_t c = 0; c < error.of_cell.size(); ++c) {
        (at_front[c] != 0 ? shares.fronts : shares.away) += error.of_cell[c];
        shares.excess += error.excess[c];
    }
    const double stored = state.ledger.stored_bulk;
    for (double* share : {&shares.away, &shares.fronts, &shares.excess})
        *share = stored > 0.0 ? std::min(*share / stored, largest_share) : unknown;
    if (&state == shown_) mesh_error_ = shares;
    return shares;
}

SmallRotations::Holding Observer::holding(const State& state) const {
    const double least = problem_.options.limits.turned_balance * max_abs(op_.reaction(state.theta, state.response));
    const auto dim = index(problem_.mesh->dimension());
    std::vector<std::uint8_t> pressed = state.closed, touching(state.response.jump.size(), 0);
    const std::vector<std::uint8_t> touches =
        touching_pairs(contact_, op_, scene_size(*problem_.mesh), state.response.jump);
    for (std::size_t p = 0; p < pressed.size(); ++p) {
        if (!(-state.response.force[p * dim] > least)) pressed[p] = 0;
        if (pressed[p] == 0) touching[p * dim] = touches[p];
    }
    return {{spring_stiffness(pairs_, state.adhesion), held_rows(contact_, pressed)}, std::move(touching)};
}

std::shared_ptr<SmallRotations> Observer::small_rotations(const State& state) {
    if (op_.turned(state.response) != nullptr) return nullptr;
    if (&state == shown_ && small_rotations_ != nullptr) return small_rotations_;
    SmallRotations::Moved moved{displacement(state), {}, {}};
    moved.slopes = centres().slopes(moved.displacement);
    moved.stress = centre_stress(*problem_.mesh, models(), moved.displacement, moved.slopes, eigenstrains(state));
    auto small = std::make_shared<SmallRotations>(problem_, op_.system(), models(), std::move(moved),
                                                  state.ledger.stored_bulk, [this, &state] { return holding(state); });
    if (&state == shown_) small_rotations_ = small;
    return small;
}

double Observer::left_out(const State& state, double (SmallRotations::*value)(), double large) {
    const std::shared_ptr<SmallRotations> small = small_rotations(state);
    return small != nullptr ? (*small.*value)() : large;
}

std::vector<double> Observer::stress() {
    const Mesh& mesh = *problem_.mesh;
    const TurnedBodies* turned = op_.turned(state().response);
    std::vector<double> stress = turned != nullptr
                                     ? turned->centre_stress(models(), eigenstrains())
                                     : centre_stress(mesh, models(), displacement(), slopes(), eigenstrains());
    const std::int64_t columns = mesh.dimension() == 2 ? 4 : 6;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        if (!known(mesh.cell_body(c))) std::fill_n(stress.begin() + c * columns, columns, unknown);
    return stress;
}

// Nothing is kept of a call that was cancelled, or that ran out of memory.
const Observer::AverageReadings* Observer::average_readings(std::int32_t body) {
    const auto known_already = averages_.find(body);
    if (known_already != averages_.end()) return known_already->second ? &*known_already->second : nullptr;
    AverageReadings readings{average_weights(*problem_.mesh, models(), body), {}, {}};
    const auto take = [&](std::array<std::vector<double>, 6>& weights, std::array<LinearReading, 6>& to) {
        for (std::size_t i = 0; i < 6; ++i) {
            poll_cancel("recover", problem_.mesh->node_count());
            if (weights[i].empty()) continue;
            std::optional<LinearReading> reading = op_.reading(weights[i]);
            if (!reading) return false;
            to[i] = std::move(*reading);
            weights[i] = {};
        }
        return true;
    };
    std::optional<AverageReadings> made;
    if (take(readings.rest.strain, readings.strain) && take(readings.rest.stress, readings.stress))
        made = std::move(readings);
    const auto at = averages_.emplace(body, std::move(made)).first;
    return at->second ? &*at->second : nullptr;
}

VolumeAverage Observer::average(std::int32_t body) {
    VolumeAverage average;
    if (const TurnedBodies* turned = op_.turned(state().response)) {
        average = turned->average(models(), eigenstrains(), body);
    } else if (const AverageReadings* readings = average_readings(body)) {
        std::array<double, 6> strain{}, stress{};
        for (std::size_t i = 0; i < 6; ++i) {
            strain[i] = readings->strain[i].at(state().theta, state().response);
            stress[i] = readings->stress[i].at(state().theta, state().response);
        }
        average = readings->rest.with(strain, stress, eigenstrains());
    } else {
        average = volume_average(*problem_.mesh, models(), displacement(), eigenstrains(), body);
    }
    for (std::int32_t b = 0; b < problem_.mesh->body_count(); ++b) {
        if ((body >= 0 && b != body) || known(b) || problem_.mesh->host_body(b)) continue;
        average.stress.fill(unknown);
        if (problem_.mesh->dimension() == 2 && problem_.plane == Plane::stress)
            std::fill(average.strain.begin() + 2, average.strain.end(), unknown);
    }
    return average;
}

const std::vector<CrackFront>& Observer::crack_fronts(std::int64_t interface) {
    fronts_.resize(problem_.interfaces.size());
    auto& kept = fronts_[index(interface)];
    if (!kept) {
        const std::optional<CrackedInterface> of = cracked(state(), interface);
        kept = of ? delam::crack_fronts(*of) : std::vector<CrackFront>{};
    }
    return *kept;
}

const std::vector<double>& Observer::displacement() {
    if (displacement_.empty()) {
        displacement_ = op_.displacement(state().theta, state().response);
        ++recoveries_;
    }
    return displacement_;
}

const std::vector<LinearReading>& Observer::node_readings(std::int64_t node) {
    const auto known_already = nodes_.find(node);
    if (known_already != nodes_.end()) return known_already->second;
    const auto dim = index(problem_.mesh->dimension());
    std::vector<LinearReading> readings;
    for (std::size_t k = 0; k < dim; ++k) {
        poll_cancel("recover", problem_.mesh->node_count());
        std::vector<double> weights(index(problem_.mesh->node_count()) * dim, 0.0);
        weights[index(node) * dim + k] = 1.0;
        if (std::optional<LinearReading> reading = op_.reading(weights)) readings.push_back(std::move(*reading));
    }
    return nodes_.emplace(node, std::move(readings)).first->second;
}

std::vector<double> Observer::displacement_of(std::int64_t node) {
    const std::vector<LinearReading>& readings = node_readings(node);
    std::vector<double> out;
    for (const LinearReading& reading : readings) out.push_back(reading.at(state().theta, state().response));
    if (!readings.empty()) return out;
    const auto dim = static_cast<std::ptrdiff_t>(problem_.mesh->dimension());
    const auto begin = displacement().begin() + node * dim;
    return {begin, begin + dim};
}

std::vector<double> Observer::displacement(const State& state) {
    if (&state == shown_) return displacement();
    ++recoveries_;
    return op_.displacement(state.theta, state.response);
}

bool Observer::recover_in_engine() {
    if (in_engine_ == nullptr) return false;
    in_engine_->recover_in_engine(state().theta, state().response);
    ++recoveries_;
    return true;
}

double Observer::equilibrium_defect(const State& state) {
    const Balance balance(problem_, op_, contact_, pairs_, state);
    const double left = balance.left(displacement(state)), reaction = balance.reaction();
    return reaction > 0.0 ? left / reaction : left;
}

}  // namespace delam
