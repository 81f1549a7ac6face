// SPDX-License-Identifier: BSD-3-Clause
#include "body/equal/row_table.hpp"

#include <bit>
#include <cstring>

namespace delam {

namespace {

// Rows that are known at most. Reason: meshes of layers have 10 to 60 different cells, graded ones as many as they
// have columns, and free ones no two that are equal, of which a bounded number is kept in vain. (examples/enf has 33,
// by verify/unit/test_row_table.cpp. Half and twice change nothing in verify/bench/analyses.py.)
constexpr std::size_t most_rows = 1024;

// Mixes the bits of a row (multiplicative hashing; D. Knuth, The Art of Computer Programming 3, section 6.4).
std::uint64_t hash_of(std::span<const double> row) {
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;
    std::uint64_t h = row.size();
    for (const double v : row) h = (std::rotl(h, 29) ^ std::bit_cast<std::uint64_t>(v)) * golden_ratio;
    return h ^ (h >> 32U);
}

}  // namespace

void RowTable::make_table(std::size_t slots) {
    table_.assign(slots, -1);
    for (std::size_t r = 0; r < hash_.size(); ++r) {
        std::size_t slot = hash_[r] & (slots - 1);
        while (table_[slot] >= 0) slot = (slot + 1) & (slots - 1);
        table_[slot] = static_cast<std::int32_t>(r);
    }
}

RowTable::Found RowTable::find(std::span<const double> row) {
    if (4 * (count() + 1) > 3 * table_.size()) make_table(table_.empty() ? 64 : 2 * table_.size());
    const std::uint64_t hash = hash_of(row);
    std::size_t slot = hash & (table_.size() - 1);
    for (; table_[slot] >= 0; slot = (slot + 1) & (table_.size() - 1)) {
        const auto r = static_cast<std::size_t>(table_[slot]);
        const std::size_t begin = r == 0 ? 0 : end_[r - 1];
        if (hash_[r] == hash && end_[r] - begin == row.size() &&
            std::memcmp(values_.data() + begin, row.data(), row.size_bytes()) == 0)
            return {table_[slot], false};
    }
    if (count() == most_rows) return {};
    table_[slot] = static_cast<std::int32_t>(count());
    values_.insert(values_.end(), row.begin(), row.end());
    end_.push_back(values_.size());
    hash_.push_back(hash);
    return {table_[slot], true};
}

}  // namespace delam
