// SPDX-License-Identifier: BSD-3-Clause
// Measures the depth of a TOML text before toml++ reads it. toml++ calls itself once for each level of a key or a list
// when it copies, prints or removes a tree: a text of 60,000 levels would exhaust the stack.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/table/toml.hpp"
#include "text/error.hpp"

namespace cli {

constexpr std::int64_t most_scene_bytes = std::int64_t{16} << 20;

struct Depth {
    int levels = 0;
    int line = 0;  // the first that is as deep
};

// The most levels of tables, keys and lists around a value of a text: 1 for `a = 1`, 2 for `a.b = 1`, 3 for the `b` of
// `[[a]]`. In a text that is not TOML, at least as many up to its first error.
Depth deepest(std::string_view text);

// Throws SceneFailure at `place` (for a file with the line of the text) if the text is too deep, and
// toml::parse_error if it is not TOML. source: what toml++ records as the origin of the nodes.
toml::table parsed_text(std::string_view text, const Place& place, std::string_view source);

}  // namespace cli
