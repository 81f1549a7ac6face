// SPDX-License-Identifier: BSD-3-Clause
// Files that come with the program: in share/delam beside it, as it is installed and as the build lays it out.
#pragma once

#include <string>

namespace cli {

struct DataFile {
    std::string path;
    bool found = false;  // else path is where it was expected
};
DataFile data_file(const std::string& name);
// The path of this program; "" if the system does not tell.
std::string program_path();

}  // namespace cli
