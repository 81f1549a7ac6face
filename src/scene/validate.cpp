// SPDX-License-Identifier: BSD-3-Clause
// Is the scene complete, free of contradictions, and held?
//
// Two questions are asked about supports. With every interface glued, notches included, nothing may be free: a rigid
// motion left over then is a support that was forgotten. With the initial adhesion alone, parts may be free (a fully
// debonded ply lies between its neighbours, held by contact or not at all) unless a dead force drives them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "delam/delam.h"
#include "scene/problem.hpp"
#include "scene/supports.hpp"

namespace delam {
namespace {

void check_bodies(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    if (mesh.cell_count() == 0) fail(DELAM_ERROR_PROBLEM, "mesh: no cells");
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        if (!problem.material[static_cast<std::size_t>(body)]) {
            fail(DELAM_ERROR_PROBLEM, "body ", mesh.body_label(body), ": no material (delam_problem_set_elastic or delam_problem_set_orthotropic)");
        }
        require_formulation(mesh, body, problem.formulation[static_cast<std::size_t>(body)], DELAM_ERROR_PROBLEM);
    }
}

void check_interfaces(const Problem& problem) {
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& interface = problem.interfaces[i];
        if (interface.bonded) {
            for (std::size_t p = 0; p < interface.adhesion.size(); ++p) {
                if (interface.adhesion[p] < 1.0) {
                    fail(DELAM_ERROR_PROBLEM, "interface ", i, " is bonded for ever, but pair ", p,
                         " has an adhesion of ", interface.adhesion[p], ", not 1");
                }
            }
        } else if (!interface.law) {
            fail(DELAM_ERROR_PROBLEM, "interface ", i, ": no law (delam_problem_set_law or delam_problem_set_bonded)");
        } else {
            try {
                interface.law->validate();
            } catch (const Error& e) {
                fail(e.status(), "interface ", i, ": ", e.what());
            }
        }
    }
}

void check_loads(const Problem& problem) {
    for (const Pattern& pattern : problem.patterns) {
        if (pattern.drives == Pattern::Drives::nothing) {
            fail(DELAM_ERROR_PROBLEM, "pattern '", pattern.name, "' drives neither a displacement nor a force or strain");
        }
    }
}

// Prescribed nodes are independent of each other already when they are added. What is left of a prescribed mean, once
// the prescribed directions are projected out, must not vanish, nor may these rests depend on each other.
void check_means(const Problem& problem) {
    const std::int64_t dimension = problem.mesh->dimension();
    std::map<std::int64_t, std::vector<std::vector<double>>> held;  // orthonormal directions at a node
    std::vector<std::size_t> means;
    for (std::size_t i = 0; i < problem.constraints.size(); ++i) {
        const Constraint& c = problem.constraints[i];
        if (c.dof.front() / dimension != c.dof.back() / dimension) {
            means.push_back(i);
            continue;
        }
        std::vector<double> direction(static_cast<std::size_t>(dimension), 0.0);
        for (std::size_t k = 0; k < c.dof.size(); ++k)
            direction[static_cast<std::size_t>(c.dof[k] % dimension)] = c.coefficient[k];
        auto& others = held[c.dof.front() / dimension];
        for (const std::vector<double>& other : others) {
            double along = 0.0;
            for (std::size_t d = 0; d < direction.size(); ++d) along += direction[d] * other[d];
            for (std::size_t d = 0; d < direction.size(); ++d) direction[d] -= along * other[d];
        }
        double length = 0.0;
        for (const double value : direction) length += value * value;
        if (length < 1e-20)
            fail(DELAM_ERROR_PROBLEM, "constraint ", i, " prescribes what earlier ones at its node do already");
        for (double& value : direction) value /= std::sqrt(length);
        others.push_back(std::move(direction));
    }
    std::vector<std::map<std::int64_t, double>> rests;
    for (const std::size_t i : means) {
        const Constraint& c = problem.constraints[i];
        std::map<std::int64_t, double> rest;
        double before = 0.0;
        for (std::size_t k = 0; k < c.dof.size(); ++k) {
            rest[c.dof[k]] += c.coefficient[k];
            before += c.coefficient[k] * c.coefficient[k];
        }
        std::set<std::int64_t> nodes;
        for (const std::int64_t dof : c.dof) nodes.insert(dof / dimension);
        for (const std::int64_t node : nodes) {
            const auto found = held.find(node);
            if (found == held.end()) continue;
            for (const std::vector<double>& direction : found->second) {
                double along = 0.0;
                for (std::int64_t d = 0; d < dimension; ++d) {
                    const auto entry = rest.find(dimension * node + d);
                    if (entry != rest.end()) along += entry->second * direction[static_cast<std::size_t>(d)];
                }
                if (along == 0.0) continue;
                for (std::int64_t d = 0; d < dimension; ++d) {
                    rest[dimension * node + d] -= along * direction[static_cast<std::size_t>(d)];
                }
            }
        }
        for (const std::map<std::int64_t, double>& other : rests) {
            double along = 0.0;
            for (const auto& [dof, value] : other) {
                const auto entry = rest.find(dof);
                if (entry != rest.end()) along += entry->second * value;
            }
            if (along == 0.0) continue;
            for (const auto& [dof, value] : other) rest[dof] -= along * value;
        }
        double after = 0.0;
        for (const auto& [dof, value] : rest) after += value * value;
        if (after < 1e-20 * before) {
            fail(DELAM_ERROR_PROBLEM, "constraint ", i, " (a mean) prescribes what other constraints do already");
        }
        for (auto& [dof, value] : rest) value /= std::sqrt(after);
        rests.push_back(std::move(rest));
    }
}

std::string names(const Mesh& mesh, const std::vector<std::int32_t>& bodies) {
    std::string list = bodies.size() == 1 ? "body " : "bodies ";
    for (std::size_t i = 0; i < bodies.size(); ++i) list += text(i == 0 ? "" : ", ", mesh.body_label(bodies[i]));
    return list;
}

void check_supports(const Problem& problem) {
    if (problem.constraints.empty())
        fail(DELAM_ERROR_PROBLEM, "missing support: no displacement is prescribed anywhere");
    const std::vector<FreeMotion> missing = free_motions(problem, true);
    if (!missing.empty()) {
        std::string list;
        for (std::size_t i = 0; i < missing.size() && i < 6; ++i) {
            list += text(i == 0 ? "" : "; ", names(*problem.mesh, missing[i].bodies), " can ", missing[i].description);
        }
        fail(DELAM_ERROR_PROBLEM, "missing support: ", list);
    }
    for (const FreeMotion& motion : free_motions(problem, false)) {
        if (motion.force_work > 1e-9) {
            fail(DELAM_ERROR_PROBLEM, "missing support: ", names(*problem.mesh, motion.bodies), " can ",
                 motion.description, " where nothing adheres, and the dead forces of pattern '",
                 problem.patterns[static_cast<std::size_t>(motion.force_pattern)].name, "' act along");
        }
    }
}

}  // namespace

void validate(const Problem& problem) {
    check_bodies(problem);
    check_interfaces(problem);
    check_loads(problem);
    check_means(problem);
    check_supports(problem);
}

}  // namespace delam
