// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/turned_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/points.hpp"

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

// Slides below this share of the spacing of pairs are rounding. (A hundredth and a hundred times pass
// verify/cases/test_turned_sliding.cpp.)
constexpr double no_slide = 1e-6;

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
    const auto around = [&](std::int64_t node) {
        Touching of;
        for (const auto& [carrier, share] : carriers.of(node))
            for (const std::int64_t c : cells[index(carrier)])
                of.emplace_back(c, 0.5 * share / static_cast<double>(cells[index(carrier)].size()));
        return of;
    };
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        std::vector<Touching>& first = first_.emplace_back(interface.node_a.size());
        std::vector<Touching>& second = second_.emplace_back(interface.node_a.size());
        std::vector<Touching>& both = touching_.emplace_back(interface.node_a.size());
        for (std::size_t p = 0; interface.body_a >= 0 && p < interface.node_a.size(); ++p) {
            first[p] = around(interface.node_a[p]);
            second[p] = around(interface.node_b[p]);
            std::map<std::int64_t, double> weight;
            for (const Touching* side : {&first[p], &second[p]})
                for (const auto& [c, m] : *side) weight[c] += m;
            both[p].assign(weight.begin(), weight.end());
        }
        paths_.emplace_back(mesh, interface);
        pairs_.emplace_back(interface.node_a.size());
        frames_.push_back(interface.frame);
    }
}

bool TurnedJumps::turn(const TurnedBodies& bodies, const Touching& cells, const Vector3& normal, const Vector3& apart,
                       Turn& turn) {
    Matrix3 sum{};
    for (const auto& [c, weight] : cells)
        for (std::size_t i = 0; i < 9; ++i) sum[i] += weight * bodies.rotation(c)[i];
    const Matrix3& one = bodies.rotation(cells.front().first);
    if (polar_decomposition(sum, turn.rotation, turn.stretch)) {
        const double cosine = angle_cosine(one, turn.rotation), depth = -dot(times(turn.rotation, normal), apart);
        if (cosine > away && (cosine > aligned || depth < bodies.radius(cells.front().first))) return true;
    }
    turn.rotation = product(shortest_turn(times(one, normal), apart), one);
    turn.stretch = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    return false;
}

std::optional<TurnedJumps::Slid> TurnedJumps::slide(const TurnedBodies& bodies, std::size_t interface,
                                                    std::size_t pair) const {
    const Pair& own = pairs_[interface][pair];
    const SlidePaths& paths = paths_[interface];
    const Vector3 back = transposed_times(own.turn.rotation, own.apart);
    const double* frame = &problem_.mesh->interfaces()[interface].frame[pair * dimension_ * dimension_];
    double opening = 0.0;
    for (std::size_t k = 0; k < dimension_; ++k) opening += frame[k] * back[k];
    Vector3 slide = back;
    for (std::size_t k = 0; k < dimension_; ++k) slide[k] -= opening * frame[k];
    Slid slid{length(slide) / paths.spacing(pair), {}, {}, {}};
    if (opening > paths.spacing(pair) || !(slid.length > no_slide)) return {};
    std::map<std::int64_t, std::pair<double, Vector3>> cells;
    const SlidePaths::Path path = paths.along(pair, slide);
    for (const auto& [parts, touching] : {std::pair(&path.first, &first_), std::pair(&path.second, &second_)})
        for (const SlidePaths::Part& part : *parts)
            for (const auto& [c, m] : (*touching)[interface][part.pair]) {
                auto& [weight, slope] = cells[c];
                weight += m * part.weight;
                for (std::size_t k = 0; k < 3; ++k) slope[k] += m * part.slope[k];
            }
    for (const auto& [c, of] : cells) {
        slid.cells.emplace_back(c, of.first);
        slid.slope.emplace_back(c, of.second);
    }
    Vector3 normal{};
    std::copy_n(frame, dimension_, normal.begin());
    if (!turn(bodies, slid.cells, normal, own.apart, slid.turn)) return {};
    return slid;
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
            Pair& own = pairs_[i][p];
            own.apart = apart(interface, p, displacement);
            own.slid.reset();
            if (touching_[i][p].empty()) continue;
            Vector3 normal{};
            std::copy_n(&interface.frame[p * dimension_ * dimension_], dimension_, normal.begin());
            if (turn(bodies, touching_[i][p], normal, own.apart, own.turn)) own.slid = slide(bodies, i, p);
            const Matrix3& rotation = own.slid ? own.slid->turn.rotation : own.turn.rotation;
            for (std::size_t r = 0; r < dimension_; ++r) {
                const std::size_t at = (p * dimension_ + r) * dimension_;
                Vector3 q{};
                std::copy_n(&interface.frame[at], dimension_, q.begin());
                q = times(rotation, q);
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
            const Vector3& d = pairs_[i][e / (dimension_ * dimension_)].apart;
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
            const Vector3& d = pairs_[i][e / (dimension_ * dimension_)].apart;
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
        add_pull(geometry, p, pull, force);
    }
}

