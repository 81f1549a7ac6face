// SPDX-License-Identifier: BSD-3-Clause
#include "law/law_parameters.hpp"

#include <array>
#include <iterator>
#include <type_traits>
#include <utility>
#include <variant>

namespace delam {

namespace {

constexpr unsigned bit(std::size_t index) { return 1u << index; }
constexpr unsigned any = ~0u;

// The kinds whose toughnesses are one of the two.
constexpr unsigned kinds_with(Toughnesses first, Toughnesses second) {
    unsigned found = 0;
    for (std::size_t i = 0; i < law_kinds.size(); ++i)
        if (law_kinds[i].toughnesses == first || law_kinds[i].toughnesses == second) found |= bit(i);
    return found;
}
constexpr unsigned computed = kinds_with(Toughnesses::total, Toughnesses::onset_and_total);
constexpr unsigned softens = kinds_with(Toughnesses::onset_and_total, Toughnesses::onset_and_total);
constexpr unsigned two_exponents = bit(static_cast<std::size_t>(Criterion::valoroso_champaney));
constexpr unsigned one_exponent = any & ~two_exponents;

constexpr LawParameter number(const char* key, const char* unit, const char* initial, const char* meaning,
                              unsigned kinds, unsigned criteria, double Law::*value, double Law::*second = nullptr) {
    return {key, "real", unit, initial, positive, meaning, kinds, criteria, value, second};
}

constexpr LawParameter instead(LawParameter row, double Law::*other) {
    row.instead_of = other;
    return row;
}
constexpr LawParameter like(LawParameter row, double Law::*first) {
    row.like = first;
    return row;
}
constexpr LawParameter of_onset(LawParameter row) {
    row.of_onset = true;
    return row;
}

// Parameters of all shapes. The last row stands behind the rows that the shapes add.
constexpr LawParameter common[] = {
    {"criterion",
     "text",
     "-",
     "valoroso-champaney",
     {"valoroso-champaney, power, benzeggagh-kenane", -no_bound, no_bound, true, true},
     "how toughness and onset depend on the mixity B; setting another one sets the exponents to their defaults",
     computed,
     any},
    {"onset_criterion",
     "text",
     "-",
     "that of criterion",
     {"valoroso-champaney, power, benzeggagh-kenane", -no_bound, no_bound, true, true},
     "how the onset depends on the mixity B, where not as the toughness does; setting another one sets the exponents "
     "of "
     "the onset to their defaults",
     softens,
     any},
    number("normal_stiffness", "F/L3", "", "k_n: traction over opening before any damage", any, any,
           &Law::normal_stiffness),
    number("tangential_stiffness", "F/L3", "", "k_t: traction over slip before any damage", any, any,
           &Law::tangential_stiffness),
    like(number("second_tangential_stiffness", "F/L3", "equal to tangential_stiffness",
                "k_t along the second tangent of a pair in space; tangential_stiffness is then that along the first",
                any, any, &Law::second_tangential_stiffness),
         &Law::tangential_stiffness),
    instead(number("normal_onset", "F/L", "", "G^o_n: driving energy at which damage begins in opening", softens, any,
                   &Law::normal_onset),
            &Law::normal_strength),
    instead(number("tangential_onset", "F/L", "", "G^o_t: driving energy at which damage begins in sliding", softens,
                   any, &Law::tangential_onset),
            &Law::tangential_strength),
    like(instead(number("second_tangential_onset", "F/L", "that of tangential_onset",
                        "G^o along the second tangent of a pair in space; tangential_onset is then that along the "
                        "first",
                        softens, any, &Law::second_tangential_onset),
                 &Law::second_tangential_strength),
         &Law::tangential_onset),
    instead(number("normal_strength", "F/L2", "that of normal_onset",
                   "instead of normal_onset: the largest traction in opening, G^o_n = s^2/(2 k_n)", softens, any,
                   &Law::normal_strength),
            &Law::normal_onset),
    instead(number("tangential_strength", "F/L2", "that of tangential_onset",
                   "instead of tangential_onset: the largest traction in sliding, G^o_t = s^2/(2 k_t)", softens, any,
                   &Law::tangential_strength),
            &Law::tangential_onset),
    like(instead(number("second_tangential_strength", "F/L2", "that of second_tangential_onset",
                        "instead of second_tangential_onset: the largest traction along the second tangent of a pair "
                        "in space, s^2/(2 k) with its stiffness there",
                        softens, any, &Law::second_tangential_strength),
                 &Law::second_tangential_onset),
         &Law::tangential_strength),
    number("normal_toughness", "F/L", "", "G^c_n >= G^o_n: energy to debond completely in opening", computed, any,
           &Law::normal_toughness),
    number("tangential_toughness", "F/L", "", "G^c_t >= G^o_t: energy to debond completely in sliding", computed, any,
           &Law::tangential_toughness),
    like(number("second_tangential_toughness", "F/L", "equal to tangential_toughness",
                "G^c along the second tangent of a pair in space; tangential_toughness is then that along the first",
                computed, any, &Law::second_tangential_toughness),
         &Law::tangential_toughness),
    of_onset(number("onset_exponent_1", "-", "2", "p of the onset: ((1-B) G/G_n)^p + (B G/G_t)^q = 1", softens,
                    two_exponents, &Law::onset_exponent_1)),
    of_onset(number("onset_exponent_2", "-", "2", "q of the onset", softens, two_exponents, &Law::onset_exponent_2)),
    number("toughness_exponent_1", "-", "2", "p of the toughness", computed, two_exponents, &Law::toughness_exponent_1),
    number("toughness_exponent_2", "-", "2", "q of the toughness", computed, two_exponents, &Law::toughness_exponent_2),
    of_onset(number("onset_exponent", "-", "2", "of the onset: p = q of the power law, eta of G_n + (G_t - G_n) B^eta",
                    softens, one_exponent, &Law::onset_exponent_1, &Law::onset_exponent_2)),
    number("toughness_exponent", "-", "2", "likewise of the toughness", computed, one_exponent,
           &Law::toughness_exponent_1, &Law::toughness_exponent_2),
    {"gradient", "real", "F L", "0", not_negative, "kappa of the gradient term kappa/2 |grad zeta|^2", any, any,
     &Law::gradient},
};

// Numbers of a shape by their place in Shape::parameters.
template <class Shape, std::size_t I>
double read(const Softening& softening) {
    return (std::get<Shape>(softening).*Shape::parameters[I].get)();
}
template <class Shape, std::size_t I>
void write(Softening& softening, double value) {
    (std::get<Shape>(softening).*Shape::parameters[I].set)(value);
}

template <class Shape>
constexpr std::size_t own_count() {
    if constexpr (requires { Shape::parameters; })
        return std::size(Shape::parameters);
    else
        return 0;
}

template <class Shape, std::size_t I>
constexpr LawParameter own(std::size_t kind) {
    constexpr ShapeParameter<Shape> p = Shape::parameters[I];
    constexpr bool real = p.type == ShapeParameter<Shape>::Type::real;
    LawParameter row{p.key, real ? "real" : "table", p.unit, p.initial, p.range, p.meaning, bit(kind), any};
    if constexpr (real) {
        row.read = read<Shape, I>;
        row.write = write<Shape, I>;
    }
    return row;
}

// The common rows with those of every shape before the last one.
template <class... Shapes>
constexpr auto joined(std::type_identity<std::variant<Shapes...>>) {
    constexpr std::size_t before = std::size(common) - 1;
    std::array<LawParameter, std::size(common) + (own_count<Shapes>() + ...)> all{};
    std::size_t next = 0, kind = 0;
    for (; next < before; ++next) all[next] = common[next];
    const auto add = [&]<class Shape, std::size_t... I>(std::type_identity<Shape>, std::index_sequence<I...>) {
        ((all[next++] = own<Shape, I>(kind)), ...);
        ++kind;
    };
    (add(std::type_identity<Shapes>{}, std::make_index_sequence<own_count<Shapes>()>{}), ...);
    all[next] = common[before];
    return all;
}

constexpr auto parameters = joined(std::type_identity<Softening>{});

}  // namespace

std::span<const LawParameter> law_parameters() { return parameters; }

bool applies(const LawParameter& p, const Law& law) {
    const Criterion governing = p.of_onset ? law.criterion_of_onset() : law.criterion;
    const unsigned kind = bit(law.softening.index()), criterion = bit(static_cast<std::size_t>(governing));
    return (p.kinds & kind) != 0 && (p.criteria & criterion) != 0;
}

const LawParameter* find_parameter(const Law& law, const std::string& key) {
    for (const LawParameter& p : parameters)
        if (key == p.key && applies(p, law)) return &p;
    return nullptr;
}

std::string known_parameters(const Law& law, const std::string& type) {
    std::string out;
    for (const LawParameter& p : parameters)
        if (applies(p, law) && type == p.type) out += (out.empty() ? "" : ", ") + std::string(p.key);
    return out;
}

bool set_parameter(Law& law, const std::string& key, double value) {
    const LawParameter* p = find_parameter(law, key);
    if (p == nullptr) return false;
    if (p->value != nullptr) {
        law.*p->value = value;
        if (p->second != nullptr) law.*p->second = value;
        if (p->instead_of != nullptr) law.*p->instead_of = 0.0;
    } else if (p->write != nullptr) {
        p->write(law.softening, value);
    }
    return p->type == std::string("real");
}

}  // namespace delam
