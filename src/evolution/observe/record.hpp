// SPDX-License-Identifier: BSD-3-Clause
// Values of every committed step under the keys that the host requested: the load curve, as part of the saved state.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delam {

class Record {
public:
    struct Column {
        std::string key;
        std::vector<double> values;  // [steps], NaN before the key was requested
    };
    struct Row {
        std::int64_t step = 0;
        std::vector<double> values;  // [columns]
    };

    // The first of the steps; the rows after it are of the steps that follow, one each.
    std::int64_t first() const { return first_; }
    std::int64_t steps() const {
        return columns_.empty() ? 0 : static_cast<std::int64_t>(columns_.front().values.size());
    }
    const std::vector<Column>& columns() const { return columns_; }
    std::vector<std::string> keys() const;
    // nullptr: the key is not recorded.
    const Column* find(const std::string& key) const;

    // Adds a key, with its value at `step`, the last one there is.
    void add(const std::string& key, std::int64_t step, double value);
    // Saved columns, of equal lengths.
    void add(Column column, std::int64_t first);
    // Allocates a further row, so that put() cannot fail.
    void reserve_row();
    // Replaces the row of its step, or appends it. A row of a step before the record began is dropped.
    void put(const Row& row) noexcept;

private:
    std::int64_t first_ = 0;
    std::vector<Column> columns_;
};

}  // namespace delam
