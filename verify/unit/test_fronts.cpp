// SPDX-License-Identifier: BSD-3-Clause
// Fronts, new cracks and rings on interfaces that are small enough to list them by hand.
#include <algorithm>
#include <set>

#include "check.hpp"
#include "evolution/search/fronts.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"

using namespace delam;

namespace {

using Ring = std::vector<std::int64_t>;

// Layers of squares or cubes with every interface between them; all pairs adhere and are equally loaded.
struct Stack {
    Mesh mesh;
    Law law;
    PairLaws pairs;
    PairGraph graph;
    std::vector<double> adhesion, jump;
    std::vector<Toughness> toughness;

    Stack(int dimension, std::vector<std::int64_t> divisions, std::size_t layers, CellType type)
        : mesh(make_layers(dimension, std::vector<double>(divisions.begin(), divisions.end()), divisions,
                           std::vector<double>(layers, 1.0), std::vector<std::int64_t>(layers, 1), type)) {
        for (std::size_t i = 0; i + 1 < layers; ++i)
            add_interface(mesh, static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1), 1e-6);
        law.normal_stiffness = law.tangential_stiffness = 1.0;
        law.normal_onset = law.tangential_onset = law.normal_toughness = law.tangential_toughness = 1.0;
        pairs.dimension = dimension;
        for (const InterfaceGeometry& g : mesh.interfaces())
            for (const double w : g.weight) {
                pairs.law.push_back(&law);
                pairs.weight.push_back(w);
                pairs.fixed.emplace_back(law.toughness(0.0));
            }
        graph = PairGraph(mesh.interfaces());
        adhesion.assign(pairs.weight.size(), 1.0);
        toughness.assign(adhesion.size(), law.toughness(0.0));
        jump.assign(adhesion.size() * static_cast<std::size_t>(dimension), 0.0);
        for (std::size_t p = 0; p < adhesion.size(); ++p) load(p, 1.0);
    }
    Stack(const Stack&) = delete;
    void load(std::size_t pair, double opening) { jump[pair * static_cast<std::size_t>(pairs.dimension)] = opening; }
    void debond(std::initializer_list<std::size_t> list) {
        for (const std::size_t p : list) adhesion[p] = 0.0;
    }
    std::vector<std::uint8_t> adhering() const { return adhering_pairs(pairs, adhesion, toughness); }
    std::vector<Front> fronts(std::size_t seeds = 0) const {
        return find_fronts(graph, pairs, adhering(), toughness, jump, seeds);
    }
    std::vector<Ring> rings_of(const Front& front) const { return rings(graph, adhering(), front); }
    std::vector<Ring> of(bool nucleation, std::size_t seeds = 0) const {
        std::vector<Ring> found;
        for (const Front& f : fronts(seeds))
            if (f.nucleation == nucleation) found.push_back(f.pairs);
        return found;
    }
};

void expect_rings(const std::vector<Ring>& found, const std::vector<Ring>& expected) {
    ck_assert_uint_eq(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        ck_assert_uint_eq(found[i].size(), expected[i].size());
        for (std::size_t k = 0; k < found[i].size(); ++k) ck_assert_int_eq(found[i][k], expected[i][k]);
    }
}

TEST(neighbours_in_the_plane) {
    const Stack s(2, {4}, 3, CellType::quad4);
    ck_assert_uint_eq(s.graph.size(), 10);
    for (std::size_t p = 0; p < 10; ++p) {
        const std::size_t ends = p % 5 == 0 || p % 5 == 4 ? 1 : 2;
        ck_assert_uint_eq(s.graph.neighbours(p).size(), ends);
        ck_assert_int_eq(s.graph.interface_of(p), p < 5 ? 0 : 1);
        for (const std::int64_t q : s.graph.neighbours(p))
            ck_assert_int_eq(std::abs(q - static_cast<std::int64_t>(p)), 1);
    }
    ck_assert_int_eq(s.graph.first_pair(0), 0);
    ck_assert_int_eq(s.graph.first_pair(1), 5);
}

// Being neighbours is mutual; a pair is not its own neighbour, never that of another interface, and every pair has one.
TEST(neighbours_of_all_cells) {
    const CellType types[] = {CellType::tri3, CellType::quad4, CellType::tri6,  CellType::quad8,
                              CellType::tet4, CellType::hex8,  CellType::tet10, CellType::hex20};
    for (const CellType type : types) {
        const bool plane =
            type == CellType::tri3 || type == CellType::quad4 || type == CellType::tri6 || type == CellType::quad8;
        const Stack s(plane ? 2 : 3, plane ? std::vector<std::int64_t>{3} : std::vector<std::int64_t>{3, 2}, 3, type);
        for (std::size_t p = 0; p < s.graph.size(); ++p) {
            ck_assert(!s.graph.neighbours(p).empty());
            for (const std::int64_t q : s.graph.neighbours(p)) {
                ck_assert_int_ne(q, static_cast<std::int64_t>(p));
                ck_assert_int_eq(s.graph.interface_of(static_cast<std::size_t>(q)), s.graph.interface_of(p));
                const auto back = s.graph.neighbours(static_cast<std::size_t>(q));
                ck_assert(std::count(back.begin(), back.end(), static_cast<std::int64_t>(p)) == 1);
            }
        }
        // The rings around one pair reach each pair of its interface once.
        std::set<std::int64_t> reached;
        std::size_t count = 0;
        for (const Ring& ring : s.rings_of({0, true, {0}})) {
            reached.insert(ring.begin(), ring.end());
            count += ring.size();
        }
        ck_assert_uint_eq(reached.size(), count);
        ck_assert_uint_eq(count, s.graph.size() / 2);
    }
}

