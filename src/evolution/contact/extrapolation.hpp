// SPDX-License-Identifier: BSD-3-Clause
// Over-relaxation of a fixed-point iteration z -> g(z), based on its last steps (Anderson, J. ACM 12, 1965; Walker and
// Ni, SIAM J. Numer. Anal. 49, 2011): the combination of the last iterates with the smallest residual g(z) - z, moved
// one step further.
#pragma once

#include <deque>
#include <span>
#include <vector>

namespace delam {

class Extrapolation {
public:
    // The next iterate from z and its image; the caller keeps it within its bounds.
    std::vector<double> next(std::span<const double> z, std::span<const double> image);
    void forget() { differences_.clear(), last_z_.clear(); }

private:
    struct Difference {
        std::vector<double> image, residual;
    };
    std::deque<Difference> differences_;
    std::vector<double> last_z_, last_image_;
};

}  // namespace delam
