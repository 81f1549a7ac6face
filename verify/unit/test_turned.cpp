// SPDX-License-Identifier: BSD-3-Clause
// Cells with small strains and any rotation: force and tangent against differences of the energy, and rigid motions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "all_types.hpp"
#include "body/element.hpp"
#include "body/turned/initial_stress.hpp"
#include "body/turned/turned_bodies.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"

using namespace delam;

namespace {

std::size_t size(std::int64_t n) { return static_cast<std::size_t>(n); }

// One cell of a block with the sides 1.3, 0.9 (and 0.7), its corners moved at random.
struct OneCell {
    std::size_t dim;
    std::vector<double> nodes;
    std::vector<TurnedCell> cell;

    explicit OneCell(CellType type) : dim(size(topology(type).dimension)) {
        constexpr std::int64_t one[] = {1, 1};
        constexpr double sides[] = {1.3, 0.7}, thickness[] = {0.9};
        const Mesh plain = make_layers(static_cast<int>(dim), std::span(sides).first(dim - 1),
                                       std::span(one).first(dim - 1), thickness, std::span(one).first(1), type);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> shift(-0.03, 0.03);
        std::vector<double> moved(plain.nodes().begin(), plain.nodes().end());
        for (double& x : moved) x += shift(random);
        Mesh mesh(static_cast<int>(dim), moved);
        const std::vector<std::int64_t> connectivity(plain.cell(0).begin(), plain.cell(0).end());
        mesh.add_cells(type, connectivity, {});
        const BodyModel model{Elastic{3.0, 0.3}, Plane::strain, default_formulations(mesh)[0], nullptr};
        cell = turned_cells(mesh, std::span(&model, 1));
        for (const std::int64_t node : connectivity)
            nodes.insert(nodes.end(), moved.begin() + static_cast<std::ptrdiff_t>(size(node) * dim),
                         moved.begin() + static_cast<std::ptrdiff_t>(size(node + 1) * dim));
    }

