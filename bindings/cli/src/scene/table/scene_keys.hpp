// SPDX-License-Identifier: BSD-3-Clause
// All tables of a scene file with their keys, schema 1.
#pragma once

#include <string_view>
#include <vector>

#include "scene/table/keys.hpp"

namespace cli {

// The first is the file itself.
const std::vector<KeyTable>& scene_tables();
const KeyTable& scene_table(std::string_view name);

// The tables that other files fill: those of the materials and the block (scene_keys_bodies.cpp), of the mesh and its
// generators (scene_keys_mesh.cpp), of interfaces and laws (scene_keys_laws.cpp), of what acts on bodies
// (scene_keys_actions.cpp).
std::vector<KeyTable> body_tables();
std::vector<KeyTable> mesh_tables();
std::vector<KeyTable> interface_tables();
std::vector<KeyTable> action_tables();

// Rows.
KeyRow number_key(std::string_view key, const Range& range = any_number);
KeyRow whole_key(std::string_view key, std::int64_t least, std::int64_t most = INT64_MAX);
KeyRow flag_key(std::string_view key);
KeyRow text_key(std::string_view key);
KeyRow choice_key(std::string_view key, std::vector<std::string> choices);
KeyRow numbers_key(std::string_view key, const Range& range = any_number);
KeyRow vector_key(std::string_view key);  // as many numbers as the scene has dimensions
KeyRow texts_key(std::string_view key);
KeyRow table_key(std::string_view key, std::string_view content);
KeyRow tables_key(std::string_view key, std::string_view content);

}  // namespace cli
