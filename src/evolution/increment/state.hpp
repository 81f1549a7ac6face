// SPDX-License-Identifier: BSD-3-Clause
// The complete state of an analysis after a step: what the next step needs, and what the history records.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "evolution/increment/pair_mixities.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

// Energies, F L (2D: F). Both parts of the recorded split are >= 0; that of PANM 15 (2010), whose dissipation is linear
// in the damage, is reported in addition (`_linear`).
struct Ledger {
    double stored_bulk = 0.0;
    double stored_interface = 0.0;         // sum w zeta Y + kappa/2 zeta^T A zeta
    double load_potential = 0.0;           // -f.u of dead forces
    double stored_interface_linear = 0.0;  // the same + sum w f(B, zeta)
    // cumulative
    double dissipated = 0.0;         // sum w (g(B, zeta) - g(B, zeta_old)) over the steps
    double dissipated_linear = 0.0;  // sum w Gc(B) (zeta_old - zeta)
    double work = 0.0;               // of the reactions
    double released = 0.0;           // in jumps: neither stored nor dissipated
    // of the step: lower <= increment <= upper
    double lower = 0.0;
    double increment = 0.0;  // E_k - E_{k-1} + D_k
    double upper = 0.0;
    // Increment with the mixity of the step before (mixity_rule = frozen, variational).
    double increment_lower = 0.0;

    // Energies of the state from which the cumulative columns count; setting a state, instead of reaching it by load
    // steps, shifts them.
    double initial = 0.0;
    double initial_linear = 0.0;
    // Estimated error of the energy that the step has dissipated, relative to that energy.
    double mixity_error = 0.0;

    double energy_linear() const { return stored_bulk + stored_interface_linear + load_potential; }
    // Defect of the energy balance, in either split.
    double defect() const { return energy() - initial + dissipated + released - work; }
    double defect_linear() const { return energy_linear() - initial_linear + dissipated_linear + released - work; }
    double energy() const { return stored_bulk + stored_interface + load_potential; }
    // Scale with which differences of energies are compared.
    double scale() const { return std::max(std::abs(energy()), std::abs(work)); }
    // Adds the increment and the bounds of a part to those of its step, and the energy that it has dissipated since
    // `before` with the error of that energy: the error of a step is the mean of its parts.
    void add_part(const Ledger& part, const Ledger& before) {
        lower += part.lower;
        increment += part.increment;
        upper += part.upper;
        increment_lower += part.increment_lower;
        const double own = part.dissipated - before.dissipated;
        dissipated += own;
        mixity_error += own > 0.0 ? (part.mixity_error - mixity_error) * own / dissipated : 0.0;
    }
    // Takes the increment, the bounds and the error of a step from its parts.
    void take_parts(const Ledger& sum) {
        lower = sum.lower;
        increment = sum.increment;
        upper = sum.upper;
        increment_lower = sum.increment_lower;
        mixity_error = sum.mixity_error;
    }
    // True if this increment of the same step is lower than the ledger's by more than rounding.
    bool undercut_by(double other) const {
        constexpr double equivalence = 1e-10;  // of the scale
        return other < increment - equivalence * scale();
    }
};

// Cost of a step; the effort of several minimisations adds up.
struct Effort {
    std::int64_t am_iterations = 0;  // alternations of the staggered scheme
    std::int64_t displacement_solves = 0;
    std::int64_t contact_iterations = 0;
    std::int64_t contact_iterations_first = 0;
    std::int64_t contact_iterations_max = 0;
    std::int64_t contact_fallbacks = 0;
    std::int64_t linear_iterations = 0;
    std::int64_t newton_solves = 0;      // solves within the process zone
    std::int64_t debond_moves = 0;       // unstable pairs taken to their debonded branch
    std::int64_t search_candidates = 0;  // states whose energy a search has compared
    double linear_residual = 0.0;        // worst
    std::int64_t linearisations = 0;     // of bodies that rotate

    void add(const Effort& more) {
        am_iterations += more.am_iterations;
        contact_iterations_first = displacement_solves == 0 ? more.contact_iterations_first : contact_iterations_first;
        displacement_solves += more.displacement_solves;
        contact_iterations += more.contact_iterations;
        contact_iterations_max = std::max(contact_iterations_max, more.contact_iterations_max);
        contact_fallbacks += more.contact_fallbacks;
        linear_iterations += more.linear_iterations;
        newton_solves += more.newton_solves;
        debond_moves += more.debond_moves;
        search_candidates += more.search_candidates;
        linearisations += more.linearisations;
        linear_residual = std::max(linear_residual, more.linear_residual);
    }
};

// The largest jump that the path of a step has shown (step/within_step.hpp); none: debonded = 0.
struct JumpWithin {
    static constexpr std::int64_t told_by_search = 2;
    std::int64_t known = 0;       // 1: the step was followed in parts, which tell about jumps; 2: its search has told
    double load = 0.0;            // over that of the end of the step
    double released = 0.0;        // F L
    double debonded = 0.0;        // of all interfaces, L or L2
    double drop = 0.0;            // of the load, relative
    std::int64_t interface = -1;  // the one that debonds most
    std::vector<double> conjugate_before, conjugate_after;  // [patterns] dE/dtheta at this load
};

