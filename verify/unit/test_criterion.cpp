// SPDX-License-Identifier: BSD-3-Clause
// Mixed-mode criteria: closed forms, slopes, the check that the toughness is nowhere below the onset; parameters and
// tables of laws.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "law/admissible.hpp"
#include "law/criterion.hpp"
#include "law/law.hpp"
#include "law/law_parameters.hpp"
#include "laws.hpp"
#include "refused.hpp"

using delam::Criterion;
using delam::Law;
using delam::Modes;

namespace {

bool close(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

std::string refusal(const Law& law) {
    return unit::refusal(DELAM_ERROR_PROBLEM, [&] { validate(law); });
}

std::string table_refusal(const std::vector<double>& xi, const std::vector<double>& s) {
    return unit::refusal(DELAM_ERROR_ARGUMENT, [&] { delam::TabulatedSoftening().set_table(xi, s); });
}

void expect(const std::string& text, const std::string& part) {
    ck_assert_msg(!part.empty() && text.find(part) != std::string::npos, "'%s' lacks '%s'", text.c_str(), part.c_str());
}

}  // namespace

TEST(closed_forms) {
    for (int i = 0; i <= 20; ++i) {
        const double b = i / 20.0;
        const Modes eta{100.0, 700.0, 2.284, 9.0};
        const double mixed = delam::toughness_at(Criterion::benzeggagh_kenane, eta, b);
        ck_assert(close(mixed, 100.0 + 600.0 * std::pow(b, 2.284), 1e-15));
        const Modes power{100.0, 700.0, 1.6, 1.6};
        const double g = std::pow(std::pow((1.0 - b) / 100.0, 1.6) + std::pow(b / 700.0, 1.6), -1.0 / 1.6);
        ck_assert(close(delam::toughness_at(Criterion::power, power, b), g, 1e-14));
        ck_assert(delam::toughness_at(Criterion::valoroso_champaney, power, b) ==
                  delam::toughness_at(Criterion::power, power, b));
    }
    for (const Criterion criterion : laws::criteria)
        for (const double exponent : {0.5, 1.0, 2.3}) {
            const Modes modes{3.0, 8.0, exponent, exponent};
            ck_assert(delam::toughness_at(criterion, modes, 0.0) == 3.0);
            ck_assert(close(delam::toughness_at(criterion, modes, 1.0), 8.0, 1e-15));
            ck_assert(delam::depends_on_mixity(criterion, modes));
            const Modes same{3.0, 3.0, 1.0, 1.0};
            ck_assert(!delam::depends_on_mixity(criterion, same));
            for (const double b : {0.0, 1e-3, 0.4, 1.0}) ck_assert(delam::toughness_at(criterion, same, b) == 3.0);
        }
}

// dG/dB by differences with long steps in the logarithm of B and of 1-B; one-sided at the pure modes.
TEST(slopes) {
    for (const Criterion criterion : laws::criteria)
        for (const double p : {0.6, 1.0, 1.5, 2.0, 4.0})
            for (const double q : {0.6, 1.0, 2.3, 5.0}) {
                if (criterion != Criterion::valoroso_champaney && q != 1.0) continue;
                const Modes m{100.0, 730.0, p, criterion == Criterion::power ? p : q};
                for (const double b : {1e-4, 0.02, 0.3, 0.5, 0.8, 0.99, 0.9999}) {
                    const double h = 1e-5 * std::min(b, 1.0 - b);
                    const double above = delam::toughness_at(criterion, m, b + h);
                    const double difference = (above - delam::toughness_at(criterion, m, b - h)) / (2.0 * h);
                    const double slope = delam::toughness_slope_at(criterion, m, b);
                    ck_assert_msg(std::abs(slope - difference) <= 1e-7 * std::abs(slope) + 1e-11 / h,
                                  "%s p %g q %g B %g: %.12g, %.12g", delam::name_of(criterion), m.first, m.second, b,
                                  slope, difference);
                }
                for (const double b : {0.0, 1.0}) {
                    const double slope = delam::toughness_slope_at(criterion, m, b);
                    ck_assert_msg(std::isfinite(slope), "%s p %g q %g B %g", delam::name_of(criterion), p, q, b);
                    if (m.first < 1.0 || m.second < 1.0) continue;  // cut off
                    const double h = 1e-9, inside = b == 0.0 ? h : 1.0 - h;
                    const double at_end = delam::toughness_at(criterion, m, b);
                    const double difference = (delam::toughness_at(criterion, m, inside) - at_end) / (inside - b);
                    ck_assert_msg(std::abs(slope - difference) <= 1e-2 * std::abs(slope) + 0.1,
                                  "%s p %g q %g B %g: %g, %g", delam::name_of(criterion), p, q, b, slope, difference);
                }
            }
    const Modes same{3.0, 3.0, 1.0, 1.0};
    for (const Criterion criterion : laws::criteria)
        for (const double b : {0.0, 0.5, 1.0}) ck_assert(delam::toughness_slope_at(criterion, same, b) == 0.0);
}

// No mixity has a lower toughness than the bound, and one has it where the exponents are at least 1.
TEST(least_toughness) {
    for (const Criterion criterion : laws::criteria)
        for (const double p : {0.3, 0.8, 1.0, 2.0, 8.0})
            for (const double q : {0.4, 1.0, 3.0})
                for (const double gt : {0.2, 1.0, 5.0}) {
                    const Modes m{1.0, gt, p, criterion == Criterion::valoroso_champaney ? q : p};
                    const double bound = delam::least_toughness(criterion, m);
                    double least = std::min(1.0, gt);
                    for (int i = 0; i <= 10000; ++i)
                        least = std::min(least, delam::toughness_at(criterion, m, 1e-4 * i));
                    ck_assert_msg(bound > 0.0 && bound <= least * (1.0 + 1e-12), "%s p %g q %g: %g above %g",
                                  delam::name_of(criterion), m.first, m.second, bound, least);
                    if (m.first >= 1.0 && m.second >= 1.0) ck_assert(bound == std::min(1.0, gt));
                }
}

// A minimum of Gc/Go between two admissible pure modes; admissible on one side of the limit and refused on the other.
TEST(admissible) {
    // G = 100 + 300 B^eta: the onset, with eta = 1, is 250 at B = 1/2, the toughness, with eta = 4, r (100 + 300/16).
    Law law = laws::law("exponential", Criterion::benzeggagh_kenane, 1.5);
    law.normal_onset = 100.0;
    law.tangential_onset = 400.0;
    const auto scaled = [&](double r) {
        law.normal_toughness = 100.0 * r;
        law.tangential_toughness = 400.0 * r;
        return refusal(law);
    };
    set_parameter(law, "onset_exponent", 1.0);
    set_parameter(law, "toughness_exponent", 4.0);
    expect(scaled(1.5), "change the exponents");
    // max over B of (1 + 3 B)/(1 + 3 B^4)
    double worst = 0.0;
    for (int i = 0; i <= 1000000; ++i) {
        const double b = i * 1e-6;
        worst = std::max(worst, (1.0 + 3.0 * b) / (1.0 + 3.0 * b * b * b * b));
    }
    expect(scaled(worst * (1.0 - 1e-8)), "although the pure modes are fine");
    ck_assert(scaled(worst * (1.0 + 1e-8)).empty());
    set_parameter(law, "onset_exponent", 4.0);
    set_parameter(law, "toughness_exponent", 1.0);
    ck_assert(scaled(1.0).empty());
    set_parameter(law, "toughness_exponent", 4.0);
    ck_assert(scaled(1.0).empty());
    expect(scaled(0.99), "normal_toughness 99 < normal_onset 100");
    // The minimum is narrow here: next to the pure mode.
    set_parameter(law, "onset_exponent", 0.05);
    set_parameter(law, "toughness_exponent", 60.0);
    expect(scaled(2.0), "change the exponents");

    Law power = laws::law("trapezoidal", Criterion::power, 1.2);
    set_parameter(power, "plateau", 0.3);
    set_parameter(power, "onset_exponent", 8.0);
    set_parameter(power, "toughness_exponent", 1.0);
    expect(refusal(power), "although the pure modes are fine");
    set_parameter(power, "onset_exponent", 1.0);
    set_parameter(power, "toughness_exponent", 8.0);
    ck_assert(refusal(power).empty());

    // Griffith's law has no onset that could be larger.
    Law griffith = laws::law("griffith", Criterion::power, 1.0);
    griffith.normal_onset = 1e9;
    ck_assert(refusal(griffith).empty());
    ck_assert(griffith.toughness(0.3).onset == griffith.toughness(0.3).total);
    ck_assert(griffith.least_onset() == std::min(griffith.normal_toughness, griffith.tangential_toughness));
}

TEST(keys) {
    for (const laws::Named& named : laws::shapes(Criterion::valoroso_champaney, 2.0)) {
        ck_assert_msg(refusal(named.law).empty(), "%s: %s", named.name.c_str(), refusal(named.law).c_str());
        for (const delam::LawParameter& p : delam::law_parameters()) {
            Law law = named.law;
            const bool has = delam::applies(p, law) && std::string(p.type) == "real";
            ck_assert_msg(set_parameter(law, p.key, -1.0) == has, "%s: %s", named.name.c_str(), p.key);
            if (has) expect(refusal(law), std::string("law: ") + p.key + " -1: must be " + p.range.words);
        }
    }
    Law law = laws::law("piecewise-linear", Criterion::valoroso_champaney, 2.0);
    ck_assert(!set_parameter(law, "onset_exponent", 3.0) && !set_parameter(law, "plateau", 0.5) &&
              !set_parameter(law, "criterion", 1.0));
    law.set_criterion(Criterion::power);
    ck_assert(law.onset_modes().first == 2.0 && law.onset_modes().second == 2.0);
    ck_assert(set_parameter(law, "onset_exponent", 3.0) && !set_parameter(law, "onset_exponent_1", 1.0));
    ck_assert(law.onset_modes().first == 3.0 && law.onset_modes().second == 3.0);
    ck_assert(set_parameter(law, "gradient", 0.5) && refusal(law).empty() && law.gradient == 0.5);

    Law trapezium = laws::law("trapezoidal", Criterion::power, 2.0);
    expect(refusal(trapezium), "plateau -1: must be >= 0 and < 1");
    set_parameter(trapezium, "plateau", 1.0);
    expect(refusal(trapezium), "plateau 1: must be >= 0 and < 1");
    set_parameter(trapezium, "plateau", std::nan(""));
    expect(refusal(trapezium), "plateau nan");
    expect(refusal(laws::law("tabulated", Criterion::power, 2.0)), "softening is missing");
}

TEST(tables) {
    ck_assert(table_refusal({0.0, 1.0}, {1.0, 0.0}).empty());
    ck_assert(table_refusal({0.0, 0.4, 0.4, 1.0, 1.0}, {1.0, 1.0, 0.4, 0.4, 0.0}).empty());
    ck_assert(table_refusal({0.0, 0.4, 1.0}, {1.0, 0.0, 0.0}).empty());
    expect(table_refusal({0.0}, {1.0}), "count = 1");
    expect(table_refusal({0.0, 0.6, 0.5, 1.0}, {1.0, 0.5, 0.4, 0.0}), "xi[2] = 0.5 < xi[1] = 0.6");
    expect(table_refusal({0.0, 0.5, 0.6, 1.0}, {1.0, 0.4, 0.5, 0.0}), "s[2] = 0.5 > s[1] = 0.4");
    expect(table_refusal({0.1, 1.0}, {1.0, 0.0}), "point 0 = (0.1, 1)");
    expect(table_refusal({0.0, 1.0}, {0.9, 0.0}), "point 0 = (0, 0.9)");
    expect(table_refusal({0.0, 0.9}, {1.0, 0.0}), "point 1 = (0.9, 0)");
    expect(table_refusal({0.0, 1.0}, {1.0, 0.1}), "point 1 = (1, 0.1)");
    expect(table_refusal({0.0, 1.5, 1.0}, {1.0, 0.5, 0.0}), "xi[1] = 1.5");
    expect(table_refusal({0.0, 0.5, 1.0}, {1.0, std::nan(""), 0.0}), "s[1] = nan");
    expect(table_refusal({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}), "area under the table is 0");
}
