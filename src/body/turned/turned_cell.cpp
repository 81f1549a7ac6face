// SPDX-License-Identifier: BSD-3-Clause
#include "body/turned/turned_cell.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"

namespace delam {

namespace {

double determinant(const Matrix3& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

// M^-T
Matrix3 inverse_transposed(const Matrix3& m) {
    const double d = determinant(m);
    Matrix3 c{m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8], m[3] * m[7] - m[4] * m[6],
              m[2] * m[7] - m[1] * m[8], m[0] * m[8] - m[2] * m[6], m[1] * m[6] - m[0] * m[7],
              m[1] * m[5] - m[2] * m[4], m[2] * m[3] - m[0] * m[5], m[0] * m[4] - m[1] * m[3]};
    for (double& v : c) v /= d;
    return c;
}

double trace(const Matrix3& m) { return m[0] + m[4] + m[8]; }

Vector3 plus(const Vector3& a, double factor, const Vector3& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

std::vector<Vector3> centred(std::size_t dimension, std::span<const double> places) {
    std::vector<Vector3> z(places.size() / dimension, Vector3{});
    Vector3 mean{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        z[i / dimension][i % dimension] = places[i];
        mean[i % dimension] += places[i] / static_cast<double>(z.size());
    }
    for (Vector3& p : z) p = plus(p, -1.0, mean);
    return z;
}

}  // namespace

Vector3 times(const Matrix3& m, const Vector3& v) {
    return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
            m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

Vector3 transposed_times(const Matrix3& m, const Vector3& v) {
    return {m[0] * v[0] + m[3] * v[1] + m[6] * v[2], m[1] * v[0] + m[4] * v[1] + m[7] * v[2],
            m[2] * v[0] + m[5] * v[1] + m[8] * v[2]};
}

Matrix3 transposed_times(const Matrix3& a, const Matrix3& b) {
    Matrix3 c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i * 3 + j] += a[k * 3 + i] * b[k * 3 + j];
    return c;
}

// Newton's iteration X <- (X + X^-T) / 2 converges quadratically to the rotation (N. Higham, SIAM J. Sci. Stat. Comput.
// 7 (1986) 1160-1174). Cells are hardly strained, so that five or six steps reach rounding. (Measured by
// verify/bench/constants.py with `analyses.py turned`: half and twice of both numbers move no result by more than
// 3e-7.)
bool polar_decomposition(const Matrix3& a, Matrix3& rotation, Matrix3& stretch) {
    constexpr int most_polar_steps = 60;
    constexpr double at_rest = 4e-16;
    const double scale = max_abs(a);
    if (!(determinant(a) > 0.0) || !std::isfinite(scale)) return false;
    if (a[2] == 0.0 && a[5] == 0.0 && a[6] == 0.0 && a[7] == 0.0 && a[8] > 0.0) {  // in the plane
        const double c = a[0] + a[4], s = a[3] - a[1], size = std::hypot(c, s);
        rotation = {c / size, -s / size, 0.0, s / size, c / size, 0.0, 0.0, 0.0, 1.0};
        stretch = transposed_times(rotation, a);
        stretch[1] = stretch[3] = 0.5 * (stretch[1] + stretch[3]);
        return true;
    }
    rotation = a;
    for (double& v : rotation) v /= scale;
    for (int step = 0; step < most_polar_steps; ++step) {
        const Matrix3 other = inverse_transposed(rotation);
        double change = 0.0;
        for (std::size_t i = 0; i < 9; ++i) {
            const double next = 0.5 * (rotation[i] + other[i]);
            change = std::max(change, std::abs(next - rotation[i]));
            rotation[i] = next;
        }
        if (!(change > at_rest)) break;
    }
    stretch = transposed_times(rotation, a);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j)
            stretch[i * 3 + j] = stretch[j * 3 + i] = 0.5 * (stretch[i * 3 + j] + stretch[j * 3 + i]);
    return true;
}

Matrix3 spin_inverse(const Matrix3& stretch) {
    Matrix3 j;
    for (std::size_t i = 0; i < 9; ++i) j[i] = (i % 4 == 0 ? trace(stretch) : 0.0) - stretch[i];
    return inverse_transposed(j);
}

TurnedCell::TurnedCell(std::size_t dimension, std::span<const double> coordinates, std::span<const double> stiffness)
    : dimension_(dimension),
      coordinates_(coordinates.begin(), coordinates.end()),
      stiffness_(stiffness.begin(), stiffness.end()),
      reference_(centred(dimension, coordinates)) {
    for (const Vector3& z : reference_) size_ += dot(z, z) / static_cast<double>(nodes());
}

std::vector<Vector3> TurnedCell::stiffness_times(const std::vector<Vector3>& d) const {
    std::vector<Vector3> q(nodes(), Vector3{});
    constexpr std::size_t most = 81;  // displacements of a cell
    std::array<double, most> flat;
    const std::size_t size = nodes() * dimension_;
    for (std::size_t n = 0, i = 0; n < nodes(); ++n)
        for (std::size_t k = 0; k < dimension_; ++k) flat[i++] = d[n][k];
    const double* row = stiffness_.data();
    for (std::size_t n = 0; n < nodes(); ++n)
        for (std::size_t k = 0; k < dimension_; ++k, row += size) {
            double sum = 0.0;
            for (std::size_t c = 0; c < size; ++c) sum += row[c] * flat[c];
            q[n][k] = sum;
        }
    return q;
}

bool TurnedCell::move(std::span<const double> displacement) {
    std::vector<double> x = coordinates_;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += displacement[i];
    place_ = centred(dimension_, x);
    const double share = 1.0 / static_cast<double>(nodes());
    Matrix3 a{};
    for (std::size_t n = 0; n < nodes(); ++n)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) a[i * 3 + j] += share * place_[n][i] * reference_[n][j];
    if (dimension_ == 2) a[8] = 0.5 * size_;  // any positive number: nothing turns out of the plane
    if (!polar_decomposition(a, rotation_, stretch_)) return false;
    inverse_ = spin_inverse(stretch_);
    strain_ = place_;
    for (std::size_t n = 0; n < nodes(); ++n) {
        place_[n] = transposed_times(rotation_, place_[n]);
        strain_[n] = plus(place_[n], -1.0, reference_[n]);
    }
    pull_ = stiffness_times(strain_);
    balance(pull_, couple_, force_);
    return true;
}

