// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "evolution/contact/active_set.hpp"
#include "evolution/contact/loose_rows.hpp"

namespace delam {

namespace {

// Part of the largest jump or prescribed displacement by which rounding may press faces. (Measured by
// verify/bench/constants.py on 250 random scenes: half and twice decide alike.)
constexpr double pressed = 1e-9;
// `stiff_contact` is relative to the bodies' stiffness against the row, `noticed` to the largest displacement. Rows
// that nothing contradicts give way by about 1e-6. (Measured with verify/cases/contact/random_scenes.py --scenes 300
// and on 15 hard scenes, such as seeds 639, 1152, 3674 and, with feti, 35 and 66: half and twice of either decide
// alike; without them these end after 200 sets.)
constexpr double stiff_contact = 1e6;
constexpr double noticed = 1e-4;
// Residual of an iteration that has found no forces at all: 1 where contacts contradict each other (the same scenes),
// less in the solves of case d-aspect of the report that end above their tolerance. (Measured by
// verify/bench/constants.py on 250 random scenes: half and twice decide alike; at 10 nothing gives way, and 8 scenes by
// FETI, such as seeds 35 and 66, end elsewhere.)
constexpr double hopeless = 0.1;

// Returns by how much rounding may press faces into each other, L.
double rounding_of_jumps(const ContactScene& scene, std::span<const double> jump, std::span<const double> theta) {
    return pressed * std::max({max_abs(jump), scene.jump_floor(theta), scene.prescribed_size(theta)});
}

// closed: [pairs] of a contact set, whose rows and constraints may leave a closed pair no choice but to be pressed, or
// a bonded one but to open. Empty: the set is not final, and only pairs that constraints press are refused.
void refuse_pressed(const ContactScene& scene, std::span<const std::uint8_t> prescribed,
                    std::span<const std::uint8_t> closed, const Response& response, std::span<const double> theta) {
    const auto dim = index(scene.dimension);
    const double deepest = -std::max(rounding_of_jumps(scene, response.jump, theta), response.error.jump);
    for (std::size_t p = 0; p < scene.bonded.size(); ++p)
        if (scene.bonded[p] == 0 && (!scene.may_close(p, prescribed) || (!closed.empty() && closed[p] != 0)) &&
            response.jump[p * dim] < deepest)
            fail(DELAM_ERROR_PROBLEM, "prescribed displacements press two faces into each other at pair ", p,
                 " (normal jump ", response.jump[p * dim], " < 0)");
    for (std::size_t r = 0; r < response.jump.size() && !closed.empty(); ++r)
        if (scene.bonded[r / dim] != 0 && std::abs(response.jump[r]) > -deepest)
            fail(DELAM_ERROR_PROBLEM, "prescribed displacements press faces in contact so that pair ", r / dim,
                 " opens by ", std::abs(response.jump[r]), ", but its interface is bonded permanently");
}

// Names the load that no contact set balances, and the motion along which it acts.
[[noreturn]] void refuse_free_load(const ContactScene& scene, const Springs& springs, std::span<const double> theta) {
    std::string load = "a dead force", parts = "a part";
    if (scene.parts != nullptr) {
        std::vector<std::uint8_t> active(springs.held);
        for (std::size_t r = 0; r < active.size(); ++r)
            if (springs.stiffness[r] > 0.0) active[r] = 1;
        const FreeParts& known = *scene.parts;
        const DenseMatrix free = known.free(active);
        const DeadWork& dead = known.motions().dead_work();
        double most = 0.0;
        for (std::int64_t c = 0; c < free.columns; ++c) {
            const auto combination = column(free, c);
            if (dead.balances(theta, combination)) continue;
            for (std::size_t p = 0; p < theta.size(); ++p) {
                double work = 0.0;
                for (std::size_t i = 0; i < combination.size(); ++i)
                    work += theta[p] * dead.work(static_cast<std::int64_t>(p), static_cast<std::int64_t>(i)) *
                            combination[i];
                if (!(std::abs(work) > most)) continue;
                most = std::abs(work);
                load = text("the dead force of pattern '", known.pattern(p), "'");
                DenseMatrix one(free.rows, 1);
                std::copy(combination.begin(), combination.end(), one.value.begin());
                parts = known.described(known.moves(one));
            }
        }
    }
    fail(DELAM_LIMIT, "no equilibrium: ", load, " acts on ", parts,
         ", which neither adhesion, supports nor contact hold");
}

// The normal rows of all pairs that may close.
ContactRows contact_rows(const ContactScene& scene, std::span<const std::uint8_t> prescribed, bool cold) {
    const auto dim = index(scene.dimension);
    ContactRows rows;
    rows.least = rows.first = scene.least_level;
    if (cold && !scene.level.empty()) rows.first = *std::max_element(scene.level.begin(), scene.level.end());
    for (std::size_t p = 0; p < scene.bonded.size(); ++p) {
        if (!scene.may_close(p, prescribed) || scene.level[p] < rows.least) continue;
        rows.row.push_back(p * dim);
        rows.level.push_back(scene.level[p]);
    }
    return rows;
}

class OperatorSystem {
public:
    static constexpr std::int64_t guesses = 3;

