// SPDX-License-Identifier: BSD-3-Clause
// Chooses the realisation of the jump operator for a scene, by predicted cost and memory.
//
// Counted, not timed: floating-point operations (a multiplication and an addition are two) and bytes. The sparse
// factor's numbers come from its symbolic analysis and are exact; the others are formulae whose constants were fitted
// to counted analyses (verify/unit/test_choose.cpp holds them to a factor of 1.5 in bytes).
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/memory_limit.hpp"
#include "base/monitor.hpp"
#include "reduction/operator/bound_rows.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/advice/expected_parts.hpp"
#include "scene/problem.hpp"

namespace delam {

// Seconds are operations over this number, and are marked as such wherever they are shown.
inline constexpr double nominal_rate = 20e9;  // operations/s of one core in a large factorisation
// Number of load steps that an analysis is assumed to have.
inline constexpr double nominal_steps = 40.0;
// The condensed analysis may need so many times the memory of one monolithic factorisation, where it needs much.
inline constexpr double memory_ratio = 2.5;
// Rows of a dense matrix that LAPACK with 32-bit integers can address.
inline constexpr std::int64_t dense_limit = 46340;

struct ReductionCost {
    double setup = 0.0;     // operations before the first step
    double longest = 0.0;   // operations of the longest factorisation, which cannot be interrupted
    double step = 0.0;      // operations of a load step
    double bytes = 0.0;     // peak of the analysis, mesh and scene not counted
    double least = 0.0;     // bytes without which it is impossible
    double ordering = 0.0;  // operations of METIS, which cannot be interrupted, before a factorisation of all bodies
    double most = 0.0;      // bytes at the peak where its iterations are many; 0: it does not iterate with vectors
    bool possible = true;   // LAPACK's integers hold its largest dense matrix
    double part = 0.0;      // operations of a minimisation, of which a step has one or more
    double analysis() const { return setup + nominal_steps * step; }
};

enum class Realisation { condensed, iterated, feti, engine };

struct ReductionChoice {
    Realisation realisation = Realisation::condensed;
    bool condensed() const { return realisation == Realisation::condensed; }
    bool forced = false;  // by the options
    std::string reason;
    ReductionCost condensation;  // setup 0: not predicted, because the options or the size had decided
    ReductionCost iteration;
    ReductionCost feti;
    ReductionCost engine;  // nobody knows
    // Returns the cost of the realisation in use.
    const ReductionCost& own() const;
    double monolithic = 0.0;      // bytes of one monolithic factorisation, 0: not predicted
    double factor_entries = 0.0;  // of the operator's sparse factor, 0: not analysed
    std::int64_t unknowns = 0;    // dense rows of the condensed operator
    std::int64_t subdomains = 0;  // FETI's
    double boundary = 0.0;        // DOFs of a subdomain's boundary, mean
    ExpectedParts parts;          // minimisations that the analysis is expected to take
    MemoryLimit memory{std::numeric_limits<double>::infinity(), ""};  // that the analysis may take
};

class Bulk;
class EngineOperator;
struct IteratedSize;
// minimisations: of a step.
ReductionCost predict_condensed(const Bulk& bulk, double minimisations);
// Takes the size from the condensed operator's analysis, without another one.
IteratedSize iterated_size(const Bulk& bulk);
ReductionCost predict_iterated(const IteratedSize& size);
// Entries of the factor of the scene's monolithic matrix, in the best order, and peak bytes of making it.
double predict_monolithic_entries(const Bulk& bulk);
double predict_monolithic_bytes(const Bulk& bulk);
// boundary: out, DOFs, mean over the subdomains.
ReductionCost predict_feti(const Problem& problem, std::int64_t subdomains, double& boundary);
// Why an operator of this cost cannot be built, "": it can.
std::string does_not_fit(const ReductionChoice& choice);
// Decides by the predictions of the condensed and the iterated operator. Pure: for tests.
void choose(ReductionChoice& choice);

// FETI, if the operator that was chosen cannot fit into the memory, and FETI's subdomains can. Pure: for tests.
void prefer_what_fits(ReductionChoice& choice);

// The operator of a scene before anything is factored: its choice, and what has been assembled and analysed for it.
struct Design {
    ReductionChoice choice;
    std::string description;                    // of the operator, for people
    std::string refusal;                        // why it does not fit into the memory, "": it may
    std::vector<std::uint8_t> prescribed;       // [jump rows] 1: the constraints alone determine the jump
    std::vector<BoundRow> bound;                // jumps that supports bind to others
    std::shared_ptr<Bulk> bulk;                 // of the condensed operator; null: it is another realisation
    bool shared = false;                        // the bulk is another solver's, which has condensed it
    std::unique_ptr<JumpOperator> op;           // the iterated operator, which factors nothing before its first solve
    const EngineOperator* in_engine = nullptr;  // the operator's, if the bodies are an engine's of the host

    Design();
    explicit Design(ReductionChoice made);  // that has nothing else
    Design(Design&&) noexcept;
    Design& operator=(Design&&) noexcept;
    ~Design();
};
Design design_operator(const Problem& problem, Monitor& monitor);
// Shares the condensed bodies of another design, whose operator has been built, where that is possible.
Design design_operator(const Problem& problem, Monitor& monitor, const Design& other);
// True if it is: the other one has condensed bodies, supports and loads are equal (hash_of_bodies), and the options ask
// for no other operator. Laws, initial adhesion and histories of loads may differ.
bool shares_bodies(const Problem& problem, const Design& other);
// Factors what must be factored beforehand. Consumes the operator that the design holds; the rest stays. Throws
// Error(DELAM_ERROR_MEMORY) with the design's refusal.
std::unique_ptr<JumpOperator> build_operator(Design& design, const Problem& problem, Monitor& monitor);

}  // namespace delam
