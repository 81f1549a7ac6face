// SPDX-License-Identifier: BSD-3-Clause
// [[controls]], [[equations]], [[couplings]], [[obstacles]] and [cell]: constraints between displacements.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "scene/scene_parts.hpp"

namespace cli {

namespace {

// Returns a position for control nodes about which nothing rotates: it does not affect the solution, and must not
// enlarge pictures.
std::vector<double> lower_corner(const Scene& scene) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    std::vector<double> corner(dimension, 0.0);
    if (!scene.mesh) return corner;
    std::copy_n(scene.mesh->nodes.begin(), dimension, corner.begin());
    for (std::size_t i = 0; i < scene.mesh->nodes.size(); ++i)
        corner[i % dimension] = std::min(corner[i % dimension], scene.mesh->nodes[i]);
    return corner;
}

std::vector<std::vector<double>> read_periods(const Table& table, const Scene& scene) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    if (!table.has("periods")) {
        if (!scene.mesh || scene.mesh->periods.empty())
            table.fail("periods", "is needed: [[x, y], ..], one vector for each direction in which the cell repeats");
        return scene.mesh->periods;
    }
    auto periods = table.points("periods", dimension);
    if (periods.empty() || periods.size() > dimension)
        table.fail("periods", fmt::format("has {} vectors: 1 to {} are expected", periods.size(), dimension));
    return periods;
}

EquationTerm read_left(const Table& table, const Scene& scene) {
    const Places places{"point", "patch", "set", "control"};
    EquationTerm term;
    term.where = read_selection(table, scene, places);
    const auto directions = read_directions(table, "component", scene.geometry);
    if (directions.size() != 1)
        table.fail("component", fmt::format("has {} entries: 1 is expected", directions.size()));
    term.direction = directions.front();
    // Directions have length 1, as everywhere in a scene.
    double square = 0;
    for (const double d : term.direction) square += d * d;
    for (double& d : term.direction) d /= std::sqrt(square);
    term.coefficient = table.number("coefficient");
    return term;
}

// No pattern: fixed at zero.
std::vector<Term> read_right(const Table& table, const Scene& scene) {
    if (table.has("pattern") || table.has("terms") || table.has("coefficient")) return read_terms(table, scene);
    return {};
}

std::size_t control_of(const Table& table, const Scene& scene, const std::string& key = "control") {
    return find_named(table, key, table.text(key), scene.controls, "control node");
}

CellComponent read_component(const Table& table, const Scene& scene, bool stress) {
    constexpr std::array names{"xx", "yy", "zz", "xy", "yz", "zx"};
    constexpr std::array<std::array<std::size_t, 2>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    const std::string name = table.text("component");
    const auto found = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    if (found == names.size() || std::max(axes[found][0], axes[found][1]) >= dimension)
        table.fail("component", fmt::format("\"{}\": {} is expected", name,
                                            dimension == 2 ? "xx, yy or xy" : "xx, yy, zz, xy, yz or zx"));
    CellComponent out;
    out.i = axes[found][0];
    out.j = axes[found][1];
    out.stress = stress;
    out.terms = read_right(table, scene);
    out.place = table.place();
    return out;
}

// Axes along which the periods lie. There must be as many as periods, because otherwise the cell has no cross section.
std::vector<std::size_t> axes_of(const Table& table, const std::vector<std::vector<double>>& periods) {
    std::vector<std::size_t> axes;
    for (std::size_t a = 0; a < periods.front().size(); ++a)
        if (std::any_of(periods.begin(), periods.end(),
                        [a](const auto& p) { return std::fpclassify(p[a]) != FP_ZERO; }))
            axes.push_back(a);
    if (axes.size() != periods.size())
        table.fail("periods", fmt::format("{} vectors have components along {} axes: as many are expected "
                                          "(turn the mesh so that the periods lie along axes, or in a plane of them)",
                                          periods.size(), axes.size()));
    return axes;
}

