// SPDX-License-Identifier: BSD-3-Clause
// Generated cells: the bodies have the right measure, opposite borders have the same nodes, the library accepts the
// cells, and interfaces enclose every fibre or yarn completely.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "delam/delam.h"
#include "mesh/cell_shape.hpp"
#include "mesh/gmsh/generate_fibre_cell.hpp"
#include "mesh/gmsh/generate_weave.hpp"
#include "mesh/gmsh/generator_model.hpp"

namespace {

using cli::MeshData;
using std::numbers::pi;

int failures = 0;

void expect(bool condition, const std::string& what) {
    std::printf("%s %s\n", condition ? "ok   " : "FAIL ", what.c_str());
    if (!condition) ++failures;
}

double coordinate(const MeshData& mesh, std::int64_t node, std::size_t axis) {
    return mesh.nodes[static_cast<std::size_t>(node) * static_cast<std::size_t>(mesh.dimension) + axis];
}

std::vector<double> place(const MeshData& mesh, std::int64_t node) {
    std::vector<double> at;
    for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) at.push_back(coordinate(mesh, node, k));
    return at;
}

// Largest distance between x + period and the opposite node, each used once, in the order of their positions.
bool periodic(const MeshData& mesh, const char* lower, const char* upper, std::size_t which) {
    std::set<std::vector<double>> moved;
    std::set<std::vector<double>> opposite;
    for (const std::int64_t node : mesh.node_sets.at(lower)) {
        std::vector<double> at = place(mesh, node);
        for (std::size_t k = 0; k < at.size(); ++k) at[k] += mesh.periods[which][k];
        moved.insert(at);
    }
    for (const std::int64_t node : mesh.node_sets.at(upper)) opposite.insert(place(mesh, node));
    double far = moved.size() == opposite.size() ? 0.0 : 1e300;
    for (auto a = moved.begin(), b = opposite.begin(); far < 1 && a != moved.end(); ++a, ++b)
        for (std::size_t k = 0; k < a->size(); ++k) far = std::max(far, std::abs((*a)[k] - (*b)[k]));
    // All nodes of the border are in the set.
    std::size_t on_border = 0;
    const std::size_t axis = mesh.periods[which][0] != 0 ? 0 : mesh.periods[which][1] != 0 ? 1 : 2;
    const auto count = static_cast<std::int64_t>(mesh.nodes.size() / static_cast<std::size_t>(mesh.dimension));
    for (std::int64_t n = 0; n < count; ++n)
        if (coordinate(mesh, n, axis) == 0.0) ++on_border;
    return far <= 1e-9 * mesh.periods[which][axis] && on_border == moved.size();
}

// Sides shared by two bodies, by the labels of the bodies; node lists, ascending.
std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::vector<std::int64_t>>> interfaces(
    const MeshData& mesh) {
    std::map<std::vector<std::int64_t>, std::int32_t> seen;
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::vector<std::int64_t>>> shared;
    for (const cli::CellBlock& block : mesh.blocks) {
        const cli::CellShape& shape = cli::shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            for (const auto& side : shape.sides) {
                std::vector<std::int64_t> nodes;
                for (const std::size_t i : side) nodes.push_back(block.connectivity[c * shape.nodes + i]);
                std::sort(nodes.begin(), nodes.end());
                const auto [at, added] = seen.emplace(nodes, block.bodies[c]);
                if (!added && at->second != block.bodies[c])
                    shared[std::minmax(at->second, block.bodies[c])].push_back(nodes);
            }
    }
    return shared;
}

// Passes the mesh to the library: nodes are doubled, and each fibre or yarn has one interface, with the matrix.
void hand_over(const MeshData& mesh, const std::string& what) {
    delam_context* context = nullptr;
    delam_mesh* handle = nullptr;
    delam_context_create(&context);
    std::int32_t status =
        delam_mesh_create(context, mesh.dimension,
                          static_cast<std::int64_t>(mesh.nodes.size() / static_cast<std::size_t>(mesh.dimension)),
                          mesh.nodes.data(), &handle);
    for (const cli::CellBlock& block : mesh.blocks)
        if (status == DELAM_OK)
            status = delam_mesh_add_conforming_cells(handle, block.type, static_cast<std::int64_t>(block.bodies.size()),
                                                     block.connectivity.data(), block.bodies.data(), 0);
    expect(status == DELAM_OK, what + ": the library takes all cells " + delam_context_message(context));
    std::int64_t count = 0;
    if (status == DELAM_OK) status = delam_mesh_add_all_interfaces(handle, 0.0, &count);
    expect(status == DELAM_OK && count == static_cast<std::int64_t>(mesh.body_names.size()) - 1,
           what + ": an interface of each with the matrix " + delam_context_message(context));
    delam_mesh_destroy(&handle);
    delam_context_destroy(&context);
}

