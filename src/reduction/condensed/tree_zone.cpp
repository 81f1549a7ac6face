// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/tree_zone.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

bool TreeZone::offered_by(const Bulk& bulk, const TreeFactor& factor, std::int64_t dimension) {
    const TrailingEquations& equations = bulk.equations();
    const auto bound = [](std::uint8_t b) { return b != 0; };
    if (std::any_of(equations.bound().begin(), equations.bound().end(), bound)) return false;
    const Superelements& skeleton = bulk.superelements();
    for (std::size_t p = 0; p < skeleton.variable().size(); ++p) {
        if (skeleton.kind(static_cast<std::int64_t>(p)) == Superelements::Kind::cut) continue;
        const std::int64_t role = equations.role(skeleton.variable()[p]);
        if (role < 0 && !equations.row(-2 - role).empty()) return false;
    }
    std::vector<std::int64_t> owner(bulk.rows().size(), -1);
    for (std::size_t r = 0; r < bulk.rows().size(); ++r) {
        const JumpRow& row = bulk.rows()[r];
        if (row.prescribed()) continue;
        const std::int64_t unknown = row.unknowns.front().first;
        if (row.unknowns.size() != 1 || row.unknowns.front().second != 1.0 || !row.offset.empty() ||
            bulk.row_of_unknown()[index(unknown)] != static_cast<std::int64_t>(r))
            return false;
        owner[r] = factor.owner(equations.place(unknown));
    }
    for (std::size_t first = 0; first < owner.size(); first += index(dimension)) {
        std::int64_t of_pair = -1;
        for (std::size_t r = first; r < first + index(dimension); ++r) {
            if (owner[r] < 0) continue;
            if (of_pair >= 0 && owner[r] != of_pair) return false;
            of_pair = owner[r];
        }
    }
    return true;
}

TreeZone::TreeZone(const Bulk& bulk, TreeFactor& factor, const ZoneChoice& choice, std::vector<std::int64_t> jump_rows,
                   const SolvedState& solved, Poll poll)
    : bulk_(bulk),
      tree_(factor),
      choice_(choice),
      jump_rows_(std::move(jump_rows)),
      solved_(solved),
      poll_(std::move(poll)) {
    const Superelements& skeleton = bulk.superelements();
    outside_held_.assign(skeleton.variable().size(), 0);
    outside_spring_.assign(outside_held_.size(), 0.0);
    for (std::size_t p = 0; p < outside_held_.size(); ++p)
        if (skeleton.kind(static_cast<std::int64_t>(p)) != Superelements::Kind::cut &&
            bulk.equations().role(skeleton.variable()[p]) < 0)
            outside_held_[p] = 1;
    for (std::size_t i = 0; i < choice.unknowns(); ++i) {
        const auto p = index(bulk.equations().place(static_cast<std::int64_t>(i)));
        if (choice.inside()[i] != 0) continue;
        outside_held_[p] = choice.spring()[i] < 0.0 ? 1 : 0;
        outside_spring_[p] = std::max(choice.spring()[i], 0.0);
    }
    std::vector<std::int64_t> places;
    for (const std::int64_t r : jump_rows_) {
        const JumpRow& row = bulk.rows()[index(r)];
        place_.push_back(row.prescribed() ? -1 : bulk.equations().place(row.unknowns.front().first));
        if (place_.back() >= 0) places.push_back(place_.back());
    }
    nodes_ = tree_.nodes(places);
    load_.assign(outside_held_.size(), 0.0);
    x_.assign(outside_held_.size(), 0.0);
}

double TreeZone::offset(std::size_t row, std::span<const double> theta) const {
    const std::vector<double>& o = bulk_.rows()[index(jump_rows_[row])].offset;
    return o.empty() ? 0.0 : dot(o, theta);
}

