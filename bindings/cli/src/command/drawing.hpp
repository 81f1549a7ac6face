// SPDX-License-Identifier: BSD-3-Clause
// The drawing of a scene before it runs: bodies, interfaces, notches, supports and loads, with their names.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace cli {

struct Caller;
struct Model;
struct Scene;

// Throws Failure(exit_scene) if the name of the file says no format, or the program cannot become a script.
void require_drawable(const std::string& file, const Caller& caller);
// Returns what plot/draw.py reads.
nlohmann::json drawing_of(const Model& model, const Scene& scene);
// Becomes the script that writes the file.
[[noreturn]] void draw(const nlohmann::json& drawing, const std::string& file);

}  // namespace cli
