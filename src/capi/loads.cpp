// SPDX-License-Identifier: BSD-3-Clause
// Load patterns, prescribed displacements, equations, periodic cells and dead forces.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "mesh/face_gaps.hpp"
#include "mesh/points.hpp"
#include "scene/periodic.hpp"
#include "scene/problem.hpp"

namespace {

using namespace delam;
using Direction = std::array<double, 3>;

void require_name(const char* name) {
    require_pointer(name, "name");
    const std::string word = name;
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    if (word.empty() || !std::all_of(word.begin(), word.end(), plain)) {
        fail(DELAM_ERROR_ARGUMENT, "name = '", word, "' must consist of letters, digits, '_' and '-'");
    }
}

// The unit vector along `direction`.
Direction require_direction(const Mesh& mesh, const double* direction) {
    require_pointer(direction, "direction");
    require_finite(direction, mesh.dimension(), "direction");
    const double largest = max_abs({direction, index(mesh.dimension())});
    if (largest == 0.0) fail(DELAM_ERROR_ARGUMENT, "direction has length 0");
    Direction unit{};
    double length = 0.0;
    for (int d = 0; d < mesh.dimension(); ++d) {
        unit[index(d)] = direction[d] / largest;
        length += unit[index(d)] * unit[index(d)];
    }
    for (double& value : unit) value /= std::sqrt(length);
    return unit;
}

// Returns a node of a body, a control node (of no body) or a tied node.
std::int64_t require_node(const Mesh& mesh, std::int64_t value, std::int32_t index_base, const std::string& what) {
    return require_index(value, mesh.node_count(), index_base, what);
}

// Even finite arguments may have a sum or a quotient that is not finite.
template <class... What>
void require_no_overflow(double value, const What&... what) {
    if (!std::isfinite(value)) fail(DELAM_ERROR_ARGUMENT, what..., " amounts to ", value, ", must be finite");
}

// Displacements with coefficients, each DOF once; tied nodes are replaced by the nodes to which they are tied.
class Terms {
public:
    explicit Terms(const Mesh& mesh) : mesh_(mesh) {}
    void add(std::int64_t node, std::int64_t component, double coefficient) {
        if (coefficient == 0.0) return;
        const auto& ties = mesh_.ties();
        const auto tie = std::lower_bound(ties.begin(), ties.end(), node,
                                          [](const NodeTie& t, std::int64_t n) { return t.node < n; });
        if (tie == ties.end() || tie->node != node) {
            sum_[mesh_.dimension() * node + component] += coefficient;
            return;
        }
        for (const auto& [other, weight] : tie->of) sum_[mesh_.dimension() * other + component] += weight * coefficient;
    }
    const std::map<std::int64_t, double>& list() const { return sum_; }
    Constraint constraint(std::vector<double> prescribed) const {
        Constraint c;
        for (const auto& [dof, coefficient] : sum_) {
            poll_cancel("loads");
            if (coefficient == 0.0) continue;
            require_no_overflow(coefficient, "a coefficient of node ", dof / mesh_.dimension());
            c.dof.push_back(dof);
            c.coefficient.push_back(coefficient);
        }
        if (c.dof.empty()) fail(DELAM_ERROR_ARGUMENT, "all coefficients are 0 or too small: nothing is prescribed");
        c.prescribed = std::move(prescribed);
        return c;
    }

private:
    const Mesh& mesh_;
    std::map<std::int64_t, double> sum_;
};

const char* name_of(Pattern::Drives drives) {
    switch (drives) {
        case Pattern::Drives::nothing:
            return "nothing";
        case Pattern::Drives::displacement:
            return "prescribed displacements";
        case Pattern::Drives::force:
            return "forces";
        case Pattern::Drives::strain:
            return "eigenstrains";
        case Pattern::Drives::gap:
            return "gaps";
    }
    return "";
}

// Returns the patterns as 0-based indices, after checking that none of them drives the other kind of load.
std::vector<std::int64_t> require_patterns(const Problem& problem, std::int64_t count, const std::int64_t* patterns,
                                           std::int32_t index_base, Pattern::Drives drives) {
    require_count(count, "pattern_count");
    require_array(patterns, count, "patterns");
    std::vector<std::int64_t> list(index(count));
    for (std::int64_t i = 0; i < count; ++i) {
        list[index(i)] = require_index(patterns[i], static_cast<std::int64_t>(problem.patterns.size()), index_base,
                                       text("patterns[", i, "]"));
        const Pattern& pattern = problem.patterns[index(list[index(i)])];
        if (pattern.drives != Pattern::Drives::nothing && pattern.drives != drives) {
            fail(DELAM_ERROR_PROBLEM, "pattern '", pattern.name, "' drives ", name_of(pattern.drives),
                 " already and cannot also drive ", name_of(drives));
        }
    }
    return list;
}

std::vector<double> prescribed(const Problem& problem, const std::vector<std::int64_t>& patterns,
                               const double* coefficients) {
    std::vector<double> list(problem.patterns.size(), 0.0);
    for (std::size_t p = 0; p < patterns.size(); ++p) {
        double& sum = list[index(patterns[p])];
        sum += coefficients[p];
        require_no_overflow(sum, "the coefficient of pattern ", patterns[p]);
    }
    return list;
}

// Directions in which single nodes are already prescribed.
std::unordered_map<std::int64_t, std::vector<Direction>> held_directions(const Problem& problem) {
    const std::int64_t dimension = problem.mesh->dimension();
    std::unordered_map<std::int64_t, std::vector<Direction>> held;
    for (const Constraint& constraint : problem.constraints) {
        poll_cancel("loads");
        if (constraint.end) continue;  // the checks of the stages tell whether it has ended by then
        if (constraint.dof.front() / dimension != constraint.dof.back() / dimension) continue;
        Direction direction{};
        double length = 0.0;
        for (const double c : constraint.coefficient) length = std::hypot(length, c);
        for (std::size_t i = 0; i < constraint.dof.size(); ++i) {
            direction[index(constraint.dof[i] % dimension)] = constraint.coefficient[i] / length;
        }
        held[constraint.dof.front() / dimension].push_back(direction);
    }
    return held;
}

// True if `direction` is a combination of the others, which are linearly independent (Gram-Schmidt).
bool depends(std::vector<Direction> others, Direction direction) {
    std::vector<Direction> basis;
    others.push_back(direction);
    for (Direction& next : others) {
        for (const Direction& unit : basis) {
            const double along = dot(next, unit);
            for (std::size_t d = 0; d < 3; ++d) next[d] -= along * unit[d];
        }
        const double length = std::sqrt(dot(next, next));
        if (length < 1e-10) return true;
        for (double& value : next) value /= length;
        basis.push_back(next);
    }
    return false;
}

void mark(Problem& problem, const std::vector<std::int64_t>& patterns, Pattern::Drives drives) noexcept {
    for (const std::int64_t p : patterns) problem.patterns[index(p)].drives = drives;
}

// Lets constraints begin or end at a time, with a pattern for what is there then.
void change_constraints(Problem& problem, std::int64_t first, std::int64_t count, double time, std::int64_t pattern,
                        std::optional<Constraint::Change> Constraint::*change) {
    const bool begins = change == &Constraint::begin;
    const auto drives = begins ? Pattern::Drives::displacement : Pattern::Drives::force;
    const auto all = static_cast<std::int64_t>(problem.constraints.size());
    require_count_up_to(count, "count", 1, all);
    require_index(first, all - count + 1, 0, "first");
    require_finite(&time, 1, "time");
    const std::vector<std::int64_t> list = require_patterns(problem, 1, &pattern, 0, drives);
    const Pattern& own = problem.patterns[index(list.front())];
    if (own.at(time) == 0.0)
        fail(DELAM_ERROR_ARGUMENT, "pattern '", own.name, "' has the factor 0 at time ", time, ", must not be 0");
    for (std::int64_t c = first; c < first + count; ++c) {
        const Constraint& constraint = problem.constraints[index(c)];
        const double from = begins ? time : constraint.begin ? constraint.begin->time : -infinite;
        const double until = !begins ? time : constraint.end ? constraint.end->time : infinite;
        if (!(from < until))
            fail(DELAM_ERROR_PROBLEM, "constraint ", c, " would begin at time ", from, " and end at time ", until,
                 ": it must end later");
    }
    for (std::int64_t c = first; c < first + count; ++c)
        problem.constraints[index(c)].*change = Constraint::Change{time, pattern};
    mark(problem, list, drives);
}

}  // namespace