void TurnedJumps::add_pull(const InterfaceGeometry& interface, std::size_t pair, const Vector3& pull,
                           std::span<double> force) const {
    for (const auto& [node, sign] : {std::pair(interface.node_b[pair], 1.0), std::pair(interface.node_a[pair], -1.0)})
        for (const auto& [carrier, weight] : carriers_.of(node))
            for (std::size_t k = 0; k < dimension_; ++k)
                force[index(carrier) * dimension_ + k] += sign * weight * pull[k];
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

Vector3 TurnedJumps::turning(const Turn& turn, const Vector3& pull, const Vector3& apart) {
    return times(spin_inverse(turn.stretch), transposed_times(turn.rotation, cross(pull, apart)));
}

void TurnedJumps::add_couples(const TurnedBodies& bodies, const Turn& turn, const Touching& cells,
                              const Vector3& turning, std::span<double> force) {
    for (const auto& [c, weight] : cells) {
        const Matrix3 s = transposed_times(turn.rotation, bodies.rotation(c));
        const Vector3 turned_back = transposed_times(s, turning);
        const double trace = s[0] + s[4] + s[8];
        Vector3 couple{};
        for (std::size_t k = 0; k < 3; ++k) couple[k] = weight * (trace * turning[k] - turned_back[k]);
        bodies.add_couple(c, times(turn.rotation, couple), force);
    }
}

template <class Visit>
void TurnedJumps::each_pulled(std::span<const double> row_force, const Visit& visit) const {
    std::size_t first = 0;  // row
    for (std::size_t i = 0; i < touching_.size(); ++i)
        for (std::size_t p = 0; p < touching_[i].size(); ++p, first += dimension_) {
            const std::span<const double> own = row_force.subspan(first, dimension_);
            if (touching_[i][p].empty() || std::all_of(own.begin(), own.end(), [](double t) { return t == 0.0; }))
                continue;
            Vector3 pull{};
            for (std::size_t r = 0; r < dimension_; ++r)
                for (std::size_t k = 0; k < dimension_; ++k)
                    pull[k] += own[r] * frames_[i][(p * dimension_ + r) * dimension_ + k];
            visit(i, p, pull);
        }
}

void TurnedJumps::add_couples(const TurnedBodies& bodies, std::span<const double> row_force,
                              std::span<double> force) const {
    each_pulled(row_force, [&](std::size_t i, std::size_t p, const Vector3& pull) {
        const Pair& pair = pairs_[i][p];
        const Turn& turn = pair.slid ? pair.slid->turn : pair.turn;
        add_couples(bodies, turn, pair.slid ? pair.slid->cells : touching_[i][p], turning(turn, pull, pair.apart),
                    force);
    });
}

double TurnedJumps::longest_slide(std::span<const double> row_force) const {
    double longest = 0.0;
    each_pulled(row_force, [&](std::size_t i, std::size_t p, const Vector3&) {
        if (const std::optional<Slid>& slid = pairs_[i][p].slid) longest = std::max(longest, slid->length);
    });
    return longest;
}

// The frame turns with the slide s by  J^-1 sum_c (R^T R_c - R_c^T R) dm_c/ds.
void TurnedJumps::add_slides(const TurnedBodies& bodies, std::span<const double> row_force,
                             std::span<double> force) const {
    each_pulled(row_force, [&](std::size_t i, std::size_t p, const Vector3& pull) {
        const Pair& pair = pairs_[i][p];
        if (!pair.slid) return;
        const Turn& turn = pair.slid->turn;
        const Vector3 turns = turning(turn, pull, pair.apart);
        Vector3 along{};  // in the geometry of the mesh
        for (const auto& [c, slope] : pair.slid->slope) {
            const Matrix3 s = transposed_times(turn.rotation, bodies.rotation(c));
            const double work = dot(Vector3{s[7] - s[5], s[2] - s[6], s[3] - s[1]}, turns);
            for (std::size_t k = 0; k < 3; ++k) along[k] += work * slope[k];
        }
        const InterfaceGeometry& interface = problem_.mesh->interfaces()[i];
        const double* normal = &interface.frame[p * dimension_ * dimension_];
        double part = 0.0;
        for (std::size_t k = 0; k < dimension_; ++k) part += normal[k] * along[k];
        for (std::size_t k = 0; k < dimension_; ++k) along[k] -= part * normal[k];
        const Vector3 pull_along = times(pair.turn.rotation, along);
        add_pull(interface, p, pull_along, force);
        add_couples(bodies, pair.turn, touching_[i][p], turning(pair.turn, pull_along, pair.apart), force);
    });
}

}  // namespace delam
