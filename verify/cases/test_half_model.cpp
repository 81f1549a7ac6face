// SPDX-License-Identifier: BSD-3-Clause
// Two blocks with a notch from both sides, pressed and pulled apart: half of them on its plane of symmetry, turned in
// the plane or in space so that every support is skew, and pressed on a rigid obstacle instead of rollers.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "support.hpp"

namespace {

using cases::Block;
using reference::LawData;
using reference::Scene;
using reference::Solver;

using Vector = std::array<double, 3>;

struct Model {
    int d = 2;
    const char* reduction = "condensed";
    bool whole = false;
    double angle = 0.0;  // in the plane of the first two axes; in space half of it in that of the last two
    bool obstacle = false;
    bool pull = true;
};

Vector turned(const Model& model, const Vector& x) {
    const double c = std::cos(model.angle), s = std::sin(model.angle);
    const Vector y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    if (model.d == 2) return y;
    const double cc = std::cos(0.5 * model.angle), ss = std::sin(0.5 * model.angle);
    return {y[0], cc * y[1] - ss * y[2], ss * y[1] + cc * y[2]};
}

std::vector<double> along(const Model& model, std::size_t axis, double sign = 1.0) {
    Vector unit{};
    unit[axis] = sign;
    const Vector e = turned(model, unit);
    return {e.begin(), e.begin() + model.d};
}

std::vector<double> values_of(const Model& model) {
    const double left = model.whole ? -2.0 : 0.0;
    const int cells = model.whole ? 16 : 8;
    Scene scene = cases::make_blocks(
        model.d,
        {Block{{left, 0.0, 0.0}, {2.0, 1.0, 1.0}, {cells, 3, 2}},
         Block{{left, 1.0, 0.0}, {2.0, 2.0, 1.0}, {cells, 3, 2}}},
        [&](const Vector& x) { return turned(model, x); }, 1);
    // Nodes by their places before the turn.
    const auto where = [&](std::int32_t body, std::size_t axis, double place) {
        std::vector<std::int64_t> found;
        const std::vector<double> e = along(model, axis);
        for (const std::int64_t n : cases::nodes_where(scene, body, [&](const double* x) {
                 double at = 0.0;
                 for (std::size_t k = 0; k < e.size(); ++k) at += e[k] * x[k];
                 return std::abs(at - place) < 1e-9;
             }))
            found.push_back(n);
        return found;
    };
    scene.interface(0, 1);
    const auto bottom = where(0, 1, 0.0), top = where(1, 1, 2.0);
    if (model.obstacle) {
        std::vector<double> normals;
        for (std::size_t i = 0; i < bottom.size(); ++i)
            for (const double n : along(model, 1)) normals.push_back(n);
        scene.obstacle(bottom, normals, 0);
    }
    scene.begin();
    scene.elastic(-1, 1000.0, 0.3);
    // The mode does not matter: the parts of a step, if it did, depend on the number of fronts.
    scene.law(0, LawData{2e4, 1e4, 1e-4, 1e-4, 2e-2, 2e-2, 1.0});
    std::vector<std::int64_t> notch;
    const auto pairs = scene.pairs(0);
    const std::vector<double> first = along(model, 0);
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        double x = 0.0;
        for (int k = 0; k < model.d; ++k)
            x += first[static_cast<std::size_t>(k)] * scene.coordinate(pairs.node_b[p], k);
        if (std::abs(x) > 1.4) notch.push_back(static_cast<std::int64_t>(p));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    for (const std::int32_t body : {0, 1}) scene.hold(where(body, 0, 0.0), along(model, 0));
    for (const std::int32_t body : {0, 1})
        if (model.d == 3) scene.hold(where(body, 2, 0.0), along(model, 2));
    if (model.obstacle) {
        scene.contact(1);
        for (int k = 0; k < model.d; ++k) scene.hold({0}, cases::unit(model.d, k));
    } else {
        scene.hold(bottom, along(model, 1));
    }
    const auto load = scene.pattern("load", {0.0, 1.0, 2.0, 4.0}, {0.0, -0.01, 0.0, model.pull ? 0.06 : -0.02});
    // The far corners are pulled further: the crack opens from outside.
    std::vector<double> part;
    for (const std::int64_t n : top) {
        double x = 0.0;
        for (int k = 0; k < model.d; ++k) x += first[static_cast<std::size_t>(k)] * scene.coordinate(n, k);
        part.push_back(1.0 + 0.25 * x * x);
    }
    scene.drive(top, along(model, 1), load, part);
    scene.text("reduction", model.reduction);
    scene.number("damage_tolerance", 1e-11);
    if (std::string(model.reduction) == "iterated") scene.number("linear_tolerance", 1e-13);
    Solver solver(scene, 0.0);
    std::vector<double> values;
    for (int step = 1; step <= 16; ++step) {
        solver.step(0.25 * step);
        solver.commit();
        for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "work"})
            values.push_back((model.whole ? 0.5 : 1.0) * solver.value(key));
    }
    return values;
}

void expect_alike(const Model& one, const Model& other, const std::string& what) {
    const std::vector<double> a = values_of(one), b = values_of(other);
    cases::expect(a[a.size() - 2] > 0.0 || !one.pull, what + ": something is damaged");
    double scale[4] = {};
    for (std::size_t i = 0; i < a.size(); ++i) scale[i % 4] = std::max(scale[i % 4], std::abs(a[i]));
    for (std::size_t i = 0; i < a.size(); ++i) {
        cases::expect_near(b[i], a[i], 1e-8, scale[i % 4], what + ", value " + std::to_string(i));
    }
}

TEST(half_of_it) {
    for (const int d : {2, 3})
        for (const char* reduction : {"condensed", "iterated", "feti"}) {
            const std::string name = std::string(reduction) + ", " + std::to_string(d) + "D";
            const Model half{.d = d, .reduction = reduction};
            expect_alike(half, {.d = d, .reduction = reduction, .whole = true}, name + ", whole");
            expect_alike(half, {.d = d, .reduction = reduction, .angle = 0.5}, name + ", skew");
            expect_alike({.d = d, .reduction = reduction, .pull = false},
                         {.d = d, .reduction = reduction, .angle = 0.3, .obstacle = true, .pull = false},
                         name + ", obstacle");
        }
}

}  // namespace
