// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"
namespace bench {
Json precision_table(const Settings&) { return {}; }
}  // namespace bench
