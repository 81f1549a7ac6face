// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cli {

/** Cells of one type. */
struct CellBlock {
    std::int32_t type;                       ///< a delam_cell_type
    std::vector<std::int64_t> connectivity;  ///< [cells][nodes per cell] in delam's node order, 0-based
    std::vector<std::int32_t> bodies;        ///< [cells] label of each cell's body, an index of MeshData::body_names
    std::vector<std::int32_t> partitions{};  ///< [cells] from 1 on, 0: none; empty: the file knows no partitions
};

/** Cohesive elements of a file, which are no cells: the faces of bodies that they hold together. */
struct CohesiveSet {
    std::string name;                                       ///< of their set of elements
    std::string faces;                                      ///< of the set of these faces: `name`, unless nodes have it
    std::string joined{};                                   ///< of its faces and those of sets with an equal section
    std::vector<std::array<std::int64_t, 9>> lower, upper;  ///< [elements] nodes of each face, -1 padded
    std::vector<double> apart;  ///< [elements] distance of its faces where bodies are tied to them; < 0: they are not
};

/**
 * A mesh as files and generators give it: bodies that touch share their nodes, and what is wanted of a part of
 * the mesh later is said by names.
 */
struct MeshData {
    std::int32_t dimension = 2;
    std::vector<double> nodes;      ///< [n][dimension], in the unit of length of the file
    std::int64_t given_nodes = -1;  ///< the first of them, which the file has; those behind lie between plies; -1: all
    std::vector<CellBlock> blocks;
    std::vector<std::string> body_names;                         ///< by label
    std::map<std::string, std::vector<std::int64_t>> node_sets;  ///< named nodes, each once and ascending
    std::map<std::string, std::vector<std::array<std::int64_t, 9>>> face_sets;  ///< faces as node lists, -1 padded
    std::vector<std::array<double, 6>> orientation;  ///< [cells, block after block] material axes 1, 2; empty: none
    std::vector<std::vector<double>> periods;        ///< [n][dimension] periods of a cell; empty: not periodic
    std::string plane;                  ///< "plane-strain" or "plane-stress" where the file says so; else empty
    std::vector<CohesiveSet> cohesive;  ///< what holds bodies together in the file
    std::vector<std::string> notes;     ///< what was decided on the way, for people
    std::string file;                   ///< from which it was read; empty: it was generated
    std::vector<std::string> chosen;    ///< the sets of elements of a deck that were asked for as bodies

    /** True if the file has this node. */
    [[nodiscard]] bool has_given(std::int64_t node) const { return given_nodes < 0 || node < given_nodes; }
};

}  // namespace cli