int32_t delam_problem_begin_constraints(delam_problem* problem, int64_t first, int64_t count, double time,
                                        int64_t pattern) {
    return guard(problem, [&] { change_constraints(*problem->core, first, count, time, pattern, &Constraint::begin); });
}

int32_t delam_problem_end_constraints(delam_problem* problem, int64_t first, int64_t count, double time,
                                      int64_t pattern) {
    return guard(problem, [&] { change_constraints(*problem->core, first, count, time, pattern, &Constraint::end); });
}

int32_t delam_problem_add_pattern(delam_problem* problem, const char* name, int64_t count, const double* times,
                                  const double* values, int64_t* out_pattern) {
    return guard(problem, [&] {
        require_pointer(out_pattern, "out_pattern");
        require_name(name);
        require_history(count, times, values);
        std::vector<Pattern>& patterns = problem->core->patterns;
        for (const Pattern& other : patterns) {
            if (other.name == name)
                fail(DELAM_ERROR_ARGUMENT, "name = '", name, "' is already the name of another pattern");
        }
        Pattern pattern{name, {times, times + count}, {values, values + count}};
        patterns.push_back(std::move(pattern));
        try {
            problem->names.emplace_back(name);
        } catch (...) {
            patterns.pop_back();
            throw;
        }
        *out_pattern = static_cast<std::int64_t>(patterns.size()) - 1;
    });
}

