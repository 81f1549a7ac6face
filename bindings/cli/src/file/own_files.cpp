// SPDX-License-Identifier: BSD-3-Clause
#include "file/own_files.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <filesystem>

#include <sys/stat.h>

#include <fmt/format.h>

#include "file/file.hpp"
#include "file/input_file.hpp"
#include "text/error.hpp"
#include "text/reason.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view marker_text = "delam: the files of a run lie here, and delam replaces and removes them\n";

// Besides the result and the steps: the origin, and what is copied before it is published. Older versions tried whether
// they could write with the last.
constexpr std::string_view running_names[] = {"origin.json", "published_history.csv", "published_state.bin", "probe"};

bool is_name(std::string_view name, std::string_view of) { return name == of || is_beside(name, of); }

}  // namespace

const std::vector<std::string>& result_names() {
    static const std::vector<std::string> names{"result.json", "history.csv", "state.bin",
                                                "fields.h5",   "fields.xdmf", "jumps.csv"};
    return names;
}

bool is_running_name(std::string_view name) {
    const auto has_name = [name](const auto& of) { return is_name(name, of); };
    return name == marker_name || step_of(name) ||
           std::any_of(result_names().begin(), result_names().end(), has_name) ||
           std::any_of(std::begin(running_names), std::end(running_names), has_name);
}

// NUMBER of step_NUMBER.bin has eight digits or more.
std::optional<std::size_t> step_of(std::string_view name) {
    constexpr std::string_view before = "step_";
    if (!name.starts_with(before)) return std::nullopt;
    const auto digits = name.substr(before.size());
    const auto end = std::find_if(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) == 0; });
    const auto number = digits.substr(0, static_cast<std::size_t>(end - digits.begin()));
    // Versions before 0.3 wrote files that end with .h5.
    if (number.size() < 8 || (!is_name(name, fmt::format("{}{}.bin", before, number)) &&
                              !is_name(name, fmt::format("{}{}.h5", before, number))))
        return std::nullopt;
    std::size_t step = 0;
    const auto [last, code] = std::from_chars(number.data(), number.data() + number.size(), step);
    return code == std::errc() ? std::optional(step) : std::nullopt;
}

std::string step_name(std::size_t step) { return fmt::format("step_{:08d}.bin", step); }
std::string earlier_step_name(std::size_t step) { return fmt::format("step_{:08d}.h5", step); }

bool is_marked(const std::string& folder) {
    const std::string path = fmt::format("{}/{}", folder, marker_name);
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return false;
    if (about.st_size > static_cast<off_t>(marker_text.size())) return false;
    return marker_text.starts_with(read_bytes(path));  // a full disk, or a kill, may have cut it
}

void mark(const std::string& folder) {
    const std::string path = fmt::format("{}/{}", folder, marker_name);
    if (is_marked(folder)) return;
    if (is_there(path)) throw OutputFailure(path, "something else has this name, which a run needs for its marker");
    try {
        Appender(path, 0).append(marker_text);
    } catch (...) {
        std::error_code code;
        fs::remove(path, code);
        throw;
    }
}

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code code;
    const fs::file_status there = fs::symlink_status(folder, code);
    if (!fs::exists(there)) return names;
    if (fs::is_symlink(there))
        throw OutputFailure(folder, "it is a symbolic link, and a run needs a folder of its own");
    if (!fs::is_directory(there)) throw OutputFailure(folder, "it is no folder");
    fs::directory_iterator at(folder, code);
    for (; !code && at != fs::directory_iterator(); at.increment(code)) names.push_back(at->path().filename().string());
    if (code) throw OutputFailure(folder, code.message());
    std::sort(names.begin(), names.end());
    return names;
}

bool is_there(const std::string& path) {
    struct stat about {};
    if (::lstat(path.c_str(), &about) == 0) return true;
    if (errno != ENOENT && errno != ENOTDIR) throw OutputFailure(path, reason_of(errno));
    return false;
}

void require_plain(const std::string& path) {
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0) {
        if (errno == ENOENT) return;
        throw OutputFailure(path, reason_of(errno));
    }
    if (S_ISLNK(about.st_mode))
        throw OutputFailure(path, "it is a symbolic link, which a run neither follows nor replaces");
    if (!S_ISREG(about.st_mode)) throw OutputFailure(path, "it is no regular file, and a run has a file of that name");
    if (about.st_nlink > 1) throw OutputFailure(path, "this file has another name, too (a hard link)");
}

}  // namespace cli
