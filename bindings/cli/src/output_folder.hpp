// SPDX-License-Identifier: BSD-3-Clause
// The output folder DIR and, in it, the folder `running`, which holds all files until the result is complete.
//
// DIR/result.json is removed before the first file of a new result is moved in, and written last: a folder with
// result.json holds one result and never a mixture.
#pragma once

#include <string>
#include <vector>

namespace cli {

struct Published {
    std::string status;  // "complete" or "incomplete"
    std::string content_hash;
    bool converged = true;  // in every step
    std::vector<std::string> closing;
};

class OutputFolder {
public:
    // Creates missing folders; refuses a folder to which another run is writing.
    explicit OutputFolder(const std::string& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    // Folder for the files of the run.
    [[nodiscard]] const std::string& running() const { return running_; }
    // Empties `running`.
    void begin();
    // Moves fields.h5, fields.xdmf, result.json and jumps.csv (if it exists), and copies of history.csv and state.bin,
    // from `running` to DIR.
    void publish();
    // Removes `running`.
    void end();
    // What result.json says; its status is "" if DIR holds no result.
    [[nodiscard]] Published published() const;

private:
    std::string path_;
    std::string running_;
    int lock_ = -1;
};

}  // namespace cli
