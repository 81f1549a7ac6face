// SPDX-License-Identifier: BSD-3-Clause
// `delam new`: the values of a specimen's sheet, in any units, become numbers in mm and N. A script makes the scene of
// them (specimen/README.md), because it asks the program itself for the process zone and the stiffness.
#include <cctype>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "text/error.hpp"
#include "text/unit.hpp"

namespace cli {

namespace {

constexpr Unit none{1, 0, 0, 0}, mm{1e-3, 0, 1, 0}, mpa{1e6, 1, -2, 0}, n_per_mm{1e3, 1, -1, 0};

// The rows of a sheet: what a value may be, and in which unit the script gets it.
const SheetRow rows[] = {
    {"width", &mm, "25mm", "width of the specimen"},
    {"length", &mm, "150mm", "length of the specimen (default: what the crack needs)"},
    {"arm", &mm, "1.5mm", "thickness of an arm, half of the specimen's; of adcb the upper one"},
    {"thickness", &mm, "3mm", "thickness of both arms together, instead of --arm"},
    {"lower-arm", &mm, "2mm", "adcb: thickness of the lower arm"},
    {"notch", &mm, "50mm", "length of the notch, from the load (dcb, adcb, mmb) or the support (enf, 4enf, slb)"},
    {"half-span", &mm, "50mm", "enf, mmb, slb: half of the distance of the supports, L in the standards"},
    {"span", &mm, "100mm", "4enf: distance of the supports; enf, mmb, slb: instead of --half-span"},
    {"inner-span", &mm, "60mm", "4enf: distance of the loading noses"},
    {"lever", &mm, "41.3mm", "mmb: length of the lever, c in the standard"},
    {"growth", &mm, "20mm", "how far the crack shall grow (default: a fifth of the notch)"},
    {"E1", &mpa, "140GPa", "modulus along the fibres, as bending tests give it"},
    {"E2", &mpa, "10GPa", "modulus across"},
    {"G12", &mpa, "5GPa", "shear modulus; G13 is the same"},
    {"G13", &mpa, "5GPa", "the same, instead of --G12"},
    {"nu12", &none, "0.3", "Poisson's ratio along and across"},
    {"nu23", &none, "0.45", "Poisson's ratio across the fibres"},
    {"young", &mpa, "70GPa", "modulus of isotropic arms, instead of E1 to nu23; fibre: of the matrix"},
    {"poisson", &none, "0.3", "Poisson's ratio of isotropic arms; fibre: of the matrix"},
    {"GIc", &n_per_mm, "250J/m2", "toughness in mode I"},
    {"GIIc", &n_per_mm, "750J/m2", "toughness in mode II"},
    {"eta", &none, "2", "exponent of Benzeggagh and Kenane"},
    {"normal-strength", &mpa, "50MPa", "strength of the interface in opening (default: proposed)"},
    {"shear-strength", &mpa, "80MPa", "strength in shear (default: proposed)"},
    {"radius", &mm, "5um", "fibre: radius of the fibre"},
    {"fraction", &none, "0.5", "fibre: fraction of the area"},
    {"fibre-young", &mpa, "74GPa", "fibre: modulus of the fibre"},
    {"fibre-poisson", &none, "0.2", "fibre: Poisson's ratio of the fibre"},
    {"ply", &mm, "0.25mm", "laminate: thickness of a ply"},
    {"cell", &mm, "0.1mm", "laminate: length of the cells along x and y (default: the thickness of a ply)"},
    {"flaw", &mm, "4mm", "laminate: length along x of a flaw, where two plies do not adhere"},
    {"flaw-width", &mm, "4mm", "laminate: width of the flaw (default: the whole width)"},
    {"flaw-at", &mm, "10mm", "laminate: x of the middle of the flaw (default: half of the length)"},
    {"flaw-across", &mm, "5mm", "laminate: y of the middle of the flaw (default: half of the width)"},
    {"flaw-interface", &none, "2", "laminate: interface of the flaw, 1 above the lowest ply (default: the middle)"},
    {"strain", &none, "1%", "fibre, laminate: the strain in the end"},
};

}  // namespace

std::vector<SheetRow> sheet_rows() { return {std::begin(rows), std::end(rows)}; }

double sheet_number(const SheetRow& row, const std::string& text) {
    const std::string place = std::string("--") + row.name + " " + text;
    std::size_t end = 0;
    double value = 0;
    std::string points = text;  // "1,5mm" is 1.5 mm, as in the files of machines
    const std::size_t comma = text.find(',');
    if (comma != std::string::npos && comma > 0 && text.find_first_of(".,", comma + 1) == std::string::npos &&
        text.find('.') > comma && comma + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[comma + 1])))
        points[comma] = '.';
    try {
        value = std::stod(points, &end);
    } catch (const std::exception&) {
        throw Failure(exit_scene, fmt::format("{}: a number with its unit is expected, like {}", place, row.example));
    }
    std::string name = text.substr(end);
    name.erase(0, name.find_first_not_of(' ') == std::string::npos ? name.size() : name.find_first_not_of(' '));
    const Unit& wanted = *row.unit;
    const std::optional<Unit> unit = name.empty() ? std::optional<Unit>(none) : unit_named(name);
    if (!unit || unit->force != wanted.force || unit->length != wanted.length ||
        unit->temperature != wanted.temperature)
        throw Failure(exit_scene,
                      fmt::format("{}: {} is expected, like {}", place,
                                  name.empty() ? "a number with its unit" : "a unit of another kind", row.example));
    value *= unit->si / wanted.si;
    if (!(value > 0) || !std::isfinite(value))
        throw Failure(exit_scene, fmt::format("{}: a finite number > 0 is expected, like {}", place, row.example));
    return value;
}

int new_scene(const SpecimenWishes& of) {
    nlohmann::json sheet = nlohmann::json::object();
    for (const SheetRow& row : sheet_rows())
        if (const auto found = of.values.find(row.name); found != of.values.end() && !found->second.empty())
            sheet[row.name] = sheet_number(row, found->second);
    const nlohmann::json given{{"kind", of.kind},       {"sheet", sheet},       {"texts", of.values},
                               {"layup", of.layup},     {"out", of.out},        {"steps", of.steps},
                               {"replace", of.replace}, {"command", of.command}};
    start_script("specimen/new.py", given.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

}  // namespace cli
