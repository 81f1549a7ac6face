// SPDX-License-Identifier: BSD-3-Clause
// Fronts of given states: positions, lengths, and J of fields whose integral is known.
#include <algorithm>
#include <cmath>
#include <functional>

#include "check.hpp"
#include "evolution/observe/crack_front.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"

using namespace delam;

namespace {

void near(double value, double exact, double tolerance = 1e-12) {
    ck_assert_msg(std::abs(value - exact) <= tolerance, "%.17g instead of %.17g", value, exact);
}

// The interface of two layers of unit thickness; adhesions and jumps as functions of the position.
struct Bed {
    using Function = std::function<double(double, double)>;
    Mesh mesh;
    Law law;
    std::vector<double> initial, adhesion, jump, force;

    explicit Bed(Mesh made) : mesh(std::move(made)) {
        law.normal_stiffness = 3.0;
        law.tangential_stiffness = 5.0;
        law.normal_onset = law.tangential_onset = 1.0;
        law.normal_toughness = law.tangential_toughness = 2.0;
        initial.assign(geometry().weight.size(), 1.0);
        adhesion = initial;
        jump.assign(adhesion.size() * static_cast<std::size_t>(mesh.dimension()), 0.0);
    }
    static Bed layers(const std::vector<double>& lengths, const std::vector<std::int64_t>& divisions, CellType type) {
        const std::vector<double> thickness{1.0, 1.0};
        const std::vector<std::int64_t> through{1, 1};
        Mesh mesh = make_layers(static_cast<int>(lengths.size()) + 1, lengths, divisions, thickness, through, type);
        add_interface(mesh, 0, 1, 1e-6);
        return Bed(std::move(mesh));
    }
    const InterfaceGeometry& geometry() const { return mesh.interfaces()[0]; }
    std::span<const double> place(std::size_t pair) const { return mesh.node(geometry().node_a[pair]); }
    void set(std::vector<double>& field, const Function& f) const {
        for (std::size_t p = 0; p < field.size(); ++p) field[p] = f(place(p)[0], place(p)[1]);
    }
    void open(const Function& normal, const Function& tangential) {
        const auto dim = static_cast<std::size_t>(mesh.dimension());
        for (std::size_t p = 0; p < adhesion.size(); ++p) {
            jump[p * dim] = normal(place(p)[0], place(p)[1]);
            jump[p * dim + 1] = tangential(place(p)[0], place(p)[1]);
        }
    }
    // The forces are those of the law at the jumps and adhesion of now.
    CrackedInterface interface() {
        const auto dim = static_cast<std::size_t>(mesh.dimension());
        force.resize(jump.size());
        for (std::size_t i = 0; i < jump.size(); ++i)
            force[i] = geometry().weight[i / dim] * adhesion[i / dim] * law.stiffness(i % dim) * jump[i];
        return {mesh, geometry(), law, initial, adhesion, jump, force};
    }
    std::vector<CrackFront> fronts() { return crack_fronts(interface()); }
};

struct Kind {
    CellType type;
    std::int64_t cells;
};
constexpr Kind kinds[] = {{CellType::hex8, 20}, {CellType::tet4, 20}, {CellType::hex20, 10}, {CellType::tet10, 10}};

double one(double, double) { return 1.0; }
double none(double, double) { return 0.0; }

}  // namespace

