// SPDX-License-Identifier: BSD-3-Clause
#include "view_template.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "error.hpp"
#include "input_file.hpp"

namespace cli {

namespace {

constexpr std::string_view place_of_data = "<!--delam:data-->";
constexpr std::string_view place_of_title = "<!--delam:title-->";
constexpr std::int64_t largest_template = std::int64_t{64} << 20;

// Beside the program: as it is installed, and as the build lays it out.
std::string template_path() {
    namespace fs = std::filesystem;
    std::error_code code;
    const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path();
    std::string first;
    for (const char* data : {DELAM_DATA_FROM_PROGRAM, "../share/delam"}) {
        const std::string path = (program / data / "view.html").lexically_normal().string();
        if (fs::exists(path, code)) return path;
        if (first.empty()) first = path;
    }
    throw Failure(exit_scene,
                  fmt::format("{}: there is no template of the page. It is built where npm is found (Debian: nodejs, "
                              "npm) and its registry answers; see README.md of bindings/cli/view",
                              first));
}

std::string escaped_title(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else
            out += c;
    }
    return out;
}

}  // namespace

std::string view_template(const std::string& named) {
    const std::string path = named.empty() ? template_path() : named;
    std::string page = read_bytes(path, largest_template);
    for (const std::string_view place : {place_of_data, place_of_title})
        if (page.find(place) == std::string::npos)
            throw Failure(exit_scene, fmt::format("{}: this is no template of the page: {} is missing", path, place));
    return page;
}

std::string filled_template(std::string page, std::string_view title, std::string_view data) {
    page.replace(page.find(place_of_title), place_of_title.size(), escaped_title(title));
    page.replace(page.find(place_of_data), place_of_data.size(), data);
    return page;
}

}  // namespace cli
