// SPDX-License-Identifier: BSD-3-Clause
#include "command/line/arguments.hpp"

#include "command/help/command_text.hpp"

namespace cli {

void add_settings(CLI::App& command, Arguments& into) {
    // One value each, so that the scene file may follow.
    command
        .add_option("--set", into.settings,
                    "a value instead of the scene file's, e.g. geometry.h=0.001, laws[0].normal_onset=10 or "
                    "solver.minimisation=alternate; may be given several times")
        ->type_name(setting_value)
        ->allow_extra_args(false);
}

void add_scene(CLI::App& command, Arguments& into) {
    command.add_option("scene", into.scene, "scene file (TOML, see SCENE.md), or input file of Abaqus (.inp)")
        ->type_name(scene_value)
        ->required();
}

}  // namespace cli
