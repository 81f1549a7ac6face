// SPDX-License-Identifier: BSD-3-Clause
// Every cell type of the library has its names in files, Gmsh's own description of its elements agrees with them, and
// what is no cell type is refused.
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gmsh.h>

#include "delam/delam.h"
#include "mesh/cell_format.hpp"
#include "mesh/cell_shape.hpp"
#include "text/error.hpp"

namespace {

int failures = 0;

void expect(bool condition, const std::string& what) {
    std::printf("%s %s\n", condition ? "ok   " : "FAIL ", what.c_str());
    if (!condition) ++failures;
}

void refused(const std::string& part, const std::function<void()>& action) {
    std::string said = "nothing";
    try {
        action();
    } catch (const cli::Failure& failure) {
        said = failure.what();
    }
    expect(said.find(part) != std::string::npos, "refused with \"" + part + "\": " + said);
}

// Each middle node of ours is, in Gmsh's order, where Gmsh puts the midpoint of the two corners.
bool same_places(const cli::CellShape& shape, const cli::CellFormat& format, const std::vector<double>& places) {
    const auto dimension = static_cast<std::size_t>(shape.dimension);
    const auto place = [&](std::size_t node, std::size_t axis) {
        return places[dimension * (format.gmsh_order.empty() ? node : format.gmsh_order[node]) + axis];
    };
    for (std::size_t m = 0; m < shape.middles.size(); ++m)
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const auto [a, b] = shape.middles[m];
            if (std::abs(place(shape.corners + m, axis) - 0.5 * (place(a, axis) + place(b, axis))) > 1e-12)
                return false;
        }
    return true;
}

void formats() {
    std::set<std::string_view> names;
    std::set<std::int64_t> numbers;
    std::set<int> gmsh_types;
    for (const cli::CellShape& shape : cli::all_shapes()) {
        const cli::CellFormat& format = cli::format_of(shape.type);
        expect(names.insert(format.xdmf).second && numbers.insert(format.xdmf_number).second &&
                   gmsh_types.insert(format.gmsh).second && cli::format_of_gmsh(format.gmsh) == &format,
               shape.name + " has names of its own");
        std::string name;
        int dimension = 0;
        int order = 0;
        int nodes = 0;
        int corners = 0;
        std::vector<double> places;
        gmsh::model::mesh::getElementProperties(format.gmsh, name, dimension, order, nodes, places, corners);
        expect(dimension == shape.dimension && static_cast<std::size_t>(nodes) == shape.nodes &&
                   static_cast<std::size_t>(corners) == shape.corners && order == (shape.linear() ? 1 : 2),
               shape.name + " is Gmsh's " + name);
        expect(same_places(shape, format, places), shape.name + ": middle nodes where Gmsh has them");
        for (const auto& side : shape.sides)
            expect(!cli::xdmf_face(shape.dimension, static_cast<std::int32_t>(side.size())).empty(),
                   shape.name + ": its sides have a name in XDMF");
        expect(&cli::shape_named(shape.name) == &shape && &cli::shape_of(shape.type) == &shape,
               shape.name + " is found");
    }
    expect(names.size() == static_cast<std::size_t>(delam_cell_type_count()), "every type of the library");
}

}  // namespace

int main() {
    gmsh::initialize();
    formats();
    gmsh::finalize();
    for (const std::int32_t type : {0, -1, 99}) {
        refused("is no cell type of the library", [&] { cli::shape_of(type); });
        refused("is no cell type of the library", [&] { cli::format_of(type); });
    }
    refused("\"pyramid13\" is no cell type", [] { cli::shape_named("pyramid13"); });
    refused("faces of 5 nodes in 3D have no name in XDMF", [] { cli::xdmf_face(3, 5); });
    refused("faces of 4 nodes in 2D have no name in XDMF", [] { cli::xdmf_face(2, 4); });
    expect(cli::format_of_gmsh(13) == nullptr, "Gmsh's prism of 18 nodes is no cell of the library");
    return failures == 0 ? 0 : 1;
}
