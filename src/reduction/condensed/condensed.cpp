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

namespace {

std::size_t count(const std::vector<std::uint8_t>& set) {
    return index(std::count_if(set.begin(), set.end(), [](std::uint8_t v) { return v != 0; }));
}

}  // namespace

Condensed::Condensed(std::shared_ptr<Bulk> bulk, const Problem& problem, Monitor& monitor)
    : bulk_(std::move(bulk)),
      problem_(problem),
      monitor_(monitor),
      always_(bulk_->equations().bound()),
      elimination_(bulk_->elimination()) {
    const std::size_t unknowns = index(bulk_->unknowns());
    for (std::size_t r = 0; r < bulk_->rows().size(); ++r) {
        const JumpRow& row = bulk_->rows()[r];
        prescribed_.push_back(row.prescribed() ? 1 : 0);
        const bool own = row.unknowns.size() == 1 &&
                         bulk_->row_of_unknown()[index(row.unknowns.front().first)] == static_cast<std::int64_t>(r);
        for (const auto& [i, n] : row.unknowns)
            if (!own) always_[index(i)] = 1;
    }
    // With as many well-chosen unknowns kept as there are rigid motions, the others can always be minimised out.
    const DenseMatrix& rigid = bulk_->rigid();
    DenseMatrix across(rigid.columns, rigid.rows);
    for (std::int64_t i = 0; i < rigid.rows; ++i)
        for (std::int64_t c = 0; c < rigid.columns; ++c) across(c, i) = rigid(i, c);
    const PivotedColumns pivots = pivoted_columns(std::move(across), 1e-10);
    for (std::int64_t k = 0; k < pivots.rank; ++k) always_[index(pivots.order[index(k)])] = 1;

    // Unknowns are neighbours if their pairs share a face of the interface, or if they belong to one pair.
    const std::int64_t dim = problem_.mesh->dimension();
    std::vector<std::int64_t> unknown_of(bulk_->rows().size(), -1);
    for (std::size_t i = 0; i < unknowns; ++i)
        unknown_of[index(bulk_->row_of_unknown()[i])] = static_cast<std::int64_t>(i);
    std::vector<Triplet> links;
    std::int64_t first = 0;
    for (const InterfaceGeometry& face : problem_.mesh->interfaces()) {
        const auto nodes = index(face.nodes_per_face);
        for (std::size_t f = 0; f + nodes <= face.face.size(); f += nodes)
            for (std::size_t a = 0; a < nodes; ++a)
                for (std::size_t b = 0; b < nodes; ++b)
                    for (std::int64_t i = 0; i < dim; ++i)
                        for (std::int64_t j = 0; j < dim; ++j) {
                            const std::int64_t u = unknown_of[index((first + face.face[f + a]) * dim + i)];
                            const std::int64_t v = unknown_of[index((first + face.face[f + b]) * dim + j)];
                            if (u >= 0 && v >= 0 && u != v) links.push_back({u, v, 1.0});
                        }
        first += face.pair_count();
    }
    SparseMatrix graph =
        from_triplets(static_cast<std::int64_t>(unknowns), static_cast<std::int64_t>(unknowns), std::move(links));
    neighbour_start_ = std::move(graph.start);
    neighbour_.assign(graph.column.begin(), graph.column.end());
    age_.assign(unknowns, forgotten());
    inside_.assign(unknowns, 1);
    last_.assign(unknowns, 0.0);
}

Poll Condensed::poll() {
    return [this] { monitor_.progress("zone", condensations_, 0); };
}

double Condensed::spring_of(const Springs& springs, std::size_t unknown) const {
    const auto row = index(bulk_->row_of_unknown()[unknown]);
    return springs.held[row] != 0 ? -1.0 : springs.stiffness[row];
}

bool Condensed::covers(const Springs& springs) const {
    if (zone_ == nullptr) return false;
    for (std::size_t i = 0; i < inside_.size(); ++i)
        if (inside_[i] == 0 && spring_[i] != spring_of(springs, i)) return false;
    return true;
}

