// SPDX-License-Identifier: BSD-3-Clause
// Layers with interfaces in states that an analysis may meet: a notch, some pairs damaged, some closed, some parts
// afloat.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "flexure.hpp"
#include "reduction/condensed/condensed.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "reduction/operator/zone.hpp"
#include "scene/problem.hpp"

namespace unit {

using namespace delam;

struct LayerCase {
    const char* name;
    int dimension = 2;
    std::size_t layers = 2;
    std::int64_t subdomains = 0;
    double stiffness = 125e9;  // of the law
    bool floating = false;     // the layers come apart but for the zone
    bool touching = false;     // the second interface only touches
    bool loaded = false;       // dead forces and an eigenstrain
    const char* preconditioner = "series";
    bool clamped = false;  // supports on both faces of the last pairs
    double tolerance = 1e-7;
    // The mean opening of all pairs of the last interface is prescribed, as large as that of the first one, or that of
    // a control node on which a force acts.
    enum class Opening { none, prescribed, tied, control } opening = Opening::none;
};

inline constexpr LayerCase layer_cases[] = {
    {.name = "two layers"},
    {.name = "four layers", .layers = 4},
    {.name = "soft interface", .subdomains = 3, .stiffness = 1e9},
    {.name = "stiff interface", .subdomains = 3, .stiffness = 1e16},
    {.name = "space", .dimension = 3, .layers = 3, .subdomains = 4},
    {.name = "a layer that floats", .layers = 3, .subdomains = 5, .floating = true},
    {.name = "a layer that floats in space", .dimension = 3, .layers = 3, .floating = true},
    // The condensed operator loses more digits here than others: its forces balance to 1e-6 only.
    {.name = "layers on weak springs", .layers = 3, .stiffness = 1e6, .floating = true, .tolerance = 1e-4},
    {.name = "contact alone", .layers = 3, .touching = true},
    {.name = "dead forces, eigenstrains", .layers = 3, .subdomains = 4, .loaded = true},
    {.name = "a clamped end in space", .dimension = 3, .clamped = true},
    {.name = "mean opening", .layers = 3, .opening = LayerCase::Opening::prescribed},
    {.name = "mean opening in space", .dimension = 3, .opening = LayerCase::Opening::prescribed},
    {.name = "two means tied to each other", .dimension = 3, .layers = 3, .opening = LayerCase::Opening::tied},
    {.name = "mean opening of a control node", .layers = 3, .opening = LayerCase::Opening::control},
    {.name = "three layers in seven subdomains", .layers = 3, .subdomains = 7},
    {.name = "lumped preconditioner", .subdomains = 4, .preconditioner = "lumped"},
    {.name = "a clamped end", .layers = 3, .subdomains = 5, .clamped = true},
    {.name = "very stiff interface", .stiffness = 1e17},
};

// A constraint on many jumps.
inline void bind_opening(Problem& problem, LayerCase::Opening opening) {
    const int dim = problem.mesh->dimension();
    const auto faces = problem.mesh->interfaces();
    Constraint mean{{}, {}, {}};
    const auto add = [&](const InterfaceGeometry& face, double sign) {
        for (std::size_t p = 0; p < face.node_a.size(); ++p) {
            const double share =
                sign * (1.0 + 0.1 * static_cast<double>(p % 5)) / static_cast<double>(face.node_a.size());
            mean.dof.insert(mean.dof.end(), {dim * face.node_b[p] + dim - 1, dim * face.node_a[p] + dim - 1});
            mean.coefficient.insert(mean.coefficient.end(), {share, -share});
        }
    };
    add(faces.back(), 1.0);
    if (opening == LayerCase::Opening::prescribed) {
        problem.patterns.push_back({"open", {0.0, 1.0}, {0.0, 1e-5}, Pattern::Drives::displacement});
        mean.prescribed.assign(problem.patterns.size(), 0.0);
        mean.prescribed.back() = 1e-5;
    } else if (opening == LayerCase::Opening::tied) {
        add(faces.front(), -1.0);
    } else {
        const std::int64_t control = problem.mesh->node_count() - 1;
        mean.dof.push_back(dim * control + dim - 1);
        mean.coefficient.push_back(-1.0);
        problem.patterns.push_back({"open", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::force});
        problem.forces.push_back(
            {static_cast<std::int64_t>(problem.patterns.size()) - 1, dim * control + dim - 1, 2e3});
        for (int k = 0; k + 1 < dim; ++k) problem.constraints.push_back({{dim * control + k}, {1.0}, {}});
    }
    problem.constraints.push_back(std::move(mean));
}

inline Problem make_layers_of(const LayerCase& c) {
    unit::Flexure f;
    f.dimension = c.dimension;
    f.layers = c.layers;
    f.along = c.dimension == 2 ? 40 : 12;
    f.across = 3;
    f.through = 2;
    f.law.normal_stiffness = f.law.tangential_stiffness = c.stiffness;
    f.control = c.opening == LayerCase::Opening::control;
    Problem problem = unit::make_flexure(f);
    // What weak springs leave of the digits depends on the cells: the tolerances are those of standard ones.
    if (c.floating) problem.formulation.assign(problem.formulation.size(), Formulation::standard);
    problem.options.subdomains = c.subdomains;
    problem.options.preconditioner = c.preconditioner;
    if (c.touching) {
        problem.interfaces.back().law.reset();
        problem.interfaces.back().contact = true;
        std::fill(problem.interfaces.back().adhesion.begin(), problem.interfaces.back().adhesion.end(), 0.0);
        // Nodes above must not fall off sideways.
        for (std::int64_t node = 0; node < problem.mesh->node_count(); ++node)
            if (problem.mesh->node_body(node) == static_cast<std::int32_t>(c.layers) - 1 &&
                problem.mesh->node(node)[0] < 1e-9)
                problem.constraints.push_back({{c.dimension * node}, {1.0}, {}});
    }
    if (c.clamped) {
        std::erase_if(problem.constraints, [&](const Constraint& constraint) {
            return problem.mesh->node(constraint.dof.front() / c.dimension)[0] > f.length - 1e-9;
        });
        for (std::int64_t node = 0; node < problem.mesh->node_count(); ++node)
            for (int k = 0; k < c.dimension && problem.mesh->node(node)[0] > f.length - 1e-9; ++k)
                problem.constraints.push_back({{c.dimension * node + k}, {1.0}, {}});
    }
    if (c.loaded) {
        problem.patterns.push_back({"pull", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::force});
        problem.patterns.push_back({"heat", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::strain});
        problem.forces.push_back({1, c.dimension * (problem.mesh->node_count() - 1) + 1, 3e3});
        Strain strain{};
        strain[0] = 1e-3;
        problem.eigenstrains.push_back({2, 1, strain});
    }
    if (c.opening != LayerCase::Opening::none) bind_opening(problem, c.opening);
    return problem;
}

// The condensed operator of a problem.
struct Reference {
    Monitor monitor;
    std::shared_ptr<Bulk> bulk;
    Condensed condensed;
    explicit Reference(const Problem& problem)
        : bulk(condensed_bulk(problem, monitor)), condensed(bulk, problem, monitor) {}
    Condensed& operator*() { return condensed; }
    Condensed* operator->() { return &condensed; }

private:
    static std::shared_ptr<Bulk> condensed_bulk(const Problem& problem, Monitor& monitor) {
        auto bulk = std::make_shared<Bulk>(problem, monitor);
        bulk->condense(monitor);
        return bulk;
    }
};

inline void expect_close(std::span<const double> a, std::span<const double> b, double tolerance, double size,
                         const std::string& what) {
    ck_assert_uint_eq(a.size(), b.size());
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        off = std::isnan(a[i] - b[i]) ? HUGE_VAL : std::max(off, std::abs(a[i] - b[i]));
    std::printf("%s: off by %.2e of %.3g\n", what.c_str(), off, size);
    ck_assert_msg(off <= tolerance * size, "%s: off by %.2e of %.3g", what.c_str(), off, size);
}

// A state that an analysis may meet: a notch, some pairs damaged, some closed.
struct LayerState {
    Problem problem;
    Springs springs;
    std::vector<std::uint8_t> wanted;
    std::vector<double> theta;
    std::size_t dim;