    // cold: nothing is known of the set, and any row may change.
    OperatorSystem(JumpOperator& op, const ContactScene& scene, const ContactRows& rows, Springs springs,
                   std::span<const double> theta, Response& response, ContactResult& result, bool cold,
                   PlacesBefore* before)
        : op_(op),
          scene_(scene),
          rows_(rows),
          springs_(std::move(springs)),
          theta_(theta),
          response_(response),
          result_(result),
          before_(before) {
        // Hundreds of rows change from one of the first sets to the next: rough answers tell which.
        if (rows.first > rows.least && op_.aim(Accuracy::rough)) accuracy_ = Accuracy::rough;
        if (cold) op_.expect_changes(rows.row);
    }
    OperatorSystem(const OperatorSystem&) = delete;
    OperatorSystem& operator=(const OperatorSystem&) = delete;
    ~OperatorSystem() {
        op_.aim(Accuracy::usual);
        op_.expect_changes({});
    }

    ContactSolve solve(const std::vector<std::uint8_t>& closed) {
        for (std::size_t i = 0; i < closed.size(); ++i) springs_.held[rows_.row[i]] = closed[i];
        jump_before_ = response_.jump;
        // Forces of stiff springs are millions of times larger than those of bodies: what starts there keeps their
        // rounding.
        if (gave_way_) response_.multipliers.clear();
        gave_way_ = false;
        op_.solve(springs_, theta_, response_);
        if (!response_.balanced) {
            response_.jump = jump_before_;
            return ContactSolve::unbalanced;
        }
        if (contradicted()) give_way(closed);
        result_.linear_iterations += response_.iterations;
        if (!rough()) result_.linear_residual = std::max(result_.linear_residual, response_.residual);
        result_.converged = result_.converged && response_.converged;
        if (scene_.always) refuse_pressed(scene_, op_.prescribed_rows(), {}, response_, theta_);
        return ContactSolve::solved;
    }
    const Springs& springs() const { return springs_; }
    std::span<const double> jump() const { return response_.jump; }
    std::span<const double> force() const { return response_.force; }
    double jump_floor() const { return scene_.jump_floor(theta_); }
    double force_floor() const {
        return std::max(scene_.force_floor(theta_),
                        scene_.rounding_of_forces(theta_, response_.jump) / contact_rounding);
    }
    std::vector<std::size_t> settle(const ContactRows& rows, std::vector<std::uint8_t>& closed, std::uint8_t level,
                                    const SolveError& least);
    std::vector<std::size_t> caught(const ContactRows& rows, const std::vector<std::uint8_t>& closed) const;
    SolveError error() const { return response_.error; }
    bool rough() const { return accuracy_ == Accuracy::rough; }
    bool tighten() {
        if (accuracy_ == Accuracy::tight) return false;
        const bool was_rough = rough();
        accuracy_ = was_rough ? Accuracy::usual : Accuracy::tight;
        return op_.aim(accuracy_) || was_rough;
    }

private:
    bool contradicted() const;
    void give_way(const std::vector<std::uint8_t>& closed);

