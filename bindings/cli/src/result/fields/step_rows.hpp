// SPDX-License-Identifier: BSD-3-Clause
// The fields of one step as the bytes of a file: a head of text, which names arrays and their shapes, then the arrays
// one behind the other, as the processor has them. Those whose values others write come last.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cli {

// One array, or a single number.
struct StepItem {
    enum class Kind : char { number = 'n', rows = 'r', room = 'o', group = 'g' };
    enum class Type : char { real = 'd', wide = 'l', narrow = 'i' };

    std::string name;  // GROUP/NAME within a group, GROUP/ for the group itself
    Kind kind = Kind::rows;
    Type type = Type::real;
    std::int64_t count = 0;    // of values
    std::int64_t columns = 0;  // 0: a vector
    std::int64_t offset = 0;   // of the first byte in the file

    [[nodiscard]] std::int64_t rows() const { return columns > 0 ? count / columns : count; }
    [[nodiscard]] std::int64_t bytes() const { return count * (type == Type::narrow ? 4 : 8); }
};

class StepRows {
public:
    void number(const std::string& name, double value) { add(name, StepItem::Kind::number, &value, 1, 0); }
    void number(const std::string& name, std::int64_t value) { add(name, StepItem::Kind::number, &value, 1, 0); }
    template <class T>
    void rows(const std::string& name, const std::vector<T>& values, std::size_t columns) {
        add(name, StepItem::Kind::rows, values.data(), values.size(), columns);
    }
    void group(const std::string& name) { add<double>(name + "/", StepItem::Kind::group, nullptr, 0, 0); }
    // Leaves room for numbers.
    void room(const std::string& name, std::int64_t rows, std::int64_t columns);

    // Returns the file up to its first room.
    [[nodiscard]] std::string bytes() const;
    // Returns where everything stands in that file.
    [[nodiscard]] std::vector<StepItem> items() const;

private:
    static constexpr char zeros[8] = {};

    template <class T>
    void add(const std::string& name, StepItem::Kind kind, const T* values, std::size_t count, std::size_t columns) {
        const auto type = std::is_same_v<T, double>         ? StepItem::Type::real
                          : std::is_same_v<T, std::int64_t> ? StepItem::Type::wide
                                                            : StepItem::Type::narrow;
        items_.push_back({name, kind, type, static_cast<std::int64_t>(count), static_cast<std::int64_t>(columns), 0});
        if (count == 0) return;
        std::string& bytes = values_.emplace_back(reinterpret_cast<const char*>(values), count * sizeof(T));
        bytes.append(zeros, (8 - bytes.size() % 8) % 8);
    }

    std::vector<StepItem> items_, rooms_;
    std::vector<std::string> values_;  // of items that have any
};

// Reads such a file up to its first room.
std::string read_step(const std::string& path);
// Returns what stands where in these bytes. Throws Failure(exit_scene) if it is none; path: for the message.
std::vector<StepItem> step_items(std::string_view bytes, const std::string& path);
// Returns the single number of this name; NaN: there is none.
double step_number(const std::vector<StepItem>& items, std::string_view bytes, std::string_view name);

}  // namespace cli
