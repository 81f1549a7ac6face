// SPDX-License-Identifier: BSD-3-Clause
// Laws with two onsets and toughnesses in shear: the criteria against their definition, bounds, what the check of a law
// finds between the shears, the response of a point, derivatives, and energies along paths that turn from one shear to
// the other.
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "evolution/increment/path_dissipation.hpp"
#include "law/admissible.hpp"
#include "law/driving.hpp"
#include "law/law_parameters.hpp"
#include "law/respond.hpp"
#include "laws.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

void near(double found, double exact, double tolerance, const std::string& what) {
    ck_assert_msg(std::abs(found - exact) <= tolerance, "%s: %.17g instead of %.17g, off by %.3e (allowed %.1e)",
                  what.c_str(), found, exact, found - exact, tolerance);
}

// G with ((1-B) G/G_n)^p + (B (1-S) G/G_1 + B S G/G_2)^q = 1, by halving an interval of ln G.
double by_definition(const Modes& m, double b, double s) {
    const auto sum = [&](long double g) {
        return std::pow((1.0L - b) * g / m.normal, static_cast<long double>(m.first)) +
               std::pow(b * (1.0L - s) * g / m.tangential + b * s * g / m.second_shear,
                        static_cast<long double>(m.second));
    };
    long double low = std::log(1e-3L), high = std::log(1e6L);
    for (int i = 0; i < 200; ++i) {
        const long double middle = low + (high - low) / 2.0L;
        (sum(std::exp(middle)) > 1.0L ? high : low) = middle;
    }
    return static_cast<double>(std::exp(low));
}

// A law of every shape whose second shear has these multiples of the onset and the toughness of the first.
std::vector<laws::Named> sheared(Criterion criterion, double onset, double total) {
    std::vector<laws::Named> out = laws::shapes(criterion, 4.0);
    std::erase_if(out, [](const laws::Named& named) { return named.law.host() != nullptr; });
    for (laws::Named& named : out) {
        named.law.second_tangential_stiffness = 0.7 * named.law.tangential_stiffness;
        if (named.law.softens()) named.law.second_tangential_onset = onset * named.law.tangential_onset;
        named.law.second_tangential_toughness = total * named.law.tangential_toughness;
    }
    return out;
}

std::string refusal(const Law& law) {
    return unit::refusal(DELAM_ERROR_PROBLEM, [&] { validate(law); });
}

void expect(const std::string& found, const std::string& part) {
    ck_assert_msg(!part.empty() && found.find(part) != std::string::npos, "'%s' lacks '%s'", found.c_str(),
                  part.c_str());
}

}  // namespace

TEST(criteria_by_their_definition) {
    for (const double p : {0.6, 1.0, 1.7, 2.0})
        for (const double q : {0.6, 1.0, 2.0, 3.1})
            for (const double other : {30.0, 110.0, 500.0}) {
                const Modes m{100.0, 250.0, p, q, other}, power{100.0, 250.0, q, q, other};
                for (int i = 0; i <= 8; ++i)
                    for (int k = 0; k <= 8; ++k) {
                        const double b = i / 8.0, s = k / 8.0;
                        const std::string where = "B = " + std::to_string(b) + ", S = " + std::to_string(s);
                        const double g = toughness_at(Criterion::valoroso_champaney, m, {b, s});
                        near(g, by_definition(m, b, s), 1e-12 * g, "Valoroso and Champaney, " + where);
                        const double h = toughness_at(Criterion::power, power, {b, s});
                        near(h, by_definition(power, b, s), 1e-12 * h, "power, " + where);
                        // The shears are alike: an exchange of both numbers exchanges the shares.
                        const Modes turned{m.normal, m.second_shear, m.first, m.second, m.tangential};
                        near(toughness_at(Criterion::valoroso_champaney, turned, {b, 1.0 - s}), g, 1e-13 * g,
                             "exchanged, " + where);
                        const double shear = 250.0 + (other - 250.0) * s;
                        const double bk = toughness_at(Criterion::benzeggagh_kenane, m, {b, s});
                        near(bk, 100.0 + (shear - 100.0) * std::pow(b, p), 1e-13 * bk, "Benzeggagh, " + where);
                    }
            }
}