    JumpOperator& op_;
    const ContactScene& scene_;
    const ContactRows& rows_;
    Springs springs_;
    std::span<const double> theta_;
    Response& response_;
    ContactResult& result_;
    PlacesBefore* before_;
    std::vector<double> jump_before_;  // the last solve; empty: there was none
    bool gave_way_ = false;            // the response is one with stiff springs in place of contacts
    Accuracy accuracy_ = Accuracy::usual;
};

// True if supports, bonds and closed contacts contradict each other: rows are not where they are held, or an iteration
// has not found forces that hold them.
bool OperatorSystem::contradicted() const {
    if (!response_.converged) return response_.residual > hopeless;
    const double least = rounding_of_jumps(scene_, response_.jump, theta_);
    for (std::size_t r = 0; r < springs_.held.size(); ++r)
        if (springs_.held[r] != 0 && std::abs(response_.jump[r]) > least) return true;
    return false;
}

// Replaces closed contacts that contradict each other by springs much stiffer than the bodies: their forces say which
// of them open. Where nothing contradicts, these springs hardly give way, and the response stays what it was.
void OperatorSystem::give_way(const std::vector<std::uint8_t>& closed) {
    if (scene_.row_stiffness.empty()) return;
    Springs stiff = springs_;
    std::vector<std::size_t> contacts;
    for (std::size_t i = 0; i < closed.size(); ++i) {
        const std::size_t r = rows_.row[i];
        if (closed[i] == 0 || !(scene_.row_stiffness[r] > 0.0)) continue;
        contacts.push_back(r);
        stiff.held[r] = 0;
        stiff.stiffness[r] = stiff_contact * scene_.row_stiffness[r];
        if (!stiff.force.empty()) stiff.force[r] = 0.0;
    }
    if (contacts.empty()) return;
    Response given;
    try {
        op_.solve(stiff, theta_, given);
    } catch (const Error& error) {  // rounding of the stiff springs has made the bodies' stiffness indefinite
        if (error.status() != DELAM_ERROR_NUMERICAL) throw;
        return;
    }
    response_.iterations += given.iterations;
    if (!given.balanced || !given.converged) return;
    double most = 0.0;
    for (const std::size_t r : contacts) most = std::max(most, std::abs(given.jump[r]));
    if (!(most > noticed * max_abs(op_.displacement(theta_, given)))) return;
    given.iterations = response_.iterations;
    response_ = std::move(given);
    gave_way_ = true;
}

std::vector<std::size_t> OperatorSystem::settle(const ContactRows& rows, std::vector<std::uint8_t>& closed,
                                                std::uint8_t level, const SolveError& least) {
    if (scene_.parts == nullptr) return {};
    const FreeParts& parts = *scene_.parts;
    const LooseRows loose(rows, closed, response_.force, level, least.force);
    const DenseMatrix free = parts.free(loose.active(springs_.held, springs_.stiffness));
    if (free.columns == 0) return {};

    // Least change of the places: min int |u + D a - u_before|^2 dV.
    const std::vector<double> now = op_.displacement(theta_, response_);
    std::vector<double> change(now.size(), 0.0);
    if (before_ != nullptr) {
        if (!before_->displacement().empty()) change = before_->displacement();
        add_scaled(-1.0, now, change);
    }
    const PlaceChanges places = parts.changes(free);
    const DenseMatrix jumps = multiply(parts.motions().jumps(), free);
    double least_jump = least.jump;
    // A part may come from far away. What the rounding of that motion leaves is penetration once the jumps are small: a
    // second motion takes it back.
    for (int pass = 0; true; ++pass) {
        std::vector<double> pull;
        for (const std::vector<double>& moved : places.moved) pull.push_back(parts.product(moved, change));
        const LeastMotion found = loose.keep_apart(places.gram, pull, jumps, response_.jump, least_jump);
        std::vector<double> combination(index(free.rows)), jump(index(jumps.rows)), displacement(now.size(), 0.0);
        multiply(free, found.motion, combination);
        multiply(jumps, found.motion, jump);
        for (std::size_t c = 0; c < places.moved.size(); ++c)
            add_scaled(found.motion[c], places.moved[c], displacement);
        op_.move(displacement, combination, jump, response_);
        const double present = least_of_contact(*this, response_.error).jump;
        if (pass > 0 || !found.blocked.empty() || !(present < LooseRows::left * least_jump))
            return loose.settled(found, closed, response_.jump, response_.force, least_jump);
        add_scaled(-1.0, displacement, change);
        least_jump = present;
    }
}

std::vector<std::size_t> OperatorSystem::caught(const ContactRows& rows,
                                                const std::vector<std::uint8_t>& closed) const {
    if (scene_.parts == nullptr) return {};
    const FreeParts& parts = *scene_.parts;
    const std::vector<double> none(springs_.stiffness.size(), 0.0);
    // Closed rows hold, whatever their force.
    LooseRows loose(rows, closed, none, rows.least, -1.0);
    const DenseMatrix free = parts.free(loose.active(springs_.held, springs_.stiffness));
    if (free.columns == 0) return {};
    const DeadWork& dead = parts.motions().dead_work();
    std::vector<double> work(index(free.rows)), pull(index(free.columns));
    multiply_transposed(dead.work, theta_, work);
    multiply_transposed(free, work, pull);
    return loose.stopping(parts.changes(free).gram, pull, multiply(parts.motions().jumps(), free),
                          response_.jump.empty() ? none : response_.jump);
}

// A response that is there already.
struct ResponseSystem {
    const ContactScene& scene;
    std::span<const double> theta;
    const Response& response;

