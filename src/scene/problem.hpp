// SPDX-License-Identifier: BSD-3-Clause
// The host's input, complete and checked: bodies, interfaces with laws, constraints, loads, options.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body/eigenstrain.hpp"
#include "body/host_stiffness.hpp"
#include "body/model.hpp"
#include "law/law.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"
#include "scene/engine.hpp"
#include "scene/options.hpp"

namespace delam {

// A named factor over time, piecewise linear, constant beyond its ends.
struct Pattern {
    std::string name;
    std::vector<double> times;
    std::vector<double> values;
    enum class Drives { nothing, displacement, force, strain, gap } drives = Drives::nothing;

    double at(double time) const;
};

// sum_j coefficient[j] u[dof[j]] = sum_p prescribed[p] factor_p(t), for bodies and control nodes, never for tied nodes.
// Coefficients of prescribed nodes are scaled to a square sum of 1, those of means to a sum of 1 along the direction;
// equations are not scaled.
struct Constraint {
    std::vector<std::int64_t> dof;  // mesh DOFs: dimension*node + component
    std::vector<double> coefficient;
    std::vector<double> prescribed;  // [patterns that existed when it was added]; later ones are 0
    // A time at which it begins or ends to hold within the analysis, and the pattern of what is there then: the
    // displacement that it finds, or the force that it leaves (stage.hpp). Nothing: it holds from the first to the
    // last.
    struct Change {
        double time;
        std::int64_t pattern;
    };
    std::optional<Change> begin{}, end{};
};

struct NodalForce {
    std::int64_t pattern;
    std::int64_t dof;
    double value;
};

// Strain per unit factor, in the material axes of a body.
struct Eigenstrain {
    std::int64_t pattern;
    std::int32_t body;
    Strain strain;
};

struct InterfaceProperties {
    std::optional<Law> law;  // none, although not bonded and no contact: still missing
    bool bonded = false;
    bool contact = false;          // contact only: no law, no adhesion
    std::vector<double> adhesion;  // initial, [pairs]
    // Distances of the faces along the normal before they move, L per unit of the factor of gap_pattern, [pairs];
    // empty: they touch. The jump is then the distance that is left.
    std::vector<double> gap;
    std::int64_t gap_pattern = -1;
};

// The gap of a pair as a part of the jump of its normal row: value times the factor of the pattern.
struct GapRow {
    std::int64_t row;
    std::int64_t pattern;
    double value;
};

struct KnownPieces;

struct Problem {
    explicit Problem(std::shared_ptr<const Mesh> mesh_);

    std::shared_ptr<const Mesh> mesh;
    Plane plane = Plane::strain;
    std::vector<std::optional<Material>> material;  // [bodies]
    std::vector<Formulation> formulation;           // [bodies]
    std::vector<std::shared_ptr<const HostStiffness>>
        stiffness;                                   // [bodies] given by the host; null: from cells and material
    std::shared_ptr<const Orientation> orientation;  // of the cells; null: none
    std::vector<InterfaceProperties> interfaces;
    std::vector<Pattern> patterns;
    std::vector<Constraint> constraints;
    std::vector<NodalForce> forces;
    std::vector<Eigenstrain> eigenstrains;
    Options options;
    std::shared_ptr<Engine> engine;  // that solves the bodies; null: the library does
    // True for a scene that is linearised again and again (reduction/turned): the numbers of its stiffness, frames and
    // forces change, but not the places where they stand.
    bool renewed = false;
    // The scene of a stage has the numbers of its constraints in the host's, and how many that has; empty: the same.
    std::vector<std::int64_t> constraint_number;
    std::int64_t constraint_total = 0;
    std::vector<double> jump_offset;  // [rows] parts of the jumps per unit of the last pattern's factor; empty: none

    // DOFs of all pairs: rows of the jump, interface after interface, pair after pair, normal first.
    std::int64_t pair_count() const;
    // Returns the model of a body whose material is set. Error(DELAM_ERROR_PROBLEM) if the plane does not fit the
    // formulation.
    BodyModel model(std::int32_t body) const;
    // K of a body over its nodes in ascending order, both triangles.
    SparseMatrix body_stiffness(std::int32_t body, const Poll& poll = {}) const;
    std::int64_t jump_count() const { return pair_count() * mesh->dimension(); }
    // Interfaces that may be damaged.
    std::int64_t softening_count() const {
        return std::count_if(interfaces.begin(), interfaces.end(),
                             [](const InterfaceProperties& own) { return own.law.has_value() && !own.bonded; });
    }
    std::vector<double> factors(double time) const;
    // The number that the host knows a constraint by, and the count of such numbers.
    std::int64_t number_of(std::size_t constraint) const {
        return constraint_number.empty() ? static_cast<std::int64_t>(constraint) : constraint_number[constraint];
    }
    std::int64_t numbered_constraints() const {
        return constraint_number.empty() ? static_cast<std::int64_t>(constraints.size()) : constraint_total;
    }
    // Right-hand side coefficients [constraints][patterns], row-major.
    std::vector<double> prescribed_matrix() const;
    // Rows of the jump that have a gap, ascending.
    std::vector<GapRow> gap_rows() const;

    // Results of pieces.hpp, for the thread that uses the problem.
    mutable std::shared_ptr<const KnownPieces> known_pieces;
};

// Error(DELAM_ERROR_PROBLEM) where a body has no material.
void require_material(const Problem& problem, std::int32_t body);

// FNV-1a over everything that determines the result, the options included.
std::uint64_t hash(const Problem& problem);
// The same over what the condensed bodies follow from: neither laws, adhesion and options, nor histories of loads.
std::uint64_t hash_of_bodies(const Problem& problem);
// The same over everything that determines what a law answers.
std::uint64_t hash(const Law& law);

}  // namespace delam
