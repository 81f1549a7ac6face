// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/turned_jumps.hpp"

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

TurnedJumps::TurnedJumps(const Problem& problem, const Carriers& carriers)
    : problem_(problem), carriers_(carriers), dimension_(index(problem.mesh->dimension())) {
    const Mesh& mesh = *problem.mesh;
    std::vector<std::vector<std::int64_t>> cells(index(mesh.node_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (const std::int64_t node : mesh.cell(c)) cells[index(node)].push_back(c);
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        std::vector<Touching>& of_interface = touching_.emplace_back();
        for (std::size_t p = 0; p < interface.node_a.size(); ++p) {
            std::map<std::int64_t, double> weight;
            for (const std::int64_t node : {interface.node_a[p], interface.node_b[p]})
                for (const auto& [carrier, share] : carriers.of(node))
                    for (const std::int64_t c : cells[index(carrier)])
                        weight[c] += 0.5 * share / static_cast<double>(cells[index(carrier)].size());
            of_interface.emplace_back(weight.begin(), weight.end());
        }
    }
}

TurnedJumps::Turn TurnedJumps::turn(const TurnedBodies& bodies, const Touching& cells, std::int64_t node) const {
    Matrix3 sum{};
    for (const auto& [c, weight] : cells)
        for (std::size_t i = 0; i < 9; ++i) sum[i] += weight * bodies.rotation(c)[i];
    Turn turn;
    if (!polar_decomposition(sum, turn.rotation, turn.stretch))
        fail(DELAM_LIMIT, "the faces at node ", node,
             " of an interface are turned against each other by 90 degrees or "
             "more: their pair has no common frame");
    return turn;
}

Vector3 TurnedJumps::row(const InterfaceGeometry& interface, std::size_t dimension, std::size_t p, std::size_t r,
                         const Matrix3& rotation) {
    Vector3 q{};
    std::copy_n(&interface.frame[(p * dimension + r) * dimension], dimension, q.begin());
    return times(rotation, q);
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

std::vector<double> TurnedJumps::frames(const TurnedBodies& bodies, std::size_t i) const {
    const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
    std::vector<double> frames;
    frames.reserve(interface.frame.size());
    for (std::size_t p = 0; p < interface.node_a.size(); ++p) {
        const Turn turned = turn(bodies, touching_[i][p], interface.node_a[p]);
        for (std::size_t r = 0; r < dimension_; ++r) {
            const Vector3 q = row(interface, dimension_, p, r, turned.rotation);
            frames.insert(frames.end(), q.begin(), q.begin() + static_cast<std::ptrdiff_t>(dimension_));
        }
    }
    return frames;
}

std::vector<double> TurnedJumps::jumps(const TurnedBodies& bodies, std::span<const double> theta,
                                       std::span<const double> displacement) const {
    std::vector<double> jumps;
    jumps.reserve(index(problem_.jump_count()));
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
        for (std::size_t p = 0; p < interface.node_a.size(); ++p) {
            const Turn turned = turn(bodies, touching_[i][p], interface.node_a[p]);
            const Vector3 d = apart(interface, p, displacement);
            for (std::size_t r = 0; r < dimension_; ++r)
                jumps.push_back(dot(row(interface, dimension_, p, r, turned.rotation), d));
        }
    }
    for (const GapRow& gap : problem_.gap_rows()) jumps[index(gap.row)] += gap.value * theta[index(gap.pattern)];
    return jumps;
}

void TurnedJumps::add_pulls(const TurnedBodies& bodies, std::span<const double> row_force,
                            std::span<double> force) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
        for (std::size_t p = 0; p < interface.node_a.size(); ++p, first += dimension_) {
            const std::span<const double> own = row_force.subspan(first, dimension_);
            if (std::all_of(own.begin(), own.end(), [](double t) { return t == 0.0; })) continue;
            const Turn turned = turn(bodies, touching_[i][p], interface.node_a[p]);
            Vector3 pull{};
            for (std::size_t r = 0; r < dimension_; ++r) {
                const Vector3 q = row(interface, dimension_, p, r, turned.rotation);
                for (std::size_t k = 0; k < dimension_; ++k) pull[k] += own[r] * q[k];
            }
            for (const auto& [node, sign] : {std::pair(interface.node_b[p], 1.0), std::pair(interface.node_a[p], -1.0)})
                for (const auto& [carrier, weight] : carriers_.of(node))
                    for (std::size_t k = 0; k < dimension_; ++k)
                        force[index(carrier) * dimension_ + k] += sign * weight * pull[k];
        }
    }
}

void TurnedJumps::add_couples(const TurnedBodies& bodies, std::span<const double> displacement,
                              std::span<const double> row_force, std::span<double> force) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); ++i) {
        const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
        for (std::size_t p = 0; p < interface.node_a.size(); ++p, first += dimension_) {
            const std::span<const double> own = row_force.subspan(first, dimension_);
            if (std::all_of(own.begin(), own.end(), [](double t) { return t == 0.0; })) continue;
            const Turn turned = turn(bodies, touching_[i][p], interface.node_a[p]);
            const Vector3 d = apart(interface, p, displacement);
            Vector3 pull{};
            for (std::size_t r = 0; r < dimension_; ++r) {
                const Vector3 q = row(interface, dimension_, p, r, turned.rotation);
                for (std::size_t k = 0; k < 3; ++k) pull[k] += own[r] * q[k];
            }
            const Vector3 in_frame =
                times(spin_inverse(turned.stretch), transposed_times(turned.rotation, cross(pull, d)));
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
