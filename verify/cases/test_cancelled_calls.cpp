// SPDX-License-Identifier: BSD-3-Clause
// Every call that goes over all cells, nodes or faces polls for cancellation every few hundred of them, so that the
// time until a cancel takes effect does not grow with the mesh; a cancelled call leaves everything unchanged. The test
// counts polls and reads no clock.
#include <functional>
#include <vector>

#include "delam/delam.h"
#include "support.hpp"

namespace {

using cases::expect;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// Counts polls, and cancels at one of them, by its result or by delam_context_cancel.
struct Watch {
    delam_context* context = nullptr;
    std::int64_t polls = 0, stop_at = 0;
    bool by_request = false, nameless = false;
    static std::int32_t poll(const char* stage, std::int64_t, std::int64_t, void* user) {
        auto& w = *static_cast<Watch*>(user);
        w.nameless = w.nameless || stage == nullptr || *stage == '\0';
        if (++w.polls != w.stop_at) return 0;
        if (!w.by_request) return 1;
        delam_context_cancel(w.context);
        return 0;
    }
};

struct Handles {
    delam_context* context = nullptr;
    delam_mesh *mesh = nullptr, *other = nullptr;
    delam_problem *problem = nullptr, *other_problem = nullptr;
    delam_law* law = nullptr;
    delam_solver* solver = nullptr;
    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        delam_solver_destroy(&solver);
        delam_problem_destroy(&problem);
        delam_problem_destroy(&other_problem);
        delam_law_destroy(&law);
        delam_mesh_destroy(&mesh);
        delam_mesh_destroy(&other);
        delam_context_destroy(&context);
    }
};