int32_t delam_problem_prescribe_nodes(delam_problem* problem, int64_t count, const int64_t* nodes,
                                      const double* direction, int64_t pattern_count, const int64_t* patterns,
                                      const double* coefficients, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t dimension = core.mesh->dimension();
        require_base(index_base);
        require_count(count, "count");
        require_array(nodes, count, "nodes");
        const Direction unit = require_direction(*core.mesh, direction);
        const auto list = require_patterns(core, pattern_count, patterns, index_base, Pattern::Drives::displacement);
        require_array(coefficients, count * pattern_count, "coefficients");
        require_finite(coefficients, count * pattern_count, "coefficients");
        auto held = held_directions(core);
        std::vector<Constraint> added;
        for (std::int64_t i = 0; i < count; ++i) {
            poll_cancel("loads");
            const std::int64_t node = require_node(*core.mesh, nodes[i], index_base, text("nodes[", i, "]"));
            std::vector<Direction>& others = held[node];
            if (depends(others, unit)) {
                fail(DELAM_ERROR_PROBLEM, "nodes[", i, "] = ", nodes[i],
                     ": the displacement of this node is prescribed along (", unit[0], ", ", unit[1],
                     dimension == 3 ? text(", ", unit[2]) : "", ") already");
            }
            others.push_back(unit);
            Terms terms(*core.mesh);
            for (std::int64_t d = 0; d < dimension; ++d) terms.add(node, d, unit[index(d)]);
            added.push_back(terms.constraint(prescribed(core, list, coefficients + i * pattern_count)));
        }
        core.constraints.insert(core.constraints.end(), std::make_move_iterator(added.begin()),
                                std::make_move_iterator(added.end()));
        if (count > 0) mark(core, list, Pattern::Drives::displacement);
    });
}

int32_t delam_problem_prescribe_mean(delam_problem* problem, int64_t count, const int64_t* nodes, const double* weights,
                                     const double* direction, int64_t pattern_count, const int64_t* patterns,
                                     const double* coefficients, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t dimension = core.mesh->dimension();
        require_base(index_base);
        require_count(count, "count", 1);
        require_array(nodes, count, "nodes");
        require_array(weights, count, "weights");
        require_finite(weights, count, "weights");
        const Direction unit = require_direction(*core.mesh, direction);
        const auto list = require_patterns(core, pattern_count, patterns, index_base, Pattern::Drives::displacement);
        require_array(coefficients, pattern_count, "coefficients");
        require_finite(coefficients, pattern_count, "coefficients");
        double sum = 0.0;
        std::vector<std::pair<std::int64_t, double>> members;
        for (std::int64_t i = 0; i < count; ++i) {
            poll_cancel("loads");
            members.emplace_back(require_node(*core.mesh, nodes[i], index_base, text("nodes[", i, "]")), weights[i]);
            sum += weights[i];
        }
        // Weights of quadratic faces may be negative at corner nodes; their sum is the extent of the patch.
        if (!(sum > 0.0 && std::isfinite(sum)))
            fail(DELAM_ERROR_ARGUMENT, "weights: their sum is ", sum, ", must be > 0 and finite");
        std::sort(members.begin(), members.end());
        Terms terms(*core.mesh);
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (i > 0 && members[i].first == members[i - 1].first) {
                fail(DELAM_ERROR_ARGUMENT, "nodes: node ", members[i].first + index_base, " is listed twice");
            }
            poll_cancel("loads");
            for (std::int64_t d = 0; d < dimension; ++d)
                terms.add(members[i].first, d, members[i].second / sum * unit[index(d)]);
        }
        core.constraints.push_back(terms.constraint(prescribed(core, list, coefficients)));
        mark(core, list, Pattern::Drives::displacement);
    });
}

