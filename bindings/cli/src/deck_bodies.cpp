// SPDX-License-Identifier: BSD-3-Clause
#include "deck_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

#include "cell_shape.hpp"

namespace cli::abaqus {

namespace {

FaceKey key_of(const Face& face, std::int32_t dimension) {
    const auto count = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
    const std::size_t corners = dimension == 2 ? 2 : count % 3 == 0 ? 3 : 4;
    FaceKey key(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(std::min(corners, count)));
    std::sort(key.begin(), key.end());
    return key;
}

void add_once(std::vector<std::int32_t>& to, std::int32_t body) {
    const auto at = std::lower_bound(to.begin(), to.end(), body);
    if (at == to.end() || *at != body) to.insert(at, body);
}

// Of nodes that coincide, the first.
class Coincidence {
public:
    Coincidence(const MeshData& mesh, double tolerance)
        : mesh_(mesh), dimension_(static_cast<std::size_t>(mesh.dimension)), tolerance_(tolerance) {}

    std::int64_t first(std::int64_t node) {
        const auto known = first_.find(node);
        if (known != first_.end()) return known->second;
        Cell cell{};
        for (std::size_t a = 0; a < dimension_; ++a) cell[a] = std::llround(std::floor(at(node)[a] / (8 * tolerance_)));
        std::int64_t found = node;
        for (const std::int64_t other : near(cell))
            if (found == node && distance(other, node) <= tolerance_) found = other;
        if (found == node) grid_[cell].push_back(node);
        return first_[node] = found;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    [[nodiscard]] const double* at(std::int64_t node) const {
        return mesh_.nodes.data() + static_cast<std::size_t>(node) * dimension_;
    }
    [[nodiscard]] double distance(std::int64_t a, std::int64_t b) const {
        double square = 0;
        for (std::size_t i = 0; i < dimension_; ++i) square += (at(a)[i] - at(b)[i]) * (at(a)[i] - at(b)[i]);
        return std::sqrt(square);
    }
    [[nodiscard]] std::vector<std::int64_t> near(const Cell& cell) const {
        std::vector<std::int64_t> out;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = dimension_ == 3 ? -1 : 0; z <= (dimension_ == 3 ? 1 : 0); ++z) {
                    const auto found = grid_.find({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (found != grid_.end()) out.insert(out.end(), found->second.begin(), found->second.end());
                }
        return out;
    }

    const MeshData& mesh_;
    std::size_t dimension_;
    double tolerance_;
    std::map<Cell, std::vector<std::int64_t>> grid_;
    std::unordered_map<std::int64_t, std::int64_t> first_;
};

}  // namespace

FaceBodies::FaceBodies(const MeshData& mesh) : dimension_(mesh.dimension) {
    for (const CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            for (const auto& side : shape.sides) {
                FaceKey key;
                for (std::size_t i = 0; i < shape.side_corners; ++i)
                    key.push_back(block.connectivity[c * shape.nodes + side[i]]);
                std::sort(key.begin(), key.end());
                const auto [at, fresh] = bodies_.emplace(std::move(key), std::vector{block.bodies[c]});
                if (!fresh) add_once(at->second, block.bodies[c]);
            }
    }
}

std::vector<std::int32_t> FaceBodies::of(const Face& face) const {
    const auto found = bodies_.find(key_of(face, dimension_));
    return found == bodies_.end() ? std::vector<std::int32_t>{} : found->second;
}

std::vector<BodyPair> pairs_of_bodies(const MeshData& mesh, const FaceBodies& faces, double shortest_edge) {
    std::map<std::pair<std::int32_t, std::int32_t>, BodyPair> out;
    const auto pair = [&](std::int32_t a, std::int32_t b) -> BodyPair& {
        BodyPair& found = out[std::minmax(a, b)];
        std::tie(found.a, found.b) = std::minmax(a, b);
        return found;
    };
    Coincidence coincidence(mesh, 1e-6 * shortest_edge);
    std::map<FaceKey, std::vector<std::int32_t>> places;  // by nodes of which each stands for all that coincide
    for (const auto& [key, bodies] : faces.all()) {
        for (std::size_t i = 1; i < bodies.size(); ++i) ++pair(bodies[0], bodies[i]).shared;
        FaceKey place;
        for (const std::int64_t node : key) place.push_back(coincidence.first(node));
        std::sort(place.begin(), place.end());
        std::vector<std::int32_t>& there = places[std::move(place)];
        for (const std::int32_t body : bodies) {
            for (const std::int32_t other : there)
                if (other != body) ++pair(other, body).doubled;
        }
        there.insert(there.end(), bodies.begin(), bodies.end());
    }
    std::vector<BodyPair> list;
    for (const auto& [key, found] : out) list.push_back(found);
    return list;
}

std::int64_t coinciding_faces(const MeshData& mesh, const std::vector<Face>& faces, const std::vector<Face>& others,
                              double shortest_edge) {
    Coincidence coincidence(mesh, 1e-6 * shortest_edge);
    const auto place_of = [&](const Face& face) {
        FaceKey place = key_of(face, mesh.dimension);
        for (std::int64_t& node : place) node = coincidence.first(node);
        std::sort(place.begin(), place.end());
        return place;
    };
    std::set<FaceKey> known;
    for (const Face& face : others) known.insert(place_of(face));
    return std::count_if(faces.begin(), faces.end(), [&](const Face& face) { return known.contains(place_of(face)); });
}

std::vector<std::int32_t> bodies_at(const MeshData& mesh, std::int64_t node) {
    std::vector<std::int32_t> out;
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t nodes = shape_of(block.type).nodes;
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            if (const auto begin = block.connectivity.begin() + static_cast<std::ptrdiff_t>(c * nodes);
                std::find(begin, begin + static_cast<std::ptrdiff_t>(nodes), node) !=
                begin + static_cast<std::ptrdiff_t>(nodes))
                add_once(out, block.bodies[c]);
    }
    return out;
}

}  // namespace cli::abaqus
