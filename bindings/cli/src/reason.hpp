// SPDX-License-Identifier: BSD-3-Clause
// Why the system refused something, with what helps.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace cli {

inline constexpr const char* too_many_files = "too many open files: raise the limit with ulimit -n";

// code: an errno.
inline std::string reason_of(int code) {
    return code == EMFILE || code == ENFILE ? too_many_files : std::strerror(code);
}

// For libraries that keep their reason to themselves: that no further file can be opened, or else `otherwise`.
inline std::string reason_or(const std::string& otherwise) {
    const int descriptor = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int code = errno;
    if (descriptor >= 0) ::close(descriptor);
    return descriptor < 0 && (code == EMFILE || code == ENFILE) ? too_many_files : otherwise;
}

}  // namespace cli
