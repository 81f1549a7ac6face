// SPDX-License-Identifier: BSD-3-Clause
// Minimises the displacements on the cuts, and all jumps that do not change, out of the energy of the skeleton of
// superelements; an energy of the jumps of the zone remains.
//
// A node adds the energies that its children have left and its own entries, and eliminates what it owns,
//     F = [F_ee F_er; F_re F_rr],   L L^T = F_ee + springs,   V = L^-1 F_er,   F_rr - V^T V   goes on to its parent
// (the multifrontal method: I. Duff, J. Reid, ACM TOMS 9, 1983), where r are the jumps of the zone below and the
// border. The zone is eliminated last, at the lowest node that has all of it below. The energies of the rest of the
// tree come down to this node from the root in the same way, as messages do in a tree of cliques (S. Lauritzen, D.
// Spiegelhalter, J. R. Stat. Soc. B 50, 1988). A change of springs or of the zone renews the nodes on its path alone.
// Other loads pass through the factors that are there. The energy that a node leaves depends on the springs, the zone
// and the loads, not on earlier ones.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/front.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/dense/dense_energy.hpp"

namespace delam {

class Elimination {
public:
    enum class Last { zone, root };
    // `bodies` must outlive it. load: of the skeleton, [places][patterns]. last: where the elimination ends.
    Elimination(const Superelements& bodies, DenseMatrix load, Last last = Last::zone);

    // States of a jump: a spring s >= 0 with which it is minimised out, or one of these.
    static constexpr double held = -1.0;
    static constexpr double in_zone = -2.0;
    // state: [places]; 0 for displacements. Throws Error(DELAM_ERROR_NUMERICAL) if nothing holds what is eliminated;
    // then nothing is left that could be used.
    void update(std::span<const double> state, const Poll& poll);
    // Takes other loads of the skeleton. Until the next update there is no energy.
    void take_loads(DenseMatrix load);
    const DenseMatrix& loads() const { return load_; }
    // Energy of the kept displacements, then the jumps of the zone, in ascending order.
    const DenseEnergy& energy() const { return last_.energy; }
    const std::vector<std::int64_t>& places() const { return last_.left; }
    // All of the skeleton from the unknowns of energy().
    void recover(std::span<const double> theta, std::span<const double> left, std::span<double> skeleton) const;
    // S x = b on the displacements of the cuts, with all jumps and kept displacements at rest; in place, b: [places].
    // All jumps must be held or in the zone, and the elimination must end at the root.
    void solve_cuts(std::span<double> b) const;

private:
    // The fronts whose energies a front adds, in this order: those of the node's own tree, and what is outside of it;
    // null: nothing is.
    struct Inputs {
        std::vector<const TreeFront*> inside;
        const TreeFront* outside;
    };
    std::int64_t lowest_with_the_zone() const;
    bool older(const TreeFront& front, std::span<const std::int64_t> own, std::initializer_list<std::int64_t> bordered,
               const Inputs& inputs) const;
    void refresh_last(const Poll& poll);
    void refresh_below(std::int64_t node, const Poll& poll);
    void refresh_outside(std::int64_t node, const Poll& poll);
    void divide_node(TreeFront& front, const Superelements::Node& node, const TreeFront* outside) const;
    void divide_outside(TreeFront& front, std::int64_t node) const;
    std::vector<const TreeFront*> children(const Superelements::Node& node) const;
    void add_all(TreeFront& front, const Superelements::Node& own, const Inputs& inputs);
    void add_own(TreeFront& front, const Superelements::Node& node);
    void add_own_loads(TreeFront& front, const Superelements::Node& node);
    void eliminate(TreeFront& front, const Poll& poll);
    // Renews the loads of a front whose factor stays. own: the node whose loads enter it.
    void reload(TreeFront& front, const Superelements::Node& own, const Inputs& inputs);
    void recover_below(std::int64_t node, std::span<const double> theta, std::span<double> skeleton) const;

    // [places], the update at which the state changed, and at which it began or ceased to be held or in the zone: a
    // subtree needs to know no more of its border.
    std::vector<std::int64_t> changed_, changed_kind_;
    std::int64_t updates_ = 0, loads_ = 0;
    std::vector<std::int64_t> parent_;        // [nodes]
    std::vector<TreeFront> below_, outside_;  // [nodes] what the subtree leaves, and what all else leaves to it
    TreeFront last_;                          // at the lowest node with all of the zone
    std::int64_t last_node_ = -1;
    Last ends_at_;
    const Superelements& bodies_;
    DenseMatrix load_;
    std::vector<double> state_;
    FrontBuilder builder_;
    bool interrupted_ = false;  // an update was, by an exception
};

}  // namespace delam
