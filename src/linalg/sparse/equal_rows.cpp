// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/equal_rows.hpp"

#include <bit>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

std::uint64_t scrambled(std::uint64_t x) {  // the finaliser of SplitMix64 (S. Vigna)
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

// The first variable with the same checksum, of each.
std::vector<std::int64_t> first_equals(const std::vector<std::uint64_t>& sum) {
    const std::size_t places = std::bit_ceil(2 * sum.size() + 1);
    std::vector<std::int64_t> table(places, -1);  // open addressing
    std::vector<std::int64_t> first(sum.size());
    for (std::size_t r = 0; r < sum.size(); ++r) {
        std::size_t at = sum[r] & (places - 1);
        while (table[at] >= 0 && sum[index(table[at])] != sum[r]) at = (at + 1) & (places - 1);
        if (table[at] < 0) table[at] = static_cast<std::int64_t>(r);
        first[r] = table[at];
    }
    return first;
}

}  // namespace

EqualRows equal_rows(const SparseMatrix& m, std::int64_t variables, std::int64_t leading) {
    std::vector<std::uint64_t> key(index(variables)), sum(index(variables));
    for (std::size_t r = 0; r < key.size(); ++r) key[r] = scrambled(r);
    const std::uint64_t apart = scrambled(index(m.rows));
    for (std::int64_t r = 0; r < variables; ++r) {
        poll_cancel("order");
        std::uint64_t total = r < leading ? 0 : apart;
        for (std::int64_t e = m.start[index(r)]; e < m.start[index(r) + 1]; ++e)
            if (m.column[index(e)] < variables) total += key[index(m.column[index(e)])];
        sum[index(r)] = total;
    }
    const std::vector<std::int64_t> first = first_equals(sum);
    EqualRows groups;
    groups.of.resize(index(variables));
    std::vector<std::int64_t> size;
    for (std::int64_t r = 0; r < variables; ++r) {
        if (first[index(r)] == r) {
            groups.of[index(r)] = static_cast<std::int64_t>(size.size());
            size.push_back(0);
        } else {
            groups.of[index(r)] = groups.of[index(first[index(r)])];
        }
        ++size[index(groups.of[index(r)])];
    }
    groups.start.reserve(size.size() + 1);
    for (const std::int64_t s : size) groups.start.push_back(groups.start.back() + s);
    std::vector<std::int64_t> next(groups.start.begin(), groups.start.end() - 1);
    groups.member.resize(index(variables));
    for (std::int64_t r = 0; r < variables; ++r) groups.member[index(next[index(groups.of[index(r)])]++)] = r;
    return groups;
}

SparseMatrix pattern_of_groups(const SparseMatrix& m, const EqualRows& groups) {
    SparseMatrix pattern;
    pattern.rows = pattern.columns = static_cast<std::int64_t>(groups.count());
    pattern.start.reserve(groups.count() + 1);
    std::vector<std::int64_t> seen(groups.count(), -1);
    for (std::size_t v = 0; v < groups.count(); ++v) {
        poll_cancel("order");
        const std::size_t r = index(groups.member[index(groups.start[v])]);
        for (std::int64_t e = m.start[r]; e < m.start[r + 1]; ++e) {
            if (m.column[index(e)] >= static_cast<std::int64_t>(groups.of.size())) continue;
            const std::int64_t w = groups.of[index(m.column[index(e)])];
            if (std::exchange(seen[index(w)], static_cast<std::int64_t>(v)) != static_cast<std::int64_t>(v))
                pattern.column.push_back(w);
        }
        pattern.start.push_back(pattern.entries());
    }
    return pattern;
}

}  // namespace delam
