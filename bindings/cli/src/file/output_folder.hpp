// SPDX-License-Identifier: BSD-3-Clause
// The output folder DIR and, in it, the folder `running`, which holds all files until the result is complete.
//
// DIR/result.json is removed before the first file of a new result is moved in, and written last: a folder with
// result.json holds one result and never a mixture. In DIR only files with the names of a result are replaced, in
// `running` only files with names of a run, and both only where own_files.hpp says whose they are.
#pragma once

#include <string>
#include <vector>

#include "file/hash.hpp"

namespace cli {

struct Published {
    std::string status;  // "complete" or "incomplete"
    std::string content_hash;
    bool converged = true;  // in every step
    std::vector<std::string> closing;
    std::vector<NamedContent> files;  // without those of older versions, which named none
};

class OutputFolder {
public:
    // Creates missing folders; refuses a folder to which another run is writing, and one with files of somebody else
    // that the run would replace or remove.
    explicit OutputFolder(const std::string& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    // Folder for the files of the run.
    [[nodiscard]] const std::string& running() const { return running_; }
    // Empties `running`.
    void begin();
    // The files of the result in `running`, but for result.json, which names them.
    [[nodiscard]] std::vector<NamedContent> contents() const;
    // Moves result.json and, if they exist, fields.h5, fields.xdmf and jumps.csv, and copies of history.csv and
    // state.bin, from `running` to DIR.
    void publish();
    // Removes the files in `running`.
    void end();

private:
    std::string path_;
    std::string running_;
    int lock_ = -1;
};

// Returns what result.json of a folder says; its status is "" if there is no result.
Published published_in(const std::string& folder);
// Throws Failure(exit_scene) if a file of the result is missing, or not as result.json says.
void require_unchanged(const std::string& folder, const Published& published);

// The files of a result, and of a run that is not finished, in a folder that holds nothing else. Throws OutputFailure
// where it does, or where nothing says that a run has written them.
std::vector<std::string> discarded_files(const std::string& folder);
// Removes them, and the folder.
void discard_result(const std::string& folder);

}  // namespace cli
