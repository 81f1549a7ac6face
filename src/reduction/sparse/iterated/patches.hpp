// SPDX-License-Identifier: BSD-3-Clause
// Patches of the bodies around rows whose springs differ from those of the whole factor, factored exactly. Parts that
// do not touch are factors of their own. While what differs stays well inside, the patches stay, and only those are
// factored again whose springs have changed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/sparse/iterated/constraint_columns.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class Patches {
public:
    // Takes from system.limits() the rings of elements about the variables that differ, fewer where the patches would
    // otherwise have more than a share of all variables.
    explicit Patches(const JumpSystem& system);

    // Chooses patches where those at hand do not cover the seeds, variables whose springs differ, ascending. False:
    // they would have more than that share with a single ring, and are only chosen if any size will do.
    bool cover(std::span<const std::int64_t> seeds, bool any_size, const Poll& poll);
    // Factors the patches at these springs where they are others than at the last time. False: one is not positive
    // definite.
    bool factorise(std::span<const Triplet> springs, const Poll& poll);
    // z += P r
    void add(std::span<const double> r, std::span<double> z) const;

    std::int64_t variables() const;
    // [variables] whether a patch has it
    std::span<const std::uint8_t> members() const { return member_; }
    std::int64_t count() const { return static_cast<std::int64_t>(patches_.size()); }
    double cost() const { return cost_; }  // operations of choosing patches, since the beginning
    double flops() const;                  // of factoring all of them
    double entries() const;                // of all factors
    // The seeds of the present choice, on which alone it depends.
    const std::vector<std::int64_t>& seeds() const { return seeds_; }
    // The margin of the present choice is less than that asked for.
    bool narrow() const { return narrow_; }
    void forget();

private:
    struct Patch {
        std::vector<std::int64_t> variables;  // ascending
        SparseMatrix matrix;                  // without springs
        std::vector<Triplet> springs;         // of the factor, in the patch's own variables
        std::vector<SparseVector> equations;  // constraints on many, independent, likewise
        std::unique_ptr<SparseCholesky> factor;
        ConstraintColumns constraints;
        bool factored = false;
    };
    std::int64_t margin_within_share(std::span<const std::int64_t> ring) const;
    Patch make(std::vector<std::int64_t> variables, const Poll& poll);
    void take_equations(Patch& patch) const;
    bool factorise(Patch& patch, std::span<const Triplet> springs);

    const JumpSystem& system_;
    std::int64_t margin_;
    double share_;
    bool narrow_ = false;
    std::vector<std::uint8_t> barred_;  // variables of constraints on many that are large parts' own: control nodes
    std::vector<std::int64_t> seeds_;
    std::vector<std::uint8_t> inner_;  // [variables] at most half the margin from a seed of the choice
    std::vector<std::uint8_t> member_;
    std::vector<Patch> patches_;
    double cost_ = 0.0;
};

}  // namespace delam
