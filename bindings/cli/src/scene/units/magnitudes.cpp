// SPDX-License-Identifier: BSD-3-Clause
#include "scene/units/magnitudes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cli {

namespace {

// A kind of number is usual from `least` to `most`, in SI units, and most are near `middle`. A factor of 10 more on
// each side accepts a scene in mm whose toughness was typed in J/m2; a factor of 10 less refuses foams and blocks of
// rock.
struct Usual {
    const char* what;
    Quantity quantity;
    double least, middle, most;
};
constexpr Usual usual[] = {
    {"modulus", Quantity::stress, 2e7, 7e10, 1.3e12},       // from rubber to diamond
    {"strength", Quantity::stress, 1e4, 4e7, 2e10},         // of an interface: from tape to a perfect crystal
    {"toughness", Quantity::release_rate, 0.05, 300, 1e5},  // from a film on glass to a ductile adhesive
    {"extent", Quantity::length, 1e-7, 0.1, 100},           // from a fibre to a wing
};

const Usual& usual_of(const Magnitude& of) {
    return *std::find_if(std::begin(usual), std::end(usual), [&](const Usual& one) { return of.what == one.what; });
}

// The consistent sets of units in use, the commonest first.
const UnitNames systems[] = {{"m", "N"},  {"mm", "N"}, {"µm", "µN"},  {"mm", "kN"},
                             {"m", "kN"}, {"cm", "N"}, {"in", "lbf"}, {"m", "MN"}};

// A number of the scene in SI units; nothing if a name is no unit.
std::optional<double> in_si(const Magnitude& of, const UnitNames& names) {
    const std::optional<Unit> length = unit_named(names.length), force = unit_named(names.force);
    if (!length || !force || length->length != 1 || force->force != 1) return std::nullopt;
    switch (of.quantity) {
        case Quantity::stress:
            return of.value * force->si / (length->si * length->si);
        case Quantity::release_rate:
            return of.value * force->si / length->si;
        default:
            return of.value * length->si;
    }
}

bool is_usual(const Magnitude& of, double si) { return si >= usual_of(of).least && si <= usual_of(of).most; }

// Returns how far all numbers are from what most are, as a sum of squared logarithms; infinite where one is not usual
// at all.
double distance(const std::vector<Magnitude>& all, const UnitNames& names) {
    double out = 0;
    for (const Magnitude& one : all) {
        const std::optional<double> si = in_si(one, names);
        if (!si || !is_usual(one, *si)) return std::numeric_limits<double>::infinity();
        out += std::pow(std::log10(*si / usual_of(one).middle), 2);
    }
    return out;
}

const UnitNames* nearest(const std::vector<Magnitude>& all) {
    const UnitNames* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const UnitNames& names : systems)
        if (const double one = distance(all, names); one < least) {
            least = one;
            best = &names;
        }
    return best;
}

// "126 GPa" of a number in SI units.
std::string si_text(const Magnitude& of, double si) { return with_unit(si, of.quantity, {"m", "N"}); }

// Keeps the extremes of a kind.
struct Extremes {
    Magnitude least, most;
    bool any = false;

    void take(const Magnitude& one) {
        if (!(one.value > 0) || !std::isfinite(one.value)) return;
        if (!any || one.value < least.value) least = one;
        if (!any || one.value > most.value) most = one;
        any = true;
    }
    void append(std::vector<Magnitude>& out) const {
        if (any) out.push_back(most);
        if (any && least.value < most.value) out.push_back(least);
    }
};

double extent_of(const Scene& scene) {
    if (!scene.mesh) {
        double out = scene.geometry.height;
        for (const double length : scene.geometry.lengths) out = std::max(out, length);
        return out;
    }
    const auto dimension = static_cast<std::size_t>(scene.mesh->dimension);
    double out = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = axis; i < scene.mesh->nodes.size(); i += dimension) {
            low = std::min(low, scene.mesh->nodes[i]);
            high = std::max(high, scene.mesh->nodes[i]);
        }
        out = std::max(out, high - low);
    }
    return out;
}

