// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_laws.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "text/refusals.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

// Stiffness of an interface whose deck gives none, in stiffnesses of a cell: that of Abaqus' penalty contact, as its
// manual says; half and twice of it change the compliance of an interface by a tenth of a cell's (ctest -R
// cli_deck_keywords).
constexpr double penalty_factor = 10;
// max((t_n/s_n)^2, (t_t/s_t)^2) = 1 is the limit of a power law whose exponent grows.
constexpr double maximum_exponent = 100;

// True if the two shears have different numbers; Ktt, T and Gt play no part in the plane.
bool shears_differ(const Numbers& values, std::int32_t dimension) {
    return dimension == 3 && values.size() > 2 && std::abs(values[1] - values[2]) > 1e-9 * std::abs(values[1]);
}

void require_positive(const Numbers& values, std::size_t count, const char* what, const Place& place) {
    for (std::size_t i = 0; i < count; ++i)
        if (!(values[i] > 0)) throw SceneFailure(place, fmt::format("{} {}: must be > 0", what, values[i]));
}

// Returns the peak of a mode that *DAMAGE INITIATION gives as a stress, a nominal strain or a jump.
double peak_of(const std::string& initiation, double value, double stiffness, double thickness) {
    return initiation.back() == 'S' ? value : value * stiffness * (initiation.back() == 'E' ? thickness : 1.0);
}

// A mode by its stiffness and its peak, `strength`.
struct Mode {
    double stiffness;
    double strength;
    [[nodiscard]] double at_onset() const { return strength / stiffness; }
    [[nodiscard]] double onset() const { return strength * at_onset() / 2; }
};
// Opening, the first shear and, in space, the second where a number of the deck differs from that of the first.
using Modes = std::vector<Mode>;

using Curve = std::vector<std::array<double, 2>>;

// Abaqus interpolates D linearly between two points, and the traction, (1 - D) times a straight line, may rise far
// above both.
void require_no_hump(const DamageCards& damage, const Mode& mode) {
    constexpr double allowed = 0.05;  // of the peak
    for (std::size_t i = 1; i < damage.values.size(); ++i) {
        const Numbers &a = damage.values[i - 1], &b = damage.values[i];
        for (const double x : {0.25, 0.5, 0.75}) {
            const double d = a[0] + x * (b[0] - a[0]), jump = a[1] + x * (b[1] - a[1]);
            const double traction = (1 - d) * (1 + jump / mode.at_onset());
            const double before = (1 - a[0]) * (1 + a[1] / mode.at_onset());
            if (traction > before + allowed)
                throw SceneFailure(
                    damage.evolution_place,
                    fmt::format("between the displacements {} and {}, the traction of Abaqus' straight D "
                                "rises to {:.3g} times the strength: give more points there, or "
                                "TYPE=ENERGY",
                                a[1], b[1], traction));
        }
    }
}

// Points of D over the jump beyond the onset, as traction over its peak, with straight lines between them.
Curve softening_of(const DamageCards& damage, const Mode& mode) {
    const std::vector<Numbers>& rows = damage.values;
    const Place& place = damage.evolution_place;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].size() < 2 || (i > 0 && !(rows[i][1] > rows[i - 1][1])))
            throw SceneFailure(place, "rows of D and a growing displacement beyond the onset are expected");
    if (rows.size() < 2 || rows.front()[0] != 0 || rows.front()[1] != 0 || rows.back()[0] != 1)
        throw SceneFailure(place, "rows from D = 0 at displacement 0 to D = 1 are expected");
    Curve out;
    for (const Numbers& row : rows) {
        const double traction = (1 - row[0]) * (1 + row[1] / mode.at_onset());
        if (!out.empty() && traction > out.back()[1] * (1 + 1e-9))
            throw SceneFailure(place,
                               fmt::format("the traction rises beyond the onset, from {:.6g} to {:.6g} of its peak "
                                           "at a displacement of {}: it must not",
                                           out.back()[1], traction, row[1]));
        out.push_back({row[1] / rows.back()[1], std::min(traction, out.empty() ? 1.0 : out.back()[1])});
    }
    require_no_hump(damage, mode);
    return out;
}

