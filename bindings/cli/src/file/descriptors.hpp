// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cli {

// Opens /dev/null where one of the descriptors 0, 1 and 2 is closed: else the next file that is opened gets its number,
// and what is meant for people goes into it. Ends the process if there is no /dev/null.
void open_standard_descriptors();

}  // namespace cli
