// SPDX-License-Identifier: BSD-3-Clause
#include "scene/table/setting.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "scene/table/scene_text.hpp"
#include "text/error.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

// A step of a path: into a table by its key, into a list by its index.
using PathStep = std::variant<std::string, std::size_t>;

[[noreturn]] void fail(const std::string& path, const std::string& text) {
    throw SceneFailure({std::string(setting_source), path, 0}, text);
}

bool bare(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

std::vector<PathStep> parsed_path(const std::string& text) {
    std::vector<PathStep> steps;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        const bool first = steps.empty();
        if (!first && *at == '[') {
            std::size_t index = 0;
            const auto [rest, code] = std::from_chars(at + 1, end, index);
            if (code != std::errc() || rest == end || *rest != ']') break;
            steps.emplace_back(index);
            at = rest + 1;
            continue;
        }
        if (!first && *at++ != '.') break;
        const char* const stop = std::find_if_not(at, end, bare);
        if (stop == at) break;
        steps.emplace_back(std::string(at, stop));
        at = stop;
        if (at == end) return steps;
    }
    if (steps.empty() || at != end || text.back() != ']')
        fail(text, "is no key: a path like geometry.h or laws[0].normal_onset is expected");
    if (steps.size() > most_levels)
        fail(shortened(text), fmt::format("has {} levels: at most {} are allowed", steps.size(), most_levels));
    return steps;
}

std::string shown(std::span<const PathStep> steps) {
    std::string out;
    for (const PathStep& step : steps) {
        if (const auto* key = std::get_if<std::string>(&step))
            out += (out.empty() ? "" : ".") + *key;
        else
            out += fmt::format("[{}]", std::get<std::size_t>(step));
    }
    return out;
}

// A table with the one key `value`; its nodes record their origin.
std::optional<toml::table> parsed(const std::string& value, const std::string& path) {
    try {
        toml::table table = parsed_text("value = " + value, {std::string(setting_source), path, 0}, setting_source);
        if (table.size() == 1) return table;
    } catch (const toml::parse_error&) {
    }
    return std::nullopt;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

// The value as TOML text.
std::string checked_value(const std::string& path, const std::string& value) {
    const bool one_line =
        std::none_of(value.begin(), value.end(), [](unsigned char c) { return std::iscntrl(c) != 0; });
    if (one_line && parsed(value, path)) return value;
    if (one_line && !value.empty() && std::isalpha(static_cast<unsigned char>(value.front())) != 0 &&
        parsed(quoted(value), path))
        return quoted(value);
    fail(path, fmt::format("{}: a number, true, false, a text or a list is expected, as in TOML",
                           value.empty() ? "there is no value" : quoted(value) + " is no value"));
}

// The target of a step of the path from `parent`: nullptr if a table lacks the key. A key of digits is a place in a
// list.
toml::node* entry(toml::node& parent, std::span<PathStep> steps, std::size_t depth, const std::string& path) {
    if (const auto* key = std::get_if<std::string>(&steps[depth]); key != nullptr && parent.is_array()) {
        std::size_t index = 0;
        const char* const end = key->data() + key->size();
        if (const auto [rest, code] = std::from_chars(key->data(), end, index); code == std::errc() && rest == end)
            steps[depth] = index;
    }
    const auto fail_here = [&](const std::string& text) { fail(path, shown(steps.first(depth)) + text); };
    if (const auto* key = std::get_if<std::string>(&steps[depth])) {
        if (parent.is_array())
            fail_here(fmt::format(" is a list: {}[0] is its first entry", shown(steps.first(depth))));
        if (!parent.is_table()) fail_here(" is no table");
        return parent.as_table()->get(*key);
    }
    if (!parent.is_array()) fail_here(" is no list");
    toml::array& list = *parent.as_array();
    const std::size_t index = std::get<std::size_t>(steps[depth]);
    if (index >= list.size())
        fail_here(fmt::format(" has {} {}, counted from 0", list.size(), list.size() == 1 ? "entry" : "entries"));
    return list.get(index);
}

}  // namespace

void apply_setting(toml::table& root, const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) fail("", quoted(setting) + ": KEY=VALUE is expected");
    const std::string path = setting.substr(0, equals);
    std::vector<PathStep> steps = parsed_path(path);
    std::string value = checked_value(path, setting.substr(equals + 1));

    // Follows the path as far as the scene goes; the last step, or the first missing one, receives the value.
    toml::node* parent = &root;
    std::size_t depth = 0;
    for (toml::node* next = nullptr; (next = entry(*parent, steps, depth, path)) != nullptr; ++depth) {
        if (depth + 1 == steps.size()) break;
        parent = next;
    }
    for (std::size_t i = steps.size() - 1; i > depth; --i) {
        const auto* key = std::get_if<std::string>(&steps[i]);
        if (key == nullptr) fail(path, shown(std::span(steps).first(i)) + " is not there");
        value = fmt::format("{{ {} = {} }}", *key, value);
    }
    toml::table holder = *parsed(value, path);
    // Moved, because a copy loses its origin.
    holder.get("value")->visit([&](auto& node) {
        if (const auto* key = std::get_if<std::string>(&steps[depth])) {
            parent->as_table()->insert_or_assign(*key, std::move(node));
        } else {
            toml::array& list = *parent->as_array();
            list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(std::get<std::size_t>(steps[depth])),
                         std::move(node));
        }
    });
}

}  // namespace cli