void TurnedCell::balance(const std::vector<Vector3>& pull, Vector3& couple, std::vector<Vector3>& force) const {
    Vector3 moment{};
    for (std::size_t n = 0; n < nodes(); ++n) moment = plus(moment, 1.0, cross(place_[n], pull[n]));
    couple = times(inverse_, moment);
    force = pull;
    const double share = 1.0 / static_cast<double>(nodes());
    for (std::size_t n = 0; n < nodes(); ++n) force[n] = plus(force[n], -share, cross(couple, reference_[n]));
}

std::vector<Vector3> TurnedCell::pull_along(std::span<const double> displacement) const {
    std::vector<Vector3> v(nodes(), Vector3{});
    Vector3 turn{};
    for (std::size_t n = 0; n < nodes(); ++n) {
        std::copy_n(&displacement[n * dimension_], dimension_, v[n].begin());
        v[n] = transposed_times(rotation_, v[n]);
        turn = plus(turn, 1.0 / static_cast<double>(nodes()), cross(reference_[n], v[n]));
    }
    turn = times(inverse_, turn);
    for (std::size_t n = 0; n < nodes(); ++n) v[n] = plus(v[n], -1.0, cross(turn, place_[n]));
    return stiffness_times(v);
}

double TurnedCell::energy() const {
    double twice = 0.0;
    for (std::size_t n = 0; n < nodes(); ++n) twice += dot(strain_[n], pull_[n]);
    return 0.5 * twice;
}

void TurnedCell::add_force(std::span<double> force) const {
    for (std::size_t n = 0; n < nodes(); ++n) {
        const Vector3 f = times(rotation_, force_[n]);
        for (std::size_t k = 0; k < dimension_; ++k) force[n * dimension_ + k] += f[k];
    }
}

