// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/zone_system.hpp"

#include <utility>

#include "base/numbers.hpp"
#include "evolution/contact/loose_rows.hpp"
#include "reduction/dense/rigid_jumps.hpp"

namespace delam {

ZoneSystem::ZoneSystem(Zone& zone, const ContactScene& scene, std::span<const std::uint8_t> prescribed,
                       std::span<const std::uint8_t> held, std::span<const double> theta, Poll poll)
    : zone_(zone), scene_(scene), theta_(theta), poll_(std::move(poll)) {
    const auto dim = index(scene.dimension);
    const std::vector<std::int64_t>& rows = zone.jump_rows();
    for (std::size_t z = 0; z < rows.size(); ++z) {
        const std::size_t row = index(rows[z]);
        held_.push_back(prescribed[row] != 0 ? 0 : held[row]);  // by constraints: neither held nor released
        if (row % dim == 0 && scene.may_close(row / dim, prescribed)) {
            contact_.row.push_back(z);
            entered_.push_back(held_[z]);
        }
        if (row % dim == 0 && z + dim <= rows.size() && index(rows[z + dim - 1]) == row + dim - 1)
            pairs_.push_back({row / dim, z});
    }
}

void ZoneSystem::load(std::vector<Zone::Coupling> couplings, std::vector<double> row_force) {
    couplings_ = std::move(couplings);
    row_force_ = std::move(row_force);
}

void ZoneSystem::load_model(std::vector<Zone::Coupling> couplings, std::vector<double> row_force) {
    zone_.begin_model();
    load(std::move(couplings), std::move(row_force));
}

std::vector<std::uint8_t> ZoneSystem::held(const std::vector<std::uint8_t>& closed) const {
    std::vector<std::uint8_t> held = held_;
    for (std::size_t i = 0; i < closed.size(); ++i) held[contact_.row[i]] = closed[i];
    return held;
}

bool ZoneSystem::softens() const {
    return std::any_of(couplings_.begin(), couplings_.end(),
                       [](const Zone::Coupling& c) { return c.row != c.column || c.value < 0.0; });
}

void ZoneSystem::stay_near(std::span<const double> jump) {
    near_.clear();
    for (const std::int64_t row : zone_.jump_rows()) near_.push_back(jump[index(row)]);
}

// The operator, which follows the zone, decides about places; here jumps change least.
std::vector<std::size_t> ZoneSystem::settle(const ContactRows& rows, std::vector<std::uint8_t>& closed,
                                            std::uint8_t level, const SolveError& least) {
    const DenseMatrix* motions = zone_.motions();
    if (motions == nullptr || motions->columns == 0) return {};
    const LooseRows loose(rows, closed, force_, level, least.force);
    std::vector<double> spring(jump_.size(), 0.0);
    for (const Zone::Coupling& c : couplings_)
        if (c.value != 0.0) spring[index(c.row)] = 1.0;
    const DenseMatrix free = split_motions(*motions, loose.active(held_, spring)).free;
    if (free.columns == 0) return {};
    const DenseMatrix jumps = multiply(*motions, free);
    std::vector<double> change(jump_.size(), 0.0), pull(index(free.columns));
    for (std::size_t z = 0; z < near_.size(); ++z) change[z] = near_[z] - jump_[z];
    multiply_transposed(jumps, change, pull);
    const LeastMotion found = loose.keep_apart(multiply_transposed(jumps, jumps), pull, jumps, jump_, least.jump);
    std::vector<double> combination(index(free.rows)), jump(jump_.size());
    multiply(free, found.motion, combination);
    multiply(jumps, found.motion, jump);
    zone_.move(combination, solution_.unknowns);
    add_scaled(1.0, jump, jump_);
    return loose.settled(found, closed, jump_, force_, least.jump);
}

std::optional<DenseMatrix> ZoneSystem::flexibility(const std::vector<std::uint8_t>& closed,
                                                   std::span<const std::vector<Zone::RowForce>> forces) {
    call_if_set(poll_);
    if (!zone_.factor(couplings_, held(closed))) return {};
    return zone_.flexibility(forces);
}

ContactSolve ZoneSystem::solve(const std::vector<std::uint8_t>& closed) {
    call_if_set(poll_);
    held_ = held(closed);
    if (!zone_.factor(couplings_, held_)) return ContactSolve::failed;
    Zone::Solution solution = zone_.solve(theta_, row_force_);
    iterations_ += solution.iterations;
    if (!solution.balanced) return ContactSolve::unbalanced;
    if (!solution.definite || !solution.converged) return ContactSolve::failed;
    solution_ = std::move(solution);
    jump_ = zone_.jumps(theta_, solution_.unknowns);
    force_.assign(jump_.size(), 0.0);
    for (std::size_t z = 0; z < row_force_.size(); ++z) force_[z] = -row_force_[z];
    for (const Zone::Coupling& c : couplings_) force_[index(c.row)] += c.value * jump_[index(c.column)];
    const std::vector<double> acting = force_;
    zone_.complete_forces(theta_, solution_, force_);
    for (std::size_t i = 0; i < closed.size(); ++i)
        if (closed[i] != 0) force_[contact_.row[i]] -= acting[contact_.row[i]];
    return ContactSolve::solved;
}

}  // namespace delam
