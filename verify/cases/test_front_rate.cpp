// SPDX-License-Identifier: BSD-3-Clause
// Energy release rate, mode mixity and process zone at crack fronts, against closed forms, energy differences and the
// toughness.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "flexure.hpp"
#include "front_points.hpp"

#include "support.hpp"

using namespace cases;

namespace {

constexpr double young = 75e9, poisson = 0.3, plane_modulus = young / (1.0 - poisson * poisson);

// Two arms opened at the notched end by half of `opening` each, in 2D, or in 3D over the width.
struct Dcb {
    double h = 0.5e-3, notch = 30e-3, opening = 1e-3, length = 90e-3, arm = 3e-3;
    reference::LawData law = reference::ductile_law;
    std::int32_t cell = DELAM_QUAD8;
    double width = 0.0;  // > 0: 3D
    std::int64_t across = 4, through = 2;
    double nu = poisson;
};

reference::Scene make_dcb(const Dcb& d, double notch) {
    const auto along = static_cast<std::int64_t>(std::llround(d.length / d.h));
    const bool space = d.width > 0.0;
    reference::Scene scene(space ? 3 : 2,
                           space ? std::vector<double>{d.length, d.width} : std::vector<double>{d.length},
                           space ? std::vector<std::int64_t>{along, d.across} : std::vector<std::int64_t>{along},
                           {d.arm, d.arm}, {d.through, d.through}, d.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, d.nu);
    scene.law(0, d.law);
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < notch - 0.2 * d.h) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, d.opening});
    const auto at_end = [&](std::int32_t body, double x) {
        const double z = body == 0 ? 0.0 : 2.0 * d.arm;
        return space ? scene.find(body, {x, 0.0, z}, {x, d.width, z}) : scene.find(body, {x, z}, {x, z});
    };
    for (std::int32_t body = 0; body < 2; ++body) {
        const auto nodes = at_end(body, 0.0);
        std::vector<double> up(space ? 3 : 2, 0.0);
        up.back() = body == 0 ? -0.5 : 0.5;
        scene.drive(nodes, up, pull, std::vector<double>(nodes.size(), 0.5));
    }
    for (int axis = 0; axis < scene.dimension(); ++axis) {
        std::vector<double> along_axis(space ? 3 : 2, 0.0);
        along_axis[static_cast<std::size_t>(axis)] = 1.0;
        auto nodes = at_end(0, d.length);
        if (axis == 1 && space) nodes.resize(1);
        scene.hold(nodes, along_axis);
    }
    return scene;
}

FrontPoint only_point(const reference::Solver& solver) {
    const auto fronts = crack_fronts(solver);
    expect(fronts.size() == 1 && fronts[0].points.size() == 1, "one front, " + std::to_string(fronts.size()));
    return fronts[0].points[0];
}

double stored(const reference::Solver& solver) {
    return solver.value("stored_bulk") + solver.value("stored_interface");
}

// DCB on a layer of finite stiffness: C = (2/(3EI)) (a^3 + 3a^2/lam + 3a/lam^2 + 3/(2 lam^3)), P = delta/C, G = P^2/2
// dC/da.
double dcb_rate(double a, double opening, double arm, double stiffness) {
    const double bending = plane_modulus * arm * arm * arm / 12.0, lam = std::pow(stiffness / (2.0 * bending), 0.25);
    const double c =
        2.0 / (3.0 * bending) * (a * a * a + 3 * a * a / lam + 3 * a / (lam * lam) + 1.5 / (lam * lam * lam));
    const double slope = 2.0 / (3.0 * bending) * (3 * a * a + 6 * a / lam + 3 / (lam * lam));
    return 0.5 * opening * opening / (c * c) * slope;
}

}  // namespace

