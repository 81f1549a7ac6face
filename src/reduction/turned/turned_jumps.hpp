// SPDX-License-Identifier: BSD-3-Clause
// Interfaces whose frames turn: jumps of pairs, and the forces on the nodes that belong to tractions.
//
// A pair turns by R of sum_c m_c R_c = R U (polar decomposition) over the frames R_c of the cells that touch its nodes,
// half of the weight on either side, so that a reflection or an exchange of the sides changes nothing. Its rows are q_r
// = R q_r0, its jump is j_r = q_r . (u_b - u_a) + gap. As j depends on the frames of the cells, tractions t pull at the
// nodes by t_r q_r and turn the cells by couples, without which the forces would have no energy (J. Mosler, I.
// Scheider, J. Mech. Phys. Solids 59 (2011) 1647-1668):
//
//     M_c = m_c R (tr S I - S)^T J^-1 R^T sum_r t_r q_r x (u_b - u_a),    S = R^T R_c, J = tr U I - U.
//
// The cells are those along the way where faces have slid against each other (slide_paths.hpp). Their weights then
// change with the slide s_r = q_r . (u_b - u_a), in the frame that the pair has without it: tractions also pull along
// the slide.
//
// An obstacle is a plane, which moves and does not turn: the frames of its pairs stay, and their cells feel no couple.
//
// Faces that are turned against each other by more than 120 degrees have been apart for long and cannot touch, nor do
// those that would lie deeper in each other than a cell is large: the normal of such a pair is the direction from one
// place to the other, so that it is open, whatever the angle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "body/turned/turned_bodies.hpp"
#include "reduction/turned/slide_paths.hpp"
#include "scene/carriers.hpp"
#include "scene/problem.hpp"

namespace delam {

class TurnedJumps {
public:
    // The arguments must outlive it.
    TurnedJumps(const Problem& problem, const Carriers& carriers);

    // Turns the frames with the bodies, which have been moved to these displacements.
    void move(const TurnedBodies& bodies, std::span<const double> displacement);
    // Returns the frames of an interface as InterfaceGeometry has them.
    const std::vector<double>& frames(std::size_t interface) const { return frames_[interface]; }
    // Returns the jumps, [rows].
    std::vector<double> jumps(std::span<const double> theta) const;
    // Returns what the frames of a mesh leave out of the jumps, [rows]: (q - q_mesh) . (u_b - u_a).
    std::vector<double> beyond(const Mesh& mesh) const;
    // Adds to the forces on the nodes [mesh DOFs] what forces of the rows cause: pulls, couples, or what pulls along
    // slides.
    void add_pulls(std::span<const double> row_force, std::span<double> force) const;
    void add_couples(const TurnedBodies& bodies, std::span<const double> row_force, std::span<double> force) const;
    void add_slides(const TurnedBodies& bodies, std::span<const double> row_force, std::span<double> force) const;
    // Returns the longest slide of pairs that pull, over their distance from the next pair.
    double longest_slide(std::span<const double> row_force) const;
    // Returns the sum of the pulls of an interface on its second side.
    Vector3 pull_of(std::size_t interface, std::span<const double> row_force) const;
    // Takes from the forces the pulls that they cause in the frames of a mesh.
    void subtract_pulls(const Mesh& mesh, std::span<const double> row_force, std::span<double> force) const;

private:
    using Touching = std::vector<std::pair<std::int64_t, double>>;  // cell, m_c; empty: of an obstacle
    struct Turn {
        Matrix3 rotation{}, stretch{};
    };
    // The frames along the way on which a pair has slid.
    struct Slid {
        double length;  // over the spacing of the pairs
        Turn turn;
        Touching cells;
        std::vector<std::pair<std::int64_t, Vector3>> slope;  // cell, change of its m_c with the slide, 1/L
    };
    struct Pair {
        Turn turn;        // as if it had not slid
        Vector3 apart{};  // u_b - u_a
        std::optional<Slid> slid;
    };
    // Sets the turn of a pair with a normal that is not turned. False: it is open, whatever the angle.
    static bool turn(const TurnedBodies& bodies, const Touching& cells, const Vector3& normal, const Vector3& apart,
                     Turn& turn);
    // Returns the frames of a pair that has slid; none: it has not, or is open by more than a cell.
    std::optional<Slid> slide(const TurnedBodies& bodies, std::size_t interface, std::size_t pair) const;
    // Returns how a pair's tractions turn its frame, in this frame: J^-1 R^T sum_r t_r q_r x (u_b - u_a).
    static Vector3 turning(const Turn& turn, const Vector3& pull, const Vector3& apart);
    static void add_couples(const TurnedBodies& bodies, const Turn& turn, const Touching& cells, const Vector3& turning,
                            std::span<double> force);
    // Calls visit(interface, pair, pull) for pairs of bodies that pull.
    template <class Visit>
    void each_pulled(std::span<const double> row_force, const Visit& visit) const;
    void add_pull(const InterfaceGeometry& interface, std::size_t pair, const Vector3& pull,
                  std::span<double> force) const;
    Vector3 apart(const InterfaceGeometry& interface, std::size_t p, std::span<const double> displacement) const;
    void pull(std::size_t interface, std::span<const double> frames, std::span<const double> row_force, double factor,
              std::span<double> force) const;

    const Problem& problem_;
    const Carriers& carriers_;
    std::size_t dimension_;
    // [interfaces][pairs] of half the weight on either side; the sum is that of a pair that has not slid
    std::vector<std::vector<Touching>> first_, second_, touching_;
    std::vector<SlidePaths> paths_;            // [interfaces]
    std::vector<std::vector<Pair>> pairs_;     // [interfaces][pairs]
    std::vector<std::vector<double>> frames_;  // [interfaces]
};

}  // namespace delam
