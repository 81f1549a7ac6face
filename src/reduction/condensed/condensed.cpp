// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/condensed.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace delam {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// A spring weaker than this part of the bodies' stiffness is no hold to factor with: such rows stay in the zone, which can.
constexpr double weak = 1e-9;

enum : std::uint8_t { outer_level = 0, inner_level = 1, zone_level = 2 };

std::size_t count(const std::vector<std::uint8_t>& set) {
    return static_cast<std::size_t>(std::count_if(set.begin(), set.end(), [](std::uint8_t v) { return v != 0; }));
}

}  // namespace

Condensed::Condensed(std::unique_ptr<Bulk> bulk, const Problem& problem, Monitor& monitor)
    : bulk_(std::move(bulk)), problem_(problem), monitor_(monitor) {
    const std::size_t unknowns = index(bulk_->energy().rows());
    rows_of_.resize(unknowns);
    always_.assign(unknowns, 0);
    for (std::size_t r = 0; r < bulk_->rows().size(); ++r) {
        const Bulk::Row& row = bulk_->rows()[r];
        prescribed_.push_back(row.prescribed() ? 1 : 0);
        const bool own = row.unknowns.size() == 1 && bulk_->row_of_unknown()[index(row.unknowns.front().first)] == static_cast<std::int64_t>(r);
        for (const auto& [i, n] : row.unknowns) {
            rows_of_[index(i)].push_back(static_cast<std::int64_t>(r));
            if (!own) always_[index(i)] = 1;
        }
    }
    // With as many well-chosen unknowns kept as there are rigid motions, the others can always be minimised out.
    const DenseMatrix& rigid = bulk_->rigid();
    DenseMatrix across(rigid.columns, rigid.rows);
    for (std::int64_t i = 0; i < rigid.rows; ++i)
        for (std::int64_t c = 0; c < rigid.columns; ++c) across(c, i) = rigid(i, c);
    const PivotedColumns pivots = pivoted_columns(std::move(across), 1e-10);
    for (std::int64_t k = 0; k < pivots.rank; ++k) always_[index(pivots.order[index(k)])] = 1;

    // Unknowns are neighbours when their pairs share a face of the interface, or are one pair.
    const std::int64_t dim = problem_.mesh->dimension();
    std::vector<std::int64_t> unknown_of(bulk_->rows().size(), -1);
    for (std::size_t i = 0; i < unknowns; ++i) unknown_of[index(bulk_->row_of_unknown()[i])] = static_cast<std::int64_t>(i);
    std::vector<Triplet> links;
    std::int64_t first = 0;
    for (const InterfaceGeometry& face : problem_.mesh->interfaces()) {
        const auto nodes = static_cast<std::size_t>(face.nodes_per_face);
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
    SparseMatrix graph = from_triplets(static_cast<std::int64_t>(unknowns), static_cast<std::int64_t>(unknowns), std::move(links));
    neighbour_start_ = std::move(graph.start);
    neighbour_ = std::move(graph.column);
    recent_.assign(unknowns, 0);
}

double Condensed::spring_of(const Springs& springs, std::size_t unknown) const {
    const auto row = index(bulk_->row_of_unknown()[unknown]);
    return springs.held[row] != 0 ? -1.0 : springs.stiffness[row];
}

bool Condensed::covers(const Springs& springs) const {
    if (zone_ == nullptr) return false;
    for (std::size_t i = 0; i < level_.size(); ++i)
        if (level_[i] != zone_level && spring_[i] != spring_of(springs, i)) return false;
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

// Margins: so that a front may move on for a while before the zone has to follow.
void Condensed::choose(const Springs& springs, std::span<const std::uint8_t> wanted) {
    const std::size_t unknowns = always_.size();
    std::vector<std::uint8_t> set(always_);
    for (std::size_t i = 0; i < unknowns; ++i) {
        const double s = spring_of(springs, i);
        const double body = bulk_->energy().stiffness(static_cast<std::int64_t>(i), static_cast<std::int64_t>(i));
        if (wanted[i] != 0 || (s > 0.0 && s < weak * body)) set[i] = 1;
    }
    const std::size_t needed = count(set);
    set = grown(std::move(set), needed + std::max<std::size_t>(16, needed / 3));
    bool outer_holds = outer_ != nullptr;
    for (std::size_t i = 0; i < unknowns && outer_holds; ++i)
        outer_holds = level_[i] != outer_level || (set[i] == 0 && spring_[i] == spring_of(springs, i));
    std::vector<std::uint8_t> level(unknowns, outer_level);
    const std::vector<std::uint8_t> near =
        outer_holds ? std::vector<std::uint8_t>() : grown(set, count(set) + std::max<std::size_t>(64, unknowns / 6));
    for (std::size_t i = 0; i < unknowns; ++i)
        level[i] = set[i] != 0 ? zone_level : (outer_holds ? level_[i] != outer_level : near[i] != 0) ? inner_level : outer_level;
    std::vector<double> spring(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) spring[i] = spring_of(springs, i);
    if (!outer_holds) outer_.reset();
    spring_ = std::move(spring);
    condense(std::move(level));
    std::fill(recent_.begin(), recent_.end(), std::uint8_t{0});
}

void Condensed::condense(std::vector<std::uint8_t> level) {
    monitor_.progress("zone", condensations_, 0);
    ++condensations_;
    level_ = std::move(level);
    zone_.reset();
    inner_.reset();
    const std::size_t unknowns = level_.size();
    const auto pick = [&](const DenseEnergy& parent, std::span<const std::int64_t> members, std::uint8_t own) {
        std::vector<std::int64_t> kept, eliminated;
        std::vector<double> stiffness(members.size(), 0.0);
        for (std::size_t m = 0; m < members.size(); ++m) {
            const auto i = index(members[m]);
            if (level_[i] > own)
                kept.push_back(static_cast<std::int64_t>(m));
            else if (spring_[i] >= 0.0)
                eliminated.push_back(static_cast<std::int64_t>(m));
            stiffness[m] = std::max(0.0, spring_[i]);
        }
        return std::make_unique<Condensation>(parent, std::move(kept), std::move(eliminated), stiffness);
    };
    std::vector<std::int64_t> all(unknowns), near;
    for (std::size_t i = 0; i < unknowns; ++i) all[i] = static_cast<std::int64_t>(i);
    if (outer_ == nullptr) outer_ = pick(bulk_->energy(), all, outer_level);
    for (const std::int64_t k : outer_->kept()) near.push_back(k);
    inner_ = pick(outer_->energy(), near, inner_level);
    zone_unknowns_.clear();
    for (const std::int64_t k : inner_->kept()) zone_unknowns_.push_back(near[index(k)]);

    std::vector<std::int64_t> place(unknowns, -1);
    for (std::size_t z = 0; z < zone_unknowns_.size(); ++z) place[index(zone_unknowns_[z])] = static_cast<std::int64_t>(z);
    zone_rows_.clear();
    std::vector<Bulk::Row> rows;
    for (std::size_t r = 0; r < bulk_->rows().size(); ++r) {
        const Bulk::Row& row = bulk_->rows()[r];
        if (row.prescribed() || place[index(row.unknowns.front().first)] < 0) continue;
        Bulk::Row local{{}, row.offset};
        for (const auto& [i, n] : row.unknowns) local.unknowns.emplace_back(place[index(i)], n);
        zone_rows_.push_back(static_cast<std::int64_t>(r));
        rows.push_back(std::move(local));
    }
    // Rigid motions that no active row outside the zone holds.
    const DenseMatrix& rigid = bulk_->rigid();
    std::vector<std::uint8_t> active(unknowns, 0);
    for (std::size_t i = 0; i < unknowns; ++i) active[i] = place[i] < 0 && spring_[i] != 0.0 ? 1 : 0;
    DenseMatrix floating(static_cast<std::int64_t>(zone_unknowns_.size()), 0);
    if (rigid.columns > 0) {
        const DenseMatrix free = multiply(rigid, split_motions(rigid, active).free);
        floating = DenseMatrix(floating.rows, free.columns);
        for (std::int64_t c = 0; c < free.columns; ++c)
            for (std::int64_t z = 0; z < floating.rows; ++z) floating(z, c) = free(zone_unknowns_[index(z)], c);
        floating = orthonormalised(std::move(floating));
    }
    zone_ = std::make_unique<Zone>(inner_->energy(), std::move(rows), std::move(floating));
    if (getenv("DBG")) { size_t held=0; for(double v:spring_) held+=v<0; fprintf(stderr,"condense %ld: n %zu outer kept %zu zone %zu held %zu floats %ld\n",(long)condensations_,unknowns,near.size(),zone_unknowns_.size(),held,(long)0);}
}

Zone& Condensed::zone(const Springs& springs, std::span<const std::uint8_t> wanted) {
    std::vector<std::uint8_t> unknowns(always_.size(), 0);
    bool inside = covers(springs);
    for (std::size_t r = 0; r < wanted.size(); ++r) {
        if (wanted[r] == 0) continue;
        for (const auto& [i, n] : bulk_->rows()[r].unknowns) {
            unknowns[index(i)] = 1;
            inside = inside && level_[index(i)] == zone_level;
        }
    }
    if (!inside) {
        if (zone_ != nullptr)
            for (std::size_t i = 0; i < unknowns.size(); ++i)
                if (level_[i] != zone_level && spring_[i] != spring_of(springs, i)) unknowns[i] = 1;
        choose(springs, unknowns);
    }
    return *zone_;
}

void Condensed::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    std::vector<double> now(always_.size());
    bool all_held = true;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now[i] = spring_of(springs, i);
        all_held = all_held && now[i] < 0.0;
    }
    if (all_held) {
        respond(springs, theta, nullptr, response);
        return;
    }
    for (std::size_t i = 0; i < now.size() && !last_.empty(); ++i)
        if (now[i] != last_[i]) recent_[i] = 1;
    if (!covers(springs)) {
        std::vector<std::uint8_t> wanted = recent_;
        if (last_.empty()) std::fill(wanted.begin(), wanted.end(), std::uint8_t{0});
        choose(springs, wanted);
    }
    last_ = std::move(now);

    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held(zone_rows_.size());
    for (std::size_t z = 0; z < zone_rows_.size(); ++z) {
        const auto r = index(zone_rows_[z]);
        held[z] = springs.held[r];
        if (held[z] == 0 && springs.stiffness[r] > 0.0)
            couplings.push_back({static_cast<std::int64_t>(z), static_cast<std::int64_t>(z), springs.stiffness[r]});
    }
    if (getenv("DBG")) { size_t h=0; for(auto v:held) h+=v; fprintf(stderr,"   solve zone %zu held %zu\n",held.size(),h);}
    if (!zone_->factor(couplings, held))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness of the process zone (", zone_rows_.size(), " rows) is not positive definite");
    const Zone::Solution solution = zone_->solve(theta, {});
    respond(springs, theta, &solution, response);
}

