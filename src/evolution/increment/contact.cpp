// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/contact.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "base/error.hpp"

namespace delam {

namespace {

// Violations below this part of the largest jump or force are rounding of the linear solve. Acceptance is ten times
// wider.
constexpr double noise = 1e-11;

double largest(std::span<const double> values) {
    double m = 0.0;
    for (const double v : values) m = std::max(m, std::abs(v));
    return m;
}

// Pairs that sit on the wrong side of the complementarity condition.
std::vector<std::size_t> violators(const ContactScene& scene, std::span<const std::uint8_t> prescribed,
                                   const std::vector<std::uint8_t>& closed, const Response& response,
                                   std::uint8_t level, std::span<const double> theta) {
    const auto dim = static_cast<std::size_t>(scene.dimension);
    const double jump_scale = noise * std::max(largest(response.jump), scene.jump_floor(theta));
    const double force_scale = noise * std::max(largest(response.force), scene.force_floor(theta));
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < closed.size(); ++p) {
        if (scene.bonded[p] != 0 || prescribed[p * dim] != 0 || scene.level[p] < level) continue;
        const bool wrong =
            closed[p] != 0 ? response.force[p * dim] > force_scale : response.jump[p * dim] < -jump_scale;
        if (wrong) found.push_back(p);
    }
    return found;
}

void refuse_pressed(const ContactScene& scene, std::span<const std::uint8_t> prescribed, const Response& response,
                    std::span<const double> theta) {
    const auto dim = static_cast<std::size_t>(scene.dimension);
    const double deepest = -1e-9 * std::max(largest(response.jump), scene.jump_floor(theta));
    for (std::size_t p = 0; p < scene.bonded.size(); ++p)
        if (prescribed[p * dim] != 0 && scene.bonded[p] == 0 && response.jump[p * dim] < deepest)
            fail(DELAM_ERROR_PROBLEM, "prescribed displacements press two faces into each other at pair ", p,
                 " (normal jump ", response.jump[p * dim], " < 0)");
}

}  // namespace

ContactResult solve_contact(JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                            std::span<const double> theta, std::vector<std::uint8_t>& closed, Response& response,
                            bool cold, std::span<const double> row_force) {
    const auto dim = static_cast<std::size_t>(scene.dimension);
    const auto prescribed = op.prescribed_rows();
    Springs springs{{stiffness.begin(), stiffness.end()},
                    std::vector<std::uint8_t>(stiffness.size(), 0),
                    {row_force.begin(), row_force.end()}};
    ContactResult result;
    std::set<std::string> seen;  // contact sets, as bytes
    bool all_closed_tried = false, one_at_a_time = false;
    std::uint8_t level =
        cold && !scene.level.empty() ? *std::max_element(scene.level.begin(), scene.level.end()) : scene.least_level;
    if (level > scene.least_level) std::fill(closed.begin(), closed.end(), std::uint8_t{0});
    while (true) {
        for (std::size_t p = 0; p < closed.size(); ++p)
            for (std::size_t c = 0; c < dim; ++c)
                springs.held[p * dim + c] = scene.bonded[p] != 0 || (c == 0 && closed[p] != 0) ? 1 : 0;
        op.solve(springs, theta, response);
        ++result.solves;
        if (!response.balanced) {
            // Nothing holds a loaded part. Contact may: start once more from everything closed that can close.
            if (all_closed_tried)
                fail(DELAM_LIMIT,
                     "no equilibrium: a dead force acts on a part that neither bonds, supports nor contact hold");
            all_closed_tried = true;
            level = scene.least_level;
            for (std::size_t p = 0; p < closed.size(); ++p)
                closed[p] = scene.bonded[p] == 0 && prescribed[p * dim] == 0 && scene.level[p] >= level ? 1 : 0;
            continue;
        }
        result.linear_iterations += response.iterations;
        result.linear_residual = std::max(result.linear_residual, response.residual);
        result.converged = result.converged && response.converged;

        if (scene.always) refuse_pressed(scene, prescribed, response, theta);
        std::vector<std::size_t> wrong = violators(scene, prescribed, closed, response, level, theta);
        while (wrong.empty() && level > scene.least_level) {
            wrong = violators(scene, prescribed, closed, response, --level, theta);
            seen.clear();
            one_at_a_time = false;
        }
        if (wrong.empty()) break;
        if (result.solves >= scene.limit) {
            result.converged = false;
            break;
        }
        if (!seen.emplace(closed.begin(), closed.end()).second) result.fallback = one_at_a_time = true;
        for (const std::size_t p : wrong) {
            closed[p] ^= 1;
            if (one_at_a_time) break;
        }
    }
    refuse_pressed(scene, prescribed, response, theta);
    return result;
}

}  // namespace delam
