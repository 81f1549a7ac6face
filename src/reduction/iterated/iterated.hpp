// SPDX-License-Identifier: BSD-3-Clause
// The jump operator for large scenes: the bodies stay sparse, and each solve is an iteration that starts from the
// solution before (reanalysis.hpp). No dense matrix of the jumps, and a factorisation of the whole only where it pays.
#pragma once

#include <memory>

#include "reduction/iterated/iterated_zone.hpp"
#include "reduction/iterated/local_zone.hpp"
#include "reduction/iterated/reanalysis.hpp"
#include "reduction/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Numbers from which its cost follows.
struct IteratedSize {
    double variables = 0.0;
    double stiffness = 0.0;    // entries of K
    double transformed = 0.0;  // of T^T K T
    FactorSize factor;         // of the whole
    double stored = 0.0;       // numbers that the factor stores
    double columns = 0.0;      // stored for constraints on many variables
    double factors = 1.0;      // kept at a time
    double softening = 1.0;    // interfaces that may be damaged
};

class Iterated final : public JumpOperator {
public:
    // `problem` must outlive the operator. Nothing is factored before the first solve.
    Iterated(const Problem& problem, Monitor& monitor);
    Iterated(const Problem& problem, AssembledBodies bodies, Monitor& monitor);
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    bool aim(Accuracy accuracy) override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    double rounding_energy(std::span<const double> theta, const Response& response) const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return reanalysis_.system().prescribed(); }
    std::int64_t factorisations() const override { return reanalysis_.factorisations(); }
    std::int64_t recoveries() const override { return recoveries_; }
    std::string description() const override;
    std::vector<double> memory() const override { return reanalysis_.memory(); }
    void recall(std::span<const double> memory) override { reanalysis_.recall(memory); }
    void require_memory(std::span<const double> memory) const override { reanalysis_.require_memory(memory); }

    bool offers_zone() const override { return true; }
    bool zone_is_whole() const override { return true; }
    // Its steps are solved to a residual far below the tolerance of the damage.
    double zone_rounding() const override { return problem_.options.damage_tolerance; }
    Zone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) override;
    Zone* part(std::span<const double> theta, const Response& response, std::span<const std::uint8_t> wanted) override;

    IteratedSize size() const;
    const JumpVariables& variables() const { return bodies_.variables(); }

private:
    double tolerance() const;
    void rest(const Springs& springs, std::span<const double> theta, Response& response) const;
    // Jumps, forces and energies from the variables.
    void respond(const Springs& springs, std::span<const double> theta, Response& response) const;
    void find_energies(std::span<const double> theta, std::span<const double> mu, Response& response) const;

    const Problem& problem_;
    Monitor& monitor_;
    std::unique_ptr<BodySystem> system_;
    BodySystem& bodies_;
    std::vector<double> strain_energy_;  // [patterns][patterns] W of the eigenstrains
    Reanalysis reanalysis_;
    std::unique_ptr<IteratedZone> zone_;  // once they are asked for
    std::unique_ptr<LocalZone> part_;
    Accuracy accuracy_ = Accuracy::usual;
    mutable std::int64_t recoveries_ = 0;
};

}  // namespace delam
