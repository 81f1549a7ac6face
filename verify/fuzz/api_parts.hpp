// SPDX-License-Identifier: BSD-3-Clause
// Engines and parts of a problem, plausible or hostile.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "api_world.hpp"

namespace fuzz {

// Gives the problem a dense engine of its own, or one in which something is missing or wrong. mesh: where the stiffness
// comes from; it may be that of another problem.
inline std::int32_t set_engine(World& world, Input& in, const delam_mesh* mesh, delam_problem* problem, bool sound) {
    constexpr std::int64_t largest = 120;  // DOFs: dense products only take long
    if ((!sound && in.seldom()) || sizes_of(problem).dofs > largest)
        return delam_experimental_problem_set_engine(problem, nullptr);
    auto own = std::make_unique<Engaged>(stiffness_of(mesh, problem));
    own->engine.awake = false;
    own->engine.calls_at_most = 600;
    delam_experimental_engine functions = own->engine.functions();
    if (!sound && in.seldom()) functions.size = in.hostile_whole();
    if (!sound && in.seldom()) functions.kept = in.hostile_whole();
    if (!sound && in.seldom()) {
        switch (in.below(7)) {
            case 0:
                functions.prepare = nullptr;
                break;
            case 1:
                functions.set = nullptr;
                break;
            case 2:
                functions.renew = nullptr;
                break;
            case 3:
                functions.solve = nullptr;
                break;
            case 4:
                functions.recover = nullptr;
                break;
            case 5:
                functions.message = nullptr;
                break;
            default:
                break;
        }
    }
    // On the heap and no longer than it says: what reads beyond `size` is seen.
    std::vector<std::uint8_t> bytes(sizeof functions);
    std::memcpy(bytes.data(), &functions, sizeof functions);
    if (functions.size >= 8 && functions.size < static_cast<std::int64_t>(sizeof functions)) {
        bytes.resize(static_cast<std::size_t>(functions.size));
        bytes.shrink_to_fit();
    }
    const std::int32_t status = delam_experimental_problem_set_engine(
        problem, reinterpret_cast<const delam_experimental_engine*>(bytes.data()));
    own->taken = status == DELAM_OK ? 1 : 0;
    world.engines.push_back(std::move(own));
    return status;
}

// Chooses what the engines do from now on, in calls that are asked.
inline void turn_engines(World& world, Input& in) {
    static constexpr std::int32_t statuses[] = {DELAM_CANCELLED,
                                                DELAM_ERROR_ARGUMENT,
                                                DELAM_ERROR_HANDLE,
                                                DELAM_ERROR_MESH,
                                                DELAM_ERROR_PROBLEM,
                                                DELAM_ERROR_STATE,
                                                DELAM_ERROR_MEMORY,
                                                DELAM_ERROR_NUMERICAL,
                                                DELAM_ERROR_SNAPSHOT,
                                                DELAM_ERROR_INTERNAL,
                                                DELAM_ERROR_FILE,
                                                DELAM_NOT_CONVERGED,
                                                DELAM_LIMIT,
                                                4,
                                                -11,
                                                1000000,
                                                std::numeric_limits<std::int32_t>::min(),
                                                std::numeric_limits<std::int32_t>::max()};
    const auto nonsense = static_cast<DenseEngine::Nonsense>(
        in.flag() ? 0 : in.below(static_cast<std::int64_t>(DenseEngine::Nonsense::count)));
    const std::int64_t after = in.flag() ? -1 : in.below(40);
    const std::uint8_t which = in.byte();
    const std::int32_t status = which < 240 ? statuses[which % std::size(statuses)] : in.raw<std::int32_t>();
    for (const auto& each : world.engines) {
        each->engine.nonsense = nonsense;
        each->engine.fail_in = after;
        each->engine.fail_with = status;
    }
}

inline std::int32_t problem_part(World& world, Input& in, const delam_problem* problem) {
    std::vector<std::int64_t> cells;
    for (std::int64_t next = in.below(3), left = in.below(8); left > 0; --left, next += 1 + in.below(2))
        cells.push_back(next);
    if (in.seldom()) cells = in.indices(few(in), 8);
    const std::int64_t count = in.seldom() ? in.hostile_whole() : static_cast<std::int64_t>(cells.size());
    // A host that says more cells than it has reads outside itself; here beyond any mesh, which is refused before.
    const std::int64_t said = count > static_cast<std::int64_t>(cells.size()) && count < 1000
                                  ? static_cast<std::int64_t>(cells.size())
                                  : count;
    std::int64_t size = 0;
    const std::int32_t status = IN_ORDER(delam_experimental_problem_part, problem, said, maybe(in, cells),
                                         in.seldom() ? in.hostile_whole() : 0, nullptr, in.seldom() ? nullptr : &size);
    if (status != DELAM_OK) return status;
    Room<std::uint8_t> room(in, size);
    const std::int32_t written =
        IN_ORDER(delam_experimental_problem_part, problem, said, cells.data(), room.capacity, room.data(), &size);
    if (written == DELAM_OK && room.capacity == size) world.part = room.entries;
    return written;
}

// The part written last, or one that was damaged, with or without its checksum corrected.
inline std::vector<std::uint8_t> some_part(const World& world, Input& in) {
    std::vector<std::uint8_t> bytes = world.part;
    if (in.flag() || bytes.empty()) return bytes;
    for (std::int64_t left = 1 + in.below(3); left > 0; --left) {
        const std::size_t place = in.raw<std::uint16_t>() % bytes.size();
        if (in.flag()) {
            bytes[place] ^= in.byte();
        } else {
            const std::int64_t whole = in.hostile_whole();
            std::memcpy(bytes.data() + place, &whole, std::min<std::size_t>(8, bytes.size() - place));
        }
    }
    if (in.seldom()) bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), in.byte()));
    return in.seldom() ? bytes : with_checksum(std::move(bytes));
}