    LayerState(const LayerCase& c, unsigned seed)
        : problem(make_layers_of(c)), dim(static_cast<std::size_t>(c.dimension)) {
        std::mt19937 random(seed);
        const auto one_in = [&](unsigned n) { return random() % n == 0; };
        springs.stiffness.assign(index(problem.jump_count()), 0.0);
        springs.held.assign(springs.stiffness.size(), 0);
        wanted.assign(springs.stiffness.size(), 0);
        theta.assign(problem.patterns.size(), 1.0);
        std::size_t pair = 0;
        for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
            const InterfaceGeometry& face = problem.mesh->interfaces()[i];
            for (std::size_t p = 0; p < face.weight.size(); ++p, ++pair) {
                const double x = problem.mesh->node(face.node_a[p])[0];
                double zeta = problem.interfaces[i].adhesion[p];
                const bool front = x > 0.025 && x<0.045, far = x> 0.1;
                if (front && one_in(2)) zeta *= 0.1 + 0.8 * static_cast<double>(random() % 1000) / 1000.0;
                if (c.floating) zeta = front && zeta > 0.0 ? zeta : 0.0;
                const bool closed =
                    problem.interfaces[i].contact ? one_in(2) : !c.floating && !front && !far && one_in(8);
                for (std::size_t k = 0; k < dim; ++k) {
                    springs.stiffness[pair * dim + k] =
                        problem.interfaces[i].law ? face.weight[p] * zeta * c.stiffness : 0.0;
                    wanted[pair * dim + k] = front ? 1 : 0;
                }
                springs.held[pair * dim] = closed ? 1 : 0;
            }
        }
    }
};

