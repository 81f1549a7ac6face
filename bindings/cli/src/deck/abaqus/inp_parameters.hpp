// SPDX-License-Identifier: BSD-3-Clause
// The parameters of an input file: *PARAMETER defines them by expressions, <NAME> stands for the value of one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "text/error.hpp"

namespace cli {

class InpParameters {
public:
    // line: NAME = EXPRESSION, of the numbers, names, operators + - * / **, parentheses and functions that Abaqus
    // documents, or a text in quotes. Throws SceneFailure at `place`; nothing else is evaluated.
    void define(std::string_view line, const Place& place);
    // A line with the values of its references in their place. Throws SceneFailure where there is no such parameter.
    [[nodiscard]] std::string replaced(const std::string& line, const Place& place) const;

    using Value = std::variant<std::int64_t, double, std::string>;

private:
    std::map<std::string, Value, std::less<>> values_;  // by name, whose case counts
};

}  // namespace cli