bool TreeZone::factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) {
    held_.assign(held.begin(), held.end());
    couplings_.clear();
    std::vector<std::uint8_t> at_rest = outside_held_;
    std::vector<double> spring = outside_spring_;
    std::vector<Triplet> cross;
    for (std::size_t r = 0; r < held_.size(); ++r)
        if (place_[r] >= 0) at_rest[index(place_[r])] = held_[r];
    for (const Coupling& c : couplings) {
        const auto r = index(c.row), q = index(c.column);
        if (held_[r] != 0 || held_[q] != 0 || place_[r] < 0) continue;
        couplings_.push_back(c);
        if (place_[q] < 0) continue;
        if (r == q)
            spring[index(place_[r])] += c.value;
        else if (r > q)
            cross.push_back({std::max(place_[r], place_[q]), std::min(place_[r], place_[q]), c.value});
    }
    return tree_.factor(at_rest, spring, cross, poll_);
}

// L theta, on the jumps alone: cuts and kept displacements follow from skeleton_at_rest().
std::vector<double> TreeZone::right_side(std::span<const double> theta) const {
    std::vector<double> of_unknown(choice_.unknowns()), b(x_.size(), 0.0);
    multiply(bulk_.load(), theta, of_unknown);
    for (std::size_t i = 0; i < of_unknown.size(); ++i)
        b[index(bulk_.equations().place(static_cast<std::int64_t>(i)))] = of_unknown[i];
    return b;
}

// force = S x - L theta in these rows, at the last solve.
void TreeZone::resist(std::span<const double> theta, std::span<const std::size_t> rows, std::span<double> force) const {
    if (rows.empty()) return;
    std::vector<std::int64_t> places;
    for (const std::size_t r : rows) places.push_back(place_[r]);
    std::vector<double> image(x_.size());
    tree_.image(x_, places, image);
    const std::vector<double> load = right_side(theta);
    for (std::size_t i = 0; i < rows.size(); ++i) force[rows[i]] = image[index(places[i])] - load[index(places[i])];
}

// Sets load_ to L theta with the forces h - C o of free rows, which are returned.
std::vector<double> TreeZone::apply(std::span<const double> theta, std::span<const double> row_force) {
    const std::size_t rows = place_.size();
    load_ = right_side(theta);
    std::vector<double> own(rows, 0.0);
    for (std::size_t r = 0; r < row_force.size(); ++r) own[r] = row_force[r];
    for (const Coupling& c : couplings_)
        if (place_[index(c.column)] < 0) own[index(c.row)] -= c.value * offset(index(c.column), theta);
    for (std::size_t r = 0; r < rows; ++r)
        if (place_[r] >= 0 && held_[r] == 0) load_[index(place_[r])] += own[r];
    return own;
}

Zone::Solution TreeZone::solve(std::span<const double> theta, std::span<const double> row_force) {
    const std::size_t rows = place_.size();
    const std::vector<double> own = apply(theta, row_force);
    const double work = tree_.solve(load_, nodes_, x_);

    Solution solution;
    std::vector<double> d(rows, 0.0), g(rows, 0.0), sprung(rows, 0.0);
    std::vector<std::size_t> held;
    for (std::size_t r = 0; r < rows; ++r) {
        if (place_[r] < 0) continue;
        if (held_[r] != 0)
            held.push_back(r);
        else
            d[r] = x_[index(place_[r])];
    }
    for (const Coupling& c : couplings_)
        if (place_[index(c.column)] >= 0) sprung[index(c.row)] += c.value * d[index(c.column)];
    for (std::size_t r = 0; r < rows; ++r)
        if (place_[r] >= 0 && held_[r] == 0) g[r] = own[r] - sprung[r];
    resist(theta, held, g);
    // The least of E + 1/2 d.C d - d.(h - C o) is -1/2 b.A^-1 b, and g = h - C o - C d.
    const double along = dot(d, g), energy = -0.5 * work + along + 0.5 * dot(d, sprung);
    solution.unknowns = std::move(d);
    solution.unknowns.insert(solution.unknowns.end(), g.begin(), g.end());
    solution.unknowns.push_back(along - 2.0 * energy);
    return solution;
}

