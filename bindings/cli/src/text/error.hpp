// SPDX-License-Identifier: BSD-3-Clause
// The reasons for which the program ends early, with the exit codes documented in --help and MANUAL.md.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace cli {

enum Exit : int {
    exit_done = 0,
    exit_not_converged = 1,
    exit_scene = 2,
    exit_output = 3,
    exit_numerical = 4,
    exit_interrupted = 130,
};

// A place in the scene: "scene.toml:14: materials[0].young".
struct Place {
    std::string file;
    std::string path;
    int line = 0;
    bool whole = false;  // all that stands in the object of this place has this line

    [[nodiscard]] std::string text() const {
        std::string out = file;
        if (line > 0) out.append(":").append(std::to_string(line));
        if (!path.empty()) out.append(": ").append(path);
        return out;
    }
};

class Failure : public std::runtime_error {
public:
    Failure(Exit code, const std::string& text) : std::runtime_error(text), code_(code), text_(text) {}
    Failure(Exit code, Place place, const std::string& text)
        : std::runtime_error(place.text() + ": " + text), code_(code), place_(std::move(place)), text_(text) {}
    [[nodiscard]] Exit code() const noexcept { return code_; }
    // Place in the scene, if it is known, and what is wrong there.
    [[nodiscard]] const Place& place() const noexcept { return place_; }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    Exit code_;
    Place place_;
    std::string text_;
};

// A file that cannot be written or read back; `name` is the file, `reason` the system's message.
class OutputFailure : public Failure {
public:
    OutputFailure(const std::string& name, const std::string& reason)
        : Failure(exit_output, "cannot write " + name + ": " + reason) {}
};

class SceneFailure : public Failure {
public:
    SceneFailure(const Place& place, const std::string& text) : Failure(exit_scene, place, text) {}
};

}  // namespace cli
