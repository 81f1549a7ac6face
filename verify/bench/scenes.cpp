// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace bench {
namespace {

using Point = std::vector<double>;

// Numbers of cell types that an older header may not have.
constexpr std::int32_t tri6 = 5;
constexpr std::int32_t quad8 = 6;
constexpr std::int32_t quad9 = 7;

std::int64_t cells(double length, double h) { return std::max<std::int64_t>(1, std::llround(length / h)); }

// An older library may not have the function: its cells are standard.
std::int32_t set_formulation(delam_problem* problem, const char* formulation) {
    using Setter = std::int32_t (*)(delam_problem*, std::int32_t, const char*);
    const auto setter = reinterpret_cast<Setter>(dlsym(RTLD_DEFAULT, "delam_problem_set_formulation"));
    if (setter == nullptr) return formulation == std::string("standard") ? DELAM_OK : DELAM_ERROR_ARGUMENT;
    return setter(problem, -1, formulation);
}

// Direction along an axis.
Point along(int dimension, int axis, double sign = 1.0) {
    Point v(static_cast<std::size_t>(dimension), 0.0);
    v[static_cast<std::size_t>(axis)] = sign;
    return v;
}

// Supports and load are at x over the whole width, on the lower (upper) face of body 0 (1).
struct Place {
    std::int32_t body;
    Point lower, upper;
};

Place place(const SceneData& data, double x, bool top) {
    const double half = 0.5 * data.patch;
    // A patch at an end lies within the body.
    const double centre = std::clamp(x, half, data.length - half);
    Point lower{centre - half};
    Point upper{centre + half};
    if (data.dimension == 3) {
        lower.push_back(0.0);
        upper.push_back(data.width);
    }
    const double level = top ? 2.0 * data.arm : 0.0;
    lower.push_back(level);
    upper.push_back(level);
    return {top ? 1 : 0, lower, upper};
}

// Prescribes direction . u at a place: node by node, or as one mean over the patch. pattern -1: fixed at zero.
void prescribe(Stage& stage, const Place& where, const Point& direction, std::int64_t pattern) {
    reference::Scene& scene = stage.scene;
    const SceneData& data = stage.data;
    if (data.patch == 0.0) {
        const auto nodes = scene.find(where.body, where.lower, where.upper);
        if (pattern < 0) {
            scene.hold(nodes, direction);
        } else {
            scene.drive(nodes, direction, pattern, std::vector<double>(nodes.size(), 1.0));
        }
        return;
    }
    const Point outward = along(data.dimension, data.dimension - 1, where.body == 0 ? -1.0 : 1.0);
    std::vector<std::int64_t> nodes(scene.node_count());
    std::vector<double> weights(nodes.size());
    std::int64_t count = 0;
    REQUIRE(scene, delam_mesh_find_patch, scene.mesh(), where.body, where.lower.data(), where.upper.data(),
            outward.data(), static_cast<std::int64_t>(nodes.size()), nodes.data(), weights.data(), &count);
    const double one = 1.0;
    REQUIRE(scene, delam_problem_prescribe_mean, scene.problem(), count, nodes.data(), weights.data(), direction.data(),
            pattern < 0 ? 0 : 1, pattern < 0 ? nullptr : &pattern, pattern < 0 ? nullptr : &one, 0);
}

reference::Scene layers(const SceneData& data) {
    const std::int32_t type = data.element != nullptr ? data.element->cell_type
                              : data.dimension == 2   ? DELAM_QUAD4
                                                      : DELAM_HEX8;
    Point lengths{data.length};
    std::vector<std::int64_t> divisions{cells(data.length, data.h)};
    if (data.dimension == 3) {
        lengths.push_back(data.width);
        divisions.push_back(cells(data.width, data.h));
    }
    const std::int64_t through = cells(data.arm, data.h);
    reference::Scene scene(data.dimension, lengths, divisions, {data.arm, data.arm}, {through, through}, type);
    scene.interface(0, 1);
    return scene;
}

}  // namespace

const std::vector<Element>& elements() {
    static const std::vector<Element> list = {{"quad4", 2, DELAM_QUAD4, "standard", 1},
                                              {"quad4-incompatible", 2, DELAM_QUAD4, "incompatible", 1},
                                              {"tri6", 2, tri6, "standard", 2},
                                              {"quad8", 2, quad8, "standard", 2},
                                              {"quad9", 2, quad9, "standard", 2}};
    return list;
}