// The set and its neighbours, ring after ring, until it has `size` members or nothing is left.
std::vector<std::uint8_t> Condensed::grown(std::vector<std::uint8_t> set, std::size_t size) const {
    std::vector<std::int64_t> ring;
    std::size_t members = 0;
    for (std::size_t i = 0; i < set.size(); ++i)
        if (set[i] != 0) {
            ring.push_back(static_cast<std::int64_t>(i));
            ++members;
        }
    while (!ring.empty() && members < size) {
        std::vector<std::int64_t> next;
        for (const std::int64_t i : ring)
            for (std::int64_t e = neighbour_start_[index(i)]; e < neighbour_start_[index(i) + 1]; ++e) {
                const std::int64_t j = neighbour_[index(e)];
                if (set[index(j)] != 0) continue;
                set[index(j)] = 1;
                ++members;
                next.push_back(j);
            }
        ring = std::move(next);
    }
    return set;
}

// Margins, so that a front may advance for a while before the zone has to follow.
void Condensed::choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) {
    const std::size_t unknowns = always_.size();
    std::vector<std::uint8_t> set(always_);
    std::vector<double> now(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        now[i] = spring_of(springs, i);
        age_[i] = wanted[i] != 0 ? std::uint8_t{0}
                                 : std::min<std::uint8_t>(forgotten(), static_cast<std::uint8_t>(age_[i] + 1));
        const double body = bulk_->diagonal(static_cast<std::int64_t>(i));
        const bool kept = age_[i] < forgotten() && (!tight || wanted[i] != 0);
        if (kept || (now[i] > 0.0 && now[i] < weakest_hold * body)) set[i] = 1;
    }
    if (!expected_.empty() && floats_unless_held(expected_, now)) expected_.clear();
    const std::size_t needed = count(set);
    if (expected_.empty() && (!tight || needed <= index(limits().zone_small)))
        set = grown(std::move(set), needed + std::max<std::size_t>(16, needed / 5));
    for (std::size_t i = 0; i < expected_.size(); ++i)
        if (expected_[i] != 0) set[i] = 1;
    // The zone is missing from here to the end of condense(), so that an interrupted choice is never taken for a valid
    // one.
    zone_.reset();
    spring_ = std::move(now);
    inside_ = std::move(set);
    condense();
}

// True if bodies float at these springs unless these unknowns are held. Where only contact holds them, held rows that
// enter the zone one by one find their motions with more digits: 16 plies lifted off each other did not settle in one
// zone.
bool Condensed::floats_unless_held(std::span<const std::uint8_t> unknowns, std::span<const double> springs) const {
    const DenseMatrix& rigid = bulk_->rigid();
    if (rigid.columns == 0) return false;
    std::vector<std::uint8_t> active(springs.size());
    for (std::size_t i = 0; i < active.size(); ++i)
        active[i] = springs[i] > 0.0 || (springs[i] < 0.0 && unknowns[i] == 0) ? 1 : 0;
    return split_motions(rigid, active).free.columns > 0;
}