// Column by column: the change of the force in the frame as one node moves along one of its axes. A motion of all nodes
// together has no force, so that S dd is a column of S and what the turning of the frame adds.
void TurnedCell::tangent(std::span<double> matrix, Stresses stresses, const std::vector<Vector3>& pull) const {
    Vector3 own_couple{};
    std::vector<Vector3> own_force;
    balance(pull, own_couple, own_force);
    const std::size_t size = nodes() * dimension_;
    const double share = 1.0 / static_cast<double>(nodes());
    std::vector<double> local(size * size);
    std::array<std::vector<Vector3>, 3> turning;  // S (y x e) for each axis e
    for (std::size_t axis = dimension_ == 2 ? 2 : 0; axis < 3; ++axis) {
        Vector3 e{};
        e[axis] = 1.0;
        std::vector<Vector3> turned;
        for (const Vector3& y : place_) turned.push_back(cross(y, e));
        turning[axis] = stiffness_times(turned);
    }
    std::vector<Vector3> moved(nodes()), pulled(nodes());
    for (std::size_t column = 0; column < size; ++column) {
        Vector3 v{};
        v[column % dimension_] = 1.0;
        const Vector3& z = reference_[column / dimension_];
        Vector3 w = times(inverse_, cross(z, v));
        for (double& c : w) c *= share;
        Matrix3 du{};  // of U: R^T dA - w x U
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector3 turned = cross(w, {stretch_[j], stretch_[3 + j], stretch_[6 + j]});
            for (std::size_t i = 0; i < 3; ++i) du[i * 3 + j] = share * v[i] * z[j] - turned[i];
        }
        for (std::size_t n = 0; n < nodes(); ++n) {
            moved[n] = plus(cross(place_[n], w), n == column / dimension_ ? 1.0 - share : -share, v);
            pulled[n] = {};
            for (std::size_t k = 0; k < dimension_; ++k)
                pulled[n][k] = stiffness_[(n * dimension_ + k) * size + column];
            for (std::size_t axis = dimension_ == 2 ? 2 : 0; axis < 3; ++axis)
                pulled[n] = plus(pulled[n], w[axis], turning[axis][n]);
        }
        const double stressed = stresses == Stresses::count ? 1.0 : 0.0;
        Vector3 moment{};
        for (std::size_t n = 0; n < nodes(); ++n)
            moment = plus(plus(moment, stressed, cross(moved[n], pull[n])), 1.0, cross(place_[n], pulled[n]));
        moment = plus(plus(moment, -stressed * trace(du), own_couple), stressed, times(du, own_couple));
        const Vector3 couple = times(inverse_, moment);
        for (std::size_t n = 0; n < nodes(); ++n) {
            const Vector3 f =
                plus(plus(pulled[n], -share, cross(couple, reference_[n])), stressed, cross(w, own_force[n]));
            for (std::size_t k = 0; k < dimension_; ++k) local[(n * dimension_ + k) * size + column] = f[k];
        }
    }
    // R K R^T, block by block; the mean with the transpose removes rounding.
    for (std::size_t a = 0; a < nodes(); ++a)
        for (std::size_t b = 0; b < nodes(); ++b)
            for (std::size_t i = 0; i < dimension_; ++i)
                for (std::size_t j = 0; j < dimension_; ++j) {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < dimension_; ++k)
                        for (std::size_t l = 0; l < dimension_; ++l)
                            sum += rotation_[i * 3 + k] * rotation_[j * 3 + l] *
                                   local[(a * dimension_ + k) * size + b * dimension_ + l];
                    matrix[(a * dimension_ + i) * size + b * dimension_ + j] = sum;
                }
    for (std::size_t r = 0; r < size; ++r)
        for (std::size_t c = 0; c < r; ++c)
            matrix[r * size + c] = matrix[c * size + r] = 0.5 * (matrix[r * size + c] + matrix[c * size + r]);
}

void TurnedCell::add_couple(const Vector3& couple, std::span<double> force) const {
    const Vector3 a = times(inverse_, transposed_times(rotation_, couple));
    for (std::size_t n = 0; n < nodes(); ++n) {
        const Vector3 f = times(rotation_, cross(a, reference_[n]));
        for (std::size_t k = 0; k < dimension_; ++k) force[n * dimension_ + k] += f[k] / static_cast<double>(nodes());
    }
}

std::vector<double> TurnedCell::local_displacement() const {
    std::vector<double> d;
    for (const Vector3& s : strain_) d.insert(d.end(), s.begin(), s.begin() + static_cast<std::ptrdiff_t>(dimension_));
    return d;
}

}  // namespace delam
