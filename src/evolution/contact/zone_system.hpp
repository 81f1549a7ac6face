// SPDX-License-Identifier: BSD-3-Clause
// A zone of the jump operator as a system with contact: springs or tangents on its rows, forces of their own, and the
// normal rows of its pairs that may open and close.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/contact/active_set.hpp"
#include "evolution/contact/contact.hpp"
#include "reduction/operator/zone.hpp"

namespace delam {

class ZoneSystem {
public:
    // held: [jump rows] of the whole scene, when the zone is entered. poll: called in every solve. The zone, the scene
    // and theta must outlive the system.
    ZoneSystem(Zone& zone, const ContactScene& scene, std::span<const std::uint8_t> prescribed,
               std::span<const std::uint8_t> held, std::span<const double> theta, Poll poll = {});

    const Zone& zone() const { return zone_; }
    Zone& zone() { return zone_; }
    const ContactRows& contact_rows() const { return contact_; }
    // The contact set with which the zone was entered, [contact rows].
    const std::vector<std::uint8_t>& entered_closed() const { return entered_; }
    // First zone row of a pair of which the zone has all rows, [pairs found], with the pair.
    struct Pair {
        std::size_t pair;
        std::size_t first;
    };
    const std::vector<Pair>& pairs() const { return pairs_; }

    // Sets what acts on the rows from now on: the force of a row is sum_q C_rq j_q - h_r. row_force: h, [zone rows] or
    // empty.
    void load(std::vector<Zone::Coupling> couplings, std::vector<double> row_force);
    // The same about an iterate of Newton's method.
    void load_model(std::vector<Zone::Coupling> couplings, std::vector<double> row_force);

    ContactSolve solve(const std::vector<std::uint8_t>& closed);
    // Zone::flexibility of what is loaded, with this contact set.
    std::optional<DenseMatrix> flexibility(const std::vector<std::uint8_t>& closed,
                                           std::span<const std::vector<Zone::RowForce>> forces);
    std::span<const double> jump() const { return jump_; }
    // Forces on the rows; that of a closed contact row is the force of contact alone. Where a model of a softening pair
    // pulls at a jump of zero, the force of the pair would open the row, and the open row would penetrate.
    std::span<const double> force() const { return force_; }
    double jump_floor() const { return scene_.jump_floor(theta_); }
    double force_floor() const {
        return std::max(scene_.force_floor(theta_),
                        scene_.rounding_of_forces(theta_, jump_, zone_.jump_rows()) / contact_rounding);
    }
    // Jumps of the rows of the whole scene, near which free parts stay.
    void stay_near(std::span<const double> jump);
    // The operator has to tell what stops a part.
    std::vector<std::size_t> caught(const ContactRows&, const std::vector<std::uint8_t>&) const { return {}; }
    std::vector<std::size_t> settle(const ContactRows& rows, std::vector<std::uint8_t>& closed, std::uint8_t level,
                                    const SolveError& least);
    bool softens() const;
    SolveError error() const { return solution_.error; }
    bool rough() const { return false; }
    // The operator, which checks the end of a minimiser, decides what is in doubt here.
    static constexpr std::int64_t guesses = 0;
    bool tighten() { return false; }
    // The last solve.
    const Zone::Solution& solution() const { return solution_; }
    // Krylov iterations of all solves.
    std::int64_t iterations() const { return iterations_; }
    // Zone rows that are held with this contact set.
    std::vector<std::uint8_t> held(const std::vector<std::uint8_t>& closed) const;

protected:
    // The couplings that are loaded.
    std::span<const Zone::Coupling> couplings() const { return couplings_; }

private:
    Zone& zone_;
    const ContactScene& scene_;
    std::span<const double> theta_;
    Poll poll_;
    ContactRows contact_;
    std::vector<std::uint8_t> entered_;
    std::vector<Pair> pairs_;
    std::vector<std::uint8_t> held_;  // [zone rows]
    std::vector<Zone::Coupling> couplings_;
    std::vector<double> row_force_;
    std::vector<double> jump_, force_;
    std::vector<double> near_;  // [zone rows] or empty
    Zone::Solution solution_;
    std::int64_t iterations_ = 0;
};

}  // namespace delam