    // Turned by 2.2 about an axis (in the plane: its normal), moved, and strained by about 0.05 at random.
    std::vector<double> displaced(double strain) const {
        const double angle = 2.2, c = std::cos(angle), s = std::sin(angle);
        const Vector3 axis = dim == 2 ? Vector3{0, 0, 1} : Vector3{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
        std::mt19937 random(5);
        std::uniform_real_distribution<double> shift(-strain, strain);
        std::vector<double> u;
        for (std::size_t n = 0; n < nodes.size() / dim; ++n) {
            Vector3 x{};
            std::copy_n(&nodes[n * dim], dim, x.begin());
            const Vector3 side = cross(axis, x);
            const double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
            for (std::size_t k = 0; k < dim; ++k)
                u.push_back(c * x[k] + s * side[k] + (1.0 - c) * along * axis[k] + 0.4 + shift(random) - x[k]);
        }
        return u;
    }
};

// A difference quotient of fourth order.
std::vector<double> difference(const std::function<std::vector<double>(double)>& f) {
    constexpr double h = 1e-3;
    const std::vector<double> a = f(-2 * h), b = f(-h), c = f(h), d = f(2 * h);
    std::vector<double> slope(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) slope[i] = (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h);
    return slope;
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

}  // namespace

LOOP_TEST(force_is_the_derivative_of_the_energy, 0, std::size(all_types)) {
    OneCell one(all_types[size(loop)]);
    const std::vector<double> u = one.displaced(0.05);
    TurnedCell& cell = one.cell[0];
    std::vector<double> force(u.size(), 0.0), slope;
    ck_assert(cell.move(u));
    cell.add_force(force);
    for (std::size_t i = 0; i < u.size(); ++i)
        slope.push_back(difference([&](double t) {
            std::vector<double> moved = u;
            moved[i] += t;
            ck_assert(cell.move(moved));
            return std::vector<double>{cell.energy()};
        })[0]);
    ck_assert_double_lt(largest_difference(force, slope), 1e-8 * max_abs(force));
}

LOOP_TEST(tangent_is_the_derivative_of_the_force, 0, std::size(all_types)) {
    OneCell one(all_types[size(loop)]);
    const std::vector<double> u = one.displaced(0.05);
    TurnedCell& cell = one.cell[0];
    std::vector<double> tangent(u.size() * u.size());
    ck_assert(cell.move(u));
    cell.tangent(tangent);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const std::vector<double> slope = difference([&](double t) {
            std::vector<double> moved = u, force(u.size(), 0.0);
            moved[i] += t;
            ck_assert(cell.move(moved));
            cell.add_force(force);
            return force;
        });
        ck_assert_double_lt(largest_difference(std::span(tangent).subspan(i * u.size(), u.size()), slope),
                            1e-8 * max_abs(tangent));
    }
}

LOOP_TEST(rigid_motion_has_no_energy_and_its_rotation_is_the_frame, 0, std::size(all_types)) {
    OneCell one(all_types[size(loop)]);
    TurnedCell& cell = one.cell[0];
    ck_assert(cell.move(one.displaced(0.0)));
    ck_assert_double_lt(cell.energy(), 1e-28);
    const Matrix3& r = cell.rotation();
    ck_assert_double_eq_tol(r[0] + r[4] + r[8], 1.0 + 2.0 * std::cos(2.2), 1e-13);
    ck_assert_double_lt(max_abs(cell.local_displacement()), 1e-14);
}

LOOP_TEST(couple_does_the_work_of_the_turning_frame, 0, std::size(all_types)) {
    OneCell one(all_types[size(loop)]);
    const std::vector<double> u = one.displaced(0.05);
    TurnedCell& cell = one.cell[0];
    const Vector3 couple = one.dim == 2 ? Vector3{0, 0, 1.7} : Vector3{0.3, -1.1, 0.7};
    std::vector<double> force(u.size(), 0.0);
    ck_assert(cell.move(u));
    cell.add_couple(couple, force);
    const Matrix3 at = cell.rotation();
    for (std::size_t i = 0; i < u.size(); ++i) {
        const std::vector<double> turning = difference([&](double t) {
            std::vector<double> moved = u;
            moved[i] += t;
            ck_assert(cell.move(moved));
            return std::vector<double>(cell.rotation().begin(), cell.rotation().end());
        });
        Matrix3 spin{};  // dR R^T
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                for (std::size_t k = 0; k < 3; ++k) spin[a * 3 + b] += turning[a * 3 + k] * at[b * 3 + k];
        const double work = couple[0] * spin[7] + couple[1] * spin[2] + couple[2] * spin[3];
        ck_assert_double_eq_tol(force[i], work, 1e-8 * max_abs(force));
    }
}

TEST(cell_that_is_inside_out_is_told) {
    OneCell one(CellType::quad4);
    std::vector<double> u = one.displaced(0.0);
    for (std::size_t n = 0; n < u.size() / 2; ++n) u[2 * n] = -2.0 * one.nodes[2 * n];
    for (std::size_t n = 0; n < u.size() / 2; ++n) u[2 * n + 1] = 0.0;
    ck_assert(!one.cell[0].move(u));
}

// The work of a constant stress on displacements with a constant gradient H is V s : H^T H / 2, for every kind of cell.
LOOP_TEST(stresses_work_on_rotations, 0, std::size(all_types)) {
    const CellType type = all_types[size(loop)];
    const OneCell one(type);
    const std::size_t dim = one.dim, columns = dim == 2 ? 4 : 6;
    Mesh mesh(static_cast<int>(dim), one.nodes);
    std::vector<std::int64_t> connectivity(one.nodes.size() / dim);
    std::iota(connectivity.begin(), connectivity.end(), std::int64_t{0});
    mesh.add_cells(type, connectivity, {});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<double> stress(columns), slope(dim * dim), u;
    for (double& s : stress) s = any(random);
    for (double& h : slope) h = any(random);
    for (std::size_t n = 0; n < one.nodes.size(); n += dim)
        for (std::size_t i = 0; i < dim; ++i) {
            u.push_back(0.0);
            for (std::size_t j = 0; j < dim; ++j) u.back() += slope[i * dim + j] * one.nodes[n + j];
        }
    constexpr std::size_t place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // xx, yy, zz, xy, yz, zx
    double density = 0.0;
    for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j)
            for (std::size_t k = 0; k < dim; ++k)
                density += slope[i * dim + j] * stress[place[j][k]] * slope[i * dim + k];
    std::vector<double> gradients(one.nodes.size());
    const double volume = integrate_gradients(type, one.nodes, gradients);
    const std::vector<double> force = InitialStress(mesh, stress).softening(u);
    double work = 0.0, sum = 0.0, on_rotations = 0.0;
    for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j)
            for (std::size_t k = 0; k < dim; ++k)
                on_rotations += 0.125 * volume * (slope[k * dim + i] - slope[i * dim + k]) * stress[place[i][j]] *
                                (slope[k * dim + j] - slope[j * dim + k]);
    ck_assert_double_eq_tol(InitialStress(mesh, stress).work_on_rotations(u), on_rotations, 1e-12 * volume);
    for (std::size_t i = 0; i < force.size(); ++i) {
        work -= force[i] * u[i];
        sum += force[i];
    }
    ck_assert_double_eq_tol(work, volume * density, 1e-12 * volume);
    ck_assert_double_eq_tol(sum, 0.0, 1e-12);
    // A stress that is not known does no work.
    stress.assign(columns, std::nan(""));
    for (const double f : InitialStress(mesh, stress).softening(u)) ck_assert(f == 0.0);
}
