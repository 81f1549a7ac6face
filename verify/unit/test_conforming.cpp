// SPDX-License-Identifier: BSD-3-Clause
// Conforming meshes of touching bodies: doubled nodes, and interfaces between all bodies that touch, against counts
// taken from the mesh as the mesher wrote it.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "all_types.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/rule/mid_sides.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

using Labels = std::vector<std::int32_t>;
using Indices = std::vector<std::int64_t>;
using Numbers = std::vector<double>;
using Place = std::array<double, 3>;

// The unit square or cube as a mesher would write it: shared nodes, cells with the label of the box in which they lie.
struct Written {
    int dimension;
    CellType type;
    Numbers nodes;
    Indices cells;
    Labels labels;

    std::size_t per_cell() const { return index(topology(type).nodes); }
    Mesh empty() const { return Mesh(dimension, nodes); }
    Mesh doubled() const {
        Mesh mesh = empty();
        mesh.add_conforming_cells(type, cells, labels);
        return mesh;
    }
};

using LabelOf = std::function<std::int32_t(const std::array<std::int64_t, 3>&)>;  // of the box with these indices

Written written(CellType type, std::int64_t n, const LabelOf& label_of) {
    const int dim = topology(type).dimension;
    const Mesh block = make_layers(dim, dim == 2 ? Numbers{1.0} : Numbers{1.0, 1.0},
                                   dim == 2 ? Indices{n} : Indices{n, n}, Numbers{1.0}, Indices{n}, type);
    Written w{dim, type, {block.nodes().begin(), block.nodes().end()}, {}, {}};
    for (std::int64_t c = 0; c < block.cell_count(); ++c) {
        std::array<std::int64_t, 3> box{};
        for (std::size_t k = 0; k < index(dim); ++k) {
            double sum = 0.0;
            for (int a = 0; a < topology(type).corners; ++a) sum += block.node(block.cell(c)[index(a)])[k];
            box[k] = static_cast<std::int64_t>(sum / topology(type).corners * static_cast<double>(n));
        }
        w.cells.insert(w.cells.end(), block.cell(c).begin(), block.cell(c).end());
        w.labels.push_back(label_of(box));
    }
    return w;
}

// A T: the lower half, and two bodies on top of it.
std::int32_t tee(const std::array<std::int64_t, 3>& box, std::int64_t n, int dim) {
    if (box[index(dim - 1)] < n / 2) return 4;
    return box[0] < n / 2 ? 7 : 2;
}
std::int32_t octants(const std::array<std::int64_t, 3>& box, std::int64_t n) {
    return static_cast<std::int32_t>(2 * box[0] / n + 2 * (2 * box[1] / n) + 4 * (2 * box[2] / n));
}
// 2 x 2 (x 2) pieces of body 1 within body 0, on a grid of 9 boxes in each direction: no piece touches another or the
// outside.
std::int32_t fibres(const std::array<std::int64_t, 3>& box, int dim) {
    for (std::size_t k = 0; k < index(dim); ++k)
        if (box[k] % 4 == 0) return 0;
    return 1;
}

// The common faces of the cells of two labels, and the nodes on these faces.
struct Shared {
    std::size_t faces = 0;
    std::set<std::int64_t> nodes;
};
std::map<std::pair<std::int32_t, std::int32_t>, Shared> shared(const Written& w) {
    std::map<Indices, std::pair<std::int32_t, Indices>> open;
    std::map<std::pair<std::int32_t, std::int32_t>, Shared> found;
    const CellTopology& shape = topology(w.type);
    for (std::size_t c = 0; c < w.labels.size(); ++c) {
        for (std::size_t f = 0; f < index(shape.faces); ++f) {
            Indices all;
            for (const int k : shape.face[f].all()) all.push_back(w.cells[c * w.per_cell() + index(k)]);
            Indices key(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shape.corners_of(shape.face[f]).size()));
            std::sort(key.begin(), key.end());
            const auto other = open.find(key);
            if (other == open.end()) {
                open.emplace(key, std::pair(w.labels[c], all));
            } else if (other->second.first != w.labels[c]) {
                Shared& s = found[std::minmax(other->second.first, w.labels[c])];
                ++s.faces;
                s.nodes.insert(all.begin(), all.end());
            }
        }
    }
    return found;
}

