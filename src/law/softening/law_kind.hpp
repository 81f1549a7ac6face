// SPDX-License-Identifier: BSD-3-Clause
// Items of the file of a shape of softening about the kind of law that it makes:
//
//   kind          its LawKind
//   parameters    optional: an array of ShapeParameter, those that no other shape has
//   hashed(add)   adds every number and text that the shape holds to the hash of the scene; needed with parameters
//   missing()     optional: what the host has not given yet, in words, or null
#pragma once

#include <limits>

namespace delam {

// An interval of finite numbers, with the words that people read.
struct ParameterRange {
    const char* words;
    double lower;
    double upper;
    bool lower_open;  // true: the bound itself is outside
    bool upper_open;

    constexpr bool allows(double v) const {
        return (lower_open ? v > lower : v >= lower) && (upper_open ? v < upper : v <= upper);
    }
};
inline constexpr double no_bound = std::numeric_limits<double>::infinity();
inline constexpr ParameterRange positive{"finite and > 0", 0.0, no_bound, true, true};
inline constexpr ParameterRange not_negative{"finite and >= 0", 0.0, no_bound, false, true};
inline constexpr ParameterRange below_one{">= 0 and < 1", 0.0, 1.0, false, true};

// Toughnesses that a kind of law takes, by mode and with their exponents.
enum class Toughnesses {
    none,            // the callbacks of the host give them
    total,           // G^c alone: onset and end are one
    onset_and_total  // G^o and G^c
};

struct LawKind {
    const char* name;
    const char* meaning;
    Toughnesses toughnesses;
};

// A parameter that one shape alone has: a number, or the table of delam_law_set_table, which has no get and set.
template <class Shape>
struct ShapeParameter {
    enum class Type { real, table };
    Type type;
    const char* key;
    const char* unit;
    const char* initial;  // "": must be given
    ParameterRange range;
    const char* meaning;
    double (Shape::*get)() const = nullptr;
    void (Shape::*set)(double) = nullptr;
};

}  // namespace delam
