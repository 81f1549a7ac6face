// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/keywords.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "text/wording.hpp"

namespace cli::abaqus {

namespace {

struct Row {
    std::string_view name;
    Use use;
    std::string_view parameters = "";  // "NAME, NAME=VALUE|VALUE"
    std::string_view instead = "";
};

constexpr Row rows[] = {
    {"NODE", Use::mesh, "NSET, SYSTEM=R|C|S, INPUT"},
    {"ELEMENT", Use::mesh, "TYPE, ELSET, INPUT"},
    {"NSET", Use::mesh, "NSET, GENERATE, INSTANCE, INTERNAL, UNSORTED, ELSET"},
    {"ELSET", Use::mesh, "ELSET, GENERATE, INSTANCE, INTERNAL, UNSORTED"},
    {"SURFACE", Use::mesh, "NAME, TYPE=ELEMENT|NODE, INTERNAL"},
    {"SYSTEM", Use::mesh},
    {"PART", Use::mesh, "NAME"},
    {"END PART", Use::mesh},
    {"ASSEMBLY", Use::mesh, "NAME"},
    {"END ASSEMBLY", Use::mesh},
    {"INSTANCE", Use::mesh, "NAME, PART"},
    {"END INSTANCE", Use::mesh},
    {"TIE", Use::mesh, "NAME, ADJUST, POSITION TOLERANCE, TYPE, NO ROTATION, NO THICKNESS, CONSTRAINT RATIO"},
    {"NGEN", Use::mesh, "NSET"},
    {"NFILL", Use::mesh, "NSET"},
    {"NCOPY", Use::mesh, "CHANGE NUMBER, OLD SET, NEW SET, SHIFT"},
    {"ELGEN", Use::mesh, "ELSET"},
    {"ELCOPY", Use::mesh, "ELEMENT SHIFT, OLD SET, SHIFT NODES, NEW SET"},
    {"DISTRIBUTION", Use::mesh, "NAME, LOCATION=ELEMENT, TABLE, INPUT"},
    {"DISTRIBUTION TABLE", Use::mesh, "NAME"},
    {"INCLUDE", Use::mesh, "INPUT"},
    {"HEADING", Use::both},
    {"PARAMETER", Use::both},
    {"SOLID SECTION", Use::both,
     "ELSET, MATERIAL, ORIENTATION, CONTROLS, COMPOSITE, STACK DIRECTION, SYMMETRIC, LAYUP, "
     "OFFSET, POISSON, SECTION INTEGRATION"},
    {"SHELL SECTION", Use::both,
     "ELSET, MATERIAL, ORIENTATION, CONTROLS, COMPOSITE, STACK DIRECTION, SYMMETRIC, LAYUP, "
     "OFFSET, POISSON, SECTION INTEGRATION"},
    {"COHESIVE SECTION", Use::both,
     "ELSET, MATERIAL, RESPONSE=TRACTION SEPARATION, THICKNESS=SPECIFIED|GEOMETRY, CONTROLS, "
     "ORIENTATION, STACK DIRECTION"},
    {"ORIENTATION", Use::both, "NAME, DEFINITION=COORDINATES, SYSTEM=RECTANGULAR|CYLINDRICAL"},
    {"STEP", Use::both, "NAME, NLGEOM, INC, AMPLITUDE=RAMP|STEP, UNSYMM, EXTRAPOLATION, CONVERT SDI"},
    {"END STEP", Use::both},
    {"AMPLITUDE", Use::deck,
     "NAME, DEFINITION=TABULAR|SMOOTH STEP|EQUALLY SPACED, FIXED INTERVAL, BEGIN, TIME=STEP TIME|TOTAL TIME, "
     "VALUE=RELATIVE|ABSOLUTE, SMOOTH, INPUT"},
    {"BOUNDARY", Use::deck, "AMPLITUDE, OP=MOD|NEW, TYPE=DISPLACEMENT|VELOCITY, FIXED"},
    {"CLOAD", Use::deck, "AMPLITUDE, OP=MOD|NEW"},
    {"CONTACT", Use::deck, "OP=MOD|NEW"},
    {"CONTACT INCLUSIONS", Use::deck, "ALL EXTERIOR"},
    {"CONTACT INITIALIZATION ASSIGNMENT", Use::deck},
    {"CONTACT INITIALIZATION DATA", Use::deck,
     "NAME, SEARCH ABOVE, SEARCH BELOW, SEARCH NSET, INITIAL CLEARANCE, INTERFERENCE FIT"},
    {"CONTACT PAIR", Use::deck,
     "INTERACTION, TYPE, SMALL SLIDING, ADJUST, TIED, "
     "EXTENSION ZONE, GEOMETRIC CORRECTION, HCRIT, MECHANICAL CONSTRAINT, NO THICKNESS, SLIDE "
     "DISTANCE, SMOOTH, SUPPLEMENTARY CONSTRAINTS, TRACKING, CPSET"},
    {"CONTACT PROPERTY ASSIGNMENT", Use::deck},
    {"COUPLING", Use::deck, "CONSTRAINT NAME, REF NODE, SURFACE"},
    {"DISTRIBUTING", Use::deck, "COUPLING=CONTINUUM, WEIGHTING METHOD=UNIFORM"},
    {"DLOAD", Use::deck, "AMPLITUDE, OP=MOD|NEW"},
    {"DSLOAD", Use::deck, "AMPLITUDE, OP=MOD|NEW, FOLLOWER, ORIENTATION, CONSTANT RESULTANT"},
    {"DYNAMIC", Use::deck,
     "APPLICATION=QUASI-STATIC, EXPLICIT, ADIABATIC, ALPHA, BETA, DIRECT, GAMMA, HAFTOL, "
     "HALFINC SCALE FACTOR, IMPACT, INCREMENTATION, INITIAL, NOHAF, SINGULAR MASS, TIME "
     "INTEGRATOR"},
    {"EQUATION", Use::deck, "INPUT"},
    {"INITIAL CONDITIONS", Use::deck, "TYPE=CONTACT|TEMPERATURE, NORMAL, INPUT"},
    {"KINEMATIC", Use::deck},
    {"MPC", Use::deck, "INPUT"},
    {"RIGID BODY", Use::deck, "REF NODE, NSET, PIN NSET, TIE NSET, ROT NODE, ANALYTICAL SURFACE, ELSET"},
    {"STATIC", Use::deck, "DIRECT, STABILIZE, RIKS, SOLVER, FACTOR, ALLSDTOL, CONTINUE, LONG TERM"},
    {"SURFACE PROPERTY ASSIGNMENT", Use::deck, "PROPERTY"},
    {"TEMPERATURE", Use::deck, "AMPLITUDE, OP=MOD|NEW, INPUT"},
    {"TRANSFORM", Use::deck, "NSET, TYPE=R"},
    {"TRANSVERSE SHEAR STIFFNESS", Use::both},
    {"MATERIAL", Use::deck, "NAME, RTOL, SRATE FACTOR"},
    {"SURFACE INTERACTION", Use::deck, "NAME, TRACKING THICKNESS, UNSYMM"},
    {"COHESIVE BEHAVIOR", Use::law,
     "ELIGIBILITY=CURRENT CONTACTS|ORIGINAL CONTACTS|SPECIFIED CONTACTS, REPEATED CONTACTS, "
     "TYPE=UNCOUPLED, DEPENDENCIES"},
    {"DAMAGE EVOLUTION", Use::law,
     "TYPE=ENERGY|DISPLACEMENT, SOFTENING=LINEAR|EXPONENTIAL|TABULAR, MIXED MODE "
     "BEHAVIOR=BK|POWER LAW|TABULAR|MODE INDEPENDENT, MODE MIX RATIO=ENERGY|TRACTION, POWER, "
     "DEGRADATION=MAXIMUM, DEPENDENCIES"},
    {"DAMAGE INITIATION", Use::law, "CRITERION=MAXS|QUADS|MAXE|QUADE|MAXU|QUADU, DEPENDENCIES, TOLERANCE"},
    {"DAMAGE STABILIZATION", Use::law},
    {"ELASTIC", Use::law, "TYPE=ISOTROPIC|ORTHOTROPIC|ENGINEERING CONSTANTS|LAMINA|TRACTION, MODULI, DEPENDENCIES"},
    {"EXPANSION", Use::law, "TYPE=ISO|ORTHO, ZERO, DEPENDENCIES"},
    {"CONTACT DAMPING", Use::law, "DEFINITION, TANGENT FRACTION"},
    {"CONTACT STABILIZATION", Use::deck, "AMPLITUDE, RESET, SCALE FACTOR, TANGENT FRACTION, RANGE"},
    {"FRICTION", Use::law,
     "ANISOTROPIC, DEPENDENCIES, ELASTIC SLIP, EXPONENTIAL DECAY, LAGRANGE, ROUGH, SHEAR "
     "TRACTION SLOPE, SLIP TOLERANCE, TAUMAX, TEST DATA"},
    {"SURFACE BEHAVIOR", Use::law, "AUGMENTED LAGRANGE, DIRECT, NO SEPARATION, PENALTY, PRESSURE-OVERCLOSURE"},
    {"BIAXIAL TEST DATA", Use::no_law},
    {"CAP HARDENING", Use::no_law},
    {"CAP PLASTICITY", Use::no_law},
    {"CAST IRON PLASTICITY", Use::no_law},
    {"CLAY PLASTICITY", Use::no_law},
    {"COMBINED TEST DATA", Use::no_law},
    {"CONCRETE", Use::no_law},
    {"CONCRETE COMPRESSION DAMAGE", Use::no_law},
    {"CONCRETE COMPRESSION HARDENING", Use::no_law},
    {"CONCRETE DAMAGED PLASTICITY", Use::no_law},
    {"CONCRETE TENSION DAMAGE", Use::no_law},
    {"CONCRETE TENSION STIFFENING", Use::no_law},
    {"CREEP", Use::no_law, "",
     "viscous strain stays out: bodies are elastic; take it out of a copy of the deck if the test is too short for it"},
    {"CRUSHABLE FOAM", Use::no_law},
    {"CRUSHABLE FOAM HARDENING", Use::no_law},
    {"CYCLIC HARDENING", Use::no_law},
    {"DRUCKER PRAGER", Use::no_law},
    {"DRUCKER PRAGER HARDENING", Use::no_law},
    {"FAIL STRAIN", Use::no_law},
    {"FAIL STRESS", Use::no_law},
    {"GAP CONDUCTANCE", Use::no_law},
    {"HYPERELASTIC", Use::no_law},
    {"HYPERFOAM", Use::no_law},
    {"HYPOELASTIC", Use::no_law},
    {"MOHR COULOMB", Use::no_law},
    {"MOHR COULOMB HARDENING", Use::no_law},
    {"NO COMPRESSION", Use::no_law},
    {"NO TENSION", Use::no_law},
    {"PLANAR TEST DATA", Use::no_law},
    {"PLASTIC", Use::no_law, "",
     "plasticity would change the result: bodies are elastic; take it out of a copy where "
     "they stay so"},
    {"PLASTICITY CORRECTION", Use::no_law},
    {"POROUS METAL PLASTICITY", Use::no_law},
    {"POTENTIAL", Use::no_law},
    {"RATE DEPENDENT", Use::no_law},
    {"SHEAR FAILURE", Use::no_law},
    {"SHEAR TEST DATA", Use::no_law},
    {"SWELLING", Use::no_law},
    {"TENSILE FAILURE", Use::no_law},
    {"UNIAXIAL TEST DATA", Use::no_law},
    {"USER MATERIAL", Use::no_law, "",
     "user materials stay out: give *ELASTIC, of cohesive elements with *DAMAGE INITIATION "
     "and *DAMAGE EVOLUTION; a program that calls the library may have a law of its own"},
    {"VISCOELASTIC", Use::no_law},
    {"VISCOUS", Use::no_law},
    {"VOLUMETRIC TEST DATA", Use::no_law},
    {"CONDUCTIVITY", Use::unneeded},
    {"CONTACT CONTROLS", Use::unneeded},
    {"CONTACT FILE", Use::unneeded},
    {"CONTACT FORMULATION", Use::unneeded},
    {"CONTACT OUTPUT", Use::unneeded},
    {"CONTACT PRINT", Use::unneeded},
    {"CONTOUR INTEGRAL", Use::unneeded},
    {"CONTROLS", Use::unneeded},
    {"DAMPING", Use::unneeded},
    {"DENSITY", Use::unneeded},
    {"DEPVAR", Use::unneeded},
    {"DIAGNOSTICS", Use::unneeded},
    {"DISPLAY BODY", Use::unneeded},
    {"EL FILE", Use::unneeded},
    {"EL PRINT", Use::unneeded},
    {"ELEMENT OUTPUT", Use::unneeded},
    {"ENERGY FILE", Use::unneeded},
    {"ENERGY OUTPUT", Use::unneeded},
    {"ENERGY PRINT", Use::unneeded},
    {"FILE FORMAT", Use::unneeded},
    {"FILE OUTPUT", Use::unneeded},
    {"FILTER", Use::unneeded},
    {"HOURGLASS STIFFNESS", Use::unneeded},
    {"INCREMENTATION OUTPUT", Use::unneeded},
    {"INTEGRATED OUTPUT", Use::unneeded},
    {"INTEGRATED OUTPUT SECTION", Use::unneeded},
    {"MONITOR", Use::unneeded},
    {"NODE FILE", Use::unneeded},
    {"NODE OUTPUT", Use::unneeded},
    {"NODE PRINT", Use::unneeded},
    {"OUTPUT", Use::unneeded},
    {"PHYSICAL CONSTANTS", Use::unneeded},
    {"PREPRINT", Use::unneeded},
    {"PRINT", Use::unneeded},
    {"RESTART", Use::unneeded},
    {"SECTION FILE", Use::unneeded},
    {"SECTION PRINT", Use::unneeded},
    {"SOLVER CONTROLS", Use::unneeded},
    {"SPECIFIC HEAT", Use::unneeded},
    {"SURFACE OUTPUT", Use::unneeded},
    {"TIME POINTS", Use::unneeded},
    {"USER OUTPUT VARIABLES", Use::unneeded},
    {"SECTION CONTROLS", Use::deck,
     "NAME, DISTORTION CONTROL, ELEMENT DELETION, HOURGLASS, KINEMATIC SPLIT, LENGTH RATIO, "
     "MAX DEGRADATION, SECOND ORDER ACCURACY, VISCOSITY, WEIGHT FACTOR, INITIAL GAP OPENING, "
     "PERCENT STRETCH, RAMP INITIAL STRESS, DRILL STIFFNESS, PERTURBATION, HARMONIC"},
    {"CONTACT EXCLUSIONS", Use::passed},
    {"FIELD", Use::passed},
    {"USER DEFINED FIELD", Use::passed},
    {"BEAM SECTION", Use::never, "", "beams stay out: give solid cells, or a rigid *COUPLING"},
    {"CLEARANCE", Use::never, "", "give the nodes their distance, or ADJUST= of *CONTACT PAIR"},
    {"DEBOND", Use::never, "",
     "debonding by the virtual crack closure technique stays out: give *COHESIVE BEHAVIOR "
     "with *DAMAGE INITIATION and *DAMAGE EVOLUTION"},
    {"EMBEDDED ELEMENT", Use::never, "", "embedded elements stay out: mesh the body around them"},
    {"FREQUENCY", Use::never, "", "vibrations would change the result's meaning: steps are *STATIC"},
    {"MEMBRANE SECTION", Use::never, "", "membranes stay out: give solid cells"},
    {"MODEL CHANGE", Use::never, "",
     "parts and contact stay for the whole analysis: end it with the step before, or take out "
     "what is removed"},
    {"PARAMETER DEPENDENCE", Use::never, "", "tables of parameters stay out: give a *PARAMETER the value"},
    {"RIGID SURFACE", Use::never, "",
     "rigid surfaces stay out: give a body of solid cells, or an obstacle in the scene (SCENE.md, [[obstacles]])"},
    {"SHELL GENERAL SECTION", Use::never, "", "shells stay out: give solid cells or SC8R"},
    {"UEL PROPERTY", Use::never, "", "user elements stay out: cohesive ones are COH2D4, COH3D6, COH3D8 here"},
    {"USER ELEMENT", Use::never, "", "user elements stay out: cohesive ones are COH2D4, COH3D6, COH3D8 here"},
    {"VISCO", Use::never, "", "viscous materials stay out: bodies are elastic, and steps are *STATIC"},
};

struct Words {
    std::string_view name;
    std::string_view text;
};

constexpr std::string_view analytical =
    "analytical rigid surfaces stay out: give a body of solid cells whose nodes a *RIGID BODY, TIE NSET= holds, or an "
    "obstacle in the scene (SCENE.md, [[obstacles]])";

// Parameters that stay out, or values of theirs (NAME=VALUE), each by its keyword.
constexpr std::pair<std::string_view, Words> parameters[] = {
    {"CONTACT INITIALIZATION DATA",
     {"INTERFERENCE FIT",
      "INTERFERENCE FIT: faces that are pressed at the start are imported as they are meshed: give the nodes their "
      "distance, or ADJUST= of *CONTACT PAIR"}},
    {"CONTACT INITIALIZATION DATA",
     {"INITIAL CLEARANCE",
      "INITIAL CLEARANCE: faces that are parted at the start are imported as they are meshed: give the nodes their "
      "distance, or ADJUST= of *CONTACT PAIR"}},
    {"CONTACT PAIR", {"TIED", "TIED is not imported: give *TIE; bodies that share nodes are bonded, too"}},
    {"DSLOAD", {"ORIENTATION", "ORIENTATION is not imported: give the direction along x, y, z"}},
    {"DYNAMIC", {"EXPLICIT", "explicit steps stay out: give *STATIC, which has no inertia"}},
    {"FRICTION",
     {"ROUGH", "ROUGH would let no faces slide: contact is without friction here; give *COHESIVE BEHAVIOR a law"}},
    {"RIGID BODY", {"ANALYTICAL SURFACE", analytical}},
    {"RIGID BODY", {"ELSET", "ELSET is not imported: give the nodes of these elements, as NSET= or TIE NSET="}},
    {"SURFACE", {"TYPE=CYLINDER", analytical}},
    {"SURFACE", {"TYPE=REVOLUTION", analytical}},
    {"SURFACE", {"TYPE=SEGMENTS", analytical}},
    {"SURFACE BEHAVIOR",
     {"NO SEPARATION",
      "NO SEPARATION would hold faces together that slide freely: that is not imported; give *COHESIVE BEHAVIOR a "
      "law"}},
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

std::string without_blanks(std::string_view text) {
    std::string out(text);
    std::erase_if(out, [](unsigned char c) { return std::isspace(c) != 0; });
    return out;
}

std::vector<std::string_view> split(std::string_view text, std::string_view between) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(between), text.size());
        out.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + between.size(), text.size()));
    }
    return out;
}

