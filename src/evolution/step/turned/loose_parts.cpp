// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/loose_parts.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "evolution/contact/loose_rows.hpp"
#include "scene/pieces.hpp"

namespace delam {

std::vector<std::uint8_t> LooseParts::of(const State& state) const { return found(state, true); }

std::vector<std::uint8_t> LooseParts::found(const State& state, bool turning) const {
    if (contact_.parts == nullptr || state.adhesion.empty()) return {};
    const State& pressing = turning ? without_slight_forces(state) : state;
    const DenseMatrix free = free_motions(op_, contact_, spring_stiffness(pairs_, state.adhesion), state.theta,
                                          state.closed, pressing.response);
    if (free.columns == 0) return {};
    const std::vector<std::uint8_t> moves = contact_.parts->moves(free);
    const auto dim = index(problem_.mesh->dimension());
    const std::size_t modes = dim == 2 ? 3 : 6, bodies = moves.size() / modes;
    const std::vector<double> size = turning ? push_of(state) : std::vector<double>(bodies, 0.0);
    const double least = turning ? balanced(state) : 0.0;
    std::vector<std::uint8_t> loose(bodies, 0);
    for (std::size_t b = 0; b < bodies; ++b) {
        const auto own = moves.begin() + static_cast<std::ptrdiff_t>(b * modes);
        const auto is_free = [](std::uint8_t m) { return m != 0; };
        const auto first = own + static_cast<std::ptrdiff_t>(dim), last = own + static_cast<std::ptrdiff_t>(modes);
        const bool translates = std::any_of(own, first, is_free), turns = std::any_of(first, last, is_free);
        if (translates || (turning && turns && size[b] <= least)) loose[b] = 1;
    }
    const bool none = std::all_of(loose.begin(), loose.end(), [](std::uint8_t l) { return l == 0; });
    return none ? std::vector<std::uint8_t>() : loose;
}

bool LooseParts::none_without_contact(const State& state) const {
    if (contact_.parts == nullptr) return true;
    const std::vector<std::uint8_t> open(state.closed.size(), 0);
    return contact_.parts->connected(with_springs(held_rows(contact_, open), spring_stiffness(pairs_, state.adhesion)));
}

// Where contact alone holds a body, forces of contact that are as small as what is out of balance say nothing of where
// it lies.
bool LooseParts::known_forces(const State& state, double off) const {
    // Forces are known to a hundredth. (With 0.3 to 1000 times what is out of balance, half and twice among these,
    // verify/cases/test_turned_loose, test_turned_energetic and test_buckling pass in the same time, within its noise
    // of a tenth; without the rule, a film that comes off comes to rest between four contacts, bent.)
    constexpr double known = 100.0;
    const double unbalanced = off * op_.load_size(state.theta, state.response), most = max_abs(state.response.force);
    return most <= op_.rounding_of_forces(state.response.multipliers) || most >= known * unbalanced;
}

std::vector<std::uint8_t> LooseParts::all() const {
    if (contact_.parts == nullptr) return {};
    const Pieces& pieces = rigid_pieces(problem_);
    std::vector<std::uint8_t> loose(index(problem_.mesh->body_count()), 0);
    for (std::size_t p = 0; p < pieces.count(); ++p)
        if (!contact_.parts->motions().holds(p)) loose[index(pieces.body[p])] = 1;
    return loose;
}

// Returns the largest force with which an interface or a load pushes each body, [bodies].
std::vector<double> LooseParts::push_of(const State& state) const {
    const Mesh& mesh = *problem_.mesh;
    std::vector<double> most(index(mesh.body_count()), 0.0);
    const auto add = [&](std::int32_t body, double force) {
        if (body >= 0) most[index(body)] = std::max(most[index(body)], std::abs(force));
    };
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i) {
        const double pull = length(op_.pull_of(i, state.response));
        add(mesh.interfaces()[i].body_a, pull);
        add(mesh.interfaces()[i].body_b, pull);
    }
    for (const NodalForce& dead : problem_.forces)
        add(mesh.node_body(dead.dof / mesh.dimension()), dead.value * state.theta[index(dead.pattern)]);
    return most;
}

// Returns the unbalanced force that an iteration may leave.
double LooseParts::balanced(const State& state) const {
    return std::max(problem_.options.limits.turned_balance * op_.load_size(state.theta, state.response),
                    op_.rounding_of_forces(state.response.multipliers));
}

// Returns a state whose faces press only with what is more than a balance leaves.
State LooseParts::without_slight_forces(const State& state) const {
    State own = state;
    const double least = balanced(state);
    for (double& f : own.response.force)
        if (std::abs(f) <= least) f = 0.0;
    return own;
}

std::vector<std::int64_t> LooseParts::since(const State& next, const State& before) const {
    if (contact_.parts == nullptr) return next.free_since;
    return free_since(op_, contact_, pairs_, without_slight_forces(next), before);
}

std::vector<double> LooseParts::pressing(std::span<const std::uint8_t> loose, const State& state) const {
    return loose.empty() ? state.response.force : without(loose, state.response.force, balanced(state));
}

std::vector<double> LooseParts::without(std::span<const std::uint8_t> loose, std::span<const double> row_force,
                                        double least) const {
    std::vector<double> force(row_force.begin(), row_force.end());
    const Mesh& mesh = *problem_.mesh;
    const auto dim = index(mesh.dimension());
    std::size_t first = 0;
    for (const InterfaceGeometry& face : mesh.interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p, first += dim)
            for (const std::int32_t body : {face.body_a, face.body_b})
                for (std::size_t r = first; r < first + dim; ++r)
                    if (body >= 0 && loose[index(body)] != 0 && std::abs(force[r]) <= least) force[r] = 0.0;
    return force;
}

}  // namespace delam