// A notch at the left end, a crack inside, one from the right end; 20 cells of length 1/2, linear and quadratic ones.
LOOP_TEST(fronts_on_a_line, 0, 2) {
    Bed bed = Bed::layers({10.0}, {loop == 0 ? 20 : 10}, loop == 0 ? CellType::quad4 : CellType::quad8);
    bed.set(bed.initial, [](double x, double) { return x < 1.9 ? 0.0 : 1.0; });
    ck_assert_uint_eq((bed.adhesion = bed.initial, bed.fronts().size()), 1);
    near(bed.fronts()[0].points[0].place[0], 2.0);
    near(bed.fronts()[0].points[0].length, 2.0);
    near(crack_length(bed.interface()), 2.0);
    near(crack_area(bed.interface()), 2.0);

    bed.set(bed.adhesion, [](double x, double) { return x < 2.9 || (x > 4.9 && x < 6.1) || x > 9.4 ? 0.0 : 1.0; });
    const std::vector<CrackFront> fronts = bed.fronts();
    ck_assert_uint_eq(fronts.size(), 4);
    const double spent[] = {1.0, 1.5, 0.75};  // weights of the pairs that broke: 2, 2.5; 5, 5.5, 6; 9.5, 10
    double sum = 2.0;
    for (std::size_t p = 0; p < bed.adhesion.size(); ++p)
        if (bed.initial[p] > 0.0) sum += bed.geometry().weight[p] * (1.0 - bed.adhesion[p]);
    near(crack_length(bed.interface()), sum);
    const double direction[] = {1.0, -1.0, 1.0, -1.0};
    for (std::size_t f = 0; f < 4; ++f) near(fronts[f].points[0].direction[0], direction[f]);
    near(fronts[1].points[0].length, fronts[2].points[0].length);
    near(0.5 * (fronts[1].points[0].place[0] + fronts[2].points[0].place[0]), 5.5);
    if (loop == 0) {
        near(fronts[0].points[0].length, 2.0 + spent[0]);
        near(fronts[1].points[0].length, spent[1]);
        near(fronts[3].points[0].length, spent[2]);
        near(fronts[3].points[0].place[0], 10.0 - spent[2]);
    }
    double lengths = fronts[0].points[0].length + fronts[1].points[0].length + fronts[3].points[0].length;
    near(lengths, sum);

    // A front lies 5/9 of a cell beyond the pair that broke, where 4/9 is spent; the notch counts from its tip.
    near(crack_area(bed.interface()), 3.0 + 1.0 + 0.5 + 3.0 * 5.0 / 18.0);

    bed.set(bed.adhesion, none);
    ck_assert_uint_eq(bed.fronts().size(), 0);
    near(crack_length(bed.interface()), 10.0);
    near(crack_area(bed.interface()), 10.0);
}

// A sharp front that breaks pair after pair advances by a cell each; a softening law puts the front where 4/9 of the
// toughness is spent, however the adhesion varies. Bilinear law: onset at a jump of 1, nothing left at 5.
TEST(area_of_a_line) {
    Bed bed = Bed::layers({10.0}, {20}, CellType::quad4);
    bed.law.normal_onset = bed.law.tangential_onset = 1.5;          // 3/2 * 1^2
    bed.law.normal_toughness = bed.law.tangential_toughness = 7.5;  // 3/2 * 1 * 5
    bed.set(bed.initial, [](double x, double) { return x < 1.9 ? 0.0 : 1.0; });
    for (const double broken : {1.9, 2.4, 2.9, 3.4}) {
        bed.set(bed.adhesion, [&](double x, double) { return x < broken ? 0.0 : 1.0; });
        near(crack_area(bed.interface()), broken + 0.1);
    }
    // The jump falls from 5 at x = 3 to 1 at x = 7; the spent share is (jump - 1)/4, 4/9 at x = 7 - 16/9. At the start
    // the front lies 4/9 of a cell behind the tip of the notch.
    const auto opening = [](double x, double) { return 8.0 - x; };
    bed.open(opening, none);
    bed.set(bed.adhesion, [&](double x, double y) {
        const double s = opening(x, y);
        return s <= 1.0 ? 1.0 : std::max((5.0 - s) / (4.0 * s), 0.0);
    });
    near(spent(bed.interface(), 8), 0.75, 1e-12);
    near(crack_area(bed.interface()), 7.0 - 16.0 / 9.0 + 4.0 / 18.0, 1e-9);
}

// A blister with a straight-sided cone of spent share: the area inside its 4/9, on all kinds of faces.
LOOP_TEST(area_of_a_blister, 0, 4) {
    const Kind kind = kinds[loop];
    Bed bed = Bed::layers({20.0, 20.0}, {kind.cells, kind.cells}, kind.type);
    bed.law.normal_onset = bed.law.tangential_onset = 2.0;  // Griffith's law: the spent share is 1 - zeta
    bed.set(bed.adhesion, [](double x, double y) {
        return std::clamp(0.5 + (std::hypot(x - 10.0, y - 10.0) - 6.0) / 4.0, 0.0, 1.0);
    });
    near(crack_area(bed.interface()), M_PI * std::pow(6.0 + 4.0 / 18.0, 2), 0.8);
}

