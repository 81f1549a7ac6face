// SPDX-License-Identifier: BSD-3-Clause
// The law of an interface at one point: stiffness, a criterion for the toughness at a mixity, a shape of softening.
//
// With Y = Y_n + Y_t, Y_c = k_c [u]_c^2 / 2, and onset and total toughness Go, Gc at the mixity (mixity.hpp), every law
// has energetic form: adhesion zeta minimises zeta Y + g(B, zeta) over 0 <= zeta <= zeta_old, where g is convex and
// decreasing, g(1) = 0, g(0) = Gc.
//   stored       zeta Y                dissipated   g(zeta)
//   or           zeta Y + f(zeta)      dissipated   Gc (zeta_old - zeta),    f(zeta) = g(zeta) - Gc (1-zeta) <= 0
// The second split is that of Zeman, Kruzik, Gruber, PANM 15 (2010), "Application to delamination problem". Both splits
// have the same minimiser. The area under the traction-jump curve of a first loading is Gc at any fixed mixity, its
// peak sqrt(2 k Go).
//
// A value: copies are independent.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "law/criterion.hpp"
#include "law/mixity.hpp"
#include "law/softening/softening.hpp"
#include "law/softening/toughness.hpp"

namespace delam {

struct Law {
    double normal_stiffness = 0.0;             // k_n, F/L3
    double tangential_stiffness = 0.0;         // k_t, in space of the first tangent of a pair
    double second_tangential_stiffness = 0.0;  // of the second one; 0: k_t
    double normal_onset = 0.0;                 // G^o_n, F/L; none of Griffith's law, nor of one that the host gives
    double tangential_onset = 0.0;
    double normal_strength = 0.0;  // s_n, F/L2: instead of the onset, G^o_n = s_n^2/(2 k_n); 0: the onset is given
    double tangential_strength = 0.0;
    double second_tangential_onset = 0.0;  // along the second tangent of a pair in space; 0: that of the first
    double second_tangential_strength = 0.0;
    double normal_toughness = 0.0;  // G^c_n
    double tangential_toughness = 0.0;
    double second_tangential_toughness = 0.0;  // 0: that of the first tangent
    double onset_exponent_1 = 2.0;  // p, q or eta of the onset; the criteria with one exponent read the first
    double onset_exponent_2 = 2.0;
    double toughness_exponent_1 = 2.0;  // likewise of the total toughness
    double toughness_exponent_2 = 2.0;
    double gradient = 0.0;  // kappa >= 0 of the gradient term kappa/2 |grad zeta|^2, F L; 0: none
    Criterion criterion = Criterion::valoroso_champaney;
    std::optional<Criterion> onset_criterion;  // of the onset where it is not that of the toughness
    Softening softening;

    // The criterion of the toughness, and of the onset as long as the onset has none of its own. Another criterion
    // starts with its own exponents, 2.
    void set_criterion(Criterion chosen);
    void set_onset_criterion(Criterion chosen);
    Criterion criterion_of_onset() const { return onset_criterion.value_or(criterion); }
    // False: Go and Gc are the same at every mixity.
    bool depends_on_mixity() const;
    const LawKind& kind() const { return law_kinds[softening.index()]; }
    // False: onset and end are one (Griffith's law), so that there is no process zone.
    bool softens() const { return kind().toughnesses != Toughnesses::total; }
    // Hands the numbers and texts that the shape alone holds to add(...), for the hash of a scene.
    void hash_shape(auto&& add) const {
        std::visit(
            [&](const auto& shape) {
                using Shape = std::remove_cvref_t<decltype(shape)>;
                if constexpr (requires { shape.hashed(add); })
                    shape.hashed(add);
                else
                    static_assert(
                        !requires { Shape::parameters; }, "a shape with parameters hashes them");
            },
            softening);
    }
    const HostSoftening* host() const { return std::get_if<HostSoftening>(&softening); }
    // k of a component of a local jump, the normal one first.
    double stiffness(std::size_t component) const {
        if (component == 0) return normal_stiffness;
        return component == 2 && two_shears() ? second_tangential_stiffness : tangential_stiffness;
    }
    // True if the stiffness depends on the direction of sliding, so that the tangents of a pair are axes of its law.
    bool two_shears() const {
        return second_tangential_stiffness > 0.0 && second_tangential_stiffness != tangential_stiffness;
    }
    // True if onset or toughness depends on the direction of sliding.
    bool two_shear_toughnesses() const;
    // Go and Gc as the criterion needs them; not for laws given by the host.
    Modes onset_modes() const;
    Modes total_modes() const;

    Toughness toughness(const Mixity& mixity) const;
    ToughnessSlope toughness_slope(double mixity) const;  // at S = 0; where infinite, cut off: toughness_slope_at
    double least_onset() const;                           // min Go of the pure modes
    double onset_bound() const;                           // at most Go at any mixity; 0: of a law of the host
    double least_total() const;                           // least_toughness of Gc; 0: the host gives the law

    // Energies per unit area, F/L, of one point; `t` at the mixity that holds, 0 <= zeta <= 1.
    double dissipated(const Toughness& t, double zeta) const;     // g >= 0
    double stored_linear(const Toughness& t, double zeta) const;  // f <= 0
    // Y(zeta) = -dg/dzeta, what it takes to damage further from zeta; nonincreasing in zeta. Its slope is
    // -g'' <= 0; at a corner of the traction-jump curve that of the more damaged side. Both are infinite where no
    // driving energy suffices (exponential, zeta = 0).
    double driving(const Toughness& t, double zeta) const;
    double driving_slope(const Toughness& t, double zeta) const;
    // argmin of zeta Y + g over 0 <= zeta <= zeta_old, the smallest where there are several, and its derivative by
    // driving = Y where it is strictly inside, else 0; <= 0.
    double minimiser(const Toughness& t, double driving, double zeta_old) const;
    double slope(const Toughness& t, double driving, double zeta_old) const;
    // dg/dB at the same zeta, and at S = 0.
    double dissipated_slope_mixity(double mixity, double zeta) const;
};

// True if the tangents of a pair are axes of its law: stiffness, onset or toughness differ along them.
inline bool has_axes(const Law& law) { return law.two_shears() || law.two_shear_toughnesses(); }

}  // namespace delam
