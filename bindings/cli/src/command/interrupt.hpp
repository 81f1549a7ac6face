// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C and SIGTERM cancel the running call; a second signal ends the program at once.
#pragma once

#include "delam/delam.h"

namespace cli {

class Interrupt {
public:
    // Also ignores SIGPIPE and SIGXFSZ, so that a closed pipe or a file-size limit gives an error code instead of
    // killing the program.
    explicit Interrupt(delam_context* context);
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    [[nodiscard]] static bool requested();
};

}  // namespace cli
