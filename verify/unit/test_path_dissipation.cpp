// SPDX-License-Identifier: BSD-3-Clause
// Compares the energy that a pair dissipates between two states of a path with closed forms, and tests how far a share
// of its toughness takes it, for every law.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "check.hpp"
#include "evolution/increment/path_dissipation.hpp"
#include "law/adhesion_after.hpp"
#include "law/law_parameters.hpp"
#include "law/mixity.hpp"
#include "laws.hpp"

using namespace delam;

namespace {

void near(double found, double exact, double tolerance, const std::string& what) {
    ck_assert_msg(std::abs(found - exact) <= tolerance, "%s: %.17g instead of %.17g, off by %.3e (allowed %.1e)",
                  what.c_str(), found, exact, found - exact, tolerance);
}

// Bilinear, Go and Gc scaled by the same s(B) = 1 + 2.65 B: Gt/Gn = 3.65.
constexpr double onset = 100.0, total = 250.0, growth = 2.65;
Law turning_law() {
    Law law;
    law.set_criterion(Criterion::benzeggagh_kenane);
    softening_of("piecewise-linear", law.softening);
    law.normal_stiffness = 125e9;
    law.tangential_stiffness = 60e9;
    law.normal_onset = onset;
    law.tangential_onset = (1.0 + growth) * onset;
    law.normal_toughness = total;
    law.tangential_toughness = (1.0 + growth) * total;
    set_parameter(law, "onset_exponent", 1.0);
    set_parameter(law, "toughness_exponent", 1.0);
    return law;
}

PairLaws one_pair(const Law& law, int dimension) {
    PairLaws pairs;
    pairs.dimension = dimension;
    pairs.law = {&law};
    pairs.weight = {1.0};
    return pairs;
}

// The jump of driving energy Y at the mixity B; its slip in a direction of the plane.
std::vector<double> jump_of(const Law& law, int dimension, double y, double b) {
    const double slip = std::sqrt(2.0 * b * y / law.tangential_stiffness);
    std::vector<double> jump{std::sqrt(2.0 * (1.0 - b) * y / law.normal_stiffness)};
    if (dimension == 2) return jump.push_back(-slip), jump;
    jump.push_back(0.6 * slip);
    jump.push_back(-0.8 * slip);
    return jump;
}

// A pair that softens while its mode turns: Y = s(B) Go w^2, and adhesion zeta = (Gc/w - Go)/(Gc - Go), with w
// from 1.05 to 2 over the path. It dissipates int Y (-dzeta) = Go Gc/(Gc - Go) int s(B) dw.
struct Turn {
    double from, to, power;  // B = from + (to - from) t^power
    double mixity(double t) const { return from + (to - from) * std::pow(t, power); }
    static double w(double t) { return 1.05 + 0.95 * t; }
    static double adhesion(double t) { return (total / w(t) - onset) / (total - onset); }
    double exact() const {
        return onset * total / (total - onset) * 0.95 * (1.0 + growth * (from + (to - from) / (1.0 + power)));
    }
    double exact_linear() const {  // int s Gc (-dzeta), by Simpson's rule
        constexpr int n = 4000;
        double sum = 0.0;
        for (int i = 0; i <= n; ++i) {
            const double t = static_cast<double>(i) / n;
            sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * (1.0 + growth * mixity(t)) / (w(t) * w(t));
        }
        return total * total / (total - onset) * 0.95 * sum / (3.0 * n);
    }
};

// The path in steps; straight: each of them without knowing the one before.
PathEnergy walk(const Turn& turn, int dimension, int steps, bool straight) {
    const Law law = turning_law();
    const PairLaws pairs = one_pair(law, dimension);
    const auto at = [&](int i) {
        const double t = static_cast<double>(i) / steps, s = 1.0 + growth * turn.mixity(t);
        return jump_of(law, dimension, s * onset * Turn::w(t) * Turn::w(t), turn.mixity(t));
    };
    PathEnergy sum;
    for (int i = 1; i <= steps; ++i) {
        const std::vector<double> last = straight || i == 1 ? std::vector<double>{} : at(i - 2), from = at(i - 1),
                                  to = at(i);
        const PathEnergy e = path_energy(pairs, 0,
                                         {last, from, to, Turn::adhesion(static_cast<double>(i - 1) / steps),
                                          Turn::adhesion(static_cast<double>(i) / steps)},
                                         0.0);
        sum.dissipated += e.dissipated;
        sum.linear += e.linear;
        sum.error += e.error;
    }
    return sum;
}

}  // namespace

