// SPDX-License-Identifier: BSD-3-Clause
// `delam own`: what the studies, which are scripts, ask about folders: the answer is in one place for all.
#include <filesystem>

#include "command/commands.hpp"
#include "file/output_folder.hpp"
#include "file/own_files.hpp"
#include "text/error.hpp"

namespace cli {

int claim(const std::string& folder, const std::vector<std::string>& names, bool known) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) throw OutputFailure(folder, code.message());
    const bool own = known || is_marked(folder);
    for (const std::string& name : names) {
        const std::string path = folder + "/" + name;
        if (!is_there(path)) continue;
        if (std::filesystem::is_directory(std::filesystem::symlink_status(path, code)))
            (void)names_in(path);
        else
            require_plain(path);
        if (!own)
            throw OutputFailure(folder, "there is " + path +
                                            ", which would be replaced, and no marker says that a study has written "
                                            "it: move it away, or choose another folder");
    }
    mark(folder);
    return exit_done;
}

int discard(const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) (void)discarded_files(folder);
    for (const std::string& folder : folders) discard_result(folder);
    return exit_done;
}

}  // namespace cli