TEST(bounds_hold_at_all_mixities) {
    std::mt19937 random(3);
    const auto real = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (int i = 0; i < 200; ++i)
        for (const Criterion criterion : laws::criteria) {
            const Modes m{real(10, 100), real(10, 100), real(0.4, 3), real(0.4, 3), real(10, 100)};
            const double least = least_toughness(criterion, m);
            for (int k = 0; k <= 400; ++k)
                ck_assert(toughness_at(criterion, m, {k / 20 / 20.0, k % 20 / 20.0}) >= least * (1.0 - 1e-12));
        }
}

// Numbers that are nearly equal are nearly one number, in all directions.
TEST(nearly_equal_numbers_are_nearly_one) {
    for (const Criterion criterion : laws::criteria)
        for (const double q : {0.6, 1.0, 2.0})
            for (const double s : {0.0, 0.3, 0.5, 1.0}) {
                const Modes one{100.0, 250.0, q, q}, two{100.0, 250.0, q, q, 250.0 * (1.0 + 1e-9)};
                for (const double b : {0.0, 0.4, 1.0}) {
                    const double g = toughness_at(criterion, one, b);
                    near(toughness_at(criterion, two, {b, s}), g, 2e-9 * g, "B = " + std::to_string(b));
                }
            }
}

// Equal numbers are one number, to the last bit, whatever the exponents.
TEST(equal_numbers_are_one) {
    for (const Criterion criterion : laws::criteria)
        for (laws::Named& named : sheared(criterion, 1.0, 1.0)) {
            Law one = named.law;
            one.second_tangential_onset = one.second_tangential_toughness = 0.0;
            ck_assert_msg(!named.law.two_shear_toughnesses(), "%s has two", named.name.c_str());
            const std::array<double, 3> jump{1e-6, 2e-5, -3e-5};
            ck_assert(driving_energy(named.law, jump).mixity() == driving_energy(one, jump).mixity());
            for (const double b : {0.0, 0.2, 0.7, 1.0})
                for (const double s : {0.0, 0.4, 1.0}) {
                    const Toughness a = named.law.toughness({b, s}), c = one.toughness({b, 0.0});
                    ck_assert_msg(a.onset == c.onset && a.total == c.total, "%s", named.name.c_str());
                }
        }
}

// Compares the check of a law with a scan of all mixities.
TEST(check_finds_what_lies_between_the_shears) {
    std::mt19937 random(5);
    const auto real = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    int refused = 0, accepted = 0;
    for (int i = 0; i < 60; ++i) {
        Law law;
        law.set_criterion(laws::criteria[static_cast<std::size_t>(i) % 3]);
        law.normal_stiffness = law.tangential_stiffness = 1e12;
        law.normal_onset = real(75, 99), law.tangential_onset = real(75, 99);
        law.normal_toughness = 100.0, law.tangential_toughness = 100.0;
        if (i % 2 == 0) law.second_tangential_onset = real(75, 99);
        if (i % 3 != 1) law.second_tangential_toughness = real(90, 110);
        law.onset_exponent_1 = real(0.7, 2.5), law.toughness_exponent_1 = real(0.7, 2.5);
        law.onset_exponent_2 = law.criterion == Criterion::power ? law.onset_exponent_1 : real(0.7, 2.5);
        law.toughness_exponent_2 = law.criterion == Criterion::power ? law.toughness_exponent_1 : real(0.7, 2.5);
        double least = 1e300;
        for (int b = 0; b <= 100; ++b)
            for (int s = 0; s <= 100; ++s) {
                const Mixity at{b / 100.0, s / 100.0};
                least = std::min(least, toughness_at(law.criterion, law.total_modes(), at) /
                                            toughness_at(law.criterion_of_onset(), law.onset_modes(), at));
            }
        if (std::abs(least - 1.0) < 1e-3) continue;  // between the places of the scan
        const std::string said = refusal(law);
        ck_assert_msg((said.empty()) == (least > 1.0), "least Gc/Go %.6f: '%s'", least, said.c_str());
        ++(said.empty() ? accepted : refused);
    }
    ck_assert_msg(refused > 5 && accepted > 5, "%d refused, %d accepted", refused, accepted);
}

