// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/generate_fibre_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "mesh/gmsh/generator_model.hpp"
#include "mesh/gmsh/gmsh_session.hpp"
#include "mesh/gmsh/packing.hpp"
#include "mesh/gmsh/read_gmsh.hpp"
#include "mesh/periodic_mesh.hpp"
#include "mesh/quadratic_cells.hpp"

namespace cli {

namespace {

namespace occ = gmsh::model::occ;

// Lengths in radii.
struct Disc {
    std::int64_t fibre;
    double x;
    double y;
};

Packing arrange(const FibreCell& cell) {
    try {
        if (cell.arrangement == "square") return square_packing(cell.fraction, cell.aspect);
        if (cell.arrangement == "hexagonal") return hexagonal_packing(cell.fraction);
        return pack_discs({cell.fibres, cell.fraction, cell.gap, cell.edge_gap, cell.aspect, cell.seed});
    } catch (const std::domain_error& error) {
        throw SceneFailure(cell.place, error.what());
    }
}

// The fibres and their periodic images that reach into the cell.
std::vector<Disc> discs_of(const Packing& packing) {
    std::vector<Disc> discs;
    for (std::size_t i = 0; i < packing.centres.size(); ++i)
        for (int p = -1; p <= 1; ++p)
            for (int q = -1; q <= 1; ++q) {
                const double x = packing.centres[i][0] + p * packing.width;
                const double y = packing.centres[i][1] + q * packing.height;
                const double dx = std::max({-x, x - packing.width, 0.0});
                const double dy = std::max({-y, y - packing.height, 0.0});
                if (dx * dx + dy * dy < 1.0) discs.push_back({static_cast<std::int64_t>(i), x, y});
            }
    return discs;
}

// The rectangle cut by the circles: parts inside a disc belong to its fibre, the rest to the matrix; parts of discs
// outside the rectangle are removed.
void draw(const Packing& packing, const std::vector<Disc>& discs) {
    const gmsh::vectorpair rectangle{{2, occ::addRectangle(0, 0, 0, packing.width, packing.height)}};
    gmsh::vectorpair tools;
    for (const Disc& disc : discs) tools.emplace_back(2, occ::addDisk(disc.x, disc.y, 0, 1, 1));
    gmsh::vectorpair pieces;
    std::vector<gmsh::vectorpair> pieces_of;
    occ::fragment(rectangle, tools, pieces, pieces_of);
    const std::set<std::pair<int, int>> inside(pieces_of[0].begin(), pieces_of[0].end());
    std::map<std::int64_t, std::vector<int>> fibres;
    std::set<int> of_fibres;
    gmsh::vectorpair outside;
    for (std::size_t d = 0; d < discs.size(); ++d)
        for (const auto& piece : pieces_of[d + 1]) {
            if (inside.count(piece) == 0) {
                outside.push_back(piece);
                continue;
            }
            fibres[discs[d].fibre].push_back(piece.second);
            of_fibres.insert(piece.second);
        }
    occ::remove(outside, true);
    occ::synchronize();

    const GeneratorModel model(2, {0, 0, 0}, {packing.width, packing.height, 0});
    model.drop_loose_parts();
    std::vector<int> matrix;
    for (const auto& piece : inside)
        if (of_fibres.count(piece.second) == 0) matrix.push_back(piece.second);
    model.name_body(matrix, "matrix");
    for (const auto& [fibre, surfaces] : fibres) model.name_body(surfaces, fmt::format("fibre-{}", fibre + 1));
    model.name_borders();
    model.tie_borders(0);
    model.tie_borders(1);
}

void mesh_surfaces(double h, bool quadrilaterals) {
    gmsh::option::setNumber("Mesh.MeshSizeMax", h);
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0.25 * h);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    // Frontal Delaunay. "Frontal Delaunay for quads" (8) crashes in builds of Gmsh without ANN, such as Debian's.
    gmsh::option::setNumber("Mesh.Algorithm", 6);
    if (quadrilaterals) {
        gmsh::option::setNumber("Mesh.RecombineAll", 1);
        gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1);
    }
    gmsh::model::mesh::generate(2);
}

}  // namespace

