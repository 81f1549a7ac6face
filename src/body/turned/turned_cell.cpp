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

// Sets the places of nodes [nodes][dimension] from their mean.
void set_centred(std::size_t dimension, std::span<const double> places, std::vector<Vector3>& z) {
    z.assign(places.size() / dimension, Vector3{});
    Vector3 mean{};
    for (std::size_t n = 0, i = 0; n < z.size(); ++n)
        for (std::size_t k = 0; k < dimension; ++k, ++i) {
            z[n][k] = places[i];
            mean[k] += places[i] / static_cast<double>(z.size());
        }
    for (Vector3& p : z) p = plus(p, -1.0, mean);
}

constexpr std::size_t most_displacements = 81;  // of a cell

}  // namespace

Vector3 times(const Matrix3& m, const Vector3& v) {
    return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
            m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

Vector3 transposed_times(const Matrix3& m, const Vector3& v) {
    return {m[0] * v[0] + m[3] * v[1] + m[6] * v[2], m[1] * v[0] + m[4] * v[1] + m[7] * v[2],
            m[2] * v[0] + m[5] * v[1] + m[8] * v[2]};
}

Matrix3 transposed(const Matrix3& m) { return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}; }

void turn_tensor(const Matrix3& rotation, std::span<double> s) {
    constexpr std::size_t without_zz[] = {0, 4, 1}, in_plane[] = {0, 4, 8, 1}, in_space[] = {0, 4, 8, 1, 5, 2};
    const std::span<const std::size_t> entry = s.size() == 3   ? std::span<const std::size_t>(without_zz)
                                               : s.size() == 4 ? std::span<const std::size_t>(in_plane)
                                                               : std::span<const std::size_t>(in_space);
    Matrix3 tensor{};
    for (std::size_t e = 0; e < s.size(); ++e) tensor[entry[e]] = tensor[entry[e] % 3 * 3 + entry[e] / 3] = s[e];
    const Matrix3 back = transposed(rotation);
    const Matrix3 turned = transposed_times(back, transposed_times(tensor, back));
    for (std::size_t e = 0; e < s.size(); ++e) s[e] = turned[entry[e]];
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
      stiffness_(stiffness.begin(), stiffness.end()) {
    set_centred(dimension, coordinates, reference_);
    for (const Vector3& z : reference_) size_ += dot(z, z) / static_cast<double>(nodes());
}

void TurnedCell::stiffness_times(std::span<const Vector3> d, std::vector<Vector3>& q) const {
    q.assign(nodes(), Vector3{});
    std::array<double, most_displacements> flat;
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
}

bool TurnedCell::move(std::span<const double> displacement) {
    std::array<double, most_displacements> x;
    const std::size_t size = coordinates_.size();
    for (std::size_t i = 0; i < size; ++i) x[i] = coordinates_[i] + displacement[i];
    set_centred(dimension_, std::span(x).first(size), place_);
    const double share = 1.0 / static_cast<double>(nodes());
    Matrix3 a{};
    for (std::size_t n = 0; n < nodes(); ++n)
        for (std::size_t i = 0; i < dimension_; ++i)
            for (std::size_t j = 0; j < dimension_; ++j) a[i * 3 + j] += share * place_[n][i] * reference_[n][j];
    if (dimension_ == 2) a[8] = 0.5 * size_;  // any positive number: nothing turns out of the plane
    if (!polar_decomposition(a, rotation_, stretch_)) return false;
    inverse_ = spin_inverse(stretch_);
    strain_.resize(nodes());
    for (std::size_t n = 0; n < nodes(); ++n) {
        place_[n] = transposed_times(rotation_, place_[n]);
        strain_[n] = plus(place_[n], -1.0, reference_[n]);
    }
    stiffness_times(strain_, pull_);
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
    std::vector<Vector3> v(nodes(), Vector3{}), change;
    Vector3 turn{};
    for (std::size_t n = 0; n < nodes(); ++n) {
        std::copy_n(&displacement[n * dimension_], dimension_, v[n].begin());
        v[n] = transposed_times(rotation_, v[n]);
        turn = plus(turn, 1.0 / static_cast<double>(nodes()), cross(reference_[n], v[n]));
    }
    turn = times(inverse_, turn);
    for (std::size_t n = 0; n < nodes(); ++n) v[n] = plus(v[n], -1.0, cross(turn, place_[n]));
    stiffness_times(v, change);
    return change;
}

double TurnedCell::work(const std::vector<Vector3>& pull) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < nodes(); ++n) sum += dot(strain_[n], pull[n]);
    return sum;
}

double TurnedCell::energy() const { return 0.5 * work(pull_); }

void TurnedCell::add_force_of(const std::vector<Vector3>& pull, std::span<double> force) const {
    Vector3 couple{};
    std::vector<Vector3> of_frame;
    balance(pull, couple, of_frame);
    add_force(of_frame, force);
}

void TurnedCell::add_force(const std::vector<Vector3>& of_frame, std::span<double> force) const {
    for (std::size_t n = 0; n < nodes(); ++n) {
        const Vector3 f = times(rotation_, of_frame[n]);
        for (std::size_t k = 0; k < dimension_; ++k) force[n * dimension_ + k] += f[k];
    }
}