double area_of(const Curve& softening) {
    double area = 0;
    for (std::size_t i = 1; i < softening.size(); ++i)
        area += (softening[i][0] - softening[i - 1][0]) * (softening[i][1] + softening[i - 1][1]) / 2;
    return area;
}

// The same where D, not the traction, is straight between the points: each part is the product of two straight lines,
// (1 - D) and 1 + jump/onset, and Simpson's rule is exact.
double area_with_straight_damage(const DamageCards& damage, const Mode& mode) {
    double area = 0;
    const auto traction = [&](double d, double jump) { return (1 - d) * (1 + jump / mode.at_onset()); };
    for (std::size_t i = 1; i < damage.values.size(); ++i) {
        const Numbers &a = damage.values[i - 1], &b = damage.values[i];
        area += (b[1] - a[1]) / 6 *
                (traction(a[0], a[1]) + 4 * traction((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) + traction(b[0], b[1]));
    }
    return area / damage.values.back()[1];
}

// A table over the mode mix ratio, in the quantities of a law.
class MixTable {
public:
    MixTable(const DamageCards& damage, const Modes& modes) : damage_(damage), normal_(modes[0]), shear_(modes[1]) {}

    // Returns the share of shear in the energy. MODE MIX RATIO=TRACTION has 2/pi of the angle between the tractions,
    // which damage leaves as it is because it lowers both alike.
    [[nodiscard]] double share(double ratio) const {
        if (damage_.mix_ratio != "TRACTION" || ratio == 0 || ratio == 1) return ratio;
        const double r = std::tan(ratio * std::numbers::pi / 2), shear = r * r / shear_.stiffness;
        return shear / (1 / normal_.stiffness + shear);
    }
    // Returns the toughness of a row. TYPE=DISPLACEMENT has the length of the jump beyond that at the onset, and the
    // traction falls linearly.
    [[nodiscard]] double toughness(double value, double share) const {
        if (damage_.evolution == "ENERGY") return value;
        const double onset = onset_energy(share);
        const double jump = std::sqrt(2 * onset * ((1 - share) / normal_.stiffness + share / shear_.stiffness));
        return onset * (1 + value / jump);
    }

private:
    [[nodiscard]] double onset_energy(double share) const {
        const double normal = normal_.onset(), shear = shear_.onset();
        const double a = (1 - share) / normal, b = share / shear;
        return 1 / (damage_.initiation.starts_with("MAX") ? std::max(a, b) : a + b);
    }

    const DamageCards& damage_;
    Mode normal_, shear_;
};

// Makes Benzeggagh and Kenane's criterion of a table over the mode mix ratio, between whose rows Abaqus interpolates:
// with two rows of toughnesses over shares of the energy it is the same, with exponent 1.
DamageCards with_criterion(const std::string& name, const DamageCards& table, const Modes& modes,
                           std::vector<std::string>& changed) {
    constexpr double allowed = 0.03;  // of a toughness: measured ones scatter by more
    const Place& place = table.evolution_place;
    const MixTable mix(table, modes);
    std::map<double, double> row;  // value by mode mix ratio
    for (const Numbers& line : table.values) {
        if (line.size() < 2 || !(line[0] > 0 && line[1] >= 0 && line[1] <= 1))
            throw SceneFailure(place, fmt::format("rows of {} > 0 and a mode mix ratio in [0, 1] are expected",
                                                  table.evolution == "ENERGY" ? "a toughness" : "a displacement"));
        const auto [at, inserted] = row.emplace(line[1], line[0]);
        if (!inserted && std::abs(at->second - line[0]) > 1e-9 * line[0])
            throw SceneFailure(place,
                               fmt::format("{} and {} at the mode mix ratio {}: the law of an interface has one value "
                                           "for both directions of sliding; give one row",
                                           at->second, line[0], line[1]));
    }
    if (!row.contains(0) || !row.contains(1))
        throw SceneFailure(place, "rows of the mode mix ratios 0 and 1, the pure modes, are expected");
    const double normal = mix.toughness(row.at(0), 0), shear = mix.toughness(row.at(1), 1);
    double least = HUGE_VAL, most = 0;
    for (const auto& [ratio, value] : row) {
        const double share = mix.share(ratio), part = (mix.toughness(value, share) - normal) / (shear - normal);
        if (share <= 0 || share >= 1 || !(part > 0 && part < 1)) continue;
        least = std::min(least, std::log(part) / std::log(share));
        most = std::max(most, std::log(part) / std::log(share));
    }
    const double exponent = most > 0 ? std::sqrt(least * most) : 1;
    double off = 0;
    for (auto a = row.begin(), b = std::next(a); b != row.end(); ++a, ++b)
        for (const double x : {0.25, 0.5, 0.75, 1.0}) {
            const double share = mix.share(a->first + x * (b->first - a->first));
            const double wanted = mix.toughness(a->second + x * (b->second - a->second), share);
            const double found = normal + (shear - normal) * std::pow(share, exponent);
            off = std::max(off, std::abs(found / wanted - 1));
        }
    const std::string curve = fmt::format("Benzeggagh and Kenane's curve with exponent {:.4g}", exponent);
    if (off > allowed)
        throw SceneFailure(place, fmt::format("{} is off by {:.3g} % from the table of toughnesses (MIXED MODE "
                                              "BEHAVIOR=TABULAR): at most {:.2g} % are imported; give TYPE=ENERGY with "
                                              "BK or POWER LAW",
                                              curve, 100 * off, 100 * allowed));
    if (off > 1e-9)
        changed.push_back(fmt::format(
            "law \"{}\": the table of toughnesses over the mode mix is {} here, from {:.6g} to {:.6g}, which "
            "is off by up to {:.2g} %",
            name, curve, normal, shear, 100 * off));
    DamageCards out = table;
    out.evolution = "ENERGY";
    out.mixed_mode = "BK";
    out.power = exponent;
    out.values = {{normal, shear}};
    return out;
}

// The toughness of all modes, from energies or displacements. Benzeggagh and Kenane's criterion of Abaqus takes that of
// the first shear for both.
Numbers toughness_of(const std::string& name, const DamageCards& damage, const Modes& modes,
                     std::vector<std::string>& changed) {
    const Place& place = damage.evolution_place;
    if (damage.evolution == "ENERGY") {
        Numbers energy = damage.values[0];
        if (energy.empty()) throw SceneFailure(place, "a toughness is expected");
        if (damage.mixed_mode.empty()) return Numbers(modes.size(), energy[0]);
        if (energy.size() < 2) throw SceneFailure(place, "the toughness of two or three modes is expected");
        if (energy.size() < 3 || damage.mixed_mode == "BK") energy.resize(3, energy[1]), energy[2] = energy[1];
        energy.resize(modes.size());
        return energy;
    }
    if (damage.softening == "TABULAR") (void)softening_of(damage, modes[0]);
    if (damage.values[0].empty()) throw SceneFailure(place, "a displacement is expected");
    const double end = damage.softening == "TABULAR" ? damage.values.back()[1] : damage.values[0][0];
    Numbers out;
    for (const Mode& mode : modes)
        out.push_back(damage.softening == "TABULAR"
                          ? mode.strength * (mode.at_onset() / 2 + end * area_of(softening_of(damage, mode)))
                          : mode.strength * (mode.at_onset() + end) / 2);
    if (damage.softening == "TABULAR") {
        const double lines = area_of(softening_of(damage, modes[0]));
        const double other = area_with_straight_damage(damage, modes[0]);
        if (std::abs(other - lines) > 1e-3 * lines)
            changed.push_back(
                fmt::format("law \"{}\": between the points of the table the traction is straight here, D in "
                            "Abaqus, where the area beyond the onset is {:+.2g} % different",
                            name, 100 * (other / lines - 1)));
    }
    const auto same = [&](auto&& of) {
        return std::all_of(modes.begin(), modes.end(),
                           [&](const Mode& mode) { return std::abs(of(modes[0]) - of(mode)) <= 1e-9 * of(modes[0]); });
    };
    const bool same_onset = same([](const Mode& mode) { return mode.at_onset(); });
    if (damage.softening == "TABULAR" && !same_onset)
        throw SceneFailure(place,
                           "SOFTENING=TABULAR is imported for modes whose jumps at the onset are the same: the "
                           "curve of a law is that of all modes");
    if (!same_onset || !same([](const Mode& mode) { return mode.strength; }))
        changed.push_back(
            fmt::format("law \"{}\": the deck gives displacements, the scene energies: alike in the pure "
                        "modes, and between them by a power law with exponent 1",
                        name));
    return out;
}

std::string kind_of(const std::string& name, const DamageCards& damage, std::vector<std::string>& changed) {
    const Place& place = damage.evolution_place;
    if (damage.softening == "LINEAR") return "piecewise-linear";
    if (damage.softening == "TABULAR") {
        if (damage.evolution == "ENERGY") throw SceneFailure(place, "SOFTENING=TABULAR needs TYPE=DISPLACEMENT");
        return "tabulated";
    }
    if (damage.evolution == "DISPLACEMENT")
        throw SceneFailure(place,
                           "SOFTENING=EXPONENTIAL with TYPE=DISPLACEMENT is not imported: give points of D "
                           "(SOFTENING=TABULAR)");
    changed.push_back(
        fmt::format("law \"{}\": exponential softening of the same strength and toughness; here the traction falls "
                    "from the onset on, "
                    "by exp(-(jump - onset)/length), where Abaqus' damage decays with the square of the jump",
                    name));
    return "exponential";
}

// True if the law of a deck has numbers of its own for the second shear.
bool second_shear_differs(const Numbers& stiffness, const DamageCards& cards, std::int32_t dimension) {
    return shears_differ(stiffness, dimension) || shears_differ(cards.strengths, dimension) ||
           (cards.evolution == "ENERGY" && cards.mixed_mode == "POWER LAW" && !cards.values.empty() &&
            shears_differ(cards.values[0], dimension));
}

// The modes of the deck; a number that it leaves out for the second shear is that of the first.
Modes modes_of(const Numbers& stiffness, double thickness, const DamageCards& cards, bool axes, const Place& place) {
    const std::size_t count = axes ? 3 : 2;
    Numbers springs = stiffness, peaks = cards.strengths;
    if (axes && springs.size() == 2) springs.push_back(springs[1]);
    if (axes && peaks.size() == 2) peaks.push_back(peaks[1]);
    RefusalList refused;
    refused.attempt([&] { require_positive(springs, count, "stiffness", place); });
    refused.attempt([&] { require_positive(peaks, count, cards.initiation.c_str(), cards.initiation_place); });
    refused.require_none();
    Modes modes;
    for (std::size_t m = 0; m < count; ++m)
        modes.push_back({springs[m], peak_of(cards.initiation, peaks[m], springs[m], thickness)});
    return modes;
}

// Holds what the cards of a law mean.
struct Judged {
    Modes modes;
    Numbers toughness;
    DamageCards damage;
    std::string kind;

    static bool differ(double first, double second) { return std::abs(first - second) > 1e-9 * first; }
    [[nodiscard]] bool three() const { return modes.size() > 2; }
    [[nodiscard]] bool stiffnesses_differ() const { return three() && differ(modes[1].stiffness, modes[2].stiffness); }
    [[nodiscard]] bool onsets_differ() const { return three() && differ(modes[1].onset(), modes[2].onset()); }
    [[nodiscard]] bool toughnesses_differ() const { return three() && differ(toughness[1], toughness[2]); }
};

// Judges the cards of a law one by one, and refuses together what cannot be imported. Energies are judged also where
// stiffnesses or strengths are wrong.
Judged judge(const std::string& name, const Numbers& stiffness, double thickness, const DamageCards& cards, bool axes,
             const Place& place, std::vector<std::string>& changed) {
    Judged out;
    out.modes.resize(axes ? 3 : 2);
    out.damage = cards;
    RefusalList refused;
    bool known = refused.attempt([&] { out.modes = modes_of(stiffness, thickness, cards, axes, place); });
    const bool table = cards.mixed_mode == "TABULAR";
    if (axes && table)
        known = refused.attempt([&] {
            throw SceneFailure(cards.evolution_place,
                               "other numbers in the second direction of sliding are imported without a table of "
                               "modes: give TYPE=ENERGY with BK or POWER LAW");
        });
    if (known && table) known = refused.attempt([&] { out.damage = with_criterion(name, cards, out.modes, changed); });
    if (known || (!table && cards.evolution == "ENERGY"))
        refused.attempt([&] {
            out.toughness = toughness_of(name, out.damage, out.modes, changed);
            require_positive(out.toughness, out.modes.size(), "toughness", out.damage.evolution_place);
        });
    refused.attempt([&] { out.kind = kind_of(name, out.damage, changed); });
    refused.require_none();
    return out;
}

// Keys of the numbers of all modes. Where damage begins at one energy in both shears, the law has one onset.
std::string numbers_text(const Judged& law) {
    constexpr const char* names[] = {"normal", "tangential", "second_tangential"};
    std::string out;
    const Modes& modes = law.modes;
    const bool stiffnesses = law.stiffnesses_differ(), onsets = law.onsets_differ();
    const auto add = [&](std::size_t mode, const char* what, double value) {
        out += fmt::format("{}_{} = {}\n", names[mode], what, toml_number(value));
    };
    for (std::size_t m = 0; m < (stiffnesses ? 3 : 2); ++m) add(m, "stiffness", modes[m].stiffness);
    for (std::size_t m = 0; m < (onsets ? 3 : 2); ++m)
        if (m == 1 && stiffnesses && !onsets)
            add(m, "onset", modes[m].onset());
        else
            add(m, "strength", modes[m].strength);
    for (std::size_t m = 0; m < (law.toughnesses_differ() ? 3 : 2); ++m) add(m, "toughness", law.toughness[m]);
    return out;
}

// Returns the law as [[laws]] of a scene, and adds what differs from that of the deck to `changed`.
std::string law_text(const std::string& name, const Numbers& stiffness, double thickness, const DamageCards& cards,
                     std::int32_t dimension, const Place& place, std::vector<std::string>& changed) {
    if (cards.initiation.empty() || cards.evolution.empty())
        throw SceneFailure(place,
                           fmt::format("\"{}\" has no {}: an interface that stays whole is no law; bodies that "
                                       "share nodes are bonded",
                                       name, cards.initiation.empty() ? "*DAMAGE INITIATION" : "*DAMAGE EVOLUTION"));
    const bool axes = second_shear_differs(stiffness, cards, dimension);
    const Judged law = judge(name, stiffness, thickness, cards, axes, place, changed);
    const DamageCards& damage = law.damage;

    std::string out = fmt::format("{}[[laws]]\nname = {}\n", origin_line(place), toml_text(name));
    if (law.kind != "piecewise-linear") out += fmt::format("kind = \"{}\"\n", law.kind);
    out += numbers_text(law);
    const bool maximum = damage.initiation.rfind("MAX", 0) == 0;
    if (maximum)
        changed.push_back(
            fmt::format("law \"{}\": {} as a power law with exponent {}: at equal shares of both modes the "
                        "strength is 0.35 % less",
                        name, damage.initiation, maximum_exponent));
    const bool bk = damage.mixed_mode == "BK";
    const bool onset = maximum && law.onsets_differ();
    const bool toughness = damage.mixed_mode == "POWER LAW" && damage.power != 1.0 && law.toughnesses_differ();
    if (onset || toughness)
        changed.push_back(fmt::format(
            "law \"{}\": between the two directions of sliding, {} with exponent 1 ((1-S)/G_1 + S/G_2 = 1/G, S being "
            "the share of the second in the energy of sliding); along each of them as in the deck",
            name, onset && toughness ? "onset and toughness" : (onset ? "onset" : "toughness")));
    out += fmt::format("onset_criterion = \"power\"       # {}\nonset_exponent = {}\n", damage.initiation,
                       toml_number(maximum ? maximum_exponent : 1.0));
    out += fmt::format("criterion = \"{}\"\ntoughness_exponent = {}\n", bk ? "benzeggagh-kenane" : "power",
                       toml_number(damage.mixed_mode.empty() ? 1.0 : damage.power));
    if (law.kind == "tabulated") {
        out += "softening = [\n";
        for (const auto& point : softening_of(damage, law.modes[0]))
            out += fmt::format("    [{}, {}],\n", toml_number(point[0]), toml_number(point[1]));
        out += "]\n";
    }
    return out;
}

}  // namespace

