// SPDX-License-Identifier: BSD-3-Clause
// The keywords of an input file, their parameters and the values of these, as this program knows them; and what to do
// about those that stay out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli::abaqus {

enum class Use {
    mesh,      // belongs to the mesh
    both,      // belongs to the mesh and to the analysis
    deck,      // belongs to the analysis
    law,       // belongs to a material or a surface interaction
    no_law,    // the same, and stays out: refused where the material or interaction is used
    unneeded,  // asks for output, sets a solver, or is not needed by quasi-static steps: left out
    passed,    // a mesh does without it, an analysis is refused
    never      // stays out
};

struct Parameter {
    std::string name;
    std::vector<std::string> values;  // empty: any
};

struct Keyword {
    std::string name;
    Use use = Use::never;
    std::vector<Parameter> parameters;
    std::string instead;  // says what to do where it stays out; empty: in general words
};

// Blanks do not count, and a beginning is enough if no other name has it, as in Abaqus. written: in upper case.
const Keyword* keyword_of(std::string_view written);
const Parameter* parameter_of(const Keyword& keyword, std::string_view written);
// Returns the value that is meant; what is written where none is known.
std::string value_of(const Parameter& parameter, const std::string& written);

// Returns what to do about a keyword that is not imported.
std::string instead_of_keyword(std::string_view written);
// The same for a parameter that is known and stays out, or NAME=VALUE; "": it is read, or unknown.
std::string instead_of_parameter(std::string_view keyword, std::string_view parameter);
// The same for a type of elements; "": nothing is known.
std::string instead_of_element(std::string_view type);

// It says what to do where cohesive elements end within a body, or between bodies that share nodes elsewhere.
constexpr std::string_view sections_of_one_side =
    "give the cells on one side of the cohesive elements an *ELSET and a *SOLID SECTION of their own: bodies that "
    "share nodes are bonded, so that the rest stays whole";

}  // namespace cli::abaqus