int32_t delam_problem_add_equation(delam_problem* problem, int64_t count, const int64_t* nodes,
                                   const double* coefficients, int64_t pattern_count, const int64_t* patterns,
                                   const double* prescribed_values, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t dimension = core.mesh->dimension();
        require_base(index_base);
        require_count(count, "count", 1);
        require_array(nodes, count, "nodes");
        require_array(coefficients, count, "coefficients");
        require_finite(coefficients, count * dimension, "coefficients");
        const auto list = require_patterns(core, pattern_count, patterns, index_base, Pattern::Drives::displacement);
        require_array(prescribed_values, pattern_count, "prescribed");
        require_finite(prescribed_values, pattern_count, "prescribed");
        Terms terms(*core.mesh);
        double largest = 0.0;
        for (std::int64_t i = 0; i < count; ++i) {
            poll_cancel("loads");
            const std::int64_t node = require_node(*core.mesh, nodes[i], index_base, text("nodes[", i, "]"));
            for (std::int64_t d = 0; d < dimension; ++d) {
                terms.add(node, d, coefficients[i * dimension + d]);
                largest = std::max(largest, std::abs(coefficients[i * dimension + d]));
            }
        }
        Constraint constraint = terms.constraint(prescribed(core, list, prescribed_values));
        if (std::none_of(constraint.coefficient.begin(), constraint.coefficient.end(),
                         [&](double c) { return std::abs(c) > 1e-14 * largest; }))
            fail(DELAM_ERROR_ARGUMENT,
                 "coefficients: their sums over each node are all 0, so that the equation is empty");
        core.constraints.push_back(std::move(constraint));
        mark(core, list, Pattern::Drives::displacement);
    });
}

int32_t delam_problem_add_periodic(delam_problem* problem, int64_t period_count, const double* periods,
                                   const int64_t* control_nodes, double tolerance, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t dimension = core.mesh->dimension();
        require_base(index_base);
        require_count(period_count, "period_count", 1);
        if (period_count > dimension)
            fail(DELAM_ERROR_ARGUMENT, "period_count = ", period_count, ": must be in 1..", dimension);
        require_array(periods, period_count, "periods");
        require_array(control_nodes, period_count, "control_nodes");
        require_finite(periods, period_count * dimension, "periods");
        if (!(tolerance >= 0.0 && tolerance < 0.5))
            fail(DELAM_ERROR_ARGUMENT, "tolerance = ", tolerance, ": must be in 0 .. 0.5");
        std::vector<std::int64_t> controls;
        for (std::int64_t k = 0; k < period_count; ++k) {
            const std::int64_t node =
                require_node(*core.mesh, control_nodes[k], index_base, text("control_nodes[", k, "]"));
            const auto& ties = core.mesh->ties();
            const bool tied = std::any_of(ties.begin(), ties.end(), [&](const NodeTie& t) { return t.node == node; });
            if (core.mesh->node_body(node) >= 0 || tied)
                fail(DELAM_ERROR_ARGUMENT, "control_nodes[", k, "] = ", control_nodes[k],
                     tied ? " is a tied node" : " belongs to a body",
                     ": must be a control node, of no body and not tied");
            if (std::find(controls.begin(), controls.end(), node) != controls.end())
                fail(DELAM_ERROR_ARGUMENT, "control_nodes[", k, "] = ", control_nodes[k], " is listed twice");
            controls.push_back(node);
        }
        const auto pairs =
            periodic_pairs(*core.mesh, {periods, index(period_count * dimension)}, tolerance == 0.0 ? 1e-6 : tolerance);
        std::vector<Constraint> added;
        for (const PeriodicPair& pair : pairs)
            for (std::int64_t d = 0; d < dimension; ++d) {
                Terms terms(*core.mesh);
                terms.add(pair.node, d, 1.0);
                terms.add(pair.base, d, -1.0);
                for (const std::size_t k : pair.directions) terms.add(controls[k], d, -1.0);
                added.push_back(terms.constraint({}));
            }
        core.constraints.insert(core.constraints.end(), std::make_move_iterator(added.begin()),
                                std::make_move_iterator(added.end()));
    });
}

