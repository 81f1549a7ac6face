// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

constexpr double small_rotation = 0.1;  // rad
constexpr double noticeable = 0.01;     // of the energy: what a ledger may leave open
constexpr double unequal = 0.01;        // adhesions of a pair and its image; half and twice warn alike (test_periodic)
constexpr double of_debonding = 0.02;   // of the energy that debonds all interfaces: from here on an energy counts

}  // namespace

Warnings::Warnings(const Problem& problem, Monitor& monitor) : problem_(problem), monitor_(monitor) {
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& properties = problem.interfaces[i];
        if (properties.bonded || !properties.law) continue;
        const std::vector<double>& weight = problem.mesh->interfaces()[i].weight;
        double area = 0.0;
        for (std::size_t p = 0; p < weight.size(); ++p) area += weight[p] * properties.adhesion[p];
        least_ += of_debonding * area * properties.law->toughness(0.0).total;
    }
}

void Warnings::go_on_from(const Warnings& before) {
    most_ = before.most_;
    told_of_estimate_ = before.told_of_estimate_;
    told_of_ledger_ = before.told_of_ledger_;
    told_of_front_ = before.told_of_front_;
    told_of_rotation_ = before.told_of_rotation_;
    told_of_balance_ = before.told_of_balance_;
}

void Warnings::judge_ledger(const State& after, const Options& options) {
    const Ledger& ledger = after.ledger;
    const double scale = ledger.scale(), eta = options.backtracking_tolerance;
    const double excess = std::max(ledger.lower - ledger.increment, ledger.increment - ledger.upper);
    const std::string where = text("step ", after.step, " at time ", after.time, ": ");
    const char* const once = " (later steps are not reported)";
    if (!told_of_estimate_ && excess > std::max(eta * scale, least_)) {
        monitor_.log(1, text(where, "its energy lies outside its two-sided estimate by ", excess / scale,
                             " of the energy (tolerance ", eta,
                             "): the crack jumps, or the step is too long; shorter steps, backtracking = on and "
                             "solution = energetic tell which",
                             once));
        told_of_estimate_ = true;
    }
    // Each mixity rule closes the ledger in one of the two splits of the interfaces' energy.
    const double open = std::min(std::abs(ledger.defect()), std::abs(ledger.defect_linear()));
    most_ = std::max(most_, scale);  // After unloading, rounding of the largest energy is left.
    if (!told_of_ledger_ && open > std::max(noticeable * most_, least_)) {
        monitor_.log(
            1, text(where, "stored, dissipated and released energy differ from the work of the loads by ", open / most_,
                    " of the energy: take shorter steps, or locate the jump (jump_tolerance)", once));
        told_of_ledger_ = true;
    }
}

void Warnings::judge_symmetry(const PairGraph& graph, const State& before, const State& after) {
    if (after.adhesion == before.adhesion) return;
    if (!symmetries_) symmetries_ = symmetries(problem_);
    const auto difference = [](const State& state, const Symmetry& symmetry, std::size_t p) {
        return std::abs(state.adhesion[p] - state.adhesion[index(symmetry.image[p])]);
    };
    std::string lost, where;
    std::erase_if(*symmetries_, [&](const Symmetry& symmetry) {
        std::size_t worst = 0;
        for (std::size_t p = 0; p < symmetry.image.size(); ++p) {
            if (difference(before, symmetry, p) > unequal) return false;
            if (difference(after, symmetry, p) > difference(after, symmetry, worst)) worst = p;
        }
        if (difference(after, symmetry, worst) <= unequal) return false;
        lost += (lost.empty() ? "" : "; ") + symmetry.name;
        where = text(after.adhesion[worst], " and ", after.adhesion[index(symmetry.image[worst])],
                     " at a pair of interface ", graph.interface_of(worst), " and at its image");
        return true;
    });
    if (lost.empty()) return;
    monitor_.log(1, text("step ", after.step, " at time ", after.time, ": the adhesion loses a symmetry of the scene (",
                         lost, "): ", where, "; the mirrored solution is as good as this one"));
}

// A front has grown if a pair broke: until the first one breaks, the zone is still forming. A zone is cut short where a
// front comes to rest, and was longer before, so the better of both states counts. The energetic solution finds the
// front by its energy, which needs no resolved zone; Griffith's law has no zone.
void Warnings::judge_front(const Observer& observer, const State& before, const State& after) {
    const Problem& problem = observer.problem();
    if (told_of_front_ || problem.options.solution == "energetic") return;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(problem.interfaces.size()); ++i) {
        const std::optional<CrackedInterface> then = observer.cracked(before, i), now = observer.cracked(after, i);
        if (!now || !now->law.softens()) continue;
        bool grown = false;
        for (std::int64_t p = 0; p < static_cast<std::int64_t>(now->adhesion.size()) && !grown; ++p)
            grown = exhausted(*now, p) && !exhausted(*then, p);
        if (!grown) continue;
        double pairs = -1.0;
        for (const CrackedInterface* state : {&*now, &*then}) {
            if (pairs >= resolving_pairs) break;
            for (const CrackFront& front : crack_fronts(*state))
                for (const FrontPoint& point : front.points) pairs = std::max(pairs, point.zone_pairs);
        }
        if (pairs < 0.0 || pairs >= resolving_pairs) continue;
        monitor_.log(1,
                     text("step ", after.step, " at time ", after.time, ": a front of interface ", i, " advanced with ",
                          std::floor(pairs), " pairs in its process zone, but at least ", resolving_pairs,
                          " are needed to resolve it; the load and the length of the growth depend on the mesh: use "
                          "finer cells or solution = energetic (later steps are not reported)"));
        told_of_front_ = true;
        return;
    }
}

void Warnings::judge_rotation(const State& state, double largest) {
    if (!(largest > small_rotation) || told_of_rotation_ || problem_.options.kinematics != "linear") return;
    monitor_.log(1, text("step ", state.step, " at time ", state.time, ": cells rotate by up to ", largest,
                         " rad; strains are linear in the displacements, with an error of about half the square "
                         "of the rotation, ",
                         0.5 * largest * largest, "; kinematics = corotational does without (later steps are not ",
                         "reported)"));
    told_of_rotation_ = true;
}

void Warnings::tell_buckling(const State& state) {
    const Buckling& buckling = state.outcome.buckling;
    if (buckling.modes == 0) return;
    std::string place;
    for (const double x : problem_.mesh->node(buckling.node)) place += text(place.empty() ? "" : ", ", x);
    const std::string freed =
        buckling.released > 0.0 ? text(" and snap through, which releases ", buckling.released) : "";
    monitor_.log(1, text("step ", state.step, ": the bodies buckle at time ", buckling.time, ", most at (", place, ")",
                         freed, "; the state has left the balance that is not stable, along ", buckling.modes,
                         buckling.modes == 1 ? " mode" : " modes"));
}

void Warnings::report_balance(const std::string& what) {
    if (told_of_balance_) return;
    monitor_.log(1, text(what, "; later steps are not reported"));
    told_of_balance_ = true;
}

}  // namespace delam