CellData read_cell(const Table& table, const Scene& scene) {
    CellData cell;
    cell.place = table.place();
    cell.periods = read_periods(table, scene);
    cell.axes = axes_of(table, cell.periods);
    // read_controls puts these after all others.
    const auto own = scene.controls.size() - cell.periods.size();
    for (std::size_t k = 0; k < cell.periods.size(); ++k) cell.controls.push_back(own + k);
    cell.tolerance = table.number("tolerance", 0.0);
    for (const bool stress : {false, true})
        for (const Table& entry : table.tables(stress ? "stress" : "strain")) {
            CellComponent component = read_component(entry, scene, stress);
            for (const std::size_t axis : {component.i, component.j})
                if (std::find(cell.axes.begin(), cell.axes.end(), axis) == cell.axes.end())
                    entry.fail("component", fmt::format("\"{}\": the cell has no period along {}, it is free there",
                                                        entry.text("component"), "xyz"[axis]));
            for (const CellComponent& other : cell.components)
                if (other.i == component.i && other.j == component.j)
                    entry.fail("component", fmt::format("\"{}\" is given twice: a strain or a stress, not both",
                                                        entry.text("component")));
            cell.components.push_back(std::move(component));
        }
    return cell;
}

}  // namespace

void read_controls(const Table& root, Scene& scene) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    const std::vector<double> corner = lower_corner(scene);
    for (const Table& table : root.tables("controls")) {
        ControlData control;
        control.name = new_name(table, scene.controls, "control node");
        control.placed = table.has("at");
        control.at = control.placed ? table.numbers("at", dimension) : corner;
        control.place = table.place();
        scene.controls.push_back(std::move(control));
    }
    if (!root.has("cell")) return;
    const Table table = root.table("cell");
    for (std::size_t k = 0; k < read_periods(table, scene).size(); ++k) {
        ControlData control;
        control.name = fmt::format("period-{}", k + 1);
        for (const ControlData& other : scene.controls)
            if (other.name == control.name)
                table.fail("periods", fmt::format("have control nodes of their own: call yours otherwise than \"{}\"",
                                                  control.name));
        control.at = corner;
        control.place = table.place();
        scene.controls.push_back(std::move(control));
    }
}

void read_constraints(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("equations")) {
        EquationData equation;
        for (const Table& term : table.tables("left")) equation.left.push_back(read_left(term, scene));
        if (equation.left.empty())
            table.fail("left", "is needed: [{ point = [..], component = [\"y\"], coefficient = 1.0 }, ..]");
        equation.right = read_right(table, scene);
        if (table.has("name")) equation.name = table.text("name");
        equation.place = table.place();
        scene.equations.push_back(std::move(equation));
    }
    for (const Table& table : root.tables("couplings")) {
        const Places places{"point", "box", "set", "body"};
        CouplingData coupling;
        coupling.control = control_of(table, scene);
        if (table.has("rotation")) {
            coupling.rotation = control_of(table, scene, "rotation");
            if (*coupling.rotation == coupling.control)
                table.fail("rotation", "is the control node that is translated: another one is expected");
            const ControlData& centre = scene.controls[coupling.control];
            if (!centre.placed)
                table.fail("rotation",
                           fmt::format("is about the control node \"{}\": give its coordinates, `at`", centre.name));
        }
        coupling.where = read_selection(table, scene, places);
        coupling.directions = read_directions(table, "component", scene.geometry);
        coupling.place = table.place();
        scene.couplings.push_back(std::move(coupling));
    }
    for (const Table& table : root.tables("obstacles")) {
        const Places places{"patch", "set"};
        ObstacleData obstacle;
        obstacle.control = control_of(table, scene);
        obstacle.where = read_selection(table, scene, places);
        obstacle.name = table.text("name", fmt::format("obstacle-{}", scene.obstacles.size() + 1));
        obstacle.place = table.place();
        scene.obstacles.push_back(std::move(obstacle));
    }
    if (root.has("cell")) scene.cell = read_cell(root.table("cell"), scene);
}

}  // namespace cli
