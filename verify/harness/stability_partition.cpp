// SPDX-License-Identifier: BSD-3-Clause
// Stability against how many pairs, subdomains and how badly cut: one pair to 1e5 of them, 1 to 512 subdomains, bodies
// that are combs pushed into each other.
#include <algorithm>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

constexpr double young = 70e9;
constexpr LawData intact{1e14, 1e14, 1e30, 1e30, 1e30, 1e30};

// Two rows of cells under uniform tension; no Poisson's effect.
Scene strip(std::int64_t cells, double k, double pull) {
    const double h = 1e-3, length = h * static_cast<double>(cells);
    Scene scene(2, {length}, {cells}, {h, h}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, {k, k, 1e30, 1e30, 1e30, 1e30});
    const auto bottom = scene.find(0, {0.0, 0.0}, {length, 0.0}), top = scene.find(1, {0.0, 2 * h}, {length, 2 * h});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, pull});
    scene.drive(top, {0.0, 1.0}, load, std::vector<double>(top.size(), 1.0));
    return scene;
}

// One pair alone, of the corners of two triangles: each is a spring of two sides.
Scene one_pair(double pull) {
    const std::vector<double> nodes{-1e-3, -1e-3, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 1e-3, 1e-3, -1e-3, 1e-3};
    Scene scene(2, nodes, DELAM_TRI3, {0, 1, 2, 3, 4, 5}, {0, 1});
    const std::int64_t a = 2, b = 3;
    const double normal[2] = {0.0, 1.0}, weight = 1e-3;
    std::int64_t index = -1;
    scene.require(delam_mesh_add_pairs(scene.mesh(), 0, 1, 1, &a, &b, normal, &weight, 0, 2, nullptr, 0, &index),
                  "delam_mesh_add_pairs");
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, intact);
    scene.hold({0, 1}, {1.0, 0.0});
    scene.hold({0, 1}, {0.0, 1.0});
    scene.hold({4, 5}, {1.0, 0.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, pull});
    scene.drive({4, 5}, {0.0, 1.0}, load, {1.0, 1.0});
    return scene;
}

void pairs(Study& study) {
    if (!study.wanted("pairs")) return;
    constexpr double pull = 1e-6, h = 1e-3, k = 1e14;
    for (const double count : study.range({1, 2, 11, 101, 1001, 10001, 100001}, 3)) {
        if (study.options().quick && count > 200) continue;
        const auto cells = std::lround(count) - 1;
        Trial t;
        t.subject = "pairs";
        t.parameter_name = "pairs";
        t.parameter = count;
        t.scene = [=] { return cells == 0 ? one_pair(pull) : strip(cells, k, pull); };
        t.subdomains = cells == 0 ? 2 : static_cast<int>(std::clamp<long>(cells / 50, 2, 2000));
        if (cells > 0) {
            t.reference = "closed form (uniform tension)";
            const double traction = pull / (2.0 * h / young + 1.0 / k);
            t.error = [=](const Result& r) {
                double worst = std::abs(r.pattern[0] / (traction * h * static_cast<double>(cells)) - 1.0);
                for (std::size_t i = 0; i < r.traction.size(); i += 2)
                    worst = std::max({worst, std::abs(r.traction[i] / traction - 1.0),
                                      std::abs(r.traction[i + 1] / traction),
                                      std::abs(r.jump[i] * k / traction - 1.0)});
                return worst;
            };
        }
        // Strips one cell thick are hard for FETI: 100 pairs take 140 iterations, 1001 take 600, and rounding ends them.
        t.may_say = count > 20;
        if (count > 2e3) {
            t.condensed = t.feti = t.direct = false;
            t.left_out = "dense: 3 GB at 1e4 pairs, no LAPACK beyond 23170; FETI: iterations grow with the length of a strip "
                         "one cell thick, minutes";
        }
        t.defect_limit = 1e-8;
        study.run(t);
    }
}

void subdomains(Study& study) {
    const std::vector<double> counts{2, 4, 8, 16, 32, 64, 128, 256, 512};
    for (const char* preconditioner : {"series", "dirichlet", "lumped"}) {
        const std::string subject = std::string("subdomains-") + preconditioner;
        if (!study.wanted(subject)) continue;
        for (const double count : study.range(counts, 4)) {
            Cantilever c;
            c.columns = 160, c.rows = 4, c.notch = 48;
            c.law = intact;
            c.lift = 1e-5;
            Trial t;
            t.subject = subject;
            t.parameter_name = "subdomains";
            t.parameter = count;
            t.subdomains = static_cast<int>(count);
            t.scene = [=] {
                Scene scene = make_cantilever(c);
                scene.text("preconditioner", preconditioner);
                scene.number("linear_limit", 5000);
                return scene;
            };
            // The simpler ones are not made for springs; they may stop short, and say so.
            t.may_say = preconditioner != std::string("series");
            t.condensed = t.subject == "subdomains-series";
            t.defect_limit = 1e-8;
            study.run(t);
        }
    }
    if (!study.wanted("subdomains-1")) return;
    // One body on a rigid obstacle, uncut.
    for (const double count : study.range({1, 2, 4, 8}, 3)) {
        Trial t;
        t.subject = "subdomains-1";
        t.parameter_name = "subdomains";
        t.parameter = count;
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
            scene.begin();
            scene.elastic(0, young, 0.3);
            scene.contact(0);
            scene.hold({control}, {1.0, 0.0});
            scene.hold({control}, {0.0, 1.0});
            scene.hold(scene.find(0, {0.0, 4e-3}, {0.0, 4e-3}), {1.0, 0.0});
            const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, 1e-6});
            const auto top = scene.find(0, {0.008, 4e-3}, {0.02, 4e-3});
            scene.drive(top, {0.0, -1.0}, load, std::vector<double>(top.size(), 1.0));
            return scene;
        };
        t.defect_limit = 1e-8;
        study.run(t);
    }
}

// Two bodies as combs whose teeth, one cell wide, fill each other's gaps: glued, or on springs. A cut along them has
// nothing but surface.
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
    scene.begin();
    scene.elastic(-1, young, 0.3);
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
            Trial t;
            t.subject = subject;
            t.parameter_name = "teeth";
            t.parameter = teeth;
            t.subdomains = 2;
            t.scene = [=] { return combs(std::lround(teeth), bonded); };
            t.may_say = true;
            t.defect_limit = 1e-8;
            study.run(t);
        }
    }
    if (!study.wanted("combs-cut")) return;
    for (const double count : study.range({2, 8, 32, 128, 256}, 2)) {
        Trial t;
        t.subject = "combs-cut";
        t.parameter_name = "subdomains";
        t.parameter = count;
        t.subdomains = static_cast<int>(count);
        t.scene = [] { return combs(16, true); };
        t.condensed = false;
        t.defect_limit = 1e-8;
        study.run(t);
    }
}

}  // namespace

void stability_partition(Study& study) {
    pairs(study);
    subdomains(study);
    poor_cuts(study);
}

}  // namespace harness