    ContactSolve solve(const std::vector<std::uint8_t>&) const { return ContactSolve::solved; }
    std::span<const double> jump() const { return response.jump; }
    std::span<const double> force() const { return response.force; }
    double jump_floor() const { return scene.jump_floor(theta); }
    double force_floor() const {
        return std::max(scene.force_floor(theta), scene.rounding_of_forces(theta, response.jump) / contact_rounding);
    }
};

}  // namespace

DenseMatrix free_motions(const JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                         std::span<const double> theta, std::span<const std::uint8_t> closed,
                         const Response& response) {
    if (scene.parts == nullptr) return {};
    // Contact can only hold more than adhesion does.
    const std::vector<std::uint8_t> none(closed.size(), 0);
    if (scene.parts->connected(with_springs(held_rows(scene, none), stiffness))) return {};
    const ContactRows rows = contact_rows(scene, op.prescribed_rows(), false);
    std::vector<std::uint8_t> set;
    for (const std::size_t row : rows.row) set.push_back(closed[row / index(scene.dimension)]);
    const double least = least_of_contact(ResponseSystem{scene, theta, response}).force;
    const LooseRows loose(rows, set, response.force, rows.least, least);
    return scene.parts->free(loose.active(held_rows(scene, closed), stiffness));
}

std::vector<std::size_t> pairs_on_the_wrong_side(const JumpOperator& op, const ContactScene& scene,
                                                 std::span<const double> theta, std::span<const std::uint8_t> closed,
                                                 const Response& response) {
    const auto dim = index(scene.dimension);
    const ContactRows rows = contact_rows(scene, op.prescribed_rows(), false);
    std::vector<std::uint8_t> set;
    for (const std::size_t row : rows.row) set.push_back(closed[row / dim]);
    std::vector<std::size_t> pairs;
    for (const std::size_t i : contact_violators(ResponseSystem{scene, theta, response}, rows, set, rows.least))
        pairs.push_back(rows.row[i] / dim);
    return pairs;
}

double ContactScene::rounding_of_forces(std::span<const double> theta, std::span<const double> jump,
                                        std::span<const std::int64_t> row_of) const {
    double size = floor(carried_force, theta);
    for (std::size_t r = 0; r < jump.size() && !row_stiffness.empty(); ++r)
        size = std::max(size, row_stiffness[row_of.empty() ? r : index(row_of[r])] * std::abs(jump[r]));
    return force_rounding * size;
}

std::vector<std::uint8_t> touching_pairs(const ContactScene& scene, const JumpOperator& op, double scene_size,
                                         std::span<const double> jump) {
    constexpr double rounding_gap = 1e-9;  // of the scene: smaller gaps are rounding
    const auto dim = index(scene.dimension);
    std::vector<std::uint8_t> touching(jump.size() / dim, 0);
    for (std::size_t p = 0; p < touching.size(); ++p)
        if (scene.may_close(p, op.prescribed_rows()) && jump[p * dim] < rounding_gap * scene_size) touching[p] = 1;
    return touching;
}

std::vector<std::uint8_t> held_rows(const ContactScene& scene, std::span<const std::uint8_t> closed) {
    const auto dim = index(scene.dimension);
    std::vector<std::uint8_t> held(closed.size() * dim, 0);
    for (std::size_t p = 0; p < closed.size(); ++p)
        for (std::size_t c = 0; c < dim; ++c)
            held[p * dim + c] = scene.bonded[p] != 0 || (c == 0 && closed[p] != 0) ? 1 : 0;
    return held;
}

bool held_by_contact_alone(const ContactScene& scene, std::span<const double> stiffness) {
    if (scene.parts == nullptr) return false;
    std::vector<std::uint8_t> active = held_rows(scene, std::vector<std::uint8_t>(scene.bonded.size(), 0));
    for (std::size_t r = 0; r < active.size(); ++r)
        if (stiffness[r] != 0.0) active[r] = 1;
    return scene.parts->free(active).columns > 0;
}

ContactResult solve_contact(JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                            std::span<const double> theta, std::vector<std::uint8_t>& closed, Response& response,
                            bool cold, std::span<const double> row_force, PlacesBefore* before) {
    const auto dim = index(scene.dimension);
    const ContactRows rows = contact_rows(scene, op.prescribed_rows(), cold);
    if (rows.first > rows.least) std::fill(closed.begin(), closed.end(), std::uint8_t{0});
    std::vector<std::uint8_t> set;  // of the contact rows
    for (const std::size_t row : rows.row) set.push_back(closed[row / dim]);
    ContactResult result;
    OperatorSystem system(
        op, scene, rows,
        {{stiffness.begin(), stiffness.end()}, held_rows(scene, closed), {row_force.begin(), row_force.end()}}, theta,
        response, result, cold, before);
    const ActiveSet found = find_active_set(system, rows, set, scene.limit);
    result.solves = found.solves;
    result.doubts = found.doubts;
    result.fallback = found.descended;
    // From a set that is far off, faces come apart pair by pair; coarse sets first take fewer solves.
    if (!cold && found.last == ContactSolve::solved && !found.settled) {
        const ContactRows coarse = contact_rows(scene, op.prescribed_rows(), true);
        if (coarse.first > coarse.least) {
            ContactResult again = solve_contact(op, scene, stiffness, theta, closed, response, true, row_force, before);
            if (again.converged) again.solves += result.solves;  // otherwise the limit is told
            again.linear_iterations += result.linear_iterations;
            return again;
        }
    }
    if (found.last != ContactSolve::solved) refuse_free_load(scene, system.springs(), theta);
    result.converged = result.converged && found.settled;
    for (std::size_t i = 0; i < set.size(); ++i) closed[rows.row[i] / dim] = set[i];
    refuse_pressed(scene, op.prescribed_rows(), result.converged ? closed : std::vector<std::uint8_t>{}, response,
                   theta);
    return result;
}

}  // namespace delam
