// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <fmt/format.h>

#include "command/commands.hpp"
#include "deck/deck_scene.hpp"
#include "file/file.hpp"
#include "text/error.hpp"
#include "text/say.hpp"

namespace cli {

int import(const std::string& deck, const std::string& scene_file, bool replace) {
    namespace fs = std::filesystem;
    const fs::path folder = scene_file.empty() ? fs::path() : fs::path(scene_file).parent_path();
    // Names through links that do not resolve stay as they are.
    std::error_code code;
    fs::path mesh = fs::proximate(deck, folder.empty() ? fs::path(".") : folder, code);
    if (code == std::errc::too_many_symbolic_link_levels || code == std::errc::no_such_file_or_directory)
        mesh = fs::absolute(deck);
    else if (code)
        throw Failure(exit_scene, deck + ": cannot be read: " + code.message());
    const ImportedScene scene = import_deck(deck, mesh.generic_string());
    if (scene_file.empty()) {
        say("{}", scene.text);
        for (const std::string& line : import_lines(scene)) complain("{}\n", line);
        return exit_done;
    }
    require_replaceable(scene_file, replace, "a scene of delam import", is_imported);
    write_atomic(scene_file, scene.text);
    for (const std::string& line : import_lines(scene)) say("{}\n", line);
    say("wrote     {}: read it, then run delam check {}\n", scene_file, scene_file);
    return exit_done;
}

}  // namespace cli