// At one mixity it is the function g of the state, to rounding, however long the path is.
LOOP_TEST(constant_mixity, 2, 4) {
    const int d = loop;
    const Law law = turning_law();
    const PairLaws pairs = one_pair(law, d);
    for (const double b : {0.0, 0.3, 1.0}) {
        const Toughness t = law.toughness(b);
        for (const double y : {0.5, 1.1, 3.0}) {
            const double zeta = law.minimiser(t, y * t.onset, 1.0), next = law.minimiser(t, 2.0 * y * t.onset, zeta);
            const auto last = jump_of(law, d, 0.7 * y * t.onset, b), from = jump_of(law, d, y * t.onset, b),
                       to = jump_of(law, d, 2.0 * y * t.onset, b);
            for (const bool known : {false, true}) {
                const PathEnergy e =
                    path_energy(pairs, 0, {known ? last : std::vector<double>{}, from, to, zeta, next}, 0.5);
                const std::string where = "B = " + std::to_string(b) + ", Y/Go = " + std::to_string(y);
                near(e.dissipated, law.dissipated(t, next) - law.dissipated(t, zeta), 1e-12 * t.total, where);
                near(e.linear, t.total * (zeta - next), 1e-12 * t.total, where + ", linear");
                near(e.error, 0.0, 1e-12 * t.total, where + ", error");
            }
        }
    }
}

// Pairs whose toughness is fixed need no path.
TEST(no_mixity) {
    Law law = turning_law();
    PairLaws pairs = one_pair(law, 2);
    pairs.fixed = {Toughness{100.0, 250.0}};
    const std::vector<double> from{1e-6, 0.0}, to{0.0, 9e-5};
    const PathEnergy e = path_energy(pairs, 0, {{}, from, to, 0.8, 0.1}, 1.0);
    near(e.dissipated, law.dissipated(*pairs.fixed[0], 0.1) - law.dissipated(*pairs.fixed[0], 0.8), 1e-12, "g");
    ck_assert(e.linear == 250.0 * (0.8 - 0.1) && e.error == 0.0);
}

// The integral of the threshold along a path from mode I to mode II and back.
LOOP_TEST(turning, 2, 4) {
    const int d = loop;
    for (const Turn turn : {Turn{0.1, 0.9, 1.0}, Turn{0.9, 0.1, 1.0}, Turn{0.05, 0.6, 2.0}}) {
        double before = 0.0;
        for (const int steps : {5, 10, 20}) {
            const PathEnergy e = walk(turn, d, steps, false), straight = walk(turn, d, steps, true);
            const double error = std::abs(e.dissipated - turn.exact());
            std::printf("turning %dD, B %g to %g, %d steps: error %.3e, straight %.3e, estimate %.3e\n", d, turn.from,
                        turn.to, steps, error / turn.exact(),
                        std::abs(straight.dissipated - turn.exact()) / turn.exact(), e.error / turn.exact());
            // Third order, down to the error of the sixteen parts of each step.
            if (steps > 5)
                ck_assert_msg(error <= std::max(before / 6.0, 1e-5 * turn.exact()), "order: %.3e after %.3e", error,
                              before);
            ck_assert_msg(error <= e.error, "error %.3e beyond its estimate %.3e", error, e.error);
            ck_assert_msg(error <= 0.5 * std::abs(straight.dissipated - turn.exact()), "the parabola is no better");
            near(e.linear, turn.exact_linear(), 60.0 * error + 1e-4 * turn.exact_linear(), "PANM 15 (2010)");
            before = error;
        }
    }
}

// The tougher mode first: more is dissipated, though both paths run through the same adhesions between the same modes.
TEST(reverse) {
    const Turn slides_first{0.9, 0.1, 2.0}, opens_first{0.1, 0.9, 2.0};
    const double much = walk(slides_first, 2, 40, false).dissipated, less = walk(opens_first, 2, 40, false).dissipated;
    near(much, slides_first.exact(), 1e-4 * much, "slides first");
    near(less, opens_first.exact(), 1e-4 * less, "opens first");
    ck_assert(much > 1.2 * less);
}

// The direction of the slip is no mode.
TEST(plane_and_space) {
    const Turn turn{0.2, 0.8, 1.0};
    near(walk(turn, 3, 7, false).dissipated, walk(turn, 2, 7, false).dissipated, 1e-11 * turn.exact(), "space");
}

