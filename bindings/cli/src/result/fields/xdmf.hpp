// SPDX-License-Identifier: BSD-3-Clause
// The XDMF 3 description of fields.h5: a temporal collection; in every instant the bodies and each interface as grids.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct XdmfBlock {
    std::string name;
    std::int64_t points = 0;
    std::int64_t cells = 0;
    std::int64_t points_per_cell = 0;
    std::string topology;
    std::int64_t entries = 0;  // of the list of a mixed topology
};

struct XdmfStep {
    std::string group;  // below /steps
    double time = 0;
};

// blocks: the bodies first, then the interfaces in order. fields: names as in [output].
std::string xdmf_text(const std::vector<XdmfBlock>& blocks, const std::vector<XdmfStep>& steps,
                      const std::vector<std::string>& fields);

}  // namespace cli