// Below onset: the springs of the interface act on arms of known stiffness. The closed form ignores shear of the arms,
// hence an error of a few percent.
// closed form, a few percent.
TEST(dcb_below_onset) {
    Dcb d;
    d.notch = 50e-3;
    d.opening = 0.1e-3;
    const reference::Scene scene = make_dcb(d, d.notch);
    reference::Solver solver(scene, 0.0);
    solver.step(1.0);
    const FrontPoint point = only_point(solver);
    const double exact = dcb_rate(d.notch, d.opening, d.arm, d.law.normal_stiffness);
    std::printf("DCB below onset: G %.6g, beam on springs %.6g J/m2\n", point.total(), exact);
    expect_near(point.total(), exact, 0.04, exact, "G of the DCB");
    expect_below(point.mixity(), 1e-9, "mixity of the DCB");
    expect_near(point.place[0], d.notch, 1e-12, 1.0, "place of the front");
    expect_near(point.direction[0], 1.0, 1e-12, 1.0, "direction");
    expect_near(point.length, d.notch, 1e-12, 1.0, "length of the crack");
    expect_near(solver.value("crack_length"), d.notch, 1e-12, 1.0, "crack_length");
    expect(point.zone_pairs == 0.0 && point.zone == 0.0, "no process zone below onset");
}

// G = -dU/da at fixed ends: the front moved by a cell. Stiff and soft interfaces, linear and quadratic cells.
LOOP_TEST(energy_differences, 0, 5) {
    struct {
        std::int32_t cell;
        reference::LawData law;
        double h, tolerance;
    } const of[] = {{DELAM_QUAD4, reference::ductile_law, 0.5e-3, 0.01},
                    {DELAM_QUAD8, reference::ductile_law, 0.5e-3, 0.01},
                    {DELAM_QUAD4, reference::brittle_law, 0.5e-3, 0.01},
                    {DELAM_QUAD4, reference::brittle_law, 0.25e-3, 0.01},
                    {DELAM_QUAD8, reference::brittle_law, 1e-3, 0.02}};
    Dcb d;
    d.cell = of[loop].cell, d.law = of[loop].law, d.h = of[loop].h;
    d.through = std::llround(d.arm / d.h);
    d.opening = 1e-6;
    double energy[3], rate[3];
    for (int k = 0; k < 3; ++k) {
        const reference::Scene scene = make_dcb(d, d.notch + (k - 1) * d.h);
        reference::Solver solver(scene, 0.0);
        solver.step(1.0);
        energy[k] = stored(solver);
        rate[k] = only_point(solver).total();
    }
    const double difference = (energy[0] - energy[2]) / (2.0 * d.h);
    std::printf("cell %d, k %.3g, h %g mm: G / difference of energies %.4f\n", d.cell, d.law.normal_stiffness,
                1e3 * d.h, rate[1] / difference);
    expect_near(rate[1], difference, of[loop].tolerance, difference, "G against the energies");
}

// ENF with closed contact behind the tip: mode II, and beam theory's G = 9 P^2 a^2 / (16 E b^2 h^3) for the load of the
// solution.
LOOP_TEST(enf_below_onset_and_growing, 0, 2) {
    reference::Flexure data;
    data.h = loop == 0 ? 0.5e-3 : 1e-3;
    data.element = loop == 0 ? "quad4-incompatible" : "quad8";
    data.patch = 2e-3;
    data.law = {125e12, 125e12, 40.0, 40.0, 250.0, 250.0};
    data.final_load = 1.0e-3;
    data.notch = 0.045;
    const reference::FlexureScene flexure = reference::make_flexure(data);
    reference::Solver solver(flexure.scene, 0.0);
    solver.step(data.time(0.1e-3));
    solver.commit();
    const FrontPoint point = only_point(solver);
    const double load = solver.value("reaction:press"), a = data.notch;
    const double beam = 9.0 * load * load * a * a / (16.0 * plane_modulus * std::pow(data.arm, 3));
    std::printf("ENF %s: G %.6g, beam %.6g J/m2, mode I part %.2e\n", data.element.c_str(), point.total(), beam,
                point.rate[0] / point.total());
    expect_near(point.total(), beam, 0.04, beam, "G of the ENF");
    expect_below(std::abs(point.rate[0]) / point.total(), 1e-3, "mode I in the ENF");
    expect(solver.value("contact_pairs") > 0.0, "contact behind the tip");
}

