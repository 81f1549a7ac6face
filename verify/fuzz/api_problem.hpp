// SPDX-License-Identifier: BSD-3-Clause
// Calls on laws and problems with plausible or hostile arguments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "api_world.hpp"

namespace fuzz {

inline std::int32_t add_pattern(Input& in, delam_problem* problem) {
    static const char* const names[] = {"load", "a", "heat", "b-2"};
    const std::size_t count = few(in);
    std::vector<double> times(count), values = in.reals(count);
    double last = in.flag() ? 0.0 : in.signed_real();
    for (double& t : times) t = last, last += in.real();
    std::int64_t index = -1;
    return IN_ORDER(delam_problem_add_pattern, problem, in.word(names), static_cast<std::int64_t>(count),
                    maybe(in, times), maybe(in, values), in.seldom() ? nullptr : &index);
}

// Prescribed nodes, means, equations and forces take similar arguments.
enum class Load { nodes, mean, equation, forces };
inline std::int32_t add_load(Input& in, delam_problem* problem, Load load) {
    const ProblemSizes s = sizes_of(problem);
    const std::size_t count = few(in), patterns = static_cast<std::size_t>(in.below(3));
    const std::int32_t base = in.base();
    const auto entries = static_cast<std::int64_t>(count), driven = static_cast<std::int64_t>(patterns);
    std::vector<std::int64_t> nodes = in.indices(count, s.dofs / 3, base);
    std::vector<std::int64_t> by = in.indices(patterns, s.patterns, base);
    std::vector<double> direction = in.reals(3), weights = in.reals(count), vectors = in.reals(3 * count);
    std::vector<double> coefficients = in.reals(std::max<std::size_t>(1, count) * std::max<std::size_t>(1, patterns));
    switch (load) {
        case Load::nodes:
            return IN_ORDER(delam_problem_prescribe_nodes, problem, entries, maybe(in, nodes), maybe(in, direction),
                            driven, maybe(in, by), maybe(in, coefficients), base);
        case Load::mean:
            return IN_ORDER(delam_problem_prescribe_mean, problem, entries, maybe(in, nodes), maybe(in, weights),
                            maybe(in, direction), driven, maybe(in, by), maybe(in, coefficients), base);
        case Load::equation:
            return IN_ORDER(delam_problem_add_equation, problem, entries, maybe(in, nodes), maybe(in, vectors), driven,
                            maybe(in, by), maybe(in, coefficients), base);
        case Load::forces:
            return IN_ORDER(delam_problem_add_forces, problem, in.index(s.patterns), entries, maybe(in, nodes),
                            maybe(in, vectors), base);
    }
    return DELAM_OK;
}

inline std::int32_t change_constraints(Input& in, delam_problem* problem, bool begins) {
    const std::int64_t first = in.index(16), count = in.below(4);
    const double time = in.seldom() ? in.hostile_real() : in.real();
    const std::int64_t pattern = in.index(sizes_of(problem).patterns);
    return begins ? IN_ORDER(delam_problem_begin_constraints, problem, first, count, time, pattern)
                  : IN_ORDER(delam_problem_end_constraints, problem, first, count, time, pattern);
}

inline std::int32_t add_periodic(Input& in, delam_problem* problem) {
    std::vector<double> periods = in.reals(9);
    if (in.flag()) periods = {1.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 1.0};
    const std::int32_t base = in.base();
    std::vector<std::int64_t> controls = in.indices(3, sizes_of(problem).dofs / 3, base);
    return IN_ORDER(delam_problem_add_periodic, problem, in.seldom() ? in.hostile_whole() % 4 : in.below(4),
                    maybe(in, periods), maybe(in, controls), in.flag() ? 0.0 : in.fraction(), base);
}

// An interface has at most as many pairs as the problem has rows of jumps.
inline std::int32_t set_gaps(Input& in, delam_problem* problem) {
    const ProblemSizes s = sizes_of(problem);
    const std::vector<double> some = in.reals(3);
    std::vector<double> gaps(static_cast<std::size_t>(s.dual));
    for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = 1e-2 * some[i % some.size()];
    const double* given = in.flag() ? nullptr : gaps.data();
    return IN_ORDER(delam_problem_set_gaps, problem, in.index(2), in.index(s.patterns), given,
                    in.flag() ? 0.0 : in.fraction());
}

inline std::int32_t set_orientation(Input& in, delam_problem* problem) {
    const std::size_t count = few(in);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> cells = in.indices(count, 6, base);
    std::vector<double> axes = in.reals(6 * std::max<std::size_t>(1, count));
    const bool whole = in.flag();
    return IN_ORDER(delam_problem_set_orientation, problem, in.body(), whole ? 1 : static_cast<std::int64_t>(count),
                    whole ? nullptr : cells.data(), maybe(in, axes), base);
}

inline std::int32_t set_orthotropic(Input& in, delam_problem* problem) {
    std::vector<double> constants = {1000.0, 100.0, 100.0, 0.25, 0.25, 0.4, 50.0, 50.0, 40.0};
    for (std::int64_t left = in.below(3); left > 0; --left)
        constants[static_cast<std::size_t>(in.below(9))] = in.signed_real();
    return IN_ORDER(delam_problem_set_orthotropic, problem, in.body(), maybe(in, constants));
}

inline std::int32_t body_matrix(Input& in, const delam_problem* problem) {
    std::int64_t rows = 0, entries = 0;
    const std::int32_t body = in.small_label(3);
    const std::int32_t status = delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr);
    if (status != DELAM_OK) return status;
    std::vector<std::int64_t> starts(static_cast<std::size_t>(rows + 1)), columns(static_cast<std::size_t>(entries));
    std::vector<double> values(static_cast<std::size_t>(entries));
    return IN_ORDER(delam_problem_body_matrix, problem, body, nullptr, nullptr, maybe(in, starts), maybe(in, columns),
                    maybe(in, values));
}

