// SPDX-License-Identifier: BSD-3-Clause
// Symmetries of a laminate of three layers: all of them are found, in any position and numbering, and whatever breaks
// one of them removes that one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "check.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "meshes.hpp"
#include "scene/advice/symmetry.hpp"
#include "scene/problem.hpp"

using namespace delam;
using namespace unit;

namespace {

constexpr double length_x = 3.0, length_y = 2.0, layer = 0.4, height = 3.0 * layer;

struct Setting {
    CellType type = CellType::quad4;
    unsigned seed = 0;
    double angle = 0.0;                                  // in the plane of the first and the last axis
    std::function<void(std::span<double>)> distorted{};  // before the turn

    int dimension() const { return topology(type).dimension; }
    Numbers turned(Numbers x) const {
        const double a = x.front(), b = x.back();
        x.front() = std::cos(angle) * a - std::sin(angle) * b;
        x.back() = std::sin(angle) * a + std::cos(angle) * b;
        return x;
    }
    Numbers back(std::span<const double> at) const {
        Numbers x(at.begin(), at.end());
        const double a = x.front(), b = x.back();
        x.front() = std::cos(angle) * a + std::sin(angle) * b;
        x.back() = -std::sin(angle) * a + std::cos(angle) * b;
        return x;
    }
};

struct Laminate {
    Setting setting;
    Problem problem;

