// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hdf5.h>
#include <CLI/CLI.hpp>

#include "delam/delam.h"
#include "error.hpp"
#include "program.hpp"
#include "say.hpp"

namespace cli {

namespace {

constexpr const char* footer =
    "SCENE.md and README.md are installed in share/doc/delam/bindings/cli.\n"
    "\n"
    "Exit codes\n"
    "  0    done\n"
    "  1    finished, but at least one step did not converge\n"
    "  2    wrong usage or an error in the scene\n"
    "  3    output cannot be written (full disk, folder not writable)\n"
    "  4    numerical failure, out of memory or limit load; finished steps are kept\n"
    "  130  interrupted (Ctrl-C, SIGTERM); finished steps are kept, go on with --resume\n";

std::string joined(int count, char** words) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i > 0 ? " " : "") + std::string(words[i]);
    return out;
}

void add_view(CLI::App* command, std::string& folder, ViewWishes& wishes) {
    command->add_option("result", folder, "folder of a result (--out of delam run)")->required();
    command->add_option("--out,-o", wishes.page, "the page (default: view.html in the folder, anew)");
    command->add_flag("--replace", wishes.replace, "overwrite the page that --out names if it is there");
    command
        ->add_option("--every", wishes.every,
                     "show the fields of every N-th written step and of the last (default: as many as a browser holds)")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000000));
    command->add_option("--template", wishes.page_template, "a template of the page instead of the installed one")
        ->type_name("FILE");
    command->footer(footer);
}

int guarded(int argc, char** argv, const Caller& caller) {
    CLI::App app("delam: delamination of layered structures by energy minimisation");
    app.footer(footer);
    app.set_version_flag("--version",
                         fmt::format("delam {} (commit {}, ABI {})", delam_version(), delam_commit(), delam_abi()));
    app.require_subcommand(1);
    std::string scene;
    std::string folder;
    bool resume = false;
    std::vector<std::string> settings;
    // One value each, so that the scene file may follow.
    const auto with_settings = [&settings](CLI::App* command) {
        command
            ->add_option("--set", settings,
                         "KEY=VALUE: a value instead of the scene file's, e.g. geometry.h=0.001, "
                         "laws[0].normal_onset=10 or solver.minimisation=alternate; may be given several times")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
    };
    CLI::App* run_command = app.add_subcommand("run", "compute the load steps of a scene and write the results");
    run_command->add_option("scene", scene, "scene file (TOML, see SCENE.md)")->required();
    run_command
        ->add_option("--out,-o", folder,
                     "folder for the results; a result that is there is replaced when the new one is whole")
        ->required();
    run_command->add_flag("--resume", resume, "go on after an interruption, from the last saved step");
    with_settings(run_command);
    run_command->footer(footer);
    CLI::App* check_command = app.add_subcommand("check", "validate a scene and print what would be computed, and how");
    check_command->add_option("scene", scene, "scene file (TOML, see SCENE.md)")->required();
    with_settings(check_command);
    CLI::App* import_command = app.add_subcommand(
        "import", "write the scene of an Abaqus input file; run and check take such files as they are");
    std::string deck;
    bool replace = false;
    import_command->add_option("deck", deck, "input file with cohesive elements or surfaces (.inp, see SCENE.md)")
        ->required();
    import_command->add_option("--out,-o", folder, "the scene file (default: standard output)");
    import_command->add_flag("--replace", replace, "overwrite the scene file if it is there");
    import_command->footer(footer);
    CLI::App* view_command = app.add_subcommand("view", "write a result as one page for a browser, without a network");
    ViewWishes wishes;
    add_view(view_command, folder, wishes);
    CLI::App* options_command =
        app.add_subcommand("options", "list the options of [solver] and the parameters of laws");
    bool json = false;
    options_command->add_flag("--json", json, "for programs");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? exit_done : exit_scene;
    }
    if (options_command->parsed()) return options(json);
    if (import_command->parsed()) return import(deck, folder, replace);
    if (view_command->parsed()) return view(folder, wishes);
    return run_command->parsed() ? run(scene, settings, folder, resume, joined(argc, argv), caller)
                                 : check(scene, settings, caller);
}

int reported(int argc, char** argv, const Caller& caller) {
    try {
        return guarded(argc, argv, caller);
    } catch (const Failure& failure) {
        complain("delam: {}\n", failure.what());
        return failure.code();
    } catch (const std::bad_alloc&) {
        complain("delam: out of memory\n");
        return exit_numerical;
    } catch (const std::exception& e) {
        complain("delam: {}\n", e.what());
        return exit_numerical;
    }
}

}  // namespace

int program(int argc, char** argv, const Caller& caller) {
    // HDF5 would print its error stack and, after a full disk, try to write again at exit; the program handles both
    // itself.
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    int code = reported(argc, argv, caller);
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
