// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command/help/completion.hpp"
#include "command/help/man_page.hpp"
#include "command/help/schema.hpp"
#include "command/program.hpp"
#include "delam/delam.h"
#include "text/error.hpp"
#include "text/say.hpp"
#include "text/wording.hpp"
#include "view/view.hpp"

namespace cli {

namespace {

constexpr const char* footer =
    "SCENE.md and MANUAL.md are installed in share/doc/delam/bindings/cli.\n"
    "\n"
    "Exit codes\n"
    "  0    done\n"
    "  1    finished, but at least one step did not converge; or ended at the limit load\n"
    "  2    wrong usage or an error in the scene\n"
    "  3    output cannot be written (full disk, folder not writable)\n"
    "  4    numerical failure, or out of memory; finished steps are kept\n"
    "  130  interrupted (Ctrl-C, SIGTERM); finished steps are kept, go on with --resume\n";

constexpr double largest_factor = 1e150;  // its square is a number

std::string joined(int count, char** words) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i > 0 ? " " : "") + std::string(words[i]);
    return out;
}

// The values of the command line.
struct Arguments {
    std::string scene, deck, folder, page, shell, progress = "text";
    std::vector<std::string> settings;
    std::vector<std::string> names;  // of `own`
    bool resume = false, replace = false, json = false, known = false;
    ViewWishes view;
    Study study;
    SpecimenWishes specimen;
};

struct Commands {
    CLI::App *run, *check, *import, *specimen, *view, *sweep, *fit, *evaluate, *own, *serve, *options, *schema, *man,
        *completion;
    std::map<std::string, std::vector<std::string>> choices;  // by option
};

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
    of.check->add_flag("--json", into.json, "for programs: one object, with the error of a wrong scene");
    of.check
        ->add_option("--draw", into.page,
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

// A number from `low` to `high`. CLI::Range takes what is no number, and infinities where they are a bound.
CLI::Validator number_within(double low, double high, const std::string& allowed) {
    return {[=](const std::string& text) {
                double value = 0;
                if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high && (value != 0 || low == 0))
                    return std::string();
                return fmt::format("{:.40}: {} is expected", text, allowed);
            },
            ""};
}

// A value of an option that takes several, each time one of them.
template <class Value>
CLI::Option* add_several(CLI::App& command, const char* names, std::vector<Value>& into, const char* meaning) {
    return command.add_option(names, into, meaning)->allow_extra_args(false);
}

void add_sweep(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.sweep =
        app.add_subcommand("sweep", "run a scene with many values, several at once, into one table and pictures");
    of.sweep->add_option("scene", study.scenes, "scene file")->type_name(scene_value)->required()->expected(1);
    add_several(*of.sweep, "--vary", study.vary,
                "FROM:TO:NUMBER, FROM:TO:NUMBER:log, a list A,B,C or, with --latin, FROM:TO, e.g. "
                "laws.0.normal_toughness=200:400:5; given several times, all combinations are run")
        ->type_name("KEY=VALUES")
        ->required();
    of.sweep->add_option("--latin", study.latin, "a Latin hypercube of so many points in the ranges instead")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, 1000000));
    of.sweep->add_option("--seed", study.seed, "of --latin (default 1)")
        ->type_name("NUMBER")
        ->check(CLI::Range(0, 2147483647));
    of.sweep
        ->add_option("--out,-o", into.folder,
                     "folder for table, pictures and results; the same command goes on after an interruption")
        ->type_name(folder_value)
        ->required();
    of.sweep->add_flag("--replace", into.replace, "discard the runs of another sweep in the folder");
    of.sweep->footer(footer);
}

// Adds the option that chooses a test of a file with several.
void add_specimen(CLI::App& command, Study& study) {
    add_several(
        command, "--specimen", study.specimen,
        "which test of a file that has several: its name, or its number from 1 on; one for all files, or one for "
        "each")
        ->type_name("NAME");
}

void add_confidence(CLI::App& command, Study& study) {
    command.add_option("--confidence", study.confidence, "of the intervals (default 0.95)")
        ->type_name("LEVEL")
        ->check(number_within(0.01, 0.9999, "a number from 0.01 to 0.9999"));
}