const Element* find_element(const std::string& name) {
    for (const Element& e : elements()) {
        if (name == e.name) return &e;
    }
    return nullptr;
}

SceneData find_scene(const std::string& name) {
    SceneData data;
    data.name = name;
    const auto dash = name.rfind('-');
    const std::string family = name.substr(0, dash);
    data.h = dash == std::string::npos ? 0.0 : 1e-3 * std::strtod(name.c_str() + dash + 1, nullptr);
    if (!(data.h > 0.0 && data.h <= 3e-3))
        throw reference::Failure(0, "scene '" + name + "': the edge in mm is missing");
    if (family == "enf-ductile") return data;
    if (family == "enf-patch") {
        data.patch = 2e-3;
        return data;
    }
    if (family == "enf-brittle") {
        data.brittle = true;
        data.law = {125e15, 125e15, 0.01, 0.01, 25.0, 25.0};
        return data;
    }
    if (family == "block") {
        // A short, wide specimen: the interface is a surface, so it has the fraction of the unknowns typical of 3D.
        data.dimension = 3;
        data.length = 0.040;
        data.width = 0.010;
        data.arm = 2e-3;
        data.notch = 0.010;
        data.final_load = 1.5e-3;
        data.steps = 10;
        return data;
    }
    throw reference::Failure(0, "scene '" + name +
                                    "' is not known: enf-ductile-H, enf-brittle-H, enf-patch-H, block-H, "
                                    "H in mm");
}

Stage make_mesh(const SceneData& data) {
    Stage stage{data, layers(data), {}};
    // The tip itself is bonded; the margin is a quarter of the smallest distance of two pairs.
    const double spacing = data.h / (data.element != nullptr ? data.element->order : 1);
    for (const auto node : stage.scene.pairs(0).node_a) {
        stage.adhesion.push_back(stage.scene.coordinate(node, 0) < data.notch - 0.25 * spacing ? 0.0 : 1.0);
    }
    return stage;
}

bool declare(Stage& stage, const Choice& choice, std::string* refusal) {
    reference::Scene& scene = stage.scene;
    const SceneData& data = stage.data;
    const int up = data.dimension - 1;
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    scene.law(0, data.law);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < stage.adhesion.size(); ++i) {
        if (stage.adhesion[i] == 0.0) notch.push_back(static_cast<std::int64_t>(i));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));

    const Place left = place(data, 0.0, false);
    const Place right = place(data, data.length, false);
    prescribe(stage, left, along(data.dimension, up), -1);
    prescribe(stage, right, along(data.dimension, 0), -1);
    prescribe(stage, right, along(data.dimension, up), -1);
    if (data.dimension == 3) {
        // One corner of each support is held in the direction of the width, against drift and rotation about the
        // vertical.
        for (const Place& support : {left, right}) {
            Point corner = support.lower;
            scene.hold(scene.find(0, corner, corner), along(3, 1));
        }
    }
    const auto press = scene.pattern("press", {0.0, end_time}, {0.0, data.final_load});
    prescribe(stage, place(data, 0.5 * data.length, true), along(data.dimension, up, -1.0), press);

    const auto accepted = [&](std::int32_t status, const char* what) {
        if (status == DELAM_OK) return true;
        if (refusal != nullptr) *refusal = std::string(what) + ": " + delam_context_message(scene.context());
        return false;
    };
    const char* formulation = data.element != nullptr ? data.element->formulation : "standard";
    if (!accepted(set_formulation(scene.problem(), formulation), "formulation")) return false;
    const std::pair<const char*, const char*> texts[] = {{"reduction", choice.reduction},
                                                         {"minimisation", choice.minimisation},
                                                         {"solution", choice.solution},
                                                         {"backtracking", choice.backtracking}};
    for (const auto& [key, word] : texts) {
        if (word != nullptr && !accepted(delam_problem_set_text(scene.problem(), key, word), key)) return false;
    }
    // The baseline's rule; the oldest versions have no other and do not know the key.
    delam_problem_set_text(scene.problem(), "mixity_rule", "frozen");
    scene.number("damage_tolerance", choice.delta);
    scene.number("minimisation_limit", 100000.0);
    return true;
}

}  // namespace bench