    // Nodes of a layer at a place before the turn; infinite: anywhere.
    Indices nodes(std::int32_t body, const Numbers& place) const {
        Indices found;
        for (const std::int64_t n : problem.mesh->body_nodes(body)) {
            const Numbers x = setting.back(problem.mesh->node(n));
            bool there = true;
            for (std::size_t k = 0; k < x.size(); ++k)
                there = there && (std::isinf(place[k]) || std::abs(x[k] - place[k]) < 1e-9);
            if (there) found.push_back(n);
        }
        return found;
    }
    void hold(const Indices& held, const Numbers& direction) {
        const std::int64_t dim = setting.dimension();
        for (const std::int64_t n : held) {
            Constraint constraint{{}, setting.turned(direction), {}};
            for (std::int64_t k = 0; k < dim; ++k) constraint.dof.push_back(dim * n + k);
            problem.constraints.push_back(constraint);
        }
    }
    void pull(const Indices& pulled, const Numbers& force) {
        const Numbers turned = setting.turned(force);
        for (const std::int64_t n : pulled)
            for (std::size_t k = 0; k < turned.size(); ++k)
                problem.forces.push_back({0, setting.dimension() * n + static_cast<std::int64_t>(k), turned[k]});
    }
    Numbers along(std::size_t axis, double value) const {
        Numbers v(index(setting.dimension()), 0.0);
        (axis == 0 ? v.front() : axis == 2 ? v.back() : v[1]) = value;
        return v;
    }
    // A place with one coordinate, the others anywhere.
    Numbers where(std::size_t axis, double value) const {
        Numbers v(index(setting.dimension()), std::numeric_limits<double>::infinity());
        (axis == 0 ? v.front() : axis == 2 ? v.back() : v[1]) = value;
        return v;
    }
};

Law softening() {
    Law law;
    law.normal_stiffness = law.tangential_stiffness = 1e5;
    law.normal_onset = law.tangential_onset = 1e-3;
    law.normal_toughness = law.tangential_toughness = 1e-2;
    return law;
}

// Pulled apart at both ends of the middle layer, held on its middle planes.
Laminate laminate(const Setting& setting) {
    const bool plane = setting.dimension() == 2;
    const Mesh straight = layers(setting.type, plane ? Numbers{length_x} : Numbers{length_x, length_y},
                                 plane ? Indices{4} : Indices{4, 2}, {layer, layer, layer}, {1, 2, 1});
    Mesh mesh = rebuilt(straight, setting.seed, [&](std::span<double> x) {
        if (setting.distorted) setting.distorted(x);
        std::ranges::copy(setting.turned({x.begin(), x.end()}), x.begin());
    });
    add_interface(mesh, 0, 1, 0.0);
    add_interface(mesh, 2, 1, 0.0);
    Laminate made{setting, Problem(std::make_shared<const Mesh>(std::move(mesh)))};
    Problem& problem = made.problem;
    problem.patterns.push_back({"p", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::force});
    for (auto& material : problem.material) material = Elastic{1e3, 0.3};
    for (InterfaceProperties& interface : problem.interfaces) interface.law = softening();
    made.hold(made.nodes(1, made.where(0, 0.5 * length_x)), made.along(0, 1.0));
    made.hold(made.nodes(1, made.where(2, 0.5 * height)), made.along(2, 1.0));
    if (!plane) made.hold(made.nodes(1, made.where(1, 0.5 * length_y)), made.along(1, 1.0));
    made.pull(made.nodes(1, made.where(0, 0.0)), made.along(0, -1.0));
    made.pull(made.nodes(1, made.where(0, length_x)), made.along(0, 1.0));
    return made;
}

std::vector<std::string> kinds(const Problem& problem) {
    std::vector<std::string> found;
    for (const Symmetry& s : symmetries(problem)) {
        for (std::size_t p = 0; p < s.image.size(); ++p)
            ck_assert_int_eq(s.image[index(s.image[p])], static_cast<std::int64_t>(p));
        found.push_back(s.name.substr(4, s.name.find(' ', 4) - 4));
    }
    std::ranges::sort(found);
    return found;
}

void expect(const Problem& problem, std::int64_t turns, std::int64_t reflections) {
    const std::vector<std::string> found = kinds(problem);
    ck_assert_int_eq(std::ranges::count(found, "half-turn"), turns);
    ck_assert_int_eq(std::ranges::count(found, "reflection"), reflections);
}

const std::vector<Setting> settings{{CellType::quad4},
                                    {CellType::quad4, 7, 0.5},
                                    {CellType::quad8, 3, std::numbers::pi / 4.0},
                                    {CellType::hex8},
                                    {CellType::hex20, 5, 0.3}};

TEST(all_are_found) {
    for (const Setting& s : settings) expect(laminate(s).problem, s.dimension() == 2 ? 1 : 3, s.dimension());
}

TEST(mirrored_pairs) {
    const Laminate made = laminate({});
    for (const Symmetry& s : symmetries(made.problem)) {
        const bool across = s.name.ends_with("normal to (0, 1)");
        for (std::size_t p = 0; p < s.image.size(); ++p)
            ck_assert_int_eq(made.problem.mesh->interfaces()[0].pair_count() <= s.image[p],
                             (static_cast<std::int64_t>(p) < made.problem.mesh->interfaces()[0].pair_count()) !=
                                 s.name.ends_with("normal to (1, 0)"));
        ck_assert(across || s.name.starts_with("the half-turn about (1.5, 0.6") ||
                  s.name.ends_with("normal to (1, 0)"));
    }
}

struct Spoiled {
    const char* what;
    std::function<void(Laminate&)> spoil;
    std::int64_t turns[2], reflections[2];  // that remain in 2D, 3D
};

const std::vector<Spoiled> spoiled{
    {"material",
     [](Laminate& l) {
         l.problem.material[2] = Elastic{1.001e3, 0.3};
     },
     {0, 1},
     {1, 2}},
    {"law", [](Laminate& l) { l.problem.interfaces[1].law->normal_onset *= 1.001; }, {0, 1}, {1, 2}},
    {"contact alone",
     [](Laminate& l) { l.problem.interfaces[1].law.reset(), l.problem.interfaces[1].contact = true; },
     {0, 1},
     {1, 2}},
    {"adhesion",
     [](Laminate& l) {
         for (std::size_t p = 0; p < l.problem.interfaces[0].adhesion.size(); ++p) {
             const std::int64_t node = l.problem.mesh->interfaces()[0].node_b[p];
             if (l.setting.back(l.problem.mesh->node(node)).front() < 1e-9) l.problem.interfaces[0].adhesion[p] = 0.0;
         }
     },
     {0, 0},
     {0, 1}},
    {"gap",
     [](Laminate& l) {
         l.problem.interfaces[0].gap_pattern = 0;
         l.problem.interfaces[0].gap.assign(l.problem.interfaces[0].adhesion.size(), 0.1);
     },
     {0, 1},
     {1, 2}},
    {"support", [](Laminate& l) { l.hold(l.nodes(0, l.where(0, 0.0)), l.along(0, 1.0)); }, {0, 0}, {0, 1}},
    {"prescribed",
     [](Laminate& l) {
         const std::size_t first = l.problem.constraints.size();
         l.hold(l.nodes(0, l.where(0, 0.0)), l.along(0, 1.0));
         l.hold(l.nodes(0, l.where(0, length_x)), l.along(0, 1.0));
         for (std::size_t c = first; c < l.problem.constraints.size(); ++c) l.problem.constraints[c].prescribed = {1.0};
     },
     {0, 0},
     {0, 1}},
    {"opposite forces",
     [](Laminate& l) {
         l.pull(l.nodes(0, l.where(2, 0.0)), l.along(0, -0.5));
         l.pull(l.nodes(2, l.where(2, height)), l.along(0, 0.5));
     },
     {1, 1},
     {0, 1}},
    {"force", [](Laminate& l) { l.pull(l.nodes(0, l.where(0, 0.0)), l.along(2, 1e-3)); }, {0, 0}, {0, 1}},
    {"strain",
     [](Laminate& l) {
         l.problem.eigenstrains.push_back({0, 0, Strain{1e-3, 1e-3, 1e-3, 0, 0, 0}});
     },
     {0, 1},
     {1, 2}},
    {"orthotropic, oblique",
     [](Laminate& l) {
         for (auto& m : l.problem.material) m = Orthotropic{{1e3, 1e2, 1e2, 0.3, 0.3, 0.4, 50, 50, 35}};
         const double c = std::cos(l.setting.angle + 0.4), s = std::sin(l.setting.angle + 0.4);
         const Axes axes =
             l.setting.dimension() == 2 ? Axes{c, s, 0, -s, c, 0, 0, 0, 1} : Axes{c, 0, s, 0, 1, 0, -s, 0, c};
         const auto cells = index(l.problem.mesh->cell_count());
         l.problem.orientation =
             std::make_shared<const Orientation>(Orientation{{axes}, std::vector<std::int32_t>(cells, 0)});
     },
     {1, 1},
     {0, 1}},
    {"formulation", [](Laminate& l) { l.problem.formulation[0] = Formulation::mean_dilatation; }, {0, 1}, {1, 2}}};

TEST(whatever_breaks_one) {
    for (const Setting& s : settings)
        for (const Spoiled& how : spoiled) {
            Laminate made = laminate(s);
            how.spoil(made);
            const std::size_t d = s.dimension() == 2 ? 0 : 1;
            const std::vector<std::string> found = kinds(made.problem);
            const auto turns = std::ranges::count(found, "half-turn");
            ck_assert_msg(turns == how.turns[d] && std::ssize(found) - turns == how.reflections[d],
                          "%s, %d dimensions: %d half-turns, %d reflections", how.what, s.dimension(),
                          static_cast<int>(turns), static_cast<int>(std::ssize(found) - turns));
        }
}

// A node that stands off by a hundredth of a cell is no rounding, one by 1e-9 of the mesh is.
TEST(places) {
    for (Setting s : settings) {
        s.distorted = [](std::span<double> x) {
            if (x.front() < 1e-9 && x.back() < 1e-9 && x[1] < 1e-9) x.front() -= 3e-9;
        };
        expect(laminate(s).problem, s.dimension() == 2 ? 1 : 3, s.dimension());
        s.distorted = [](std::span<double> x) {
            if (x.front() < 1e-9 && x.back() < 1e-9 && x[1] < 1e-9) x.front() -= 1e-2;
        };
        expect(laminate(s).problem, 0, 0);
    }
}

// A square has diagonals, too.
TEST(diagonals) {
    Mesh mesh = layers(CellType::hex8, {2.0, 2.0}, {3, 3}, {layer, layer}, {1, 1});
    add_interface(mesh, 0, 1, 0.0);
    Problem problem(std::make_shared<const Mesh>(std::move(mesh)));
    for (auto& material : problem.material) material = Elastic{1e3, 0.3};
    problem.interfaces[0].law = softening();
    // Across the layers pairs stay where they are: two reflections along edges, two along diagonals, and the half-turns
    // about five axes.
    expect(problem, 5, 4);
    problem.material[1] = Elastic{2e3, 0.3};
    expect(problem, 1, 4);
}

TEST(insides_unknown) {
    Laminate made = laminate({});
    made.problem.stiffness[0] = std::make_shared<const HostStiffness>();
    expect(made.problem, 0, 0);
}

}  // namespace