TEST(refused_by_name) {
    Law law = laws::law("piecewise-linear", Criterion::power, 4.0);
    law.second_tangential_onset = 10.0 * law.tangential_toughness;
    expect(refusal(law), "tangential_toughness 853.333 < second_tangential_onset 8533.33");
    law.second_tangential_onset = 0.0;
    law.second_tangential_toughness = 0.5 * law.tangential_onset;
    expect(refusal(law), "second_tangential_toughness 80 < tangential_onset 160");
    // An onset with axes under a toughness without, whose exponents differ.
    law.second_tangential_toughness = 0.0;
    law.tangential_onset = 0.9 * law.tangential_toughness;
    law.second_tangential_onset = 0.95 * law.tangential_toughness;
    ck_assert(refusal(law).empty());
    law.normal_onset = 0.95 * law.normal_toughness;
    set_parameter(law, "onset_exponent", 2.0);
    set_parameter(law, "toughness_exponent", 1.0);
    expect(refusal(law), "and a share of the second shear of 0 although the pure modes are fine");
    // The one that is set last counts.
    ck_assert(set_parameter(law, "second_tangential_strength", 3e6) && law.second_tangential_onset == 0.0);
    near(law.onset_modes().second_shear, 9e12 / 2.0 / law.tangential_stiffness, 1e-9, "onset of a strength");
    ck_assert(set_parameter(law, "second_tangential_onset", 7.0) && law.second_tangential_strength == 0.0);
    ck_assert(law.onset_modes().second_shear == 7.0 && law.least_onset() == 7.0);
}

// Monotone loading along any direction: the peak traction sqrt(2 Y) of Go, and the area Gc.
TEST(point_at_any_angle) {
    for (const Criterion criterion : laws::criteria)
        for (const laws::Named& named : sheared(criterion, 0.6, 1.7)) {
            const Law& law = named.law;
            for (int angle = 0; angle <= 90; angle += 30)
                for (const double open : {0.0, 0.3}) {
                    const double turned = angle * std::acos(-1.0) / 180.0;
                    const std::array<double, 3> unit{open, std::cos(turned), std::sin(turned)};
                    const Driving y = driving_energy(law, unit);
                    const Mixity at = y.mixity();
                    const double first = law.tangential_stiffness * unit[1] * unit[1] / 2.0,
                                 second = law.second_tangential_stiffness * unit[2] * unit[2] / 2.0;
                    near(at.second, second / (first + second), 1e-15, named.name + ": share");
                    near(at.shear, (first + second) / y.total(), 1e-15, named.name + ": mixity");
                    const double onset = toughness_at(law.criterion_of_onset(), law.onset_modes(), at);
                    const double total = toughness_at(law.criterion, law.total_modes(), at);
                    const double begin = std::sqrt(onset / y.total()), end = 60.0 * total / onset * begin;
                    double area = 0.0, peak = 0.0, last = 0.0, zeta = 1.0, at_last = 0.0;
                    constexpr int steps = 2000;
                    for (int i = 1; i <= steps; ++i) {
                        // Evenly to just before the onset, where a table may drop; beyond it in a geometric
                        // progression.
                        const double jump = i <= 500 ? begin * (1.0 - 1e-9) * i / 500.0
                                                     : begin * std::pow(end / begin, (i - 500.0) / (steps - 500.0));
                        std::array<double, 3> u = unit;
                        for (double& component : u) component *= jump;
                        const PointResponse r = respond(law, u, at.shear, zeta);
                        zeta = r.adhesion;
                        double traction = 0.0;
                        for (std::size_t c = 0; c < 3; ++c) traction += r.traction[c] * unit[c];
                        area += 0.5 * (traction + last) * (jump - at_last);
                        peak = std::max(peak, traction);
                        last = traction, at_last = jump;
                    }
                    if (!law.softens()) continue;  // debonds at once, between two steps
                    near(peak, 2.0 * y.total() * begin, 1e-8 * peak, named.name + ": peak");
                    near(area, total, 2e-3 * total, named.name + ": area");
                }
        }
}

