// SPDX-License-Identifier: BSD-3-Clause
// Writes small meshes through Gmsh's library for test_meshes.py: make_meshes DIR. Two blocks on top of each other,
// "lower" and "upper", 4 x 1 x 1 and in the plane 4 x 1, of every cell type that the program reads, in every format.
#include <cstdio>
#include <string>
#include <utility>

#include <gmsh.h>

namespace {

// Bricks or rectangles of `recombined` cells, else simplices; order 1 or 2, `whole` second-order cells with centres.
void build(int dimension, bool recombined, int order, bool whole) {
    gmsh::clear();
    gmsh::model::add("blocks");
    gmsh::vectorpair bottoms;
    for (int layer = 0; layer < 2; ++layer) {
        const double y = layer;
        if (dimension == 2) {
            for (double x : {0.0, 4.0}) {
                if (layer == 0) gmsh::model::geo::addPoint(x, y, 0, 0, x > 0 ? 2 : 1);
                gmsh::model::geo::addPoint(x, y + 1, 0, 0, 2 * layer + (x > 0 ? 4 : 3));
            }
        }
    }
    if (dimension == 2) {
        // Points 1 2, 3 4, 5 6 from the bottom up; the upper surface has clockwise orientation.
        const int a[][2] = {{1, 2}, {2, 4}, {4, 3}, {3, 1}, {4, 6}, {6, 5}, {5, 3}};
        for (int i = 0; i < 7; ++i) gmsh::model::geo::addLine(a[i][0], a[i][1], i + 1);
        gmsh::model::geo::addCurveLoop({1, 2, 3, 4}, 1);
        gmsh::model::geo::addCurveLoop({-7, -6, -5, 3}, 2);
        for (int s : {1, 2}) {
            gmsh::model::geo::addPlaneSurface({s}, s);
        }
        for (int line : {1, 3, 6}) gmsh::model::geo::mesh::setTransfiniteCurve(line, 5);
        for (int line : {2, 4, 5, 7}) gmsh::model::geo::mesh::setTransfiniteCurve(line, 2);
        for (int s : {1, 2}) {
            gmsh::model::geo::mesh::setTransfiniteSurface(s);
            if (recombined) gmsh::model::geo::mesh::setRecombine(2, s);
        }
        gmsh::model::geo::synchronize();
        const char* bodies[] = {"lower", "upper"};
        for (int s : {1, 2}) gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {s}), bodies[s - 1]);
        gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {1}), "bottom");
        gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {6}), "top");
        gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {3}), "seam");
        gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {1}), "corner");
    } else {
        gmsh::model::occ::addBox(0, 0, 0, 4, 1, 1, 1);
        gmsh::model::occ::addBox(0, 0, 1, 4, 1, 1, 2);
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        gmsh::model::occ::fragment({{3, 1}}, {{3, 2}}, out, map);
        gmsh::model::occ::synchronize();
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, 1);
        for (const auto& [dim, line] : entities) {
            double a[6];
            gmsh::model::getBoundingBox(dim, line, a[0], a[1], a[2], a[3], a[4], a[5]);
            gmsh::model::mesh::setTransfiniteCurve(line, a[3] - a[0] > 1 ? 5 : 2);
        }
        gmsh::model::getEntities(entities, 2);
        int bottom = 0, top = 0, seam = 0;
        for (const auto& [dim, face] : entities) {
            gmsh::model::mesh::setTransfiniteSurface(face);
            if (recombined) gmsh::model::mesh::setRecombine(2, face);
            double x, y, z;
            gmsh::model::occ::getCenterOfMass(2, face, x, y, z);
            if (z < 0.1) bottom = face;
            if (z > 1.9) top = face;
            if (z > 0.9 && z < 1.1) seam = face;
        }
        // The seam and other faces share z = 1/2 and 3/2 with nothing.
        for (int v : {1, 2}) gmsh::model::mesh::setTransfiniteVolume(v);
        const char* bodies[] = {"lower", "upper"};
        for (int v : {1, 2}) gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {v}), bodies[v - 1]);
        gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {bottom}), "bottom");
        gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {top}), "top");
        gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {seam}), "seam");
    }
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", whole ? 0 : 1);
    gmsh::model::mesh::generate(dimension);
    if (order > 1) gmsh::model::mesh::setOrder(order);
}