int32_t delam_problem_add_forces(delam_problem* problem, int64_t pattern, int64_t count, const int64_t* nodes,
                                 const double* forces, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t dimension = core.mesh->dimension();
        require_base(index_base);
        require_count(count, "count");
        require_array(nodes, count, "nodes");
        require_array(forces, count, "forces");
        require_finite(forces, count * dimension, "forces");
        require_index(pattern, static_cast<std::int64_t>(core.patterns.size()), 0, "pattern");
        const auto list = require_patterns(core, 1, &pattern, 0, Pattern::Drives::force);
        std::vector<NodalForce> added;
        for (std::int64_t i = 0; i < count; ++i) {
            poll_cancel("loads");
            const std::int64_t node = require_node(*core.mesh, nodes[i], index_base, text("nodes[", i, "]"));
            Terms terms(*core.mesh);
            for (std::int64_t d = 0; d < dimension; ++d) terms.add(node, d, forces[i * dimension + d]);
            for (const auto& [dof, force] : terms.list()) {
                require_no_overflow(force, "forces of nodes[", i, "]");
                added.push_back({pattern, dof, force});
            }
        }
        core.forces.insert(core.forces.end(), added.begin(), added.end());
        if (count > 0) mark(core, list, Pattern::Drives::force);
    });
}

int32_t delam_problem_add_eigenstrain(delam_problem* problem, int64_t pattern, int32_t body, const double* strain) {
    return guard(problem, [&] {
        Problem& core = *problem->core;
        require_index(pattern, static_cast<std::int64_t>(core.patterns.size()), 0, "pattern");
        const std::int32_t index = body < 0 ? -1 : core.mesh->body_of_label(body);
        if (body != -1 && index < 0) fail(DELAM_ERROR_ARGUMENT, "body = ", body, ": no body has this label");
        require_pointer(strain, "strain");
        require_finite(strain, 6, "strain");
        const auto list = require_patterns(core, 1, &pattern, 0, Pattern::Drives::strain);
        Strain own{};
        std::copy_n(strain, own.size(), own.begin());
        std::vector<Eigenstrain> added;
        for (std::int32_t i = 0; i < core.mesh->body_count(); ++i)
            if (body == -1 || i == index) added.push_back({pattern, i, own});
        core.eigenstrains.insert(core.eigenstrains.end(), added.begin(), added.end());
        mark(core, list, Pattern::Drives::strain);
    });
}

int32_t delam_problem_set_gaps(delam_problem* problem, int64_t interface_index, int64_t pattern, const double* gaps,
                               double adjust) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const std::int64_t at =
            require_index(interface_index, static_cast<std::int64_t>(core.interfaces.size()), 0, "interface_index");
        const InterfaceGeometry& faces = core.mesh->interfaces()[index(at)];
        require_index(pattern, static_cast<std::int64_t>(core.patterns.size()), 0, "pattern");
        const auto list = require_patterns(core, 1, &pattern, 0, Pattern::Drives::gap);
        if (!(adjust >= 0.0 && std::isfinite(adjust)))
            fail(DELAM_ERROR_ARGUMENT, "adjust = ", adjust, ": must be >= 0 and finite");
        std::vector<double> own;
        if (gaps == nullptr) {
            if (faces.body_a < 0)
                fail(DELAM_ERROR_ARGUMENT, "gaps is NULL, but interface_index = ", interface_index,
                     " is an obstacle, whose place is not known");
            own = face_gaps(*core.mesh, faces);
        } else {
            require_finite(gaps, faces.pair_count(), "gaps");
            own.assign(gaps, gaps + faces.pair_count());
        }
        for (double& gap : own)
            if (std::abs(gap) <= adjust) gap = 0.0;
        const auto least = std::min_element(own.begin(), own.end());
        if (gaps == nullptr && least != own.end() && *least < 0.0)
            fail(DELAM_ERROR_MESH, "interface ", at, ": its faces overlap by up to ", -*least, ", at pair ",
                 least - own.begin(), " at ", place(*core.mesh, faces.node_b[index(least - own.begin())]),
                 ", farther than adjust (", adjust, "), which moves them apart without strain");
        InterfaceProperties& interface = core.interfaces[index(at)];
        const std::int64_t replaced = interface.gap.empty() ? pattern : interface.gap_pattern;
        std::size_t parted = 0;
        for (std::size_t p = 0; p < own.size(); ++p)
            if (own[p] != 0.0 && !interface.bonded && interface.adhesion[p] > 0.0) {
                interface.adhesion[p] = 0.0;
                ++parted;
            }
        interface.gap = std::move(own);
        interface.gap_pattern = pattern;
        mark(core, list, Pattern::Drives::gap);
        if (std::none_of(core.interfaces.begin(), core.interfaces.end(), [&](const InterfaceProperties& other) {
                return !other.gap.empty() && other.gap_pattern == replaced;
            }))
            core.patterns[index(replaced)].drives = Pattern::Drives::nothing;
        if (parted > 0 && interface.law)
            problem->context->monitor.log(
                1, text("interface ", at, ": ", parted, " of ", interface.gap.size(),
                        " pairs have a gap at the start, of up to ", max_abs(interface.gap), ": they do not adhere"));
    });
}
