// SPDX-License-Identifier: BSD-3-Clause
// Stability against units and sizes: a march in other units of length and force gives the same numbers. Powers of two
// change no digit but by the order of summation; other factors round the data. A tolerance that is absolute shows here.
#include <algorithm>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

constexpr double delta = 1e-12;

// Mixed-mode cantilever with every length `a` and every force `b` times the SI number; per unit thickness in the plane.
Cantilever scaled(double a, double b, int dimension) {
    Cantilever c;
    c.dimension = dimension;
    const double stress = b / (a * a), energy = stress * a;
    if (dimension == 3) c.columns = 16, c.notch = 5;
    c.length *= a;
    c.arm *= a;
    c.width *= a;
    c.lift *= a;
    c.young_lower *= stress;
    c.young_upper *= stress;
    c.law = {1e13 * stress / a, 2e13 * stress / a, 50.0 * energy, 80.0 * energy, 200.0 * energy, 400.0 * energy};
    c.delta = delta;
    return c;
}

// The march in SI units, by each realisation for itself.
struct Twin {
    std::vector<Result> condensed, feti;
    const Result& at(const Result& r) const {
        return (r.realisation == Realisation::feti ? feti : condensed).at(r.step);
    }
};

std::shared_ptr<const Twin> twin_of(const Cantilever& c, const std::vector<double>& times) {
    Trial t;
    t.scene = [=] { return make_cantilever(c); };
    t.times = times;
    return std::make_shared<Twin>(Twin{states_of(t, Realisation::condensed), states_of(t, Realisation::feti)});
}

double scaled_difference(const Result& r, const Result& si, double a, double b, int dimension) {
    const double force = dimension == 2 ? b / a : b, energy = force * a, stress = b / (a * a);
    const auto times = [](std::vector<double> v, double factor) {
        for (double& x : v) x *= factor;
        return v;
    };
    double worst = std::max({relative_difference(r.displacement, times(si.displacement, a)),
                             relative_difference(r.jump, times(si.jump, a)),
                             relative_difference(r.traction, times(si.traction, stress)),
                             relative_difference(r.adhesion, si.adhesion),
                             relative_difference(r.pattern, times(si.pattern, force))});
    const double scale = si.work * energy;
    for (const double miss : {r.stored_bulk - si.stored_bulk * energy, r.stored_interface - si.stored_interface * energy,
                              r.dissipated - si.dissipated * energy, r.work - si.work * energy})
        if (!std::isnan(miss)) worst = std::max(worst, std::abs(miss) / scale);
    return worst;
}

void units(Study& study, const std::string& subject, const std::string& parameter_name,
           const std::vector<double>& factors, bool length, double limit, int dimension, std::size_t stride) {
    if (!study.wanted(subject)) return;
    const std::vector<double> times{0.25, 0.5, 0.75, 1.0};
    const auto twin = twin_of(scaled(1.0, 1.0, dimension), times);
    for (const double factor : study.range(factors, stride)) {
        const double a = length ? factor : 1.0, b = length ? 1.0 : factor;
        const Cantilever c = scaled(a, b, dimension);
        Trial t;
        t.subject = subject;
        t.parameter_name = parameter_name;
        t.parameter = factor;
        t.times = times;
        t.law = c.law;
        t.delta = delta;
        t.scene = [=] { return make_cantilever(c); };
        t.reference = "twin in SI units";
        t.error = [=](const Result& r) {
            return scaled_difference(r, twin->at(r), a, b, dimension);
        };
        t.limit = limit;
        t.direct_limit = 1e-9;  // beside the condensed twin
        study.run(t);
    }
}

// A specimen of another size of the same materials: G, k and the load follow, so that the answer is the same but for
// its scale.
Cantilever sized(double size) {
    Cantilever c;
    c.length *= size;
    c.arm *= size;
    c.lift *= size;
    c.law = {1e13 / size, 2e13 / size, 50.0 * size, 80.0 * size, 200.0 * size, 400.0 * size};
    c.delta = delta;
    return c;
}

void sizes(Study& study) {
    if (!study.wanted("size")) return;
    const std::vector<double> times{0.25, 0.5, 0.75, 1.0};
    const auto twin = twin_of(sized(1.0), times);
    // Lengths of 40 nm to 40 km.
    for (const double size : study.range({1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6}, 4)) {
        const Cantilever c = sized(size);
        Trial t;
        t.subject = "size";
        t.parameter_name = "length / 40 mm";
        t.parameter = size;
        t.times = times;
        t.law = c.law;
        t.delta = delta;
        t.scene = [=] { return make_cantilever(c); };
        t.reference = "twin of 40 mm";
        t.error = [=](const Result& r) {
            // Stresses are those of the twin: forces go with the square of the size.
            return scaled_difference(r, twin->at(r), size, size * size, 2);
        };
        t.limit = 1e-9;
        study.run(t);
    }
}

}  // namespace

void stability_units(Study& study) {
    std::vector<double> binary, decimal;
    // Powers of four: the square root in a Cholesky factor keeps the digits of those alone.
    for (int e = -30; e <= 30; e += 6) binary.push_back(std::ldexp(1.0, e));
    for (int e = -9; e <= 9; ++e) decimal.push_back(std::pow(10.0, e));
    sizes(study);
    units(study, "unit-length-binary", "unit of length", binary, true, 1e-14, 2, 5);
    units(study, "unit-force-binary", "unit of force", binary, false, 1e-14, 2, 5);
    units(study, "unit-length", "unit of length", decimal, true, 1e-9, 2, 9);
    units(study, "unit-force", "unit of force", decimal, false, 1e-9, 2, 9);
    units(study, "unit-length-3d", "unit of length", {1e-9, 1e-6, 1e-3, 1.0 / 0.0254, 1e3, 1e9}, true, 1e-9, 3, 5);
}

}  // namespace harness
