// SPDX-License-Identifier: BSD-3-Clause
#include "flexure.hpp"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

// Prescribes direction . u on a part of a horizontal face of one arm: at a point, or as the mean over a patch within
// the arm. pattern -1: fixed at zero.
void prescribe(FlexureScene& s, std::int32_t arm, double x, double level, const std::vector<double>& direction,
               std::int64_t pattern) {
    const Flexure& data = s.data;
    Scene& scene = s.scene;
    const double half = 0.5 * data.patch;
    const double centre = std::clamp(x, half, data.length - half);
    const std::vector<double> lower{centre - half, level};
    const std::vector<double> upper{centre + half, level};
    if (data.patch == 0.0) {
        const auto nodes = scene.find(arm, lower, upper);
        if (nodes.empty()) throw Failure(0, "flexure: no node at x = " + std::to_string(x));
        if (pattern < 0)
            scene.hold(nodes, direction);
        else
            scene.drive(nodes, direction, pattern, std::vector<double>(nodes.size(), 1.0));
        return;
    }
    const std::vector<double> outward{0.0, level > (arm == 0 ? 0.5 : 1.5) * data.arm ? 1.0 : -1.0};
    std::vector<std::int64_t> nodes(scene.node_count());
    std::vector<double> weights(nodes.size());
    std::int64_t count = 0;
    REQUIRE(scene, delam_mesh_find_patch, scene.mesh(), arm, lower.data(), upper.data(), outward.data(),
            static_cast<std::int64_t>(nodes.size()), nodes.data(), weights.data(), &count);
    const double one = 1.0;
    REQUIRE(scene, delam_problem_prescribe_mean, scene.problem(), count, nodes.data(), weights.data(), direction.data(),
            pattern < 0 ? 0 : 1, pattern < 0 ? nullptr : &pattern, pattern < 0 ? nullptr : &one, 0);
}

}  // namespace

Flexure find_flexure(const std::string& name) {
    Flexure data;
    const std::string family = name.substr(0, 3);
    const std::string law = name.size() > 4 ? name.substr(4) : "";
    if ((family != "enf" && family != "mmf") || (law != "ductile" && law != "brittle"))
        throw Failure(0, "specimen '" + name + "' is not known: enf-ductile, enf-brittle, mmf-ductile, mmf-brittle");
    data.mixed = family == "mmf";
    data.law = law == "brittle" ? brittle_law : ductile_law;
    return data;
}

FlexureScene make_flexure(const Flexure& data) {
    const bool quadratic = data.element == "quad8";
    const bool incompatible = data.element == "quad4-incompatible";
    if (!quadratic && !incompatible && data.element != "quad4")
        throw Failure(0, "element '" + data.element + "' is not known: quad4, quad4-incompatible, quad8");
    const auto along = static_cast<std::int64_t>(std::llround(data.length / data.h));
    const auto through = std::max<std::int64_t>(1, std::llround(data.arm / data.h));
    FlexureScene s{data,
                   Scene(2, {data.length}, {along}, {data.arm, data.arm}, {through, through},
                         quadratic ? DELAM_QUAD8 : DELAM_QUAD4),
                   {},
                   {},
                   {}};
    Scene& scene = s.scene;
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, incompatible ? "incompatible" : "standard");
    scene.law(0, data.law);

    const Pairs pairs = scene.pairs(0);
    s.weight = pairs.weight;
    const double margin = 0.25 * data.h / (quadratic ? 2.0 : 1.0);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < pairs.count(); ++i) {
        s.position.push_back(scene.coordinate(pairs.node_a[i], 0));
        const bool open = s.position.back() < data.notch - margin;
        s.adhesion.push_back(open ? 0.0 : 1.0);
        if (open) notch.push_back(static_cast<std::int64_t>(i));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));

    const auto press = scene.pattern("press", {0.0, data.end_time}, {0.0, data.final_load});
    prescribe(s, data.mixed ? 1 : 0, 0.0, data.mixed ? data.arm : 0.0, {0.0, 1.0}, -1);
    prescribe(s, 0, data.length, 0.0, {1.0, 0.0}, -1);
    prescribe(s, 0, data.length, 0.0, {0.0, 1.0}, -1);
    prescribe(s, 1, 0.5 * data.length, 2.0 * data.arm, {0.0, -1.0}, press);
    return s;
}

}  // namespace reference
