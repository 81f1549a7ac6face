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

#include "commands.hpp"
#include "delam/delam.h"
#include "error.hpp"
#include "say.hpp"

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

int guarded(int argc, char** argv) {
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
    CLI::App* run = app.add_subcommand("run", "compute the load steps of a scene and write the results");
    run->add_option("scene", scene, "scene file (TOML, see SCENE.md)")->required();
    run->add_option("--out,-o", folder,
                    "folder for the results; a result that is there is replaced when the new one is whole")
        ->required();
    run->add_flag("--resume", resume, "go on after an interruption, from the last saved step");
    with_settings(run);
    run->footer(footer);
    CLI::App* check = app.add_subcommand("check", "validate a scene and print what would be computed, and how");
    check->add_option("scene", scene, "scene file (TOML, see SCENE.md)")->required();
    with_settings(check);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? cli::exit_done : cli::exit_scene;
    }
    return run->parsed() ? cli::run(scene, settings, folder, resume, joined(argc, argv)) : cli::check(scene, settings);
}

int reported(int argc, char** argv) {
    try {
        return guarded(argc, argv);
    } catch (const cli::Failure& failure) {
        cli::complain("delam: {}\n", failure.what());
        return failure.code();
    } catch (const std::bad_alloc&) {
        cli::complain("delam: out of memory\n");
        return cli::exit_numerical;
    } catch (const std::exception& e) {
        cli::complain("delam: {}\n", e.what());
        return cli::exit_numerical;
    }
}

}  // namespace

int main(int argc, char** argv) {
    // HDF5 would print its error stack and, after a full disk, try to write again at exit; the program handles both
    // itself.
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    int code = reported(argc, argv);
    // A full disk behind standard output shows here at the latest; a worse exit code is kept.
    errno = 0;
    const bool flushed = std::fflush(stdout) == 0;
    const int reason = errno;
    if (!flushed || std::ferror(stdout) != 0) {
        cli::complain("delam: cannot write the standard output{}\n",
                      reason != 0 ? std::string(": ") + std::strerror(reason) : "");
        if (code == cli::exit_done || code == cli::exit_not_converged) code = cli::exit_output;
    }
    return code;
}