// The zone at the present choice.
void Condensed::condense() {
    monitor_.progress("zone", condensations_, 0);
    ++condensations_;
    zone_.reset();
    energy_.reset();
    std::vector<double> state(spring_);
    for (std::size_t i = 0; i < state.size(); ++i)
        if (inside_[i] != 0) state[i] = Elimination::in_zone;
    elimination_.update(bulk_->equations().states(state), poll());
    energy_ = std::make_unique<ZoneEnergy>(bulk_->zone_energy(elimination_, poll()));
    const std::vector<std::int64_t>& zone_unknowns = energy_->unknowns();

    const std::size_t unknowns = inside_.size();
    std::vector<std::int64_t> place(unknowns, -1);
    for (std::size_t z = 0; z < zone_unknowns.size(); ++z)
        place[index(zone_unknowns[z])] = static_cast<std::int64_t>(z);
    std::vector<std::int64_t> zone_rows;
    std::vector<JumpRow> rows;
    const auto dim = index(problem_.mesh->dimension());
    const auto pair_inside = [&](std::size_t pair) {
        for (std::size_t r = pair * dim; r < (pair + 1) * dim; ++r)
            if (const JumpRow& row = bulk_->rows()[r];
                !row.prescribed() && place[index(row.unknowns.front().first)] >= 0)
                return true;
        return false;
    };
    for (std::size_t r = 0; r < bulk_->rows().size(); ++r) {
        const JumpRow& row = bulk_->rows()[r];
        // A prescribed row comes with the others of its pair, because the minimisers in the zone need whole pairs.
        if (row.prescribed() ? !pair_inside(r / dim) : place[index(row.unknowns.front().first)] < 0) continue;
        JumpRow local{{}, row.offset};
        for (const auto& [i, n] : row.unknowns) local.unknowns.emplace_back(place[index(i)], n);
        zone_rows.push_back(static_cast<std::int64_t>(r));
        rows.push_back(std::move(local));
    }
    std::vector<std::uint8_t> active(unknowns, 0);
    for (std::size_t i = 0; i < unknowns; ++i) active[i] = place[i] < 0 && spring_[i] != 0.0 ? 1 : 0;
    ZoneMotions floating = ZoneMotions::of(bulk_->rigid(), bulk_->dead_work(), active, zone_unknowns);
    zone_ = std::make_unique<DenseZone>(energy_->energy(), std::move(rows), std::move(zone_rows), std::move(floating),
                                        poll());
}

DenseZone* Condensed::zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) {
    std::vector<std::uint8_t> unknowns(always_.size(), 0);
    bool inside = covers(springs);
    const auto rows = index(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}));
    if (tight && inside && energy_->unknowns().size() > 2 * rows + index(limits().zone_small)) {
        age_.assign(age_.size(), forgotten());
        inside = false;
    }
    for (std::size_t r = 0; r < wanted.size(); ++r) {
        if (wanted[r] == 0) continue;
        for (const auto& [i, n] : bulk_->rows()[r].unknowns) {
            unknowns[index(i)] = 1;
            inside = inside && inside_[index(i)] != 0;
        }
    }
    if (!inside) {
        if (zone_ != nullptr)
            for (std::size_t i = 0; i < unknowns.size(); ++i)
                if (inside_[i] == 0 && spring_[i] != spring_of(springs, i)) unknowns[i] = 1;
        choose(springs, unknowns, tight);
    }
    return zone_.get();
}

// A zone of all of them, where its factor costs less than choosing zones anew. The unknowns that have changed in it are
// no reason to stay in later ones.
void Condensed::expect_changes(std::span<const std::size_t> rows) {
    unmet_ = false;
    expected_.clear();
    if (rows.empty()) return;
    expected_.assign(always_.size(), 0);
    for (const std::size_t r : rows)
        for (const auto& [i, n] : bulk_->rows()[r].unknowns) expected_[index(i)] = 1;
    const auto n = static_cast<double>(count(expected_));
    if (n * n * n / 3.0 > limits().zone_one_factor * bulk_->superelements().condensation().operations)
        expected_.clear();
    unmet_ = !expected_.empty();
}