std::optional<DenseMatrix> TreeZone::flexibility(std::span<const std::vector<RowForce>> forces) {
    std::vector<std::vector<std::pair<std::int64_t, double>>> on_places;
    for (const std::vector<RowForce>& force : forces) {
        on_places.emplace_back();
        for (const RowForce& f : force)
            if (place_[index(f.row)] >= 0 && held_[index(f.row)] == 0)
                on_places.back().emplace_back(place_[index(f.row)], f.value);
    }
    return tree_.flexibility(on_places);
}

// After a solve of the operator with the springs that are outside, its forces are known. Otherwise everything else is
// minimised out with the rows of the zone at their jumps.
std::vector<double> TreeZone::unknowns_at(std::span<const double> theta, const Response& response) {
    const std::size_t rows = place_.size();
    std::vector<double> unknowns(2 * rows + 1, 0.0);
    const std::vector<double> load = right_side(theta);
    for (std::size_t r = 0; r < rows; ++r)
        if (place_[r] >= 0) unknowns[r] = response.jump[index(jump_rows_[r])];
    bool known = std::ranges::equal(solved_.theta, theta) && solved_.jump == response.jump;
    for (std::size_t i = 0; i < choice_.unknowns() && known; ++i)
        known = choice_.inside()[i] != 0 || choice_.spring()[i] == solved_.springs[i];
    double& w = unknowns.back();
    if (known) {
        for (std::size_t r = 0; r < rows; ++r)
            if (place_[r] >= 0) unknowns[rows + r] = -response.force[index(jump_rows_[r])];
        for (std::size_t i = 0; i < choice_.unknowns(); ++i)
            w += response.jump[index(bulk_.row_of_unknown()[i])] *
                 load[index(bulk_.equations().place(static_cast<std::int64_t>(i)))];
        return unknowns;
    }
    // x = x_0 + d, with x_0 = d on the zone alone: A d = L theta - S x_0 where nothing is held.
    std::vector<double> at(x_.size(), 0.0), image(x_.size());
    std::vector<std::size_t> inside;
    for (std::size_t r = 0; r < rows; ++r) {
        if (place_[r] < 0) continue;
        inside.push_back(r);
        at[index(place_[r])] = unknowns[r];
    }
    if (!factor({}, std::vector<std::uint8_t>(rows, 1)))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness outside the process zone is not positive definite");
    load_ = load;
    const std::vector<std::uint8_t> everywhere(x_.size(), 1);
    bulk_.superelements().subtract_image(at, everywhere, load_);
    tree_.solve(load_, std::vector<std::uint8_t>(bulk_.superelements().nodes().size(), 1), x_);
    add_scaled(1.0, at, x_);
    resist(theta, inside, std::span<double>(unknowns).subspan(rows, rows));
    w = dot(x_, load);
    return unknowns;
}

std::vector<double> TreeZone::jumps(std::span<const double> theta, std::span<const double> unknowns) const {
    std::vector<double> j(unknowns.begin(), unknowns.begin() + static_cast<std::ptrdiff_t>(place_.size()));
    for (std::size_t r = 0; r < j.size(); ++r)
        if (place_[r] < 0) j[r] = offset(r, theta);
    return j;
}

void TreeZone::complete_forces(std::span<const double>, const Solution& solution, std::span<double> row_force) const {
    for (std::size_t r = 0; r < place_.size(); ++r)
        if (place_[r] >= 0 && held_[r] != 0) row_force[r] = -solution.unknowns[place_.size() + r];
}

double TreeZone::energy_of(std::span<const double>, std::span<const double> unknowns) {
    const std::size_t rows = place_.size();
    return 0.5 * (dot(unknowns.subspan(0, rows), unknowns.subspan(rows, rows)) - unknowns[2 * rows]);
}

std::vector<double> TreeZone::skeleton(std::span<const double> theta, std::span<const double> row_force) {
    apply(theta, row_force);
    tree_.solve(load_, std::vector<std::uint8_t>(bulk_.superelements().nodes().size(), 1), x_);
    std::vector<double> x = bulk_.skeleton_at_rest(theta);
    add_scaled(1.0, x_, x);
    return x;
}

}  // namespace delam
