// SPDX-License-Identifier: BSD-3-Clause
// The neighbourhood of bodies of a mesh: the sides of cells that two bodies share, and the sides that coincide.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "deck/abaqus/abaqus_model.hpp"
#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli::abaqus {

using Face = std::array<std::int64_t, 9>;   // nodes, -1 padded
using FaceKey = std::vector<std::int64_t>;  // its corners, ascending

// The bodies on a side of cells. A side on which two bodies meet has two, unless the nodes are doubled.
class FaceBodies {
public:
    explicit FaceBodies(const MeshData& mesh);
    // Ascending and without repetitions; empty: no side of a cell.
    [[nodiscard]] std::vector<std::int32_t> of(const Face& face) const;
    // Returns the places of the nodes of a cohesive element in an order in which both halves are sides of cells; empty:
    // there is none.
    [[nodiscard]] std::vector<std::size_t> order_by_sides(const std::vector<std::int64_t>& nodes) const;
    [[nodiscard]] const std::map<FaceKey, std::vector<std::int32_t>>& all() const { return bodies_; }

private:
    std::int32_t dimension_;
    std::map<FaceKey, std::vector<std::int32_t>> bodies_;
};

// A face of a cohesive element of the mesh.
struct CohesiveFace {
    const CohesiveSet* set;
    std::size_t element;
    bool upper;
};
// Throw SceneFailure at the element: it has no body there; its faces are `gap` apart, and lie in one body. section: of
// the elements, for one that the deck knows no more.
[[noreturn]] void refuse_face(const Model& model, const MeshData& mesh, const FaceBodies& faces,
                              const CohesiveFace& face, const Place& section);
[[noreturn]] void refuse_thick(const Model& model, const MeshData& mesh, const FaceBodies& faces,
                               const CohesiveFace& face, double gap, const Place& section);

struct BodyPair {
    std::int32_t a = 0, b = 0;  // a < b
    std::int64_t shared = 0;    // sides whose nodes belong to both
    std::int64_t doubled = 0;   // sides that coincide, with nodes of their own
};
// Nodes coincide within 1e-6 of the shortest edge. Throws SceneFailure at `place` where there are too many pairs.
std::vector<BodyPair> pairs_of_bodies(const MeshData& mesh, const FaceBodies& faces, double shortest_edge,
                                      const Place& place);

// Knows where the faces of sets lie.
class FacePlaces {
public:
    FacePlaces(const MeshData& mesh, double shortest_edge);
    ~FacePlaces();
    FacePlaces(const FacePlaces&) = delete;
    FacePlaces& operator=(const FacePlaces&) = delete;
    // Returns how many faces of a set coincide with one of the other set.
    [[nodiscard]] std::int64_t coinciding(const std::string& set, const std::string& other);

private:
    struct Known;
    std::unique_ptr<Known> known_;
};

// Returns the largest distance of a node of one set of faces from the nearest node of another.
double farthest(const MeshData& mesh, const std::string& from, const std::string& to);

// The bodies that have a node in their cells, ascending.
class NodeBodies {
public:
    explicit NodeBodies(const MeshData& mesh);
    [[nodiscard]] const std::vector<std::int32_t>& of(std::int64_t node) const {
        return of_[static_cast<std::size_t>(node)];
    }

private:
    std::vector<std::vector<std::int32_t>> of_;
};

}  // namespace cli::abaqus
