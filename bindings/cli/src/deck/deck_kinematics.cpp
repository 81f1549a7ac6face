// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_kinematics.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace cli::abaqus {

namespace {

// Returns what of a deck large rotations do not know (src/scene/check/kinematics.cpp); empty: nothing.
std::string unknown_part(const References& references) {
    return references.stay_linear()
               ? "angles of nodes that belong to no body, as *COUPLING and *RIGID BODY use them, and periodic "
                 "equations do not turn with large rotations: prescribe displacements of nodes instead"
               : "";
}

constexpr const char* small_rotations = "kinematics = \"linear\"\n";

}  // namespace

std::string kinematics_key(Deck& deck, const References& references) {
    const auto large = [](const Step& step) { return step.large.value_or(false); };
    const auto first = std::find_if(deck.steps.begin(), deck.steps.end(), large);
    if (first == deck.steps.end()) {
        const bool said =
            std::any_of(deck.steps.begin(), deck.steps.end(), [](const Step& step) { return step.large.has_value(); });
        deck.changed.push_back(fmt::format("{}: kinematics = \"linear\", rotations are small whatever they come to",
                                           said ? "NLGEOM=NO" : "no NLGEOM, which means NLGEOM=NO"));
        return small_rotations;
    }
    if (const std::string unknown = unknown_part(references); !unknown.empty()) {
        deck.changed.push_back(
            fmt::format("NLGEOM=YES: small displacements and rotations here, kinematics = \"linear\", because {}; the "
                        "program warns where cells rotate by more than 0.1 rad",
                        unknown));
        return small_rotations;
    }
    deck.changed.push_back(fmt::format(
        "NLGEOM=YES: kinematics = \"corotational\"{}: large rotations, small strains; it takes some times as long as "
        "\"linear\" (--set solver.kinematics=linear), which does where cells rotate by less than 0.1 rad",
        first == deck.steps.begin() ? "" : " from the first step on"));
    return "kinematics = \"corotational\"\n";
}

}  // namespace cli::abaqus
