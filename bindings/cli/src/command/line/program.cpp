// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command/help/completion.hpp"
#include "command/help/man_page.hpp"
#include "command/help/schema.hpp"
#include "command/line/help_options.hpp"
#include "command/line/program.hpp"
#include "command/line/study_options.hpp"
#include "command/line/work_options.hpp"
#include "command/reported.hpp"
#include "delam/delam.h"
#include "text/error.hpp"
#include "text/say.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

std::string joined(int count, char** words) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i > 0 ? " " : "") + std::string(words[i]);
    return out;
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
    if (of.check->parsed()) return check(given.scene, given.settings, given.check, caller);
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

}  // namespace

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