void expect_doubled(const Written& w, const Mesh& mesh) {
    std::set<std::pair<std::int32_t, std::int64_t>> wanted;
    for (std::size_t i = 0; i < w.cells.size(); ++i) wanted.emplace(w.labels[i / w.per_cell()], w.cells[i]);
    const auto before = static_cast<std::int64_t>(w.nodes.size()) / w.dimension;
    std::set<std::int64_t> used(w.cells.begin(), w.cells.end());
    ck_assert_int_eq(mesh.node_count(), before + static_cast<std::int64_t>(wanted.size() - used.size()));
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        const std::int64_t origin = mesh.node_origin(n);
        ck_assert(n < before ? origin == n : origin >= 0 && origin < before);
        ck_assert(std::ranges::equal(mesh.node(n), mesh.node(origin)));
        if (mesh.node_body(n) >= 0) ck_assert_uint_eq(wanted.erase({mesh.body_label(mesh.node_body(n)), origin}), 1);
    }
    ck_assert(wanted.empty());
    for (std::size_t i = 0; i < w.cells.size(); ++i) {
        const std::size_t c = i / w.per_cell();
        const std::int64_t node = mesh.cell(static_cast<std::int64_t>(c))[i % w.per_cell()];
        ck_assert_int_eq(mesh.node_origin(node), w.cells[i]);
        ck_assert_int_eq(mesh.body_label(mesh.node_body(node)), w.labels[c]);
    }
}

void expect_joined(const Written& w, Mesh& mesh) {
    const auto wanted = shared(w);
    ck_assert_int_eq(add_all_interfaces(mesh, 0.0), static_cast<std::int64_t>(wanted.size()));
    ck_assert_uint_eq(mesh.interfaces().size(), wanted.size());
    std::size_t k = 0;
    for (const auto& [labels, s] : wanted) {
        const InterfaceGeometry& i = mesh.interfaces()[k++];
        ck_assert_int_eq(mesh.body_label(i.body_a), labels.first);
        ck_assert_int_eq(mesh.body_label(i.body_b), labels.second);
        ck_assert_int_eq(i.face_count(), static_cast<std::int64_t>(s.faces));
        std::set<std::int64_t> met;
        for (std::size_t p = 0; p < i.node_a.size(); ++p) {
            ck_assert_int_eq(mesh.node_origin(i.node_a[p]), mesh.node_origin(i.node_b[p]));
            ck_assert_int_eq(mesh.node_body(node_of_pair(mesh, i.node_a[p])), i.body_a);
            ck_assert_int_eq(mesh.node_body(node_of_pair(mesh, i.node_b[p])), i.body_b);
            met.insert(mesh.node_origin(i.node_a[p]));
        }
        ck_assert(met == s.nodes);
    }
    ck_assert_int_eq(add_all_interfaces(mesh, 0.0), 0);
}

std::vector<LabelOf> layouts(int dim, std::int64_t n) {
    std::vector<LabelOf> list;
    list.push_back([=](const auto& box) { return tee(box, n, dim); });
    list.push_back([=](const auto& box) { return octants(box, n); });
    list.push_back([](const auto& box) { return static_cast<std::int32_t>(box[0] + 10 * box[1] + 100 * box[2]); });
    return list;
}

TEST(bodies_that_meet) {
    for (const CellType type : all_types) {
        for (const LabelOf& label_of : layouts(topology(type).dimension, 4)) {
            const Written w = written(type, 4, label_of);
            Mesh mesh = w.doubled();
            expect_doubled(w, mesh);
            expect_joined(w, mesh);
        }
    }
}

// On the line where the three bodies of a T meet, each two of them have a pair, and the areas are those of the blocks.
TEST(triple_junction) {
    for (const CellType type : all_types) {
        const int dim = topology(type).dimension;
        Mesh mesh = written(type, 4, [&](const auto& box) { return tee(box, 4, dim); }).doubled();
        ck_assert_int_eq(add_all_interfaces(mesh, 0.0), 3);
        std::size_t at_junction = 0;
        for (const InterfaceGeometry& i : mesh.interfaces()) {
            double area = 0.0;
            for (std::size_t p = 0; p < i.node_a.size(); ++p) {
                area += i.weight[p];
                const auto x = mesh.node(i.node_a[p]);
                if (x[0] == 0.5 && x[index(dim - 1)] == 0.5) ++at_junction;
            }
            ck_assert(std::abs(area - 0.5) < 1e-14);
        }
        const std::size_t line = dim == 2                                         ? 1
                                 : topology(type).nodes == topology(type).corners ? 5  // 4 cells along it
                                                                                  : 9;
        ck_assert_uint_eq(at_junction, 3 * line);
    }
}

