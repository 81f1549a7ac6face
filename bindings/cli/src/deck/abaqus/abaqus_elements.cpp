// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/abaqus_elements.hpp"

#include <initializer_list>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "deck/abaqus/keywords.hpp"
#include "delam/delam.h"
#include "mesh/cell_shape.hpp"
#include "text/wording.hpp"

namespace cli::abaqus {

namespace {

constexpr std::string_view modes = "formulation \"incompatible\" here, unless the scene says otherwise";
constexpr std::string_view full =
    "integrated fully here, and formulation \"incompatible\", unless the scene says otherwise";
constexpr std::string_view quadratic = "integrated fully here";
constexpr std::string_view plain = "a plain quadratic cell here";

// Abaqus has the centre, then the centres of S1 to S6, behind the other nodes.
constexpr std::uint8_t hexahedron_27[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                          14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20};
constexpr std::uint8_t wedge_6[] = {3, 4, 5, 0, 1, 2};
constexpr std::uint8_t wedge_15[] = {3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14};

// But for these, the node orders are the library's: corners, then the nodes midway, of C3D15 and C3D20 the bottom's,
// the top's, the vertical ones.
constexpr ElementType element_types[] = {
    {"CPE3", DELAM_TRI3, "plane-strain", ""},
    {"CPE4", DELAM_QUAD4, "plane-strain", modes},
    {"CPE4R", DELAM_QUAD4, "plane-strain", full},
    {"CPE4I", DELAM_QUAD4, "plane-strain", ""},
    {"CPE6", DELAM_TRI6, "plane-strain", ""},
    {"CPE6M", DELAM_TRI6, "plane-strain", plain},
    {"CPE8", DELAM_QUAD8, "plane-strain", ""},
    {"CPE8R", DELAM_QUAD8, "plane-strain", quadratic},
    {"CPS3", DELAM_TRI3, "plane-stress", ""},
    {"CPS4", DELAM_QUAD4, "plane-stress", modes},
    {"CPS4R", DELAM_QUAD4, "plane-stress", full},
    {"CPS4I", DELAM_QUAD4, "plane-stress", ""},
    {"CPS6", DELAM_TRI6, "plane-stress", ""},
    {"CPS6M", DELAM_TRI6, "plane-stress", plain},
    {"CPS8", DELAM_QUAD8, "plane-stress", ""},
    {"CPS8R", DELAM_QUAD8, "plane-stress", quadratic},
    {"C3D4", DELAM_TET4, "", ""},
    {"C3D5", DELAM_PYRAMID5, "", ""},
    {"C3D6", DELAM_WEDGE6, "", "", 0, wedge_6},
    {"C3D8", DELAM_HEX8, "", modes},
    {"C3D8R", DELAM_HEX8, "", full},
    {"C3D8I", DELAM_HEX8, "", ""},
    {"C3D10", DELAM_TET10, "", ""},
    {"C3D10M", DELAM_TET10, "", plain},
    {"C3D15", DELAM_WEDGE15, "", "", 0, wedge_15},
    {"C3D20", DELAM_HEX20, "", ""},
    {"C3D20R", DELAM_HEX20, "", quadratic},
    {"C3D27", DELAM_HEX27, "", "", 0, hexahedron_27},
    {"SC8R", DELAM_HEX8, "", "a solid cell here, of formulation \"incompatible\", unless the scene says otherwise"},
    {"COH2D4", -1, "", "", 2},
    {"COH3D6", -1, "", "", 3},
    {"COH3D8", -1, "", "", 4},
};

bool begins(const std::string& type, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (type.starts_with(name)) return true;
    return false;
}

}  // namespace

std::size_t ElementType::nodes() const { return cohesive() ? 2 * face_nodes : shape_of(cell).nodes; }

std::int32_t ElementType::dimension() const {
    if (!cohesive()) return shape_of(cell).dimension;
    return face_nodes == 2 ? 2 : 3;
}

const ElementType& type_named(const InpCard& card) {
    const std::string name = upper(card.required("TYPE"));
    std::vector<std::string> known;
    for (const ElementType& type : element_types) {
        if (type.name == name) return type;
        known.emplace_back(type.name);
    }
    if (const std::string instead = instead_of_element(name); !instead.empty())
        throw SceneFailure(card.place, fmt::format("type {} is not read: {}", name, instead));
    throw SceneFailure(
        card.place, fmt::format("type {} is not read{}; these are: {}", name, suggestion(name, known), listing(known)));
}

BoundaryElements::BoundaryElements(const std::vector<InpCard>& cards) {
    for (const InpCard& card : cards) {
        if (card.keyword.ends_with(" SECTION")) sections_.insert(upper(card.parameter("ELSET")));
        if (card.keyword == "ELEMENT" && upper(card.parameter("TYPE")).starts_with("C3D")) solid_ = true;
    }
}

bool BoundaryElements::contains(const InpCard& card) const {
    const std::string type = upper(card.parameter("TYPE")), set = upper(card.parameter("ELSET"));
    if (card.keyword != "ELEMENT" || set.empty() || sections_.contains(set)) return false;
    return begins(type, {"T2D", "T3D"}) || (solid_ && begins(type, {"CPS", "CPE"}));
}

}  // namespace cli::abaqus