// With constant jumps int Y dzeta/dx dx = Y, however the adhesion varies; a patch of lower initial adhesion ahead adds
// nothing.
LOOP_TEST(rates_on_a_line, 0, 2) {
    Bed bed = Bed::layers({10.0}, {loop == 0 ? 20 : 10}, loop == 0 ? CellType::quad4 : CellType::quad8);
    bed.set(bed.initial, [](double x, double) { return x < 1.9 ? 0.0 : x > 7.9 ? 0.4 : 1.0; });
    bed.set(bed.adhesion, [](double x, double) {
        return x < 1.9 ? 0.0 : x > 7.9 ? 0.4 : std::min(1.0, 0.2 * (x - 1.9));
    });
    bed.open([](double, double) { return 0.1; }, [](double, double) { return -0.2; });
    const std::vector<CrackFront> fronts = bed.fronts();
    const FrontPoint& point = fronts[0].points[0];
    near(point.rate[0], 0.5 * 3.0 * 0.01, 1e-15);
    near(point.rate[1], 0.5 * 5.0 * 0.04, 1e-15);
    near(point.rate[2], 0.0);
    near(point.mixity(), 0.1 / 0.115, 1e-12);
    near(point.zone_pairs, 10.0);  // 2.0 .. 6.5
    near(point.zone, 5.0, loop == 0 ? 1e-12 : 0.2);
}

// A ring-shaped interface: two fronts of one crack, wherever the list of faces begins.
LOOP_TEST(ring, 0, 4) {
    const std::int64_t n = 24;
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    const double radius[] = {1.0, 2.0, 2.0, 3.0};
    for (const double r : radius)
        for (std::int64_t i = 0; i < n; ++i)
            for (const double x : {r * std::cos(2.0 * M_PI * static_cast<double>(i) / n),
                                   r * std::sin(2.0 * M_PI * static_cast<double>(i) / n)})
                nodes.push_back(x);
    for (const std::int64_t inner : {std::int64_t{0}, 2 * n})
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t j = (i + 1) % n;
            for (const std::int64_t node : {inner + i, inner + n + i, inner + n + j, inner + j}) cells.push_back(node);
            bodies.push_back(inner == 0 ? 0 : 1);
        }
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad4, cells, bodies);
    add_interface(mesh, 0, 1, 1e-6);
    Bed bed(std::move(mesh));
    const double start = 2.0 * M_PI * loop / 4.0;
    const auto inside = [&](double x, double y) { return std::cos(std::atan2(y, x) - start) > std::cos(0.9); };
    bed.set(bed.adhesion, [&](double x, double y) { return inside(x, y) ? 0.0 : 1.0; });
    bed.open([](double, double) { return 0.1; }, one);
    const std::vector<CrackFront> fronts = bed.fronts();
    ck_assert_uint_eq(fronts.size(), 2);
    double opened = 0.0;
    for (std::size_t p = 0; p < bed.adhesion.size(); ++p) opened += bed.geometry().weight[p] * (1.0 - bed.adhesion[p]);
    for (const CrackFront& front : fronts) {
        const FrontPoint& point = front.points[0];
        near(point.length, opened, 1e-9);
        near(std::acos((point.place[0] * std::cos(start) + point.place[1] * std::sin(start)) /
                       std::hypot(point.place[0], point.place[1])) *
                 4.0,
             opened, 0.05);
        near(point.rate[0], 0.5 * 3.0 * 0.01, 1e-12);
        near(point.rate[1], 0.5 * 5.0 * std::cos(2.0 * M_PI / n), 1e-9);  // the tangents of two neighbours turn
    }
    bed.set(bed.adhesion, none);
    ck_assert_uint_eq(bed.fronts().size(), 0);
}

// A stiff interface: the jump rises in unit steps from the onset s_0 = 1e-5 s_c to s_c = 8, where the adhesion is
// (s_0/s)(s_c - s)/(s_c - s_0), at most 1e-5 in between. Its process zone is where the traction decreases, not where
// the adhesion is far from 0 and 1.
TEST(zone_of_a_stiff_interface) {
    const double s_c = 8.0, s_0 = 1e-5 * s_c;
    for (const bool space : {false, true}) {
        Bed bed =
            space ? Bed::layers({20.0, 2.0}, {20, 2}, CellType::hex8) : Bed::layers({20.0}, {20}, CellType::quad4);
        bed.law.normal_onset = 0.5 * bed.law.normal_stiffness * s_0 * s_0;
        bed.law.normal_toughness = 0.5 * bed.law.normal_stiffness * s_0 * s_c;
        bed.law.tangential_onset = bed.law.normal_onset;
        bed.law.tangential_toughness = bed.law.normal_toughness;
        const auto jump = [](double x, double) {
            return std::max(12.5 - x, 0.0);
        };  // onset ahead of x = 12, end at 4.5
        bed.open(jump, none);
        bed.set(bed.adhesion, [&](double x, double y) {
            const double s = jump(x, y);
            return s <= s_0 ? 1.0 : std::max(s_0 / s * (s_c - s) / (s_c - s_0), 0.0);
        });
        const std::vector<CrackFront> fronts = bed.fronts();
        ck_assert_uint_eq(fronts.size(), 1);
        for (const FrontPoint& point : fronts[0].points) {
            near(point.zone, 8.0, 1e-9);  // 5 .. 12
            near(point.zone_pairs, 8.0, 1e-9);
        }
        near(process_zone(bed.interface()), space ? 16.0 : 8.0, 1e-9);
    }
}

