// SPDX-License-Identifier: BSD-3-Clause
// Complete small scenes, from creating the context to destroying it, with each call passed to a host: mesh, law,
// problem, analysis with rolled back steps, fields, fronts, tangent, saving and loading.
#pragma once

#include <string>
#include <vector>

#include "host.hpp"

namespace faults {

// A strip of two layers, 70 mm long, unbonded over the first 30 mm, peeled off from that end.
struct Strip {
    std::string name;
    int dimension = 2;
    std::int64_t cells = 14;               // along
    std::string mesh = "layers";           // layers | conforming | projected
    std::string law = "piecewise-linear";  // host: callbacks
    bool brittle = false;
    bool strained = false;                                   // a dead force, an eigenstrain and gaps beside the peel
    std::vector<std::pair<std::string, std::string>> texts;  // options
    std::vector<std::pair<std::string, double>> numbers;
    int steps = 4;
    bool given = false;  // the stiffness of the upper body is passed as CSR
    bool condensed() const;
};

const std::vector<Strip>& strips();
void analyse(Host& host, const Strip& strip);

}  // namespace faults