// Tells where the bodies of a step have buckled: they were in balance, but another state was lower at the same loads.
struct Buckling {
    std::int64_t modes = 0;  // along which the step has left states that were not stable
    double time = 0.0;  // at which the first of these states became so, between those of the states around the step
    std::int64_t node = -1;  // that moves most in its mode
    double released = 0.0;   // energy that the way to the stable state sets free, F L

    void add(const Buckling& later) {
        if (modes == 0) time = later.time, node = later.node;
        modes += later.modes;
        released += later.released;
    }
};

// Outcome of a step.
struct StepOutcome {
    double damage_change = 0.0;    // change that a further damage step would make to an adhesion
    std::int64_t mixity_held = 0;  // pairs whose mixity would not settle and was held
    // Energy of the state kept minus the bound of the candidates left out, F L; 0: none of them can be lower.
    double search_margin = 0.0;
    // State kept minus what bounds the candidates left out, F L; 0: nothing left out can be lower.
    double search_gap = 0.0;
    std::int64_t jumps = 0;   // instants of this step at which the state jumps
    double released = 0.0;    // energy that the step sets free and nothing stores or dissipates, F L
    std::int64_t pops = 0;    // pairs that came apart one by one at one load, because the mesh resolves no zone
    double popped = 0.0;      // part of `released` that they set free, F L
    double turned_off = 0.0;  // unbalanced force over the load that linearisations of rotating bodies leave
    Buckling buckling;
};

// Tells the parts of the next step how the growth of this one went on (step/load_path.hpp).
struct Growth {
    double rate = 0.0;       // da/dlnM of the last part that is not flat, L or L2; 0: not known
    double part_time = 0.0;  // length of the part that would have come next; 0: not known
    double pop_time = 0.0;   // time from one pair that pops to the next; 0: none does
    // These tell what the last single pairs of one mode, so many, dissipated and released, F L: longer parts release
    // the same share.
    double told_pairs = 0.0;
    double told_dissipated = 0.0;
    double told_released = 0.0;
    // 0: steps were taken whole, or there are none; 1: they follow their load; 2: from now on they are taken whole.
    std::int64_t way = 0;
};

// A measure of what small rotations leave out, of the state for which it was computed last, and what of this state
// tells whether it must be computed again (analysis/rotation_watch.hpp).
struct RotationCheck {
    double value = 0.0;
    std::vector<double> loads;     // with which it grows; empty: it was not computed yet
    std::vector<double> damaged;   // [interfaces] share of the area that has lost its adhesion
    std::vector<double> touching;  // [interfaces] share of the area that is closed
};

struct RotationChecks {
    RotationCheck rotation;  // of cells, rad; its loads: [patterns]
    RotationCheck energy;    // that small rotations leave out, of that of the bodies; its load: the rotation
    RotationCheck stresses;  // over the critical ones; its loads: [patterns]
    // The share of the energy of strains that rotations add (Observer::RotationEnergy) that further displacements
    // leave; its loads: [patterns].
    RotationCheck relief;
};

// A part of a load step.
struct StepPart {
    double time;    // its end
    double stride;  // share of its toughness that a pair may dissipate at one load; 0: that of the options
};

// The way in which the step was computed.
struct StepHistory {
    std::int64_t backtracks = 0;     // number of times that this step was computed anew after a return
    std::int64_t revisions = 0;      // number of times that this step was computed anew after a return
    std::int64_t revised_from = 0;   // first step that these returns replaced
    std::int64_t substeps = 1;       // steps that this one was cut into
    std::int64_t refused_steps = 0;  // that were too long and not kept
};

// Derivatives of a state by parameters of the laws (step/sensitivity.hpp); they are followed from the first state on,
// and not saved.
struct Sensitivity {
    std::vector<double> conjugate;  // [parameters][patterns] of dE/dtheta
    std::vector<double> adhesion;   // [parameters][pairs]
    std::vector<double> mixity;     // [parameters][pairs] of the B that the jumps show
    std::vector<double> second;     // [parameters][pairs] of the share S of the second shear, likewise
    std::int64_t unknown = 0;       // pairs whose adhesion came to rest within a step, so far: taken as constant

    // False: nothing is followed, or the state was loaded or set.
    bool known() const { return !conjugate.empty(); }
};

struct State {
    std::int64_t step = 0;
    double time = 0.0;
    std::vector<double> theta;         // [patterns]
    std::vector<double> adhesion;      // [pairs]
    PairMixities mixity;               // [pairs] used for this step's damage
    PairMixities mixity_before;        // [pairs] of the step before
    std::vector<std::uint8_t> closed;  // [pairs]
    std::uint8_t loaded = 0;           // 1 once any pair has had a jump, so that the mixities are meaningful
    Response response;
    std::vector<double> memory;           // of the jump operator
    std::vector<double> search_memory;    // of the operator that a search uses
    std::vector<double> search_energies;  // that the next search may take over
    Ledger ledger;
    Effort effort;
    StepOutcome outcome;
    StepHistory history;
    JumpWithin jump_within;
    Sensitivity sensitivity;
    Growth growth;
    // [rows] jumps at the begin of the part that has led here along the load (step/load_path.hpp); empty: none has, or
    // the next part does not go on in its direction.
    std::vector<double> jump_before;
    // [bodies] the step since which nothing holds all of a body's motions; negative: something does.
    std::vector<std::int64_t> free_since;
    RotationChecks rotations;  // kinematics = auto
};

}  // namespace delam
