// SPDX-License-Identifier: BSD-3-Clause
#include "file/data_file.hpp"

#include <filesystem>

namespace cli {

namespace fs = std::filesystem;

std::string program_path() {
    std::error_code code;
    const fs::path path = fs::read_symlink("/proc/self/exe", code);
    return code ? "" : path.string();
}

DataFile data_file(const std::string& name) {
    const fs::path folder = fs::path(program_path()).parent_path();
    std::error_code code;
    DataFile expected;
    for (const char* data : {DELAM_DATA_FROM_PROGRAM, "../share/delam"}) {
        const std::string path = (folder / data / name).lexically_normal().string();
        if (fs::exists(path, code)) return {path, true};
        if (expected.path.empty()) expected.path = path;
    }
    return expected;
}

}  // namespace cli
