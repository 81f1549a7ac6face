// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C and SIGTERM: the running call is asked to stop; a second one ends the program at once.
#pragma once

#include "delam/delam.h"

namespace cli {

class Interrupt {
public:
    // Also ignores SIGPIPE and SIGXFSZ, so that a closed pipe or a file-size limit is an error code and not the end.
    explicit Interrupt(delam_context* context);
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    [[nodiscard]] static bool requested();
};

}  // namespace cli
