// SPDX-License-Identifier: BSD-3-Clause
// Whole files of bytes. Error(DELAM_ERROR_FILE) names the file and what the system says.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delam {

// Written beside `path`, then put in its place: either all of it is there, on disk, or what was there before.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> read_file(const std::string& path);

}  // namespace delam
