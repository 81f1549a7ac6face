// SPDX-License-Identifier: BSD-3-Clause
// Interfaces whose frames turn: the forces on the nodes are the derivative of an energy of the jumps, in the plane and
// in space, and a rigid motion opens nothing.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "body/turned/turned_bodies.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "reduction/turned/turned_jumps.hpp"
#include "reduction/turned/turned_operator.hpp"
#include "scene/carriers.hpp"
#include "scene/problem.hpp"

using namespace delam;

namespace {

// Two layers on each other, three cells (by two) along them.
struct Layers {
    Problem problem;
    std::unique_ptr<Carriers> carriers;
    std::unique_ptr<TurnedBodies> bodies;
    std::unique_ptr<TurnedJumps> jumps;

    explicit Layers(int dimension) : problem(mesh(dimension)) {
        for (auto& material : problem.material) material = Elastic{1.0, 0.3};
        carriers = std::make_unique<Carriers>(problem);
        const std::vector<BodyModel> models{problem.model(0), problem.model(1)};
        bodies = std::make_unique<TurnedBodies>(*problem.mesh, models);
        jumps = std::make_unique<TurnedJumps>(problem, *carriers);
    }
    static std::shared_ptr<const Mesh> mesh(int dimension) {
        constexpr double sides[] = {3.0, 2.0}, thickness[] = {0.7, 0.4};
        constexpr std::int64_t cells[] = {3, 2}, one[] = {1, 1};
        const auto across = static_cast<std::size_t>(dimension) - 1;
        auto mesh = std::make_shared<Mesh>(make_layers(dimension, std::span(sides).first(across),
                                                       std::span(cells).first(across), thickness, one,
                                                       dimension == 2 ? CellType::quad4 : CellType::hex8));
        add_interface(*mesh, 0, 1, 1e-6);
        return mesh;
    }
    // Turned by an angle about an axis, and moved at random besides. slide: of the upper layer along the lower one.
    std::vector<double> displaced(double angle, double random_part, double slide = 0.0) const {
        const auto dim = static_cast<std::size_t>(problem.mesh->dimension());
        const double c = std::cos(angle), s = std::sin(angle);
        const Point axis = dim == 2 ? Point{0, 0, 1} : Point{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
        std::mt19937 random(11);
        std::uniform_real_distribution<double> shift(-random_part, random_part);
        std::vector<double> u;
        for (std::int64_t n = 0; n < problem.mesh->node_count(); ++n) {
            const Point x = position(*problem.mesh, n);
            Point slid = x;
            if (problem.mesh->node_body(n) == 1) slid[0] += slide;
            const Point side = cross(axis, slid);
            for (std::size_t k = 0; k < dim; ++k)
                u.push_back(c * slid[k] + s * side[k] + (1.0 - c) * dot(axis, slid) * axis[k] - x[k] + shift(random));
        }
        return u;
    }
    std::vector<double> at(std::span<const double> u) const {
        bodies->move(u);
        jumps->move(*bodies, u);
        return jumps->jumps({});
    }
};

// Springs of their own for all rows.
double spring(std::size_t row) { return 1.0 + 0.3 * static_cast<double>(row % 7); }

double energy(const std::vector<double>& jump) {
    double sum = 0.0;
    for (std::size_t r = 0; r < jump.size(); ++r) sum += 0.5 * spring(r) * jump[r] * jump[r];
    return sum;
}

}  // namespace

// Faces rest on each other, or have slid by more than the spacing of the pairs.
// A state remembers a point, with the way to it or without, and the operator's numbers; earlier states have the point
// alone, after a number that tells of its stresses.
LOOP_TEST(a_state_remembers_its_linear_scene, 0, 8) {
    using Stresses = TurnedCell::Stresses;
    const std::vector<double> at{1.0, 2.0, 3.0, 4.0}, place{5.0, 6.0, 7.0, 8.0}, theta{0.5};
    const bool moved = loop % 2 != 0, own = loop / 2 % 2 != 0;
    TurnedMemory memory;
    memory.point = {place, {}, {}, loop < 4 ? Stresses::count : Stresses::left_out, theta};
    if (moved) memory.point.from = memory.point.along = at;
    if (own) memory.of_operator = {0.0, -1.0, 9.0};
    std::vector<double> numbers = memory.numbers();
    const TurnedMemory again = TurnedMemory::of(numbers, at, theta);
    ck_assert(again.point == memory.point && again.of_operator == memory.of_operator);
    if (own) return;
    numbers.front() = loop < 4 ? 1.0 : 0.0;
    const TurnedMemory earlier = TurnedMemory::of(numbers, at, theta);
    ck_assert(earlier.point == memory.point && earlier.of_operator.empty());
    const TurnedMemory none = TurnedMemory::of({}, at, theta);
    ck_assert(none.point.displacement == at && none.point.from.empty() && none.of_operator.empty());
}

LOOP_TEST(forces_are_the_derivative_of_the_energy_of_the_jumps, 0, 4) {
    const Layers layers(2 + loop % 2);
    const std::vector<double> u = layers.displaced(1.9, 0.05, loop < 2 ? 0.0 : 1.4);
    std::vector<double> pull = layers.at(u), force(u.size(), 0.0), couples(u.size(), 0.0);
    for (std::size_t r = 0; r < pull.size(); ++r) pull[r] *= spring(r);
    layers.jumps->add_pulls(pull, force);
    layers.jumps->add_couples(*layers.bodies, pull, couples);
    layers.jumps->add_slides(*layers.bodies, pull, couples);
    ck_assert_double_gt(max_abs(couples), 1e-3 * max_abs(force));
    constexpr double h = 1e-3;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto moved = [&](double t) {
            std::vector<double> v = u;
            v[i] += t;
            return energy(layers.at(v));
        };
        const double slope = (moved(-2 * h) - 8 * moved(-h) + 8 * moved(h) - moved(2 * h)) / (12 * h);
        ck_assert_double_eq_tol(force[i] + couples[i], slope, 1e-8 * max_abs(force));
    }
}

LOOP_TEST(rigid_motion_opens_nothing_and_turns_the_frames, 2, 4) {
    const Layers layers(loop);
    const std::vector<double> jump = layers.at(layers.displaced(2.6, 0.0));
    ck_assert_double_lt(max_abs(jump), 1e-13);
    const std::vector<double> frames = layers.jumps->frames(0);
    const std::vector<double>& before = layers.problem.mesh->interfaces()[0].frame;
    const Matrix3& turned = layers.bodies->rotation(0);
    const auto dim = static_cast<std::size_t>(loop);
    for (std::size_t i = 0; i < frames.size(); i += dim) {
        Point q{};
        std::copy_n(&before[i], dim, q.begin());
        for (std::size_t k = 0; k < dim; ++k) ck_assert_double_eq_tol(frames[i + k], times(turned, q)[k], 1e-13);
    }
}
