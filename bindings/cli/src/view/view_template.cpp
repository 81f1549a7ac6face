// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_template.hpp"

#include <utility>

#include <fmt/format.h>

#include "file/data_file.hpp"
#include "file/input_file.hpp"
#include "text/error.hpp"
#include "text/xml_text.hpp"

namespace cli {

namespace {

constexpr std::string_view place_of_data = "<!--delam:data-->";
constexpr std::string_view place_of_title = "<!--delam:title-->";
constexpr std::int64_t largest_template = std::int64_t{64} << 20;

std::string template_path() {
    const DataFile file = data_file("view.html");
    if (file.found) return file.path;
    throw Failure(exit_scene,
                  fmt::format("{}: there is no template of the page. It comes with the program: `cmake --preset "
                              "release` puts it into the folder of the build, and `cmake --install` installs it. The "
                              "sources have it in bindings/cli/view/view.html, which --template FILE takes as well",
                              file.path));
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
    page.replace(page.find(place_of_title), place_of_title.size(), xml_text(title));
    page.replace(page.find(place_of_data), place_of_data.size(), data);
    return page;
}

}  // namespace cli