// A softening front that grows: G is Gc, whatever the law does in between; the process zone moves along.
LOOP_TEST(growth_at_the_toughness, 0, 2) {
    Dcb d;
    d.h = loop == 1 ? 0.5e-3 : 0.25e-3;
    d.cell = loop == 1 ? DELAM_QUAD8 : DELAM_QUAD4;
    d.through = 6;
    d.law = {1e13, 1e13, 15.0, 15.0, 300.0, 300.0};
    d.opening = 4e-3;
    reference::Scene scene = make_dcb(d, d.notch);
    scene.text("reduction", "condensed");
    reference::Solver solver(scene, 0.0);
    double last = 0.0;
    int growing = 0;
    for (int k = 1; k <= 40; ++k) {
        solver.step(k / 40.0);
        solver.commit();
        const FrontPoint point = only_point(solver);
        const double a = solver.value("crack_length");
        expect_near(point.place[0], a, 1e-9, a, "place and crack length");
        expect(a >= last, "a crack does not heal");
        last = a;
        if (a < d.notch + 6e-3) continue;
        ++growing;
        expect_near(point.total(), 300.0, 0.02, 300.0, "G of a growing crack");
        expect(point.zone_pairs >= 3.0, "pairs in the process zone");
        expect_near(point.zone / point.zone_pairs, d.h * (loop == 1 ? 0.5 : 1.0), 0.4, d.h, "spacing");
        if (k == 40)
            std::printf("DCB grown to %.4g mm: G %.5g, zone %.3g mm of %g pairs\n", 1e3 * a, point.total(),
                        1e3 * point.zone, point.zone_pairs);
    }
    expect(growing > 3, "it has grown");
}

// Mixed mode with the mixity of the step's own solution: G at the front is Gc at the mixity of G.
TEST(mixed_mode_growth) {
    reference::Flexure data;
    data.mixed = true;
    data.h = 0.25e-3;
    data.element = "quad4-incompatible";
    data.law = {2e13, 2e13, 10.0, 20.0, 150.0, 300.0, 1.0};
    data.notch = 0.065;
    data.final_load = 6e-3;
    reference::FlexureScene flexure = reference::make_flexure(data);
    flexure.scene.text("reduction", "condensed");
    flexure.scene.text("mixity_rule", "converged");
    reference::Solver solver(flexure.scene, 0.0);
    double seen = 0.0;
    for (int k = 1; k <= 50; ++k) {
        expect(solver.advance(data.end_time * k / 50) >= 0, "step");
        solver.commit();
        const FrontPoint point = only_point(solver);
        if (solver.value("crack_length") < data.notch + 4e-3) continue;
        const double b = point.mixity(), toughness = 1.0 / ((1.0 - b) / 150.0 + b / 300.0);
        if (seen == 0.0)
            std::printf("MMF: B %.4f (beams 3/7 = %.4f), G %.5g, Gc(B) %.5g J/m2\n", b, 3.0 / 7.0, point.total(),
                        toughness);
        expect_near(point.total(), toughness, 0.04, toughness, "G of a growing crack in mixed mode");
        expect_near(b, 3.0 / 7.0, 0.15, 1.0, "mixity");
        seen += 1.0;
    }
    expect(seen > 3.0, "it has grown");
}

namespace {

double mean_rate(const reference::Solver& solver) {
    const auto fronts = crack_fronts(solver);
    expect(fronts.size() == 1 && !fronts[0].closed, "one front from side to side");
    double sum = 0.0, width = 0.0;
    for (const FrontPoint& point : fronts[0].points) {
        sum += point.length * point.total();
        width += point.length;
    }
    return fronts[0].points.size() == 1 ? fronts[0].points[0].total() : sum / width;
}

}  // namespace

// A sharp front in cells as large as an arm is high, on interfaces from soft to all but rigid: G is the geometric mean
// of what the energy falls by if the front advances from a cell behind to its place, and to a cell ahead. With such
// cells a rigid interface presses ahead of the tip, and its contact closes the crack as the tractions do.
LOOP_TEST(quadratic_cells_at_a_sharp_front, 0, 12) {
    const std::int32_t cells[] = {DELAM_QUAD8, DELAM_HEX20, DELAM_TET10, DELAM_WEDGE15};
    const double stiffnesses[] = {1e12, 1e14, 1e17};
    const double k = stiffnesses[loop / 4];
    Dcb d;
    d.h = 2e-3, d.length = 50e-3, d.notch = 20e-3, d.opening = 0.02e-3, d.nu = 0.0;
    d.law = {k, k, 1e6, 1e6, 2e6, 2e6};
    d.cell = cells[loop % 4];
    d.width = loop % 4 > 0 ? 12e-3 : 0.0;
    d.across = 2;
    d.through = 1;
    double energy[3], rate = 0.0;
    for (int at = 0; at < 3; ++at) {
        const reference::Scene scene = make_dcb(d, d.notch + (at - 1) * d.h);
        reference::Solver solver(scene, 0.0);
        solver.step(1.0);
        energy[at] = stored(solver);
        if (at == 1) rate = mean_rate(solver);
    }
    const double swept = d.h * (d.width > 0.0 ? d.width : 1.0);
    const double mean = std::sqrt((energy[0] - energy[1]) * (energy[1] - energy[2])) / swept;
    std::printf("cell %d, k %.0e: G / falls of energy %.4f\n", d.cell, k, rate / mean);
    expect_near(rate, mean, 0.02, mean, "G of a sharp front");
}