// A straight front across the width, a blister inside: an open line and a ring on one interface.
LOOP_TEST(contours, 0, 4) {
    const Kind kind = kinds[loop];
    Bed bed = Bed::layers({20.0, 20.0}, {kind.cells, kind.cells}, kind.type);
    bed.set(bed.adhesion, [](double x, double y) {
        return std::clamp(std::min(0.5 + (x - 3.2) / 3.0, 0.5 + (std::hypot(x - 12.0, y - 10.0) - 4.0) / 3.0), 0.0,
                          1.0);
    });
    bed.open([](double, double) { return 0.1; }, [](double, double) { return 0.2; });
    const std::vector<CrackFront> fronts = bed.fronts();
    ck_assert_uint_eq(fronts.size(), 2);
    const bool swapped = fronts[0].closed;
    const CrackFront &line = fronts[swapped ? 1 : 0], &ring = fronts[swapped ? 0 : 1];
    ck_assert(!line.closed && ring.closed);
    const double area = bed.geometry().weight.size() > 0 ? 400.0 : 0.0;
    double length = 0.0, rate = 0.0;
    for (const FrontPoint& point : line.points) {
        near(point.place[0], 3.2, 0.02);
        near(point.direction[0], 1.0, 0.02);
        length += point.length;
        rate += point.length * point.total();
    }
    near(length, 20.0, 0.05);
    near(rate / length, 0.5 * (3.0 * 0.01 + 5.0 * 0.04), 0.004);
    length = 0.0;
    double normal = 0.0, mixed[2] = {0.0, 0.0};
    for (const FrontPoint& point : ring.points) {
        const double x = point.place[0] - 12.0, y = point.place[1] - 10.0, r = std::hypot(x, y);
        near(r, 4.0, 0.15);
        ck_assert_msg((point.direction[0] * x + point.direction[1] * y) / r > 0.9, "outward");
        length += point.length;
        normal += point.length * point.rate[0];
        mixed[0] += point.length * point.rate[1];
        mixed[1] += point.length * point.rate[2];
    }
    near(length, 8.0 * M_PI, 0.6);
    // Shear along x all around: half of its energy is mode II, half mode III.
    near(normal / length, 0.5 * 3.0 * 0.01, 0.0015);
    near(mixed[0] / length, 0.25 * 5.0 * 0.04, 0.006);
    near(mixed[1] / length, 0.25 * 5.0 * 0.04, 0.006);
    double weights = 0.0;
    for (const double w : bed.geometry().weight) weights += w;
    near(weights, area, 1e-9);
}

// A front that advances in strips: each point has its own process zone and pairs.
TEST(zones_in_space) {
    Bed bed = Bed::layers({20.0, 8.0}, {20, 4}, CellType::hex8);
    bed.set(bed.adhesion, [](double x, double) { return std::clamp((x - 4.5) / 6.0, 0.0, 1.0); });
    const std::vector<CrackFront> fronts = bed.fronts();
    ck_assert_uint_eq(fronts.size(), 1);
    ck_assert_uint_eq(fronts[0].points.size(), 5);
    for (const FrontPoint& point : fronts[0].points) {
        near(point.zone, 6.0, 1e-9);
        near(point.zone_pairs, 6.0, 1e-9);
        near(point.rate[0], 0.0);
    }
}

// A checkerboard with saddles and many loops: every crossing belongs to exactly one front, and every front ends.
TEST(saddles) {
    Bed bed = Bed::layers({8.0, 8.0}, {8, 8}, CellType::hex8);
    bed.set(bed.adhesion, [](double x, double y) { return static_cast<int>(std::lround(x + y)) % 2 == 0 ? 0.0 : 0.9; });
    std::size_t points = 0;
    for (const CrackFront& front : bed.fronts()) points += front.points.size();
    ck_assert(points > 0);
    bed.set(bed.adhesion, [](double x, double y) { return std::lround(x) == 4 && std::lround(y) == 4 ? 0.0 : 1.0; });
    ck_assert_uint_eq(bed.fronts().size(), 1);
    ck_assert(bed.fronts()[0].closed);
}
