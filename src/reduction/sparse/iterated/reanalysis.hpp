// SPDX-License-Identifier: BSD-3-Clause
// Solves the system of bodies and interfaces repeatedly, while its springs change little (global/local reanalysis; P.
// Gosselet, M. Blanchard, O. Allix, G. Guguin, AMSES 5, 2018). Conjugate gradients are preconditioned by a factor of
// the whole with earlier springs. Exact factors of patches around the springs that differ act before and after it
// (multiplicative Schwarz, symmetric).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/body_solver.hpp"
#include "reduction/sparse/floating.hpp"
#include "reduction/sparse/iterated/conjugate_gradients.hpp"
#include "reduction/sparse/iterated/lagged_factor.hpp"
#include "reduction/sparse/iterated/patches.hpp"
#include "reduction/sparse/iterated/schwarz.hpp"
#include "reduction/sparse/jump_system.hpp"
#include "reduction/sparse/renewal.hpp"

namespace delam {

class Reanalysis final : public BodySolver {
public:
    // transformed: T^T K T of the bodies
    Reanalysis(const BodySystem& bodies, SparseMatrix transformed, Monitor& monitor);

    bool set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) override;
    Answer solve(std::span<const double> theta, std::span<const double> row_force, double tolerance,
                 std::vector<double>& x, const Forcing& forcing = {}) override;
    std::vector<double> held_forces(std::span<const double> theta, std::span<const double> x,
                                    std::span<double> force) const override;
    double load_size(std::span<const double> theta) const override;
    Work work(std::span<const double> theta, std::span<const double> x) override;
    double energy_rounding(std::span<const double> theta, std::span<const double> x) override;
    void recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                 std::vector<double>& stressed) override;

    const JumpSystem& system() const override { return system_; }
    std::int64_t state_size() const override { return system_.count(); }
    const Floating& floating() const override { return floating_; }
    void move(std::span<const double>, std::span<const double> combination, std::span<double> x) const override {
        add_scaled(1.0, floating_.in_variables(combination), x);
    }
    // g = T^T (f - K U theta)
    std::vector<double> load(std::span<const double> theta) const;
    std::int64_t factorisations() const override { return factor_.factorisations(); }
    const WholeFactor* whole() const { return &factor_.whole(); }
    const Patches& patches() const { return patches_; }

    // True for an analysis that solves other states and comes back.
    static bool keeps_two_factors(const Problem& problem);

    std::vector<double> memory() override;
    void recall(std::span<const double> memory) override;
    void require_memory(std::span<const double> memory) const override;

private:
    // Variables of rows whose springs differ from those of the factor.
    std::vector<std::int64_t> changed() const;
    bool plain() const;
    bool cover(bool any_size);
    bool factorise_patches();
    void renew(std::vector<double> springs);
    std::vector<double> history() const;
    void renew_now();  // at the springs that act
    std::vector<double> right_side(std::span<const double> theta, std::span<const double> row_force) const;
    double work_of_couplings(std::span<const double> x) const;
    double size_of(std::span<const double> theta, std::span<const double> x) const;
    bool confirm(std::span<const double> right, std::span<const double> theta, std::span<const double> x,
                 std::span<const double> residual) const;
    double rounding_at(std::span<const double> right, std::span<const double> x);
    std::vector<double> start_from(std::span<const double> right, std::span<const double> theta,
                                   std::span<double> x) const;
    SolveError error_of(std::span<const double> correction, double least) const;
    double iteration_cost() const;
    bool weak_directions(std::vector<Direction>& given) const;
    CgOutcome iterate(CgSystem& cg, double tolerance, std::span<double> x);
    std::int64_t affordable() const;  // iterations that cost less than a new factor

    const BodySystem& bodies_;
    Monitor& monitor_;
    JumpSystem system_;
    Floating floating_;
    Patches patches_;
    LaggedFactor factor_;
    Schwarz preconditioner_;
    std::vector<std::vector<double>> load_;  // [patterns][variables]
    Renewal renewal_;                        // its price and excess in operations
    bool attempt_ = false;  // too much differs for wide patches, but the factor is still the one before
    double rounded_ = 0.0;  // rounding of a residual, relative; 0: not yet met with this factor
};

}  // namespace delam