template <class T>
void append(std::string& text, const std::vector<T>& values) {
    text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string print_of(const delam_mesh* mesh) {
    if (mesh == nullptr) return "none";
    std::int32_t dimension = 0;
    std::int64_t nodes = 0, cells = 0, bodies = 0, interfaces = 0, entries = 0, ties = 0;
    delam_mesh_size(mesh, &dimension, &nodes, &cells, &bodies, &interfaces);
    std::string text = std::to_string(bodies) + " " + std::to_string(interfaces);
    std::vector<double> places(at(nodes * dimension));
    std::vector<std::int32_t> labels(at(nodes)), of_cells(at(cells));
    std::vector<std::int64_t> origins(at(nodes));
    expect(delam_mesh_nodes(mesh, nodes * dimension, places.data()) == DELAM_OK, "nodes");
    expect(delam_mesh_node_bodies(mesh, nodes, labels.data()) == DELAM_OK, "bodies");
    expect(delam_mesh_node_origins(mesh, nodes, origins.data()) == DELAM_OK, "origins");
    expect(delam_mesh_cells(mesh, nullptr, of_cells.data(), nullptr, 0, nullptr, &entries) == DELAM_OK, "cells");
    std::vector<std::int64_t> connectivity(at(entries));
    expect(delam_mesh_cells(mesh, nullptr, nullptr, nullptr, entries, connectivity.data(), nullptr) == DELAM_OK,
           "cells");
    expect(delam_mesh_node_ties(mesh, &ties, nullptr, nullptr, nullptr, nullptr, nullptr) == DELAM_OK, "ties");
    text += " " + std::to_string(ties) + " ";
    append(text, places), append(text, labels), append(text, of_cells), append(text, origins),
        append(text, connectivity);
    for (std::int64_t i = 0; i < interfaces; ++i) {
        std::int64_t pairs = 0;
        delam_mesh_interface_size(mesh, i, nullptr, nullptr, &pairs, nullptr, nullptr);
        std::vector<std::int64_t> a(at(pairs)), b(at(pairs));
        expect(delam_mesh_interface_pairs(mesh, i, a.data(), b.data(), nullptr, nullptr) == DELAM_OK, "pairs");
        append(text, a), append(text, b);
    }
    return text;
}

std::string print_of(const delam_problem* problem) {
    char hash[17] = {};
    std::int64_t rows = 0, entries = 0;
    expect(delam_problem_hash(problem, hash) == DELAM_OK, "hash");
    expect(delam_problem_constraints(problem, &rows, &entries, nullptr, nullptr, nullptr, nullptr, nullptr) == DELAM_OK,
           "constraints");
    return std::string(hash) + " " + std::to_string(rows) + " " + std::to_string(entries);
}

std::string print_of(delam_solver* solver) {
    std::int64_t size = 0;
    delam_solver_save(solver, 0, nullptr, &size);
    std::vector<std::uint8_t> bytes(at(size));
    expect(delam_solver_save(solver, size, bytes.data(), &size) == DELAM_OK, "save");
    std::string text;
    append(text, bytes);
    return text;
}

class Host {
public:
    explicit Host(Watch& watch) : watch_(watch) {
        expect(delam_context_create(&h.context) == DELAM_OK, "a context");
        watch.context = h.context;
        expect(delam_context_set_progress(h.context, Watch::poll, &watch) == DELAM_OK, "a callback");
    }
    void require(std::int32_t status, const char* name) const {
        expect(status == DELAM_OK,
               std::string(name) + ": " + delam_status_name(status) + ": " + delam_context_message(h.context));
    }
    // Cancelled at some polls, the first ones one by one, the call changes nothing; at last it succeeds, with a poll
    // for every 256 of `passes`.
    void call(const char* name, std::int64_t passes, const std::function<std::string()>& print,
              const std::function<std::int32_t()>& call) {
        stopped(name, passes, print, call, false);
    }
    // The same for a call that only reads: it ignores the callback's result.
    void read(const char* name, std::int64_t passes, const std::function<std::string()>& print,
              const std::function<std::int32_t()>& call) {
        watch_.by_request = false;
        watch_.polls = 0;
        watch_.stop_at = 1;
        require(call(), name);
        expect(watch_.polls >= 1, std::string(name) + " does not poll");
        if (again) again();
        stopped(name, passes, print, call, true);
    }
    // Makes an object discard what it has computed for a call.
    std::function<void()> again;
    void stopped(const char* name, std::int64_t passes, const std::function<std::string()>& print,
                 const std::function<std::int32_t()>& call, bool reads) {
        const std::string before = print();
        std::int64_t stopped = 0;
        for (std::int64_t stop = 1;; stop = stop < 4 ? stop + 1 : stop + stop / 2) {
            watch_.polls = 0;
            watch_.stop_at = stop;
            watch_.by_request = reads || !watch_.by_request;
            const std::int32_t status = call();
            watch_.stop_at = 0;
            if (watch_.polls < stop) {
                require(status, name);
                break;
            }
            ++stopped;
            const std::string where = std::string(name) + " stopped at poll " + std::to_string(stop);
            expect(status == DELAM_CANCELLED,
                   where + ": " + delam_status_name(status) + ": " + delam_context_message(h.context));
            expect(print() == before, where + ": something has changed");
        }
        const std::string count =
            std::string(name) + ": " + std::to_string(watch_.polls) + " polls, " + std::to_string(passes) + " passes";
        expect(stopped > 0 && watch_.polls >= passes / 256 && !watch_.nameless, count);
    }
    Handles h;

private:
    Watch& watch_;
};

std::string nothing() { return ""; }

// A block of two layers as the host provides it: its nodes, and one without cells after them.
struct Block {
    std::int32_t type = 0, dimension = 0;
    std::int64_t node_count = 0, cells = 0;
    std::vector<double> nodes, lengths;
    std::vector<std::int64_t> connectivity, body[2];  // nodes of each body
    std::vector<std::int32_t> labels;
};

Block make_block(Host& host, std::int32_t dimension) {
    Block b;
    b.dimension = dimension;
    b.type = dimension == 2 ? DELAM_QUAD4 : DELAM_HEX8;
    b.lengths = {4.0, 4.0};
    const std::int64_t divisions[] = {dimension == 2 ? 128 : 16, 16},
                       layers[] = {dimension == 2 ? 16 : 8, dimension == 2 ? 16 : 8};
    const double thickness[] = {1.0, 1.0};
    delam_mesh*& mesh = host.h.other;
    std::int64_t cells = dimension == 2 ? 128 * 32 : 16 * 16 * 16, entries = 0;
    host.call(
        "delam_mesh_create_layers", cells, [&] { return print_of(mesh); },
        [&] {
            return delam_mesh_create_layers(host.h.context, dimension, b.lengths.data(), divisions, 2, thickness,
                                            layers, b.type, &mesh);
        });
    delam_mesh_size(mesh, nullptr, &b.node_count, &b.cells, nullptr, nullptr);
    expect(b.cells == cells, "cells");
    b.nodes.resize(at(b.node_count * dimension));
    b.labels.resize(at(b.cells));
    host.require(delam_mesh_nodes(mesh, b.node_count * dimension, b.nodes.data()), "nodes");
    host.require(delam_mesh_cells(mesh, nullptr, b.labels.data(), nullptr, 0, nullptr, &entries), "cells");
    b.connectivity.resize(at(entries));
    host.require(delam_mesh_cells(mesh, nullptr, nullptr, nullptr, entries, b.connectivity.data(), nullptr), "cells");
    std::vector<std::int32_t> bodies(at(b.node_count));
    host.require(delam_mesh_node_bodies(mesh, b.node_count, bodies.data()), "bodies");
    for (std::int64_t n = 0; n < b.node_count; ++n) b.body[bodies[at(n)]].push_back(n);
    delam_mesh_destroy(&mesh);
    for (int d = 0; d < dimension; ++d) b.nodes.push_back(0.0);
    ++b.node_count;
    return b;
}

void build_meshes(Host& host, const Block& b) {
    delam_mesh*& mesh = host.h.mesh;
    const auto print = [&] { return print_of(mesh); };
    const auto new_mesh = [&](bool with_cells) {
        delam_mesh_destroy(&mesh);
        host.require(delam_mesh_create(host.h.context, b.dimension, b.node_count, b.nodes.data(), &mesh),
                     "delam_mesh_create");
        if (with_cells)
            host.require(delam_mesh_add_cells(mesh, b.type, b.cells, b.connectivity.data(), b.labels.data(), 0),
                         "cells");
    };
    std::int64_t index = -1;
    std::vector<std::int64_t> bottom;
    for (std::int64_t n = 0; n + 1 < b.node_count; ++n)
        if (b.nodes[at(n * b.dimension + b.dimension - 1)] == 0.0) bottom.push_back(n);
    std::vector<double> normals(bottom.size() * at(b.dimension), 0.0);
    for (std::size_t i = at(b.dimension) - 1; i < normals.size(); i += at(b.dimension)) normals[i] = 1.0;

    // Stripes of bodies across a mesh with common nodes: most nodes are doubled.
    new_mesh(false);
    std::vector<std::int32_t> stripes(at(b.cells));
    for (std::int64_t c = 0; c < b.cells; ++c) stripes[at(c)] = 2 * b.labels[at(c)] + static_cast<std::int32_t>(c % 2);
    host.call("delam_mesh_add_conforming_cells", 2 * b.cells, print, [&] {
        return delam_mesh_add_conforming_cells(mesh, b.type, b.cells, b.connectivity.data(), stripes.data(), 0);
    });
    host.call("delam_mesh_add_all_interfaces", b.cells, print,
              [&] { return delam_mesh_add_all_interfaces(mesh, 0.0, &index); });
    // One body of two halves that share no node.
    new_mesh(false);
    const std::vector<std::int32_t> one(at(b.cells), 0);
    host.require(delam_mesh_add_cells(mesh, b.type, b.cells, b.connectivity.data(), one.data(), 0), "cells");
    host.call("delam_mesh_add_seams", b.cells, print, [&] { return delam_mesh_add_seams(mesh, 0.0, &index); });
    // The same, with the halves a quarter apart.
    std::vector<double> apart = b.nodes;
    for (const std::int64_t n : b.body[1]) apart[at((n + 1) * b.dimension - 1)] += 0.25;
    delam_mesh_destroy(&mesh);
    host.require(delam_mesh_create(host.h.context, b.dimension, b.node_count, apart.data(), &mesh), "a mesh");
    host.require(delam_mesh_add_cells(mesh, b.type, b.cells, b.connectivity.data(), one.data(), 0), "cells");
    host.call("delam_mesh_add_self_contact", b.cells, print,
              [&] { return delam_mesh_add_self_contact(mesh, 0.5, &index); });
    new_mesh(true);
    host.call("delam_mesh_add_projected_interface", b.cells, print,
              [&] { return delam_mesh_add_projected_interface(mesh, 0, 1, 0.0, &index); });
    new_mesh(true);
    host.call("delam_mesh_add_mortar_interface", b.cells, print,
              [&] { return delam_mesh_add_mortar_interface(mesh, 0, 1, 0.0, &index); });
    host.call("delam_mesh_add_obstacle", b.cells / 2, print, [&] {
        return delam_mesh_add_obstacle(mesh, static_cast<std::int64_t>(bottom.size()), bottom.data(), normals.data(),
                                       nullptr, b.node_count - 1, 0, &index);
    });
    new_mesh(false);
    const auto count = static_cast<std::int64_t>(b.body[0].size());
    for (std::int32_t body = 0; body < 2; ++body)
        host.call("delam_mesh_add_host_body", count, print,
                  [&] { return delam_mesh_add_host_body(mesh, body, count, b.body[body].data(), 0); });
    const std::vector<double> ones(at(count * b.dimension), 1.0);
    host.call("delam_mesh_add_pairs", count, print, [&] {
        return delam_mesh_add_pairs(mesh, 0, 1, count, b.body[0].data(), b.body[1].data(), ones.data(), ones.data(), 0,
                                    0, nullptr, 0, &index);
    });
    new_mesh(false);
    host.call("delam_mesh_add_cells", b.cells, print,
              [&] { return delam_mesh_add_cells(mesh, b.type, b.cells, b.connectivity.data(), b.labels.data(), 0); });
    host.call("delam_mesh_add_interface", b.cells, print,
              [&] { return delam_mesh_add_interface(mesh, 0, 1, 0.0, &index); });
    const std::vector<double> lower(3, 0.0), upper{4.0, b.dimension == 2 ? 0.0 : 4.0, 0.0};
    std::vector<double> weights(at(b.node_count)), down(3, 0.0);
    std::vector<std::int64_t> nodes(at(b.node_count));
    down[at(b.dimension) - 1] = -1.0;
    host.read("delam_mesh_find_patch", b.cells, nothing, [&] {
        return delam_mesh_find_patch(mesh, -1, lower.data(), upper.data(), down.data(), b.node_count, nodes.data(),
                                     weights.data(), &index);
    });
}

// Loads on all nodes, and queries of a problem.
void build_problems(Host& host, const Block& b) {
    delam_problem*& problem = host.h.other_problem;
    const auto print = [&] { return print_of(problem); };
    const std::int64_t count = b.node_count - 1, control = b.node_count - 1;
    std::vector<std::int64_t> all(at(count));
    for (std::int64_t n = 0; n < count; ++n) all[at(n)] = n;
    const std::vector<double> ones(at(count * b.dimension), 1.0), x{1.0, 0.0, 0.0}, period{4.0, 0.0, 0.0};
    const double times[] = {0.0, 1.0}, strain[] = {1e-3, 1e-3, 0.0, 0.0, 0.0, 0.0};
    std::int64_t displacement = -1, force = -1, expansion = -1, gap = -1;
    host.require(delam_problem_create(host.h.context, host.h.mesh, &problem), "delam_problem_create");
    host.require(delam_problem_set_elastic(problem, -1, 1000.0, 0.3), "delam_problem_set_elastic");
    for (const auto& [name, pattern] : {std::pair{"u", &displacement}, {"f", &force}, {"e", &expansion}, {"g", &gap}})
        host.require(delam_problem_add_pattern(problem, name, 2, times, times, pattern), name);
    host.require(delam_problem_add_eigenstrain(problem, expansion, -1, strain), "delam_problem_add_eigenstrain");
    std::vector<std::int64_t> cells(at(b.cells));
    std::vector<double> axes;
    for (std::int64_t c = 0; c < b.cells; ++c) {
        cells[at(c)] = c;
        axes.insert(axes.end(), {1.0, 1e-4 * static_cast<double>(c), 0.0, 0.0, 1.0, 0.0});
    }
    host.call("delam_problem_set_orientation", b.cells, print,
              [&] { return delam_problem_set_orientation(problem, -1, b.cells, cells.data(), axes.data(), 0); });
    host.call("delam_problem_add_periodic", count, print,
              [&] { return delam_problem_add_periodic(problem, 1, period.data(), &control, 0.0, 0); });
    host.call("delam_problem_prescribe_nodes", count, print, [&] {
        return delam_problem_prescribe_nodes(problem, count, all.data(), x.data(), 1, &displacement, ones.data(), 0);
    });
    host.call("delam_problem_prescribe_mean", count, print, [&] {
        return delam_problem_prescribe_mean(problem, count, all.data(), ones.data(), x.data(), 1, &displacement,
                                            ones.data(), 0);
    });
    host.call("delam_problem_add_equation", count, print, [&] {
        return delam_problem_add_equation(problem, count, all.data(), ones.data(), 1, &displacement, ones.data(), 0);
    });
    host.call("delam_problem_add_forces", count, print,
              [&] { return delam_problem_add_forces(problem, force, count, all.data(), ones.data(), 0); });
    host.call("delam_problem_set_gaps", b.cells, print,
              [&] { return delam_problem_set_gaps(problem, 0, gap, nullptr, 0.0); });
    std::int64_t rows = 0, entries = 0, patterns = 0;
    char hash[17] = {};
    double energy[16] = {};
    std::vector<double> forces(at(b.node_count * b.dimension));
    host.read("delam_problem_hash", b.cells, nothing, [&] { return delam_problem_hash(problem, hash); });
    host.read("delam_problem_constraints", count, nothing, [&] {
        return delam_problem_constraints(problem, &rows, &entries, &patterns, nullptr, nullptr, nullptr, nullptr);
    });
    host.read("delam_problem_forces", b.cells, nothing,
              [&] { return delam_problem_forces(problem, expansion, b.node_count * b.dimension, forces.data()); });
    host.read("delam_problem_eigenstrain_energy", b.cells, nothing,
              [&] { return delam_problem_eigenstrain_energy(problem, 16, energy); });
}

// A scene of two layers, fixed at the bottom, pulled at the top.
void make_problem(Host& host, const Block& b, const char* reduction) {
    Handles& h = host.h;
    std::int64_t index = -1;
    host.require(delam_mesh_create(h.context, b.dimension, b.node_count, b.nodes.data(), &h.mesh), "delam_mesh_create");
    host.require(delam_mesh_add_cells(h.mesh, b.type, b.cells, b.connectivity.data(), b.labels.data(), 0), "cells");
    host.require(delam_mesh_add_interface(h.mesh, 0, 1, 0.0, &index), "interface");
    host.require(delam_problem_create(h.context, h.mesh, &h.problem), "delam_problem_create");
    host.require(delam_problem_set_elastic(h.problem, -1, 1000.0, 0.3), "delam_problem_set_elastic");
    host.require(delam_law_create(h.context, "piecewise-linear", &h.law), "delam_law_create");
    for (const auto& [key, value] : {std::pair{"normal_stiffness", 1e5},
                                     {"tangential_stiffness", 1e5},
                                     {"normal_onset", 1.0},
                                     {"tangential_onset", 1.0},
                                     {"normal_toughness", 2.0},
                                     {"tangential_toughness", 2.0}})
        host.require(delam_law_set(h.law, key, value), key);
    host.require(delam_problem_set_law(h.problem, 0, h.law), "delam_problem_set_law");
    std::vector<std::int64_t> bottom, top;
    for (std::int64_t n = 0; n + 1 < b.node_count; ++n) {
        const double height = b.nodes[at(n * b.dimension + b.dimension - 1)];
        if (height == 0.0) bottom.push_back(n);
        if (height == 2.0) top.push_back(n);
    }
    for (int d = 0; d < b.dimension; ++d) {
        std::vector<double> axis(3, 0.0);
        axis[at(d)] = 1.0;
        host.require(delam_problem_prescribe_nodes(h.problem, static_cast<std::int64_t>(bottom.size()), bottom.data(),
                                                   axis.data(), 0, nullptr, nullptr, 0),
                     "support");
    }
    const double times[] = {0.0, 1.0}, factors[] = {0.0, 1e-3};
    std::int64_t pattern = -1;
    std::vector<double> axis(3, 0.0), ones(top.size(), 1.0);
    axis[at(b.dimension) - 1] = 1.0;
    host.require(delam_problem_add_pattern(h.problem, "u", 2, times, factors, &pattern), "pattern");
    host.require(delam_problem_prescribe_nodes(h.problem, static_cast<std::int64_t>(top.size()), top.data(),
                                               axis.data(), 1, &pattern, ones.data(), 0),
                 "load");
    host.require(delam_problem_set_text(h.problem, "reduction", reduction), "reduction");
    host.require(delam_problem_set_number(h.problem, "subdomains", 4.0), "subdomains");
}

void read_problem(Host& host, const Block& b) {
    const Handles& h = host.h;
    const auto print = [&] { return print_of(h.problem); };
    std::int64_t rows = 0;
    double length = 0.0;
    host.again = [&] {  // the matrix requested last is kept
        host.require(delam_problem_body_matrix(h.problem, 1, &rows, nullptr, nullptr, nullptr, nullptr),
                     "delam_problem_body_matrix");
    };
    host.call("delam_problem_check", b.cells, print, [&] { return delam_problem_check(h.problem); });
    host.read("delam_problem_process_zone", b.cells, print,
              [&] { return delam_problem_process_zone(h.problem, 0, &length, nullptr); });
    host.read("delam_problem_propose", b.cells, print,
              [&] { return delam_problem_propose(h.problem, 0, 3.0, nullptr, nullptr, &length, nullptr); });
    host.read("delam_problem_body_matrix", b.cells / 2, print,
              [&] { return delam_problem_body_matrix(h.problem, 0, &rows, nullptr, nullptr, nullptr, nullptr); });
}

void read_solver(Host& host, const Block& b) {
    delam_solver*& solver = host.h.solver;
    host.require(delam_solver_create(host.h.problem, 0.0, &solver), "delam_solver_create");
    host.require(delam_solver_advance(solver, 0.5), "delam_solver_advance");
    const auto print = [&] { return print_of(solver); };
    const auto forget = [&] {  // recovered displacements belong to a state
        host.require(delam_solver_rollback(solver), "delam_solver_rollback");
        host.require(delam_solver_advance(solver, 0.5), "delam_solver_advance");
    };
    host.again = forget;
    const std::int64_t recovery = 2 * 256;  // around the sparse solve and between its halves, whatever its size
    const auto field = [&](const char* key, std::int64_t passes) {
        std::int64_t of = 0, columns = 0;
        host.require(delam_solver_field_shape(solver, key, -1, &of, &columns), key);
        std::vector<double> values(at(of * columns));
        host.read(key, passes, print, [&] { return delam_solver_field(solver, key, -1, of * columns, values.data()); });
    };
    double value = 0.0;
    for (const char* key : {"kkt_gap", "rotation_max", "kkt_equilibrium"}) {
        host.read(key, recovery, print, [&] { return delam_solver_value(solver, key, &value); });
        forget();
    }
    field("displacement", recovery);
    field("stress", b.cells);
    field("rotation", b.cells);
    std::int64_t unknowns = 0;
    if (delam_solver_condensed_size(solver, &unknowns, nullptr) == DELAM_OK) {
        std::vector<double> stiffness(at(unknowns * unknowns));
        host.read("delam_solver_condensed", unknowns * (unknowns / 128), print, [&] {
            return delam_solver_condensed(solver, unknowns * unknowns, stiffness.data(), nullptr, nullptr, nullptr,
                                          nullptr, nullptr, nullptr);
        });
    }
    host.again = [&] {  // how averages follow from jumps belongs to a solver
        delam_solver_destroy(&solver);
        host.require(delam_solver_create(host.h.problem, 0.0, &solver), "delam_solver_create");
        host.require(delam_solver_advance(solver, 0.5), "delam_solver_advance");
    };
    host.read("delam_solver_average", b.cells, print,
              [&] { return delam_solver_average(solver, -1, &value, nullptr, nullptr); });
}

LOOP_TEST(calls_that_build, 0, 2) {
    Watch watch;
    Host host(watch);
    const Block block = make_block(host, loop == 0 ? 2 : 3);
    build_meshes(host, block);
    build_problems(host, block);
}

LOOP_TEST(calls_that_read, 0, 3) {
    Watch watch;
    Host host(watch);
    const Block block = make_block(host, loop < 2 ? 2 : 3);
    make_problem(host, block, loop == 1 ? "feti" : "condensed");
    read_problem(host, block);
    read_solver(host, block);
}

// A request made earlier concerns the analysis: calls that build or read succeed, and the next step is cancelled.
TEST(waiting_request) {
    Watch watch;
    Host host(watch);
    delam_context* context = host.h.context;
    const Block block = make_block(host, 2);
    expect(delam_context_cancel(context) == DELAM_OK, "delam_context_cancel");
    make_problem(host, block, "condensed");
    host.require(delam_problem_check(host.h.problem), "delam_problem_check");
    host.require(delam_problem_plan(host.h.problem, nullptr, nullptr, nullptr), "delam_problem_plan");
    expect(delam_solver_create(host.h.problem, 0.0, &host.h.solver) == DELAM_CANCELLED && host.h.solver == nullptr,
           "the request has waited for delam_solver_create");
    // Now the request is consumed.
    host.require(delam_solver_create(host.h.problem, 0.0, &host.h.solver), "delam_solver_create");
    expect(delam_context_cancel(context) == DELAM_OK, "delam_context_cancel");
    delam_solver* like = nullptr;
    expect(delam_solver_create_like(host.h.problem, host.h.solver, 0.0, &like) == DELAM_CANCELLED && like == nullptr,
           "delam_solver_create_like");
    host.require(delam_solver_advance(host.h.solver, 0.5), "delam_solver_advance");
    expect(delam_context_cancel(context) == DELAM_OK, "delam_context_cancel");
    double value = 0.0;
    host.require(delam_solver_value(host.h.solver, "kkt_gap", &value), "kkt_gap");
    host.require(delam_solver_commit(host.h.solver), "delam_solver_commit");
    expect(delam_solver_advance(host.h.solver, 1.0) == DELAM_CANCELLED,
           "the request has waited for delam_solver_advance");
    host.require(delam_solver_advance(host.h.solver, 1.0), "delam_solver_advance");
}

}  // namespace
