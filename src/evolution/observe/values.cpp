// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <variant>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/search/fronts.hpp"

namespace delam {

namespace {

// A state of a solver as the values see it. The fronts of an interface are sought when the first value asks for them.
class Reading {
public:
    Reading(Observer& observer, const State& state) : observer_(observer), state_(state) {}

    Observer& observer() const { return observer_; }
    const State& state() const { return state_; }
    std::int64_t interfaces() const { return static_cast<std::int64_t>(observer_.problem().interfaces.size()); }
    std::size_t dimension() const { return index(observer_.pairs().dimension); }
    // Its fields with its law; nothing where it has none.
    std::optional<CrackedInterface> cracked(std::int64_t interface) const {
        return observer_.cracked(state_, interface);
    }
    const std::vector<CrackFront>& fronts(std::int64_t interface) const {
        if (&state_ == &observer_.state()) return observer_.crack_fronts(interface);
        const auto known = fronts_.find(interface);
        if (known != fronts_.end()) return known->second;
        const std::optional<CrackedInterface> of = cracked(interface);
        return fronts_[interface] = of ? crack_fronts(*of) : std::vector<CrackFront>{};
    }

private:
    Observer& observer_;
    const State& state_;
    mutable std::map<std::int64_t, std::vector<CrackFront>> fronts_;
};

double count(std::int64_t n) { return static_cast<double>(n); }

// Sum of weight * f(adhesion) over the pairs that adhered at first.
template <class F>
double over_bond(const Reading& r, F f) {
    double sum = 0.0;
    for (std::size_t p = 0; p < r.state().adhesion.size(); ++p)
        if (r.observer().pairs().law[p] != nullptr && r.observer().initial_adhesion()[p] > 0.0)
            sum += r.observer().pairs().weight[p] * f(r.state().adhesion[p]);
    return sum;
}

// Sum of f(interface) over the interfaces with a law; which: one of them alone, -1: all.
template <class F>
double over_interfaces(const Reading& r, std::int64_t which, F f) {
    double sum = 0.0;
    for (std::int64_t i = 0; i < r.interfaces(); ++i) {
        if (which >= 0 && i != which) continue;
        const std::optional<CrackedInterface> of = r.cracked(i);
        sum += of ? f(*of) : 0.0;
    }
    return sum;
}

// Normal jumps of all pairs from the displacements at their nodes: what a host would measure.
std::vector<double> gaps(const Reading& r) {
    const std::size_t rows = r.dimension();  // of a pair
    if (r.observer().jump_operator().turned(r.state().response) != nullptr) {
        // Frames that turn have no other jumps than those of the response, which are made from displacements.
        std::vector<double> normal;
        for (std::size_t row = 0; row < r.state().response.jump.size(); row += rows)
            normal.push_back(r.state().response.jump[row]);
        return normal;
    }
    const std::vector<double> u = r.observer().displacement(r.state());
    const Mesh& mesh = *r.observer().problem().mesh;
    const std::size_t dim = index(mesh.dimension());
    std::vector<double> found;
    for (const InterfaceGeometry& interface : mesh.interfaces())
        for (std::size_t p = 0; p < interface.weight.size(); ++p) {
            double gap = 0.0;
            for (std::size_t c = 0; c < dim; ++c)
                gap += interface.frame[p * dim * dim + c] *
                       (u[index(interface.node_b[p]) * dim + c] - u[index(interface.node_a[p]) * dim + c]);
            found.push_back(gap);
        }
    for (const GapRow& gap : r.observer().problem().gap_rows())
        found[index(gap.row) / dim] += gap.value * r.state().theta[index(gap.pattern)];
    return found;
}

double ratio(double a, double b) { return b > 0.0 ? a / b : a; }

double kkt_gap(const Reading& r) {
    // Gaps are differences of displacements, and of these from initial gaps.
    double most = max_abs(r.observer().displacement(r.state()));
    for (const GapRow& gap : r.observer().problem().gap_rows())
        most = std::max(most, std::abs(gap.value * r.state().theta[index(gap.pattern)]));
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * most;
    double deepest = 0.0;
    for (const double gap : gaps(r)) deepest = -gap > rounding ? std::max(deepest, -gap) : deepest;
    return ratio(deepest, max_abs(r.state().response.jump));
}

bool in_contact(const Reading& r, std::size_t pair) {
    return r.observer().contact().bonded[pair] == 0 && r.state().closed[pair] != 0;
}

// Normal forces of the pairs in contact, [pairs]; 0 for the others, and where they are rounding.
std::vector<double> contact_forces(const Reading& r) {
    const Response& response = r.state().response;
    const double rounding = r.observer().contact().rounding_of_forces(r.state().theta, response.jump);
    std::vector<double> forces(r.state().closed.size(), 0.0);
    for (std::size_t p = 0; p < forces.size(); ++p)
        if (const double f = response.force[p * r.dimension()]; in_contact(r, p) && std::abs(f) > rounding)
            forces[p] = f;
    return forces;
}

double kkt_pressure(const Reading& r) {
    double pull = 0.0;
    for (const double f : contact_forces(r)) pull = std::max(pull, f);
    return ratio(pull, max_abs(r.state().response.force));
}

double kkt_complementarity(const Reading& r) {
    const Response& response = r.state().response;
    const std::vector<double> gap = gaps(r), force = contact_forces(r);
    double product = 0.0;
    for (std::size_t p = 0; p < force.size(); ++p) product = std::max(product, std::abs(gap[p] * force[p]));
    return ratio(product, max_abs(response.jump) * max_abs(response.force));
}

// The point of an interface's fronts (-1: of all) with the largest energy release rate; a point of zeros where there is
// no front.
FrontPoint leading_point(const Reading& r, std::int64_t interface) {
    FrontPoint leading;
    bool found = false;
    for (std::int64_t i = 0; i < r.interfaces(); ++i) {
        if (interface >= 0 && i != interface) continue;
        for (const CrackFront& front : r.fronts(i))
            for (const FrontPoint& point : front.points) {
                if (found && !(point.total() > leading.total())) continue;
                leading = point;
                found = true;
            }
    }
    return leading;
}

// The mean of the energy release rates along an interface's fronts (-1: along all), by modes: in 3D weighted by the
// length of front that belongs to each point, in 2D over the tips.
Vector3 mean_rate(const Reading& r, std::int64_t interface) {
    Vector3 sum{};
    double whole = 0.0;
    for (std::int64_t i = 0; i < r.interfaces(); ++i) {
        if (interface >= 0 && i != interface) continue;
        for (const CrackFront& front : r.fronts(i))
            for (const FrontPoint& point : front.points) {
                const double share = r.dimension() == 2 ? 1.0 : point.length;
                for (std::size_t mode = 0; mode < 3; ++mode) sum[mode] += share * point.rate[mode];
                whole += share;
            }
    }
    for (double& rate : sum) rate = whole > 0.0 ? rate / whole : 0.0;
    return sum;
}
// The mean of another number of the points, with the same weights.
double mean_of(const Reading& r, std::int64_t interface, double FrontPoint::*member) {
    double sum = 0.0, whole = 0.0;
    for (std::int64_t i = 0; i < r.interfaces(); ++i) {
        if (interface >= 0 && i != interface) continue;
        for (const CrackFront& front : r.fronts(i))
            for (const FrontPoint& point : front.points) {
                const double share = r.dimension() == 2 ? 1.0 : point.length;
                sum += share * point.*member;
                whole += share;
            }
    }
    return whole > 0.0 ? sum / whole : 0.0;
}

constexpr const char* by_recovery = "reading it takes a sparse solve, which recovers the displacements";
constexpr const char* counts_on = "it counts since the solver was created and is not part of a state";

// The part is an interface (-1: all together) or a pattern.
using OfState = double (*)(const State&);
using OfLedger = double (*)(const Ledger&);
using OfReading = double (*)(const Reading&);
using OfPart = double (*)(const Reading&, std::int64_t);

struct Row {
    ValueInfo info;
    std::variant<OfState, OfLedger, OfReading, OfPart> read;
};

constexpr Row row(const char* key, const char* unit, const char* meaning, OfState read, const char* alias = "") {
    return {{key, alias, unit, ValueCost::free, ValueScope::whole, meaning}, read};
}
constexpr Row ledger_row(const char* key, const char* unit, const char* meaning, OfLedger read,
                         const char* alias = "") {
    return {{key, alias, unit, ValueCost::free, ValueScope::whole, meaning}, read};
}
constexpr Row read_row(const char* key, const char* unit, const char* meaning, OfReading read) {
    return {{key, "", unit, ValueCost::reads, ValueScope::whole, meaning}, read};
}
constexpr Row life_row(const char* key, const char* meaning, OfReading read) {
    return {{key, "", "-", ValueCost::free, ValueScope::whole, meaning, counts_on}, read};
}
constexpr Row recovered_row(const char* key, const char* unit, const char* meaning, OfReading read) {
    return {{key, "", unit, ValueCost::recovers, ValueScope::whole, meaning, by_recovery}, read};
}
constexpr Row front_row(const char* key, const char* unit, const char* meaning, OfPart read) {
    return {{key, "", unit, ValueCost::reads, ValueScope::interface, meaning}, read};
}
constexpr Row pattern_row(const char* key, const char* unit, const char* meaning, OfPart read) {
    return {{key, "", unit, ValueCost::free, ValueScope::pattern, meaning}, read};
}

// In the order of the list that hosts read; a new row goes to the end of its scope.
constexpr Row table[] = {
    row("step", "-", "number of the load step; the initial state is 0", [](const State& s) { return count(s.step); }),
    row("time", "t", "time of the state", [](const State& s) { return s.time; }),
    ledger_row("stored_bulk", "F L", "elastic energy of the bodies", [](const Ledger& l) { return l.stored_bulk; }),
    ledger_row("stored_interface", "F L", "energy stored in the interfaces, with the gradient term",
               [](const Ledger& l) { return l.stored_interface; }),
    ledger_row("dissipated", "F L", "energy dissipated by damage since the start",
               [](const Ledger& l) { return l.dissipated; }),
    ledger_row(
        "stored_interface_slides", "F L", "stored_interface in the split whose dissipation is linear in the damage",
        [](const Ledger& l) { return l.stored_interface_linear; }, "stored_interface_linear"),
    ledger_row(
        "dissipated_slides", "F L", "dissipated in the split whose dissipation is linear in the damage",
        [](const Ledger& l) { return l.dissipated_linear; }, "dissipated_linear"),
    ledger_row("load_potential", "F L", "potential of the dead forces",
               [](const Ledger& l) { return l.load_potential; }),
    ledger_row("work", "F L", "work of the loads since the start", [](const Ledger& l) { return l.work; }),
    ledger_row("lower", "F L", "lower bound of the two-sided estimate of the step",
               [](const Ledger& l) { return l.lower; }),
    ledger_row("increment", "F L", "change of stored energy and potential in the step plus what it dissipated",
               [](const Ledger& l) { return l.increment; }),
    ledger_row("upper", "F L", "upper bound of the two-sided estimate of the step",
               [](const Ledger& l) { return l.upper; }),
    ledger_row("increment_lower", "F L", "increment at the mixities of the step before",
               [](const Ledger& l) { return l.increment_lower; }),
    ledger_row("defect", "F L", "error of the energy balance since the start",
               [](const Ledger& l) { return l.defect(); }),
    ledger_row(
        "defect_slides", "F L", "defect in the split whose dissipation is linear in the damage",
        [](const Ledger& l) { return l.defect_linear(); }, "defect_linear"),
    ledger_row("mixity_error", "-",
               "estimated error of the energy dissipated in the step, because the mode mixity changes, relative to it",
               [](const Ledger& l) { return l.mixity_error; }),
    row(
        "am_iterations", "-", "iterations of the staggered scheme in the step",
        [](const State& s) { return count(s.effort.am_iterations); }, "staggered_iterations"),
    row("displacement_solves", "-", "displacement solves of the step",
        [](const State& s) { return count(s.effort.displacement_solves); }),
    row("contact_iterations", "-", "active-set steps of the step, over all displacement solves",
        [](const State& s) { return count(s.effort.contact_iterations); }),
    row("contact_iterations_first", "-", "active-set steps of the first displacement solve of the step",
        [](const State& s) { return count(s.effort.contact_iterations_first); }),
    row("contact_iterations_max", "-", "active-set steps of the worst displacement solve of the step",
        [](const State& s) { return count(s.effort.contact_iterations_max); }),
    row("contact_fallbacks", "-",
        "displacement solves whose active sets recurred, so that the feasible descent went on",
        [](const State& s) { return count(s.effort.contact_fallbacks); }),
    row("linear_iterations", "-", "Krylov iterations of the step",
        [](const State& s) { return count(s.effort.linear_iterations); }),
    row("newton_solves", "-", "solves of the step in a zone, for the pairs that a Newton step changes",
        [](const State& s) { return count(s.effort.newton_solves); }),
    row(
        "debond_moves", "-", "unstable pairs that the step took straight to their debonded branch",
        [](const State& s) { return count(s.effort.debond_moves); }, "unstable_debonds"),
    read_row("contact_pairs", "-", "pairs in contact",
             [](const Reading& r) {
                 return count(std::count(r.state().closed.begin(), r.state().closed.end(), std::uint8_t{1}));
             }),
    read_row("debonded_length", "L or L2", "weight of the pairs that adhered at first and have debonded",
             [](const Reading& r) { return over_bond(r, [](double z) { return z <= debonded_below ? 1.0 : 0.0; }); }),
    read_row("front", "L or L2",
             "advance of the front: sum of weight (1 - adhesion) of the pairs that adhered at first",
             [](const Reading& r) { return over_bond(r, [](double z) { return 1.0 - z; }); }),
    read_row("process_zone", "L or L2", "weight of the pairs in the process zone",
             [](const Reading& r) { return over_interfaces(r, -1, process_zone); }),
    row("backtracks", "-", "returns to an earlier step that the step has made",
        [](const State& s) { return count(s.history.backtracks); }),
    row("revisions", "-", "times that a return has recomputed the step",
        [](const State& s) { return count(s.history.revisions); }),
    row("revised_from", "-", "first step that a return from this step has recomputed; its own number if none",
        [](const State& s) { return count(s.history.revised_from); }),
    row("search_candidates", "-", "states that the energetic search compared",
        [](const State& s) { return count(s.effort.search_candidates); }),
    row("search_margin", "F L", "energy of the lowest of these states minus that of the accepted state",
        [](const State& s) { return s.outcome.search_margin; }),
    row("search_gap", "F L",
        "energy of the accepted state minus a lower bound on that of the front positions not tried",
        [](const State& s) { return s.outcome.search_gap; }),
    row("substeps", "-", "parts into which the step was divided",
        [](const State& s) { return count(s.history.substeps); }),
    row("refused_steps", "-", "substeps that were computed and discarded",
        [](const State& s) { return count(s.history.refused_steps); }),
    row(
        "jumps", "-", "instants within the step at which the state jumps",
        [](const State& s) { return count(s.outcome.jumps); }, "state_jumps"),
    row("released", "F L", "energy that the step releases, neither stored nor dissipated",
        [](const State& s) { return s.outcome.released; }),
    life_row("bulk_factorisations", "sparse factorisations of the bodies since the solver was made",
             [](const Reading& r) { return count(r.observer().jump_operator().factorisations()); }),
    life_row("field_recoveries", "how often displacements were recovered since the solver was made",
             [](const Reading& r) { return count(r.observer().recoveries()); }),
    row("damage_change", "-", "largest change of adhesion that a further damage step would make",
        [](const State& s) { return s.outcome.damage_change; }),
    row("linear_residual", "-", "worst relative residual of the iterative linear solves of the step",
        [](const State& s) { return s.effort.linear_residual; }),
    recovered_row("kkt_gap", "-", "deepest penetration of the recovered displacements over the largest jump", kkt_gap),
    recovered_row("kkt_pressure", "-", "largest pull of a closed contact over the largest force of a pair",
                  kkt_pressure),
    recovered_row("kkt_complementarity", "-",
                  "largest |gap * force| of a closed contact over the largest jump times the largest force",
                  kkt_complementarity),
    recovered_row(rotation_key, "rad", "largest rotation of a cell",
                  [](const Reading& r) { return r.observer().largest_rotation(r.state()); }),
    recovered_row("kkt_equilibrium", "-",
                  "largest out-of-balance nodal force over the largest reaction or nodal force of eigenstrains",
                  [](const Reading& r) { return r.observer().equilibrium_defect(r.state()); }),
    row("free_bodies", "-", "bodies of which nothing holds all motions: neither adhesion, supports nor contact",
        [](const State& s) {
            return count(
                std::count_if(s.free_since.begin(), s.free_since.end(), [](std::int64_t k) { return k >= 0; }));
        }),
    row("pops", "-", "pairs that came apart one by one at one load, because the mesh resolves no process zone",
        [](const State& s) { return count(s.outcome.pops); }),
    row("popped", "F L", "part of `released` that these pairs set free",
        [](const State& s) { return s.outcome.popped; }),
    recovered_row("mesh_error", "-", "estimated error of the bodies' elastic energy, away from the fronts of cracks",
                  [](const Reading& r) { return r.observer().mesh_error(r.state()).away; }),
    recovered_row("mesh_error_fronts", "-", "the same in the cells at the fronts of cracks",
                  [](const Reading& r) { return r.observer().mesh_error(r.state()).fronts; }),
    recovered_row("mesh_excess", "-", "part of that energy that incompatible modes would take off standard cells",
                  [](const Reading& r) { return r.observer().mesh_error(r.state()).excess; }),
    row("buckling_modes", "-", "modes along which the step has left states in balance that were not stable",
        [](const State& s) { return count(s.outcome.buckling.modes); }),
    row("buckling_time", "-", "time at which the first of these states began to buckle; 0: there is none",
        [](const State& s) { return s.outcome.buckling.time; }),
    row("buckling_released", "F L", "part of `released` that is set free where the bodies snap through",
        [](const State& s) { return s.outcome.buckling.released; }),
    recovered_row("rotation_error", "-",
                  "estimated error of strains that are linear in the displacements; 0 with large rotations",
                  [](const Reading& r) { return r.observer().left_out(r.state(), &SmallRotations::error, 0.0); }),
    recovered_row("buckling_ratio", "-", "stresses over those at which the bodies buckle, at this adhesion and contact",
                  [](const Reading& r) { return r.observer().left_out(r.state(), &SmallRotations::buckling_ratio); }),
    front_row("crack_length", "L or L2", "initially open length or area plus the advance of its fronts",
              [](const Reading& r, std::int64_t i) { return over_interfaces(r, i, crack_length); }),
    front_row("energy_release_rate", "F/L", "largest energy release rate of a front point; 0: there is no front",
              [](const Reading& r, std::int64_t i) { return leading_point(r, i).total(); }),
    front_row("front_mixity", "-", "share of the shearing modes in that energy release rate",
              [](const Reading& r, std::int64_t i) { return leading_point(r, i).mixity(); }),
    front_row("process_zone_length", "L", "length of the process zone at that point",
              [](const Reading& r, std::int64_t i) { return leading_point(r, i).zone; }),
    front_row("process_zone_pairs", "-", "pairs in the process zone at that point",
              [](const Reading& r, std::int64_t i) { return leading_point(r, i).zone_pairs; }),
    front_row("energy_release_rate_mean", "F/L", "mean energy release rate along the fronts; 0: there is no front",
              [](const Reading& r, std::int64_t i) { return total_rate(mean_rate(r, i)); }),
    front_row("front_mixity_mean", "-", "share of the shearing modes in that mean",
              [](const Reading& r, std::int64_t i) { return shear_share(mean_rate(r, i)); }),
    front_row("crack_area", "L or L2",
              "initially open length or area plus what the line in the middle of the process zone has swept",
              [](const Reading& r, std::int64_t i) { return over_interfaces(r, i, crack_area); }),
    front_row("process_zone_length_mean", "L", "mean length of the process zone along the fronts",
              [](const Reading& r, std::int64_t i) { return mean_of(r, i, &FrontPoint::zone); }),
    front_row("process_zone_pairs_mean", "-", "mean number of pairs across the process zone along the fronts",
              [](const Reading& r, std::int64_t i) { return mean_of(r, i, &FrontPoint::zone_pairs); }),
    pattern_row("load", "-", "factor of the load pattern",
                [](const Reading& r, std::int64_t p) { return r.state().theta[index(p)]; }),
    pattern_row("reaction", "F L",
                "conjugate of the load pattern, positive where it acts in the direction of a growing factor",
                [](const Reading& r, std::int64_t p) { return r.state().response.conjugate[index(p)]; }),
};

// Rows by key and alias; a row of a part of the scene also by KEY before a colon.
struct RowIndex {
    std::unordered_map<std::string_view, const Row*> by_key, by_alias;
    RowIndex() {
        for (const Row& row : table) {
            by_key.emplace(row.info.key, &row);
            if (*row.info.alias != '\0') by_alias.emplace(row.info.alias, &row);
        }
    }
};

const Row* find_row(std::string_view key) {
    static const RowIndex rows;
    const std::string_view name = key.substr(0, key.find(':'));
    const auto own = rows.by_key.find(name);
    if (own != rows.by_key.end() && (own->second->info.scope != ValueScope::whole || key == name)) return own->second;
    const auto other = rows.by_alias.find(name);
    return other == rows.by_alias.end() ? nullptr : other->second;
}

// Finds the interface or pattern of KEY:I or KEY:NAME; -1: KEY alone. False: no interface or pattern has this name.
bool part_of(const Problem& problem, const ValueInfo& info, const std::string& key, std::int64_t& part) {
    part = -1;
    const std::size_t colon = key.find(':');
    const std::string name = colon == std::string::npos ? "" : key.substr(colon + 1);
    if (info.scope == ValueScope::pattern) {
        for (std::size_t p = 0; p < problem.patterns.size(); ++p)
            if (colon != std::string::npos && name == problem.patterns[p].name) part = static_cast<std::int64_t>(p);
        return part >= 0;
    }
    if (colon == std::string::npos) return true;
    const std::size_t interfaces = info.scope == ValueScope::interface ? problem.interfaces.size() : 0;
    for (std::size_t i = 0; i < interfaces; ++i)
        if (name == std::to_string(i)) part = static_cast<std::int64_t>(i);
    return part >= 0;
}

double read(const Reading& r, const std::string& key) {
    const Row* row = find_row(key);
    std::int64_t part = -1;
    if (row == nullptr || !part_of(r.observer().problem(), row->info, key, part)) {
        std::string known;
        for (const std::string& name : value_names(r.observer().problem())) known += (known.empty() ? "" : ", ") + name;
        fail(DELAM_ERROR_ARGUMENT, "value '", key, "' is not known; known are ", known);
    }
    if (const OfState* of = std::get_if<OfState>(&row->read)) return (*of)(r.state());
    if (const OfLedger* of = std::get_if<OfLedger>(&row->read)) return (*of)(r.state().ledger);
    if (const OfReading* of = std::get_if<OfReading>(&row->read)) return (*of)(r);
    return std::get<OfPart>(row->read)(r, part);
}

}  // namespace

const char* name_of(ValueCost cost) {
    constexpr const char* names[] = {"free", "reads", "recovers"};
    return names[static_cast<std::size_t>(cost)];
}
const char* name_of(ValueScope scope) {
    constexpr const char* names[] = {"whole", "interface", "pattern"};
    return names[static_cast<std::size_t>(scope)];
}

std::vector<std::string> value_names(const Problem& problem) {
    std::vector<std::string> names;
    const auto add = [&](ValueScope scope, const std::string& part) {
        for (const Row& row : table)
            if (row.info.scope == scope) names.push_back(row.info.key + part);
    };
    add(ValueScope::whole, "");
    add(ValueScope::interface, "");
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) add(ValueScope::interface, text(":", i));
    for (const Pattern& pattern : problem.patterns) add(ValueScope::pattern, ":" + pattern.name);
    return names;
}

const ValueInfo* find_value(const std::string& key) {
    const Row* row = find_row(key);
    return row == nullptr ? nullptr : &row->info;
}

std::string value_key(const std::string& key) {
    const ValueInfo* info = find_value(key);
    const std::size_t colon = std::min(key.find(':'), key.size());
    return info == nullptr ? key : info->key + key.substr(colon);
}

const char* why_unrecorded(const std::string& key) {
    const ValueInfo* info = find_value(key);
    return info == nullptr ? nullptr : info->unrecorded;
}

std::optional<KeyedValue> not_finite(const Ledger& ledger) {
    for (const Row& row : table)
        if (const OfLedger* of = std::get_if<OfLedger>(&row.read); of != nullptr && !std::isfinite((*of)(ledger)))
            return KeyedValue{row.info.key, (*of)(ledger)};
    return std::nullopt;
}

std::vector<double> values_of(Observer& observer, const State& state, const std::vector<std::string>& keys) {
    const Reading reading(observer, state);
    std::vector<double> values;
    values.reserve(keys.size());
    for (const std::string& key : keys) values.push_back(read(reading, key));
    return values;
}

double value(Observer& observer, const std::string& key) { return read({observer, observer.state()}, key); }

}  // namespace delam
