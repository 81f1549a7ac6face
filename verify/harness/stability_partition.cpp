// SPDX-License-Identifier: BSD-3-Clause
// Stability against the number of pairs and subdomains and against bad cuts: one pair to 1e5, subdomains from short to
// slender, 1 to 512 of them, bodies shaped like combs pushed into each other.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

constexpr double modulus = 70e9;

// Two rows of cells under uniform tension; no Poisson effect.
Scene strip(std::int64_t cells, double k, double pull) {
    const double h = 1e-3, length = h * static_cast<double>(cells);
    Scene scene(2, {length}, {cells}, {h, h}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(-1, modulus, 0.0);
    scene.law(0, {k, k, 1e30, 1e30, 1e30, 1e30});
    const auto bottom = scene.find(0, {0.0, 0.0}, {length, 0.0}), top = scene.find(1, {0.0, 2 * h}, {length, 2 * h});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, pull});
    scene.drive(top, {0.0, 1.0}, load, std::vector<double>(top.size(), 1.0));
    return scene;
}

// A single pair, between the corners of two triangles: each is a spring of two sides.
Scene one_pair(double pull) {
    const std::vector<double> nodes{-1e-3, -1e-3, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 1e-3, 1e-3, -1e-3, 1e-3};
    Scene scene(2, nodes, DELAM_TRI3, {0, 1, 2, 3, 4, 5}, {0, 1});
    const std::int64_t a = 2, b = 3;
    const double normal[2] = {0.0, 1.0}, weight = 1e-3;
    std::int64_t index = -1;
    REQUIRE(scene, delam_mesh_add_pairs, scene.mesh(), 0, 1, 1, &a, &b, normal, &weight, 0, 2, nullptr, 0, &index);
    begin_standard(scene);
    scene.elastic(-1, modulus, 0.0);
    scene.law(0, intact);
    scene.hold({0, 1}, {1.0, 0.0});
    scene.hold({0, 1}, {0.0, 1.0});
    scene.hold({4, 5}, {1.0, 0.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, pull});
    scene.drive({4, 5}, {0.0, 1.0}, load, {1.0, 1.0});
    return scene;
}

constexpr double pull = 1e-6, spring = 1e14;

// Tractions, jumps and the force of a strip under uniform tension.
double strip_error(const Result& r, std::int64_t cells) {
    constexpr double h = 1e-3, traction = pull / (2.0 * h / modulus + 1.0 / spring);
    double worst = std::abs(r.pattern[0] / (traction * h * static_cast<double>(cells)) - 1.0);
    for (std::size_t i = 0; i < r.traction.size(); i += 2)
        worst = std::max({worst, std::abs(r.traction[i] / traction - 1.0), std::abs(r.traction[i + 1] / traction),
                          std::abs(r.jump[i] * spring / traction - 1.0)});
    return worst;
}

std::string format(const char* text, double a, double b, double c) {
    char line[200];
    std::snprintf(line, sizeof line, text, a, b, c);
    return line;
}

// Predicted cost of the dense matrices of the condensed operator: src/reduction/NOTES.md.
std::string dense_cost(double pairs) {
    const double m = 2.0 * pairs, operations = (2.0 / 3.0 + 0.7 + 0.2) * m * m * m;
    return format(
        "expected: %.3g GB for four dense matrices of two rows a pair, %.2g operations, %.2g minutes at "
        "20 GF/s",
        4.0 * 8.0 * m * m * 1e-9, operations, operations / 20e9 / 60.0);
}

// Number of cells in a subdomain of FETI; longer subdomains lose digits, see pieces().
constexpr std::int64_t piece = 20;

