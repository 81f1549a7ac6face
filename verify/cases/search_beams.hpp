// SPDX-License-Identifier: BSD-3-Clause
// Energetic beams with two fronts in one interface and in two, on squares of h, against all rivals. Pairs of fronts
// grow in number with 1/h^2.
#pragma once

#include "energetic_scenes.hpp"

namespace cases {

inline void expect_two_fronts(double h, bool symmetric) {
    Beam b;
    b.h = h;
    if (symmetric) b.right = b.left;
    reference::Scene scene = make_beam(b);
    const double middle = 0.5 * beam_length;
    const Rivals rivals(scene, {run(scene, 0, b.left - 0.25 * h, middle + 4 * h),
                                run(scene, 0, middle - 4 * h, beam_length - b.right + 0.25 * h, true)});
    set_energetic(scene);
    const auto dissipated = march_below(scene, rivals, 12);
    expect(dissipated.front() == 0.0 && dissipated.back() > 0.0, "a front moves");
}

inline void expect_two_interfaces(double h, bool symmetric) {
    Beam b;
    b.h = h;
    b.layers = 3;
    b.right = 0.0;
    b.left_above = symmetric ? b.left : 0.021;
    b.press = 6e-3;
    reference::Scene scene = make_beam(b);
    const Rivals rivals(scene,
                        {run(scene, 0, b.left - 0.25 * h, 0.066), run(scene, 1, b.left_above - 0.25 * h, 0.066)});
    set_energetic(scene);
    const auto dissipated = march_below(scene, rivals, 10);
    expect(dissipated.back() > 0.0, "a front moves");
}

}  // namespace cases
