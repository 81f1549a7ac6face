// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/condensed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/operator/body_reactions.hpp"

namespace delam {

Condensed::Condensed(std::shared_ptr<Bulk> bulk, const Problem& problem, Monitor& monitor, std::int64_t before)
    : bulk_(std::move(bulk)),
      problem_(problem),
      monitor_(monitor),
      choice_(*bulk_, problem_),
      elimination_(bulk_->elimination()),
      before_(before) {
    for (const JumpRow& row : bulk_->rows()) prescribed_.push_back(row.prescribed() ? 1 : 0);
}

bool Condensed::renew(Renewed what) {
    forget_zone();
    solved_ = {};
    choice_.expect_changes({});
    if (!bulk_->renew(what, monitor_)) return false;
    choice_.renew();
    if (what == Renewed::loads) {
        elimination_->take_loads(bulk_->elimination().loads());
        return true;
    }
    elimination_.emplace(bulk_->elimination());
    tree_.reset();
    tree_offered_ = false;
    return true;
}

Poll Condensed::poll() {
    return [this] { monitor_.progress("zone", condensations_, 0); };
}

bool Condensed::covers(const Springs& springs) const { return zone_ != nullptr && choice_.covers(springs); }

// The zone is missing from the choice to the end of condense(), so that an interrupted one is never taken for valid.
void Condensed::choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) {
    choice_.choose(springs, wanted, tight);
    forget_zone();
    condense();
}

void Condensed::forget_zone() {
    zone_ = nullptr;
    dense_.reset();
    by_tree_.reset();
    energy_.reset();
}

// The rows of the zone whose unknowns are these.
std::vector<std::int64_t> Condensed::rows_of(std::span<const std::uint8_t> inside) const {
    std::vector<std::int64_t> zone_rows;
    const auto dim = index(problem_.mesh->dimension());
    const auto row_inside = [&](std::size_t r) {
        const JumpRow& row = bulk_->rows()[r];
        return !row.prescribed() && inside[index(row.unknowns.front().first)] != 0;
    };
    for (std::size_t r = 0; r < bulk_->rows().size(); ++r) {
        // A prescribed row comes with the others of its pair, because the minimisers in the zone need whole pairs.
        bool in = row_inside(r);
        if (bulk_->rows()[r].prescribed())
            for (std::size_t other = r / dim * dim; other < (r / dim + 1) * dim; ++other) in = in || row_inside(other);
        if (in) zone_rows.push_back(static_cast<std::int64_t>(r));
    }
    return zone_rows;
}

// The zone at the present choice.
void Condensed::condense() {
    monitor_.progress("zone", condensations_, 0);
    ++condensations_;
    forget_zone();
    std::vector<std::uint8_t> active(choice_.unknowns(), 0);
    for (std::size_t i = 0; i < active.size(); ++i)
        active[i] = choice_.inside()[i] == 0 && choice_.spring()[i] != 0.0 ? 1 : 0;
    if (tree_pays(active)) {
        by_tree_ = std::make_unique<TreeZone>(*bulk_, *tree_, choice_, rows_of(choice_.inside()), solved_, poll());
        zone_ = by_tree_.get();
    } else {
        condense_dense(active);
        zone_ = dense_.get();
    }
}

// True if the zone is factored with the whole tree in fewer operations than as a dense matrix, by a margin. Motions
// that only the zone holds need a dense one. That of a single interface is a stretch through few cuts, whose dense
// factor follows a front by updates.
bool Condensed::tree_pays(std::span<const std::uint8_t> active) {
    const Limits& limits = problem_.options.limits;
    std::vector<std::int64_t> places;
    for (std::size_t i = 0; i < active.size(); ++i)
        if (choice_.inside()[i] != 0) places.push_back(bulk_->equations().place(static_cast<std::int64_t>(i)));
    const auto n = static_cast<double>(places.size());
    if (n < limits.zone_tree_least || problem_.mesh->interfaces().size() < 2) return false;
    if (tree_ == nullptr) {
        tree_ = std::make_unique<TreeFactor>(bulk_->superelements());
        tree_offered_ = TreeZone::offered_by(*bulk_, *tree_, problem_.mesh->dimension());
    }
    if (!tree_offered_ || !(n * n * n / 3.0 > limits.zone_tree * tree_->operations(places))) return false;
    return bulk_->rigid().columns == 0 || split_motions(bulk_->rigid(), active).free.columns == 0;
}