void pairs(Study& study) {
    if (!study.wanted("pairs")) return;
    for (const double count : study.range({1, 2, 11, 101, 1001, 10001, 30001, 100001}, 3)) {
        if (study.options().quick && count > 200) continue;
        const auto cells = std::lround(count) - 1;
        Trial t = trial_of("pairs", "pairs", count);
        t.scene = [=] { return cells == 0 ? one_pair(pull) : strip(cells, spring, pull); };
        t.subdomains = static_cast<int>(std::max<long>(2, 2 * cells / piece));
        if (cells > 0) {
            t.reference = "closed form (uniform tension)";
            t.error = [=](const Result& r) { return strip_error(r, cells); };
        }
        if (count > 5e4) {
            Trial refused = t;
            refused.feti = refused.direct = false;
            refused.refused = "allowed: up to 46340; iterated and feti have no such limit";
            study.run(refused);
        } else if (count > 2e3) {
            study.leave_out(t, "condensed", dense_cost(count));
        }
        if (count > 2e4) {
            study.leave_out(t, "FETI",
                            count > 5e4 ? "takes long: once it was right to 4e-13 after 537 Krylov iterations, in nine "
                                          "minutes and 6.3 GB"
                                        : "takes long: once it was right to 5e-13 after 459 Krylov iterations, in "
                                          "minutes and 2.1 GB");
            t.feti = false;
        }
        t.condensed = count < 2e3;
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// One strip in ever longer subdomains. A floating subdomain bends. FETI takes differences of a compliance that grows
// with (length / thickness)^3; rounding spoils them, until residuals no longer reach the tolerance.
void pieces(Study& study) {
    if (!study.wanted("pairs-pieces")) return;
    constexpr std::int64_t cells = 400;
    for (const double length : study.range({5, 10, 20, 50, 100, 200, 400}, 3)) {
        if (study.options().quick && length > 50) continue;
        Trial t = trial_of("pairs-pieces", "cells of a piece", length);
        t.scene = [=] { return strip(cells, spring, pull); };
        t.subdomains = static_cast<int>(std::lround(2.0 * cells / length));
        t.reference = "closed form (uniform tension)";
        t.error = [=](const Result& r) { return strip_error(r, cells); };
        t.condensed = false;
        t.left_out = "the strip is the same however FETI cuts it: see 401 pairs";
        t.feti_may_say = length > static_cast<double>(piece);
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

void subdomains(Study& study) {
    // 1: at least one for each connected part, so two.
    const std::vector<double> counts{1, 2, 4, 8, 16, 32, 64, 128, 256, 512};
    for (const char* preconditioner : {"series", "dirichlet", "lumped"}) {
        const std::string subject = std::string("subdomains-") + preconditioner;
        if (!study.wanted(subject)) continue;
        for (const double count : study.range(counts, 4)) {
            // With --quick the largest number with the default preconditioner alone.
            if (study.options().quick && count == (subject == "subdomains-series" ? 256 : 512)) continue;
            Cantilever c;
            c.columns = 160, c.rows = 4, c.notch = 48;
            c.law = intact;
            c.lift = 1e-5;
            Trial t = trial_of(subject, "subdomains", count);
            t.subdomains = static_cast<int>(count);
            t.scene = [=] {
                Scene scene = make_cantilever(c);
                scene.text("preconditioner", preconditioner);
                scene.number("linear_limit", 5000);
                return scene;
            };
            t.condensed = t.subject == "subdomains-series";
            t.left_out = "the preconditioner is FETI's own, and the scene that of the default one";
            t.limit = 1e-9;
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
    if (!study.wanted("subdomains-1")) return;
    // One body on a rigid obstacle, in one subdomain.
    for (const double count : study.range({1, 2, 4, 8}, 3)) {
        Trial t = trial_of("subdomains-1", "subdomains", count);
        t.subdomains = static_cast<int>(count);
        t.scene = [] {
            const Scene plain(2, {0.04}, {20}, {4e-3}, {4}, DELAM_QUAD4);
            std::vector<double> nodes = plain.nodes();
            const auto control = static_cast<std::int64_t>(nodes.size() / 2);
            nodes.insert(nodes.end(), {0.0, -1.0});
            std::vector<std::int64_t> cells;
            for (std::int64_t j = 0; j < 4; ++j)
                for (std::int64_t i = 0; i < 20; ++i) {
                    const std::int64_t a = j * 21 + i;
                    cells.insert(cells.end(), {a, a + 1, a + 22, a + 21});
                }
            Scene scene(2, nodes, DELAM_QUAD4, cells, std::vector<std::int32_t>(80, 0));
            std::vector<std::int64_t> below;
            std::vector<double> normals;
            for (std::int64_t i = 0; i < 21; ++i) below.push_back(i), normals.insert(normals.end(), {0.0, 1.0});
            scene.obstacle(below, normals, control);
            begin_standard(scene);
            scene.elastic(0, modulus, 0.3);
            scene.contact(0);
            scene.hold({control}, {1.0, 0.0});
            scene.hold({control}, {0.0, 1.0});
            scene.hold(scene.find(0, {0.0, 4e-3}, {0.0, 4e-3}), {1.0, 0.0});
            const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, 1e-6});
            const auto top = scene.find(0, {0.008, 4e-3}, {0.02, 4e-3});
            scene.drive(top, {0.0, -1.0}, load, std::vector<double>(top.size(), 1.0));
            return scene;
        };
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// Two bodies shaped like combs whose teeth, one cell wide, fill each other's gaps: bonded, or on springs. A cut along
// them is all surface.
Scene combs(std::int64_t teeth, bool bonded) {
    const std::int64_t columns = 2 * teeth, rows = 16;
    const double h = 1e-3;
    std::vector<double> nodes;
    for (std::int64_t j = 0; j <= rows; ++j)
        for (std::int64_t i = 0; i <= columns; ++i)
            nodes.insert(nodes.end(), {h * static_cast<double>(i), h * static_cast<double>(j)});
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) {
            const std::int64_t a = j * (columns + 1) + i, up = a + columns + 1;
            cells.insert(cells.end(), {a, a + 1, up + 1, up});
            bodies.push_back(j < 2 ? 0 : j >= rows - 2 ? 1 : static_cast<std::int32_t>(i % 2));
        }
    Scene scene = Scene::conforming(2, nodes, DELAM_QUAD4, cells, bodies);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(-1, modulus, 0.3);
    if (bonded)
        scene.bonded(0);
    else
        scene.law(0, intact);
    const double width = h * static_cast<double>(columns), height = h * static_cast<double>(rows);
    const auto bottom = scene.find(0, {0.0, 0.0}, {width, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, 1e-6});
    const auto top = scene.find(1, {0.0, height}, {width, height});
    scene.drive(top, {1.0, 1.0}, load, std::vector<double>(top.size(), 1.0));
    return scene;
}

void poor_cuts(Study& study) {
    for (const bool bonded : {true, false}) {
        const std::string subject = bonded ? "combs-glued" : "combs-on-springs";
        if (!study.wanted(subject)) continue;
        for (const double teeth : study.range({1, 2, 4, 8, 16, 32}, 3)) {
            if (study.options().quick && teeth > 8) continue;
            Trial t = trial_of(subject, "teeth", teeth);
            t.subdomains = 2;
            t.scene = [=] { return combs(std::lround(teeth), bonded); };
            t.acceptance_limit = 5e-9;
            t.feti_may_say = teeth > 16;  // the teeth of a subdomain bend: the more teeth, the fewer digits
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
    if (!study.wanted("combs-cut")) return;
    for (const double count : study.range({2, 8, 32, 128, 256, 512}, 5)) {
        Trial t = trial_of("combs-cut", "subdomains", count);
        t.subdomains = static_cast<int>(count);
        t.scene = [] { return combs(16, true); };
        t.condensed = count < 4;
        t.left_out = "nothing of it depends on FETI's subdomains: see 2";
        t.acceptance_limit = 5e-9;
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

}  // namespace

void stability_partition(Study& study) {
    pairs(study);
    pieces(study);
    subdomains(study);
    poor_cuts(study);
}

}  // namespace harness
