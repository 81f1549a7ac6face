// SPDX-License-Identifier: BSD-3-Clause
// Stability against units and sizes: an analysis in other units of length and force must give the same numbers. Powers
// of four change no digit; odd powers of two change those of the square roots in a Cholesky factor; other factors round
// the data. This test reveals absolute tolerances.
#include <algorithm>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

constexpr double delta = 1e-12;
// Allowed differences: only the last digit; and rounding of the data, 1e-16, amplified by a process zone close to
// instability. The direct reference uses the adhesions of the condensed analysis. (Measured by the case d-units of the
// report, all factors: 6e-10 on one processor, 2.1e-9 on another with other kernels of BLAS. 1e-9 is therefore a matter
// of the machine, and 1e-8 leaves a factor of five.)
constexpr double exact = 1e-14, rounded = 1e-8;

// Multipliers of every length and every force of an analysis.
struct Scale {
    double length, force;
};

// A mixed-mode cantilever with lengths and forces multiplied; in the plane, forces are per unit thickness.
Cantilever scaled(Scale by, int dimension) {
    Cantilever c;
    c.dimension = dimension;
    const double a = by.length, stress = by.force / (a * a), energy = stress * a;
    if (dimension == 3) c.columns = 16, c.notch = 5;
    c.length *= a;
    c.arm *= a;
    c.width *= a;
    c.lift *= a;
    c.young_lower *= stress;
    c.young_upper *= stress;
    c.law.normal_stiffness *= stress / a;
    c.law.tangential_stiffness *= stress / a;
    for (double* per_area :
         {&c.law.normal_onset, &c.law.tangential_onset, &c.law.normal_toughness, &c.law.tangential_toughness})
        *per_area *= energy;
    c.delta = delta;
    return c;
}

// The reference analysis in SI units, or at 40 mm, separately for each realisation.
struct Unscaled {
    std::vector<Result> condensed, feti;
    const Result& at(const Result& r) const {
        return (r.realisation == Realisation::feti ? feti : condensed).at(r.step);
    }
};

Unscaled unscaled_analysis(int dimension, const std::vector<double>& times) {
    Trial t;
    t.scene = [=] { return make_cantilever(scaled({1.0, 1.0}, dimension)); };
    t.times = times;
    return {states_of(t, Realisation::condensed), states_of(t, Realisation::feti)};
}

double scaled_difference(const Result& r, const Result& si, Scale by, int dimension) {
    const double a = by.length, force = dimension == 2 ? by.force / a : by.force;
    const double energy = force * a, stress = by.force / (a * a);
    const auto times = [](std::vector<double> v, double factor) {
        for (double& x : v) x *= factor;
        return v;
    };
    double worst = std::max(
        {relative_difference(r.displacement, times(si.displacement, a)), relative_difference(r.jump, times(si.jump, a)),
         relative_difference(r.traction, times(si.traction, stress)), relative_difference(r.adhesion, si.adhesion),
         relative_difference(r.pattern, times(si.pattern, force))});
    const double scale = si.work * energy;
    for (const double miss :
         {r.stored_bulk - si.stored_bulk * energy, r.stored_interface - si.stored_interface * energy,
          r.dissipated - si.dissipated * energy, r.work - si.work * energy})
        if (!std::isnan(miss)) worst = std::max(worst, std::abs(miss) / scale);
    return worst;
}

struct Range {
    std::string subject, parameter_name;
    std::vector<double> factors;
    Scale (*scale)(double factor);
    double limit;
    std::string reference = "the analysis in SI units";
    int dimension = 2;
    std::size_t stride = 9;  // for --quick
};

void scaled_analyses(Study& study, const Range& range) {
    if (!study.wanted(range.subject)) return;
    const std::vector<double> times{0.25, 0.5, 0.75, 1.0};
    const auto unscaled = std::make_shared<const Unscaled>(unscaled_analysis(range.dimension, times));
    for (const double factor : study.range(range.factors, range.stride)) {
        const Scale by = range.scale(factor);
        const Cantilever c = scaled(by, range.dimension);
        Trial t = trial_of(range.subject, range.parameter_name, factor);
        t.times = times;
        t.law = c.law;
        t.delta = delta;
        t.scene = [=] { return make_cantilever(c); };
        t.reference = range.reference;
        t.error = [=, dimension = range.dimension](const Result& r) {
            return scaled_difference(r, unscaled->at(r), by, dimension);
        };
        t.limit = range.limit;
        t.direct_limit = rounded;
        study.run(t);
    }
}

std::vector<double> powers(double base, int first, int last, int step) {
    std::vector<double> all;
    for (int e = first; e <= last; e += step) all.push_back(std::pow(base, e));
    return all;
}

}  // namespace

void stability_units(Study& study) {
    const auto length = [](double factor) { return Scale{factor, 1.0}; };
    const auto force = [](double factor) { return Scale{1.0, factor}; };
    // The same materials: stresses keep their values, so that forces scale with the square of the size. 40 nm to 40 km.
    const auto size = [](double factor) { return Scale{factor, factor * factor}; };
    const std::vector<double> decimal = powers(10.0, -9, 9, 1);
    // The square root in a Cholesky factor keeps its digits only for powers of four. A unit of length changes the
    // stiffness by its square, so odd powers of two do, too.
    const std::vector<double> four = powers(2.0, -30, 30, 6), odd = powers(2.0, -29, 29, 2);
    scaled_analyses(study,
                    {"size", "length / 40 mm", powers(10.0, -6, 6, 1), size, rounded, "the analysis at 40 mm", 2, 4});
    scaled_analyses(study, {.subject = "unit-length-binary",
                            .parameter_name = "unit of length",
                            .factors = four,
                            .scale = length,
                            .limit = exact,
                            .stride = 5});
    scaled_analyses(study, {.subject = "unit-force-binary",
                            .parameter_name = "unit of force",
                            .factors = four,
                            .scale = force,
                            .limit = exact,
                            .stride = 5});
    scaled_analyses(study, {.subject = "unit-length-odd",
                            .parameter_name = "unit of length",
                            .factors = odd,
                            .scale = length,
                            .limit = exact,
                            .stride = 15});
    scaled_analyses(study, {.subject = "unit-force-odd",
                            .parameter_name = "unit of force",
                            .factors = odd,
                            .scale = force,
                            .limit = rounded,
                            .stride = 15});
    scaled_analyses(study, {.subject = "unit-length",
                            .parameter_name = "unit of length",
                            .factors = decimal,
                            .scale = length,
                            .limit = rounded});
    scaled_analyses(study, {.subject = "unit-force",
                            .parameter_name = "unit of force",
                            .factors = decimal,
                            .scale = force,
                            .limit = rounded});
    scaled_analyses(study, {.subject = "unit-length-3d",
                            .parameter_name = "unit of length",
                            .factors = {1e-9, 1e-6, 1e-3, 1.0 / 0.0254, 1e3, 1e9},
                            .scale = length,
                            .limit = rounded,
                            .dimension = 3,
                            .stride = 5});
}

}  // namespace harness