// Along the minimiser S x = L theta - sum_r N_r^T lambda_r, which gives the energies without another product with S:
//   stored + potential = 1/2 (x.L theta - sum lambda_r (N x)_r) - x.L theta + 1/2 theta.A theta,   dE/dtheta = A theta - L^T x + O^T lambda
void Condensed::respond(const Springs& springs, std::span<const double> theta, const Zone::Solution* solution,
                        Response& response) const {
    response.balanced = solution == nullptr || solution->balanced;
    if (!response.balanced) return;
    const DenseEnergy& energy = bulk_->energy();
    const std::size_t unknowns = always_.size(), rows = bulk_->rows().size();
    std::vector<double> x(unknowns, 0.0), load(unknowns, 0.0);
    if (solution != nullptr) {
        std::vector<double> near(outer_->kept().size(), 0.0);
        inner_->recover(theta, solution->unknowns, near);
        outer_->recover(theta, near, x);
    }
    multiply(energy.load, theta, load);

    response.jump.assign(rows, 0.0);
    response.force.assign(rows, 0.0);
    std::vector<double> offset(rows, 0.0), left = load;
    for (std::size_t z = 0; solution != nullptr && z < solution->multiplier.size(); ++z)
        response.force[index(zone_rows_[z])] = solution->multiplier[z];
    for (std::size_t r = 0; r < rows; ++r) {
        const Bulk::Row& row = bulk_->rows()[r];
        if (!row.offset.empty()) offset[r] = dot(row.offset, theta);
        if (springs.held[r] == 0) {
            response.jump[r] = offset[r];
            for (const auto& [i, n] : row.unknowns) response.jump[r] += n * x[index(i)];
            response.force[r] = springs.stiffness[r] * response.jump[r];
        }
        const bool own = row.unknowns.size() == 1 && bulk_->row_of_unknown()[index(row.unknowns.front().first)] == static_cast<std::int64_t>(r);
        if (!own)
            for (const auto& [i, n] : row.unknowns) left[index(i)] -= n * response.force[r];
    }
    for (std::size_t i = 0; i < unknowns; ++i) {
        const auto r = index(bulk_->row_of_unknown()[i]);
        if (springs.held[r] == 0) continue;
        const auto column = std::span<const double>(energy.stiffness.value).subspan(i * unknowns, unknowns);
        response.force[r] = left[i] - dot(column, x);
    }

    double along = 0.0, potential = 0.0;
    for (std::size_t i = 0; i < unknowns; ++i) along -= 0.5 * x[i] * load[i];
    response.conjugate.assign(theta.size(), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p) {
        const auto column = std::span<const double>(energy.load.value).subspan(p * unknowns, unknowns);
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
    response.multipliers.clear();
    response.rigid.clear();
    response.residual = 0.0;
    response.iterations = 0;
    response.converged = true;
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
    return bulk_->reaction(theta, displacement(theta, response), response.force);
}

double Condensed::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    const std::vector<double> u = displacement(theta, response);
    return bulk_->defect(theta, u, response.force, bulk_->reaction(theta, u, response.force));
}

