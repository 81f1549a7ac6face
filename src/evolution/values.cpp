// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/values.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

double count(std::int64_t n) { return static_cast<double>(n); }
std::int64_t count_of_interfaces(const Problem& problem) {
    return static_cast<std::int64_t>(problem.interfaces.size());
}

// Sum of weight * f(adhesion) over the initially adhering pairs.
template <class F>
double over_bond(const Solver& solver, F f) {
    const State& state = solver.state();
    double sum = 0.0;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p)
        if (solver.pairs().law[p] != nullptr && solver.initial_adhesion()[p] > 0.0)
            sum += solver.pairs().weight[p] * f(state.adhesion[p]);
    return sum;
}

double contact_pairs(const Solver& solver) {
    const auto& closed = solver.state().closed;
    return count(std::count(closed.begin(), closed.end(), std::uint8_t{1}));
}

// Normal jumps of all pairs from the displacements of their nodes, as a host would compute them.
std::vector<double> gaps(const Solver& solver) {
    const std::vector<double> u = solver.displacement();
    const Mesh& mesh = *solver.problem().mesh;
    const auto dim = static_cast<std::size_t>(mesh.dimension());
    std::vector<double> found;
    for (const InterfaceGeometry& interface : mesh.interfaces())
        for (std::size_t p = 0; p < interface.weight.size(); ++p) {
            double gap = 0.0;
            for (std::size_t c = 0; c < dim; ++c)
                gap +=
                    interface.frame[p * dim * dim + c] * (u[static_cast<std::size_t>(interface.node_b[p]) * dim + c] -
                                                          u[static_cast<std::size_t>(interface.node_a[p]) * dim + c]);
            found.push_back(gap);
        }
    return found;
}

double ratio(double a, double b) { return b > 0.0 ? a / b : a; }

double kkt_gap(const Solver& s) {
    double deepest = 0.0;
    for (const double gap : gaps(s)) deepest = std::max(deepest, -gap);
    return ratio(deepest, max_abs(s.state().response.jump));
}

double kkt_pressure(const Solver& s) {
    const State& state = s.state();
    const auto dim = static_cast<std::size_t>(s.pairs().dimension);
    double pull = 0.0;
    for (std::size_t p = 0; p < state.closed.size(); ++p)
        if (s.contact().bonded[p] == 0 && state.closed[p] != 0) pull = std::max(pull, state.response.force[p * dim]);
    return ratio(pull, max_abs(state.response.force));
}

double kkt_complementarity(const Solver& s) {
    const State& state = s.state();
    const auto dim = static_cast<std::size_t>(s.pairs().dimension);
    const std::vector<double> gap = gaps(s);
    double product = 0.0;
    for (std::size_t p = 0; p < state.closed.size(); ++p)
        if (s.contact().bonded[p] == 0 && state.closed[p] != 0)
            product = std::max(product, std::abs(gap[p] * state.response.force[p * dim]));
    return ratio(product, max_abs(state.response.jump) * max_abs(state.response.force));
}

// The point of an interface's fronts (-1: of all) with the largest energy release rate; a point of zeros if there is no
// front.
FrontPoint leading_point(const Solver& s, std::int64_t interface) {
    FrontPoint leading;
    bool found = false;
    for (std::int64_t i = 0; i < count_of_interfaces(s.problem()); ++i) {
        if (interface >= 0 && i != interface) continue;
        for (const CrackFront& front : s.crack_fronts(i))
            for (const FrontPoint& point : front.points) {
                if (found && !(point.total() > leading.total())) continue;
                leading = point;
                found = true;
            }
    }
    return leading;
}

double crack_length(const Solver& s, std::int64_t interface) {
    double sum = 0.0;
    for (std::int64_t i = 0; i < count_of_interfaces(s.problem()); ++i)
        if (interface < 0 || i == interface) sum += s.crack_length(i);
    return sum;
}

// For all interfaces together (-1), and as KEY:I for one.
struct FrontEntry {
    const char* key;
    double (*value)(const Solver&, std::int64_t);
};
constexpr FrontEntry front_table[] = {
    {"crack_length", crack_length},
    {"energy_release_rate", [](const Solver& s, std::int64_t i) { return leading_point(s, i).total(); }},
    {"front_mixity", [](const Solver& s, std::int64_t i) { return leading_point(s, i).mixity(); }},
    {"process_zone_length", [](const Solver& s, std::int64_t i) { return leading_point(s, i).zone; }},
    {"process_zone_pairs", [](const Solver& s, std::int64_t i) { return leading_point(s, i).zone_pairs; }},
};

constexpr const char* recovers = "it recovers the displacements, a sparse solve each";
constexpr const char* counts_on = "it counts over the solver's life and is no part of a state";

struct Entry {
    const char* key;
    double (*value)(const Solver&);
    const char* unrecorded = nullptr;  // why it is not recorded; null: it is
};