void Condensed::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    std::vector<double> now(always_.size());
    bool all_held = true;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now[i] = spring_of(springs, i);
        all_held = all_held && now[i] < 0.0;
    }
    // Without a load nothing moves, exactly.
    std::vector<double> load(now.size());
    multiply(bulk_->load(), theta, load);
    bool loaded = std::any_of(load.begin(), load.end(), [](double v) { return v != 0.0; });
    for (std::size_t r = 0; r < springs.force.size(); ++r)
        loaded = loaded || (springs.force[r] != 0.0 && springs.held[r] == 0);
    for (const JumpRow& row : bulk_->rows()) loaded = loaded || (!row.offset.empty() && dot(row.offset, theta) != 0.0);
    if (all_held || !loaded) {
        respond(springs, theta, nullptr, response);
        return;
    }
    std::vector<std::uint8_t> wanted(now.size(), 0);
    const bool after_another = std::any_of(last_.begin(), last_.end(), [](double s) { return s != 0.0; });
    for (std::size_t i = 0; after_another && i < now.size(); ++i) {
        if (now[i] == last_[i]) continue;
        wanted[i] = 1;
        if (expected_.empty()) age_[i] = 0;
    }
    const bool unmet = std::exchange(unmet_, false);
    if (unmet || !covers(springs)) choose(springs, wanted);
    if (!springs.force.empty()) {
        std::vector<std::uint8_t> pulled(springs.force.size());
        for (std::size_t r = 0; r < pulled.size(); ++r) pulled[r] = springs.force[r] != 0.0 ? 1 : 0;
        zone(springs, pulled, false);
    }
    last_ = std::move(now);

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
    const Zone::Solution solution = zone_->solve(theta, force);
    respond(springs, theta, &solution, response);
}

bool Condensed::complete(const Springs& springs, std::span<const double> theta, const Zone::Solution& solution,
                         Response& response) const {
    respond(springs, theta, &solution, response);
    return true;
}

// Along the minimiser S x = L theta - sum_r N_r^T lambda_r, which gives the energies without another product with S:
//   stored + potential = 1/2 (x.L theta - sum lambda_r (N x)_r) - x.L theta + 1/2 theta.A theta,   dE/dtheta = A theta
//   - L^T x + O^T lambda
void Condensed::respond(const Springs& springs, std::span<const double> theta, const Zone::Solution* solution,
                        Response& response) const {
    response.balanced = solution == nullptr || solution->balanced;
    if (!response.balanced) return;
    const std::size_t unknowns = always_.size(), rows = bulk_->rows().size();
    std::vector<double> load(unknowns, 0.0);
    const std::vector<double> skeleton = skeleton_of(theta, solution), x = bulk_->equations().unknowns_at(skeleton);
    multiply(bulk_->load(), theta, load);

    response.jump.assign(rows, 0.0);
    response.force.assign(rows, 0.0);
    std::vector<double> offset(rows, 0.0);
    std::vector<std::uint8_t> held(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) held[i] = springs.held[index(bulk_->row_of_unknown()[i])];
    std::vector<double> left = bulk_->residual(theta, skeleton, held);
    for (std::size_t z = 0; solution != nullptr && z < solution->multiplier.size(); ++z)
        response.force[index(zone_->jump_rows()[z])] = solution->multiplier[z];
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

// All else at its minimum for these unknowns of the zone; without a solution all unknowns are at zero.
std::vector<double> Condensed::skeleton_of(std::span<const double> theta, const Zone::Solution* solution) const {
    if (solution == nullptr) return bulk_->skeleton_at_rest(theta);
    std::vector<double> skeleton(bulk_->superelements().variable().size());
    elimination_.recover(theta, energy_->recover(theta, solution->unknowns), skeleton);
    return skeleton;
}

std::vector<double> Condensed::unknowns_of(const Response& response) const {
    std::vector<double> x(always_.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = response.jump[index(bulk_->row_of_unknown()[i])];
    return x;
}

std::vector<double> Condensed::displacement(std::span<const double> theta, const Response& response) const {
    return bulk_->displacement(theta, unknowns_of(response));
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
    for (std::int64_t i = 0; i < bulk_->unknowns(); ++i)
        stiffness[index(bulk_->row_of_unknown()[index(i)])] = bulk_->diagonal(i);
    return stiffness;
}

std::string Condensed::description_of(const Bulk& bulk) {
    const Superelements& pieces = bulk.superelements();
    return text("condensed: ", free_jumps(bulk.system().variables()), " unknown jumps, ", pieces.leaves(),
                " superelements, ", pieces.pieces(), " of them different, sparse factors with ", pieces.size().entries,
                " entries, dense matrices of ", 8.0 * pieces.dense_entries() / 1048576.0, " MiB");
}

}  // namespace delam