std::vector<double> Condensed::memory() const {
    if (zone_ == nullptr) return {};
    std::vector<double> m;
    for (std::size_t i = 0; i < level_.size(); ++i) m.push_back(level_[i] + 4.0 * recent_[i]);
    m.insert(m.end(), spring_.begin(), spring_.end());
    m.insert(m.end(), last_.begin(), last_.end());
    return m;
}

void Condensed::recall(std::span<const double> memory) {
    const std::size_t unknowns = always_.size();
    if (memory.empty() || std::ranges::equal(memory, this->memory())) return;
    if (memory.size() != 3 * unknowns && memory.size() != 2 * unknowns) fail(DELAM_ERROR_SNAPSHOT, "the operator's memory has another size");
    std::vector<std::uint8_t> level(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        const double code = memory[i];
        if (!(code >= 0.0 && code <= 6.0) || code != std::floor(code)) fail(DELAM_ERROR_SNAPSHOT, "the operator's memory is damaged");
        level[i] = static_cast<std::uint8_t>(std::fmod(code, 4.0));
        recent_[i] = code >= 4.0 ? 1 : 0;
        if (level[i] == 3) fail(DELAM_ERROR_SNAPSHOT, "the operator's memory is damaged");
    }
    const std::span<const double> spring = memory.subspan(unknowns, unknowns), last = memory.subspan(2 * unknowns);
    const bool same = zone_ != nullptr && level == level_ && std::ranges::equal(spring, spring_);
    spring_.assign(spring.begin(), spring.end());
    last_.assign(last.begin(), last.end());
    if (same) return;
    outer_.reset();
    condense(std::move(level));
}

std::string Condensed::description() const {
    const double unknowns = static_cast<double>(always_.size());
    return text("condensed: ", always_.size(), " unknown jumps, sparse factor with ", bulk_->size().entries, " entries, dense operator ",
                8.0 * unknowns * unknowns / 1048576.0, " MiB");
}

}  // namespace delam