void add_fit(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.fit = app.add_subcommand("fit", "find numbers of the scene, above all of its laws, from measured load curves");
    of.fit->add_option("scenes", study.scenes, "scene files that share the parameters")
        ->type_name(scene_value)
        ->required();
    of.fit->add_option("--data", study.data, "a CSV file with a curve for each scene, in its order")
        ->type_name(file_value)
        ->required();
    of.fit
        ->add_option(
            "--parameters", study.parameters,
            "KEY, KEY=LOWER:UPPER or KEY=LOWER:UPPER@START, e.g. laws.0.normal_toughness=100:500; the start is "
            "otherwise the value of the scene")
        ->type_name("KEY")
        ->required();
    of.fit->add_option("--x", study.x, "column of history.csv over which the curve is given (default load)")
        ->type_name("COLUMN");
    of.fit->add_option("--y", study.y, "column that is fitted (default reaction)")->type_name("COLUMN");
    of.fit
        ->add_option("--columns", study.columns,
                     "columns of the data (default: those whose titles say displacement and load, or the first two)")
        ->type_name("X Y")
        ->expected(2);
    add_specimen(*of.fit, study);
    of.fit
        ->add_option("--width", study.width,
                     "width of the specimen, by which the y of the data is divided, where a plane scene has forces per "
                     "width; with its own unit if the scene names units, e.g. 25mm")
        ->type_name("WIDTH");
    const auto factor =
        number_within(-largest_factor, largest_factor, "a finite number other than 0, of at most 1e150");
    of.fit->add_option("--scale", study.scale, "factor on the y of the data")->type_name("NUMBER")->check(factor);
    of.fit->add_option("--x-scale", study.x_scale, "factor on the x of the data")->type_name("NUMBER")->check(factor);
    of.fit
        ->add_option("--loops", study.loops,
                     "unloadings of the data: cut (default), or follow, as the load history of the scene")
        ->type_name("HOW")
        ->check(CLI::IsMember(of.choices["loops"] = {"cut", "follow"}));
    of.fit
        ->add_option(
            "--slack", study.slack,
            "displacement at which the load begins, which is taken off: find (default), none, or a length, e.g. "
            "0.3mm")
        ->type_name("LENGTH");
    of.fit
        ->add_option("--compliance", study.compliance,
                     "of machine and fixture: displacement per load of the specimen, which is taken off, e.g. 2e-5mm/N")
        ->type_name("COMPLIANCE");
    of.fit
        ->add_option(
            "--weights", study.weights,
            "curve (default): residuals over the largest y of their curve; relative: over their own y; equal: as "
            "they are")
        ->type_name("HOW")
        ->check(CLI::IsMember(of.choices["weights"] = {"curve", "equal", "relative"}));
    add_confidence(*of.fit, study);
    of.fit
        ->add_option("--held", study.held,
                     "by which part numbers of laws and elastic constants that are not among the parameters are moved "
                     "in the end, to say what an error there does, an analysis each (default 0.1; 0: none)")
        ->type_name("PART")
        ->check(number_within(0, 1, "a number from 0 to 1"));
    of.fit->add_option("--out,-o", into.folder, "folder for fit.json, fit.csv and pictures")
        ->type_name(folder_value)
        ->required();
    of.fit->footer(footer);
}

void add_evaluate(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.evaluate = app.add_subcommand(
        "evaluate", "toughness by the standards (ISO 15024, ASTM D5528, D7905, D6671) from the file of a test machine");
    of.evaluate->add_option("test", study.test, "dcb, enf or mmb")
        ->type_name("TEST")
        ->required()
        ->check(CLI::IsMember(of.choices["test"] = {"dcb", "enf", "mmb"}));
    of.evaluate
        ->add_option("file", study.data,
                     "a file with displacement, load and, if there is one, crack length; several are a series")
        ->type_name(file_value)
        ->required();
    struct Entry {
        const char *key, *meaning;
    };
    for (const Entry& entry :
         {Entry{"width", "width of the specimen with its unit, e.g. 25mm"}, Entry{"arm", "thickness of one arm"},
          Entry{"thickness", "thickness of both arms together, instead of --arm"},
          Entry{"notch", "length of the starter crack, from the line of load (dcb, mmb) or the support (enf)"},
          Entry{"span", "distance of the outer supports, of enf and mmb"},
          Entry{"half-span", "half of it, instead of --span"},
          Entry{"lever", "from the middle to the load on the lever, of mmb"},
          Entry{"block-pin", "dcb with load blocks: from the middle of the arm to the pin, l1 of ISO 15024"},
          Entry{"block-length", "dcb with load blocks: length of a block, 2 l2 of ISO 15024"},
          Entry{"compliance", "of machine and fixture, which takes its displacement off, e.g. 2e-5mm/N"},
          Entry{"E1", "modulus along the fibres, e.g. 140GPa"}, Entry{"E2", "modulus across them"},
          Entry{"G13", "shear modulus across the thickness"}, Entry{"G12", "the same of a ply, instead of --G13"}})
        of.evaluate->add_option("--" + std::string(entry.key), study.sheet[entry.key], entry.meaning)
            ->type_name("QUANTITY");
    of.evaluate
        ->add_option("--columns", study.columns,
                     "columns of the file (default: those whose titles say displacement and load)")
        ->type_name("X Y")
        ->expected(2);
    of.evaluate->add_option("--units", study.units, "their units, where the file has none, e.g. mm N")
        ->type_name("LENGTH FORCE")
        ->expected(2);
    of.evaluate->add_option("--crack", study.crack, "column with crack lengths (default: that whose title says so)")
        ->type_name("COLUMN");
    of.evaluate
        ->add_option("--marks", study.marks,
                     "a sheet of crack lengths apart, with the time or the displacement of each beside it")
        ->type_name(file_value);
    add_several(
        *of.evaluate, "--specimen", study.specimen,
        "which test of a file that has several: its name, or its number from 1 on; all, or several of them, are a "
        "series")
        ->type_name("NAME");
    of.evaluate
        ->add_option("--sheets", study.sheets,
                     "a table with a row for each specimen of a series: \"Specimen\", and options that differ, e.g. "
                     "\"width (mm)\"")
        ->type_name(file_value);
    add_several(*of.evaluate, "--leave-out", study.leave_out,
                "a specimen that counts for no mean of the series; its row stays, and it is named")
        ->type_name("NAME");
    add_confidence(*of.evaluate, study);
    add_several(
        *of.evaluate, "--calibration", study.calibration,
        "of enf: a file that was measured at another length of the crack, e.g. 20mm=a20.csv; given twice or more")
        ->type_name("LENGTH=FILE");
    of.evaluate->add_option("--beside", study.beside, "folder of a fit, whose toughness stands beside")
        ->type_name(folder_value);
    of.evaluate->add_option("--out,-o", into.folder, "folder for tables and a picture")
        ->type_name(folder_value)
        ->required();
    of.evaluate->add_flag("--replace", into.replace,
                          "replace the evaluation of another test, or of another series, in the folder");
    of.evaluate->footer(footer);
}

