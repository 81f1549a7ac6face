// SPDX-License-Identifier: BSD-3-Clause
// The parameters of laws: by key, with unit, default, range and meaning in one table. Those of one shape alone stand in
// the file of that shape.
#pragma once

#include <span>
#include <string>

#include "law/law.hpp"

namespace delam {

struct LawParameter {
    const char* key;
    const char* type;  // real, text or table
    const char* unit;
    const char* initial;   // "": must be given
    ParameterRange range;  // of a table: of each number in it
    const char* meaning;
    unsigned kinds;                              // bit i: softening i has it
    unsigned criteria;                           // bit i: criterion i has it
    double Law::*value = nullptr;                // null: it belongs to the shape
    double Law::*second = nullptr;               // set along with it
    double Law::*instead_of = nullptr;           // one of the two is given, the other is 0
    double Law::*like = nullptr;                 // takes its place where it is 0, not given
    bool of_onset = false;                       // the criterion is that of the onset
    double (*read)(const Softening&) = nullptr;  // of a number of the shape
    void (*write)(Softening&, double) = nullptr;
};
std::span<const LawParameter> law_parameters();
// Has the law this parameter, with its kind and its criterion?
bool applies(const LawParameter& parameter, const Law& law);
// Null: it has none of this name.
const LawParameter* find_parameter(const Law& law, const std::string& key);
// "normal_stiffness, ...", of one type
std::string known_parameters(const Law& law, const std::string& type);
// Sets a number by its public name (delam_law_set), whatever its value; false: the law has no such number.
bool set_parameter(Law& law, const std::string& key, double value);

}  // namespace delam