// Passes a stiffness assembled by the library, or a band matrix, as the host's own, corrupted.
inline std::int32_t set_stiffness(const delam_mesh* mesh, Input& in, delam_problem* problem) {
    const MeshSizes s = mesh == nullptr ? MeshSizes{} : sizes_of(mesh);
    const std::int32_t body = in.small_label(5), base = in.base();
    const std::int64_t shift = base == 1 ? 1 : 0;
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    if (mesh != nullptr) delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < s.nodes; ++n)
        if (bodies[static_cast<std::size_t>(n)] == body) nodes.push_back(n);
    // The array is as long as three components per node require, whatever the dimension.
    const std::size_t most = 3 * nodes.size();
    std::int64_t rows = 0, entries = 0;
    delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> starts, columns;
    std::vector<double> values;
    if (rows > 0 && rows == static_cast<std::int64_t>(nodes.size()) * s.dimension) {
        starts.resize(static_cast<std::size_t>(rows + 1)), columns.resize(static_cast<std::size_t>(entries));
        values.resize(columns.size());
        delam_problem_body_matrix(problem, body, nullptr, nullptr, starts.data(), columns.data(), values.data());
    } else {
        for (std::size_t i = 0; i < nodes.size() * static_cast<std::size_t>(s.dimension); ++i) {
            starts.push_back(static_cast<std::int64_t>(columns.size()));
            columns.push_back(static_cast<std::int64_t>(i)), values.push_back(100.0);
        }
        starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
    starts.resize(most + 1, starts.back());
    for (std::int64_t left = in.below(4); left > 0 && !values.empty(); --left) {
        const std::size_t at = in.raw<std::uint16_t>();
        switch (in.below(4)) {
            case 0:
                values[at % values.size()] = in.hostile_real();
                break;
            case 1:
                values[at % values.size()] = 100.0 * in.signed_real();
                break;
            case 2:
                columns[at % columns.size()] = in.index(static_cast<std::int64_t>(most));
                break;
            default: {  // row ends never lie beyond the arrays
                const std::int64_t start = in.hostile_whole();
                starts[at % starts.size()] = std::min(start, static_cast<std::int64_t>(columns.size()));
            }
        }
    }
    for (std::int64_t& v : starts) v = v > std::numeric_limits<std::int64_t>::min() ? v + shift : v;
    for (std::int64_t& v : columns) v = v < std::numeric_limits<std::int64_t>::max() ? v + shift : v;
    for (std::int64_t& v : nodes) v += shift;
    std::vector<std::int64_t> dofs(most);
    for (std::size_t i = 0; i < dofs.size(); ++i) dofs[i] = static_cast<std::int64_t>(i) + shift;
    if (in.seldom()) dofs = in.indices(most, static_cast<std::int64_t>(most), base);
    const std::int64_t kernels = in.below(5) - 1;
    std::vector<double> kernel = in.reals(most * static_cast<std::size_t>(std::max<std::int64_t>(kernels, 0)));
    return IN_ORDER(delam_problem_set_stiffness, problem, static_cast<std::int64_t>(nodes.size()), maybe(in, nodes),
                    in.flag() ? nullptr : dofs.data(), maybe(in, starts), maybe(in, columns), maybe(in, values),
                    kernels, kernels > 0 ? maybe(in, kernel) : nullptr, base);
}

inline std::int32_t constraints(Input& in, const delam_problem* problem) {
    std::int64_t rows = 0, entries = 0, patterns = 0;
    delam_problem_constraints(problem, &rows, &entries, &patterns, nullptr, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> starts(static_cast<std::size_t>(rows + 1)), columns(static_cast<std::size_t>(entries));
    std::vector<double> values(columns.size()), coefficients(static_cast<std::size_t>(rows * patterns));
    const std::int32_t status = IN_ORDER(delam_problem_constraints, problem, nullptr, nullptr, nullptr,
                                         maybe(in, starts), columns.data(), values.data(), maybe(in, coefficients));
    for (const double v : values) expect(std::isfinite(v), "constraints are finite", "delam_problem_constraints");
    for (const double v : coefficients) expect(std::isfinite(v), "constraints are finite", "delam_problem_constraints");
    return status;
}

inline std::int32_t law_respond(Input& in, const delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> jump = in.reals(3 * count), mixity(count), old(count), adhesion(count), traction(3 * count);
    for (std::size_t i = 0; i < count; ++i) mixity[i] = in.fraction(), old[i] = in.fraction();
    return IN_ORDER(delam_law_respond, law, in.seldom() ? 4 : 2 + in.flag(), static_cast<std::int64_t>(count),
                    maybe(in, jump), maybe(in, mixity), maybe(in, old), adhesion.data(), maybe(in, traction));
}

inline std::int32_t law_toughness(Input& in, const delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> mixity(count), onset(count), toughness(count);
    for (double& b : mixity) b = in.fraction();
    return IN_ORDER(delam_law_toughness, law, static_cast<std::int64_t>(count), maybe(in, mixity), maybe(in, onset),
                    maybe(in, toughness));
}

inline std::int32_t law_table(Input& in, delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> xi(count), s(count);
    for (std::size_t i = 0; i < count; ++i) xi[i] = in.fraction(), s[i] = in.fraction();
    if (count >= 2 && in.flag()) xi.front() = 0.0, xi.back() = 1.0, s.front() = 1.0, s.back() = 0.0;
    return IN_ORDER(delam_law_set_table, law, static_cast<std::int64_t>(count), maybe(in, xi), maybe(in, s));
}

}  // namespace fuzz
