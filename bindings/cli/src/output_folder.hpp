// SPDX-License-Identifier: BSD-3-Clause
// The output folder DIR and, in it, the folder `running` where everything is written until it is whole.
//
// DIR/result.json is removed before the first file of a new result is moved in and comes back last: a folder with
// result.json holds one result and never a mixture.
#pragma once

#include <string>

namespace cli {

class OutputFolder {
public:
    // Creates what is missing; refuses a folder that another run is writing to.
    explicit OutputFolder(const std::string& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    // Folder for the files of the run.
    [[nodiscard]] const std::string& running() const { return running_; }
    // An empty `running`.
    void begin();
    // Moves fields.h5, fields.xdmf, result.json and, where there is one, jumps.csv, and copies of history.csv and
    // state.bin, from `running` to DIR.
    void publish();
    // Removes `running`.
    void end();
    // "complete", "incomplete" or "" when DIR holds no result; content_hash is the scene's that made it.
    [[nodiscard]] std::string status(std::string& content_hash, bool& all_converged) const;

private:
    std::string path_;
    std::string running_;
    int lock_ = -1;
};

}  // namespace cli
