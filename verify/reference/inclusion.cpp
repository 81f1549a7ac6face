// SPDX-License-Identifier: BSD-3-Clause
#include "inclusion.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace reference {

namespace {

using Complex = std::complex<double>;

struct Potentials {
    Complex phi, phi1, phi2, psi, psi1;  // with derivatives
};

Potentials potentials(bool in_fibre, Complex z, const std::array<double, 8>& c) {
    const auto [A, B, C, a, b, k, G, H] = c;
    if (in_fibre) return {a * z + k * z * z * z, a + 3.0 * k * z * z, 6.0 * k * z, b * z, b};
    const Complex w = 1.0 / z;
    return {G * z + A * w, G - A * w * w, 2.0 * A * w * w * w, H * z + B * w + C * w * w * w,
            H - B * w * w - 3.0 * C * w * w * w * w};
}

// Gaussian elimination with row pivoting.
std::vector<double> solve(std::vector<std::vector<double>> m, std::vector<double> right) {
    const std::size_t n = right.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
        if (m[pivot][k] == 0.0) throw std::runtime_error("inclusion: singular conditions");
        std::swap(m[k], m[pivot]);
        std::swap(right[k], right[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = m[i][k] / m[k][k];
            for (std::size_t j = k; j < n; ++j) m[i][j] -= factor * m[k][j];
            right[i] -= factor * right[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) right[k] -= m[k][j] * right[j];
        right[k] /= m[k][k];
    }
    return right;
}

// Components along and across the ray at angle t.
std::array<double, 2> polar(const std::array<double, 2>& u, double t) {
    return {u[0] * std::cos(t) + u[1] * std::sin(t), u[1] * std::cos(t) - u[0] * std::sin(t)};
}
std::array<double, 2> polar_traction(const std::array<double, 3>& s, double t) {
    const double n = std::cos(t), m = std::sin(t);
    return polar({s[0] * n + s[2] * m, s[2] * n + s[1] * m}, t);
}

}  // namespace

std::array<double, 2> Inclusion::displacement(bool in_fibre, double x, double y, const std::array<double, 8>& c) const {
    const Complex z = Complex(x, y) / radius_;
    const Potentials p = potentials(in_fibre, z, c);
    const Phase& phase = in_fibre ? fibre_ : matrix_;
    const Complex u =
        (phase.kolosov() * p.phi - z * std::conj(p.phi1) - std::conj(p.psi)) * radius_ / (2.0 * phase.shear());
    return {u.real(), u.imag()};
}

// sigma_xx + sigma_yy = 4 Re phi',  sigma_yy - sigma_xx + 2 i sigma_xy = 2 (conj(z) phi'' + psi')
std::array<double, 3> Inclusion::stress(bool in_fibre, double x, double y, const std::array<double, 8>& c) const {
    const Complex z = Complex(x, y) / radius_;
    const Potentials p = potentials(in_fibre, z, c);
    const double sum = 4.0 * p.phi1.real();
    const Complex rest = 2.0 * (std::conj(z) * p.phi2 + p.psi1);
    return {0.5 * (sum - rest.real()), 0.5 * (sum + rest.real()), 0.5 * rest.imag()};
}

// All fields are a constant plus a second harmonic: sigma_rr and [u_r] at 0 and 90 degrees and sigma_rt and [u_t] at 45
// degrees determine everything.
Inclusion::Inclusion(Phase fibre, Phase matrix, double radius, std::array<double, 2> remote_stress,
                     double normal_compliance, double tangential_compliance, bool free)
    : fibre_(fibre), matrix_(matrix), radius_(radius) {
    constexpr std::array<double, 3> angle{0.0, 0.5 * std::numbers::pi, 0.25 * std::numbers::pi};
    const auto conditions = [&](const std::array<double, 8>& c) {
        std::vector<double> residual;
        for (std::size_t i = 0; i < angle.size(); ++i) {
            const double x = radius * std::cos(angle[i]), y = radius * std::sin(angle[i]);
            const std::size_t component = i == 2 ? 1 : 0;
            const double outside = polar_traction(stress(false, x, y, c), angle[i])[component];
            const double inside = polar_traction(stress(true, x, y, c), angle[i])[component];
            residual.push_back(free ? outside : outside - inside);
            const double jump = polar(displacement(false, x, y, c), angle[i])[component] -
                                polar(displacement(true, x, y, c), angle[i])[component];
            const double compliance = component == 0 ? normal_compliance : tangential_compliance;
            residual.push_back(free ? inside : (jump - compliance * inside) * matrix.young / radius);
        }
        return residual;
    };
    std::array<double, 8> known{};
    known[6] = 0.25 * (remote_stress[0] + remote_stress[1]);
    known[7] = 0.5 * (remote_stress[1] - remote_stress[0]);
    std::vector<double> right = conditions(known);
    for (double& r : right) r = -r;
    std::vector<std::vector<double>> system(6, std::vector<double>(6));
    for (std::size_t j = 0; j < 6; ++j) {
        std::array<double, 8> unit{};
        unit[j] = 1.0;
        const std::vector<double> column = conditions(unit);
        for (std::size_t i = 0; i < 6; ++i) system[i][j] = column[i];
    }
    const std::vector<double> solution = solve(std::move(system), std::move(right));
    coefficient_ = known;
    for (std::size_t j = 0; j < 6; ++j) coefficient_[j] = solution[j];
}

std::array<double, 2> Inclusion::displacement(bool in_fibre, double x, double y) const {
    return displacement(in_fibre, x, y, coefficient_);
}
std::array<double, 3> Inclusion::stress(bool in_fibre, double x, double y) const {
    return stress(in_fibre, x, y, coefficient_);
}

// u_r = a r in the fibre, A r + D/r in the matrix;  sigma_rr = 2 k a  and  2 k A - 2 mu D/r^2.
double composite_cylinder_bulk(Phase fibre, Phase matrix, double radius, double outer, double compliance, bool free) {
    const double k = matrix.bulk(), mu = matrix.shear(), r = radius, b = outer;
    // The fibre and its spring act as a radial stiffness q: sigma_rr(R) = q u_r(R)/R of the matrix.
    const double q = free ? 0.0 : 1.0 / (1.0 / (2.0 * fibre.bulk()) + compliance / r);
    // 2 k A - 2 mu D/R^2 = q (A + D/R^2)  and  A + D/b^2 = 1
    const double ratio = (2.0 * k - q) / (2.0 * mu + q) * r * r;  // D/A
    const double a = 1.0 / (1.0 + ratio / (b * b));
    return k * a - mu * a * ratio / (b * b);
}

}  // namespace reference