// Hidden from people: the studies call it.
void add_own(CLI::App& app, Arguments& into, Commands& of) {
    of.own = app.add_subcommand("own", "which files are the program's own (study/MANUAL.md)")->group("");
    of.own->add_option("action", into.page)->required()->check(CLI::IsMember({"claim", "discard"}));
    of.own->add_option("names", into.names)->required();
    of.own->add_flag("--known", into.known);
    of.serve = app.add_subcommand("serve", "run analyses of a study")->group("");
}

void add_studies(CLI::App& app, Arguments& into, Commands& of) {
    add_sweep(app, into, of);
    add_fit(app, into, of);
    add_evaluate(app, into, of);
    for (CLI::App* command : {of.sweep, of.fit}) {
        add_settings(*command, into);
        command->add_option("--jobs,-j", into.study.jobs, "runs at once (default 1)")
            ->type_name("NUMBER")
            ->check(CLI::Range(1, 4096));
    }
}

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

std::vector<OptionText> options_of(const CLI::App& app, const Commands& commands) {
    std::vector<OptionText> out;
    for (const CLI::Option* option : app.get_options()) {
        OptionText text;
        text.argument = option->get_positional();
        for (const std::string& name : option->get_lnames()) text.names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) text.names.push_back("-" + name);
        if (text.argument) text.names = {option->get_name(true)};
        text.value = option->get_expected_max() > 0 ? option->get_type_name() : "";
        if (const std::size_t end = text.value.find(':'); end != std::string::npos) text.value.resize(end);
        text.meaning = option->get_description();
        text.needed = option->get_required();
        text.several = option->get_items_expected_max() > 1 && option->get_type_size_max() == 1;
        const auto known = commands.choices.find(option->get_single_name());
        if (known != commands.choices.end()) text.choices = known->second;
        out.push_back(std::move(text));
    }
    return out;
}

ProgramText text_of(const CLI::App& app, const Commands& commands, const std::string& name) {
    ProgramText out{
        name, "delamination of layered structures by energy minimisation", footer, options_of(app, commands), {}};
    for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
        out.commands.push_back({command->get_name(), command->get_description(), options_of(*command, commands)});
    return out;
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
    std::vector<std::string> out;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
        out.push_back(command->get_name());
    return out;
}

// Words that begin with -- are options: one that the command does not have is named, with those nearby, before its
// value is taken for something else.
void require_known(const std::vector<std::string>& words, const CLI::App& app) {
    const CLI::App* command = app.get_subcommand(words[0]);
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
        const std::string name = words[i].substr(0, words[i].find('='));
        if (name.compare(0, 2, "--") != 0 || std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Failure(exit_scene, fmt::format("{}: `delam {}` has no such option{}; `delam help {}` lists its options",
                                              shortened(name), words[0], suggestion(name, known), words[0]));
    }
}