// With opposite borders identified, two sides meet at every corner of an interface.
bool closed_circles(const MeshData& mesh) {
    const auto fold = [&](std::int64_t node) {
        std::vector<double> at = place(mesh, node);
        for (std::size_t k = 0; k < 2; ++k)
            if (at[k] == mesh.periods[k][k]) at[k] = 0.0;
        return at;
    };
    for (const auto& [bodies, list] : interfaces(mesh)) {
        std::map<std::vector<double>, int> ends;
        for (const auto& side : list) {
            // Corners are the two points that are furthest apart.
            std::vector<std::int64_t> corners(side.begin(), side.begin() + 2);
            double longest = -1;
            for (std::size_t i = 0; i < side.size(); ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    const double length = std::hypot(coordinate(mesh, side[i], 0) - coordinate(mesh, side[j], 0),
                                                     coordinate(mesh, side[i], 1) - coordinate(mesh, side[j], 1));
                    if (length > longest) corners = {side[i], side[j]};
                    longest = std::max(longest, length);
                }
            for (const std::int64_t corner : corners) ++ends[fold(corner)];
        }
        for (const auto& [at, count] : ends)
            if (count != 2) return false;
    }
    return true;
}

void fibre_cell(cli::FibreCell cell, const std::string& what) {
    const MeshData mesh = cli::generate_fibre_cell(cell);
    const std::vector<double> areas = cli::GeneratorModel::measures(mesh);
    const double area = mesh.periods[0][0] * mesh.periods[1][1];
    double all = 0;
    double smallest = 1e300;
    double largest = 0;
    std::int64_t fibres = 0;
    for (std::size_t b = 0; b < areas.size(); ++b) {
        all += areas[b];
        if (mesh.body_names[b] == "matrix") continue;
        ++fibres;
        smallest = std::min(smallest, areas[b]);
        largest = std::max(largest, areas[b]);
    }
    const double circle = pi * cell.radius * cell.radius;
    const bool quadratic = cell.cell == DELAM_TRI6 || cell.cell == DELAM_QUAD8;
    const double error = quadratic ? 3e-3 : 4e-2;  // where fibres nearly touch, sides stay straight
    std::printf("      %s: %zu nodes, fibres %.6f..%.6f of a circle\n", what.c_str(), mesh.nodes.size() / 2,
                smallest / circle, largest / circle);
    for (const std::string& note : mesh.notes) std::printf("      %s\n", note.c_str());
    const double expected = static_cast<double>(fibres) * circle / cell.fraction;
    expect(std::abs(all / area - 1) < 1e-9 && std::abs(area / expected - 1) < 1e-9, what + ": the cell has its area");
    expect(smallest > (1 - error) * circle && largest < (1 + 1e-3) * circle, what + ": each fibre has its area");
    expect(cell.arrangement != "random" || fibres == cell.fibres, what + ": as many fibres as asked for");
    expect(periodic(mesh, "left", "right", 0) && periodic(mesh, "bottom", "top", 1), what + ": borders are periodic");
    expect(mesh.node_sets.at("corners").size() == 4 && mesh.node_sets.at("origin").size() == 1 &&
               place(mesh, mesh.node_sets.at("origin")[0]) == std::vector<double>{0, 0},
           what + ": corners and origin");
    expect(closed_circles(mesh), what + ": interfaces are closed");
    hand_over(mesh, what);
}

// Distance of the nodes between fibre and matrix from the circle, in radii.
void on_circles(cli::FibreCell cell) {
    cell.arrangement = "square";
    const MeshData mesh = cli::generate_fibre_cell(cell);
    double far = 0;
    for (const auto& [bodies, list] : interfaces(mesh))
        for (const auto& side : list)
            for (const std::int64_t node : side)
                far = std::max(far, std::abs(std::hypot(coordinate(mesh, node, 0) - mesh.periods[0][0] / 2,
                                                        coordinate(mesh, node, 1) - mesh.periods[1][1] / 2) -
                                             cell.radius) /
                                        cell.radius);
    expect(far < 1e-8, "all nodes of the interface, middle ones too, are on the circle");
}