constexpr Entry table[] = {
    {"step", [](const Solver& s) { return count(s.state().step); }},
    {"time", [](const Solver& s) { return s.state().time; }},
    {"stored_bulk", [](const Solver& s) { return s.state().ledger.stored_bulk; }},
    {"stored_interface", [](const Solver& s) { return s.state().ledger.stored_interface; }},
    {"dissipated", [](const Solver& s) { return s.state().ledger.dissipated; }},
    {"stored_interface_slides", [](const Solver& s) { return s.state().ledger.stored_interface_slides; }},
    {"dissipated_slides", [](const Solver& s) { return s.state().ledger.dissipated_slides; }},
    {"load_potential", [](const Solver& s) { return s.state().ledger.load_potential; }},
    {"work", [](const Solver& s) { return s.state().ledger.work; }},
    {"lower", [](const Solver& s) { return s.state().ledger.lower; }},
    {"increment", [](const Solver& s) { return s.state().ledger.increment; }},
    {"upper", [](const Solver& s) { return s.state().ledger.upper; }},
    {"increment_lower", [](const Solver& s) { return s.state().ledger.increment_lower; }},
    {"defect", [](const Solver& s) { return s.state().ledger.defect(); }},
    {"defect_slides", [](const Solver& s) { return s.state().ledger.defect_slides(); }},
    {"mixity_error", [](const Solver& s) { return s.state().ledger.mixity_error; }},
    {"am_iterations", [](const Solver& s) { return count(s.state().effort.am_iterations); }},
    {"displacement_solves", [](const Solver& s) { return count(s.state().effort.displacement_solves); }},
    {"contact_iterations", [](const Solver& s) { return count(s.state().effort.contact_iterations); }},
    {"contact_iterations_first", [](const Solver& s) { return count(s.state().effort.contact_iterations_first); }},
    {"contact_iterations_max", [](const Solver& s) { return count(s.state().effort.contact_iterations_max); }},
    {"contact_fallbacks", [](const Solver& s) { return count(s.state().effort.contact_fallbacks); }},
    {"linear_iterations", [](const Solver& s) { return count(s.state().effort.linear_iterations); }},
    {"newton_solves", [](const Solver& s) { return count(s.state().effort.newton_solves); }},
    {"debond_moves", [](const Solver& s) { return count(s.state().effort.debond_moves); }},
    {"contact_pairs", contact_pairs},
    {"debonded_length",
     [](const Solver& s) { return over_bond(s, [](double zeta) { return zeta <= debonded_below ? 1.0 : 0.0; }); }},
    {"front", [](const Solver& s) { return over_bond(s, [](double zeta) { return 1.0 - zeta; }); }},
    {"process_zone",
     [](const Solver& s) {
         double sum = 0.0;
         for (std::int64_t i = 0; i < count_of_interfaces(s.problem()); ++i) sum += s.process_zone(i);
         return sum;
     }},
    {"backtracks", [](const Solver& s) { return count(s.state().history.backtracks); }},
    {"revisions", [](const Solver& s) { return count(s.state().history.revisions); }},
    {"revised_from", [](const Solver& s) { return count(s.state().history.revised_from); }},
    {"search_candidates", [](const Solver& s) { return count(s.state().effort.search_candidates); }},
    {"search_margin", [](const Solver& s) { return s.state().outcome.search_margin; }},
    {"search_gap", [](const Solver& s) { return s.state().outcome.search_gap; }},
    {"substeps", [](const Solver& s) { return count(s.state().history.substeps); }},
    {"refused_steps", [](const Solver& s) { return count(s.state().history.refused_steps); }},
    {"jumps", [](const Solver& s) { return count(s.state().outcome.jumps); }},
    {"released", [](const Solver& s) { return s.state().outcome.released; }},
    {"bulk_factorisations", [](const Solver& s) { return count(s.jump_operator().factorisations()); }, counts_on},
    {"field_recoveries", [](const Solver& s) { return count(s.recoveries()); }, counts_on},
    {"damage_change", [](const Solver& s) { return s.state().outcome.damage_change; }},
    {"linear_residual", [](const Solver& s) { return s.state().effort.linear_residual; }},
    {"kkt_gap", kkt_gap, recovers},
    {"kkt_pressure", kkt_pressure, recovers},
    {"kkt_complementarity", kkt_complementarity, recovers},
    {"rotation_max", [](const Solver& s) { return s.largest_rotation(); }, recovers},
    {"kkt_equilibrium", [](const Solver& s) { return s.equilibrium_defect(); }, recovers},
};

}  // namespace

std::vector<std::string> value_names(const Problem& problem) {
    std::vector<std::string> names;
    for (const Entry& entry : table) names.emplace_back(entry.key);
    for (std::int64_t i = -1; i < count_of_interfaces(problem); ++i)
        for (const FrontEntry& entry : front_table) names.push_back(i < 0 ? entry.key : text(entry.key, ":", i));
    for (const Pattern& pattern : problem.patterns) {
        names.push_back("load:" + pattern.name);
        names.push_back("reaction:" + pattern.name);
    }
    return names;
}

const char* why_unrecorded(const std::string& key) {
    for (const Entry& entry : table)
        if (key == entry.key) return entry.unrecorded;
    return nullptr;
}

double value(const Solver& solver, const std::string& key) {
    for (const Entry& entry : table)
        if (key == entry.key) return entry.value(solver);
    for (const FrontEntry& entry : front_table) {
        if (key == entry.key) return entry.value(solver, -1);
        if (key.rfind(text(entry.key, ":"), 0) != 0) continue;
        for (std::int64_t i = 0; i < count_of_interfaces(solver.problem()); ++i)
            if (key == text(entry.key, ":", i)) return entry.value(solver, i);
    }
    const auto& patterns = solver.problem().patterns;
    for (std::size_t p = 0; p < patterns.size(); ++p) {
        if (key == "load:" + patterns[p].name) return solver.state().theta[p];
        if (key == "reaction:" + patterns[p].name) return solver.state().response.conjugate[p];
    }
    std::string known;
    for (const std::string& name : value_names(solver.problem())) {
        if (!known.empty()) known += ", ";
        known += name;
    }
    fail(DELAM_ERROR_ARGUMENT, "value '", key, "' is not known; known are ", known);
}

}  // namespace delam
