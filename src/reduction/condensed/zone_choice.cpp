// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/zone_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/dense/dense_energy.hpp"

namespace delam {

namespace {

std::size_t count(const std::vector<std::uint8_t>& set) {
    return index(std::count_if(set.begin(), set.end(), [](std::uint8_t v) { return v != 0; }));
}

}  // namespace

void ZoneChoice::find_always() {
    const Bulk& bulk = bulk_;
    always_ = bulk.equations().bound();
    for (std::size_t r = 0; r < bulk.rows().size(); ++r) {
        const JumpRow& row = bulk.rows()[r];
        const bool own = row.unknowns.size() == 1 &&
                         bulk.row_of_unknown()[index(row.unknowns.front().first)] == static_cast<std::int64_t>(r);
        for (const auto& [i, n] : row.unknowns)
            if (!own) always_[index(i)] = 1;
    }
    // With as many well-chosen unknowns kept as there are rigid motions, the others can always be minimised out.
    const DenseMatrix& rigid = bulk.rigid();
    DenseMatrix across(rigid.columns, rigid.rows);
    for (std::int64_t i = 0; i < rigid.rows; ++i)
        for (std::int64_t c = 0; c < rigid.columns; ++c) across(c, i) = rigid(i, c);
    const PivotedColumns pivots = pivoted_columns(std::move(across), 1e-10);
    for (std::int64_t k = 0; k < pivots.rank; ++k) always_[index(pivots.order[index(k)])] = 1;
}

ZoneChoice::ZoneChoice(const Bulk& bulk, const Problem& problem) : bulk_(bulk), limits_(problem.options.limits) {
    find_always();
    const std::size_t unknowns = index(bulk.unknowns());
    // Unknowns are neighbours if their pairs share a face of the interface, or if they belong to one pair.
    const std::int64_t dim = problem.mesh->dimension();
    std::vector<std::int64_t> unknown_of(bulk.rows().size(), -1);
    for (std::size_t i = 0; i < unknowns; ++i)
        unknown_of[index(bulk.row_of_unknown()[i])] = static_cast<std::int64_t>(i);
    std::vector<Triplet> links;
    std::int64_t first = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces()) {
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

double ZoneChoice::spring_of(const Springs& springs, std::size_t unknown) const {
    const auto row = index(bulk_.row_of_unknown()[unknown]);
    return springs.held[row] != 0 ? -1.0 : springs.stiffness[row];
}

std::vector<double> ZoneChoice::springs_of(const Springs& springs) const {
    std::vector<double> now(unknowns());
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = spring_of(springs, i);
    return now;
}

bool ZoneChoice::covers(const Springs& springs) const {
    for (std::size_t i = 0; i < inside_.size(); ++i)
        if (inside_[i] == 0 && spring_[i] != spring_of(springs, i)) return false;
    return true;
}

void ZoneChoice::add_changed(const Springs& springs, std::span<std::uint8_t> wanted) const {
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (inside_[i] == 0 && spring_[i] != spring_of(springs, i)) wanted[i] = 1;
}

// The set and its neighbours, ring after ring, until it has `size` members or nothing is left.
std::vector<std::uint8_t> ZoneChoice::grown(std::vector<std::uint8_t> set, std::size_t size) const {
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
void ZoneChoice::choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) {
    std::vector<std::uint8_t> set(always_);
    std::vector<double> now = springs_of(springs);
    for (std::size_t i = 0; i < now.size(); ++i) {
        age_[i] = wanted[i] != 0 ? std::uint8_t{0}
                                 : std::min<std::uint8_t>(forgotten(), static_cast<std::uint8_t>(age_[i] + 1));
        const double body = bulk_.diagonal(static_cast<std::int64_t>(i));
        const bool kept = age_[i] < forgotten() && (!tight || wanted[i] != 0);
        if (kept || (now[i] > 0.0 && now[i] < weakest_hold * body)) set[i] = 1;
    }
    if (!expected_.empty() && floats_unless_held(expected_, now)) expected_.clear();
    const std::size_t needed = count(set);
    if (expected_.empty() && (!tight || needed <= index(limits_.zone_small)))
        set = grown(std::move(set), needed + std::max<std::size_t>(16, needed / 5));
    for (std::size_t i = 0; i < expected_.size(); ++i)
        if (expected_[i] != 0) set[i] = 1;
    spring_ = std::move(now);
    inside_ = std::move(set);
}

// True if bodies float at these springs unless these unknowns are held. Where only contact holds them, held rows that
// enter the zone one by one find their motions with more digits: 16 plies lifted off each other did not settle in one
// zone.
bool ZoneChoice::floats_unless_held(std::span<const std::uint8_t> unknowns, std::span<const double> springs) const {
    const DenseMatrix& rigid = bulk_.rigid();
    if (rigid.columns == 0) return false;
    std::vector<std::uint8_t> active(springs.size());
    for (std::size_t i = 0; i < active.size(); ++i)
        active[i] = springs[i] > 0.0 || (springs[i] < 0.0 && unknowns[i] == 0) ? 1 : 0;
    return split_motions(rigid, active).free.columns > 0;
}

// A zone of all of them, where its factor costs less than choosing zones anew. The unknowns that have changed in it are
// no reason to stay in later ones.
void ZoneChoice::expect_changes(std::span<const std::size_t> rows) {
    unmet_ = false;
    expected_.clear();
    if (rows.empty()) return;
    expected_.assign(always_.size(), 0);
    for (const std::size_t r : rows)
        for (const auto& [i, n] : bulk_.rows()[r].unknowns) expected_[index(i)] = 1;
    const auto n = static_cast<double>(count(expected_));
    if (n * n * n / 3.0 > limits_.zone_one_factor * bulk_.superelements().condensation().operations) expected_.clear();
    unmet_ = !expected_.empty();
}

std::vector<std::uint8_t> ZoneChoice::changed_since_last(std::span<const double> now) {
    std::vector<std::uint8_t> changed(now.size(), 0);
    const bool after_another = std::any_of(last_.begin(), last_.end(), [](double s) { return s != 0.0; });
    for (std::size_t i = 0; after_another && i < now.size(); ++i) {
        if (now[i] == last_[i]) continue;
        changed[i] = 1;
        if (expected_.empty()) age_[i] = 0;
    }
    return changed;
}

// Saves three numbers for each unknown: a code of age and inside, the spring at which it is minimised out, and that of
// the last solve.
std::vector<double> ZoneChoice::memory() const {
    std::vector<double> m;
    m.reserve(3 * always_.size());
    for (std::size_t i = 0; i < always_.size(); ++i) m.push_back(age_[i] + 4 * inside_[i]);
    for (const auto* springs : {&spring_, &last_}) m.insert(m.end(), springs->begin(), springs->end());
    return m;
}

ZoneChoice::Saved ZoneChoice::parse(std::span<const double> memory) const {
    const std::size_t unknowns = always_.size();
    const auto damaged = [](bool yes) {
        if (yes) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a zone that the condensed operator cannot have");
    };
    damaged(memory.size() != 3 * unknowns);
    Saved saved;
    auto& [age, inside, spring, last] = saved;
    for (auto* codes : {&age, &inside}) codes->resize(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        damaged(!(memory[i] >= 0.0 && memory[i] < 8.0) || memory[i] != std::floor(memory[i]));
        const auto code = static_cast<unsigned>(memory[i]);
        age[i] = code & 3U;
        inside[i] = (code >> 2U) & 1U;
        damaged(inside[i] == 0 && always_[i] != 0);
    }
    // Negative zero equals zero, but would be saved with its sign.
    std::size_t at = unknowns;
    for (auto* springs : {&spring, &last})
        for (std::size_t i = 0; i < unknowns; ++i, ++at) {
            damaged(!(memory[at] >= 0.0 || memory[at] == -1.0));
            springs->push_back(memory[at] + 0.0);
        }
    return saved;
}

void ZoneChoice::require(std::span<const double> memory) const { (void)parse(memory); }

void ZoneChoice::recall(std::span<const double> memory) {
    auto [age, inside, spring, last] = parse(memory);
    age_ = std::move(age);
    inside_ = std::move(inside);
    last_ = std::move(last);
    spring_ = std::move(spring);
}

void ZoneChoice::clear() {
    age_.assign(unknowns(), forgotten());
    inside_.assign(unknowns(), 1);
    spring_.clear();
    last_.assign(unknowns(), 0.0);
}

}  // namespace delam