void weave(cli::WeaveCell cell, const std::string& what) {
    const MeshData mesh = cli::generate_weave(cell);
    const std::vector<double> volumes = cli::GeneratorModel::measures(mesh);
    double lowest = 1e300;
    double highest = -1e300;
    for (std::size_t n = 2; n < mesh.nodes.size(); n += 3) {
        lowest = std::min(lowest, mesh.nodes[n]);
        highest = std::max(highest, mesh.nodes[n]);
    }
    double all = 0;
    for (const double v : volumes) all += v;
    const double box = 4 * cell.spacing * cell.spacing * (highest - lowest);
    const double a = cell.width / 2;
    const double b = cell.thickness / 2;
    const double radius = (a * a + b * b) / (2 * b);
    const double section =
        cell.section == "lens" ? 2 * (radius * radius * std::asin(a / radius) - a * (radius - b)) : pi * a * b;
    const double yarn = section * 2 * cell.spacing;
    double error = 0;
    for (std::size_t i = 0; i < volumes.size(); ++i)
        if (mesh.body_names[i] != "matrix") error = std::max(error, std::abs(volumes[i] / yarn - 1));
    std::printf("      %s: %zu nodes, yarns off by %.2g\n", what.c_str(), mesh.nodes.size() / 3, error);
    for (const std::string& note : mesh.notes) std::printf("      %s\n", note.c_str());
    expect(mesh.body_names == std::vector<std::string>{"matrix", "warp-1", "warp-2", "weft-1", "weft-2"} &&
               std::abs(all / box - 1) < 1e-9,
           what + ": the block has its volume");
    // The tips of ellipses are sharper than the cells.
    expect(error < (cell.section == "lens" ? 5e-3 : 0.15), what + ": each yarn has its volume");
    bool borders = periodic(mesh, "left", "right", 0) && periodic(mesh, "front", "back", 1);
    if (cell.stacked) borders = borders && periodic(mesh, "bottom", "top", 2);
    expect(borders && mesh.periods.size() == (cell.stacked ? 3U : 2U), what + ": borders are periodic");
    expect(mesh.node_sets.at("corners").size() == 8 && mesh.node_sets.count("top") == 1 &&
               mesh.node_sets.count("bottom") == 1,
           what + ": sets of the borders");

    // Axis 1 is the tangent dz/ds = +-A pi/L cos(pi s/L) at the centroid.
    const double amplitude = cli::weave_amplitude(cell);
    const double steepest = amplitude * pi / cell.spacing;
    double off = 0;
    std::size_t index = 0;
    for (const cli::CellBlock& block : mesh.blocks) {
        const cli::CellShape& shape = cli::shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c, ++index) {
            const auto& axes = mesh.orientation.at(index);
            const std::string& name = mesh.body_names[static_cast<std::size_t>(block.bodies[c])];
            if (name == "matrix") continue;
            const std::size_t run = name.rfind("warp", 0) == 0 ? 0 : 1;
            double along = 0;
            for (std::size_t i = 0; i < 4; ++i)
                along += coordinate(mesh, block.connectivity[c * shape.nodes + i], run) / 4;
            const double sign = name == "warp-1" || name == "weft-2" ? 1.0 : -1.0;
            off = std::max(off, std::abs(axes[2] / axes[run] - sign * steepest * std::cos(pi * along / cell.spacing)));
            off = std::max(off, std::abs(axes[0] * axes[3] + axes[1] * axes[4] + axes[2] * axes[5]));
            off = std::max(off, std::abs(std::hypot(axes[0], axes[1], axes[2]) - 1));
        }
    }
    expect(index == mesh.orientation.size() && off < 1e-9, what + ": yarn axes follow the centre lines");

    // Every body except the matrix touches only the matrix.
    const auto shared = interfaces(mesh);
    expect(shared.size() == 4, what + ": yarns do not touch each other");
    hand_over(mesh, what);
}

