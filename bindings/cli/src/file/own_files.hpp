// SPDX-License-Identifier: BSD-3-Clause
// Decides which files of a folder are this program's own: it replaces and removes no others.
//
// A folder in which it works holds a marker. Files are its own if their names are those that it writes and the folder
// is marked, or if an older version, which wrote no marker, can be recognised by them. Links, folders and files with a
// second name are never its own: they lead to what belongs to others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

inline constexpr std::string_view marker_name = ".delam";
// A file of more bytes is refused: result.json, and a table (history.csv, jumps.csv).
inline constexpr std::int64_t most_result_bytes = std::int64_t{64} << 20, most_table_bytes = std::int64_t{1} << 30;

// Names of the files of a result.
const std::vector<std::string>& result_names();
// True for the files of a run that is not finished, in its folder `running`: those of its result, its steps and what it
// needs to go on.
bool is_running_name(std::string_view name);
std::string step_name(std::size_t step);
// The name that versions before 0.3 gave it.
std::string earlier_step_name(std::size_t step);
// The step of such a name, or of what is written beside it; nothing: it is another name.
std::optional<std::size_t> step_of(std::string_view name);

bool is_marked(const std::string& folder);
// Writes the marker, if it is not there.
void mark(const std::string& folder);

// Returns the names in a folder, ascending; none if it is not there. Throws OutputFailure if it is no folder, or a link
// to one.
std::vector<std::string> names_in(const std::string& folder);
// True if something has this name, be it a link that leads nowhere.
bool is_there(const std::string& path);
// Throws OutputFailure if it is there and no regular file, or one that has another name, too.
void require_plain(const std::string& path);

}  // namespace cli
