// SPDX-License-Identifier: BSD-3-Clause
#include "text/unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace cli {

namespace {

struct NamedUnit {
    const char* name;
    Unit unit;
};

constexpr double inch = 0.0254, pound_force = 4.4482216152605;

// Units without a prefix, and what is not metric.
constexpr NamedUnit base_units[] = {
    {"m", {1, 0, 1, 0}},
    {"cm", {1e-2, 0, 1, 0}},
    {"in", {inch, 0, 1, 0}},
    {"inch", {inch, 0, 1, 0}},
    {"ft", {12 * inch, 0, 1, 0}},
    {"N", {1, 1, 0, 0}},
    {"lbf", {pound_force, 1, 0, 0}},
    {"lb", {pound_force, 1, 0, 0}},
    {"kip", {1e3 * pound_force, 1, 0, 0}},
    {"Pa", {1, 1, -2, 0}},
    {"psi", {pound_force / (inch * inch), 1, -2, 0}},
    {"ksi", {1e3 * pound_force / (inch * inch), 1, -2, 0}},
    {"Msi", {1e6 * pound_force / (inch * inch), 1, -2, 0}},
    {"J", {1, 1, 1, 0}},
    {"in-lb", {inch * pound_force, 1, 1, 0}},
    {"K", {1, 0, 0, 1}},
    {"C", {1, 0, 0, 1}},
    {"1", {1, 0, 0, 0}},
    {"ppm", {1e-6, 0, 0, 0}},
    {"%", {1e-2, 0, 0, 0}},
};

struct Prefix {
    const char* name;
    double factor;
};
constexpr Prefix prefixes[] = {{"n", 1e-9}, {"µ", 1e-6}, {"u", 1e-6}, {"m", 1e-3},
                               {"", 1.0},   {"k", 1e3},  {"M", 1e6},  {"G", 1e9}};
constexpr std::string_view metric[] = {"m", "N", "Pa", "J"};

bool is_metric(std::string_view name) {
    return std::find(std::begin(metric), std::end(metric), name) != std::end(metric);
}

std::optional<Unit> simple_unit(std::string_view name) {
    for (const NamedUnit& known : base_units)
        if (name == known.name) return known.unit;
    for (const Prefix& prefix : prefixes) {
        const std::string_view begin = prefix.name;
        if (begin.empty() || name.substr(0, begin.size()) != begin) continue;
        const std::string_view rest = name.substr(begin.size());
        for (const NamedUnit& known : base_units)
            if (rest == known.name && is_metric(rest)) {
                Unit out = known.unit;
                out.si *= prefix.factor;
                return out;
            }
    }
    return std::nullopt;
}

// The power at the end of "mm2", "mm^2" or "mm²", which is cut off.
int power_of(std::string_view& name) {
    for (const auto& [text, power] : {std::pair<std::string_view, int>{"²", 2}, {"³", 3}, {"2", 2}, {"3", 3}})
        if (name.size() > text.size() && name.substr(name.size() - text.size()) == text) {
            name.remove_suffix(text.size());
            if (name.size() > 1 && name.back() == '^') name.remove_suffix(1);
            return power;
        }
    return 1;
}

bool multiply(Unit& into, std::string_view name, int sign) {
    const int power = sign * power_of(name);
    const std::optional<Unit> found = simple_unit(name);
    if (!found) return false;
    into.si *= std::pow(found->si, power);
    into.force += power * found->force;
    into.length += power * found->length;
    into.temperature += power * found->temperature;
    return true;
}

// A quantity is named by its `symbol` with prefixes, that many powers of it, over a power of the unit of length that
// the scene names (per_length) or of the metre (per_metre).
struct Naming {
    Quantity quantity;
    const char* key;
    const char* symbol;
    int power;
    int per_length;
    int per_metre;
    int force, length;  // dimensions
};
constexpr Naming namings[] = {
    {Quantity::length, "length", "m", 1, 0, 0, 0, 1},
    {Quantity::area, "area", "m", 2, 0, 0, 0, 2},
    {Quantity::force, "force", "N", 1, 0, 0, 1, 0},
    {Quantity::line_force, "line_force", "N", 1, 1, 0, 1, -1},
    {Quantity::energy, "energy", "J", 1, 0, 0, 1, 1},
    {Quantity::line_energy, "line_energy", "J", 1, 1, 0, 1, 0},
    {Quantity::release_rate, "release_rate", "J", 1, 0, 2, 1, -1},
    {Quantity::stress, "stress", "Pa", 1, 0, 0, 1, -2},
};

const Naming& naming_of(Quantity quantity) { return namings[static_cast<std::size_t>(quantity)]; }

std::string power_text(int power) { return power == 2 ? "²" : power == 3 ? "³" : ""; }

// "lbf/in²": from the names alone.
std::string composed(const Naming& naming, const UnitNames& names) {
    const auto factor = [](const std::string& name, int power) { return name + power_text(std::abs(power)); };
    std::string above = naming.force != 0 ? names.force : "", below;
    // An energy per length keeps both lengths, which say what it is.
    const int over = naming.per_length + (naming.length < 0 ? -naming.length - naming.per_length : 0);
    const int times = naming.length + over;
    if (times > 0) above += (above.empty() ? "" : " ") + factor(names.length, times);
    if (over > 0) below = "/" + factor(names.length, over);
    return above + below;
}

constexpr double least_shown = 0.2, most_shown = 2000;  // of the unit that the scene names
constexpr double most_whole = 1e6;                      // larger numbers have an exponent

}  // namespace

