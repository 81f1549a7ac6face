// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_surface.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"

namespace cli {

namespace {

// Its corners, ascending; -1 before those of a triangle. Faces of the same corners are the same.
using SeenKey = std::array<std::int64_t, 4>;

SeenKey seen_key(std::span<const std::int64_t> corners) {
    SeenKey key{-1, -1, -1, -1};
    std::copy_n(corners.begin(), std::min<std::size_t>(corners.size(), 4), key.begin());
    std::sort(key.begin(), key.end());
    return key;
}

// The nodes around each side of a cell, or around a plane cell. Where there are nodes midway, one of them is first: a
// fan of triangles from a corner would begin with one of no area.
std::vector<std::vector<std::size_t>> outlines_of(const CellShape& shape) {
    const auto around = [&shape](std::span<const std::size_t> corners) {
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::size_t from = corners[i], to = corners[(i + 1) % corners.size()];
            out.push_back(from);
            for (std::size_t m = 0; m < shape.middles.size(); ++m) {
                const auto& ends = shape.middles[m];
                if ((ends[0] == from && ends[1] == to) || (ends[0] == to && ends[1] == from))
                    out.push_back(shape.corners + m);
            }
        }
        if (out.size() > corners.size()) std::rotate(out.begin(), out.begin() + 1, out.end());
        return out;
    };
    std::vector<std::vector<std::size_t>> out;
    if (shape.dimension == 2) {
        std::vector<std::size_t> corners(shape.corners);
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = i;
        out.push_back(around(corners));
        return out;
    }
    for (const std::vector<std::size_t>& side : shape.sides) out.push_back(around(shape.corners_of(side)));
    return out;
}

struct ViewShape {
    const CellShape* shape = nullptr;
    std::vector<std::vector<std::size_t>> outlines;
};

// The dimension and the number of nodes tell the library's shapes apart.
std::vector<ViewShape> view_shapes(std::int32_t dimension) {
    std::vector<ViewShape> out;
    for (const CellShape& shape : all_shapes())
        if (shape.dimension == dimension) out.push_back({&shape, outlines_of(shape)});
    return out;
}

// One side of a cell, before it is known whether it can be seen.
struct CellSide {
    SeenKey key{};
    std::int64_t cell = 0;
    std::uint32_t side = 0;
};

// The corners of an interface's faces on the nodes of one of its bodies.
void add_keys(const ViewInterface& interface, const std::vector<std::int64_t>& nodes, std::vector<SeenKey>& keys) {
    const std::size_t corners = interface.per_face == 3 || interface.per_face == 6 ? 3 : 4;
    for (std::size_t f = 0; f + interface.per_face <= interface.faces.size(); f += interface.per_face) {
        std::array<std::int64_t, 4> on{};
        for (std::size_t i = 0; i < corners; ++i) on[i] = nodes[static_cast<std::size_t>(interface.faces[f + i])];
        const bool triangle =
            corners == 3 || on[2] == on[3];  // a triangle among quadrilaterals repeats its last corner
        keys.push_back(seen_key(std::span(on).first(triangle ? 3 : 4)));
    }
}

// A face of an interface, its pairs in order around it, or along it in the plane. The nodes midway follow the corners.
void add_face(Polygons& faces, std::span<const std::int64_t> face, std::int32_t dimension) {
    const std::size_t n = face.size();
    const auto add = [&](std::size_t i) { faces.nodes.push_back(static_cast<std::int32_t>(face[i])); };
    if (dimension == 2) {
        add(0);
        if (n == 3) add(2);
        add(1);
    } else if (n <= 4) {
        for (std::size_t i = 0; i < n; ++i) add(i);
    } else {
        const std::size_t corners = n == 6 ? 3 : 4;
        for (std::size_t i = 0; i < corners; ++i) {
            add(corners + i);
            add((i + 1) % corners);
        }
    }
    faces.offsets.push_back(static_cast<std::int32_t>(faces.nodes.size()));
}

class SurfaceCollector {
public:
    SurfaceCollector(const ViewMesh& mesh, const std::vector<ViewInterface>& interfaces, std::string path)
        : mesh_(mesh), interfaces_(interfaces), path_(std::move(path)), shapes_(view_shapes(mesh.dimension)) {}

    Seen collect() {
        if (mesh_.dimension == 2)
            for (std::size_t c = 0; c < mesh_.cell_count(); ++c) add_polygon(c, 0);
        else
            add_surface();
        for (const ViewInterface& interface : interfaces_) {
            if (interface.body_a >= 0) use(interface.nodes_a);
            use(interface.nodes_b);
        }
        number_nodes();
        return std::move(out_);
    }

private:
    std::span<const std::int64_t> row(std::size_t cell) const {
        const std::span<const std::int64_t> whole(mesh_.cells.data() + cell * mesh_.per_cell, mesh_.per_cell);
        return whole.first(static_cast<std::size_t>(std::find(whole.begin(), whole.end(), -1) - whole.begin()));
    }