TEST(derivatives_by_both_shares) {
    for (const Criterion criterion : laws::criteria)
        for (const laws::Named& named : sheared(criterion, 0.6, 1.7)) {
            if (!named.law.softens()) continue;
            for (const double b : {0.3, 0.8})
                for (const double s : {0.2, 0.7}) {
                    constexpr double zeta = 0.02, h = 1e-4;
                    const auto driving = [&](double db, double ds) {
                        return named.law.driving(named.law.toughness({b + db, s + ds}), zeta);
                    };
                    const double size = driving(0, 0);
                    near(driving_by_shear(named.law, {b, s}, zeta), (driving(h, 0) - driving(-h, 0)) / (2 * h),
                         1e-6 * size, named.name + ": by B");
                    near(driving_by_second(named.law, {b, s}, zeta), (driving(0, h) - driving(0, -h)) / (2 * h),
                         1e-6 * size, named.name + ": by S");
                    ck_assert(std::abs(driving_by_second(named.law, {b, s}, zeta)) > 1e-3 * size);
                }
        }
}

// A pair that softens while its sliding turns from one shear to the other, with G_2 = 3.65 G_1 and a criterion that is
// straight between them: Y = s(S) Go w^2 and zeta = (Gc/w - Go)/(Gc - Go), w from 1.05 to 2. It dissipates
// int Y (-dzeta) = Go Gc/(Gc - Go) int s(S) dw.
TEST(paths_that_turn_between_the_shears) {
    constexpr double onset = 100.0, total = 250.0, growth = 2.65;
    Law law;
    law.set_criterion(Criterion::benzeggagh_kenane);
    law.normal_stiffness = 125e9, law.tangential_stiffness = 60e9, law.second_tangential_stiffness = 20e9;
    law.normal_onset = law.tangential_onset = onset;
    law.normal_toughness = law.tangential_toughness = total;
    law.second_tangential_onset = (1.0 + growth) * onset;
    law.second_tangential_toughness = (1.0 + growth) * total;
    set_parameter(law, "onset_exponent", 1.0);
    set_parameter(law, "toughness_exponent", 1.0);
    PairLaws pairs;
    pairs.dimension = 3;
    pairs.law = {&law};
    pairs.weight = {1.0};
    ck_assert(pairs.two_shears() && opening(pairs).second.size() == 1);
    for (const auto& [from, to] : {std::pair(0.1, 0.9), std::pair(0.9, 0.3)}) {
        const auto share = [&, first = from, last = to](double t) { return first + (last - first) * t; };
        const auto w = [](double t) { return 1.05 + 0.95 * t; };
        const auto adhesion = [&](double t) { return (total / w(t) - onset) / (total - onset); };
        const auto jump = [&](double t) {
            const double s = share(t), y = (1.0 + growth * s) * onset * w(t) * w(t);
            return std::vector<double>{0.0, std::sqrt(2.0 * (1.0 - s) * y / law.tangential_stiffness),
                                       -std::sqrt(2.0 * s * y / law.second_tangential_stiffness)};
        };
        const double exact = onset * total / (total - onset) * 0.95 * (1.0 + growth * (from + to) / 2.0);
        double coarse = 0.0;
        for (const int steps : {20, 40}) {
            double sum = 0.0;
            for (int i = 1; i <= steps; ++i) {
                const double before = (i - 1.0) / steps, after = static_cast<double>(i) / steps;
                const std::vector<double> last = i > 1 ? jump((i - 2.0) / steps) : std::vector<double>{};
                const std::vector<double> begin = jump(before), end = jump(after);
                sum +=
                    path_energy(pairs, 0, {last, begin, end, adhesion(before), adhesion(after)}, {0.0, 0.0}).dissipated;
            }
            const double error = std::abs(sum - exact) / exact;
            near(error, 0.0, steps == 20 ? 1e-4 : 2e-5, "error of the dissipated energy");
            if (steps == 40) ck_assert_msg(error < 0.2 * coarse, "error %.3e after %.3e", error, coarse);
            coarse = error;
        }
    }
    // Between two jumps along the axes lies the mixity with which a pair debonds that goes from one to the other.
    const std::vector<double> slide{0.0, 1e-4, 0.0}, across{0.0, 0.0, 2e-4};
    const Mixity met = path_mixity(pairs, 0, slide, across, {0.0, 0.0});
    ck_assert(met.shear == 1.0 && met.second > 0.05 && met.second < 0.95);
}
