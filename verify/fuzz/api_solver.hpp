// SPDX-License-Identifier: BSD-3-Clause
// Calls on solvers with plausible or hostile arguments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

#include "api_world.hpp"

namespace fuzz {

inline double next_time(Input& in, delam_solver* solver) {
    double time = 0.0;
    delam_solver_value(solver, "time", &time);
    return in.seldom() ? in.hostile_real() : time + 0.125 * static_cast<double>(1 + in.below(8));
}

inline std::int32_t equilibrate(Input& in, delam_solver* solver) {
    std::int64_t pairs = 0, one = 0;
    delam_solver_field_shape(solver, "adhesion", -1, &pairs, &one);
    std::vector<double> adhesion(static_cast<std::size_t>(pairs));
    for (double& zeta : adhesion) zeta = in.fraction();
    return IN_ORDER(delam_solver_equilibrate, solver, next_time(in, solver), in.flag() ? nullptr : adhesion.data());
}

inline std::int32_t read_field(Input& in, delam_solver* solver) {
    const char* key = in.word(field_keys);
    const std::int64_t part = in.flag() ? -1 : in.index(3);
    std::int64_t rows = -1, columns = -1;
    const std::int32_t status = delam_solver_field_shape(solver, key, part, in.seldom() ? nullptr : &rows, &columns);
    if (status != DELAM_OK || rows < 0) return status;
    Room<double> room(in, rows * columns);
    return delam_solver_field(solver, key, part, room.capacity, room.data());
}

inline std::int32_t read_front(Input& in, delam_solver* solver) {
    const std::int64_t index = in.index(3);
    std::int64_t fronts = 0, points = 0;
    const std::int32_t status = delam_solver_front_count(solver, index, &fronts, &points);
    if (status != DELAM_OK) return status;
    Room<std::int32_t> closed(in, fronts);
    Room<double> lengths(in, points);
    std::vector<std::int64_t> starts(closed.entries.size() + 1);
    const std::size_t room = lengths.entries.size();
    std::vector<double> places(3 * room), directions(3 * room), rates(3 * room), zones(room), pairs(room);
    return IN_ORDER(delam_solver_front, solver, index, closed.capacity, lengths.capacity, maybe(in, starts),
                    closed.data(), maybe(in, places), maybe(in, directions), lengths.data(), maybe(in, rates),
                    maybe(in, zones), maybe(in, pairs));
}

inline std::int32_t read_all_values(delam_solver* solver) {
    std::int64_t count = 0;
    delam_solver_value_count(solver, &count);
    for (std::int64_t i = 0; i < count; ++i) {
        const char* name = delam_solver_value_name(solver, i);
        expect(name != nullptr, "a value has a name", "delam_solver_value_name");
        const std::string key = name;
        double value = 0.0;
        const std::int32_t status = delam_solver_value(solver, key.c_str(), &value);
        if (status != DELAM_OK) return status;
    }
    return DELAM_OK;
}

inline std::int32_t read_jumps(Input& in, delam_solver* solver, std::int64_t patterns) {
    std::int64_t count = 0;
    delam_solver_jump_count(solver, &count);
    double released = 0.0;
    std::int64_t step = 0, first = 0;
    Room<double> before(in, patterns), after(in, patterns);
    const std::int32_t status = delam_solver_jump_reactions(
        solver, in.index(count), std::min(before.capacity, after.capacity), before.data(), after.data());
    if (status != DELAM_OK) return status;
    return delam_solver_jump(solver, in.index(count), &step, nullptr, nullptr, nullptr, nullptr, &released, nullptr,
                             nullptr, &first, nullptr);
}

inline std::int32_t read_plan(Input& in, delam_solver* solver) {
    expect(delam_solver_plan(solver) != nullptr, "never NULL", "delam_solver_plan");
    std::int64_t count = 0;
    delam_solver_plan_count(solver, &count);
    const char *subject = nullptr, *reason = nullptr;
    double cost = 0.0;
    return delam_solver_plan_item(solver, in.index(count), &subject, nullptr, &reason, &cost, nullptr, nullptr);
}

inline std::int32_t tangent(Input& in, delam_solver* solver, std::int64_t patterns) {
    Room<double> room(in, patterns * patterns);
    return delam_solver_tangent(solver, room.capacity, room.data());
}

inline std::int32_t set_history(Input& in, delam_solver* solver) {
    const std::size_t count = few(in);
    std::vector<double> times(count), values = in.reals(count);
    double last = next_time(in, solver);
    for (double& t : times) t = last, last += in.real();
    return IN_ORDER(delam_solver_set_history, solver, in.index(2), static_cast<std::int64_t>(count), maybe(in, times),
                    maybe(in, values));
}

inline std::int32_t recorded(Input& in, delam_solver* solver) {
    std::int64_t steps = 0;
    const std::int32_t status = in.seldom() ? delam_solver_recorded_size(solver, nullptr, &steps)
                                            : delam_solver_recorded_size(solver, &steps, &steps);
    if (status != DELAM_OK) return status;
    Room<double> room(in, steps);
    return delam_solver_recorded(solver, in.word(value_keys), room.capacity, room.data());
}

inline std::int64_t patterns_of(delam_solver* solver) {
    std::int64_t count = 0, patterns = 0;
    delam_solver_value_count(solver, &count);
    for (std::int64_t i = 0; i < count; ++i)
        patterns += std::string(delam_solver_value_name(solver, i)).starts_with("load:") ? 1 : 0;
    return patterns;
}

inline std::int32_t condensed(Input& in, delam_solver* solver) {
    const std::int64_t patterns = patterns_of(solver);
    std::int64_t unknowns = 0, entries = 0, rows = 0, columns = 0;
    const std::int32_t status = delam_solver_condensed_size(solver, &unknowns, &entries);
    if (status != DELAM_OK) return status;
    delam_solver_field_shape(solver, "jump", -1, &rows, &columns);
    const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
    Room<double> stiffness(in, unknowns * unknowns);
    std::vector<double> load(size(patterns * unknowns)), constant(size(patterns * patterns)), values(size(entries)),
        offset(size(rows * columns * patterns));
    std::vector<std::int64_t> starts(size(rows * columns + 1)), of(size(entries));
    return IN_ORDER(delam_solver_condensed, solver, stiffness.capacity, stiffness.data(), maybe(in, load),
                    maybe(in, constant), maybe(in, starts), maybe(in, of), maybe(in, values), maybe(in, offset));
}

inline std::int32_t eigenstrains(Input& in, delam_solver* solver) {
    std::int64_t count = 0;
    const std::int32_t status = delam_experimental_solver_eigenstrains(
        solver, in.seldom() ? in.hostile_whole() : 0, nullptr, nullptr, in.seldom() ? nullptr : &count);
    if (status != DELAM_OK) return status;
    Room<std::int32_t> bodies(in, count);
    std::vector<double> strains(6 * bodies.entries.size());
    return IN_ORDER(delam_experimental_solver_eigenstrains, solver, bodies.capacity, bodies.data(), maybe(in, strains),
                    &count);
}

inline std::int32_t follow(Input& in, delam_solver* solver) {
    std::vector<std::int64_t> interfaces = in.indices(1 + few(in) / 2, 2);
    std::int64_t count = in.seldom() ? in.hostile_whole() : static_cast<std::int64_t>(interfaces.size());
    if (count > static_cast<std::int64_t>(interfaces.size()) && count < 1000) count = 0;
    std::int64_t parameter = -1;
    return IN_ORDER(delam_experimental_solver_follow, solver, count, maybe(in, interfaces), in.word(law_keys),
                    in.seldom() ? nullptr : &parameter);
}

inline std::int32_t sensitivity(Input& in, delam_solver* solver) {
    Room<double> room(in, patterns_of(solver) * in.below(4));
    std::int64_t unknown = 0;
    return IN_ORDER(delam_experimental_solver_sensitivity, solver, room.capacity, room.data(),
                    in.seldom() ? nullptr : &unknown);
}

// A file in memory, owned by this process.
inline std::string file_name() { return "/dev/shm/delam-fuzz-" + std::to_string(::getpid()) + ".state"; }
inline const char* some_path(Input& in) {
    static const std::string own = file_name();
    static const char* const wrong[] = {"/nowhere/at/all", "/dev/shm"};
    return in.seldom() ? in.word(wrong) : own.c_str();
}

// Loads the bytes of one solver into another, of the same scene or not, whole or truncated.
inline std::int32_t save_and_load(World& world, Input& in, delam_solver* solver) {
    const delam_solver* from = world.solver.pick(in);
    if (from == nullptr) from = solver;
    std::vector<std::uint8_t> bytes = saved(from);
    if (in.seldom()) bytes.resize(bytes.size() - static_cast<std::size_t>(in.below(9)));
    if (in.seldom() && !bytes.empty()) bytes[in.raw<std::uint16_t>() % bytes.size()] ^= in.byte();
    return IN_ORDER(delam_solver_load, solver,
                    in.seldom() ? in.hostile_whole() % 2 : static_cast<std::int64_t>(bytes.size()), maybe(in, bytes));
}

}  // namespace fuzz
