// SPDX-License-Identifier: BSD-3-Clause
// The baseline of every comparison: what a competent engineer would write in an afternoon.
//
// Plain alternate minimisation with the monolithic matrix. CHOLMOD's symbolic analysis is kept; the numeric
// factorisation is repeated whenever an adhesion or the contact set has changed, and only then; the active set starts
// from the last one. Iterates, acceptance of contact, mixity and stopping test are those of the library's plain
// alternate minimisation.
#pragma once

#include <functional>
#include <optional>

#include "monolithic.hpp"
#include "record.hpp"

namespace bench {

struct BaselineOptions {
    double delta = 1e-5;
    std::int64_t minimisation_limit = 100000;
    std::int64_t contact_limit = 200;
    bool wide = false;  // CHOLMOD's 64-bit indices
};

class Baseline {
public:
    // One law for all interfaces; `adhesion` is the initial one, [pairs]. The constructor solves for the state at time
    // 0.
    Baseline(const reference::Scene& scene, const reference::LawData& law, std::vector<double> adhesion,
             const BaselineOptions& options);

    // Computes and commits one load step. Calls `stop` before each linear system; if it returns true, the step is
    // abandoned and nothing is returned.
    std::optional<StepRecord> advance(double time, const std::function<bool()>& stop = {});

    const std::vector<double>& adhesion() const { return adhesion_; }
    const std::vector<double>& mixity() const { return mixity_; }  // of the last step
    const std::vector<double>& jump() const { return jump_; }
    const std::vector<std::uint8_t>& closed() const { return closed_; }
    const Monolithic& system() const { return system_; }
    const SparseFactor& factor() const { return factor_; }
    std::int64_t factorisations() const { return static_cast<std::int64_t>(factor_seconds_.size()); }
    // Times of single numeric factorisations, and of the rest of an active-set step (assembly, solve, tests).
    const std::vector<double>& factor_seconds() const { return factor_seconds_; }
    const std::vector<double>& solve_seconds() const { return solve_seconds_; }

private:
    struct Stopped {};
    bool displace(const std::vector<double>& theta, StepRecord& record, const std::function<bool()>& stop);
    void solve_linear(const std::vector<double>& theta);
    void damage_step(const std::vector<double>& old, std::vector<double>& next) const;
    double traction_change(const std::vector<double>& next) const;
    void update_mixity();
    double driving(std::size_t pair, std::size_t component) const;  // Y_n (0) or Y_t (1)
    double stored_bulk(const std::vector<double>& theta) const;
    double stored_interface() const;
    double dissipation(const std::vector<double>& old) const;

    const reference::Scene* scene_;
    reference::LawData data_;
    reference::Law law_;
    BaselineOptions options_;
    std::size_t dimension_;
    Monolithic system_;
    SparseFactor factor_;

    std::vector<double> adhesion_;
    std::vector<double> mixity_;
    std::vector<double> jump_;   // [jumps]
    std::vector<double> force_;  // [jumps], tension positive
    std::vector<std::uint8_t> closed_;
    bool loaded_ = false;
    double dissipated_ = 0.0;

    std::vector<double> v_, b_, spring_, factored_spring_;
    std::vector<std::uint8_t> held_, factored_held_;
    std::vector<double> factor_seconds_, solve_seconds_;
};

}  // namespace bench