void Condensed::condense_dense(std::span<const std::uint8_t> active) {
    std::vector<double> state(choice_.spring());
    for (std::size_t i = 0; i < state.size(); ++i)
        if (choice_.inside()[i] != 0) state[i] = Elimination::in_zone;
    elimination_->update(bulk_->equations().states(state), poll());
    energy_ = std::make_unique<ZoneEnergy>(bulk_->zone_energy(*elimination_, poll()));
    const std::vector<std::int64_t>& zone_unknowns = energy_->unknowns();

    std::vector<std::int64_t> place(choice_.unknowns(), -1);
    std::vector<std::uint8_t> inside(place.size(), 0);
    for (std::size_t z = 0; z < zone_unknowns.size(); ++z) {
        place[index(zone_unknowns[z])] = static_cast<std::int64_t>(z);
        inside[index(zone_unknowns[z])] = 1;
    }
    std::vector<std::int64_t> zone_rows = rows_of(inside);
    std::vector<JumpRow> rows;
    for (const std::int64_t r : zone_rows) {
        const JumpRow& row = bulk_->rows()[index(r)];
        JumpRow local{{}, row.offset};
        for (const auto& [i, n] : row.unknowns) {
            if (place[index(i)] < 0) fail(DELAM_ERROR_INTERNAL, "an unknown of row ", r, " is not in its zone");
            local.unknowns.emplace_back(place[index(i)], n);
        }
        rows.push_back(std::move(local));
    }
    ZoneMotions floating = ZoneMotions::of(bulk_->rigid(), bulk_->dead_work(), active, zone_unknowns);
    dense_ = std::make_unique<DenseZone>(energy_->energy(), std::move(rows), std::move(zone_rows), std::move(floating),
                                         poll());
}

Zone* Condensed::zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) {
    std::vector<std::uint8_t> unknowns(choice_.unknowns(), 0);
    bool inside = covers(springs);
    const auto rows = index(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}));
    const auto members = energy_ != nullptr
                             ? energy_->unknowns().size()
                             : index(std::count(choice_.inside().begin(), choice_.inside().end(), std::uint8_t{1}));
    if (tight && inside && members > 2 * rows + index(problem_.options.limits.zone_small)) {
        choice_.let_go();
        inside = false;
    }
    for (std::size_t r = 0; r < wanted.size(); ++r) {
        if (wanted[r] == 0) continue;
        for (const auto& [i, n] : bulk_->rows()[r].unknowns) {
            unknowns[index(i)] = 1;
            inside = inside && choice_.inside()[index(i)] != 0;
        }
    }
    if (!inside) {
        if (zone_ != nullptr) choice_.add_changed(springs, unknowns);
        choose(springs, unknowns, tight);
    }
    return zone_;
}

void Condensed::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    std::vector<double> now = choice_.springs_of(springs);
    const bool all_held = std::all_of(now.begin(), now.end(), [](double s) { return s < 0.0; });
    // Without a load nothing moves, exactly.
    std::vector<double> load(now.size());
    multiply(bulk_->load(), theta, load);
    bool loaded = std::any_of(load.begin(), load.end(), [](double v) { return v != 0.0; });
    for (std::size_t r = 0; r < springs.force.size(); ++r)
        loaded = loaded || (springs.force[r] != 0.0 && springs.held[r] == 0);
    for (const JumpRow& row : bulk_->rows()) loaded = loaded || (!row.offset.empty() && dot(row.offset, theta) != 0.0);
    if (all_held || !loaded) {
        respond(springs, theta, bulk_->skeleton_at_rest(theta), {}, response);
        return;
    }
    const std::vector<std::uint8_t> wanted = choice_.changed_since_last(now);
    const bool unmet = choice_.take_unmet();
    if (unmet || !covers(springs)) choose(springs, wanted, false);
    if (!springs.force.empty()) {
        std::vector<std::uint8_t> pulled(springs.force.size());
        for (std::size_t r = 0; r < pulled.size(); ++r) pulled[r] = springs.force[r] != 0.0 ? 1 : 0;
        zone(springs, pulled, false);
    }
    choice_.solved_at(std::move(now));

    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held(zone_->jump_rows().size());
    for (std::size_t z = 0; z < zone_->jump_rows().size(); ++z) {
        const auto r = index(zone_->jump_rows()[z]);
        if (prescribed_[r] != 0) continue;  // constant: no unknown, whether held or not
        held[z] = springs.held[r];
        if (held[z] == 0 && springs.stiffness[r] > 0.0)
            couplings.push_back({static_cast<std::int64_t>(z), static_cast<std::int64_t>(z), springs.stiffness[r]});
    }
    zone_->ask_for_energies(0.0);
    if (!zone_->factor(couplings, held))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness of the process zone (", zone_->jump_rows().size(),
             " rows) is not positive definite");
    std::vector<double> force(springs.force.empty() ? 0 : zone_->jump_rows().size());
    for (std::size_t z = 0; z < force.size(); ++z) force[z] = springs.force[index(zone_->jump_rows()[z])];
    if (by_tree_ == nullptr) {
        complete(springs, theta, zone_->solve(theta, force), response);
    } else {
        respond(springs, theta, by_tree_->skeleton(theta, force), {}, response);
        solved_ = {{theta.begin(), theta.end()}, choice_.springs_of(springs), response.jump};
    }
}