TEST(fronts_in_the_plane) {
    Stack s(2, {7}, 3, CellType::quad4);
    s.debond({0, 1, 5, 6, 15});
    // Interface 0: pairs 2..4 between two notches, 7 at the end; interface 1: pairs 8..14.
    expect_rings(s.of(false), {{2}, {4}, {7}, {14}});
    expect_rings(s.of(true), {{8}});
    expect_rings(s.rings_of({0, false, {2}}), {{2}, {3}, {4}});
    expect_rings(s.rings_of({0, false, {4}}), {{4}, {3}, {2}});
    expect_rings(s.rings_of({0, false, {7}}), {{7}});
    const auto up = s.rings_of({1, false, {14}});
    ck_assert_uint_eq(up.size(), 7);
    ck_assert_int_eq(up.back().front(), 8);
    // One pair between two notches is one front; two neighbours are one, too.
    s.debond({3});
    expect_rings(s.of(false), {{2}, {4}, {7}, {14}});
    s.adhesion[3] = 1.0;
    s.debond({2});
    expect_rings(s.of(false), {{3, 4}, {7}, {14}});
}

TEST(nothing_left_or_nothing_broken) {
    Stack s(2, {3}, 2, CellType::quad4);
    ck_assert(s.of(false).empty());
    expect_rings(s.of(true), {{0}, {3}});
    s.debond({0, 1, 2, 3});
    ck_assert(s.fronts(2).empty());
}

// A permanently bonded pair is neither a front nor a crack, and is no front beside debonded pairs.
TEST(bonded_pairs_stay_out) {
    Stack s(2, {4}, 3, CellType::quad4);
    for (std::size_t p = 0; p < 5; ++p) s.pairs.law[p] = nullptr;
    s.debond({0, 1, 5});
    expect_rings(s.of(false), {{6}});
    expect_rings(s.of(true, 3), {{9}});
    ck_assert_uint_eq(s.rings_of({1, false, {6}}).size(), 4);
}

// New cracks begin where the load is the largest fraction of the onset, largest first, a limited number per interface,
// and not beside a front.
TEST(new_cracks) {
    Stack s(2, {20}, 3, CellType::quad4);
    for (std::size_t p = 0; p < s.adhesion.size(); ++p) s.load(p, 0.0);
    s.load(5, 2.0);
    s.load(10, 3.0);
    s.load(15, 1.0);
    s.load(21 + 7, 0.5);
    const std::vector<Ring> ends{{0}, {20}, {21}, {41}};
    const auto with = [&](std::initializer_list<std::int64_t> more) {
        std::vector<Ring> all = ends;
        for (const std::int64_t p : more) all.push_back({p});
        return all;
    };
    expect_rings(s.of(true, 0), ends);
    expect_rings(s.of(true, 2), with({10, 5, 28}));
    expect_rings(s.of(true, 9), with({10, 5, 15, 28}));
    // The toughness matters: a weak place comes first.
    s.toughness[15].onset = 0.01;
    expect_rings(s.of(true, 1), with({15, 28}));
    // A plateau counts as one place.
    s.load(16, 1.0);
    s.toughness[16].onset = 0.01;
    expect_rings(s.of(true, 9), with({15, 10, 5, 28}));
    s.debond({9});
    expect_rings(s.of(false), {{8}, {10}});
    expect_rings(s.of(true, 9), with({15, 5, 28}));
}

// A round hole in a plane: one closed front; rings grow around it. Two holes: two fronts.
TEST(holes_in_an_area) {
    Stack s(3, {6, 6}, 2, CellType::hex8);
    const auto at = [&](double x, double y) {
        const InterfaceGeometry& g = s.mesh.interfaces()[0];
        for (std::size_t p = 0; p < g.weight.size(); ++p) {
            const double* node = s.mesh.nodes().data() + 3 * g.node_a[p];
            if (std::abs(node[0] - x) < 1e-9 && std::abs(node[1] - y) < 1e-9) return p;
        }
        ck_abort_msg("no pair");
        return std::size_t{0};
    };
    s.debond({at(3, 3)});
    auto fronts = s.of(false);
    ck_assert_uint_eq(fronts.size(), 1);
    ck_assert_uint_eq(fronts[0].size(), 8);
    const auto grown = s.rings_of({0, false, fronts[0]});
    ck_assert_uint_eq(grown.size(), 3);
    ck_assert_uint_eq(grown[1].size(), 16);
    ck_assert_uint_eq(grown[2].size(), 24);
    s.adhesion[at(3, 3)] = 1.0;
    s.debond({at(0, 0), at(6, 6)});
    ck_assert_uint_eq(s.of(false).size(), 2);
    s.debond({at(0, 6), at(6, 0)});
    ck_assert_uint_eq(s.of(false).size(), 4);
    ck_assert(s.of(true, 0).empty());  // an area has no ends
}

}  // namespace
