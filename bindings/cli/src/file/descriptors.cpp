// SPDX-License-Identifier: BSD-3-Clause
#include "file/descriptors.hpp"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

#include "text/error.hpp"

namespace cli {

void open_standard_descriptors() {
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
        // The lowest number that is free is this one, as those below are open.
        if (::fcntl(number, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) != number)
            ::_exit(exit_output);
}

}  // namespace cli
