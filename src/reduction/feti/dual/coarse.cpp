// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/coarse.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"

namespace delam {

CoarseProblem::CoarseProblem(const DualRows& rows, std::span<const Subdomain> subdomains) {
    std::int64_t size = 0;
    std::vector<std::int64_t> first, owner(index(rows.boundary_count()));
    for (std::size_t s = 0; s < subdomains.size(); ++s) {
        first.push_back(size);
        size += subdomains[s].rigid_count;
        std::fill(owner.begin() + rows.offset[s], owner.begin() + rows.offset[s + 1], static_cast<std::int64_t>(s));
    }
    std::vector<Triplet> forward, backward;
    for (std::int64_t r = 0; r < rows.b.rows; ++r) {
        for (std::int64_t e = rows.b.start[index(r)]; e < rows.b.start[index(r) + 1]; ++e) {
            const std::int64_t dof = rows.b.column[index(e)];
            const auto s = index(owner[index(dof)]);
            for (std::int64_t k = 0; k < subdomains[s].rigid_count; ++k) {
                const double value = rows.b.value[index(e)] * subdomains[s].rigid_boundary(dof - rows.offset[s], k);
                forward.push_back({first[s] + k, r, value});
                backward.push_back({r, first[s] + k, value});
            }
        }
    }
    g_ = from_triplets(size, rows.count(), std::move(forward));
    gt_ = from_triplets(rows.count(), size, std::move(backward));
}

// The pivots of G Q G^T fall over many decades if springs have every stiffness, and their size does not distinguish a
// soft spring from none. Which motions are held at all is decided by G over the rows that carry force, whatever their
// stiffness.
void CoarseProblem::set_weights(std::span<const double> weight) {
    if (std::equal(weight.begin(), weight.end(), weight_.begin(), weight_.end())) return;
    std::vector<double> carries(weight.size());
    bool same = weight_.size() == weight.size();
    for (std::size_t i = 0; i < weight.size(); ++i) {
        carries[i] = weight[i] > 0.0 ? 1.0 : 0.0;
        same = same && (weight[i] > 0.0) == (weight_[i] > 0.0);
    }
    weight_.clear();  // none, until the factor is there: it may be interrupted
    const SparseMatrix gram = weighted_gram(g_, gt_, weight);
    if (!same) factor_ = SemidefiniteFactor(gram, independent_rows(g_, gt_, carries, 1e-11));
    factor_.factorise(gram);
    weight_.assign(weight.begin(), weight.end());
}

std::vector<double> CoarseProblem::apply(std::span<const double> lambda) const {
    std::vector<double> out(index(g_.rows));
    multiply(g_, lambda, out);
    return out;
}

std::vector<double> CoarseProblem::apply_transposed(std::span<const double> alpha) const {
    std::vector<double> out(index(gt_.rows));
    multiply(gt_, alpha, out);
    return out;
}

void CoarseProblem::project(std::span<double> lambda) const {
    std::vector<double> y = apply(lambda);
    factor_.solve(y);
    const std::vector<double> correction = apply_transposed(y);
    for (std::size_t i = 0; i < lambda.size(); ++i) lambda[i] -= weight_[i] * correction[i];
}

void CoarseProblem::project_transposed(std::span<double> r) const {
    std::vector<double> y = rigid_coefficients(r);
    const std::vector<double> correction = apply_transposed(y);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= correction[i];
}

double CoarseProblem::balance(std::span<const double> e, std::span<double> lambda, double scale) const {
    double left = 0.0;
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes the rounding of the first
        std::vector<double> y = apply(lambda);
        for (std::size_t i = 0; i < y.size(); ++i) y[i] = e[i] - y[i];
        factor_.solve(y);
        const std::vector<double> correction = apply_transposed(y);
        for (std::size_t i = 0; i < lambda.size(); ++i) lambda[i] += weight_[i] * correction[i];
    }
    const std::vector<double> carried = apply(lambda);
    for (std::size_t i = 0; i < carried.size(); ++i) left = std::max(left, std::abs(e[i] - carried[i]));
    return scale > 0.0 ? left / scale : left;
}

std::vector<double> CoarseProblem::rigid_coefficients(std::span<const double> r) const {
    std::vector<double> weighted(r.size());
    for (std::size_t i = 0; i < r.size(); ++i) weighted[i] = weight_[i] * r[i];
    std::vector<double> alpha = apply(weighted);
    factor_.solve(alpha);
    return alpha;
}

}  // namespace delam
