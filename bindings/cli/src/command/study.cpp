// SPDX-License-Identifier: BSD-3-Clause
// `delam sweep`, `delam fit` and `delam evaluate`: SciPy's methods and Matplotlib's pictures, so the rest is in Python.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/interrupt.hpp"
#include "command/reported.hpp"
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
                               {"sheets", of.sheets},
                               {"leave_out", of.leave_out},
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

namespace {

// Lets an analysis speak into its log, which the study has begun; a link is not followed.
void say_into(const std::string& log) {
    const int file = ::open(log.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0) throw OutputFailure(log, std::strerror(errno));
    const bool said = ::dup2(file, STDOUT_FILENO) >= 0 && ::dup2(file, STDERR_FILENO) >= 0;
    ::close(file);
    if (!said) throw OutputFailure(log, std::strerror(errno));
}

int served(const nlohmann::json& job, const Caller& caller) {
    say_into(job.at("log"));
    return run(job.at("scene"), job.at("set"), job.at("out"), job.at("resume"), job.at("command"), caller);
}

}  // namespace

int serve(const Caller& of) {
    Former former;
    Caller caller = of;
    caller.former = &former;
    const int answers = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    std::string line;
    while (answers >= 0 && !Interrupt::requested() && std::getline(std::cin, line)) {
        int code = reported([&] { return served(nlohmann::json::parse(line), caller); });
        // A full disk behind the log shows here at the latest.
        if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && code <= exit_not_converged) code = exit_output;
        std::clearerr(stdout);
        const std::string answer = fmt::format("{}\n", code);
        if (::write(answers, answer.data(), answer.size()) != static_cast<ssize_t>(answer.size())) break;
    }
    return exit_done;
}

}  // namespace cli
