// SPDX-License-Identifier: BSD-3-Clause
// Stability against the bodies: contrast of moduli, Poisson's ratio near 1/2, aspect ratio of cells, slenderness of
// plies, bodies that the host provides as matrices.
#include <algorithm>
#include <cmath>
#include <utility>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

// The same with lengths in other units; stresses keep their values.
LawData in_units(double unit) { return {1e14 / unit, 1e14 / unit, 1e30, 1e30, 1e30, 1e30}; }

std::vector<double> powers(int first, int last, int step) {
    std::vector<double> all;
    for (int e = first; e <= last; e += step) all.push_back(std::pow(10.0, e));
    return all;
}

void contrast(Study& study) {
    for (const int dimension : {2, 3}) {
        const std::string subject = dimension == 2 ? "contrast" : "contrast-3d";
        if (!study.wanted(subject)) continue;
        for (const double ratio : study.range(powers(-8, 8, dimension == 2 ? 1 : 4), dimension == 2 ? 4 : 2)) {
            Cantilever c;
            c.dimension = dimension;
            if (dimension == 3) c.columns = 16, c.notch = 5;
            c.law = intact;
            c.lift = 1e-5;
            // The stiffer arm has 70 GPa.
            c.young_upper *= std::min(1.0, ratio);
            c.young_lower *= std::min(1.0, 1.0 / ratio);
            Trial t = trial_of(subject, "E upper / E lower", ratio);
            t.scene = [=] { return make_cantilever(c); };
            t.limit = t.acceptance_limit = 1e-8;  // 1e-16 of the stiffer arm is 1e-8 of the softer one
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
}

// A quarter of a ring whose inner and outer halves are bonded, with the inner face pushed outwards: the energy in
// closed form (lambda + mu and mu of plane strain), with u = A r + B / r.
constexpr double inner = 1.0, outer = 2.0, push = 1e-3;

double ring_energy(double young, double nu) {
    const double mu = young / (2.0 * (1.0 + nu)), lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    // sigma_rr(outer) = 0: 2 (lambda + mu) A = 2 mu B / outer^2; u(inner) = push.
    const double ratio = mu / ((lambda + mu) * outer * outer);  // A / B
    const double b = push / (ratio * inner + 1.0 / inner), a = ratio * b;
    const double pressure = -(2.0 * (lambda + mu) * a - 2.0 * mu * b / (inner * inner));
    return 0.5 * pressure * push * inner * 0.5 * std::acos(-1.0);
}

Scene make_ring(std::int32_t cell, std::int64_t corners, const std::string& formulation, double young, double nu) {
    const double quarter = 0.5 * std::acos(-1.0);
    const Scene plain(2, {quarter}, {24}, {0.5, 0.5}, {6, 6}, cell);
    std::int64_t needed = 0, count = 0;
    REQUIRE(plain, delam_mesh_size, plain.mesh(), nullptr, nullptr, &count, nullptr, nullptr);
    const auto n = static_cast<std::size_t>(count);
    std::vector<std::int64_t> offsets(n + 1), cells(n * static_cast<std::size_t>(corners));
    std::vector<std::int32_t> types(n), bodies(n);
    REQUIRE(plain, delam_mesh_cells, plain.mesh(), types.data(), bodies.data(), offsets.data(),
            static_cast<std::int64_t>(cells.size()), cells.data(), &needed);
    std::vector<double> nodes = plain.nodes();
    for (std::size_t i = 0; i < nodes.size(); i += 2) {
        const double angle = nodes[i], r = inner + nodes[i + 1];
        nodes[i] = r * std::sin(angle);
        nodes[i + 1] = r * std::cos(angle);
    }
    Scene scene(2, nodes, cell, cells, bodies);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(-1, young, nu);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, formulation.c_str());
    scene.bonded(0);
    const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, push});
    for (std::size_t i = 0; i < nodes.size(); i += 2) {
        const auto node = static_cast<std::int64_t>(i / 2);
        const bool on_x = std::abs(nodes[i]) < 1e-12, on_y = std::abs(nodes[i + 1]) < 1e-12;
        if (std::abs(std::hypot(nodes[i], nodes[i + 1]) - inner) < 1e-9)
            scene.drive({node}, {on_x ? 0.0 : nodes[i], on_y ? 0.0 : nodes[i + 1]}, load, {1.0});
        if (on_x) scene.hold({node}, {1.0, 0.0});
        if (on_y) scene.hold({node}, {0.0, 1.0});
    }
    return scene;
}