// One number of each kind in the units, for people.
std::string told(const std::vector<Magnitude>& all, const UnitNames& names) {
    std::vector<std::string> out;
    for (const Magnitude& one : all)
        if (out.empty() || out.back().rfind(one.what, 0) != 0)
            out.push_back(fmt::format("{} {}", one.what, si_text(one, in_si(one, names).value_or(one.value))));
    return fmt::format("{}", fmt::join(out, ", "));
}

// The two kinds that disagree most clearly: the first number decides on units in which another is not usual.
std::string contradiction(const std::vector<Magnitude>& all) {
    for (std::size_t i = 1; i < all.size(); ++i) {
        const std::vector<Magnitude> before(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i));
        const std::vector<Magnitude> with(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i + 1));
        if (nearest(with) != nullptr) continue;
        const UnitNames* names = nearest(before);
        if (names == nullptr) break;
        const Magnitude& odd = all[i];
        return fmt::format(
            "the numbers do not fit together: {} = {:.6g} suggests {}, {} ({}), and {} = {:.6g} would then "
            "be {}",
            all[0].path, all[0].value, names->length, names->force, told({all[0]}, *names), odd.path, odd.value,
            si_text(odd, *in_si(odd, *names)));
    }
    return fmt::format("the numbers do not fit together: {} = {:.6g} fits no usual units", all[0].path, all[0].value);
}

}  // namespace

std::vector<Magnitude> magnitudes_of(const Scene& scene) {
    Extremes moduli, peaks, toughnesses;
    for (const Material& material : scene.materials) {
        const auto at = [&](const char* key) { return material.place.path + "." + key; };
        if (const auto* isotropic = std::get_if<Isotropic>(&material.elastic)) {
            moduli.take({Quantity::stress, "modulus", at("young"), isotropic->young});
        } else {
            const auto& constants = std::get<std::array<double, 9>>(material.elastic);
            moduli.take({Quantity::stress, "modulus", at("E1"), constants[0]});
            moduli.take({Quantity::stress, "modulus", at("E2"), constants[1]});
        }
    }
    for (const LawData& law : scene.laws)
        for (const char* mode : {"normal", "tangential", "second_tangential"}) {
            const std::string key = law.place.path + "." + mode;
            peaks.take({Quantity::stress, "strength", key + "_strength", law_peak(law, mode)});
            toughnesses.take({Quantity::release_rate, "toughness", key + "_toughness",
                              law_number(law, std::string(mode) + "_toughness")});
        }
    std::vector<Magnitude> out;
    moduli.append(out);
    out.push_back({Quantity::length, "extent", "the extent of the bodies", extent_of(scene)});
    toughnesses.append(out);
    peaks.append(out);
    std::erase_if(out, [](const Magnitude& one) { return !(one.value > 0); });
    return out;
}

UnitsFound units_found(const Scene& scene) {
    const std::vector<Magnitude> all = magnitudes_of(scene);
    const bool named = !scene.units.names.length.empty() && !scene.units.names.force.empty();
    UnitsFound out;
    if (all.empty() || (scene.units.given && !named && !scene.imported))
        return out;  // names that are left empty on purpose
    const UnitNames* near = nearest(all);
    if (!named) {
        if (near == nullptr) {
            out.warning = contradiction(all) + "; numbers without units: [units] with length = \"\", force = \"\"";
        } else {
            out.proposed = *near;
            out.reason = told(all, *near);
        }
        return out;
    }
    for (const Magnitude& one : all) {
        const std::optional<double> si = in_si(one, scene.units.names);
        if (!si) return out;  // names that are labels alone
        if (is_usual(one, *si)) continue;
        out.warning =
            fmt::format("[units] length = \"{}\", force = \"{}\": {} = {:.6g} would be a {} of {}; {} to {} is usual",
                        scene.units.names.length, scene.units.names.force, one.path, one.value, one.what,
                        si_text(one, *si), si_text(one, usual_of(one).least), si_text(one, usual_of(one).most));
        if (near != nullptr)
            out.warning +=
                fmt::format("; the numbers suggest {}, {} ({})", near->length, near->force, told(all, *near));
        return out;
    }
    return out;
}

}  // namespace cli
