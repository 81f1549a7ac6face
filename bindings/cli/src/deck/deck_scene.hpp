// SPDX-License-Identifier: BSD-3-Clause
// An Abaqus input file as a scene: the mesh stays in the file, everything else is written for people to read and
// change.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"

namespace cli {

struct ImportedScene {
    std::string text;                   // TOML
    std::map<int, Place> origins{};     // of its tables, by the lines at which they begin: cards of the deck
    std::vector<std::string> taken;     // translated items and their new form, for people
    std::vector<std::string> changed;   // items that the scene handles in another way
    std::vector<std::string> left_out;  // items that the scene does not have
};

// mesh_name: by which the scene names the deck, relative to its own folder. Throws SceneFailure with file, line and
// keyword where the deck says something that the scene could only guess.
ImportedScene import_deck(const std::string& deck, const std::string& mesh_name);

// True if a text is a scene that delam import has written, whatever was changed in it since.
bool is_imported(std::string_view text);

// Returns lines for people that say what was taken, changed and left out.
std::vector<std::string> import_lines(const ImportedScene& scene);

}  // namespace cli
