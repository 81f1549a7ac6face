// SPDX-License-Identifier: BSD-3-Clause
// The cell types, one row each. Every part of the library takes what it needs of a type from its row; nothing else
// lists the types.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "delam/delam.h"

namespace delam {

enum class CellType : std::int32_t {
    tri3 = DELAM_TRI3,
    quad4 = DELAM_QUAD4,
    tet4 = DELAM_TET4,
    hex8 = DELAM_HEX8,
    tri6 = DELAM_TRI6,
    quad8 = DELAM_QUAD8,
    quad9 = DELAM_QUAD9,
    tet10 = DELAM_TET10,
    hex20 = DELAM_HEX20,
    hex27 = DELAM_HEX27,
    wedge6 = DELAM_WEDGE6,
    pyramid5 = DELAM_PYRAMID5,
    wedge15 = DELAM_WEDGE15
};
inline constexpr std::size_t most_cell_nodes = 27;
inline constexpr std::size_t most_cell_faces = 6;
inline constexpr std::size_t most_face_nodes = 9;

// Local nodes of a face of a cell. The faces of one cell may have different numbers of them.
struct CellFace {
    std::size_t nodes = 0;
    std::array<int, most_face_nodes> node{};  // first `nodes` entries are used

    constexpr CellFace() = default;
    constexpr CellFace(std::initializer_list<int> list) : nodes(list.size()) {
        std::copy(list.begin(), list.end(), node.begin());
    }
    constexpr std::span<const int> all() const { return std::span(node).first(nodes); }
};

// The nodes of a cell are its corners, then those midway between two corners. Its faces (edges in 2D) are lists of
// local nodes: corners, outward when walked in order, then the mid-side nodes, the k-th between corners k and k+1, then
// the centre where there is one.
struct CellTopology {
    const char* name;  // as the C API and the scene file spell it
    int dimension;
    int nodes;
    int corners;
    int faces;
    std::array<CellFace, most_cell_faces> face;  // first `faces` entries are used
    std::array<std::array<int, 2>, 19> middle;   // node corners+k sits between middle[k]

    constexpr std::span<const CellFace> all_faces() const {
        return std::span(face).first(static_cast<std::size_t>(faces));
    }
    // The corners of one of its faces, which stand before the other nodes.
    constexpr std::span<const int> corners_of(const CellFace& one) const {
        const auto own = std::ranges::count_if(one.all(), [this](int k) { return k < corners; });
        return one.all().first(static_cast<std::size_t>(own));
    }
};

// The triangle or tetrahedron with corners 0, e1, e2(, e3); the square [-1,1]^2 or the cube [-1,1]^3; the product of
// this triangle and [-1,1]; the cube whose upper face is mapped to one point, the apex of a pyramid.
enum class ReferenceCell { simplex, box, prism, pyramid };
// Linear (on boxes: in each coordinate); complete of second degree; serendipity, without nodes inside faces and cells.
enum class Interpolation { linear, quadratic, serendipity };
// Quadrature of the stiffness (shape.cpp).
enum class Rule { centroid, triangle3, tetrahedron8, gauss2, gauss3, prism6, prism18 };

struct CellRow {
    CellType type;
    CellTopology topology;
    ReferenceCell reference;
    Interpolation interpolation;
    Rule rule;

