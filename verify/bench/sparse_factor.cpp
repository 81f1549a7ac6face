// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_factor.hpp"

#include <suitesparse/cholmod.h>

#include <cstring>
#include <type_traits>

#include "api.hpp"

namespace bench {

struct SparseFactor::Interface {
    virtual ~Interface() = default;
    virtual void factorise() = 0;
    virtual void solve(const std::vector<double>& b, std::vector<double>& x) = 0;
    cholmod_common common{};
    cholmod_factor* factor = nullptr;
};

namespace {

// The two families of entry points under one name.
struct Narrow {
    using Index = std::int32_t;
    static constexpr int type = CHOLMOD_INT;
    static constexpr auto start = cholmod_start;
    static constexpr auto finish = cholmod_finish;
    static constexpr auto analyze = cholmod_analyze;
    static constexpr auto factorize = cholmod_factorize;
    static constexpr auto solve2 = cholmod_solve2;
    static constexpr auto free_factor = cholmod_free_factor;
    static constexpr auto free_dense = cholmod_free_dense;
};
struct Wide {
    using Index = SuiteSparse_long;
    static constexpr int type = CHOLMOD_LONG;
    static constexpr auto start = cholmod_l_start;
    static constexpr auto finish = cholmod_l_finish;
    static constexpr auto analyze = cholmod_l_analyze;
    static constexpr auto factorize = cholmod_l_factorize;
    static constexpr auto solve2 = cholmod_l_solve2;
    static constexpr auto free_factor = cholmod_l_free_factor;
    static constexpr auto free_dense = cholmod_l_free_dense;
};

template <class Family>
class Cholmod final : public SparseFactor::Interface {
public:
    explicit Cholmod(const UpperMatrix& matrix) : matrix_(&matrix) {
        Family::start(&common);
        common.print = 0;
        if constexpr (!std::is_same_v<typename Family::Index, std::int32_t>) {
            start_.assign(matrix.start.begin(), matrix.start.end());
            row_.assign(matrix.row.begin(), matrix.row.end());
        }
        cholmod_sparse a = view();
        factor = Family::analyze(&a, &common);
        if (factor == nullptr || common.status != CHOLMOD_OK) throw reference::Failure(0, "CHOLMOD: analysis failed");
    }
    ~Cholmod() override {
        Family::free_factor(&factor, &common);
        Family::free_dense(&x_, &common);
        Family::free_dense(&y_, &common);
        Family::free_dense(&e_, &common);
        Family::finish(&common);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;

    void factorise() override {
        cholmod_sparse a = view();
        Family::factorize(&a, factor, &common);
        if (common.status != CHOLMOD_OK || factor->minor < factor->n)
            throw reference::Failure(0, "CHOLMOD: the matrix is not positive definite");
    }

    void solve(const std::vector<double>& b, std::vector<double>& x) override {
        cholmod_dense right{};
        right.nrow = right.nzmax = right.d = b.size();
        right.ncol = 1;
        right.x = const_cast<double*>(b.data());
        right.xtype = CHOLMOD_REAL;
        right.dtype = CHOLMOD_DOUBLE;
        if (Family::solve2(CHOLMOD_A, factor, &right, nullptr, &x_, nullptr, &y_, &e_, &common) == 0)
            throw reference::Failure(0, "CHOLMOD: solve failed");
        x.resize(b.size());
        std::memcpy(x.data(), x_->x, b.size() * sizeof(double));
    }

private:
    cholmod_sparse view() {
        cholmod_sparse a{};
        a.nrow = a.ncol = matrix_->size();
        a.nzmax = matrix_->row.size();
        if constexpr (std::is_same_v<typename Family::Index, std::int32_t>) {
            a.p = const_cast<std::int32_t*>(matrix_->start.data());
            a.i = const_cast<std::int32_t*>(matrix_->row.data());
        } else {
            a.p = start_.data();
            a.i = row_.data();
        }
        a.x = const_cast<double*>(matrix_->value.data());
        a.stype = 1;
        a.itype = Family::type;
        a.xtype = CHOLMOD_REAL;
        a.dtype = CHOLMOD_DOUBLE;
        a.sorted = 1;
        a.packed = 1;
        return a;
    }

    const UpperMatrix* matrix_;
    std::vector<typename Family::Index> start_, row_;  // copies of wide indices; narrow ones are read in place
    cholmod_dense* x_ = nullptr;
    cholmod_dense* y_ = nullptr;
    cholmod_dense* e_ = nullptr;
};

}  // namespace

SparseFactor::SparseFactor(const UpperMatrix& matrix, bool wide) {
    if (wide) {
        impl_ = std::make_unique<Cholmod<Wide>>(matrix);
    } else {
        impl_ = std::make_unique<Cholmod<Narrow>>(matrix);
    }
}

SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;

void SparseFactor::factorise() { impl_->factorise(); }
void SparseFactor::solve(const std::vector<double>& b, std::vector<double>& x) { impl_->solve(b, x); }
double SparseFactor::entries() const {
    const cholmod_factor* l = impl_->factor;
    return static_cast<double>(l->is_super != 0 ? l->xsize : l->nzmax);
}
double SparseFactor::peak_bytes() const { return static_cast<double>(impl_->common.memory_usage); }
const char* SparseFactor::ordering() const {
    switch (impl_->factor->ordering) {
        case CHOLMOD_AMD:
            return "AMD";
        case CHOLMOD_METIS:
            return "METIS";
        case CHOLMOD_NATURAL:
            return "natural";
        default:
            return "other";
    }
}

}  // namespace bench
