// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/buckling_mode.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// Modes of equal factors converge late; with more vectors than that they are known well enough to descend along. (Half
// and twice give the same digits of examples/blister and pass verify/cases/test_buckling.)
constexpr std::size_t most_vectors = 120;

// A vector of which this share of the square is left lies in the space. (1e-16 and 1e-26 decide alike in the unit
// test.)
constexpr double rounding_square = 1e-20;

// A square that differs by more than this share from that of Pythagoras has lost its digits. (From a hundredth to a
// hundred times the digits of examples/blister are the same, and verify/cases/test_buckling passes.)
constexpr double lost_digits = 1e-8;

// Returns parts of golden sections between -1/2 and 1/2: no mode of a mesh, whatever its numbering, is orthogonal to
// it.
std::vector<double> first_force(std::size_t size) {
    std::vector<double> force(size);
    for (std::size_t i = 0; i < size; ++i) {
        const double x = std::numbers::phi * static_cast<double>(i + 1);
        force[i] = x - std::floor(x) - 0.5;
    }
    return force;
}

// Orthonormal vectors v with their forces p = K v, and the products v . G v among them.
class KrylovSpace {
public:
    explicit KrylovSpace(std::vector<double> force) : force_(std::move(force)) {}

    enum class Grows { yes, complete, lost };
    // Takes v = K^-1 of the force, less its parts in the space, into it. complete: it is in it already; lost: the
    // digits in which v and its force differ from K v have grown, as they do where many vectors leave little of each
    // next one.
    Grows extend(std::vector<double> v) {
        const double whole = dot(force_, v);
        double rest = whole;
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t i = 0; i < vectors_.size(); ++i) {
                const double part = dot(forces_[i], v);
                add_scaled(-part, vectors_[i], v);
                add_scaled(-part, forces_[i], force_);
                rest -= part * part;
            }
        const double square = dot(force_, v);
        if (!(std::abs(square - rest) <= lost_digits * whole)) return Grows::lost;
        if (!(square > rounding_square * whole)) return Grows::complete;
        beta_.push_back(std::sqrt(square));
        for (double& x : v) x /= beta_.back();
        for (double& x : force_) x /= beta_.back();
        vectors_.push_back(std::move(v));
        forces_.push_back(force_);
        return Grows::yes;
    }
    // Sets the force of the next vector to G times the last one.
    void follow(std::vector<double> softened) {
        alpha_.push_back(dot(softened, vectors_.back()));
        force_ = std::move(softened);
    }
    std::size_t size() const { return vectors_.size(); }
    const std::vector<double>& force() const { return force_; }
    const std::vector<double>& last() const { return vectors_.back(); }
    // The factors in the space, ascending, from the tridiagonal matrix of these products.
    Eigen factors() const {
        const auto n = static_cast<std::int64_t>(alpha_.size());
        DenseMatrix t(n, n);
        for (std::int64_t i = 0; i < n; ++i) {
            t(i, i) = alpha_[index(i)];
            if (i > 0) t(i, i - 1) = t(i - 1, i) = beta_[index(i)];
        }
        return eigen_symmetric(std::move(t));
    }
    std::vector<double> combined(std::span<const double> parts) const {
        std::vector<double> sum(vectors_.front().size(), 0.0);
        for (std::size_t i = 0; i < parts.size(); ++i) add_scaled(parts[i], vectors_[i], sum);
        return sum;
    }
    // The size of what the last vector has left outside of the space.
    double beyond() const { return beta_.back(); }

private:
    std::vector<std::vector<double>> vectors_, forces_;
    std::vector<double> alpha_, beta_, force_;
};

}  // namespace

void orient(std::span<double> mode) {
    const double half = 0.5 * max_abs(mode);
    for (const double x : mode) {
        if (std::abs(x) < half) continue;
        if (x < 0.0)
            for (double& y : mode) y = -y;
        return;
    }
}

BucklingMode buckling_mode(std::size_t size, const Apply& solve, const Apply& soften, const ModeAccuracy& accuracy) {
    using Grows = KrylovSpace::Grows;
    BucklingMode mode;
    KrylovSpace space(first_force(size));
    Grows grows = space.extend(solve(space.force()));
    if (grows != Grows::yes) return mode;
    Eigen found;
    for (mode.solves = 1; grows == Grows::yes && !mode.converged && space.size() <= most_vectors; ++mode.solves) {
        space.follow(soften(space.last()));
        found = space.factors();
        const std::int64_t last = found.vector.rows - 1;
        grows = space.extend(solve(space.force()));
        mode.factor = found.value.back();
        mode.converged =
            grows == Grows::complete ||
            (grows == Grows::yes && space.beyond() * std::abs(found.vector(last, last)) <=
                                        accuracy.tolerance * std::max(accuracy.least, std::abs(mode.factor)));
    }
    mode.displacement = space.combined(column(found.vector, found.vector.columns - 1));
    orient(mode.displacement);
    const double largest = max_abs(mode.displacement);
    for (double& x : mode.displacement) x /= largest;
    return mode;
}

}  // namespace delam