// Bodies inside another body, with one label and several pieces.
TEST(surrounded_pieces) {
    for (const CellType type : {CellType::tri6, CellType::quad4, CellType::hex8, CellType::tet10}) {
        const int dim = topology(type).dimension;
        const Written w = written(type, 9, [&](const auto& box) { return fibres(box, dim); });
        Mesh mesh = w.doubled();
        expect_doubled(w, mesh);
        expect_joined(w, mesh);
        ck_assert_uint_eq(mesh.interfaces().size(), 1);
        double area = 0.0;
        for (const double weight : mesh.interfaces()[0].weight) area += weight;
        const double side = 3.0 / 9.0;
        ck_assert(std::abs(area - (dim == 2 ? 4 * 4 * side : 8 * 6 * side * side)) < 1e-12);
        for (std::size_t p = 0; p < mesh.interfaces()[0].node_a.size(); ++p) {  // from the matrix into the piece
            const auto x = mesh.node(mesh.interfaces()[0].node_a[p]);
            double inward = 0.0;
            for (std::size_t k = 0; k < index(dim); ++k)
                inward +=
                    mesh.interfaces()[0].frame[p * index(dim * dim) + k] * ((x[k] < 0.5 ? 2.5 : 6.5) / 9.0 - x[k]);
            ck_assert(inward > 0.0);
        }
    }
}

// Cells added in several calls, also of other types, and a body whose cells come before and after those of another.
TEST(several_calls) {
    for (const CellType type : all_types) {
        const Written w = written(type, 4, [](const auto& box) { return static_cast<std::int32_t>(box[0] % 2); });
        Mesh mesh = w.empty();
        for (std::size_t c = 0; c < w.labels.size(); ++c)
            mesh.add_conforming_cells(type, std::span(w.cells).subspan(c * w.per_cell(), w.per_cell()),
                                      std::span(w.labels).subspan(c, 1));
        expect_doubled(w, mesh);
        expect_joined(w, mesh);
    }
    // Quadrilaterals of bodies 0 and 2 and triangles of body 1 between them.
    Mesh mesh(2, Numbers{0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2, 2, 2});
    mesh.add_conforming_cells(CellType::quad4, Indices{0, 1, 4, 3}, Labels{0});
    ck_assert_int_eq(mesh.node_count(), 9);
    mesh.add_conforming_cells(CellType::tri3, Indices{1, 2, 4, 2, 5, 4, 3, 4, 6}, Labels{1, 1, 1});
    ck_assert_int_eq(mesh.node_count(), 12);
    mesh.add_conforming_cells(CellType::quad4, Indices{4, 5, 8, 7}, Labels{2});
    ck_assert_int_eq(mesh.node_count(), 14);
    ck_assert_int_eq(mesh.node_origin(12), 4);
    ck_assert_int_eq(mesh.node_origin(13), 5);
    // A copy may stand for its original.
    mesh.add_conforming_cells(CellType::tri3, Indices{10, 7, 6}, Labels{1});
    ck_assert_int_eq(mesh.node_count(), 15);
    ck_assert_int_eq(mesh.cell(5)[0], mesh.cell(1)[2]);
    // Bodies 0 and 2 share a corner only.
    ck_assert_int_eq(add_all_interfaces(mesh, 0.0), 2);
    for (const InterfaceGeometry& i : mesh.interfaces()) ck_assert_int_eq(i.face_count(), 2);
}

