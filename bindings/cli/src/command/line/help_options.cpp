// SPDX-License-Identifier: BSD-3-Clause
#include "command/line/help_options.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "command/help/completion.hpp"
#include "text/wording.hpp"

namespace cli {

void add_help(CLI::App& app, Arguments& into, Commands& of) {
    of.options = app.add_subcommand("options", "list the options of [solver] and the parameters of laws");
    of.options->add_flag("--json", into.json, "for programs");
    of.schema = app.add_subcommand("schema", "print the JSON Schema of scene files, for editors");
    of.man = app.add_subcommand("man", "print a manual page, for man -l");
    of.man->add_option("page", into.page, "delam (the default) or delam-scene")
        ->type_name("PAGE")
        ->check(CLI::Validator(
            [pages = of.choices["page"] = {"delam", "delam-scene"}](const std::string& page) {
                return std::find(pages.begin(), pages.end(), page) != pages.end()
                           ? std::string()
                           : fmt::format("\"{}\" is no page; the pages are {}; `delam help COMMAND` tells of a command",
                                         shortened(page), listing(pages));
            },
            "", "page"));
    of.completion = app.add_subcommand("completion", "print the script that completes command lines in a shell");
    of.completion->add_option("shell", into.shell, "bash, zsh or fish")
        ->type_name("SHELL")
        ->required()
        ->check(CLI::IsMember(of.choices["shell"] = completion_shells()));
}

}  // namespace cli
