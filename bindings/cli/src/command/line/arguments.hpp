// SPDX-License-Identifier: BSD-3-Clause
// The command line as values, and what several commands have in common.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command/commands.hpp"
#include "view/view.hpp"

namespace cli {

inline constexpr const char* footer =
    "SCENE.md and MANUAL.md are installed in share/doc/delam/bindings/cli.\n"
    "\n"
    "Exit codes\n"
    "  0    done\n"
    "  1    finished, but at least one step did not converge; or ended at the limit load\n"
    "  2    wrong usage or an error in the scene\n"
    "  3    output cannot be written (full disk, folder not writable)\n"
    "  4    numerical failure, or out of memory; finished steps are kept\n"
    "  130  interrupted (Ctrl-C, SIGTERM); finished steps are kept, go on with --resume\n";

// The values of the command line.
struct Arguments {
    std::string scene, deck, folder, page, shell, progress = "text";
    std::vector<std::string> settings;
    std::vector<std::string> names;  // of `own`
    bool resume = false, replace = false, json = false, known = false;
    ViewWishes view;
    Study study;
    SpecimenWishes specimen;
    CheckWishes check;
};

struct Commands {
    CLI::App *run, *check, *import, *specimen, *view, *sweep, *fit, *evaluate, *own, *serve, *options, *schema, *man,
        *completion;
    std::map<std::string, std::vector<std::string>> choices;  // by option
};

void add_settings(CLI::App& command, Arguments& into);
void add_scene(CLI::App& command, Arguments& into);

}  // namespace cli
