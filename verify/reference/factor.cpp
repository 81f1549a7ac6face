// SPDX-License-Identifier: BSD-3-Clause
#include "factor.hpp"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cmath>

#include "api.hpp"

namespace reference {
namespace {

// After scaling to a unit diagonal, a pivot this small is rounding; slender bodies with supports stay far above it.
constexpr double singular = 1e-15;
constexpr int refinement_limit = 20;

}  // namespace

struct Factor::Impl {
    cholmod_common common{};
    cholmod_factor* factor = nullptr;
    std::size_t n = 0;
    std::vector<double> scale;  // 1 / sqrt(diagonal)

    Impl() {
        cholmod_l_start(&common);
        common.print = 0;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_AMD;
        common.postorder = 1;
        common.final_ll = 1;
    }
    ~Impl() {
        cholmod_l_free_factor(&factor, &common);
        cholmod_l_finish(&common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
};

Factor::Factor(std::size_t n, const Triplets& lower) : impl_(std::make_unique<Impl>()) {
    Impl& p = *impl_;
    p.n = n;
    if (n == 0) return;
    std::vector<double> diagonal(n, 0.0);
    for (std::size_t e = 0; e < lower.value.size(); ++e) {
        if (lower.row[e] == lower.column[e]) diagonal[static_cast<std::size_t>(lower.row[e])] += lower.value[e];
    }
    p.scale.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (!(diagonal[i] > 0.0)) throw Failure(0, "direct reference: a body is free to move (zero diagonal)");
        p.scale[i] = 1.0 / std::sqrt(diagonal[i]);
    }
    cholmod_triplet* t = cholmod_l_allocate_triplet(n, n, lower.value.size(), -1, CHOLMOD_REAL, &p.common);
    if (t == nullptr) throw Failure(0, "direct reference: out of memory");
    auto* ti = static_cast<std::int64_t*>(t->i);
    auto* tj = static_cast<std::int64_t*>(t->j);
    auto* tx = static_cast<double*>(t->x);
    for (std::size_t e = 0; e < lower.value.size(); ++e) {
        ti[e] = lower.row[e];
        tj[e] = lower.column[e];
        tx[e] = lower.value[e] * p.scale[static_cast<std::size_t>(ti[e])] * p.scale[static_cast<std::size_t>(tj[e])];
    }
    t->nnz = lower.value.size();
    cholmod_sparse* a = cholmod_l_triplet_to_sparse(t, 0, &p.common);
    cholmod_l_free_triplet(&t, &p.common);
    if (a == nullptr) throw Failure(0, "direct reference: out of memory");
    p.factor = cholmod_l_analyze(a, &p.common);
    if (p.factor != nullptr) cholmod_l_factorize(a, p.factor, &p.common);
    cholmod_l_free_sparse(&a, &p.common);
    if (p.factor == nullptr || p.common.status != CHOLMOD_OK || p.factor->minor < n ||
        cholmod_l_rcond(p.factor, &p.common) < singular) {
        throw Failure(0, "direct reference: the system is singular, so a body is free to move: out of its scope");
    }
}

Factor::~Factor() = default;

std::vector<double> Factor::solve(const std::vector<double>& right) const {
    Impl& p = *impl_;
    if (p.n == 0) return {};
    cholmod_dense* b = cholmod_l_allocate_dense(p.n, 1, p.n, CHOLMOD_REAL, &p.common);
    if (b == nullptr) throw Failure(0, "direct reference: out of memory");
    for (std::size_t i = 0; i < p.n; ++i) static_cast<double*>(b->x)[i] = right[i] * p.scale[i];
    cholmod_dense* x = cholmod_l_solve(CHOLMOD_A, p.factor, b, &p.common);
    cholmod_l_free_dense(&b, &p.common);
    if (x == nullptr) throw Failure(0, "direct reference: solve failed");
    std::vector<double> result(p.n);
    for (std::size_t i = 0; i < p.n; ++i) result[i] = static_cast<double*>(x->x)[i] * p.scale[i];
    cholmod_l_free_dense(&x, &p.common);
    return result;
}

std::vector<long double> Factor::refine(const Residual& residual) const {
    const Impl& p = *impl_;
    std::vector<long double> x(p.n, 0.0L);
    std::vector<double> r(p.n);
    long double before = 0.0L;
    for (int iteration = 0; iteration < refinement_limit; ++iteration) {
        const auto extended = residual(x);
        std::transform(extended.begin(), extended.end(), r.begin(),
                       [](long double v) { return static_cast<double>(v); });
        const auto correction = solve(r);
        long double size = 0.0L;
        for (std::size_t i = 0; i < p.n; ++i) {
            x[i] += static_cast<long double>(correction[i]);
            size = std::max(size, static_cast<long double>(std::abs(correction[i]) / p.scale[i]));
        }
        if (size == 0.0L || (iteration > 2 && size > 0.5L * before)) break;
        before = size;
    }
    return x;
}

}  // namespace reference
