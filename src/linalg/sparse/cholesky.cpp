// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/machine/blas_threads.hpp"
#include "base/machine/large_pages.hpp"
#include "base/numbers.hpp"
#include "base/room.hpp"
#include "base/team.hpp"
#include "delam/delam.h"
#include "linalg/sparse/cholmod_view.hpp"
#include "linalg/sparse/elimination_order.hpp"
#include "linalg/sparse/leading_solve.hpp"
#include "linalg/sparse/single_factor.hpp"

// This file calls only LGPL modules by name (Core, Cholesky, Partition/CAMD; METIS is called by itself, metis.hpp). The
// supernodal (GPL) kernels are reached through cholmod_l_factorize if the installed CHOLMOD has them, and never if
// DELAM_CHOLMOD_SIMPLICIAL is defined.

// CHOLMOD 3 requests four OpenMP threads on any machine. On fewer cores they wait for each other at every supernode,
// which takes twice the time of one thread (measured). All solves, small factorisations and those in a piece of a
// team's work get one thread, since no region of the calling thread is parallel meanwhile. For large ones the "dynamic"
// setting of the calling thread lets the runtime provide fewer than four: GNU's provides as many as there are
// processors, less the load of the last 15 minutes. The threads share the scattering of blocks, not sums, so that no
// digit depends on their number. Not where OpenBLAS has OpenMP's threads (2): it waits for as many as it has asked for,
// and for ever if the runtime provides fewer. Weak symbols: a CHOLMOD without OpenMP, and another BLAS, lack these
// functions.
extern "C" {
int openblas_get_parallel() __attribute__((weak));
int omp_get_dynamic() __attribute__((weak));
void omp_set_dynamic(int) __attribute__((weak));
int omp_get_max_active_levels() __attribute__((weak));
void omp_set_max_active_levels(int) __attribute__((weak));
}

namespace delam {

namespace {

// The threads of CHOLMOD and of the BLAS that it calls, for work of so many operations outside a piece of a team's; 0:
// one thread.
class FactorThreads {
public:
    explicit FactorThreads(double operations) {
        const bool one = operations < large || in_a_piece();
        if (one) blas_.emplace();
        require_room(std::size_t{1} << 16);  // GNU's OpenMP ends the process if this memory is missing
        if (omp_get_dynamic == nullptr || omp_set_dynamic == nullptr) return;
        if (openblas_get_parallel != nullptr && openblas_get_parallel() == 2) return;
        dynamic_ = omp_get_dynamic();
        omp_set_dynamic(1);
        if (one && omp_get_max_active_levels != nullptr && omp_set_max_active_levels != nullptr) {
            levels_ = omp_get_max_active_levels();
            omp_set_max_active_levels(0);
        }
    }
    ~FactorThreads() {
        if (levels_ >= 0) omp_set_max_active_levels(levels_);
        if (dynamic_ >= 0) omp_set_dynamic(dynamic_);
    }
    FactorThreads(const FactorThreads&) = delete;
    FactorThreads& operator=(const FactorThreads&) = delete;

private:
    // A second of one core, most of it in products of large supernodes.
    static constexpr double large = 2e10;
    std::optional<BlasThreads> blas_;
    int dynamic_ = -1, levels_ = -1;
};

cholmod_dense view(std::span<const double> b) {
    cholmod_dense d{};
    d.nrow = b.size();
    d.ncol = 1;
    d.nzmax = b.size();
    d.d = b.size();
    d.x = const_cast<double*>(b.data());
    d.xtype = CHOLMOD_REAL;
    d.dtype = CHOLMOD_DOUBLE;
    return d;
}

}  // namespace

struct SparseCholesky::Impl {
    mutable cholmod_common common;
    cholmod_factor* factor = nullptr;
    std::int64_t size = 0;
    std::int64_t trailing = 0;
    FactorSize size_of_factor;
    mutable cholmod_dense* x_buffer = nullptr;  // kept between solves
    mutable cholmod_dense* y_work = nullptr;
    mutable cholmod_dense* e_work = nullptr;
    mutable std::vector<double> below;   // likewise, of the solves with the leading block
    std::optional<SingleFactor> single;  // instead of the values in `factor`
    void* single_values = nullptr;       // CHOLMOD's memory
    std::size_t single_count = 0;

