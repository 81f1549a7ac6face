// SPDX-License-Identifier: BSD-3-Clause
// `delam sweep`, `delam fit` and `delam evaluate`: SciPy's methods and Matplotlib's pictures, so the rest is in Python.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "file/data_file.hpp"
#include "text/error.hpp"

namespace cli {

void start_script(const std::string& name, const std::string& words) {
    const DataFile script = data_file(name);
    if (!script.found)
        throw Failure(exit_scene, fmt::format("{}: is not there; it is installed with the program", script.path));
    // The interpreter would answer an interrupt with a traceback while it starts: the script lets it through as soon as
    // it has an answer (command.py).
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : {SIGINT, SIGTERM}) sigaddset(&held, signal);
    (void)sigprocmask(SIG_BLOCK, &held, nullptr);
    (void)setenv("DELAM", program_path().c_str(), 1);
    // Debian's modules belong to this interpreter; elsewhere the first one counts.
    for (const char* python : {"/usr/bin/python3", "python3"})
        execlp(python, python, script.path.c_str(), words.c_str(), static_cast<char*>(nullptr));
    throw Failure(exit_scene, fmt::format("python3 cannot be started: {}", std::strerror(errno)));
}

int study(const Study& of) {
    const nlohmann::json given{{"scenes", of.scenes},
                               {"set", of.settings},
                               {"out", of.folder},
                               {"replace", of.replace},
                               {"jobs", of.jobs},
                               {"vary", of.vary},
                               {"latin", of.latin},
                               {"seed", of.seed},
                               {"data", of.data},
                               {"columns", of.columns},
                               {"parameters", of.parameters},
                               {"x", of.x},
                               {"y", of.y},
                               {"weights", of.weights},
                               {"scale", of.scale},
                               {"x_scale", of.x_scale},
                               {"width", of.width},
                               {"loops", of.loops},
                               {"slack", of.slack},
                               {"compliance", of.compliance},
                               {"test", of.test},
                               {"sheet", of.sheet},
                               {"units", of.units},
                               {"crack", of.crack},
                               {"marks", of.marks},
                               {"specimen", of.specimen},
                               {"calibration", of.calibration},
                               {"beside", of.beside},
                               {"confidence", of.confidence},
                               {"held", of.held}};
    std::string words;
    try {
        words = given.dump(-1, ' ', true);
    } catch (const nlohmann::json::exception&) {
        throw Failure(exit_scene, "a name on the command line is not UTF-8, which studies need");
    }
    start_script("study/" + of.name + ".py", words);
}

}  // namespace cli
