// SPDX-License-Identifier: BSD-3-Clause
// The zone of total FETI: a dense energy of the jumps where springs change, found from the columns of the dual
// operator.
//
// The set A consists of the rows whose springs differ from those of the base and of all wanted rows, rounded up to the
// groups in which columns are found. Rows outside A have the springs of the base, and the columns have them minimised
// out. The groups of wanted rows are the zone; the other rows of A are minimised out at their present springs. Rows of
// A that depend on others in it (where interfaces meet) are combinations of these and no unknowns. The zone depends on
// the scene, the springs and the wanted rows alone: kept columns equal those that would be found again.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reduction/dense/dense_zone.hpp"
#include "reduction/feti/jump_columns.hpp"
#include "reduction/feti/jump_equations.hpp"

namespace delam {

class FetiZone {
public:
    FetiZone(const Problem& problem, const std::vector<Subdomain>& subdomains, DualOperator& dual,
             const DualLoads& loads, Monitor& monitor);
    // Null: A is too large, or its columns cannot be found well enough.
    DenseZone* zone(const Springs& springs, std::span<const std::uint8_t> wanted);

private:
    // Unknowns of the zone and what the others are minimised out at, over A.
    struct Split {
        std::vector<std::int64_t> kept;
        std::vector<double> spring;  // of the others, -1: held; 0 for those kept
        bool operator==(const Split&) const = default;
    };
    std::vector<std::int64_t> changed(const Springs& springs, std::span<const std::uint8_t> wanted) const;
    bool allowed(std::span<const std::int64_t> rows) const;
    bool find_energy(std::vector<std::int64_t> wanted);
    // False: the springs are so stiff that nothing is left of the energy.
    bool take_out_springs();
    void find_motions(std::span<const std::int64_t> changed);
    Split split(const Springs& springs, std::span<const std::uint8_t> wanted) const;
    bool minimise_out(Split split);
    ZoneMotions floating() const;

    const Problem& problem_;
    DualOperator& dual_;
    Monitor& monitor_;
    JumpColumns columns_;
    JumpEquations equations_;
    RigidMotions motions_;
    const DenseMatrix& rigid_;  // their jumps, [jump rows][motions]

    std::vector<std::int64_t> changed_;                // A; empty: none is known
    std::vector<std::int64_t> rows_;                   // of A, independent
    std::vector<JumpEquations::Dependent> dependent_;  // of A, by places in rows_
    DenseEnergy energy_;                               // of A, over rows_
    std::vector<std::int64_t> anchors_;  // of rows_: with these kept, the others hold every motion that A lets go
    Split split_;
    std::unique_ptr<Condensation> rest_;
    std::unique_ptr<DenseZone> zone_;
};

}  // namespace delam