// Stored energy of the periodic cell under the average strain exx = 1, 2 W/V: the modulus C11. -1: failed.
double modulus(const MeshData& mesh, double matrix, double inclusion) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto count = static_cast<std::int64_t>(mesh.nodes.size() / d);
    const auto periods = static_cast<std::int64_t>(mesh.periods.size());
    std::vector<double> nodes = mesh.nodes;
    double height = 0;  // for a weave that is not stacked
    for (std::size_t i = d - 1; i < mesh.nodes.size(); i += d) height = std::max(height, 2 * mesh.nodes[i]);
    double volume = mesh.periods.size() < d ? height : 1.0;
    std::vector<double> flat;
    std::vector<std::int64_t> control;
    for (std::size_t k = 0; k < mesh.periods.size(); ++k) {
        volume *= mesh.periods[k][k];
        flat.insert(flat.end(), mesh.periods[k].begin(), mesh.periods[k].end());
        control.push_back(count + static_cast<std::int64_t>(k));
        nodes.insert(nodes.end(), d, -static_cast<double>(k + 1) * mesh.periods[0][0]);
    }
    delam_context* context = nullptr;
    delam_mesh* made = nullptr;
    delam_problem* problem = nullptr;
    delam_solver* solver = nullptr;
    delam_context_create(&context);
    bool fine = true;
    const auto run = [&](std::int32_t status) {
        if (fine && status != DELAM_OK) std::printf("      %s\n", delam_context_message(context));
        fine = fine && status == DELAM_OK;
        return fine;
    };
    run(delam_mesh_create(context, mesh.dimension, count + periods, nodes.data(), &made));
    for (const cli::CellBlock& block : mesh.blocks)
        run(delam_mesh_add_conforming_cells(made, block.type, static_cast<std::int64_t>(block.bodies.size()),
                                            block.connectivity.data(), block.bodies.data(), 0));
    std::int64_t interface_count = 0;
    run(delam_mesh_add_all_interfaces(made, 0.0, &interface_count));
    run(delam_problem_create(context, made, &problem));
    for (std::size_t b = 0; b < mesh.body_names.size(); ++b)
        run(delam_problem_set_elastic(problem, static_cast<std::int32_t>(b), b == 0 ? matrix : inclusion, 0.3));
    for (std::int64_t i = 0; i < interface_count; ++i) run(delam_problem_set_bonded(problem, i));
    run(delam_problem_add_periodic(problem, periods, flat.data(), control.data(), 0.0, 0));
    constexpr double instants[] = {0, 1};
    std::int64_t pattern = 0;
    run(delam_problem_add_pattern(problem, "strain", 2, instants, instants, &pattern));
    for (std::size_t i = 0; i < d; ++i) {
        std::vector<double> direction(d, 0.0);
        direction[i] = 1;
        for (std::size_t k = 0; k < control.size(); ++k) {
            const double stretch = i == 0 ? mesh.periods[k][0] : 0.0;
            run(delam_problem_prescribe_nodes(problem, 1, &control[k], direction.data(), 1, &pattern, &stretch, 0));
        }
        run(delam_problem_prescribe_nodes(problem, 1, &mesh.node_sets.at("origin")[0], direction.data(), 0, nullptr,
                                          nullptr, 0));
    }
    run(delam_solver_create(problem, 0.0, &solver));
    if (fine) run(delam_solver_advance(solver, 1.0));
    double energy = 0;
    if (fine) run(delam_solver_value(solver, "stored_bulk", &energy));
    delam_solver_destroy(&solver);
    delam_problem_destroy(&problem);
    delam_mesh_destroy(&made);
    delam_context_destroy(&context);
    return fine ? 2 * energy / volume : -1;
}

// C11/E at nu = 0.3: without other strains, and without stress across the fabric.
constexpr double uniaxial_strain = 0.7 / (1.3 * 0.4);
constexpr double free_surfaces = 1 / (1 - 0.3 * 0.3);

// A cell of one material strains uniformly, whatever its mesh; with stiff inclusions the modulus lies between the
// bounds of Reuss and Voigt.
void homogenised(const MeshData& mesh, double exact_factor, const std::string& what) {
    constexpr double matrix = 3;
    constexpr double stiff = 70;
    const double uniform = modulus(mesh, matrix, matrix);
    expect(std::abs(uniform / (exact_factor * matrix) - 1) < 1e-9, what + ": one material is uniform");
    const double stiffened = modulus(mesh, matrix, stiff);
    const std::vector<double> volumes = cli::GeneratorModel::measures(mesh);
    double all = 0;
    for (const double v : volumes) all += v;
    const double f = 1 - volumes[0] / all;
    expect(stiffened > exact_factor / ((1 - f) / matrix + f / stiff) &&
               stiffened < uniaxial_strain * ((1 - f) * matrix + f * stiff),
           what + ": stiff inclusions lie between the bounds");
}

void refused(const std::string& text, const std::function<void()>& call) {
    try {
        call();
        expect(false, "refused: " + text);
    } catch (const cli::Failure& failure) {
        expect(std::string(failure.what()).find(text) != std::string::npos, failure.what());
    }
}

