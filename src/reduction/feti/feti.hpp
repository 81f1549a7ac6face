// SPDX-License-Identifier: BSD-3-Clause
// Total FETI as a jump operator: all bodies are cut into floating subdomains; supports, gluing and interfaces act
// through multipliers.
//
//   [ F + C   -G^T ] [lambda]   [ B K^+ f - c ]        u = K^+ (f - B^T lambda) + R alpha
//   [ -G        0  ] [alpha ] = [ -R^T f      ]        F = B K^+ B^T,  G = R^T B^T
//
// C is the compliance 1/s of the springs on jump rows, zero elsewhere; a row with s = 0 carries no force and is left
// out, and its jump follows from u (Zeman, Kruzik, Gruber, PANM 15 (2010), "FETI formulation", "Dual problem", "Active
// set strategy").
#pragma once

#include <memory>

#include "base/monitor.hpp"
#include "reduction/feti/dual/dual_loads.hpp"
#include "reduction/feti/dual/dual_operator.hpp"
#include "reduction/feti/dual/parts.hpp"
#include "reduction/feti/feti_zone.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

class Feti final : public JumpOperator, private Zones {
public:
    Feti(const Problem& problem, Monitor& monitor);
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    void move(std::span<const double> displacement, std::span<const double> combination, std::span<const double> jump,
              Response& response) const override;
    std::vector<double> row_stiffness() const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return dual_.scaling().prescribed; }
    std::int64_t factorisations() const override {
        return static_cast<std::int64_t>(parts_.subdomains.size()) - (parts_.subdomains.back().body < 0 ? 1 : 0);
    }
    Zones* zones() override { return this; }
    DenseZone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) override;
    std::string description() const override;

private:
    // The columns are right to 1e-12 of the bodies' flexibility, and an unstable pair multiplies what they are off.
    ZoneTraits zone_traits() const override { return {.rounding = 1e-6}; }
    Poll condensing();
    std::vector<double> local_displacement(std::size_t subdomain, std::span<const double> theta,
                                           const Response& response) const;

    const Problem problem_;
    Monitor& monitor_;
    FetiParts parts_;
    DualOperator dual_;
    DualLoads loads_;
    std::unique_ptr<FetiZone> zone_;  // once it is asked for
};

}  // namespace delam
