// SPDX-License-Identifier: BSD-3-Clause
// The jump operator whose bodies stay sparse: each solve is an iteration that starts from the solution before. Who
// iterates is left to a BodySolver; what follows from its solutions (jumps, forces, energies) is here.
#pragma once

#include <functional>
#include <memory>

#include "reduction/operator/jump_operator.hpp"
#include "reduction/sparse/body_solver.hpp"
#include "reduction/sparse/iterated_zone.hpp"
#include "scene/problem.hpp"

namespace delam {

class SparseOperator : public JumpOperator, protected Zones {
public:
    ~SparseOperator() override;
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    bool aim(Accuracy accuracy) override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    double rounding_energy(std::span<const double> theta, const Response& response) const override;
    void move(std::span<const double> displacement, std::span<const double> combination, std::span<const double> jump,
              Response& response) const override;
    std::vector<double> row_stiffness() const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return solver_.system().rows().prescribed(); }
    std::int64_t factorisations() const override { return solver_.factorisations(); }
    std::vector<double> memory() override { return solver_.memory(); }
    void recall(std::span<const double> memory) override { solver_.recall(memory); }
    void require_memory(std::span<const double> memory) const override { solver_.require_memory(memory); }

    Zones* zones() override { return this; }
    Zone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) override;

    const JumpVariables& variables() const { return bodies_->variables(); }

protected:
    // The steps of a zone are solved to a residual far below the tolerance of the damage.
    ZoneTraits zone_traits() const override { return {.whole = true, .rounding = problem_.options.damage_tolerance}; }
    using SolverOf = std::function<std::unique_ptr<BodySolver>(const BodySystem& bodies)>;
    // `problem` must outlive the operator. solver: called once, when the loads of the bodies are known.
    SparseOperator(const Problem& problem, Monitor& monitor, std::unique_ptr<BodySystem> bodies,
                   const SolverOf& solver);

    const Problem& problem() const { return problem_; }
    Monitor& monitor() const { return monitor_; }
    const BodySystem* system() const override { return bodies_.get(); }
    BodySolver& solver() const { return solver_; }

private:
    double tolerance() const;
    void rest(const Springs& springs, std::span<const double> theta, Response& response) const;
    // Jumps, forces and energies from the variables.
    void respond(const Springs& springs, std::span<const double> theta, Response& response) const;
    void find_energies(std::span<const double> theta, std::span<const double> mu, Response& response) const;
    std::vector<double> stressed(std::span<const double> theta, const Response& response,
                                 std::vector<double>& displacement) const;

    const Problem& problem_;
    Monitor& monitor_;
    std::unique_ptr<BodySystem> bodies_;
    std::vector<double> strain_energy_;  // [patterns][patterns] W of the eigenstrains
    std::unique_ptr<BodySolver> own_;
    BodySolver& solver_;
    std::unique_ptr<IteratedZone> zone_;  // once they are asked for
    Accuracy accuracy_ = Accuracy::usual;
};

}  // namespace delam