inline std::int64_t some_size(Input& in, const std::vector<std::uint8_t>& bytes) {
    if (!in.seldom()) return static_cast<std::int64_t>(bytes.size());
    const std::int64_t said = in.hostile_whole();
    return said > static_cast<std::int64_t>(bytes.size()) && said <= (std::int64_t{1} << 48) ? -said : said;
}

inline std::int32_t part_matrix(World& world, Input& in, delam_context* context) {
    std::vector<std::uint8_t> bytes = some_part(world, in);
    const std::int64_t said = some_size(in, bytes);
    std::int64_t dimension = 0, nodes = 0, entries = 0;
    const std::uint8_t* given = maybe(in, bytes);
    const std::int32_t status = delam_experimental_part_matrix(context, said, given, &dimension, &nodes, &entries,
                                                               nullptr, nullptr, nullptr, nullptr, nullptr);
    if (status != DELAM_OK) return status;
    const auto rows = static_cast<std::size_t>(dimension * nodes);
    std::vector<std::int64_t> node(static_cast<std::size_t>(nodes)), starts(rows + 1),
        columns(static_cast<std::size_t>(entries));
    std::vector<double> places(rows), values(columns.size());
    return IN_ORDER(delam_experimental_part_matrix, context, said, given, nullptr, nullptr, nullptr, maybe(in, node),
                    maybe(in, places), maybe(in, starts), maybe(in, columns), maybe(in, values));
}

inline std::int32_t part_fields(World& world, Input& in, delam_context* context) {
    std::vector<std::uint8_t> bytes = some_part(world, in);
    const std::int64_t said = some_size(in, bytes);
    std::int64_t dimension = 2, nodes = 0;
    delam_experimental_part_matrix(context, said, bytes.data(), &dimension, &nodes, nullptr, nullptr, nullptr, nullptr,
                                   nullptr, nullptr);
    const std::size_t labels = few(in), cells = in.seldom() ? few(in) : 64;
    std::vector<std::int32_t> bodies(labels);
    for (std::int32_t& label : bodies) label = in.small_label(4);
    std::vector<double> u = in.reals(static_cast<std::size_t>(dimension * nodes)), strains = in.reals(6 * labels);
    // The part does not tell its number of cells: all that are possible are asked for.
    std::vector<double> stress(6 * cells), rotation(3 * cells);
    std::int32_t status = DELAM_ERROR_ARGUMENT;
    const std::int64_t hostile = in.seldom() ? in.hostile_whole() : -1;
    const double* displacement = maybe(in, u);
    double *stresses = maybe(in, stress), *rotations = maybe(in, rotation);
    for (std::int64_t count = 0; count <= static_cast<std::int64_t>(cells) && status == DELAM_ERROR_ARGUMENT; ++count)
        status = delam_experimental_part_fields(context, said, bytes.data(), nodes, displacement,
                                                static_cast<std::int64_t>(labels), bodies.data(), strains.data(), count,
                                                stresses, rotations);
    if (hostile < 0 || hostile > 1000)
        status = delam_experimental_part_fields(context, said, bytes.data(), hostile, displacement, 0, nullptr, nullptr,
                                                hostile, nullptr, nullptr);
    return status;
}

}  // namespace fuzz
