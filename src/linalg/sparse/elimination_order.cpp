// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/elimination_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "base/archive.hpp"
#include "base/numbers.hpp"
#include "linalg/sparse/cholmod_view.hpp"
#include "linalg/sparse/dissection.hpp"

namespace delam {

namespace {

using Order = std::vector<std::int64_t>;

struct OrderingCommon {
    cholmod_common value;
    OrderingCommon() {
        cholmod_l_start(&value);
        value.print = 0;
        value.error_handler = nullptr;
    }
    ~OrderingCommon() { cholmod_l_finish(&value); }
    OrderingCommon(const OrderingCommon&) = delete;
    OrderingCommon& operator=(const OrderingCommon&) = delete;
};

cholmod_sparse view_of_pattern(const SparseMatrix& m) {
    cholmod_sparse a = view(m);
    a.xtype = CHOLMOD_PATTERN;
    a.sorted = 0;
    return a;
}

// An order for few large overlapping dense blocks, where minimum degree takes longer than the factorisation itself.
// Variables that belong to only one block come first, because their rows are the shortest. Rows with the same columns
// stay together (recognised by a checksum).
constexpr double well_filled = 0.1;
constexpr std::int64_t few_rows = 500;

Order shortest_first(const SparseMatrix& m) {
    std::vector<std::array<std::uint64_t, 3>> rows;  // length, checksum, number
    for (std::size_t r = 0; r < index(m.rows); ++r) {
        std::uint64_t sum = 0;
        for (std::int64_t e = m.start[r]; e < m.start[r + 1]; ++e)
            sum = sum * checksum_factor + static_cast<std::uint64_t>(m.column[index(e)]);
        rows.push_back({static_cast<std::uint64_t>(m.start[r + 1] - m.start[r]), sum, r});
    }
    std::sort(rows.begin(), rows.end());
    Order order;
    for (const auto& row : rows) order.push_back(static_cast<std::int64_t>(row[2]));
    return order;
}

// The leading variables, group by group, then the trailing ones.
Order members(const EqualRows& groups, std::int64_t trailing, std::span<const std::int64_t> of_groups) {
    const auto size = static_cast<std::int64_t>(groups.of.size());
    Order order;
    order.reserve(groups.of.size());
    for (const std::int64_t g : of_groups)
        for (std::int64_t i = groups.start[index(g)]; i < groups.start[index(g) + 1]; ++i)
            if (groups.member[index(i)] < size - trailing) order.push_back(groups.member[index(i)]);
    for (std::int64_t v = size - trailing; v < size; ++v) order.push_back(v);
    return order;
}

// Variables with equal rows are ordered as one: CAMD would find them itself, in twice the time.
Order minimum_degree(const EqualRows& groups, const SparseMatrix& pattern, std::int64_t trailing) {
    const auto leading = static_cast<std::int64_t>(groups.of.size()) - trailing;
    // CAMD writes beyond its arrays if the number of a set, here 1, is not below the number of variables.
    if (leading == 0) return members(groups, trailing, {});
    Order last(groups.count()), of_groups(groups.count());
    for (std::size_t g = 0; g < last.size(); ++g) last[g] = groups.member[index(groups.start[g])] < leading ? 0 : 1;
    OrderingCommon common;
    cholmod_sparse a = view_of_pattern(pattern);
    if (cholmod_l_camd(&a, nullptr, 0, last.data(), of_groups.data(), &common.value) == 0)
        require_cholmod(common.value, "ordering");
    return members(groups, trailing, of_groups);
}

// Nested dissection is tried where minimum degree costs more operations per stored entry of the matrix. METIS takes 0.1
// us per stored entry in space and 0.2 us in the plane; a third of these operations takes 0.08 us. The triangle of the
// trailing variables costs the same in every order.
constexpr double worth_dissecting = 5e3;

bool may_gain(double operations, const SparseMatrix& m, std::int64_t trailing) {
    const auto t = static_cast<double>(trailing);
    return operations - t * t * t / 3.0 > worth_dissecting * static_cast<double>(m.entries());
}

}  // namespace

double estimated_operations(const EqualRows& groups, const SparseMatrix& pattern, std::int64_t trailing,
                            std::vector<std::int64_t>& order) {
    const std::size_t n = groups.count();
    Order before, parent(n), post(n), columns(n), first(n), level(n);
    std::vector<std::uint8_t> seen(n, 0);
    for (const std::int64_t v : order)
        if (std::exchange(seen[index(groups.of[index(v)])], std::uint8_t{1}) == 0)
            before.push_back(groups.of[index(v)]);
    OrderingCommon common;
    cholmod_sparse a = view_of_pattern(pattern);
    cholmod_l_analyze_ordering(&a, CHOLMOD_GIVEN, before.data(), nullptr, 0, parent.data(), post.data(), columns.data(),
                               first.data(), level.data(), &common.value);
    require_cholmod(common.value, "ordering");
    const double average = static_cast<double>(groups.of.size()) / static_cast<double>(n);
    double operations = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t g = index(before[k]);
        for (std::int64_t own = groups.start[g + 1] - groups.start[g]; own > 0; --own) {
            const double rows = average * static_cast<double>(columns[k] - 1) + static_cast<double>(own);
            operations += rows * rows;
        }
    }
    for (std::int64_t& k : post) k = before[index(k)];
    order = members(groups, trailing, post);
    return operations;
}

std::vector<std::int64_t> elimination_order(const SparseMatrix& matrix, std::int64_t trailing, const Poll& poll) {
    const auto n = static_cast<double>(matrix.rows);
    if (trailing == 0 && matrix.rows > few_rows && static_cast<double>(matrix.entries()) > well_filled * n * n) {
        Order order = shortest_first(matrix);
        call_if_set(poll);
        return order;
    }
    const EqualRows groups = equal_rows(matrix, matrix.rows, matrix.rows - trailing);
    const SparseMatrix pattern = pattern_of_groups(matrix, groups);
    Order order = minimum_degree(groups, pattern, trailing);
    call_if_set(poll);
    if (!may_gain(n * n * n / 3.0, matrix, trailing)) return order;  // not even a full factor costs as much
    Order other = order;
    const double operations = estimated_operations(groups, pattern, trailing, other);
    call_if_set(poll);
    if (!may_gain(operations, matrix, trailing)) return order;
    const Order dissected = dissection_order(matrix, matrix.rows - trailing);
    call_if_set(poll);
    if (dissected.empty()) return order;
    std::copy(dissected.begin(), dissected.end(), other.begin());  // the trailing variables stay where they are
    const bool better = estimated_operations(groups, pattern, trailing, other) < operations;
    call_if_set(poll);
    return better ? other : order;
}

}  // namespace delam
