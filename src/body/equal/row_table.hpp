// SPDX-License-Identifier: BSD-3-Clause
// Finds rows of numbers that are equal to the last bit, so that what follows from them is computed once: meshes of
// layers have thousands of cells and some dozens of different ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace delam {

class RowTable {
public:
    struct Found {
        std::int64_t number = -1;  // -1: not known, and too many others are
        bool added = false;        // it was not known before
    };
    Found find(std::span<const double> row);
    std::size_t count() const { return end_.size(); }

private:
    void make_table(std::size_t slots);

    std::vector<double> values_;       // row after row
    std::vector<std::size_t> end_;     // [rows] of each in values_
    std::vector<std::uint64_t> hash_;  // [rows]
    std::vector<std::int32_t> table_;  // numbers of rows by their hash, -1 if empty
};

// Keeps what follows from rows.
template <class Value>
class ByRow {
public:
    // Returns the number of a row, for which make() has been kept; -1: it is not kept.
    template <class Make>
    std::int64_t number(std::span<const double> row, Make&& make) {
        const RowTable::Found found = rows_.find(row);
        if (found.added) values_.push_back(make());
        return found.number;
    }
    const Value& at(std::int64_t number) const { return values_[static_cast<std::size_t>(number)]; }
    std::size_t count() const { return values_.size(); }

private:
    RowTable rows_;
    std::deque<Value> values_;
};

}  // namespace delam