bool Condensed::complete(const Springs& springs, std::span<const double> theta, const Zone::Solution& solution,
                         Response& response) const {
    if (by_tree_ != nullptr) return false;
    response.balanced = solution.balanced;
    if (!solution.balanced) return true;
    std::vector<double> skeleton(bulk_->superelements().variable().size());
    elimination_->recover(theta, energy_->recover(theta, solution.unknowns), skeleton);
    respond(springs, theta, skeleton, solution.multiplier, response);
    return true;
}

// Along the minimiser S x = L theta - sum_r N_r^T lambda_r, which gives the energies without another product with S:
//   stored + potential = 1/2 (x.L theta - sum lambda_r (N x)_r) - x.L theta + 1/2 theta.A theta,   dE/dtheta = A theta
//   - L^T x + O^T lambda
void Condensed::respond(const Springs& springs, std::span<const double> theta, std::span<const double> skeleton,
                        std::span<const double> multiplier, Response& response) const {
    response.balanced = true;
    const std::size_t unknowns = choice_.unknowns(), rows = bulk_->rows().size();
    std::vector<double> load(unknowns, 0.0);
    const std::vector<double> x = bulk_->equations().unknowns_at(skeleton);
    multiply(bulk_->load(), theta, load);

    response.jump.assign(rows, 0.0);
    response.force.assign(rows, 0.0);
    std::vector<double> offset(rows, 0.0);
    std::vector<std::uint8_t> held(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) held[i] = springs.held[index(bulk_->row_of_unknown()[i])];
    std::vector<double> left = bulk_->residual(theta, skeleton, held);
    for (std::size_t z = 0; z < multiplier.size(); ++z) response.force[index(zone_->jump_rows()[z])] = multiplier[z];
    for (std::size_t r = 0; r < rows; ++r) {
        const JumpRow& row = bulk_->rows()[r];
        if (!row.offset.empty()) offset[r] = dot(row.offset, theta);
        if (springs.held[r] == 0) {
            response.jump[r] = offset[r];
            for (const auto& [i, n] : row.unknowns) response.jump[r] += n * x[index(i)];
            response.force[r] = springs.stiffness[r] * response.jump[r];
            if (!springs.force.empty()) response.force[r] -= springs.force[r];
        } else if (!row.unknowns.empty()) {
            response.jump[r] = held_jump(row, offset[r], x);
        }
        const bool own = row.unknowns.size() == 1 &&
                         bulk_->row_of_unknown()[index(row.unknowns.front().first)] == static_cast<std::int64_t>(r);
        if (!own)
            for (const auto& [i, n] : row.unknowns) left[index(i)] -= n * response.force[r];
    }
    for (std::size_t i = 0; i < unknowns; ++i) {
        const auto r = index(bulk_->row_of_unknown()[i]);
        if (springs.held[r] != 0) response.force[r] = left[i];
    }

    double along = 0.0, potential = 0.0;
    for (std::size_t i = 0; i < unknowns; ++i) along -= 0.5 * x[i] * load[i];
    response.conjugate.assign(theta.size(), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p) {
        const auto column = std::span<const double>(bulk_->load().value).subspan(p * unknowns, unknowns);
        double q = -dot(column, x);
        for (std::size_t k = 0; k < theta.size(); ++k)
            q += bulk_->pattern_stiffness()(static_cast<std::int64_t>(p), static_cast<std::int64_t>(k)) * theta[k];
        along += 0.5 * theta[p] * (q + dot(column, x));
        for (std::size_t r = 0; r < rows; ++r)
            if (!bulk_->rows()[r].offset.empty()) q += bulk_->rows()[r].offset[p] * response.force[r];
        response.conjugate[p] = q;
        if (problem_.patterns[p].drives == Pattern::Drives::force) potential += theta[p] * q;
    }
    for (std::size_t r = 0; r < rows; ++r) along -= 0.5 * response.force[r] * (response.jump[r] - offset[r]);
    response.load_potential = potential;
    response.stored_bulk = along - potential;
    // Strains that can freely follow an eigenstrain store only the rounding of terms that cancel.
    if (!problem_.eigenstrains.empty()) response.stored_bulk = std::max(0.0, response.stored_bulk);
    response.multipliers.clear();
    response.rigid.clear();
    response.residual = 0.0;
    response.iterations = 0;
    response.converged = true;
}

