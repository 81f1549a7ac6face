// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/record.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

std::vector<std::string> Record::keys() const {
    std::vector<std::string> keys;
    for (const Column& column : columns_) keys.push_back(column.key);
    return keys;
}

const Record::Column* Record::find(const std::string& key) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.key == key; });
    return found == columns_.end() ? nullptr : &*found;
}

void Record::add(const std::string& key, std::int64_t step, double value) {
    const std::int64_t first = columns_.empty() ? step : first_;
    std::vector<double> values(index(step - first + 1), std::numeric_limits<double>::quiet_NaN());
    values.back() = value;
    add({key, std::move(values)}, first);
}

void Record::add(Column column, std::int64_t first) {
    columns_.push_back(std::move(column));
    first_ = first;
}

void Record::reserve_row() {
    for (Column& column : columns_)
        if (column.values.size() == column.values.capacity()) column.values.reserve(2 * column.values.size());
}

void Record::put(const Row& row) noexcept {
    if (row.step < first_) return;
    const auto at = index(row.step - first_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        std::vector<double>& values = columns_[c].values;
        if (at == values.size())
            values.push_back(row.values[c]);
        else
            values[at] = row.values[c];
    }
}

}  // namespace delam