MeshData generate_fibre_cell(const FibreCell& cell) {
    const Place& place = cell.place;
    require(std::isfinite(cell.radius) && cell.radius > 0, place, "radius",
            fmt::format("must be > 0, got {}", cell.radius));
    require(cell.arrangement == "random" || cell.arrangement == "square" || cell.arrangement == "hexagonal", place,
            "arrangement", fmt::format("must be random, square or hexagonal, got \"{}\"", cell.arrangement));
    require(cell.cells_around >= 8 && cell.cells_around <= 1000, place, "cells_around",
            fmt::format("must be in 8..1000, got {}", cell.cells_around));
    const CellShape& shape = required_shape(cell.cell, fibre_cell_shapes(), place);
    const double coarsest = 2 * std::numbers::pi / 8;
    const double h = cell.h > 0 ? cell.h / cell.radius : 2 * std::numbers::pi / static_cast<double>(cell.cells_around);
    require(cell.h >= 0 && h <= coarsest && h >= coarsest / 125, place, "h",
            fmt::format("must be in [{:.6g}, {:.6g}], 1000 to 8 cells around a fibre, got {}",
                        coarsest / 125 * cell.radius, coarsest * cell.radius, cell.h));

    const Packing packing = arrange(cell);
    const std::vector<Disc> discs = discs_of(packing);
    const std::string subject = fmt::format("generator fibre-cell with h = {:.6g}", h * cell.radius);
    MeshData mesh = with_gmsh(key_of(place, "h"), subject, [&] {
        draw(packing, discs);
        mesh_surfaces(h, !shape.simplex());
        MeshData read = read_gmsh_model(subject, place);
        std::vector<std::string> names{"matrix"};
        for (std::size_t i = 0; i < packing.centres.size(); ++i) names.push_back(fmt::format("fibre-{}", i + 1));
        GeneratorModel::order_bodies(read, names);
        return read;
    });
    mesh.periods = {{packing.width, 0.0}, {0.0, packing.height}};
    align_borders(mesh, place);
    if (!shape.linear()) {
        // Radially onto the circle of the disc whose interface the edge is a chord of.
        make_quadratic(mesh, [&](const std::vector<std::int32_t>&, double* middle) {
            const Disc* nearest = nullptr;
            double nearest_distance = HUGE_VAL;
            for (const Disc& disc : discs) {
                const double distance = std::abs(std::hypot(middle[0] - disc.x, middle[1] - disc.y) - 1.0);
                if (distance < nearest_distance) {
                    nearest_distance = distance;
                    nearest = &disc;
                }
            }
            const double length = std::hypot(middle[0] - nearest->x, middle[1] - nearest->y);
            middle[0] = nearest->x + (middle[0] - nearest->x) / length;
            middle[1] = nearest->y + (middle[1] - nearest->y) / length;
        });
    }
    require_sound_cells(mesh, 0.02, key_of(place, "h"));

    for (double& x : mesh.nodes) x *= cell.radius;
    for (auto& period : mesh.periods)
        for (double& p : period) p *= cell.radius;
    const std::vector<double> areas = GeneratorModel::measures(mesh);
    double fibres = 0;
    double all = 0;
    for (std::size_t b = 0; b < areas.size(); ++b) {
        all += areas[b];
        if (mesh.body_names[b] != "matrix") fibres += areas[b];
    }
    mesh.notes.push_back(fmt::format("fibre cell {:.6g} x {:.6g}, {} fibres, {:.4f} of its area in this mesh",
                                     mesh.periods[0][0], mesh.periods[1][1], packing.centres.size(), fibres / all));
    return mesh;
}

}  // namespace cli