    Impl() {
        cholmod_l_start(&common);
        common.print = 0;
        common.error_handler = nullptr;
        common.final_ll = 1;
        // Supernodes larger than CHOLMOD's default: with trailing variables every column is long, and narrow supernodes
        // waste time.
        common.nrelax[0] = 8;
        common.nrelax[1] = 32;
        common.nrelax[2] = 96;
        common.zrelax[1] = 0.2;
        common.zrelax[2] = 0.1;
#ifdef DELAM_CHOLMOD_SIMPLICIAL
        common.supernodal = CHOLMOD_SIMPLICIAL;
#else
        common.supernodal = CHOLMOD_AUTO;
#endif
    }
    ~Impl() {
        forget_single();
        cholmod_l_free_factor(&factor, &common);
        cholmod_l_free_dense(&x_buffer, &common);
        cholmod_l_free_dense(&y_work, &common);
        cholmod_l_free_dense(&e_work, &common);
        cholmod_l_finish(&common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void forget_single() {
        single.reset();
        single_values = cholmod_l_free(single_count, sizeof(float), single_values, &common);
    }

    // CHOLMOD would allocate them itself, in small pages.
    void make_room_for_values() {
        if (factor->is_super == 0 || factor->xtype != CHOLMOD_PATTERN) return;
        cholmod_l_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor, &common);
        check("factorisation");
        prefer_large_pages(factor->x, factor->xsize * sizeof(double));
    }

    Supernodes supernodes() const {
        const std::size_t n = factor->nsuper;
        const auto array = [](const void* data, std::size_t count) {
            return std::span<const std::int64_t>(static_cast<const std::int64_t*>(data), count);
        };
        return {array(factor->super, n + 1), array(factor->pi, n + 1), array(factor->px, n),
                array(factor->s, factor->ssize), array(factor->Perm, factor->n)};
    }

    // The values change hands; the factor keeps its pattern, as after the analysis.
    void take_single(int power) {
        single_values = std::exchange(factor->x, nullptr);
        factor->xtype = CHOLMOD_PATTERN;
        std::size_t bytes = factor->xsize * sizeof(double);
        round_in_place(static_cast<double*>(single_values), static_cast<std::int64_t>(factor->xsize), power);
        single_values = cholmod_l_realloc(factor->xsize * sizeof(float), 1, single_values, &bytes, &common);
        single_count = factor->xsize;
        single.emplace(supernodes(), static_cast<const float*>(single_values), power);
    }

    void analyse(cholmod_sparse& a, std::vector<std::int64_t>& order) {
        cholmod_l_free_factor(&factor, &common);
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_GIVEN;
        common.postorder = trailing == 0 ? 1 : 0;  // a postorder may move trailing variables that are not connected
        factor = cholmod_l_analyze_p(&a, order.data(), nullptr, 0, &common);
        check("analysis");
        size_of_factor = {common.lnz, common.fl};
    }

    // One solve. The buffers are allocated here, in the sizes that CHOLMOD needs, because CHOLMOD 3 does not check its
    // own allocations.
    const double* solve(int system, cholmod_dense& rhs) const {
        const bool super = factor->is_super != 0;
        const std::size_t n = factor->n, rows = super ? n : 4, columns = rhs.ncol;
        common.status = CHOLMOD_OK;  // reset the status of an earlier call
        cholmod_l_ensure_dense(&x_buffer, n, columns, n, CHOLMOD_REAL, &common);
        check("solve");
        cholmod_l_ensure_dense(&y_work, rows, super ? columns : n, rows, CHOLMOD_REAL, &common);
        check("solve");
        if (super) cholmod_l_ensure_dense(&e_work, columns, factor->maxesize, columns, CHOLMOD_REAL, &common);
        check("solve");
        cholmod_l_solve2(system, factor, &rhs, nullptr, &x_buffer, nullptr, &y_work, &e_work, &common);
        check("solve");
        return static_cast<const double*>(x_buffer->x);
    }
    void check(const char* stage) const { require_cholmod(common, stage); }
};

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, std::int64_t trailing, const Poll& poll)
    : impl_(std::make_unique<Impl>()) {
    impl_->size = matrix.rows;
    impl_->trailing = trailing;
    if (matrix.rows == 0) return;
    std::vector<std::int64_t> order = elimination_order(matrix, trailing, poll);
    cholmod_sparse a = view(matrix);
    impl_->analyse(a, order);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorise(const SparseMatrix& matrix) {
    Impl& impl = *impl_;
    if (impl.size == 0) return true;
    const FactorThreads threads(impl.size_of_factor.flops);
    impl.forget_single();
    impl.make_room_for_values();
    cholmod_sparse a = view(matrix);
    cholmod_l_factorize(&a, impl.factor, &impl.common);
    impl.check("factorisation");
    return impl.common.status == CHOLMOD_OK && impl.factor->minor == impl.factor->n;
}

namespace {

// Least ratio of a pivot to the largest: solutions in single precision then stay far below 1e38.
constexpr double single_range = 1e-24;
// Powers of two by which a double can be scaled and stay one.
constexpr int scalable = 1000;

}  // namespace

void SparseCholesky::keep_single() {
    Impl& impl = *impl_;
    if (impl.factor == nullptr || impl.factor->is_super == 0 || impl.factor->x == nullptr) return;
    const Pivot pivot = smallest_pivot();
    const int power = exponent(pivot.largest);
    if (!(pivot.ratio >= single_range) || std::abs(power) > scalable) return;
    impl.take_single(power);
}

void SparseCholesky::solve(std::span<const double> b, std::span<double> x) const {
    const Impl& impl = *impl_;
    if (impl.size == 0) return;
    if (impl.single) {
        const std::size_t n = index(impl.size);
        for (std::size_t at = 0; at < b.size(); at += n) impl.single->solve(b.subspan(at, n), x.subspan(at, n));
        return;
    }
    const FactorThreads threads(0.0);
    cholmod_dense rhs = view(b);
    rhs.nrow = rhs.d = index(impl.size);
    rhs.ncol = b.size() / rhs.nrow;
    std::memcpy(x.data(), impl.solve(CHOLMOD_A, rhs), b.size() * sizeof(double));
}

void SparseCholesky::solve_leading(std::span<const double> b, std::span<double> x) const {
    const Impl& impl = *impl_;
    const auto leading = index(impl.size - impl.trailing);
    if (leading == 0) return;
    if (impl.factor->is_super != 0) {
        const Supernodes nodes = impl.supernodes();
        std::vector<double> y(leading);
        for (std::size_t i = 0; i < leading; ++i) y[i] = b[index(nodes.order[i])];
        solve_leading_block(nodes, static_cast<const double*>(impl.factor->x), impl.size - impl.trailing, y,
                            impl.below);
        for (std::size_t i = 0; i < leading; ++i) x[index(nodes.order[i])] = y[i];
        return;
    }
    const FactorThreads threads(0.0);
    std::vector<double> v(index(impl.size), 0.0);
    std::copy(b.begin(), b.end(), v.begin());
    for (const int system : {CHOLMOD_P, CHOLMOD_L, CHOLMOD_Lt, CHOLMOD_Pt}) {
        if (system == CHOLMOD_L || system == CHOLMOD_Lt) poll_cancel("solve", impl.size / 64);
        cholmod_dense rhs = view(v);
        std::memcpy(v.data(), impl.solve(system, rhs), v.size() * sizeof(double));
        if (system == CHOLMOD_L) std::fill(v.begin() + static_cast<std::ptrdiff_t>(leading), v.end(), 0.0);
    }
    std::copy(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(leading), x.begin());
}

std::vector<std::int64_t> SparseCholesky::order() const {
    if (impl_->factor == nullptr) return {};
    const auto* order = static_cast<const std::int64_t*>(impl_->factor->Perm);
    return {order, order + impl_->size};
}

double SparseCholesky::factor_entries() const {
    const cholmod_factor* l = impl_->factor;
    return l == nullptr ? 0.0 : static_cast<double>(l->is_super != 0 ? l->xsize : l->nzmax);
}

FactorSize SparseCholesky::size() const { return impl_->size_of_factor; }

SparseCholesky::Pivot SparseCholesky::smallest_pivot() const {
    const cholmod_factor* l = impl_->factor;
    if (l == nullptr) return {};
    const auto* order = static_cast<const std::int64_t*>(l->Perm);
    if (l->minor < l->n) return {order[l->minor], 0.0, 0.0};
    const auto* x = static_cast<const double*>(l->x);
    std::int64_t smallest = 0;
    double least = 0.0, largest = 0.0;
    const auto check = [&](std::int64_t j, double diagonal) {
        if (j == 0 || diagonal < least) {
            least = diagonal;
            smallest = j;
        }
        largest = std::max(largest, diagonal);
    };
    if (l->is_super != 0) {
        const auto* super = static_cast<const std::int64_t*>(l->super);
        const auto* row_start = static_cast<const std::int64_t*>(l->pi);
        const auto* value_start = static_cast<const std::int64_t*>(l->px);
        for (std::size_t s = 0; s < l->nsuper; ++s)
            for (std::int64_t j = super[s]; j < super[s + 1]; ++j)
                check(j, x[value_start[s] + (j - super[s]) * (row_start[s + 1] - row_start[s] + 1)]);
    } else {
        const auto* start = static_cast<const std::int64_t*>(l->p);
        for (std::int64_t j = 0; j < impl_->size; ++j) check(j, x[start[j]]);
    }
    return {order[smallest], least / largest * (least / largest), largest};
}

DenseMatrix SparseCholesky::trailing_factor() const {
    const Impl& impl = *impl_;
    DenseMatrix lower;
    make_room(lower.value, index(impl.trailing * impl.trailing));
    lower.rows = lower.columns = impl.trailing;
    lower.value.assign(index(impl.trailing * impl.trailing), 0.0);
    if (impl.trailing == 0) return lower;
    const cholmod_factor* l = impl.factor;
    const std::int64_t first = impl.size - impl.trailing;
    const auto* x = static_cast<const double*>(l->x);
    if (l->is_super != 0) {
        // A supernode stores its columns as one dense block over its rows; amalgamation may let it begin before
        // `first`.
        const auto* super = static_cast<const std::int64_t*>(l->super);
        const auto* row_start = static_cast<const std::int64_t*>(l->pi);
        const auto* value_start = static_cast<const std::int64_t*>(l->px);
        const auto* row = static_cast<const std::int64_t*>(l->s);
        for (std::size_t s = 0; s < l->nsuper; ++s) {
            if (super[s + 1] <= first) continue;
            const std::int64_t rows = row_start[s + 1] - row_start[s];
            for (std::int64_t j = std::max(super[s], first); j < super[s + 1]; ++j) {
                const double* column = x + value_start[s] + (j - super[s]) * rows;
                for (std::int64_t i = j - super[s]; i < rows; ++i)
                    lower(row[row_start[s] + i] - first, j - first) = column[i];
            }
        }
        return lower;
    }
    const auto* start = static_cast<const std::int64_t*>(l->p);
    const auto* count = static_cast<const std::int64_t*>(l->nz);
    const auto* row = static_cast<const std::int64_t*>(l->i);
    for (std::int64_t j = first; j < impl.size; ++j)
        for (std::int64_t k = start[j]; k < start[j] + count[j]; ++k) lower(row[k] - first, j - first) = x[k];
    return lower;
}

}  // namespace delam