// `delam` alone, `delam help` and `delam help run` say what `--help` says; a first word that is no command is named
// with those nearby.
std::vector<std::string> words_of(int argc, char** argv, const CLI::App& app) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) return {"--help"};
    if (words[0].empty() || words[0][0] == '-') return words;
    const std::vector<std::string> known = names_of_commands(app);
    const auto is_known = [&](const std::string& word) {
        return std::find(known.begin(), known.end(), word) != known.end() || word == "own" || word == "serve";
    };
    const bool help = words[0] == "help";
    if (help) words.erase(words.begin());
    if (help && words.empty()) return {"--help"};
    if (!is_known(words[0]))
        throw Failure(exit_scene,
                      fmt::format("\"{}\" is no command{}; the commands are {}; `delam help COMMAND` tells more",
                                  shortened(words[0]), suggestion(words[0], known), listing(known)));
    if (help) return {words[0], "--help"};
    require_known(words, app);
    return words;
}

// Returns what is wrong with the words of a command. A word that is missing is told with what it means.
Failure refused(const CLI::ParseError& error, const CLI::App& app) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    if (commands.empty()) return {exit_scene, error.what()};
    std::string text = error.what();
    for (const CLI::Option* option : commands.front()->get_options())
        if (error.get_name() == "RequiredError" && option->get_required() && option->count() == 0) {
            text = fmt::format("{} {} is required: {}", option->get_name(), option->get_type_name(),
                               option->get_description());
            break;
        }
    const std::string name = commands.front()->get_name();
    return {exit_scene, fmt::format("{}: {}; `delam help {}` tells more", name, text, name)};
}

int guarded(int argc, char** argv, const Caller& caller) {
    CLI::App app("delam: delamination of layered structures by energy minimisation");
    app.footer(footer);
    app.set_version_flag("--version",
                         fmt::format("delam {} (commit {}, ABI {})", delam_version(), delam_commit(), delam_abi()));
    app.require_subcommand(1);
    Arguments given;
    Commands of = add_work(app, given);
    add_new(app, given, of);
    add_view(app, given, of);
    add_studies(app, given, of);
    add_own(app, given, of);
    add_help(app, given, of);
    try {
        app.name(argv[0]);
        std::vector<std::string> words = words_of(argc, argv, app);
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) throw refused(e, app);
        std::ostringstream shown;
        app.exit(e, shown);
        say_text(shown.str());
        return exit_done;
    }
    if (of.options->parsed()) return options(given.json);
    if (of.import->parsed()) return import(given.deck, given.folder, given.replace);
    if (of.specimen->parsed()) {
        given.specimen.command = joined(argc, argv);
        return new_scene(given.specimen);
    }
    if (of.view->parsed()) return view(given.folder, given.view);
    if (of.sweep->parsed() || of.fit->parsed() || of.evaluate->parsed()) {
        given.study.name = of.fit->parsed() ? "fit" : of.sweep->parsed() ? "sweep" : "evaluate";
        given.study.settings = given.settings;
        given.study.folder = given.folder;
        given.study.replace = given.replace;
        return study(given.study);
    }
    if (of.own->parsed()) {
        const std::vector<std::string>& names = given.names;
        return given.page == "discard" ? discard(names)
                                       : claim(names.front(), {names.begin() + 1, names.end()}, given.known);
    }
    if (of.serve->parsed()) return serve(caller);
    if (of.check->parsed()) return check(given.scene, given.settings, given.json, given.page, caller);
    if (of.run->parsed()) {
        say_json_lines(given.progress == "json");
        return run(given.scene, given.settings, given.folder, given.resume, joined(argc, argv), caller);
    }
    const ProgramText text = text_of(app, of, caller.name);
    if (of.schema->parsed()) say_raw(scene_schema());
    if (of.completion->parsed()) say_raw(completion(text, given.shell));
    if (of.man->parsed()) say_raw(given.page == "delam-scene" ? man_page_of_scenes(text) : man_page_of_program(text));
    return exit_done;
}

int failed(const std::string& message, int code) {
    complain("delam: {}\n", message);
    say_event("error", "\"message\": " + json_text(message));
    return code;
}

}  // namespace

int reported(const std::function<int()>& command) {
    try {
        return command();
    } catch (const Failure& failure) {
        return failed(failure.what(), failure.code());
    } catch (const std::bad_alloc&) {
        return failed("out of memory", exit_numerical);
    } catch (const std::exception& e) {
        return failed(e.what(), exit_numerical);
    }
}

int program(int argc, char** argv, const Caller& caller) {
    say_json_lines(false);
    int code = reported([&] { return guarded(argc, argv, caller); });
    say_event("end", fmt::format("\"exit_code\": {}", code));
    // A full disk behind standard output shows here at the latest; a worse exit code is kept.
    errno = 0;
    const bool flushed = std::fflush(stdout) == 0;
    const int reason = errno;
    if (!flushed || std::ferror(stdout) != 0) {
        complain("delam: cannot write the standard output{}\n",
                 reason != 0 ? std::string(": ") + std::strerror(reason) : "");
        if (code == exit_done || code == exit_not_converged) code = exit_output;
    }
    return code;
}

}  // namespace cli
