// SPDX-License-Identifier: BSD-3-Clause
#include "command/line/work_options.hpp"

#include <string>

#include <fmt/format.h>

#include "command/help/command_text.hpp"

namespace cli {

Commands add_work(CLI::App& app, Arguments& into) {
    Commands of{};
    of.run = app.add_subcommand("run", "compute the load steps of a scene and write the results");
    add_scene(*of.run, into);
    of.run
        ->add_option("--out,-o", into.folder,
                     "folder for the results; a result that is there is replaced when the new one is whole")
        ->type_name(folder_value)
        ->required();
    of.run->add_flag("--resume", into.resume, "go on after an interruption, from the last saved step");
    of.run
        ->add_option("--progress", into.progress,
                     "how progress is told: text, or json, one object in each line of standard output")
        ->type_name("HOW")
        ->check(CLI::IsMember(of.choices["progress"] = {"text", "json"}));
    add_settings(*of.run, into);
    of.run->footer(footer);
    of.check = app.add_subcommand("check", "validate a scene and print what would be computed, and how");
    add_scene(*of.check, into);
    of.check->add_flag("--json", into.check.json, "for programs: one object, with the error of a wrong scene");
    of.check->add_flag(
        "--no-plan", into.check.no_plan,
        "leave out how the scene is computed, and the time and memory that it takes: many times as fast");
    of.check
        ->add_option("--draw", into.check.drawing,
                     "also draw the scene into a file (.svg or .png): bodies, interfaces, notches, supports and loads "
                     "with their names; a drawing that is there is replaced")
        ->type_name(file_value);
    add_settings(*of.check, into);
    of.import = app.add_subcommand(
        "import", "write the scene of an Abaqus input file; run and check take such files as they are");
    of.import->add_option("deck", into.deck, "input file with cohesive elements or surfaces (.inp, see SCENE.md)")
        ->type_name(deck_value)
        ->required();
    of.import->add_option("--out,-o", into.folder, "the scene file (default: standard output)")->type_name(file_value);
    of.import->add_flag("--replace", into.replace, "overwrite the scene file if it is there");
    of.import->footer(footer);
    return of;
}

void add_new(CLI::App& app, Arguments& into, Commands& of) {
    SpecimenWishes& wishes = into.specimen;
    of.specimen = app.add_subcommand("new", "write the scene of a test from the sheet of its specimen");
    of.specimen->add_option("kind", wishes.kind, "the kind of test")
        ->type_name("KIND")
        ->required()
        ->check(CLI::IsMember(of.choices["kind"] = specimen_kinds));
    for (const SheetRow& row : sheet_rows())
        of.specimen
            ->add_option(std::string("--") + row.name, wishes.values[row.name],
                         fmt::format("{}, e.g. {}", row.meaning, row.example))
            ->type_name("VALUE");
    of.specimen->add_option("--layup", wishes.layup, "laminate: angles of the plies from the bottom up, e.g. 0/90/90/0")
        ->type_name("ANGLES");
    of.specimen->add_option("--steps", wishes.steps, "load steps (default 100)")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, 100000));
    of.specimen->add_option("--out,-o", wishes.out, "the scene file (default: standard output)")->type_name(file_value);
    of.specimen->add_flag("--replace", wishes.replace, "overwrite the scene file if it is there");
    of.specimen->footer(footer);
}

void add_view(CLI::App& app, Arguments& into, Commands& of) {
    of.view = app.add_subcommand("view", "write a result as one page for a browser, without a network");
    of.view->add_option("result", into.folder, "folder of a result (--out of delam run)")
        ->type_name(folder_value)
        ->required();
    of.view->add_option("--out,-o", into.view.page, "the page (default: view.html in the folder, anew)")
        ->type_name(file_value);
    of.view->add_flag("--replace", into.view.replace, "overwrite the page that --out names if it is there");
    of.view
        ->add_option("--every", into.view.every,
                     "show the fields of every N-th written step and of the last (default: as many as a browser holds)")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000000));
    of.view->add_option("--template", into.view.page_template, "a template of the page instead of the installed one")
        ->type_name(file_value);
    of.view->footer(footer);
}

}  // namespace cli