Keyword keyword_from(const Row& row) {
    Keyword out{std::string(row.name), row.use, {}, std::string(row.instead)};
    for (const std::string_view each : split(row.parameters, ", ")) {
        const std::size_t equals = std::min(each.find('='), each.size());
        Parameter parameter{std::string(each.substr(0, equals)), {}};
        for (const std::string_view value : split(each.substr(std::min(equals + 1, each.size())), "|"))
            parameter.values.emplace_back(value);
        out.parameters.push_back(std::move(parameter));
    }
    return out;
}

// Returns the keywords by their names without blanks.
const std::map<std::string, Keyword, std::less<>>& all() {
    static const auto made = [] {
        std::map<std::string, Keyword, std::less<>> out;
        for (const Row& row : rows) out.emplace(without_blanks(row.name), keyword_from(row));
        return out;
    }();
    return made;
}

// Shorter beginnings are too likely to be other words.
constexpr std::size_t least_letters = 3;

// Returns the position of the name that is written, or begins so while no other does; their number: there is none.
template <class NameAt>
std::size_t meant(std::string_view written, std::size_t count, NameAt name_at) {
    const std::string bare = without_blanks(written);
    std::size_t found = count, others = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = without_blanks(name_at(i));
        if (name == bare) return i;
        if (bare.size() < least_letters || !name.starts_with(bare)) continue;
        others += found < count ? 1 : 0;
        found = i;
    }
    return others == 0 ? found : count;
}

}  // namespace

