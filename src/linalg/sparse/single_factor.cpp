// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/single_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/cancel_scope.hpp"
#include "base/machine/blas_threads.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/blas_size.hpp"

extern "C" {
void strsv_(const char*, const char*, const char*, const int*, const float*, const int*, float*, const int*);
void sgemv_(const char*, const int*, const int*, const float*, const float*, const int*, const float*, const int*,
            const float*, float*, const int*);
}

namespace delam {

namespace {

constexpr int step_one = 1;
constexpr float plus = 1.0F, minus = -1.0F, nothing = 0.0F;

// One supernode: `columns` columns over as many rows of its own and `below` others.
struct Node {
    std::size_t first;           // column
    const float* value;          // [own + below][columns]
    const std::int64_t* others;  // rows below
    int columns, rows, below;
};

Node node_at(const Supernodes& nodes, const float* values, std::size_t s) {
    const std::int64_t columns = nodes.first[s + 1] - nodes.first[s];
    const std::int64_t rows = nodes.row_start[s + 1] - nodes.row_start[s];
    return {index(nodes.first[s]),
            values + nodes.value_start[s],
            nodes.row.data() + nodes.row_start[s] + columns,
            blas_size(columns),
            blas_size(rows),
            blas_size(rows - columns)};
}

void poll(const Node& n) { poll_cancel_reading("linear solve", static_cast<std::int64_t>(n.columns) * n.rows); }

}  // namespace

const float* round_in_place(double* value, std::int64_t count, int power) {
    const double scale = std::ldexp(1.0, -power);
    auto* bytes = reinterpret_cast<unsigned char*>(value);
    for (std::size_t i = 0; i < index(count); ++i) {
        double wide = 0.0;
        std::memcpy(&wide, bytes + i * sizeof(double), sizeof(double));
        const auto narrow = static_cast<float>(wide * scale);
        std::memcpy(bytes + i * sizeof(float), &narrow, sizeof(float));
    }
    return reinterpret_cast<const float*>(bytes);
}

SingleFactor::SingleFactor(const Supernodes& nodes, const float* values, int power)
    : nodes_(nodes), values_(values), power_(power), solution_(nodes.order.size()) {
    std::int64_t most = 0;
    for (std::size_t s = 0; s + 1 < nodes_.first.size(); ++s)
        most = std::max(most, nodes_.row_start[s + 1] - nodes_.row_start[s]);
    below_.resize(index(most));
}

void SingleFactor::forward(std::span<float> y) const {
    for (std::size_t s = 0; s + 1 < nodes_.first.size(); ++s) {
        const Node n = node_at(nodes_, values_, s);
        poll(n);
        strsv_("L", "N", "N", &n.columns, n.value, &n.rows, y.data() + n.first, &step_one);
        if (n.below == 0) continue;
        sgemv_("N", &n.below, &n.columns, &plus, n.value + n.columns, &n.rows, y.data() + n.first, &step_one, &nothing,
               below_.data(), &step_one);
        for (std::size_t i = 0; i < index(n.below); ++i) y[index(n.others[i])] -= below_[i];
    }
}

void SingleFactor::backward(std::span<float> y) const {
    for (std::size_t s = nodes_.first.size() - 1; s-- > 0;) {
        const Node n = node_at(nodes_, values_, s);
        poll(n);
        for (std::size_t i = 0; i < index(n.below); ++i) below_[i] = y[index(n.others[i])];
        if (n.below > 0)
            sgemv_("T", &n.below, &n.columns, &minus, n.value + n.columns, &n.rows, below_.data(), &step_one, &plus,
                   y.data() + n.first, &step_one);
        strsv_("L", "T", "N", &n.columns, n.value, &n.rows, y.data() + n.first, &step_one);
    }
}

void SingleFactor::solve(std::span<const double> b, std::span<double> x) const {
    const BlasThreads one;  // it waits for memory, supernode after supernode
    const int size = exponent(max_abs(b));
    for (std::size_t i = 0; i < solution_.size(); ++i)
        solution_[i] = static_cast<float>(std::ldexp(b[index(nodes_.order[i])], -size));
    forward(solution_);
    backward(solution_);
    for (std::size_t i = 0; i < solution_.size(); ++i)
        x[index(nodes_.order[i])] = std::ldexp(static_cast<double>(solution_[i]), size - 2 * power_);
}

}  // namespace delam