// Refused cells leave everything unchanged: what follows gives the same mesh as without them.
TEST(refused_cells) {
    for (const CellType type : all_types) {
        const Written w = written(type, 2, [](const auto& box) { return static_cast<std::int32_t>(box[0]); });
        Mesh mesh = w.empty();
        const auto refused = [&](std::int32_t status, const char* part, auto&& spoil) {
            Indices cells = w.cells;
            Labels labels = w.labels;
            spoil(cells, labels);
            ck_assert_refused(status, part, mesh.add_conforming_cells(type, cells, labels));
            ck_assert_int_eq(mesh.node_count() * w.dimension, static_cast<std::int64_t>(w.nodes.size()));
            ck_assert_int_eq(mesh.cell_count(), 0);
            ck_assert_int_eq(mesh.body_count(), 0);
            for (std::int64_t n = 0; n < mesh.node_count(); ++n) ck_assert_int_eq(mesh.node_body(n), -1);
        };
        refused(DELAM_ERROR_ARGUMENT, "must be in 0..",
                [&](Indices& cells, Labels&) { cells.back() = mesh.node_count(); });
        refused(DELAM_ERROR_ARGUMENT, "must be in 0..", [](Indices& cells, Labels&) { cells.back() = -1; });
        refused(DELAM_ERROR_ARGUMENT, "body -3", [](Indices&, Labels& labels) { labels.back() = -3; });
        refused(DELAM_ERROR_ARGUMENT, "body labels for", [](Indices&, Labels& labels) { labels.pop_back(); });
        refused(DELAM_ERROR_MESH, "degenerate",
                [&](Indices& cells, Labels&) { cells[cells.size() - 1] = cells[cells.size() - w.per_cell()]; });
        mesh.add_conforming_cells(type, w.cells, w.labels);
        expect_doubled(w, mesh);
        const std::int64_t nodes = mesh.node_count();
        Indices more(w.cells.begin(), w.cells.begin() + static_cast<std::ptrdiff_t>(w.per_cell()));
        std::swap(more[0], more[1]);
        ck_assert_refused(DELAM_ERROR_MESH, "inverted", mesh.add_conforming_cells(type, more, Labels{9}));
        ck_assert_int_eq(mesh.node_count(), nodes);
        ck_assert_int_eq(add_all_interfaces(mesh, 0.0), 1);
        ck_assert_refused(DELAM_ERROR_STATE, "has an interface already",
                          mesh.add_conforming_cells(type, more, Labels{1}));
        // The rule for plain cells stays.
        Mesh plain = w.empty();
        ck_assert_refused(DELAM_ERROR_MESH, "belongs to bodies", plain.add_cells(type, w.cells, w.labels));
    }
}

// Each two bodies get the interface that they would get alone; existing interfaces are skipped; thousands are no
// problem.
TEST(all_interfaces) {
    for (const CellType type : all_types) {
        const Written w = written(type, 4, [&](const auto& box) { return octants(box, 4); });
        Mesh all = w.doubled();
        Mesh single = w.doubled();
        add_interface(single, 1, 0, 0.0);
        const std::int64_t rest = add_all_interfaces(all, 0.0) - 1;
        ck_assert_int_eq(add_all_interfaces(single, 0.0), rest);
        for (const InterfaceGeometry& i : all.interfaces()) {
            Mesh alone = w.doubled();
            add_interface(alone, all.body_label(i.body_a), all.body_label(i.body_b), 0.0);
            const InterfaceGeometry& one = alone.interfaces()[0];
            ck_assert(one.weight == i.weight && one.frame == i.frame && one.face == i.face);
            // Tied nodes have numbers in the order in which interfaces were made.
            for (std::size_t p = 0; p < i.node_a.size(); ++p) {
                ck_assert_int_eq(node_of_pair(alone, one.node_a[p]), node_of_pair(all, i.node_a[p]));
                ck_assert_int_eq(node_of_pair(alone, one.node_b[p]), node_of_pair(all, i.node_b[p]));
            }
        }
    }
    const std::int64_t n = 12;
    Mesh grains = written(CellType::hex8, n, [=](const auto& box) {
                      return static_cast<std::int32_t>(box[0] + n * (box[1] + n * box[2]));
                  }).doubled();
    ck_assert_int_eq(grains.node_count(), 8 * n * n * n);
    ck_assert_int_eq(add_all_interfaces(grains, 0.0), 3 * n * n * (n - 1));
    Mesh apart = written(CellType::quad4, 4, [](const auto& box) { return box[0] < 2 ? 0 : 1; }).empty();
    ck_assert_int_eq(add_all_interfaces(apart, 0.0), 0);
    for (const double bad : {-0.1, 0.5, std::nan("")})
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "[0, 0.5)", add_all_interfaces(apart, bad));
}

// Two cells on top of one, beside bodies that match: refused as a whole.
TEST(unmatched_among_matched) {
    Mesh mesh(2, Numbers{0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 1, 0, 1, 1, 1, 1, 2, 0, 2, 0.5, 1, 0.5, 2});
    mesh.add_conforming_cells(CellType::quad4, Indices{0, 1, 2, 3, 1, 4, 5, 2, 6, 10, 11, 9, 10, 7, 8, 11},
                              Labels{0, 1, 2, 2});
    ck_assert_refused(DELAM_ERROR_MESH, "bodies 0 and 2: a face of cell", add_all_interfaces(mesh, 0.0));
    ck_assert_uint_eq(mesh.interfaces().size(), 0);
    ck_assert_int_eq(add_interface(mesh, 0, 1, 0.0), 0);
}

}  // namespace
