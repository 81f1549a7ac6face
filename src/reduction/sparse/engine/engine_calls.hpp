// SPDX-License-Identifier: BSD-3-Clause
// The functions of an engine of the host (scene/engine.hpp) with the library's own types. Answers that are not finite
// are refused.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/body_solver.hpp"
#include "reduction/sparse/engine/engine_state.hpp"
#include "scene/engine.hpp"

namespace delam {

// Entries of a matrix as the engine takes them.
class EngineEntries {
public:
    EngineEntries() = default;
    // Leaves out zeros.
    explicit EngineEntries(const SparseMatrix& matrix);
    void add(std::int64_t row, std::int64_t column, double value);
    // Points into this object.
    delam_experimental_entries view() const {
        return {static_cast<std::int64_t>(rows_.size()), rows_.data(), columns_.data(), values_.data()};
    }

private:
    std::vector<std::int64_t> rows_, columns_;
    std::vector<double> values_;
};

class EngineCalls {
public:
    EngineCalls(std::shared_ptr<Engine> engine, Monitor& monitor) : engine_(std::move(engine)), monitor_(monitor) {}
    ~EngineCalls();
    EngineCalls(const EngineCalls&) = delete;
    EngineCalls& operator=(const EngineCalls&) = delete;

    // True if the engine has the variables that prepare() has given it. Another operator may have taken its place.
    bool prepared() const { return engine_->owner == this; }
    struct Sizes {
        std::vector<double> diagonal;  // of T^T K T
        std::vector<double> loads;     // [patterns]
    };
    Sizes prepare(const BodySystem& bodies);
    void set(const EngineEntries& couplings, std::span<const std::int64_t> fixed, std::span<const std::int64_t> pivots,
             const EngineEntries& masters) const;
    // Returns how many iterations the new preconditioner is worth, as the engine says.
    double renew(const EngineEntries& entries) const;

    struct Question {
        std::span<const double> theta, force, right;
        std::span<const double> start;  // weights of kept answers; empty: none
        std::size_t place = 0;
        double tolerance = 0.0;
        std::int64_t limit = 0;
        const BodySolver::Forcing& forcing;
        bool reading = false;  // only a request made during the call stops it
    };
    struct Answer {
        delam_experimental_answer numbers{};  // without the arrays
        std::vector<double> state;            // but for the rigid motions
        std::vector<double> correction, correction_balance;
        std::vector<double> products;  // with the kept answers
        bool definite() const { return numbers.definite != 0; }
        bool converged() const { return numbers.converged != 0; }
    };
    // Answers with numbers that are of no use where the bodies are not definite.
    Answer solve(const Question& question, const EngineLayout& at) const;

    // Computes u and K u of a combination of kept answers.
    void recover(std::span<const double> weights, std::span<double> displacement, std::span<double> stressed) const;
    // Does the same, but the engine keeps them. moved: rigid motions to be added, empty: none. False: it cannot add
    // them.
    bool recover_within(std::span<const double> weights, std::vector<double> moved) const;

private:
    const delam_experimental_engine& functions() const { return engine_->functions(); }

    std::shared_ptr<Engine> engine_;
    Monitor& monitor_;
};

}  // namespace delam