// The two blocks as prisms: triangles that are extruded, with rectangles on the sides; one cell in each block's height.
void extrude(int order) {
    gmsh::clear();
    gmsh::model::add("blocks");
    int number = 0;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {0.0, 1.0}})
        gmsh::model::geo::addPoint(x, y, 0, 0, ++number);
    for (int i = 1; i < 5; ++i) {
        gmsh::model::geo::addLine(i, i % 4 + 1, i);
        gmsh::model::geo::mesh::setTransfiniteCurve(i, i % 2 == 1 ? 5 : 2);
    }
    gmsh::model::geo::addCurveLoop({1, 2, 3, 4}, 1);
    gmsh::model::geo::addPlaneSurface({1}, 1);
    gmsh::model::geo::mesh::setTransfiniteSurface(1);
    const char *bodies[] = {"lower", "upper"}, *sets[] = {"seam", "top"};
    int from = 1, volumes[2], surfaces[2];
    for (int layer = 0; layer < 2; ++layer) {
        gmsh::vectorpair out;
        gmsh::model::geo::extrude({{2, from}}, 0, 0, 1, out, {1}, {}, true);
        surfaces[layer] = from = out[0].second;
        volumes[layer] = out[1].second;
    }
    gmsh::model::geo::synchronize();
    for (int k : {0, 1}) {
        gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volumes[k]}), bodies[k]);
        gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {surfaces[k]}), sets[k]);
    }
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), "bottom");
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
    gmsh::model::mesh::generate(3);
    if (order > 1) gmsh::model::mesh::setOrder(order);
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) return 2;
    const std::string folder = words[1];
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    struct {
        const char* name;
        int dimension;
        bool recombined;
        int order;
        bool whole;
    } const cases[] = {{"tri3", 2, false, 1, false},  {"quad4", 2, true, 1, false},  {"tri6", 2, false, 2, false},
                       {"quad8", 2, true, 2, false},  {"quad9", 2, true, 2, true},   {"tet4", 3, false, 1, false},
                       {"hex8", 3, true, 1, false},   {"tet10", 3, false, 2, false}, {"hex20", 3, true, 2, false},
                       {"hex27", 3, true, 2, true},   {"tri10", 2, false, 3, false}, {"wedge6", 3, true, 1, false},
                       {"wedge15", 3, true, 2, false}};
    try {
        for (const auto& c : cases) {
            if (std::string(c.name).starts_with("wedge"))
                extrude(c.order);
            else
                build(c.dimension, c.recombined, c.order, c.whole);
            for (const double version : {2.2, 4.1})
                for (const int binary : {0, 1}) {
                    gmsh::option::setNumber("Mesh.MshFileVersion", version);
                    gmsh::option::setNumber("Mesh.Binary", binary);
                    gmsh::write(folder + "/" + c.name + (version < 3 ? "-22" : "-41") + (binary ? "b" : "a") + ".msh");
                }
            gmsh::option::setNumber("Mesh.Binary", 0);
            gmsh::option::setNumber("Mesh.SaveGroupsOfNodes", 1);
            gmsh::write(folder + "/" + c.name + ".inp");
            if (c.order > 1) continue;
            gmsh::model::mesh::partition(3);
            for (const double version : {2.2, 4.1}) {
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::write(folder + "/" + c.name + (version < 3 ? "-22" : "-41") + "p.msh");
            }
        }
    } catch (const std::string& text) {
        std::fprintf(stderr, "make_meshes: %s\n", text.c_str());
        return 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "make_meshes: %s\n", e.what());
        return 1;
    }
    gmsh::finalize();
    return 0;
}
