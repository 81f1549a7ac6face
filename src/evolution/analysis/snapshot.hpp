// SPDX-License-Identifier: BSD-3-Clause
// The committed state as bytes: magic, version, hash of the scene, the state, checksum. Doubles are stored
// little-endian without conversion, so that a restored analysis continues bit for bit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolution/analysis/solver.hpp"

namespace delam {

std::vector<std::uint8_t> save(const Solver& solver);
// Throws Error(DELAM_ERROR_SNAPSHOT) for bytes that are damaged, of another version or of another scene; the solver is
// then unchanged.
void load(Solver& solver, std::span<const std::uint8_t> bytes);
// The same from a file. Checks its first bytes before it takes memory for the others.
void load_file(Solver& solver, const std::string& path);

}  // namespace delam