void poisson(Study& study) {
    const std::vector<double> ratios{0.0, 0.3, 0.4, 0.45, 0.49, 0.495, 0.499, 0.4995, 0.4999};
    for (const char* formulation : {"standard", "mean-dilatation"}) {
        const std::string subject = std::string("poisson-") + formulation;
        if (!study.wanted(subject)) continue;
        for (const double nu : study.range(ratios, 4)) {
            Cantilever c;
            c.law = intact;
            c.lift = 1e-5;
            c.poisson = nu;
            c.formulation = formulation;
            Trial t = trial_of(subject, "Poisson's ratio", nu);
            t.scene = [=] { return make_cantilever(c); };
            // The condition number of the bodies grows with 1 / (1 - 2 nu).
            t.limit = 3e-9 + 2e-11 / (1.0 - 2.0 * nu);
            t.acceptance_limit = 1e-8;
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
    const struct {
        const char* subject;
        std::int32_t cell;
        std::int64_t corners;
        const char* formulation;
    } rings[] = {{"ring-quad8-standard", DELAM_QUAD8, 8, "standard"},
                 {"ring-quad4-mean-dilatation", DELAM_QUAD4, 4, "mean-dilatation"},
                 {"ring-quad8-mean-dilatation", DELAM_QUAD8, 8, "mean-dilatation"}};
    for (const auto& ring : rings) {
        if (!study.wanted(ring.subject)) continue;
        for (const double nu : study.range(ratios, 4)) {
            constexpr double young = 1e9;
            const double exact = ring_energy(young, nu);
            Trial t = trial_of(ring.subject, "Poisson's ratio", nu);
            t.scene = [=] { return make_ring(ring.cell, ring.corners, ring.formulation, young, nu); };
            t.reference = "closed form (Lame), energy";
            t.error = [=](const Result& r) { return std::abs(r.stored_bulk / exact - 1.0); };
            // Straight edges give an error of a tenth of the squared angle of a cell, 0.065; parabolic ones 3e-7, which
            // nearly incompressible material multiplies without mean dilatation.
            const bool locks = ring.formulation == std::string("standard");
            t.limit = ring.cell == DELAM_QUAD4 ? 4e-4 : locks ? 1e-6 / (1.0 - 2.0 * nu) : 1e-6;
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
}

// Thin layers, one cell each, beside the interface of a cantilever that is not slender itself: cells `ratio` times
// longer than thick, bonded to thick arms.
Scene make_graded(int dimension, double ratio, double unit) {
    const bool plane = dimension == 2;
    const double length = 0.04 * unit, arm = 4e-3 * unit, width = 0.01 * unit;
    const std::int64_t columns = plane ? 40 : 16, notch = plane ? 12 : 5, rows = plane ? 4 : 2;
    const double thin = length / static_cast<double>(columns) / ratio, top = 2.0 * (arm + thin);
    Scene scene(dimension, plane ? std::vector<double>{length} : std::vector<double>{length, width},
                plane ? std::vector<std::int64_t>{columns} : std::vector<std::int64_t>{columns, 3},
                {arm, thin, thin, arm}, {rows, 1, 1, rows}, plane ? DELAM_QUAD4 : DELAM_HEX8);
    for (std::int32_t b = 0; b < 3; ++b) scene.interface(b, b + 1);
    begin_standard(scene);
    scene.elastic(-1, 70e9, 0.3);
    scene.bonded(0);
    scene.law(1, in_units(unit));
    scene.bonded(2);
    std::vector<std::int64_t> open;
    const auto a = scene.pairs(1).node_a;
    const double edge = (static_cast<double>(notch) - 0.25) * length / static_cast<double>(columns);
    for (std::size_t i = 0; i < a.size(); ++i)
        if (scene.coordinate(a[i], 0) < edge) open.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(1, open, std::vector<double>(open.size(), 0.0));
    const auto at = [&](double x, double y, double z) {
        return plane ? std::vector<double>{x, z} : std::vector<double>{x, y, z};
    };
    const auto right = scene.find(-1, at(length, 0, 0), at(length, width, top));
    for (int k = 0; k < dimension; ++k) {
        std::vector<double> axis(static_cast<std::size_t>(dimension), 0.0);
        axis[static_cast<std::size_t>(k)] = 1.0;
        scene.hold(right, axis);
    }
    std::vector<double> up(static_cast<std::size_t>(dimension), 0.0);
    up.back() = 1.0;
    const auto load = scene.pattern("lift", {0.0, 1.0}, {0.0, 1e-5 * unit});
    const auto corner = scene.find(3, at(0, 0, top), at(0, width, top));
    scene.drive(corner, up, load, std::vector<double>(corner.size(), 1.0));
    return scene;
}

// The condition number of a flat cell's matrix grows with its ratio, and the rounding error with it: 1e-12 times the
// ratio was measured.
double flat_limit(double ratio) { return std::max(1e-9, 1e-11 * ratio); }

void aspect(Study& study) {
    const std::vector<double> ratios{1, 3, 10, 30, 100, 300, 1e3, 3e3, 1e4};
    for (const bool tall : {false, true}) {
        const std::string subject = tall ? "aspect-tall" : "aspect-flat";
        if (!study.wanted(subject)) continue;
        for (const double ratio : study.range(ratios, tall ? 4 : 8)) {
            Trial t = trial_of(subject, "aspect ratio of cells", ratio);
            t.in_unit = [=](double unit) {
                if (!tall) return make_graded(2, ratio, unit);
                Cantilever c;
                c.length *= unit;
                c.arm = 2e-3 * ratio * unit;  // 1 mm wide, `ratio` mm high
                c.law = in_units(unit);
                c.lift = 1e-5 * unit;
                return make_cantilever(c);
            };
            t.scene = [in_unit = t.in_unit] { return in_unit(1.0); };
            t.limit = flat_limit(ratio);
            t.acceptance_limit = 1e-8;
            t.feti_may_say = tall && ratio > 3e3;  // four subdomains of cells 1e4 times higher than wide
            t.defect_limit = closed_balance;
            if (!tall) t.subdomains = 400;  // one cell per subdomain
            study.run(t);
        }
    }
    // The thin layers as whole subdomains of FETI: 40 cells times the ratio longer than thick.
    if (study.wanted("aspect-flat-whole"))
        for (const double ratio : study.range(ratios, 4)) {
            Trial t = trial_of("aspect-flat-whole", "aspect ratio of cells", ratio);
            t.in_unit = [=](double unit) { return make_graded(2, ratio, unit); };
            t.scene = [in_unit = t.in_unit] { return in_unit(1.0); };
            t.condensed = false;
            t.left_out = "as in the flat, plane scene, from which this one differs by the pieces of FETI alone";
            t.limit = flat_limit(ratio);
            t.acceptance_limit = 1e-8;
            t.feti_may_say = ratio > 3.0;  // subdomains more than 120 times longer than thick
            t.defect_limit = closed_balance;
            study.run(t);
        }
    if (study.wanted("aspect-3d"))
        for (const double ratio : study.range({1, 10, 100, 1e3, 1e4}, 2)) {
            Trial t = trial_of("aspect-3d", "aspect ratio of cells", ratio);
            t.in_unit = [=](double unit) { return make_graded(3, ratio, unit); };
            t.scene = [in_unit = t.in_unit] { return in_unit(1.0); };
            t.limit = flat_limit(ratio);
            t.acceptance_limit = 1e-8;
            t.feti_may_say = ratio > 10.0;  // whole layers, more than 160 times longer than thick
            t.defect_limit = closed_balance;
            study.run(t);
        }
    if (!study.wanted("slender-3d")) return;
    for (const double ratio : study.range({1, 10, 100, 1e3}, 3)) {
        Trial t = trial_of("slender-3d", "length / thickness", 8.0 * ratio);
        t.in_unit = [=](double unit) {
            Cantilever c;
            c.dimension = 3;
            c.columns = 16, c.notch = 5, c.ranks = 2;
            c.length *= unit;
            c.width *= unit;
            c.arm = 2.0 * c.length / 16.0 / ratio;
            c.law = in_units(unit);
            c.lift = 1e-3 * c.arm;
            return make_cantilever(c);
        };
        t.scene = [in_unit = t.in_unit] { return in_unit(1.0); };
        t.limit = 1e-9;
        t.acceptance_limit = 1e-8;
        t.feti_may_say = ratio > 10.0;  // arms more than 80 times longer than thick
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// EI times the compliance of both arms as beams on springs that resist only opening, with crack a and root length
// 1/lam. Each arm's deflection grows from the point where the arms touch as cosh s sin s - sinh s cos s, where s is lam
// times the distance from that point; deflection, slope and moment are zero there. The tip, where moment over shear is
// a, lies at s0.
double beams_on_springs(double a, double lam) {
    double s0 = 2.0;
    for (int i = 0; i < 60; ++i) s0 = std::acos(-1.0) - std::atan(2.0 * a * lam + std::tanh(s0));
    const double ch = std::cosh(s0), sh = std::sinh(s0), c = std::cos(s0), s = std::sin(s0);
    const double size = -0.25 / (lam * lam * lam * ch * c);
    return 2.0 * (size * (ch * s - sh * c) + 2.0 * size * lam * sh * s * a + a * a * a / 3.0);
}

// A double cantilever beam, opened. Arms 10 to 1000 times longer than thick; no Poisson effect.
void slender(Study& study) {
    if (!study.wanted("slender")) return;
    constexpr double span = 1.0, young = 70e9;
    constexpr std::int64_t columns = 120;
    for (const double ratio : study.range({10, 30, 100, 300, 1e3}, 2)) {
        if (study.options().quick && ratio > 100) continue;
        const double inertia = std::pow(span / ratio, 3) / 12.0;
        const double lam = 20.0 / span, crack = 0.5 * span, opening = 1e-3 * span;
        const double k = 2.0 * young * inertia * std::pow(lam, 4);
        const double compliance = beams_on_springs(crack, lam) / (young * inertia);
        Trial t = trial_of("slender", "length / thickness", ratio);
        t.in_unit = [=](double unit) {
            const double length = span * unit, thickness = length / ratio;
            Scene scene(2, {length}, {columns}, {thickness, thickness}, {1, 1}, DELAM_QUAD8);
            scene.interface(0, 1);
            begin_standard(scene);
            scene.elastic(-1, young, 0.0);
            scene.law(0, {k / unit, k / unit, 1e30, 1e30, 1e30, 1e30});
            const auto pairs = scene.pairs(0).node_a;
            // Half of the weight of the tip's pair lies behind the tip.
            std::vector<std::int64_t> notch;
            std::vector<double> adhesion;
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                const double ahead = scene.coordinate(pairs[i], 0) / unit - crack;
                if (ahead > 1e-6) continue;
                notch.push_back(static_cast<std::int64_t>(i));
                adhesion.push_back(ahead < -1e-6 ? 0.0 : 0.5);
            }
            scene.adhesion(0, notch, adhesion);
            const auto right = scene.find(-1, {length, 0.0}, {length, 2.0 * thickness});
            scene.hold(right, {1.0, 0.0});
            scene.hold(right, {0.0, 1.0});
            const auto load = scene.pattern("open", {0.0, 1.0}, {0.0, opening * unit});
            scene.drive(scene.find(1, {0.0, 2.0 * thickness}, {0.0, 2.0 * thickness}), {0.0, 1.0}, load, {0.5});
            scene.drive(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, -1.0}, load, {0.5});
            return scene;
        };
        t.scene = [in_unit = t.in_unit] { return in_unit(1.0); };
        const auto in_unit = std::exchange(t.in_unit, nullptr);
        t.reference = "closed form (beams on springs)";
        t.error = [=](const Result& r) { return std::abs(r.pattern[0] * compliance / opening - 1.0); };
        // Spacing of the pairs over the root length; shear and thickness of the arms.
        t.limit = 1e-3 + 15.0 / (ratio * ratio);
        t.may_say = ratio > 300.0;
        // Rounding of the bending forces.
        t.acceptance_limit = std::max(1e-8, 2e-16 * std::pow(ratio, 4));
        Trial direct = t;
        direct.subject = "slender-direct";
        direct.reference = "direct solver";
        direct.error = nullptr;
        direct.in_unit = in_unit;
        // Penetrations of 1e-11 of the largest jump count as rounding: where the arms just touch, that is 1e-7 of the
        // largest traction.
        direct.limit = 5e-7;
        direct.acceptance_limit = 1e-8;
        study.run(t, &direct);
    }
}

// The upper arm as a matrix that the library assembled and the host provides, against the arm made of cells.
void host_stiffness(Study& study) {
    if (!study.wanted("host-stiffness")) return;
    for (const double k : study.range(powers(6, 22, 2), 3)) {
        Cantilever c;
        c.law = {k, k, 1e30, 1e30, 1e30, 1e30};
        c.lift = 1e-5;
        Trial t = trial_of("host-stiffness", "k, N/m3", k);
        t.held = [=] { return make_cantilever(c); };
        t.scene = [=] {
            Scene scene = make_cantilever(c);
            std::int64_t rows = 0, entries = 0;
            const auto matrix = [&](std::int64_t* start, std::int64_t* column, double* value) {
                REQUIRE(scene, delam_problem_body_matrix, scene.problem(), 1, &rows, &entries, start, column, value);
            };
            matrix(nullptr, nullptr, nullptr);
            std::vector<std::int64_t> start(static_cast<std::size_t>(rows) + 1);
            std::vector<std::int64_t> column(static_cast<std::size_t>(entries));
            std::vector<double> value(column.size());
            matrix(start.data(), column.data(), value.data());
            const auto nodes = scene.find(1, {-1.0, -1.0}, {1.0, 1.0});
            REQUIRE(scene, delam_problem_set_stiffness, scene.problem(), static_cast<std::int64_t>(nodes.size()),
                    nodes.data(), nullptr, start.data(), column.data(), value.data(), -1, nullptr, 0);
            return scene;
        };
        t.reference = "direct solver, of cells";
        t.subdomains = 3;
        t.limit = 3e-9;
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

}  // namespace

void stability_bodies(Study& study) {
    contrast(study);
    poisson(study);
    aspect(study);
    slender(study);
    host_stiffness(study);
}

}  // namespace harness
