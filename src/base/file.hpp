// SPDX-License-Identifier: BSD-3-Clause
// Whole binary files. Error(DELAM_ERROR_FILE) names the file and gives the system's message.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delam {

// Writes a temporary file and renames it to `path`: the path then holds either all of the new content, on disk, or the
// old.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> read_file(const std::string& path);

}  // namespace delam
