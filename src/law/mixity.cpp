// SPDX-License-Identifier: BSD-3-Clause
#include "law/mixity.hpp"

#include <algorithm>

namespace delam {

double mode_mixity(double normal, double tangential) {
    if (!(tangential > 0.0)) return 0.0;
    return std::min(1.0, tangential / (normal + tangential));
}

double second_share(double tangential, double second) {
    return tangential > 0.0 ? std::min(1.0, second / tangential) : 0.0;
}

}  // namespace delam
