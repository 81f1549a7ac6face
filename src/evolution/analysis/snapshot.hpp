// SPDX-License-Identifier: BSD-3-Clause
// The committed state as bytes: magic, version, hash of the scene, the state, checksum. Doubles are stored
// little-endian without conversion, so that a restored analysis continues bit for bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/analysis/solver.hpp"

namespace delam {

std::vector<std::uint8_t> save(const Solver& solver);
// Throws Error(DELAM_ERROR_SNAPSHOT) for bytes that are damaged, of another version or of another scene; the solver is
// then unchanged.
void load(Solver& solver, std::span<const std::uint8_t> bytes);
// Reads the bytes from a file. Checks the first of them before it takes memory for the others.
std::vector<std::uint8_t> read_snapshot(const Solver& solver, const std::string& path);
// Returns the stage of the state in bytes of this scene; nothing: the scene has no stages. Throws as load() does.
std::optional<Stage> stage_in(const Solver& solver, std::span<const std::uint8_t> bytes);

}  // namespace delam