    constexpr bool linear() const { return interpolation == Interpolation::linear; }
    constexpr bool simplex() const { return reference == ReferenceCell::simplex; }
    // True if all strains are constant in the cell.
    constexpr bool one_strain() const { return simplex() && linear(); }
    // True if the cell can have the incompatible modes of body/element.cpp.
    constexpr bool has_modes() const { return reference == ReferenceCell::box && linear(); }
    // Number of functions that a projected dilatation consists of: a constant in linear cells and quadratic simplices,
    // a linear function of x in the other quadratic cells.
    constexpr std::size_t dilatations() const {
        return simplex() || linear() ? 1 : static_cast<std::size_t>(topology.dimension) + 1;
    }
};

// The rows stand in the order of their numbers, 1, 2, ... The centres of quad9 and hex27
// and of the faces of hex27 count as midway of a diagonal.
// clang-format off
inline constexpr std::array cell_rows{
    CellRow{CellType::tri3, {"tri3", 2, 3, 3, 3, {{{0, 1}, {1, 2}, {2, 0}}}, {}},
            ReferenceCell::simplex, Interpolation::linear, Rule::centroid},
    CellRow{CellType::quad4, {"quad4", 2, 4, 4, 4, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}, {}},
            ReferenceCell::box, Interpolation::linear, Rule::gauss2},
    CellRow{CellType::tet4, {"tet4", 3, 4, 4, 4, {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}, {}},
            ReferenceCell::simplex, Interpolation::linear, Rule::centroid},
    CellRow{CellType::hex8,
            {"hex8", 3, 8, 8, 6,
             {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
             {}},
            ReferenceCell::box, Interpolation::linear, Rule::gauss2},
    CellRow{CellType::tri6,
            {"tri6", 2, 6, 3, 3, {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}}, {{{0, 1}, {1, 2}, {2, 0}}}},
            ReferenceCell::simplex, Interpolation::quadratic, Rule::triangle3},
    CellRow{CellType::quad8,
            {"quad8", 2, 8, 4, 4,
             {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
             {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}},
            ReferenceCell::box, Interpolation::serendipity, Rule::gauss3},
    CellRow{CellType::quad9,
            {"quad9", 2, 9, 4, 4,
             {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
             {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}}},
            ReferenceCell::box, Interpolation::quadratic, Rule::gauss3},
    CellRow{CellType::tet10,
            {"tet10", 3, 10, 4, 4,
             {{{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}},
             {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}},
            ReferenceCell::simplex, Interpolation::quadratic, Rule::tetrahedron8},
    CellRow{CellType::hex20,
            {"hex20", 3, 20, 8, 6,
             {{{0, 3, 2, 1, 11, 10, 9, 8},
               {4, 5, 6, 7, 12, 13, 14, 15},
               {0, 1, 5, 4, 8, 17, 12, 16},
               {1, 2, 6, 5, 9, 18, 13, 17},
               {2, 3, 7, 6, 10, 19, 14, 18},
               {3, 0, 4, 7, 11, 16, 15, 19}}},
             {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}},
            ReferenceCell::box, Interpolation::serendipity, Rule::gauss3},
    CellRow{CellType::hex27,
            {"hex27", 3, 27, 8, 6,
             {{{0, 3, 2, 1, 11, 10, 9, 8, 24},
               {4, 5, 6, 7, 12, 13, 14, 15, 25},
               {0, 1, 5, 4, 8, 17, 12, 16, 22},
               {1, 2, 6, 5, 9, 18, 13, 17, 21},
               {2, 3, 7, 6, 10, 19, 14, 18, 23},
               {3, 0, 4, 7, 11, 16, 15, 19, 20}}},
             {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
               {0, 7}, {1, 6}, {0, 5}, {3, 6}, {0, 2}, {4, 6}, {0, 6}}}},
            ReferenceCell::box, Interpolation::quadratic, Rule::gauss3},
    CellRow{CellType::wedge6,
            {"wedge6", 3, 6, 6, 5, {{{3, 5, 4}, {0, 1, 2}, {3, 4, 1, 0}, {4, 5, 2, 1}, {5, 3, 0, 2}}}, {}},
            ReferenceCell::prism, Interpolation::linear, Rule::prism6},
    CellRow{CellType::pyramid5,
            {"pyramid5", 3, 5, 5, 5, {{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}, {}},
            ReferenceCell::pyramid, Interpolation::linear, Rule::gauss2},
    CellRow{CellType::wedge15,
            {"wedge15", 3, 15, 6, 5,
             {{{3, 5, 4, 11, 10, 9},
               {0, 1, 2, 6, 7, 8},
               {3, 4, 1, 0, 9, 13, 6, 12},
               {4, 5, 2, 1, 10, 14, 7, 13},
               {5, 3, 0, 2, 11, 12, 8, 14}}},
             {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}},
            ReferenceCell::prism, Interpolation::serendipity, Rule::prism18},
};
// clang-format on

// A face of quadratic cells consists of linear pieces between its nodes: an edge of two chords; a triangle of four
// triangles; a quadrilateral of a triangle at each corner and the quadrilateral of its mid-side nodes. A linear face is
// one piece.
struct FacePiece {
    int nodes;
    std::array<int, 4> node;  // positions in the list of the face's nodes, outward in order; the first `nodes` are used
};

// A kind of face: the dimension of the cells that have it and its number of nodes tell which.
struct FaceRow {
    int dimension;
    int nodes;
    int corners;
    CellType surface;  // the plane cell whose reference cell and shape functions a face in space has; of edges unused
    int pieces;
    std::array<FacePiece, 5> piece;

    constexpr int sides() const { return corners == 2 ? 1 : corners; }
};

// clang-format off
inline constexpr std::array face_rows{
    FaceRow{2, 2, 2, {}, 1, {{{2, {0, 1}}}}},
    FaceRow{2, 3, 2, {}, 2, {{{2, {0, 2}}, {2, {2, 1}}}}},
    FaceRow{3, 3, 3, CellType::tri3, 1, {{{3, {0, 1, 2}}}}},
    FaceRow{3, 4, 4, CellType::quad4, 1, {{{4, {0, 1, 2, 3}}}}},
    FaceRow{3, 6, 3, CellType::tri6, 4, {{{3, {0, 3, 5}}, {3, {3, 1, 4}}, {3, {5, 4, 2}}, {3, {3, 4, 5}}}}},
    FaceRow{3, 8, 4, CellType::quad8, 5,
            {{{3, {0, 4, 7}}, {3, {4, 1, 5}}, {3, {5, 2, 6}}, {3, {6, 3, 7}}, {4, {4, 5, 6, 7}}}}},
    FaceRow{3, 9, 4, CellType::quad9, 4,
            {{{4, {0, 4, 8, 7}}, {4, {4, 1, 5, 8}}, {4, {8, 5, 2, 6}}, {4, {7, 8, 6, 3}}}}},
};
// clang-format on

// Row of a type; nullptr for a number that is no cell type.
const CellRow* find_cell_row(std::int32_t number);
// The same, Error(DELAM_ERROR_ARGUMENT) where there is none.
const CellRow& cell_row(CellType type);
const CellTopology& topology(CellType type);
// Names of the types that `wanted` picks, as "quad4 and hex8".
std::string cell_names(bool (*wanted)(const CellRow&));

// Row of the faces with so many nodes; nullptr where no cell has such faces.
const FaceRow* find_face_row(int dimension, std::int64_t nodes);
// The same, Error(DELAM_ERROR_INTERNAL) where there is none.
const FaceRow& face_row(int dimension, std::size_t nodes);
// The smallest row with these corners and at least so many other nodes.
const FaceRow& face_row(int dimension, std::size_t corners, std::size_t others);
std::span<const FacePiece> face_pieces(int dimension, std::size_t face_nodes);
// The numbers of nodes that faces may have, as "3, 4, 6, 8 or 9".
std::string face_sizes(int dimension);

}  // namespace delam
