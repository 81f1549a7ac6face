// SPDX-License-Identifier: BSD-3-Clause
// Why the system refused something, with what helps.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

namespace cli {

inline constexpr const char* too_many_files = "too many open files: raise the limit with ulimit -n";

// code: an errno.
inline std::string reason_of(int code) {
    return code == EMFILE || code == ENFILE ? too_many_files : std::strerror(code);
}

}  // namespace cli