const Keyword* keyword_of(std::string_view written) {
    const std::string bare = without_blanks(written);
    const auto found = all().lower_bound(bare);
    if (found == all().end() || !found->first.starts_with(bare)) return nullptr;
    if (found->first == bare) return &found->second;
    const auto next = std::next(found);
    const bool alone = next == all().end() || !next->first.starts_with(bare);
    return alone && bare.size() >= least_letters ? &found->second : nullptr;
}

const Parameter* parameter_of(const Keyword& keyword, std::string_view written) {
    const auto& known = keyword.parameters;
    const std::size_t at = meant(written, known.size(), [&](std::size_t i) { return std::string_view(known[i].name); });
    return at < known.size() ? &known[at] : nullptr;
}

std::string value_of(const Parameter& parameter, const std::string& written) {
    const auto& known = parameter.values;
    const std::size_t at = meant(written, known.size(), [&](std::size_t i) { return std::string_view(known[i]); });
    return at < known.size() ? known[at] : written;
}

std::string instead_of_keyword(std::string_view written) {
    const Keyword* keyword = keyword_of(written);
    if (keyword != nullptr && !keyword->instead.empty()) return keyword->instead;
    if (keyword == nullptr) {
        std::vector<std::string> names;
        for (const auto& [bare, known] : all())
            if (std::max(known.name.size(), written.size()) - std::min(known.name.size(), written.size()) <= 2)
                names.push_back(known.name);
        const std::string near = suggestion(written, names);
        if (!near.empty())
            return "unknown keyword" + near +
                   "; another one of Abaqus cannot be imported: write the scene by hand (SCENE.md)";
    }
    return "this keyword would change the result and cannot be imported; take it out of a copy of the deck to go on "
           "without it, or write the scene by hand (SCENE.md)";
}

std::string instead_of_parameter(std::string_view keyword, std::string_view parameter) {
    for (const auto& [of, words] : parameters)
        if (of == keyword && words.name == parameter) return std::string(words.text);
    return "";
}

std::string instead_of_element(std::string_view type) {
    for (const auto& [name, text] : elements)
        if (type.starts_with(name)) return std::string(text);
    return "";
}

}  // namespace cli::abaqus
