// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/left_out.hpp"

namespace cli::abaqus {

namespace {

struct Words {
    std::string_view name;
    std::string_view text;
};

constexpr Words keywords[] = {
    {"BEAM SECTION", "beams stay out: give solid cells, or a rigid *COUPLING"},
    {"CLEARANCE", "give the nodes their distance, or ADJUST= of *CONTACT PAIR"},
    {"DEBOND",
     "debonding by the virtual crack closure technique stays out: give *COHESIVE BEHAVIOR with "
     "*DAMAGE INITIATION and *DAMAGE EVOLUTION"},
    {"ELCOPY", "write the elements (*ELEMENT, *ELGEN)"},
    {"EMBEDDED ELEMENT", "embedded elements stay out: mesh the body around them"},
    {"FREQUENCY", "vibrations would change the result's meaning: steps are *STATIC"},
    {"MEMBRANE SECTION", "membranes stay out: give solid cells"},
    {"MODEL CHANGE",
     "parts and contact stay for the whole analysis: end it with the step before, or take out what "
     "is removed"},
    {"NCOPY", "write the nodes (*NODE, *NGEN)"},
    {"NFILL", "write the nodes (*NODE, *NGEN)"},
    {"PARAMETER DEPENDENCE", "tables of parameters stay out: give a *PARAMETER the value"},
    {"PLASTIC", "plasticity would change the result: bodies are elastic; take it out of a copy where they stay so"},
    {"RIGID SURFACE", "rigid surfaces stay out: give a body of solid cells, or an obstacle in the scene"},
    {"SHELL GENERAL SECTION", "shells stay out: give solid cells or SC8R"},
    {"SURFACE BEHAVIOUR", "write *SURFACE BEHAVIOR"},
    {"SYSTEM", "give the coordinates of the nodes in one system, or *NODE, SYSTEM="},
    {"UEL PROPERTY", "user elements stay out: cohesive ones are COH2D4, COH3D6, COH3D8 here"},
    {"USER ELEMENT", "user elements stay out: cohesive ones are COH2D4, COH3D6, COH3D8 here"},
    {"USER MATERIAL",
     "user materials stay out: give *ELASTIC, of cohesive elements with *DAMAGE INITIATION and "
     "*DAMAGE EVOLUTION; a program that calls the library may have a law of its own"},
    {"VISCO", "viscous materials stay out: steps are *STATIC"},
};
// A type has the words of the first row whose name it begins with.
constexpr Words elements[] = {
    {"B2", "beams stay out: give solid cells, or a rigid *COUPLING"},
    {"B3", "beams stay out: give solid cells, or a rigid *COUPLING"},
    {"CAX", "axisymmetry stays out: give a sector of solid cells (C3D8I)"},
    {"COHAX", "axisymmetry stays out: give a sector of solid cells with COH3D8"},
    {"CGAX", "axisymmetry stays out: give a sector of solid cells (C3D8I)"},
    {"CPEG", "generalised plane strain stays out: give CPE4I, or solid cells"},
    {"COH", "give COH2D4, COH3D6 or COH3D8"},
    {"CONN", "connectors stay out: give *COUPLING or *EQUATION"},
    {"DC", "heat transfer stays out: give temperatures (*TEMPERATURE)"},
    {"MASS", "masses play no part in quasi-static steps: take the element out"},
    {"R2D", "rigid elements stay out: give *RIGID BODY with a set of nodes"},
    {"R3D", "rigid elements stay out: give *RIGID BODY with a set of nodes"},
    {"SAX", "axisymmetry stays out: give a sector of solid cells (C3D8I)"},
    {"SPRING", "springs stay out: give a bar of solid cells"},
    {"STRI", "shells stay out: give solid cells or SC8R"},
    {"S3", "shells stay out: give solid cells or SC8R"},
    {"S4", "shells stay out: give solid cells or SC8R"},
    {"S8", "shells stay out: give solid cells or SC8R"},
    {"T2D", "trusses stay out: give solid cells"},
    {"T3D", "trusses stay out: give solid cells"},
    {"U", "user elements stay out: cohesive ones are COH2D4, COH3D6, COH3D8 here"},
};

}  // namespace

std::string instead_of_keyword(std::string_view keyword) {
    for (const auto& [name, text] : keywords)
        if (keyword == name) return std::string(text);
    return "this keyword would change the result and cannot be imported; take it out of a copy of the deck to go on "
           "without it, or write the scene by hand (SCENE.md)";
}

std::string instead_of_element(std::string_view type) {
    for (const auto& [name, text] : elements)
        if (type.starts_with(name)) return std::string(text);
    return "";
}

}  // namespace cli::abaqus