std::vector<double> Condensed::unknowns_of(const Response& response) const {
    std::vector<double> x(choice_.unknowns());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = response.jump[index(bulk_->row_of_unknown()[i])];
    return x;
}

std::vector<double> Condensed::displacement(std::span<const double> theta, const Response& response) const {
    return bulk_->displacement(theta, unknowns_of(response));
}

std::optional<LinearReading> Condensed::reading(std::span<const double> weights) const {
    LinearReading of_unknowns = bulk_->reading(weights);
    std::vector<double> of_row(bulk_->rows().size(), 0.0);
    for (std::size_t i = 0; i < of_unknowns.of_row.size(); ++i)
        of_row[index(bulk_->row_of_unknown()[i])] += of_unknowns.of_row[i];
    return LinearReading{std::move(of_row), std::move(of_unknowns.of_pattern)};
}

std::vector<double> Condensed::reaction(std::span<const double> theta, const Response& response) const {
    const BodySystem& system = bulk_->system();
    return body_reactions(system, theta, system.stressed(displacement(theta, response)), response.force);
}

double Condensed::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    const BodySystem& system = bulk_->system();
    return delam::equilibrium_defect(system, theta, system.stressed(displacement(theta, response)), response.force);
}

// Entries of S have an error of the order of eps S_ii, and so has x^T S x, however small it is: the bending stiffness
// of plies is (thickness/length)^2 of that of their cells. The factor's own losses inside the bodies appear where it is
// used for the loads.
double Condensed::rounding_energy(std::span<const double> theta, const Response& response) const {
    const std::vector<double> x = unknowns_of(response);
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += bulk_->diagonal(static_cast<std::int64_t>(i)) * x[i] * x[i];
    return std::numeric_limits<double>::epsilon() * sum + bulk_->rounding_energy(theta);
}

std::vector<double> Condensed::row_stiffness() const {
    std::vector<double> stiffness(bulk_->rows().size(), 0.0);
    for (std::size_t r = 0; r < stiffness.size(); ++r)
        for (const auto& [i, n] : bulk_->rows()[r].unknowns)
            stiffness[r] = std::max(stiffness[r], n * n * bulk_->assembled_diagonal(i));
    return stiffness;
}

std::vector<double> Condensed::memory() {
    if (zone_ == nullptr) return {};
    solved_ = {};
    if (dense_ != nullptr) dense_->forget();  // the factor that earlier solves have left is not saved
    return choice_.memory();
}

void Condensed::recall(std::span<const double> memory) {
    choice_.expect_changes({});
    solved_ = {};
    if (memory.empty()) {  // before the first zone was chosen
        choice_.clear();
        forget_zone();
        return;
    }
    if (std::ranges::equal(memory, this->memory())) return;
    choice_.recall(memory);
    forget_zone();  // as in choose
    condense();
}

std::string Condensed::description_of(const Bulk& bulk) {
    const Superelements& pieces = bulk.superelements();
    return text("condensed: ", free_jumps(bulk.system().variables()), " unknown jumps, ", pieces.leaves(),
                " superelements, ", pieces.pieces(), " of them different, sparse factors with ", pieces.size().entries,
                " entries, dense matrices of ", 8.0 * pieces.dense_entries() / 1048576.0, " MiB");
}

}  // namespace delam