// ---- adhesion after a share ----------------------------------------------------------------------------------------

// The adhesion is one that the law passes through, and the first that has dissipated the share: exactly, unless the
// law falls there at once.
LOOP_TEST(a_share_of_the_toughness, 0, 3) {
    for (const double ratio : {1.02, 2.5, 40.0, 1e5})
        for (const auto& [name, law] : laws::shapes(laws::criteria[loop], ratio))
            for (const double b : {0.0, 0.4})
                for (const double zeta_old : {1.0, 0.6, 0.01, 1e-5})
                    for (const double share : {0.03, 0.1, 0.5, 1.0}) {
                        const Toughness t = law.toughness(b);
                        const double z = adhesion_after(law, t, zeta_old, share);
                        const std::string where = name + ", zeta " + std::to_string(zeta_old) + ", share " +
                                                  std::to_string(share) + ": " + std::to_string(z);
                        const double wanted = law.dissipated(t, zeta_old) + share * t.total;
                        ck_assert_msg(z >= 0.0 && z <= zeta_old, "%s", where.c_str());
                        if (wanted > (1.0 - 0.01 * share) * t.total) {
                            ck_assert_msg(z == 0.0, "%s: a sliver", where.c_str());
                            continue;
                        }
                        const double done = law.dissipated(t, z);
                        ck_assert_msg(done >= wanted - 1e-9 * t.total, "%s: too little", where.c_str());
                        if (done <= wanted + 1e-9 * t.total) continue;
                        // It falls: no driving energy leads to anything between.
                        for (double y = 1.0; y < 1e12; y *= 1.001) {
                            const double between = law.dissipated(t, law.minimiser(t, y * t.onset, zeta_old));
                            ck_assert_msg(between < wanted || between >= done - 1e-9 * t.total,
                                          "%s: passes through %.9g, wanted %.9g, got %.9g", where.c_str(), between,
                                          wanted, done);
                        }
                    }
}

// Laws that soften continuously give the share itself.
LOOP_TEST(exactly_the_share, 0, 3) {
    for (const char* shape : {"piecewise-linear", "exponential", "trapezoidal"})
        for (const double ratio : {2.5, 40.0, 1e5}) {
            Law law = laws::law(shape, laws::criteria[loop], ratio);
            if (std::string(shape) == "trapezoidal") set_parameter(law, "plateau", 0.5);
            const Toughness t = law.toughness(0.4);
            for (const double zeta_old : {1.0, 0.5})
                for (const double share : {0.01, 0.1}) {
                    const double left = t.total - law.dissipated(t, zeta_old);
                    if (left < 1.5 * share * t.total) continue;
                    const double z = adhesion_after(law, t, zeta_old, share);
                    near(law.dissipated(t, z) - law.dissipated(t, zeta_old), share * t.total, 1e-9 * t.total,
                         std::string(shape) + ", Gc/Go = " + std::to_string(ratio));
                }
        }
}

TEST(limits) {
    const Law law = laws::law("piecewise-linear", Criterion::valoroso_champaney, 2.5);
    const Toughness t = law.toughness(0.2);
    ck_assert(adhesion_after(law, t, 0.0, 0.1) == 0.0);
    ck_assert(adhesion_after(law, t, 1.0, 1.0) == 0.0);
    ck_assert(adhesion_after(law, t, 1.0, 1.0 - 1e-12) == 0.0);
    ck_assert(adhesion_after(law, t, 1.0, 0.5) > 0.0);
    const double small = adhesion_after(law, t, 1.0, 1e-7);
    ck_assert(small < 1.0 && small > 1.0 - 1e-6);
    ck_assert(adhesion_after(laws::law("griffith", Criterion::power, 2.5), {250.0, 250.0}, 1.0, 0.1) == 0.0);
}

// No digit depends on the units.
TEST(units_of_a_share) {
    for (const auto& [name, law] : laws::shapes(laws::criteria[0], 2.5)) {
        const Toughness t = law.toughness(0.3);
        for (const double scale : {std::ldexp(1.0, 40), std::ldexp(1.0, -60)}) {
            Law other = law;
            other.normal_onset *= scale, other.tangential_onset *= scale;
            other.normal_toughness *= scale, other.tangential_toughness *= scale;
            for (const double share : {0.1, 0.37})
                ck_assert_msg(adhesion_after(other, {t.onset * scale, t.total * scale}, 0.9, share) ==
                                  adhesion_after(law, t, 0.9, share),
                              "%s", name.c_str());
        }
    }
}
