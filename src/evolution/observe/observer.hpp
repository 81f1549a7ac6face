// SPDX-License-Identifier: BSD-3-Clause
// Reads states of an analysis: fields in the bodies, averages over them, crack fronts. Of one state, the one that is
// shown, it keeps what it has computed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/numbers.hpp"
#include "body/averages.hpp"
#include "body/equal/centre_gradients.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "evolution/observe/crack_front.hpp"
#include "evolution/observe/mesh_error.hpp"
#include "reduction/turned/small_rotations.hpp"
#include "scene/problem.hpp"

namespace delam {

class EngineOperator;

// Parts of the elastic energy of the bodies.
struct MeshErrorShares {
    double away = 0.0;    // error in cells away from the fronts of cracks
    double fronts = 0.0;  // error in cells at fronts, where stresses are singular
    double excess = 0.0;  // energy that incompatible modes would take off standard cells
};

class Observer {
public:
    // The arguments must outlive the observer.
    Observer(const Problem& problem, const JumpOperator& op, const PairLaws& pairs, const ContactScene& contact,
             const std::vector<double>& initial_adhesion, const EngineOperator* in_engine)
        : problem_(problem),
          op_(op),
          pairs_(pairs),
          contact_(contact),
          initial_adhesion_(initial_adhesion),
          in_engine_(in_engine) {}

    // Shows a state and discards what was computed of the one before.
    void show(const State& state);
    // The state that is shown lies at another address now.
    void follow(const State& state) { shown_ = &state; }

    const Problem& problem() const { return problem_; }
    const JumpOperator& jump_operator() const { return op_; }
    const PairLaws& pairs() const { return pairs_; }
    const ContactScene& contact() const { return contact_; }
    // Initial adhesion, [pairs].
    const std::vector<double>& initial_adhesion() const { return initial_adhesion_; }
    const State& state() const { return *shown_; }

    // Displacements of the state that is shown, [mesh DOFs], recovered on request.
    const std::vector<double>& displacement();
    // Displacements of any state.
    std::vector<double> displacement(const State& state);
    // True if the engine of the host has recovered the displacements of the state that is shown, and keeps them.
    bool recover_in_engine();
    // Returns how often displacements were recovered.
    std::int64_t recoveries() const { return recoveries_; }
    // Out-of-balance force over the largest reaction.
    double equilibrium_defect(const State& state);
    // Returns the stress at the centres of the cells (centre_stress); NaN for bodies with a stiffness of the host and
    // no material.
    std::vector<double> stress();
    // e* of the bodies, in material axes; empty if there are none.
    std::vector<Strain> eigenstrains() const { return eigenstrains(state()); }
    // Returns the average over a body (index), -1: over all; recovers the displacements where the operator has no
    // reading of them.
    VolumeAverage average(std::int32_t body);
    // Returns the displacement of a node, [dimension]; recovers those of all where the operator has no reading of it.
    std::vector<double> displacement_of(std::int64_t node);
    // Returns the rotations of the cells (centre_rotation); vectors of rotation where they may be large.
    std::vector<double> rotation();
    // Returns the largest rotation of a cell, rad; NaN without cells. Recovers the displacements.
    double largest_rotation(const State& state);
    // Returns what the rotations of a state leave out, of which it knows what it was asked for; null where they are
    // large. Recovers the displacements.
    std::shared_ptr<SmallRotations> small_rotations(const State& state);
    // Returns one of its values, and `large` where rotations are large.
    double left_out(const State& state, double (SmallRotations::*value)(),
                    double large = std::numeric_limits<double>::quiet_NaN());

    // Returns the error of the stored energy that mesh_error.hpp estimates for a state; recovers the displacements.
    // Finite only where the materials of all cells are known and energy is stored.
    MeshErrorShares mesh_error(const State& state);
    // The same cell by cell, of the state that is shown, [cells], F L.
    std::vector<double> mesh_error_of_cells();

    // The interface with its law and its fields of a state; nothing if it has no law.
    std::optional<CrackedInterface> cracked(const State& state, std::int64_t interface) const;
    // Fronts of the cracks of an interface in the state that is shown; none if it has no law.
    const std::vector<CrackFront>& crack_fronts(std::int64_t interface);

private:
    // The averages over a body from jumps and loads.
    struct AverageReadings {
        AverageWeights rest;  // without weights of displacements
        std::array<LinearReading, 6> strain, stress;
    };
    // Returns null if the operator has none.
    const AverageReadings* average_readings(std::int32_t body);
    // Returns the readings of the displacement of a node, [dimension]; empty if the operator has none.
    const std::vector<LinearReading>& node_readings(std::int64_t node);
    bool known(std::int32_t body) const { return problem_.material[index(body)].has_value(); }
    // Returns the model of each body; undefined where the material is unknown.
    std::vector<BodyModel> models() const;
    std::vector<Strain> eigenstrains(const State& state) const;
    SmallRotations::Holding holding(const State& state) const;
    MeshError estimate(const State& state);
    const CentreGradients& centres();
    // Displacement gradients at the centres of the cells (CentreGradients::slopes), of the state that is shown.
    const std::vector<double>& slopes();

    const Problem& problem_;
    const JumpOperator& op_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
    const std::vector<double>& initial_adhesion_;
    const State* shown_ = nullptr;
    const EngineOperator* in_engine_;
    std::vector<double> displacement_;                            // empty: not recovered
    std::vector<double> slopes_;                                  // empty: not computed
    std::optional<CentreGradients> centres_;                      // nothing: not yet needed
    std::unique_ptr<MeshErrorEstimate> estimates_;                // null: not yet needed
    std::vector<std::optional<std::vector<CrackFront>>> fronts_;  // [interfaces]
    std::optional<MeshErrorShares> mesh_error_;                   // nothing: not estimated
    std::shared_ptr<SmallRotations> small_rotations_;             // null: not needed
    // These are made when they are first asked for, and then used always: so a resumed analysis has the same digits.
    std::map<std::int32_t, std::optional<AverageReadings>> averages_;
    std::map<std::int64_t, std::vector<LinearReading>> nodes_;
    std::int64_t recoveries_ = 0;
};

}  // namespace delam