// The front has advanced to x; every seventh pair behind it is closed.
inline Springs advanced(const LayerState& scene, double x) {
    Springs springs = scene.springs;
    std::size_t pair = 0;
    for (const InterfaceGeometry& face : scene.problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p, ++pair) {
            const double at = scene.problem.mesh->node(face.node_a[p])[0];
            if (at < 0.045 || at > x) continue;
            for (std::size_t k = 0; k < scene.dim; ++k) springs.stiffness[pair * scene.dim + k] = 0.0;
            springs.held[pair * scene.dim] = pair % 7 == 0 ? 1 : 0;
        }
    return springs;
}

struct ZoneAnswer {
    std::vector<double> jump, force;  // of the wanted rows
    double energy = 0.0;
};

// The zone's minimiser where the wanted rows have `scale` of their springs and every fifth pair of them is closed.
inline ZoneAnswer ask(Zone& zone, const LayerState& scene, double scale) {
    const std::vector<std::int64_t>& rows = zone.jump_rows();
    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held(rows.size());
    std::vector<double> spring(rows.size(), 0.0);
    for (std::size_t z = 0; z < rows.size(); ++z) {
        const std::size_t r = index(rows[z]);
        held[z] = scene.springs.held[r];
        if (scene.wanted[r] != 0) held[z] = r % scene.dim == 0 && r / scene.dim % 5 == 0 && scale < 1.0 ? 1 : 0;
        spring[z] = (scene.wanted[r] != 0 ? scale : 1.0) * scene.springs.stiffness[r];
        const auto at = static_cast<std::int64_t>(z);
        if (held[z] == 0 && spring[z] > 0.0) couplings.push_back({at, at, spring[z]});
    }
    ck_assert(zone.factor(couplings, held));
    const Zone::Solution solution = zone.solve(scene.theta, {});
    ck_assert(solution.balanced);
    const std::vector<double> jump = zone.jumps(scene.theta, solution.unknowns);
    std::vector<double> force(rows.size());
    for (std::size_t z = 0; z < rows.size(); ++z) force[z] = held[z] != 0 ? 0.0 : spring[z] * jump[z];
    zone.complete_forces(scene.theta, solution, force);
    ZoneAnswer answer;
    answer.energy = zone.energy_of(scene.theta, solution.unknowns);
    for (std::size_t z = 0; z < rows.size(); ++z) {
        if (held[z] == 0) answer.energy += 0.5 * spring[z] * jump[z] * jump[z];
        if (scene.wanted[index(rows[z])] == 0) continue;
        answer.jump.push_back(jump[z]);
        answer.force.push_back(force[z]);
    }
    return answer;
}

}  // namespace unit
