// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/turned_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// This is the cosine of half the angle between faces, 120 degrees, beyond which their pair is open. (Half and twice of
// the angle: examples/peel ends with an energy that differs by 1e-8 and not at all, a film that curls up by 4.5 rad by
// 4e-10 and not at all, with up to 1.15 times the iterations.)
constexpr double away = 0.5;
// Faces that are turned farther than this, 30 degrees against each other, and lie deeper in each other than a cell is
// large, have turned by more than half a turn. (Half and twice of this angle leave every digit of examples/peel and of
// `curled_film` of verify/cases/test_turned_strains.cpp, which curls up by 320 degrees.)
constexpr double aligned = 0.9659258262890683;

Matrix3 product(const Matrix3& a, const Matrix3& b) {
    Matrix3 c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i * 3 + j] += a[i * 3 + k] * b[k * 3 + j];
    return c;
}

// Returns the cosine of the angle between two rotations.
double angle_cosine(const Matrix3& a, const Matrix3& b) {
    double trace = 0.0;
    for (std::size_t i = 0; i < 9; ++i) trace += a[i] * b[i];
    return 0.5 * (trace - 1.0);
}

// Returns the rotation by the smallest angle that takes a unit vector to the direction of another vector; none where
// this has no length. Of all half turns one in the plane is taken where there is one.
Matrix3 shortest_turn(const Vector3& from, const Vector3& to) {
    const double size = length(to);
    if (!(size > 0.0)) return {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    Vector3 axis = cross(from, to);
    const double sine = length(axis) / size, cosine = dot(from, to) / size;
    if (!(sine > 1e-12)) axis = std::abs(from[2]) < 0.5 ? Vector3{0.0, 0.0, 1.0} : cross(from, Vector3{1.0, 0.0, 0.0});
    const double long_axis = length(axis);
    for (double& a : axis) a /= long_axis;
    Matrix3 turn{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            turn[i * 3 + j] = (i == j ? cosine : 0.0) + (1.0 - cosine) * axis[i] * axis[j];
    const Matrix3 spin{0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0};
    for (std::size_t i = 0; i < 9; ++i) turn[i] += sine * spin[i];
    return turn;
}

}  // namespace

TurnedJumps::TurnedJumps(const Problem& problem, const Carriers& carriers)
    : problem_(problem), carriers_(carriers), dimension_(index(problem.mesh->dimension())) {
    const Mesh& mesh = *problem.mesh;
    std::vector<std::vector<std::int64_t>> cells(index(mesh.node_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (const std::int64_t node : mesh.cell(c)) cells[index(node)].push_back(c);
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        std::vector<Touching>& of_interface = touching_.emplace_back(interface.node_a.size());
        for (std::size_t p = 0; interface.body_a >= 0 && p < interface.node_a.size(); ++p) {
            std::map<std::int64_t, double> weight;
            for (const std::int64_t node : {interface.node_a[p], interface.node_b[p]})
                for (const auto& [carrier, share] : carriers.of(node))
                    for (const std::int64_t c : cells[index(carrier)])
                        weight[c] += 0.5 * share / static_cast<double>(cells[index(carrier)].size());
            of_interface[p].assign(weight.begin(), weight.end());
        }
        turns_.emplace_back(interface.node_a.size());
        frames_.push_back(interface.frame);
    }
}

void TurnedJumps::turn(const TurnedBodies& bodies, const Touching& cells, const Vector3& normal, Turn& turn) const {
    Matrix3 sum{};
    for (const auto& [c, weight] : cells)
        for (std::size_t i = 0; i < 9; ++i) sum[i] += weight * bodies.rotation(c)[i];
    const Matrix3& one = bodies.rotation(cells.front().first);
    if (polar_decomposition(sum, turn.rotation, turn.stretch)) {
        const double cosine = angle_cosine(one, turn.rotation), depth = -dot(times(turn.rotation, normal), turn.apart);
        if (cosine > away && (cosine > aligned || depth < bodies.radius(cells.front().first))) return;
    }
    turn.rotation = product(shortest_turn(times(one, normal), turn.apart), one);
    turn.stretch = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
}

Vector3 TurnedJumps::apart(const InterfaceGeometry& interface, std::size_t p,
                           std::span<const double> displacement) const {
    Vector3 d{};
    for (const auto& [node, sign] : {std::pair(interface.node_b[p], 1.0), std::pair(interface.node_a[p], -1.0)})
        for (const auto& [carrier, weight] : carriers_.of(node))
            for (std::size_t k = 0; k < dimension_; ++k)
                d[k] += sign * weight * displacement[index(carrier) * dimension_ + k];
    return d;
}

void TurnedJumps::move(const TurnedBodies& bodies, std::span<const double> displacement) {
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
        for (std::size_t p = 0; p < interface.node_a.size(); ++p) {
            Turn& own = turns_[i][p];
            own.apart = apart(interface, p, displacement);
            if (touching_[i][p].empty()) continue;
            Vector3 normal{};
            std::copy_n(&interface.frame[p * dimension_ * dimension_], dimension_, normal.begin());
            turn(bodies, touching_[i][p], normal, own);
            for (std::size_t r = 0; r < dimension_; ++r) {
                const std::size_t at = (p * dimension_ + r) * dimension_;
                Vector3 q{};
                std::copy_n(&interface.frame[at], dimension_, q.begin());
                q = times(own.rotation, q);
                std::copy_n(q.begin(), dimension_, &frames_[i][at]);
            }
        }
    }
}

std::vector<double> TurnedJumps::jumps(std::span<const double> theta) const {
    std::vector<double> jumps;
    jumps.reserve(index(problem_.jump_count()));
    for (std::size_t i = 0; i < touching_.size(); ++i)
        for (std::size_t e = 0; e < frames_[i].size(); e += dimension_) {
            const Vector3& d = turns_[i][e / (dimension_ * dimension_)].apart;
            jumps.push_back(dot(std::span(frames_[i]).subspan(e, dimension_), std::span(d).first(dimension_)));
        }
    for (const GapRow& gap : problem_.gap_rows()) jumps[index(gap.row)] += gap.value * theta[index(gap.pattern)];
    return jumps;
}

std::vector<double> TurnedJumps::beyond(const Mesh& mesh) const {
    std::vector<double> jumps;
    jumps.reserve(index(problem_.jump_count()));
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        const std::vector<double>& before = mesh.interfaces()[i].frame;
        for (std::size_t e = 0; e < before.size(); e += dimension_) {
            const Vector3& d = turns_[i][e / (dimension_ * dimension_)].apart;
            double sum = 0.0;
            for (std::size_t k = 0; k < dimension_; ++k) sum += (frames_[i][e + k] - before[e + k]) * d[k];
            jumps.push_back(sum);
        }
    }
    return jumps;
}