std::optional<Unit> unit_named(std::string_view name) {
    Unit out;
    int sign = 1;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find_first_of("/*", begin), name.size());
        if (!(begin == end && begin == 0 && name.size() > 1) && !multiply(out, name.substr(begin, end - begin), sign))
            return std::nullopt;
        if (end < name.size() && name[end] == '/') sign = -1;
        begin = end + 1;
    }
    return out;
}

const char* quantity_name(Quantity quantity) { return naming_of(quantity).key; }

std::vector<Scale> scales_of(Quantity quantity, const UnitNames& names) {
    const Naming& naming = naming_of(quantity);
    const bool lengths_alone = naming.force == 0;
    if (names.length.empty() || (!lengths_alone && names.force.empty())) {
        // A force needs no length.
        if (quantity == Quantity::force && !names.force.empty()) return scales_of(quantity, {"m", names.force});
        return {{1.0, ""}};
    }
    const std::optional<Unit> length = simple_unit(names.length), force = simple_unit(names.force);
    const bool known = length && length->length == 1 && length->force == 0 &&
                       (lengths_alone || (force && force->force == 1 && force->length == 0)) &&
                       std::abs(std::log10(length->si) - std::round(std::log10(length->si))) < 1e-9 &&
                       (lengths_alone || std::abs(std::log10(force->si) - std::round(std::log10(force->si))) < 1e-9);
    if (!known) return {{1.0, composed(naming, names)}};
    const double own = (lengths_alone ? 1.0 : std::pow(force->si, naming.force)) *
                       std::pow(length->si, naming.length + naming.per_length);  // in powers of the symbol
    const std::string below = naming.per_length > 0  ? "/" + names.length
                              : naming.per_metre > 0 ? "/m" + power_text(naming.per_metre)
                                                     : "";
    std::vector<Scale> out;
    bool has_own = false;
    for (const Prefix& prefix : prefixes) {
        if (prefix.name == std::string_view("u")) continue;
        const bool metres = naming.symbol == std::string_view("m");
        if (metres && prefix.factor > 1) continue;
        const double factor = own / std::pow(prefix.factor, naming.power);
        const bool is_own = std::abs(factor - 1) < 1e-9;
        has_own = has_own || is_own;
        const std::string name = prefix.name + std::string(naming.symbol) + power_text(naming.power) + below;
        // A toughness is written in J/m², or in the units of the scene (N/mm); no other prefix.
        if (naming.per_metre == 0 || prefix.factor == 1.0)
            out.push_back({is_own ? 1.0 : factor, name});
        else if (is_own)
            out.push_back({1.0, composed(naming, names)});
    }
    if (!has_own) return {{1.0, composed(naming, names)}};  // e.g. cm
    return out;
}

const Scale& suiting(const std::vector<Scale>& scales, double largest) {
    const Scale* own = &scales.front();
    for (const Scale& scale : scales)
        if (std::abs(scale.factor - 1) < 1e-9) own = &scale;
    const double size = std::abs(largest);
    if (!std::isfinite(size) || size <= std::numeric_limits<double>::min() ||
        (size >= least_shown && size < most_shown))
        return *own;
    if (size * scales.front().factor < least_shown) return *own;  // rounding
    const Scale* best = &scales.front();
    for (const Scale& scale : scales)
        if (size * scale.factor >= 1 - 1e-9) best = &scale;
    return *best;
}

std::string with_unit(double number, Quantity quantity, const UnitNames& names, double largest) {
    const std::vector<Scale> scales = scales_of(quantity, names);
    const Scale& scale = suiting(scales, std::max(std::abs(number), largest));
    const double shown = number * scale.factor;
    const bool whole = !scale.name.empty() && std::abs(shown) >= 999.5 && std::abs(shown) < most_whole;
    return fmt::format("{}{}{}", whole ? fmt::format("{:.0f}", shown) : fmt::format("{:.3g}", shown),
                       scale.name.empty() ? "" : " ", scale.name);
}

}  // namespace cli