// A wide DCB in space: the plane values at mid-width; without Poisson effect, everywhere.
LOOP_TEST(dcb_in_space, 0, 3) {
    if (loop == 0 && !cases::whole()) return;  // no Poisson effect
    Dcb d;
    d.h = 1e-3;
    d.length = 50e-3;
    d.notch = 20e-3;
    d.opening = 0.02e-3;
    d.law = {1e14, 1e14, 50.0, 50.0, 250.0, 250.0};
    d.nu = loop == 1 ? poisson : 0.0;
    const bool quadratic = loop == 2;
    if (quadratic) d.h = 2e-3;
    double plane = 0.0;
    for (const bool space : {false, true}) {
        d.cell = space ? (quadratic ? DELAM_HEX20 : DELAM_HEX8) : quadratic ? DELAM_QUAD8 : DELAM_QUAD4;
        d.width = space ? 60e-3 : 0.0;
        d.across = quadratic ? 6 : 10;
        d.through = quadratic ? 1 : 3;
        const reference::Scene scene = make_dcb(d, d.notch);
        if (!quadratic)
            scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
        reference::Solver solver(scene, 0.0);
        solver.step(1.0);
        const auto fronts = crack_fronts(solver);
        expect(fronts.size() == 1 && !fronts[0].closed, "one front from side to side");
        const auto& points = fronts[0].points;
        if (!space) {
            plane = points[0].total();
            continue;
        }
        if (quadratic) {
            double sum = 0.0, width = 0.0, least = 1e300, most = 0.0;
            for (const FrontPoint& point : points) {
                sum += point.length * point.total();
                width += point.length;
                least = std::min(least, point.total());
                most = std::max(most, point.total());
            }
            std::printf("DCB in space, hex20: G / plane %.4f on average, %.4f to %.4f\n", sum / width / plane,
                        least / plane, most / plane);
            expect_near(sum / width, plane, 0.005, plane, "mean G on quadratic faces");
            for (const FrontPoint& point : points)
                expect_near(point.total(), plane, 0.01, plane, "G at single points of quadratic faces");
            continue;
        }
        expect(points.size() == 11, "a point at each row of pairs, " + std::to_string(points.size()));
        double length = 0.0, mean = 0.0;
        for (const FrontPoint& point : points) {
            length += point.length;
            mean += point.length * point.total();
            expect_near(point.place[0], d.notch - 0.5 * d.h, 1e-9, 1.0,
                        "contour between the open and the first bonded row");
            expect_near(point.direction[0], 1.0, 1e-9, 1.0, "direction");
            if (d.nu == 0.0) expect_near(point.total(), plane, 1e-6, plane, "G across the width");
        }
        const double middle = points[5].total();
        std::printf("DCB in space, nu %g: G at mid-width / plane %.4f, mean %.4f, edge %.4f\n", d.nu, middle / plane,
                    mean / length / plane, points[0].total() / plane);
        expect_near(length, d.width, 1e-9, d.width, "length of the front");
        expect_near(middle, plane, 0.02, plane, "G at mid-width");
        expect_near(solver.value("energy_release_rate"),
                    std::max_element(points.begin(), points.end(),
                                     [](const auto& p, const auto& q) { return p.total() < q.total(); })
                        ->total(),
                    1e-12, plane, "value energy_release_rate");
        expect_near(solver.value("crack_length:0"), d.notch * d.width, 1e-9, 1.0, "crack_length is an area in space");
    }
}
