// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/step_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "file/input_file.hpp"
#include "text/error.hpp"

namespace cli {

namespace {

// The first line names the format and how many bytes come before the rooms.
constexpr std::string_view begins = "delam fields of a step 1 ";
constexpr std::size_t digits = 16, first_line = begins.size() + digits + 1;

std::int64_t whole(std::int64_t bytes) { return (bytes + 7) / 8 * 8; }

// Sets the offsets of items one behind the other.
void place(std::vector<StepItem>& items, std::int64_t first) {
    for (StepItem& item : items) {
        item.offset = first;
        first += whole(item.bytes());
    }
}

// Lines of the head, which ends at a multiple of 8 bytes.
std::string head_of(const std::vector<StepItem>& items, std::size_t values) {
    std::string head(first_line, ' ');
    for (const StepItem& item : items)
        head += fmt::format("{}{} {} {} {}\n", static_cast<char>(item.kind), static_cast<char>(item.type), item.count,
                            item.columns, item.name);
    while (head.size() % 8 != 7) head.push_back(' ');
    head.push_back('\n');
    return fmt::format("{}{:0{}}\n", begins, head.size() + values, digits) + head.substr(first_line);
}

}  // namespace

void StepRows::room(const std::string& name, std::int64_t rows, std::int64_t columns) {
    rooms_.push_back({name, StepItem::Kind::room, StepItem::Type::real, rows * columns, columns, 0});
}

std::vector<StepItem> StepRows::items() const {
    std::vector<StepItem> all = items_;
    all.insert(all.end(), rooms_.begin(), rooms_.end());
    place(all, static_cast<std::int64_t>(head_of(all, 0).size()));
    return all;
}

std::string StepRows::bytes() const {
    std::vector<StepItem> all = items_;
    all.insert(all.end(), rooms_.begin(), rooms_.end());
    std::size_t count = 0;
    for (const std::string& values : values_) count += values.size();
    std::string bytes = head_of(all, count);
    bytes.reserve(bytes.size() + count);
    for (const std::string& values : values_) bytes += values;
    return bytes;
}

std::string read_step(const std::string& path) {
    InputFile file(path);
    std::string bytes = file.read(static_cast<std::int64_t>(first_line));
    std::int64_t before_rooms = 0;
    if (bytes.size() == first_line)
        std::from_chars(bytes.data() + begins.size(), bytes.data() + begins.size() + digits, before_rooms);
    return bytes + file.read(before_rooms - static_cast<std::int64_t>(bytes.size()));
}

// The head ends with the first line that is blank.
std::vector<StepItem> step_items(std::string_view bytes, const std::string& path) {
    const Failure damaged(exit_scene, path + ": holds no fields of a step; run again without --resume");
    if (!bytes.starts_with(begins) || bytes.size() < first_line) throw damaged;
    std::vector<StepItem> items;
    std::size_t at = first_line;
    for (;;) {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos) throw damaged;
        const std::string_view line = bytes.substr(at, end - at);
        at = end + 1;
        if (line.find_first_not_of(' ') == std::string_view::npos) break;
        if (line.size() < 2) throw damaged;
        StepItem item;
        item.kind = static_cast<StepItem::Kind>(line[0]);
        item.type = static_cast<StepItem::Type>(line[1]);
        std::istringstream rest{std::string(line.substr(2))};
        if (!(rest >> item.count >> item.columns >> item.name) || item.count < 0 || item.columns < 0) throw damaged;
        items.push_back(item);
    }
    place(items, static_cast<std::int64_t>(at));
    for (const StepItem& item : items)
        if (item.kind != StepItem::Kind::room && item.offset + item.bytes() > static_cast<std::int64_t>(bytes.size()))
            throw damaged;
    return items;
}

double step_number(const std::vector<StepItem>& items, std::string_view bytes, std::string_view name) {
    const auto found = std::find_if(items.begin(), items.end(), [name](const StepItem& item) {
        return item.name == name && item.kind == StepItem::Kind::number;
    });
    if (found == items.end()) return std::numeric_limits<double>::quiet_NaN();
    const char* from = bytes.data() + found->offset;
    double real = 0;
    std::int64_t wide = 0;
    if (found->type == StepItem::Type::real) {
        std::memcpy(&real, from, sizeof real);
        return real;
    }
    std::memcpy(&wide, from, sizeof wide);
    return static_cast<double>(wide);
}

}  // namespace cli
