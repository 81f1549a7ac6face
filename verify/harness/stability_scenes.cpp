// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "stability.hpp"

namespace harness {

using reference::Scene;

namespace {

long double criterion(long double mixity, double normal, double tangential, double exponent) {
    const long double a = exponent, n = normal, t = tangential;
    // Scaled by the smaller of the two, so that large exponents neither overflow nor underflow.
    const long double unit = std::min(n, t);
    return unit * std::pow(std::pow((1.0L - mixity) * unit / n, a) + std::pow(mixity * unit / t, a), -1.0L / a);
}

}  // namespace

OwnLaw::OwnLaw(const reference::LawData& law) : data(law) {}

long double OwnLaw::onset(long double mixity) const {
    return criterion(mixity, data.normal_onset, data.tangential_onset, data.exponent);
}

long double OwnLaw::toughness(long double mixity) const {
    return criterion(mixity, data.normal_toughness, data.tangential_toughness, data.exponent);
}

long double OwnLaw::driving(const double* jump, int dimension) const {
    long double y = 0.5L * data.normal_stiffness * jump[0] * jump[0];
    for (int c = 1; c < dimension; ++c) y += 0.5L * data.tangential_stiffness * jump[c] * jump[c];
    return y;
}

long double OwnLaw::mixity(const double* jump, int dimension) const {
    const long double y = driving(jump, dimension);
    return y > 0.0L ? 1.0L - 0.5L * data.normal_stiffness * jump[0] * jump[0] / y : 0.0L;
}

long double OwnLaw::adhesion(long double mixity, long double y, long double old) const {
    const long double go = onset(mixity), gc = toughness(mixity), d = gc - go;
    if (y <= go) return old;
    if (d <= 1e-12L * gc) return y < gc ? old : 0.0L;
    return std::clamp((gc * std::sqrt(go / y) - go) / d, 0.0L, old);
}

long double OwnLaw::spent(long double mixity, long double adhesion) const {
    const long double go = onset(mixity), gc = toughness(mixity);
    return gc * go * (1.0L - adhesion) / (go + (gc - go) * adhesion);
}

void begin_standard(Scene& scene) {
    scene.begin();
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
}

Scene make_cantilever(const Cantilever& c) {
    const bool plane = c.dimension == 2;
    const std::int32_t cell = c.cell != 0 ? c.cell : plane ? DELAM_QUAD4 : DELAM_HEX8;
    Scene scene(c.dimension, plane ? std::vector<double>{c.length} : std::vector<double>{c.length, c.width},
                plane ? std::vector<std::int64_t>{c.columns} : std::vector<std::int64_t>{c.columns, c.ranks},
                {c.arm, c.arm}, {c.rows, c.rows}, cell);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(0, c.young_lower, c.poisson);
    scene.elastic(1, c.young_upper, c.poisson);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, c.formulation.c_str());
    if (c.bonded) {
        scene.bonded(0);
    } else {
        scene.law(0, c.law);
        const auto a = scene.pairs(0).node_a;
        const double step = c.length / static_cast<double>(c.columns);
        std::vector<std::int64_t> notch;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (scene.coordinate(a[i], 0) < (static_cast<double>(c.notch) - 0.25) * step)
                notch.push_back(static_cast<std::int64_t>(i));
        scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    }
    const double top = 2.0 * c.arm;
    const auto at = [&](double x, double y, double z) {
        return plane ? std::vector<double>{x, z} : std::vector<double>{x, y, z};
    };
    const auto right = scene.find(-1, at(c.length, 0, 0), at(c.length, c.width, top));
    for (int k = 0; k < c.dimension; ++k) {
        std::vector<double> axis(static_cast<std::size_t>(c.dimension), 0.0);
        axis[static_cast<std::size_t>(k)] = 1.0;
        scene.hold(right, axis);
    }
    std::vector<double> up(static_cast<std::size_t>(c.dimension), 0.0);
    up.back() = 1.0;
    const auto load =
        c.times.empty() ? scene.pattern("lift", {0.0, 1.0}, {0.0, c.lift}) : scene.pattern("lift", c.times, c.lifts);
    const auto corner = scene.find(1, at(0, 0, top), at(0, c.width, top));
    scene.drive(corner, up, load, std::vector<double>(corner.size(), 1.0));
    scene.number("damage_tolerance", c.delta);
    return scene;
}

Scene make_driven(const reference::LawData& law, const std::vector<double>& times, const std::vector<double>& open,
                  const std::vector<double>& slide, double delta) {
    Scene scene(2, {1e-3}, {1}, {1e-3, 1e-3}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, law);
    const auto lower = scene.find(0, {0.0, 0.0}, {1.0, 1.0}), upper = scene.find(1, {0.0, 0.0}, {1.0, 1.0});
    scene.hold(lower, {1.0, 0.0});
    scene.hold(lower, {0.0, 1.0});
    scene.drive(upper, {0.0, 1.0}, scene.pattern("open", times, open), std::vector<double>(upper.size(), 1.0));
    scene.drive(upper, {1.0, 0.0}, scene.pattern("slide", times, slide), std::vector<double>(upper.size(), 1.0));
    scene.number("damage_tolerance", delta);
    return scene;
}

}  // namespace harness
