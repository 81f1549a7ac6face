// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_type.hpp"

#include <algorithm>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

// The compiler checks that the rows agree with one another.

constexpr bool on_face(const CellFace& face, int node) {
    const std::span<const int> all = face.all();
    return std::find(all.begin(), all.end(), node) != all.end();
}

// Mid-side node k of a face is the middle node between its corners k and k+1.
constexpr bool middles_fit(const CellTopology& cell, const CellFace& face) {
    const std::span<const int> local = face.all();
    const std::size_t corners = cell.corners_of(face).size(), sides = corners == 2 ? 1 : corners;
    for (std::size_t k = 0; k < sides && corners + k < local.size(); ++k) {
        const auto& [a, b] = cell.middle[index(local[corners + k] - cell.corners)];
        const int p = local[k];
        const int q = local[(k + 1) % corners];
        if (!((a == p && b == q) || (a == q && b == p))) return false;
    }
    return true;
}

constexpr bool has_row(const CellTopology& cell, const CellFace& face) {
    for (const FaceRow& row : face_rows)
        if (row.dimension == cell.dimension && index(row.nodes) == face.nodes &&
            index(row.corners) == cell.corners_of(face).size())
            return true;
    return false;
}

constexpr bool sound(const CellRow& row, std::size_t place) {
    const CellTopology& cell = row.topology;
    if (static_cast<std::size_t>(row.type) != place + 1) return false;
    if (index(cell.nodes) > most_cell_nodes || index(cell.faces) > most_cell_faces) return false;
    if (row.linear() != (cell.nodes == cell.corners)) return false;
    for (int m = 0; m < cell.nodes - cell.corners; ++m)
        for (const int corner : cell.middle[index(m)])
            if (corner < 0 || corner >= cell.corners) return false;
    for (const CellFace& face : cell.all_faces()) {
        for (std::size_t k = 0; k < face.nodes; ++k) {
            const int node = face.node[k];
            if (node < 0 || node >= cell.nodes || (k < cell.corners_of(face).size()) != (node < cell.corners))
                return false;
        }
        if (!has_row(cell, face) || !middles_fit(cell, face)) return false;
    }
    // As many faces meet at a corner as there are axes; one more at the apex of a pyramid.
    for (int corner = 0; corner < cell.corners; ++corner) {
        int meeting = 0;
        for (const CellFace& face : cell.all_faces()) meeting += on_face(face, corner) ? 1 : 0;
        const bool apex = row.reference == ReferenceCell::pyramid && corner + 1 == cell.corners;
        if (meeting != cell.dimension + (apex ? 1 : 0)) return false;
    }
    return true;
}

constexpr bool all_sound() {
    for (std::size_t i = 0; i < cell_rows.size(); ++i)
        if (!sound(cell_rows[i], i)) return false;
    for (const FaceRow& face : face_rows)
        if (index(face.nodes) > most_face_nodes || index(face.pieces) > face.piece.size()) return false;
    return true;
}
static_assert(all_sound(), "a row of a cell type contradicts itself");

std::string listing(const std::vector<std::string>& words, const char* last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? std::string(" ") + last + " " : std::string(", ")) + words[i];
    return text;
}

}  // namespace

const CellRow* find_cell_row(std::int32_t number) {
    const auto count = static_cast<std::int32_t>(cell_rows.size());
    return number >= 1 && number <= count ? &cell_rows[index(number - 1)] : nullptr;
}

const CellRow& cell_row(CellType type) {
    const auto number = static_cast<std::int32_t>(type);
    if (const CellRow* row = find_cell_row(number)) return *row;
    fail(DELAM_ERROR_ARGUMENT, "cell type ", number, ": must be 1 (", cell_rows.front().topology.name, ") .. ",
         cell_rows.size(), " (", cell_rows.back().topology.name, ")");
}

const CellTopology& topology(CellType type) { return cell_row(type).topology; }

std::string cell_names(bool (*wanted)(const CellRow&)) {
    std::vector<std::string> names;
    for (const CellRow& row : cell_rows)
        if (wanted(row)) names.emplace_back(row.topology.name);
    return listing(names, "and");
}

const FaceRow* find_face_row(int dimension, std::int64_t nodes) {
    for (const FaceRow& row : face_rows)
        if (row.dimension == dimension && row.nodes == nodes) return &row;
    return nullptr;
}

const FaceRow& face_row(int dimension, std::size_t nodes) {
    if (const FaceRow* row = find_face_row(dimension, static_cast<std::int64_t>(nodes))) return *row;
    fail(DELAM_ERROR_INTERNAL, "no cell has faces of ", nodes, " nodes in ", dimension, "D");
}

const FaceRow& face_row(int dimension, std::size_t corners, std::size_t others) {
    const FaceRow* smallest = nullptr;
    for (const FaceRow& row : face_rows)
        if (row.dimension == dimension && index(row.corners) == corners && index(row.nodes) >= corners + others &&
            (smallest == nullptr || row.nodes < smallest->nodes))
            smallest = &row;
    if (smallest != nullptr) return *smallest;
    fail(DELAM_ERROR_INTERNAL, "no cell has faces of ", corners, " corners and ", others, " other nodes in ", dimension,
         "D");
}

std::span<const FacePiece> face_pieces(int dimension, std::size_t face_nodes) {
    const FaceRow& row = face_row(dimension, face_nodes);
    return std::span(row.piece).first(index(row.pieces));
}

std::string face_sizes(int dimension) {
    std::vector<std::string> sizes;
    for (const FaceRow& row : face_rows)
        if (row.dimension == dimension) sizes.push_back(std::to_string(row.nodes));
    return listing(sizes, "or");
}

}  // namespace delam