std::string DeckLaws::of_material(const MaterialCards& material, double thickness) {
    if (material.elastic != "TRACTION")
        throw SceneFailure(material.place,
                           "material \"" + material.name + "\" of cohesive elements needs *ELASTIC, TYPE=TRACTION");
    Numbers stiffness = material.constants;
    for (double& k : stiffness) k /= thickness;
    return law("material", material.name, stiffness, thickness, material.damage, material.elastic_place);
}

std::string DeckLaws::of_interaction(const InteractionCards& interaction) {
    Numbers stiffness = interaction.stiffness;
    if (stiffness.empty()) {
        stiffness.assign(3, penalty_factor * softest() / edge_);
        say_once(deck_.changed, fmt::format("interaction \"{}\": no stiffness; here that of Abaqus' contact, about {} "
                                            "times that of a cell: {:.6g}",
                                            interaction.name, penalty_factor, stiffness[0]));
    }
    return law("interaction", interaction.name, stiffness, 1.0, interaction.damage, interaction.stiffness_place);
}

std::string DeckLaws::law(const std::string& of, const std::string& name, const Numbers& stiffness, double thickness,
                          const DamageCards& damage, const Place& place) {
    const auto [known, inserted] = names_.emplace(std::pair(of + " " + name, thickness), name);
    if (!inserted) return known->second;
    const std::size_t alike = ++alike_[name];
    if (alike > 1) known->second = fmt::format("{} ({})", name, alike);
    text_ += law_text(known->second, stiffness, thickness, damage, dimension_, place, deck_.changed) + "\n";
    if (second_shear_differs(stiffness, damage, dimension_)) with_axes_.insert(known->second);
    return known->second;
}

// The least Young's modulus of the materials of bodies.
double DeckLaws::softest() const {
    double out = std::numeric_limits<double>::infinity();
    for (const Section& section : deck_.sections) {
        if (!section.thickness.empty()) continue;
        const MaterialCards& m = named(deck_.materials, section.material, "material", section.place);
        const std::size_t moduli = m.elastic == "ISOTROPIC" ? 1 : m.elastic == "LAMINA" ? 2 : 3;
        // D1111, D2222 and D3333 stand at 0, 2 and 5.
        const bool stiffnesses = m.elastic == "ORTHOTROPIC";
        for (std::size_t i = 0; i < moduli; ++i)
            out = std::min(out, m.constants.at(stiffnesses ? (i + 1) * (i + 2) / 2 - 1 : i));
    }
    return std::isfinite(out) ? out : 1.0;
}

}  // namespace cli::abaqus