    const ViewShape& shape(std::size_t cell) const {
        const std::size_t nodes = row(cell).size();
        for (const ViewShape& one : shapes_)
            if (one.shape->nodes == nodes) return one;
        throw Failure(exit_scene, fmt::format("{}: cell {} has {} nodes, as no cell of {} dimensions has", path_, cell,
                                              nodes, mesh_.dimension));
    }

    void add_polygon(std::size_t cell, std::size_t side) {
        const auto nodes = row(cell);
        for (const std::size_t i : shape(cell).outlines[side]) corners_.push_back(nodes[i]);
        out_.faces.offsets.push_back(static_cast<std::int32_t>(corners_.size()));
        out_.cells.push_back(static_cast<std::int64_t>(cell));
    }

    // The sides that only one cell has, but for those at interfaces, which are drawn as such.
    void add_surface() {
        std::vector<CellSide> sides;
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            const auto nodes = row(c);
            const CellShape& of = *shape(c).shape;
            for (std::size_t s = 0; s < of.sides.size(); ++s) {
                std::array<std::int64_t, 4> on{};
                const std::span<const std::size_t> corners = of.corners_of(of.sides[s]);
                for (std::size_t i = 0; i < corners.size(); ++i) on[i] = nodes[corners[i]];
                sides.push_back({seen_key(std::span(on).first(corners.size())), static_cast<std::int64_t>(c),
                                 static_cast<std::uint32_t>(s)});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const CellSide& x, const CellSide& y) { return x.key < y.key; });
        std::vector<SeenKey> covered;
        for (const ViewInterface& interface : interfaces_) {
            if (interface.body_a >= 0) add_keys(interface, interface.nodes_a, covered);
            add_keys(interface, interface.nodes_b, covered);
        }
        std::sort(covered.begin(), covered.end());
        std::vector<CellSide> kept;
        for (auto from = sides.begin(); from != sides.end();) {
            const auto to =
                std::find_if(from, sides.end(), [&](const CellSide& side) { return side.key != from->key; });
            if (to - from == 1 && !std::binary_search(covered.begin(), covered.end(), from->key)) kept.push_back(*from);
            from = to;
        }
        // Sorted by cell, neighbours have similar numbers, which compress better.
        std::sort(kept.begin(), kept.end(), [](const CellSide& x, const CellSide& y) {
            return std::tie(x.cell, x.side) < std::tie(y.cell, y.side);
        });
        for (const CellSide& side : kept) add_polygon(static_cast<std::size_t>(side.cell), side.side);
    }

    void use(const std::vector<std::int64_t>& nodes) { used_.insert(used_.end(), nodes.begin(), nodes.end()); }

    void number_nodes() {
        use(corners_);
        std::vector<std::int32_t> number(mesh_.nodes(), -1);
        for (const std::int64_t node : used_) number[static_cast<std::size_t>(node)] = 0;
        for (std::size_t i = 0; i < number.size(); ++i) {
            if (number[i] < 0) continue;
            number[i] = static_cast<std::int32_t>(out_.nodes.size());
            out_.nodes.push_back(static_cast<std::int64_t>(i));
        }
        const auto numbered = [&number](const std::vector<std::int64_t>& nodes) {
            std::vector<std::int32_t> out;
            for (const std::int64_t node : nodes) out.push_back(number[static_cast<std::size_t>(node)]);
            return out;
        };
        out_.faces.nodes = numbered(corners_);
        for (const ViewInterface& interface : interfaces_) {
            SeenInterface one;
            if (interface.body_a >= 0) one.a = numbered(interface.nodes_a);
            one.b = numbered(interface.nodes_b);
            for (std::size_t f = 0; f + interface.per_face <= interface.faces.size(); f += interface.per_face)
                add_face(one.faces, std::span(interface.faces).subspan(f, interface.per_face), mesh_.dimension);
            out_.interfaces.push_back(std::move(one));
        }
    }

    const ViewMesh& mesh_;
    const std::vector<ViewInterface>& interfaces_;
    std::string path_;
    std::vector<ViewShape> shapes_;
    std::vector<std::int64_t> corners_;  // of the faces, nodes of the mesh
    std::vector<std::int64_t> used_;
    Seen out_;
};

}  // namespace

Seen seen_of(const ViewMesh& mesh, const std::vector<ViewInterface>& interfaces, const std::string& path) {
    return SurfaceCollector(mesh, interfaces, path).collect();
}

}  // namespace cli