void refusals() {
    const cli::Place place{"scene.toml", "mesh", 7};
    cli::FibreCell fibres;
    fibres.cell = DELAM_TRI6;
    fibres.place = place;
    const auto fibre = [&](const std::function<void(cli::FibreCell&)>& change) {
        return [fibres, change] {
            cli::FibreCell cell = fibres;
            change(cell);
            cli::generate_fibre_cell(cell);
        };
    };
    refused("scene.toml:7: mesh.radius: must be > 0", fibre([](auto& c) { c.radius = -1; }));
    refused("mesh.h: must be in", fibre([](auto& c) { c.h = 3; }));
    refused("mesh.cells_around: must be in 8..1000", fibre([](auto& c) { c.cells_around = 4; }));
    refused("mesh.arrangement: must be random, square or hexagonal", fibre([](auto& c) { c.arrangement = "lattice"; }));
    refused("mesh: fraction = 0.9: must be in (0,", fibre([](auto& c) { c.fraction = 0.9; }));
    refused("mesh.cell: must be one of tri3, quad4, tri6, quad8", fibre([](auto& c) { c.cell = DELAM_TET4; }));
    cli::WeaveCell weaves;
    weaves.cell = DELAM_TET10;
    weaves.place = place;
    const auto yarns = [&](const std::function<void(cli::WeaveCell&)>& change) {
        return [weaves, change] {
            cli::WeaveCell cell = weaves;
            change(cell);
            cli::generate_weave(cell);
        };
    };
    refused("mesh.width: must be in (0, 0.95]", yarns([](auto& c) { c.width = 1.2; }));
    refused("mesh.gap: must be > 0", yarns([](auto& c) { c.gap = 0; }));
    refused("mesh.height: must be in", yarns([](auto& c) { c.height = 0.2; }));
    refused("mesh.section: must be ellipse or lens", yarns([](auto& c) { c.section = "square"; }));
    refused("mesh.h: must be in", yarns([](auto& c) { c.h = 1; }));
    refused("mesh.cell: must be one of tet4, tet10", yarns([](auto& c) { c.cell = DELAM_HEX8; }));
}

}  // namespace

// With an argument (the long tier) each shape of a weave with each cell; OpenCASCADE takes seconds for one.
int main(int argc, char**) {
    const bool whole = argc > 1;
    cli::FibreCell fibres;
    fibres.cell = DELAM_TRI6;
    fibres.radius = 3.5e-6;
    fibres.arrangement = "square";
    fibre_cell(fibres, "one fibre in the middle");
    on_circles(fibres);
    fibres.cell = DELAM_TRI3;
    fibres.arrangement = "hexagonal";
    fibres.fraction = 0.6;
    fibre_cell(fibres, "hexagonal, tri3");
    fibres.arrangement = "random";
    fibres.fraction = 0.3;
    fibres.cell = DELAM_TRI6;
    fibre_cell(fibres, "one fibre anywhere");
    fibres.fraction = 0.55;
    fibres.fibres = 12;
    fibres.cells_around = 20;
    for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3}}) {
        fibres.seed = seed;
        fibre_cell(fibres, "12 fibres, seed " + std::to_string(seed));
    }
    homogenised(cli::generate_fibre_cell(fibres), uniaxial_strain, "12 fibres");
    fibres.cell = DELAM_QUAD4;
    fibre_cell(fibres, "12 fibres, quad4");
    fibres.cell = DELAM_QUAD8;
    fibre_cell(fibres, "12 fibres, quad8");
    fibres.fibres = 30;
    fibres.fraction = 0.65;
    fibres.gap = 0.06;
    fibres.cell = DELAM_TRI6;
    fibre_cell(fibres, "30 fibres at 0.65");

    cli::WeaveCell cell;
    cell.cell = DELAM_TET10;
    cell.spacing = 2e-3;
    cell.width = 1.6e-3;
    cell.thickness = 0.4e-3;
    cell.gap = 0.04e-3;
    cell.h = 0.44e-3;
    cell.section = "ellipse";
    if (whole) weave(cell, "ellipses, tet10");
    cell.stacked = true;
    weave(cell, "ellipses, stacked");
    cell.stacked = false;
    cell.cell = DELAM_TET4;
    if (whole) weave(cell, "ellipses, tet4");
    cell.section = "lens";
    cell.cell = DELAM_TET10;
    weave(cell, "lenses, tet10");
    // Coarse: both statements hold for every mesh. Each cell type and each number of periods once.
    cell.h = 0.9e-3;
    cell.gap = 0.1e-3;
    if (whole) homogenised(cli::generate_weave(cell), free_surfaces, "weave");
    cell.stacked = true;
    cell.cell = DELAM_TET4;
    homogenised(cli::generate_weave(cell), uniaxial_strain, "stacked weave");
    refusals();
    return failures == 0 ? 0 : 1;
}