// With w = G v, dd = P v and P = I + Y G, where the rows of Y are [y_n]x, the stiffness alone gives P^T S P. The
// stresses q add w x f to the force, and to the moment v_m x q_m + sum (y_n x w) x q_n + (du - tr(du)) a, where U
// changes by du = 1/n v z^T - w x U. A motion of all nodes together has no force.
void TurnedCell::tangent(std::span<double> matrix, Stresses stresses, const std::vector<Vector3>& pull) const {
    const std::size_t size = nodes() * dimension_, first = dimension_ == 2 ? 2 : 0;
    const double share = 1.0 / static_cast<double>(nodes());
    std::array<Vector3, most_displacements> turn, resisted;  // columns of G; rows of S Y
    for (std::size_t column = 0; column < size; ++column) {
        Vector3 v{};
        v[column % dimension_] = share;
        turn[column] = times(inverse_, cross(reference_[column / dimension_], v));
    }
    for (std::size_t row = 0; row < size; ++row) {
        resisted[row] = {};
        for (std::size_t n = 0; n < nodes(); ++n) {
            Vector3 s{};
            std::copy_n(&stiffness_[row * size + n * dimension_], dimension_, s.begin());
            resisted[row] = plus(resisted[row], 1.0, cross(s, place_[n]));
        }
    }
    Matrix3 both{};  // Y^T S Y
    for (std::size_t n = 0; n < nodes(); ++n)
        for (std::size_t axis = first; axis < 3; ++axis) {
            Vector3 s{};
            for (std::size_t k = 0; k < dimension_; ++k) s[k] = resisted[n * dimension_ + k][axis];
            const Vector3 sum = cross(s, place_[n]);
            for (std::size_t i = first; i < 3; ++i) both[i * 3 + axis] += sum[i];
        }
    for (std::size_t column = 0; column < size; ++column) {
        const Vector3 moved = plus(resisted[column], 1.0, times(both, turn[column]));
        for (std::size_t row = 0; row < size; ++row) {
            double sum = stiffness_[row * size + column];
            for (std::size_t i = first; i < 3; ++i) sum += resisted[row][i] * turn[column][i] + turn[row][i] * moved[i];
            matrix[row * size + column] = sum;
        }
    }
    if (stresses == Stresses::count) add_stresses(std::span(turn).first(size), pull, matrix);
    turn_blocks(matrix);
}

// turn: the columns of G.
void TurnedCell::add_stresses(std::span<const Vector3> turn, const std::vector<Vector3>& pull,
                              std::span<double> matrix) const {
    Vector3 couple{};
    std::vector<Vector3> force;
    balance(pull, couple, force);
    const std::size_t size = turn.size(), first = dimension_ == 2 ? 2 : 0;
    const double share = 1.0 / static_cast<double>(nodes());
    double along = 0.0;
    Matrix3 across{};  // sum y q^T
    for (std::size_t n = 0; n < nodes(); ++n) {
        along += dot(place_[n], pull[n]);
        for (std::size_t i = 0; i < dimension_; ++i)
            for (std::size_t j = 0; j < dimension_; ++j) across[i * 3 + j] += place_[n][i] * pull[n][j];
    }
    const Vector3 stretched = times(stretch_, couple);
    for (std::size_t column = 0; column < size; ++column) {
        const std::size_t node = column / dimension_, axis = column % dimension_;
        const Vector3 &w = turn[column], &z = reference_[node];
        Vector3 v{};
        v[axis] = 1.0;
        Vector3 moment = plus(cross(v, pull[node]), along, w);
        moment = plus(plus(moment, -1.0, times(across, w)), -share * z[axis], couple);
        moment = plus(plus(moment, share * dot(z, couple), v), -1.0, cross(w, stretched));
        for (std::size_t n = 0; n < nodes(); ++n) {
            const Vector3 turned = cross(w, force[n]);
            for (std::size_t k = 0; k < dimension_; ++k) {
                double sum = turned[k];
                for (std::size_t i = first; i < 3; ++i) sum -= turn[n * dimension_ + k][i] * moment[i];
                matrix[(n * dimension_ + k) * size + column] += sum;
            }
        }
    }
}

// R K R^T, block by block; the mean with the transpose removes rounding.
void TurnedCell::turn_blocks(std::span<double> matrix) const {
    const std::size_t size = nodes() * dimension_;
    for (std::size_t a = 0; a < nodes(); ++a)
        for (std::size_t b = 0; b <= a; ++b) {
            Matrix3 block{}, half{};  // K, K R^T
            for (std::size_t i = 0; i < dimension_; ++i)
                for (std::size_t j = 0; j < dimension_; ++j)
                    block[i * 3 + j] = 0.5 * (matrix[(a * dimension_ + i) * size + b * dimension_ + j] +
                                              matrix[(b * dimension_ + j) * size + a * dimension_ + i]);
            for (std::size_t i = 0; i < dimension_; ++i)
                for (std::size_t j = 0; j < dimension_; ++j)
                    for (std::size_t k = 0; k < dimension_; ++k)
                        half[i * 3 + j] += block[i * 3 + k] * rotation_[j * 3 + k];
            for (std::size_t i = 0; i < dimension_; ++i)
                for (std::size_t j = 0; j < dimension_; ++j) {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < dimension_; ++k) sum += rotation_[i * 3 + k] * half[k * 3 + j];
                    matrix[(a * dimension_ + i) * size + b * dimension_ + j] = sum;
                    matrix[(b * dimension_ + j) * size + a * dimension_ + i] = sum;
                }
            if (a != b) continue;
            for (std::size_t i = 0; i < dimension_; ++i)
                for (std::size_t j = 0; j < i; ++j)
                    matrix[(a * dimension_ + i) * size + a * dimension_ + j] =
                        matrix[(a * dimension_ + j) * size + a * dimension_ + i];
        }
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