void TurnedJumps::pull(std::size_t interface, std::span<const double> frames, std::span<const double> row_force,
                       double factor, std::span<double> force) const {
    const InterfaceGeometry& geometry = problem_.mesh->interfaces()[interface];
    for (std::size_t p = 0; p < geometry.node_a.size(); ++p) {
        const std::span<const double> own = row_force.subspan(p * dimension_, dimension_);
        if (std::all_of(own.begin(), own.end(), [](double t) { return t == 0.0; })) continue;
        Vector3 pull{};
        for (std::size_t r = 0; r < dimension_; ++r)
            for (std::size_t k = 0; k < dimension_; ++k)
                pull[k] += factor * own[r] * frames[(p * dimension_ + r) * dimension_ + k];
        for (const auto& [node, sign] : {std::pair(geometry.node_b[p], 1.0), std::pair(geometry.node_a[p], -1.0)})
            for (const auto& [carrier, weight] : carriers_.of(node))
                for (std::size_t k = 0; k < dimension_; ++k)
                    force[index(carrier) * dimension_ + k] += sign * weight * pull[k];
    }
}

void TurnedJumps::add_pulls(std::span<const double> row_force, std::span<double> force) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); first += touching_[i++].size() * dimension_)
        pull(i, frames_[i], row_force.subspan(first), 1.0, force);
}

Vector3 TurnedJumps::pull_of(std::size_t interface, std::span<const double> row_force) const {
    std::size_t row = 0;
    for (std::size_t i = 0; i < interface; ++i) row += touching_[i].size() * dimension_;
    Vector3 pull{};
    for (std::size_t e = 0; e < frames_[interface].size(); ++e)
        pull[e % dimension_] += row_force[row + e / dimension_] * frames_[interface][e];
    return pull;
}

void TurnedJumps::subtract_pulls(const Mesh& mesh, std::span<const double> row_force, std::span<double> force) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); first += touching_[i++].size() * dimension_)
        pull(i, mesh.interfaces()[i].frame, row_force.subspan(first), -1.0, force);
}

void TurnedJumps::add_couples(const TurnedBodies& bodies, std::span<const double> row_force,
                              std::span<double> force) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        for (std::size_t p = 0; p < touching_[i].size(); ++p, first += dimension_) {
            const std::span<const double> own = row_force.subspan(first, dimension_);
            if (touching_[i][p].empty() || std::all_of(own.begin(), own.end(), [](double t) { return t == 0.0; }))
                continue;
            const Turn& turned = turns_[i][p];
            Vector3 pull{};
            for (std::size_t r = 0; r < dimension_; ++r)
                for (std::size_t k = 0; k < dimension_; ++k)
                    pull[k] += own[r] * frames_[i][(p * dimension_ + r) * dimension_ + k];
            const Vector3 in_frame =
                times(spin_inverse(turned.stretch), transposed_times(turned.rotation, cross(pull, turned.apart)));
            for (const auto& [c, weight] : touching_[i][p]) {
                const Matrix3 s = transposed_times(turned.rotation, bodies.rotation(c));
                const Vector3 turned_back = transposed_times(s, in_frame);
                const double trace = s[0] + s[4] + s[8];
                Vector3 own_couple{};
                for (std::size_t k = 0; k < 3; ++k) own_couple[k] = weight * (trace * in_frame[k] - turned_back[k]);
                bodies.add_couple(c, times(turned.rotation, own_couple), force);
            }
        }
    }
}

}  // namespace delam
