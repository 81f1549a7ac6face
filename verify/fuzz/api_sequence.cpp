// SPDX-License-Identifier: BSD-3-Clause
// A sequence of calls of the public API over a few handles, some of them NULL or of another kind, with arguments that
// are plausible or hostile and callbacks that cancel and fail. A new function of the header is one more row of `calls`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "contract.hpp"
#include "delam/experimental.h"
#include "dense_engine.hpp"
#include "host_law.hpp"
#include "input.hpp"
#include "small_scene.hpp"

namespace {

using namespace fuzz;

constexpr std::size_t slots = 3;  // of each kind
constexpr int calls_at_most = 40;
constexpr std::int64_t nodes_at_most = 400;

template <class T>
void destroy_handle(T** handle);
template <>
void destroy_handle(delam_mesh** handle) {
    delam_mesh_destroy(handle);
}
template <>
void destroy_handle(delam_law** handle) {
    delam_law_destroy(handle);
}
template <>
void destroy_handle(delam_problem** handle) {
    delam_problem_destroy(handle);
}
template <>
void destroy_handle(delam_solver** handle) {
    delam_solver_destroy(handle);
}

// Handles of one kind, each with the host whose context it was made with.
template <class T>
struct Shelf {
    T* handle[slots] = {};
    Host* host[slots] = {};

    void put(std::size_t slot, T* made, Host* with) {
        destroy_handle(&handle[slot]);
        handle[slot] = made;
        host[slot] = with;
    }
    // Empty slots give NULL.
    T* pick(Input& in) const { return handle[static_cast<std::size_t>(in.below(slots))]; }
};

// An engine that problems of the library may have taken.
struct Engaged {
    explicit Engaged(Dense stiffness) : engine(std::move(stiffness)) {}
    DenseEngine engine;
    std::int64_t taken = 0;
};

// Two contexts, the objects made with them, and the data of the callbacks.
struct World {
    std::vector<std::unique_ptr<Engaged>> engines;
    std::vector<std::uint8_t> part;  // last output of delam_experimental_problem_part
    std::unique_ptr<Host> host[2] = {std::make_unique<Host>(), std::make_unique<Host>()};
    HostLaw host_law;
    Shelf<delam_mesh> mesh;
    Shelf<delam_law> law;
    Shelf<delam_problem> problem;
    Shelf<delam_solver> solver;
    // The running call: its subject, and the callbacks that it may call.
    Host* heard = nullptr;
    // The next call: number of polls until it is cancelled, and whether by the callback's answer; -1: not at all.
    std::int64_t interrupt_in = -1;
    bool interrupt_by_call = false;

    ~World() {
        for (std::size_t i = 0; i < slots; ++i) {
            delam_solver_destroy(&solver.handle[i]);
            delam_problem_destroy(&problem.handle[i]);
            delam_law_destroy(&law.handle[i]);
            delam_mesh_destroy(&mesh.handle[i]);
            expect(solver.handle[i] == nullptr && mesh.handle[i] == nullptr, "destroyed handles are NULL", "destroy");
        }
        for (const auto& each : engines)
            expect(each->engine.released == each->taken, "each engine that was taken is released once", "release");
    }
    // Engines fail and answer nonsense only while the call runs that is asked, not while objects are looked at.
    void wake(bool awake) {
        for (const auto& each : engines) each->engine.awake = awake, each->engine.failed &= !awake;
    }
    bool engine_failed() const {
        return std::any_of(engines.begin(), engines.end(), [](const auto& each) { return each->engine.failed; });
    }
    Host& any_host(Input& in) { return *host[in.below(2)]; }

    // Status of a call that makes an object; if it succeeds, the object goes into a slot.
    template <class T, class Make>
    std::int32_t make(Shelf<T>& shelf, Input& in, Host& with, Make&& call) {
        T* made = reinterpret_cast<T*>(this);  // must be overwritten
        T** out = in.seldom() ? nullptr : &made;
        const std::int32_t status = call(out);
        if (out == nullptr) {
            expect(status < 0, "no place for the object is an error", "create");
            return status;
        }
        const bool is_there = status == DELAM_OK || status == DELAM_NOT_CONVERGED;
        expect((made != nullptr) == is_there, "*out is NULL on error, and the object otherwise", "create");
        if (made != nullptr) shelf.put(static_cast<std::size_t>(in.below(slots)), made, &with);
        return status;
    }
};

// ---- arguments ------------------------------------------------------------------------------------------------------

const char* const value_keys[] = {"stored_bulk",
                                  "stored_interface",
                                  "dissipated",
                                  "work",
                                  "lower",
                                  "upper",
                                  "defect",
                                  "defect_slides",
                                  "front",
                                  "kkt_gap",
                                  "kkt_pressure",
                                  "kkt_complementarity",
                                  "kkt_equilibrium",
                                  "rotation_max",
                                  "damage_change",
                                  "linear_residual",
                                  "crack_length",
                                  "crack_length:0",
                                  "crack_length:7",
                                  "energy_release_rate",
                                  "front_mixity:1",
                                  "process_zone_length",
                                  "process_zone_pairs:0",
                                  "load:load",
                                  "reaction:load",
                                  "reaction:none",
                                  "search_gap",
                                  "debonded_length",
                                  "contact_pairs",
                                  "mixity_error",
                                  "increment_lower",
                                  "bulk_factorisations",
                                  "field_recoveries",
                                  "crack_length:",
                                  "crack_length:99999999999999999999",
                                  "crack_length:-1",
                                  "load:"};
const char* const field_keys[] = {"displacement", "stress", "rotation", "jump",    "traction",
                                  "adhesion",     "mixity", "contact",  "reaction"};
const char* const law_keys[] = {"normal_stiffness", "tangential_stiffness", "normal_onset",   "tangential_onset",
                                "normal_toughness", "tangential_toughness", "plateau",        "gradient",
                                "onset_exponent_1", "toughness_exponent_2", "onset_exponent", "toughness_exponent",
                                "criterion"};
const char* const law_kinds[] = {"piecewise-linear", "exponential", "trapezoidal", "tabulated", "griffith", "host"};
const char* const criteria[] = {"valoroso-champaney", "power", "benzeggagh-kenane"};
// Every word that some text option may be.
std::span<const char* const> option_texts() {
    static const std::set<std::string> texts = [] {
        std::set<std::string> words;
        for (std::int64_t i = 0; i < delam_option_count(); ++i) {
            const char *type = "", *range = "";
            delam_option_info(i, nullptr, &type, nullptr, nullptr, &range, nullptr);
            if (std::string(type) != "text") continue;
            std::istringstream list{std::string(range)};
            for (std::string word; list >> word;)
                if (word != "|") words.insert(word);
        }
        return words;
    }();
    static const std::vector<const char*> pointers = [] {
        std::vector<const char*> list;
        for (const std::string& word : texts) list.push_back(word.c_str());
        return list;
    }();
    return pointers;
}

const char* option_key(Input& in) {
    const char* key = nullptr;
    const std::int64_t index = in.below(delam_option_count() + 1);
    return delam_option_info(index, &key, nullptr, nullptr, nullptr, nullptr, nullptr) == DELAM_OK ? key : "no option";
}

struct MeshSizes {
    std::int32_t dimension = 2;
    std::int64_t nodes = 0, cells = 0, bodies = 0, interfaces = 0;
};
MeshSizes sizes_of(const delam_mesh* mesh) {
    MeshSizes s;
    delam_mesh_size(mesh, &s.dimension, &s.nodes, &s.cells, &s.bodies, &s.interfaces);
    return s;
}
// A problem does not return its mesh; fields that exist in only one dimension reveal the dimension.
struct ProblemSizes {
    std::int64_t dofs = 0, dual = 0, patterns = 0;
};
ProblemSizes sizes_of(const delam_problem* problem) {
    ProblemSizes s;
    delam_problem_dofs(problem, &s.dofs, &s.dual);
    delam_problem_pattern_count(problem, &s.patterns);
    return s;
}

// A capacity near the required one, and a buffer of exactly that many entries, so that writing one more is detected.
template <class T>
struct Room {
    Room(Input& in, std::int64_t needed) {
        const std::uint8_t how = in.byte();
        capacity = how == 255 ? -1 : how == 254 ? std::numeric_limits<std::int64_t>::min() : needed + how % 8 - 2;
        if (how < 200) capacity = needed;
        entries.resize(static_cast<std::size_t>(std::max<std::int64_t>(capacity, 0)));
    }
    std::int64_t capacity = 0;
    std::vector<T> entries;
    T* data() { return entries.data(); }
};

std::size_t few(Input& in) { return static_cast<std::size_t>(in.below(6)); }

std::int32_t add_cells(Input& in, delam_mesh* mesh, bool conforming) {
    static constexpr std::int32_t per_cell[] = {0, 3, 4, 4, 8, 6, 8, 9, 10, 20};
    const std::int32_t type =
        in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 1 + static_cast<std::int32_t>(in.below(9));
    const std::size_t count = few(in);
    const std::size_t nodes = count * static_cast<std::size_t>(type >= 1 && type <= 9 ? per_cell[type] : 20);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> connectivity = in.indices(nodes, sizes_of(mesh).nodes, base);
    std::vector<std::int32_t> bodies(count);
    for (std::int32_t& label : bodies) label = in.small_label(4);
    const auto call = conforming ? delam_mesh_add_conforming_cells : delam_mesh_add_cells;
    return in_order{call, mesh, type, static_cast<std::int64_t>(count), maybe(in, connectivity), maybe(in, bodies),
                    base}
        .status;
}

std::int32_t add_obstacle(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::size_t count = few(in);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> nodes = in.indices(count, s.nodes, base);
    std::vector<double> normals = in.reals(count * static_cast<std::size_t>(s.dimension));
    std::vector<double> weights = in.reals(count);
    std::int64_t index = -1;
    return in_order{delam_mesh_add_obstacle,
                    mesh,
                    static_cast<std::int64_t>(count),
                    maybe(in, nodes),
                    maybe(in, normals),
                    in.flag() ? nullptr : weights.data(),
                    in.index(s.nodes),
                    base,
                    in.seldom() ? nullptr : &index}
        .status;
}

// Nodes without cells, or any; pairs of them.
std::int32_t add_host_body(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::int32_t base = in.base();
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < s.nodes && nodes.size() < 8; ++n)
        if (bodies[static_cast<std::size_t>(n)] < 0 && !in.seldom()) nodes.push_back(n + (base == 1 ? 1 : 0));
    if (in.seldom()) nodes = in.indices(few(in), s.nodes, base);
    return in_order{delam_mesh_add_host_body, mesh, in.small_label(5), static_cast<std::int64_t>(nodes.size()),
                    maybe(in, nodes),         base}
        .status;
}

std::int32_t add_pairs(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::size_t count = few(in), faces = few(in) / 2;
    const std::int32_t base = in.base(), per_face = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole() % 12)
                                                                : 2 + static_cast<std::int32_t>(in.below(7));
    const std::int32_t body_a = in.small_label(5), body_b = in.small_label(5);
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes_a, nodes_b;
    for (std::int64_t n = 0; n < s.nodes; ++n) {
        const std::int32_t body = bodies[static_cast<std::size_t>(n)];
        const std::int64_t index = n + (base == 1 ? 1 : 0);
        if (body == body_a && nodes_a.size() < count) nodes_a.push_back(index);
        if (body == body_b && nodes_b.size() < count) nodes_b.push_back(index);
    }
    nodes_a.resize(count), nodes_b.resize(count);
    if (in.seldom()) nodes_a = in.indices(count, s.nodes, base);
    std::vector<double> normals = in.reals(3 * count), weights(count);
    for (double& w : weights) w = in.real();
    std::vector<std::int64_t> face =
        in.indices(faces * static_cast<std::size_t>(std::max(per_face, 0)), static_cast<std::int64_t>(count), base);
    std::int64_t index = -1;
    return in_order{delam_mesh_add_pairs,
                    mesh,
                    body_a,
                    body_b,
                    static_cast<std::int64_t>(count),
                    maybe(in, nodes_a),
                    maybe(in, nodes_b),
                    maybe(in, normals),
                    maybe(in, weights),
                    static_cast<std::int64_t>(faces),
                    per_face,
                    maybe(in, face),
                    base,
                    in.seldom() ? nullptr : &index}
        .status;
}

std::int32_t create_layers(Input& in, Host& host, delam_mesh** out) {
    const std::int32_t dimension = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 2 + in.flag();
    std::vector<double> lengths = {in.real(), in.real()};
    // Large products would only take long, so only single numbers are hostile.
    std::vector<std::int64_t> divisions = {1 + in.below(4), 1 + in.below(2)};
    const std::int64_t layers = in.below(4);
    std::vector<double> thickness(static_cast<std::size_t>(layers));
    std::vector<std::int64_t> across(static_cast<std::size_t>(layers), 1);
    for (double& t : thickness) t = in.real();
    if (in.seldom()) {
        const std::int64_t many = in.hostile_whole();
        if (many < 1 || many > 1000000000000) divisions[0] = many;
    }
    const std::int32_t type =
        in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 1 + static_cast<std::int32_t>(in.below(9));
    return in_order{delam_mesh_create_layers,
                    host.context,
                    dimension,
                    maybe(in, lengths),
                    maybe(in, divisions),
                    layers,
                    maybe(in, thickness),
                    maybe(in, across),
                    type,
                    out}
        .status;
}

std::int32_t create_mesh(Input& in, Host& host, delam_mesh** out) {
    const std::int32_t dimension = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 2 + in.flag();
    const std::size_t count = static_cast<std::size_t>(in.below(32));
    std::vector<double> nodes(3 * count);
    // On a grid, so that cells made of them may be valid.
    for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i] = in.seldom() ? in.signed_real() : static_cast<double>(in.below(4));
    return delam_mesh_create(host.context, dimension, static_cast<std::int64_t>(count), maybe(in, nodes), out);
}

std::int32_t find_in(Input& in, const delam_mesh* mesh, bool patch) {
    const MeshSizes s = sizes_of(mesh);
    std::vector<double> lower = in.reals(3), upper = in.reals(3), direction = in.reals(3), weights;
    if (in.flag())
        for (std::size_t d = 0; d < 3; ++d) lower[d] = -1.0, upper[d] = 2.0;
    Room<std::int64_t> nodes(in, s.nodes);
    weights.resize(nodes.entries.size());
    std::int64_t count = -1;
    const std::int32_t body = in.seldom() ? in.small_label(3) : static_cast<std::int32_t>(in.below(4)) - 1;
    if (patch)
        return in_order{
            delam_mesh_find_patch, mesh,           body,         lower.data(),   upper.data(),
            maybe(in, direction),  nodes.capacity, nodes.data(), weights.data(), in.seldom() ? nullptr : &count}
            .status;
    return in_order{delam_mesh_find_nodes, mesh,           body,         maybe(in, lower),
                    maybe(in, upper),      nodes.capacity, nodes.data(), in.seldom() ? nullptr : &count}
        .status;
}

std::int32_t add_pattern(Input& in, delam_problem* problem) {
    static const char* const names[] = {"load", "a", "heat", "b-2"};
    const std::size_t count = few(in);
    std::vector<double> times(count), values = in.reals(count);
    double last = in.flag() ? 0.0 : in.signed_real();
    for (double& t : times) t = last, last += in.real();
    std::int64_t index = -1;
    return in_order{delam_problem_add_pattern,        problem,          in.word(names),
                    static_cast<std::int64_t>(count), maybe(in, times), maybe(in, values),
                    in.seldom() ? nullptr : &index}
        .status;
}

// Prescribed nodes, means, equations and forces take similar arguments.
enum class Load { nodes, mean, equation, forces };
std::int32_t add_load(Input& in, delam_problem* problem, Load load) {
    const ProblemSizes s = sizes_of(problem);
    const std::size_t count = few(in), patterns = static_cast<std::size_t>(in.below(3));
    const std::int32_t base = in.base();
    const auto entries = static_cast<std::int64_t>(count), driven = static_cast<std::int64_t>(patterns);
    std::vector<std::int64_t> nodes = in.indices(count, s.dofs / 3, base);
    std::vector<std::int64_t> by = in.indices(patterns, s.patterns, base);
    std::vector<double> direction = in.reals(3), weights = in.reals(count), vectors = in.reals(3 * count);
    std::vector<double> coefficients = in.reals(std::max<std::size_t>(1, count) * std::max<std::size_t>(1, patterns));
    switch (load) {
        case Load::nodes:
            return in_order{delam_problem_prescribe_nodes,
                            problem,
                            entries,
                            maybe(in, nodes),
                            maybe(in, direction),
                            driven,
                            maybe(in, by),
                            maybe(in, coefficients),
                            base}
                .status;
        case Load::mean:
            return in_order{
                delam_problem_prescribe_mean, problem, entries,       maybe(in, nodes),        maybe(in, weights),
                maybe(in, direction),         driven,  maybe(in, by), maybe(in, coefficients), base}
                .status;
        case Load::equation:
            return in_order{delam_problem_add_equation,
                            problem,
                            entries,
                            maybe(in, nodes),
                            maybe(in, vectors),
                            driven,
                            maybe(in, by),
                            maybe(in, coefficients),
                            base}
                .status;
        case Load::forces:
            return in_order{delam_problem_add_forces, problem, in.index(s.patterns), entries, maybe(in, nodes),
                            maybe(in, vectors),       base}
                .status;
    }
    return DELAM_OK;
}

std::int32_t add_periodic(Input& in, delam_problem* problem) {
    std::vector<double> periods = in.reals(9);
    if (in.flag()) periods = {1.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 1.0};
    const std::int32_t base = in.base();
    std::vector<std::int64_t> controls = in.indices(3, sizes_of(problem).dofs / 3, base);
    return in_order{delam_problem_add_periodic,
                    problem,
                    in.seldom() ? in.hostile_whole() % 4 : in.below(4),
                    maybe(in, periods),
                    maybe(in, controls),
                    in.flag() ? 0.0 : in.fraction(),
                    base}
        .status;
}

std::int32_t set_orientation(Input& in, delam_problem* problem) {
    const std::size_t count = few(in);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> cells = in.indices(count, 6, base);
    std::vector<double> axes = in.reals(6 * std::max<std::size_t>(1, count));
    const bool whole = in.flag();
    return in_order{
        delam_problem_set_orientation,  problem,         in.body(), whole ? 1 : static_cast<std::int64_t>(count),
        whole ? nullptr : cells.data(), maybe(in, axes), base}
        .status;
}

std::int32_t set_orthotropic(Input& in, delam_problem* problem) {
    std::vector<double> constants = {1000.0, 100.0, 100.0, 0.25, 0.25, 0.4, 50.0, 50.0, 40.0};
    for (std::int64_t left = in.below(3); left > 0; --left)
        constants[static_cast<std::size_t>(in.below(9))] = in.signed_real();
    return in_order{delam_problem_set_orthotropic, problem, in.body(), maybe(in, constants)}.status;
}

std::int32_t body_matrix(Input& in, const delam_problem* problem) {
    std::int64_t rows = 0, entries = 0;
    const std::int32_t body = in.small_label(3);
    const std::int32_t status = delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr);
    if (status != DELAM_OK) return status;
    std::vector<std::int64_t> starts(static_cast<std::size_t>(rows + 1)), columns(static_cast<std::size_t>(entries));
    std::vector<double> values(static_cast<std::size_t>(entries));
    return in_order{delam_problem_body_matrix, problem,          body, nullptr, nullptr, maybe(in, starts),
                    maybe(in, columns),        maybe(in, values)}
        .status;
}

// Passes a stiffness assembled by the library, or a band matrix, as the host's own, corrupted.
std::int32_t set_stiffness(const delam_mesh* mesh, Input& in, delam_problem* problem) {
    const MeshSizes s = mesh == nullptr ? MeshSizes{} : sizes_of(mesh);
    const std::int32_t body = in.small_label(5), base = in.base();
    const std::int64_t shift = base == 1 ? 1 : 0;
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    if (mesh != nullptr) delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < s.nodes; ++n)
        if (bodies[static_cast<std::size_t>(n)] == body) nodes.push_back(n);
    // The array is as long as three components per node require, whatever the dimension.
    const std::size_t most = 3 * nodes.size();
    std::int64_t rows = 0, entries = 0;
    delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> starts, columns;
    std::vector<double> values;
    if (rows > 0 && rows == static_cast<std::int64_t>(nodes.size()) * s.dimension) {
        starts.resize(static_cast<std::size_t>(rows + 1)), columns.resize(static_cast<std::size_t>(entries));
        values.resize(columns.size());
        delam_problem_body_matrix(problem, body, nullptr, nullptr, starts.data(), columns.data(), values.data());
    } else {
        for (std::size_t i = 0; i < nodes.size() * static_cast<std::size_t>(s.dimension); ++i) {
            starts.push_back(static_cast<std::int64_t>(columns.size()));
            columns.push_back(static_cast<std::int64_t>(i)), values.push_back(100.0);
        }
        starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
    starts.resize(most + 1, starts.back());
    for (std::int64_t left = in.below(4); left > 0 && !values.empty(); --left) {
        const std::size_t at = in.raw<std::uint16_t>();
        switch (in.below(4)) {
            case 0:
                values[at % values.size()] = in.hostile_real();
                break;
            case 1:
                values[at % values.size()] = 100.0 * in.signed_real();
                break;
            case 2:
                columns[at % columns.size()] = in.index(static_cast<std::int64_t>(most));
                break;
            default: {  // row ends never lie beyond the arrays
                const std::int64_t start = in.hostile_whole();
                starts[at % starts.size()] = std::min(start, static_cast<std::int64_t>(columns.size()));
            }
        }
    }
    for (std::int64_t& v : starts) v = v > std::numeric_limits<std::int64_t>::min() ? v + shift : v;
    for (std::int64_t& v : columns) v = v < std::numeric_limits<std::int64_t>::max() ? v + shift : v;
    for (std::int64_t& v : nodes) v += shift;
    std::vector<std::int64_t> dofs(most);
    for (std::size_t i = 0; i < dofs.size(); ++i) dofs[i] = static_cast<std::int64_t>(i) + shift;
    if (in.seldom()) dofs = in.indices(most, static_cast<std::int64_t>(most), base);
    const std::int64_t kernels = in.below(5) - 1;
    std::vector<double> kernel = in.reals(most * static_cast<std::size_t>(std::max<std::int64_t>(kernels, 0)));
    return in_order{delam_problem_set_stiffness,
                    problem,
                    static_cast<std::int64_t>(nodes.size()),
                    maybe(in, nodes),
                    in.flag() ? nullptr : dofs.data(),
                    maybe(in, starts),
                    maybe(in, columns),
                    maybe(in, values),
                    kernels,
                    kernels > 0 ? maybe(in, kernel) : nullptr,
                    base}
        .status;
}

std::int32_t constraints(Input& in, const delam_problem* problem) {
    std::int64_t rows = 0, entries = 0, patterns = 0;
    delam_problem_constraints(problem, &rows, &entries, &patterns, nullptr, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> starts(static_cast<std::size_t>(rows + 1)), columns(static_cast<std::size_t>(entries));
    std::vector<double> values(columns.size()), coefficients(static_cast<std::size_t>(rows * patterns));
    const std::int32_t status = in_order{delam_problem_constraints,
                                         problem,
                                         nullptr,
                                         nullptr,
                                         nullptr,
                                         maybe(in, starts),
                                         columns.data(),
                                         values.data(),
                                         maybe(in, coefficients)}
                                    .status;
    for (const double v : values) expect(std::isfinite(v), "constraints are finite", "delam_problem_constraints");
    for (const double v : coefficients) expect(std::isfinite(v), "constraints are finite", "delam_problem_constraints");
    return status;
}

double next_time(Input& in, delam_solver* solver) {
    double time = 0.0;
    delam_solver_value(solver, "time", &time);
    return in.seldom() ? in.hostile_real() : time + 0.125 * static_cast<double>(1 + in.below(8));
}

// A call of the analysis: the progress callback may cancel, the law's callbacks may fail.
template <class Call>
std::int32_t watched(World& world, Input& in, Call&& call) {
    if (in.seldom() || in.seldom()) {
        world.heard->cancel_in = in.below(64);
        world.heard->cancel_by_call = in.flag();
    }
    if (in.seldom()) {
        world.host_law.fail_in = in.byte();
        if (in.flag()) world.host_law.fail_with = in.raw<std::int32_t>();
    }
    const std::int32_t status = call();
    world.heard->cancel_in = -1;
    world.host_law.fail_in = -1;
    return status;
}

std::int32_t equilibrate(Input& in, delam_solver* solver) {
    std::int64_t pairs = 0, one = 0;
    delam_solver_field_shape(solver, "adhesion", -1, &pairs, &one);
    std::vector<double> adhesion(static_cast<std::size_t>(pairs));
    for (double& zeta : adhesion) zeta = in.fraction();
    return in_order{delam_solver_equilibrate, solver, next_time(in, solver), in.flag() ? nullptr : adhesion.data()}
        .status;
}

std::int32_t read_field(Input& in, delam_solver* solver) {
    const char* key = in.word(field_keys);
    const std::int64_t part = in.flag() ? -1 : in.index(3);
    std::int64_t rows = -1, columns = -1;
    const std::int32_t status = delam_solver_field_shape(solver, key, part, in.seldom() ? nullptr : &rows, &columns);
    if (status != DELAM_OK || rows < 0) return status;
    Room<double> room(in, rows * columns);
    return delam_solver_field(solver, key, part, room.capacity, room.data());
}

std::int32_t read_front(Input& in, delam_solver* solver) {
    const std::int64_t index = in.index(3);
    std::int64_t fronts = 0, points = 0;
    const std::int32_t status = delam_solver_front_count(solver, index, &fronts, &points);
    if (status != DELAM_OK) return status;
    Room<std::int32_t> closed(in, fronts);
    Room<double> lengths(in, points);
    std::vector<std::int64_t> starts(closed.entries.size() + 1);
    const std::size_t room = lengths.entries.size();
    std::vector<double> places(3 * room), directions(3 * room), rates(3 * room), zones(room), pairs(room);
    return in_order{delam_solver_front,
                    solver,
                    index,
                    closed.capacity,
                    lengths.capacity,
                    maybe(in, starts),
                    closed.data(),
                    maybe(in, places),
                    maybe(in, directions),
                    lengths.data(),
                    maybe(in, rates),
                    maybe(in, zones),
                    maybe(in, pairs)}
        .status;
}

std::int32_t read_all_values(delam_solver* solver) {
    std::int64_t count = 0;
    delam_solver_value_count(solver, &count);
    for (std::int64_t i = 0; i < count; ++i) {
        const char* name = delam_solver_value_name(solver, i);
        expect(name != nullptr, "a value has a name", "delam_solver_value_name");
        const std::string key = name;
        double value = 0.0;
        const std::int32_t status = delam_solver_value(solver, key.c_str(), &value);
        if (status != DELAM_OK) return status;
    }
    return DELAM_OK;
}

std::int32_t read_jumps(Input& in, delam_solver* solver, std::int64_t patterns) {
    std::int64_t count = 0;
    delam_solver_jump_count(solver, &count);
    double released = 0.0;
    std::int64_t step = 0, first = 0;
    Room<double> before(in, patterns), after(in, patterns);
    const std::int32_t status = delam_solver_jump_reactions(
        solver, in.index(count), std::min(before.capacity, after.capacity), before.data(), after.data());
    if (status != DELAM_OK) return status;
    return delam_solver_jump(solver, in.index(count), &step, nullptr, nullptr, nullptr, nullptr, &released, nullptr,
                             nullptr, &first, nullptr);
}

std::int32_t read_plan(Input& in, delam_solver* solver) {
    expect(delam_solver_plan(solver) != nullptr, "never NULL", "delam_solver_plan");
    std::int64_t count = 0;
    delam_solver_plan_count(solver, &count);
    const char *subject = nullptr, *reason = nullptr;
    double cost = 0.0;
    return delam_solver_plan_item(solver, in.index(count), &subject, nullptr, &reason, &cost, nullptr, nullptr);
}

std::int32_t tangent(Input& in, delam_solver* solver, std::int64_t patterns) {
    Room<double> room(in, patterns * patterns);
    return delam_solver_tangent(solver, room.capacity, room.data());
}

std::int32_t set_history(Input& in, delam_solver* solver) {
    const std::size_t count = few(in);
    std::vector<double> times(count), values = in.reals(count);
    double last = next_time(in, solver);
    for (double& t : times) t = last, last += in.real();
    return in_order{delam_solver_set_history,         solver,           in.index(2),
                    static_cast<std::int64_t>(count), maybe(in, times), maybe(in, values)}
        .status;
}

std::int32_t recorded(Input& in, delam_solver* solver) {
    std::int64_t steps = 0;
    const std::int32_t status = in.seldom() ? delam_solver_recorded_size(solver, nullptr, &steps)
                                            : delam_solver_recorded_size(solver, &steps, &steps);
    if (status != DELAM_OK) return status;
    Room<double> room(in, steps);
    return delam_solver_recorded(solver, in.word(value_keys), room.capacity, room.data());
}

std::int64_t patterns_of(delam_solver* solver) {
    std::int64_t count = 0, patterns = 0;
    delam_solver_value_count(solver, &count);
    for (std::int64_t i = 0; i < count; ++i)
        patterns += std::string(delam_solver_value_name(solver, i)).starts_with("load:") ? 1 : 0;
    return patterns;
}

std::int32_t condensed(Input& in, delam_solver* solver) {
    const std::int64_t patterns = patterns_of(solver);
    std::int64_t unknowns = 0, entries = 0, rows = 0, columns = 0;
    const std::int32_t status = delam_solver_condensed_size(solver, &unknowns, &entries);
    if (status != DELAM_OK) return status;
    delam_solver_field_shape(solver, "jump", -1, &rows, &columns);
    const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
    Room<double> stiffness(in, unknowns * unknowns);
    std::vector<double> load(size(patterns * unknowns)), constant(size(patterns * patterns)), values(size(entries)),
        offset(size(rows * columns * patterns));
    std::vector<std::int64_t> starts(size(rows * columns + 1)), of(size(entries));
    return in_order{delam_solver_condensed, solver,          stiffness.capacity,
                    stiffness.data(),       maybe(in, load), maybe(in, constant),
                    maybe(in, starts),      maybe(in, of),   maybe(in, values),
                    maybe(in, offset)}
        .status;
}

// ---- experimental functions -----------------------------------------------------------------------------------------

// Gives the problem a dense engine of its own, or one in which something is missing or wrong. mesh: where the stiffness
// comes from; it may be that of another problem.
std::int32_t set_engine(World& world, Input& in, const delam_mesh* mesh, delam_problem* problem, bool sound) {
    constexpr std::int64_t largest = 120;  // DOFs: dense products only take long
    if ((!sound && in.seldom()) || sizes_of(problem).dofs > largest)
        return delam_experimental_problem_set_engine(problem, nullptr);
    auto own = std::make_unique<Engaged>(stiffness_of(mesh, problem));
    own->engine.awake = false;
    own->engine.calls_at_most = 600;
    delam_experimental_engine functions = own->engine.functions();
    if (!sound && in.seldom()) functions.size = in.hostile_whole();
    if (!sound && in.seldom()) functions.kept = in.hostile_whole();
    if (!sound && in.seldom()) {
        switch (in.below(7)) {
            case 0:
                functions.prepare = nullptr;
                break;
            case 1:
                functions.set = nullptr;
                break;
            case 2:
                functions.renew = nullptr;
                break;
            case 3:
                functions.solve = nullptr;
                break;
            case 4:
                functions.recover = nullptr;
                break;
            case 5:
                functions.message = nullptr;
                break;
            default:
                break;
        }
    }
    // On the heap and no longer than it says: what reads beyond `size` is seen.
    std::vector<std::uint8_t> bytes(sizeof functions);
    std::memcpy(bytes.data(), &functions, sizeof functions);
    if (functions.size >= 8 && functions.size < static_cast<std::int64_t>(sizeof functions)) {
        bytes.resize(static_cast<std::size_t>(functions.size));
        bytes.shrink_to_fit();
    }
    const std::int32_t status = delam_experimental_problem_set_engine(
        problem, reinterpret_cast<const delam_experimental_engine*>(bytes.data()));
    own->taken = status == DELAM_OK ? 1 : 0;
    world.engines.push_back(std::move(own));
    return status;
}

// Chooses what the engines do from now on, in calls that are asked.
void turn_engines(World& world, Input& in) {
    static constexpr std::int32_t statuses[] = {DELAM_CANCELLED,
                                                DELAM_ERROR_ARGUMENT,
                                                DELAM_ERROR_HANDLE,
                                                DELAM_ERROR_MESH,
                                                DELAM_ERROR_PROBLEM,
                                                DELAM_ERROR_STATE,
                                                DELAM_ERROR_MEMORY,
                                                DELAM_ERROR_NUMERICAL,
                                                DELAM_ERROR_SNAPSHOT,
                                                DELAM_ERROR_INTERNAL,
                                                DELAM_ERROR_FILE,
                                                DELAM_NOT_CONVERGED,
                                                DELAM_LIMIT,
                                                4,
                                                -11,
                                                1000000,
                                                std::numeric_limits<std::int32_t>::min(),
                                                std::numeric_limits<std::int32_t>::max()};
    const auto nonsense = static_cast<DenseEngine::Nonsense>(
        in.flag() ? 0 : in.below(static_cast<std::int64_t>(DenseEngine::Nonsense::count)));
    const std::int64_t after = in.flag() ? -1 : in.below(40);
    const std::uint8_t which = in.byte();
    const std::int32_t status = which < 240 ? statuses[which % std::size(statuses)] : in.raw<std::int32_t>();
    for (const auto& each : world.engines) {
        each->engine.nonsense = nonsense;
        each->engine.fail_in = after;
        each->engine.fail_with = status;
    }
}

std::int32_t problem_part(World& world, Input& in, const delam_problem* problem) {
    std::vector<std::int64_t> cells;
    for (std::int64_t next = in.below(3), left = in.below(8); left > 0; --left, next += 1 + in.below(2))
        cells.push_back(next);
    if (in.seldom()) cells = in.indices(few(in), 8);
    const std::int64_t count = in.seldom() ? in.hostile_whole() : static_cast<std::int64_t>(cells.size());
    // A host that says more cells than it has reads outside itself; here beyond any mesh, which is refused before.
    const std::int64_t said = count > static_cast<std::int64_t>(cells.size()) && count < 1000
                                  ? static_cast<std::int64_t>(cells.size())
                                  : count;
    std::int64_t size = 0;
    const std::int32_t status = in_order{delam_experimental_problem_part,
                                         problem,
                                         said,
                                         maybe(in, cells),
                                         in.seldom() ? in.hostile_whole() : 0,
                                         nullptr,
                                         in.seldom() ? nullptr : &size}
                                    .status;
    if (status != DELAM_OK) return status;
    Room<std::uint8_t> room(in, size);
    const std::int32_t written =
        in_order{delam_experimental_problem_part, problem, said, cells.data(), room.capacity, room.data(), &size}
            .status;
    if (written == DELAM_OK && room.capacity == size) world.part = room.entries;
    return written;
}

// The part written last, or one that was damaged, with or without its checksum corrected.
std::vector<std::uint8_t> some_part(const World& world, Input& in) {
    std::vector<std::uint8_t> bytes = world.part;
    if (in.flag() || bytes.empty()) return bytes;
    for (std::int64_t left = 1 + in.below(3); left > 0; --left) {
        const std::size_t place = in.raw<std::uint16_t>() % bytes.size();
        if (in.flag()) {
            bytes[place] ^= in.byte();
        } else {
            const std::int64_t whole = in.hostile_whole();
            std::memcpy(bytes.data() + place, &whole, std::min<std::size_t>(8, bytes.size() - place));
        }
    }
    if (in.seldom()) bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), in.byte()));
    return in.seldom() ? bytes : with_checksum(std::move(bytes));
}

std::int64_t some_size(Input& in, const std::vector<std::uint8_t>& bytes) {
    if (!in.seldom()) return static_cast<std::int64_t>(bytes.size());
    const std::int64_t said = in.hostile_whole();
    return said > static_cast<std::int64_t>(bytes.size()) && said <= (std::int64_t{1} << 48) ? -said : said;
}

std::int32_t part_matrix(World& world, Input& in, delam_context* context) {
    std::vector<std::uint8_t> bytes = some_part(world, in);
    const std::int64_t said = some_size(in, bytes);
    std::int64_t dimension = 0, nodes = 0, entries = 0;
    const std::uint8_t* given = maybe(in, bytes);
    const std::int32_t status = delam_experimental_part_matrix(context, said, given, &dimension, &nodes, &entries,
                                                               nullptr, nullptr, nullptr, nullptr, nullptr);
    if (status != DELAM_OK) return status;
    const auto rows = static_cast<std::size_t>(dimension * nodes);
    std::vector<std::int64_t> node(static_cast<std::size_t>(nodes)), starts(rows + 1),
        columns(static_cast<std::size_t>(entries));
    std::vector<double> places(rows), values(columns.size());
    return in_order{delam_experimental_part_matrix,
                    context,
                    said,
                    given,
                    nullptr,
                    nullptr,
                    nullptr,
                    maybe(in, node),
                    maybe(in, places),
                    maybe(in, starts),
                    maybe(in, columns),
                    maybe(in, values)}
        .status;
}

std::int32_t part_fields(World& world, Input& in, delam_context* context) {
    std::vector<std::uint8_t> bytes = some_part(world, in);
    const std::int64_t said = some_size(in, bytes);
    std::int64_t dimension = 2, nodes = 0;
    delam_experimental_part_matrix(context, said, bytes.data(), &dimension, &nodes, nullptr, nullptr, nullptr, nullptr,
                                   nullptr, nullptr);
    const std::size_t labels = few(in), cells = in.seldom() ? few(in) : 64;
    std::vector<std::int32_t> bodies(labels);
    for (std::int32_t& label : bodies) label = in.small_label(4);
    std::vector<double> u = in.reals(static_cast<std::size_t>(dimension * nodes)), strains = in.reals(6 * labels);
    // The part does not tell its number of cells: all that are possible are asked for.
    std::vector<double> stress(6 * cells), rotation(3 * cells);
    std::int32_t status = DELAM_ERROR_ARGUMENT;
    const std::int64_t hostile = in.seldom() ? in.hostile_whole() : -1;
    const double* displacement = maybe(in, u);
    double *stresses = maybe(in, stress), *rotations = maybe(in, rotation);
    for (std::int64_t count = 0; count <= static_cast<std::int64_t>(cells) && status == DELAM_ERROR_ARGUMENT; ++count)
        status = delam_experimental_part_fields(context, said, bytes.data(), nodes, displacement,
                                                static_cast<std::int64_t>(labels), bodies.data(), strains.data(), count,
                                                stresses, rotations);
    if (hostile < 0 || hostile > 1000)
        status = delam_experimental_part_fields(context, said, bytes.data(), hostile, displacement, 0, nullptr, nullptr,
                                                hostile, nullptr, nullptr);
    return status;
}

std::int32_t eigenstrains(Input& in, delam_solver* solver) {
    std::int64_t count = 0;
    const std::int32_t status = delam_experimental_solver_eigenstrains(
        solver, in.seldom() ? in.hostile_whole() : 0, nullptr, nullptr, in.seldom() ? nullptr : &count);
    if (status != DELAM_OK) return status;
    Room<std::int32_t> bodies(in, count);
    std::vector<double> strains(6 * bodies.entries.size());
    return in_order{
        delam_experimental_solver_eigenstrains, solver, bodies.capacity, bodies.data(), maybe(in, strains), &count}
        .status;
}

std::int32_t follow(Input& in, delam_solver* solver) {
    std::vector<std::int64_t> interfaces = in.indices(1 + few(in) / 2, 2);
    std::int64_t count = in.seldom() ? in.hostile_whole() : static_cast<std::int64_t>(interfaces.size());
    if (count > static_cast<std::int64_t>(interfaces.size()) && count < 1000) count = 0;
    std::int64_t parameter = -1;
    return in_order{delam_experimental_solver_follow,  solver, count, maybe(in, interfaces), in.word(law_keys),
                    in.seldom() ? nullptr : &parameter}
        .status;
}

std::int32_t sensitivity(Input& in, delam_solver* solver) {
    Room<double> room(in, patterns_of(solver) * in.below(4));
    std::int64_t unknown = 0;
    return in_order{delam_experimental_solver_sensitivity, solver, room.capacity, room.data(),
                    in.seldom() ? nullptr : &unknown}
        .status;
}

// A file in memory, owned by this process.
std::string file_name() { return "/dev/shm/delam-fuzz-" + std::to_string(::getpid()) + ".state"; }
const char* some_path(Input& in) {
    static const std::string own = file_name();
    static const char* const wrong[] = {"/nowhere/at/all", "/dev/shm"};
    return in.seldom() ? in.word(wrong) : own.c_str();
}

// Loads the bytes of one solver into another, of the same scene or not, whole or truncated.
std::int32_t save_and_load(World& world, Input& in, delam_solver* solver) {
    const delam_solver* from = world.solver.pick(in);
    if (from == nullptr) from = solver;
    std::vector<std::uint8_t> bytes = saved(from);
    if (in.seldom()) bytes.resize(bytes.size() - static_cast<std::size_t>(in.below(9)));
    if (in.seldom() && !bytes.empty()) bytes[in.raw<std::uint16_t>() % bytes.size()] ^= in.byte();
    return in_order{delam_solver_load, solver,
                    in.seldom() ? in.hostile_whole() % 2 : static_cast<std::int64_t>(bytes.size()), maybe(in, bytes)}
        .status;
}

std::int32_t law_respond(Input& in, const delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> jump = in.reals(3 * count), mixity(count), old(count), adhesion(count), traction(3 * count);
    for (std::size_t i = 0; i < count; ++i) mixity[i] = in.fraction(), old[i] = in.fraction();
    return in_order{delam_law_respond,
                    law,
                    in.seldom() ? 4 : 2 + in.flag(),
                    static_cast<std::int64_t>(count),
                    maybe(in, jump),
                    maybe(in, mixity),
                    maybe(in, old),
                    adhesion.data(),
                    maybe(in, traction)}
        .status;
}

std::int32_t law_toughness(Input& in, const delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> mixity(count), onset(count), toughness(count);
    for (double& b : mixity) b = in.fraction();
    return in_order{delam_law_toughness, law, static_cast<std::int64_t>(count), maybe(in, mixity), maybe(in, onset),
                    maybe(in, toughness)}
        .status;
}

std::int32_t law_table(Input& in, delam_law* law) {
    const std::size_t count = few(in);
    std::vector<double> xi(count), s(count);
    for (std::size_t i = 0; i < count; ++i) xi[i] = in.fraction(), s[i] = in.fraction();
    if (count >= 2 && in.flag()) xi.front() = 0.0, xi.back() = 1.0, s.front() = 1.0, s.back() = 0.0;
    return in_order{delam_law_set_table, law, static_cast<std::int64_t>(count), maybe(in, xi), maybe(in, s)}.status;
}

// ---- the table ------------------------------------------------------------------------------------------------------

struct Asked {
    World& world;
    Input& in;
    Host& host;  // that owns the subject
    delam_mesh* mesh;
    delam_law* law;
    delam_problem* problem;
    delam_solver* solver;
};

enum class Subject { host, mesh, law, problem, solver };

struct Call {
    const char* name;
    Subject subject;
    Statuses documented;
    std::int32_t (*make)(const Asked&);
};

const Call calls[] = {
    {"delam_mesh_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.mesh, a.in, a.host, [&](delam_mesh** o) { return create_mesh(a.in, a.host, o); });
     }},
    {"delam_mesh_create_layers", Subject::host, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         return a.world.make(a.world.mesh, a.in, a.host,
                             [&](delam_mesh** o) { return create_layers(a.in, a.host, o); });
     }},
    {"delam_law_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.law, a.in, a.host,
                             [&](delam_law** o) { return delam_law_create(a.host.context, a.in.word(law_kinds), o); });
     }},
    {"delam_law_create_host", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.law, a.in, a.host, [&](delam_law** o) {
             const std::int32_t status =
                 in_order{delam_law_create_host, a.host.context, a.in.seldom() ? "" : "bilinear", host_adhesion,
                                       a.in.seldom() ? nullptr : host_dissipation, &a.world.host_law, o}.status;
             if (status == DELAM_OK)
                 for (const char* key : {"normal_stiffness", "tangential_stiffness"}) delam_law_set(*o, key, 1e4);
             return status;
         });
     }},
    {"delam_problem_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.problem, a.in, a.host, [&](delam_problem** o) {
             return delam_problem_create(a.host.context, a.world.mesh.pick(a.in), o);
         });
     }},
    {"delam_context_cancel", Subject::host, may::usual,
     [](const Asked& a) { return a.in.seldom() ? delam_context_cancel(a.host.context) : DELAM_OK; }},
    {"delam_context_set_log", Subject::host, may::usual,
     [](const Asked& a) {
         a.host.listens = false;
         return delam_context_set_log(a.host.context, nullptr, nullptr);
     }},
    {"a whole scene", Subject::host, may::usual,
     [](const Asked& a) {
         SmallScene scene = small_scene(a.host, a.in);
         const auto slot = static_cast<std::size_t>(a.in.below(slots));
         a.world.mesh.put(slot, scene.mesh, &a.host);
         a.world.law.put(slot, scene.law, &a.host);
         a.world.problem.put(slot, scene.problem, &a.host);
         return DELAM_OK;
     }},
    {"a whole scene with an engine", Subject::host, may::usual,
     [](const Asked& a) {
         SmallScene scene = small_scene(a.host, a.in);
         delam_problem_set_text(scene.problem, "reduction", "auto");
         delam_problem_set_number(scene.problem, "subdomains", 0.0);
         const std::int32_t status = set_engine(a.world, a.in, scene.mesh, scene.problem, true);
         expect(status == DELAM_OK, "a sound engine is taken", "delam_experimental_problem_set_engine");
         delam_solver* solver = nullptr;
         delam_solver_create(scene.problem, 0.0, &solver);
         const auto slot = static_cast<std::size_t>(a.in.below(slots));
         a.world.mesh.put(slot, scene.mesh, &a.host);
         a.world.law.put(slot, scene.law, &a.host);
         a.world.problem.put(slot, scene.problem, &a.host);
         a.world.solver.put(slot, solver, &a.host);
         return DELAM_OK;
     }},
    {"the engines turn", Subject::host, may::usual,
     [](const Asked& a) {
         turn_engines(a.world, a.in);
         return DELAM_OK;
     }},
    {"delam_experimental_part_matrix", Subject::host, may::cancelled | may::argument | may::snapshot,
     [](const Asked& a) { return part_matrix(a.world, a.in, a.host.context); }},
    {"delam_experimental_part_fields", Subject::host, may::cancelled | may::argument | may::snapshot,
     [](const Asked& a) { return part_fields(a.world, a.in, a.host.context); }},
    {"the next call is interrupted", Subject::host, may::usual,
     [](const Asked& a) {
         a.world.interrupt_in = a.in.below(16);
         a.world.interrupt_by_call = a.in.flag();
         return DELAM_OK;
     }},
    {"the host's law turns", Subject::host, may::usual,
     [](const Asked& a) {
         a.world.host_law.nonsense = a.in.flag();
         return DELAM_OK;
     }},

    {"delam_mesh_add_cells", Subject::mesh, may::cancelled | may::argument | may::mesh | may::state,
     [](const Asked& a) { return add_cells(a.in, a.mesh, false); }},
    {"delam_mesh_add_conforming_cells", Subject::mesh, may::cancelled | may::argument | may::mesh | may::state,
     [](const Asked& a) { return add_cells(a.in, a.mesh, true); }},
    {"delam_mesh_add_interface", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t index = -1;
         return in_order{delam_mesh_add_interface, a.mesh, a.in.small_label(3), a.in.small_label(3),
                                         a.in.flag() ? 0.0 : a.in.fraction(), a.in.seldom() ? nullptr : &index}.status;
     }},
    {"delam_mesh_add_all_interfaces", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t count = -1;
         return in_order{delam_mesh_add_all_interfaces, a.mesh, a.in.flag() ? 0.0 : a.in.fraction(),
                                              a.in.seldom() ? nullptr : &count}.status;
     }},
    {"delam_mesh_add_projected_interface", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t index = -1;
         return in_order{delam_mesh_add_projected_interface, a.mesh, a.in.small_label(3), a.in.small_label(3),
                                                   a.in.flag() ? 0.0 : a.in.real(),
                         a.in.seldom() ? nullptr : &index}.status;
     }},
    {"delam_mesh_add_obstacle", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_obstacle(a.in, a.mesh); }},
    {"delam_mesh_add_host_body", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_host_body(a.in, a.mesh); }},
    {"delam_mesh_add_pairs", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_pairs(a.in, a.mesh); }},
    {"delam_mesh_find_nodes", Subject::mesh, may::argument,
     [](const Asked& a) { return find_in(a.in, a.mesh, false); }},
    {"delam_mesh_find_patch", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return find_in(a.in, a.mesh, true); }},
    {"delam_mesh_nodes", Subject::mesh, may::argument,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.mesh).nodes * sizes_of(a.mesh).dimension);
         return delam_mesh_nodes(a.mesh, room.capacity, room.data());
     }},
    {"delam_mesh_destroy", Subject::mesh, may::usual,
     [](const Asked& a) {
         a.world.mesh.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},

    {"delam_law_set", Subject::law, may::argument,
     [](const Asked& a) { return in_order{delam_law_set, a.law, a.in.word(law_keys), a.in.signed_real()}.status; }},
    {"delam_law_set_text", Subject::law, may::argument,
     [](const Asked& a) {
         return in_order{delam_law_set_text, a.law, a.in.seldom() ? a.in.word(law_keys) : "criterion",
                         a.in.word(criteria)}.status;
     }},
    {"delam_law_set_table", Subject::law, may::argument, [](const Asked& a) { return law_table(a.in, a.law); }},
    {"delam_law_check", Subject::law, may::problem,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_law_check(a.law); }); }},
    {"delam_law_toughness", Subject::law, may::argument | may::problem,
     [](const Asked& a) { return law_toughness(a.in, a.law); }},
    {"delam_law_respond", Subject::law, may::argument | may::problem,
     [](const Asked& a) { return law_respond(a.in, a.law); }},
    {"delam_law_destroy", Subject::law, may::usual,
     [](const Asked& a) {
         a.world.law.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},

    {"delam_problem_set_plane", Subject::problem, may::argument,
     [](const Asked& a) {
         static const char* const planes[] = {"plane-strain", "plane-stress"};
         return delam_problem_set_plane(a.problem, a.in.word(planes));
     }},
    {"delam_problem_set_elastic", Subject::problem, may::argument,
     [](const Asked& a) {
         return in_order{delam_problem_set_elastic, a.problem, a.in.body(), 1000.0 * a.in.real(),
                                          0.25 * a.in.signed_real()}.status;
     }},
    {"delam_problem_set_orthotropic", Subject::problem, may::argument,
     [](const Asked& a) { return set_orthotropic(a.in, a.problem); }},
    {"delam_problem_set_orientation", Subject::problem, may::cancelled | may::argument,
     [](const Asked& a) { return set_orientation(a.in, a.problem); }},
    {"delam_problem_set_formulation", Subject::problem, may::argument,
     [](const Asked& a) {
         static const char* const words[] = {"standard", "incompatible", "mean-dilatation"};
         return in_order{delam_problem_set_formulation, a.problem, a.in.body(), a.in.word(words)}.status;
     }},
    {"delam_problem_set_stiffness", Subject::problem, may::argument | may::numerical | may::cancelled,
     [](const Asked& a) { return set_stiffness(a.world.mesh.pick(a.in), a.in, a.problem); }},
    {"delam_problem_set_law", Subject::problem, may::argument | may::problem,
     [](const Asked& a) {
         return watched(a.world, a.in,
                        [&] { return in_order{delam_problem_set_law, a.problem, a.in.index(2),
                                              a.world.law.pick(a.in)}.status; });
     }},
    {"delam_problem_set_bonded", Subject::problem, may::argument,
     [](const Asked& a) { return delam_problem_set_bonded(a.problem, a.in.index(2)); }},
    {"delam_problem_set_contact", Subject::problem, may::argument,
     [](const Asked& a) { return delam_problem_set_contact(a.problem, a.in.index(2)); }},
    {"delam_problem_set_adhesion", Subject::problem, may::argument,
     [](const Asked& a) {
         const std::size_t count = few(a.in);
         const std::int32_t base = a.in.base();
         std::vector<std::int64_t> pairs = a.in.indices(count, 4, base);
         std::vector<double> adhesion(count);
         for (double& zeta : adhesion) zeta = a.in.fraction();
         return in_order{delam_problem_set_adhesion, a.problem, a.in.index(2), static_cast<std::int64_t>(count),
                                           maybe(a.in, pairs), maybe(a.in, adhesion), base}.status;
     }},
    {"delam_problem_set_adhesion_box", Subject::problem, may::argument,
     [](const Asked& a) {
         std::vector<double> lower = a.in.reals(3), upper = a.in.reals(3);
         const double adhesion = a.in.fraction();
         std::int64_t count = 0;
         return in_order{delam_problem_set_adhesion_box, a.problem, a.in.index(2), maybe(a.in, lower),
                                           maybe(a.in, upper), adhesion, a.in.seldom() ? nullptr : &count}.status;
     }},
    {"delam_problem_add_pattern", Subject::problem, may::argument,
     [](const Asked& a) { return add_pattern(a.in, a.problem); }},
    {"delam_problem_prescribe_nodes", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::nodes); }},
    {"delam_problem_prescribe_mean", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::mean); }},
    {"delam_problem_add_equation", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::equation); }},
    {"delam_problem_add_forces", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::forces); }},
    {"delam_problem_add_periodic", Subject::problem, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_periodic(a.in, a.problem); }},
    {"delam_problem_add_eigenstrain", Subject::problem, may::argument | may::problem,
     [](const Asked& a) {
         std::vector<double> strain = a.in.reals(6);
         for (double& e : strain) e *= 1e-3;
         return in_order{delam_problem_add_eigenstrain, a.problem, a.in.index(sizes_of(a.problem).patterns),
                                              a.in.body(), maybe(a.in, strain)}.status;
     }},
    {"delam_problem_set_number", Subject::problem, may::argument,
     [](const Asked& a) {
         const char* key = option_key(a.in);
         return in_order{delam_problem_set_number, a.problem, key,
                         a.in.seldom() ? a.in.hostile_real() : a.in.real()}.status;
     }},
    {"delam_problem_set_text", Subject::problem, may::argument,
     [](const Asked& a) {
         const char* key = option_key(a.in);
         return delam_problem_set_text(a.problem, key, a.in.word(option_texts()));
     }},
    {"delam_problem_check", Subject::problem, may::cancelled | may::mesh | may::problem,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_problem_check(a.problem); }); }},
    {"delam_problem_process_zone", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         double length = 0.0;
         return delam_problem_process_zone(a.problem, a.in.index(2), &length, nullptr);
     }},
    {"delam_problem_propose", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         const std::int64_t interface_index = a.in.index(2);
         double stiffness = 0.0, share = 0.0, normal = 0.0, tangential = 0.0;
         return in_order{delam_problem_propose, a.problem, interface_index, a.in.seldom() ? a.in.hostile_real() : 3.0,
                         &stiffness, &share, &normal, &tangential}.status;
     }},
    {"delam_problem_body_matrix", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return body_matrix(a.in, a.problem); }},
    {"delam_problem_constraints", Subject::problem, may::cancelled,
     [](const Asked& a) { return constraints(a.in, a.problem); }},
    {"delam_problem_forces", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.problem).dofs);
         return delam_problem_forces(a.problem, a.in.index(sizes_of(a.problem).patterns), room.capacity, room.data());
     }},
    {"delam_problem_eigenstrain_energy", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         const std::int64_t patterns = sizes_of(a.problem).patterns;
         Room<double> room(a.in, patterns * patterns);
         return delam_problem_eigenstrain_energy(a.problem, room.capacity, room.data());
     }},
    {"delam_problem_factors", Subject::problem, may::argument,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.problem).patterns);
         const std::int32_t status = delam_problem_factors(a.problem, a.in.signed_real(), room.capacity, room.data());
         for (std::int64_t p = 0; status == DELAM_OK && p < sizes_of(a.problem).patterns; ++p)
             expect(std::isfinite(room.entries[static_cast<std::size_t>(p)]), "factors are finite",
                    "delam_problem_factors");
         return status;
     }},
    {"delam_experimental_problem_set_engine", Subject::problem, may::argument,
     [](const Asked& a) {
         const delam_mesh* mesh = a.world.mesh.pick(a.in);
         return set_engine(a.world, a.in, mesh, a.problem, false);
     }},
    {"delam_experimental_problem_part", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return problem_part(a.world, a.in, a.problem); }},
    {"delam_problem_destroy", Subject::problem, may::usual,
     [](const Asked& a) {
         a.world.problem.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},
    {"delam_solver_create", Subject::problem,
     may::not_converged | may::cancelled | may::limit | may::argument | may::mesh | may::problem | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] {
             return a.world.make(a.world.solver, a.in, a.host, [&](delam_solver** o) {
                 return in_order{delam_solver_create, a.problem, a.in.seldom() ? a.in.hostile_real() : 0.0, o}.status;
             });
         });
     }},

    {"delam_solver_advance", Subject::solver,
     may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return delam_solver_advance(a.solver, next_time(a.in, a.solver)); });
     }},
    {"delam_solver_commit", Subject::solver, may::problem | may::state,
     [](const Asked& a) { return delam_solver_commit(a.solver); }},
    {"delam_solver_commit, the law may fail", Subject::solver, may::problem | may::state,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_solver_commit(a.solver); }); }},
    {"delam_solver_rollback", Subject::solver, may::state,
     [](const Asked& a) { return delam_solver_rollback(a.solver); }},
    {"delam_solver_equilibrate", Subject::solver,
     may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::state | may::numerical,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return equilibrate(a.in, a.solver); }); }},
    {"delam_solver_look", Subject::solver, may::argument,
     [](const Asked& a) {
         const std::int64_t step = a.in.index(7);
         return delam_solver_look(a.solver, step == std::numeric_limits<std::int64_t>::min() ? step : step - 1);
     }},
    {"delam_solver_value", Subject::solver, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         double value = 0.0;
         return in_order{delam_solver_value, a.solver, a.in.word(value_keys), a.in.seldom() ? nullptr : &value}.status;
     }},
    {"all values", Subject::solver, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return read_all_values(a.solver); }},
    {"delam_solver_field", Subject::solver, may::cancelled | may::argument,
     [](const Asked& a) { return read_field(a.in, a.solver); }},
    {"delam_solver_average", Subject::solver, may::cancelled | may::argument,
     [](const Asked& a) {
         std::vector<double> strain(6), stress(6);
         double volume = 0.0;
         return in_order{delam_solver_average, a.solver, a.in.body(), &volume, maybe(a.in, strain),
                                     maybe(a.in, stress)}.status;
     }},
    {"delam_solver_front", Subject::solver, may::argument | may::problem,
     [](const Asked& a) { return read_front(a.in, a.solver); }},
    {"delam_solver_tangent", Subject::solver, may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return tangent(a.in, a.solver, patterns_of(a.solver)); });
     }},
    {"delam_solver_step_tangent", Subject::solver, may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] {
             const std::int64_t patterns = patterns_of(a.solver);
             Room<double> room(a.in, patterns * patterns);
             return delam_solver_step_tangent(a.solver, room.capacity, room.data());
         });
     }},
    {"delam_solver_set_history", Subject::solver, may::argument | may::state,
     [](const Asked& a) { return set_history(a.in, a.solver); }},
    {"delam_solver_record", Subject::solver, may::argument | may::problem | may::state,
     [](const Asked& a) {
         const char* key = a.in.word(value_keys);
         return watched(a.world, a.in, [&] { return delam_solver_record(a.solver, key); });
     }},
    {"delam_solver_recorded", Subject::solver, may::argument,
     [](const Asked& a) { return recorded(a.in, a.solver); }},
    {"delam_solver_condensed", Subject::solver, may::cancelled | may::argument | may::state,
     [](const Asked& a) { return condensed(a.in, a.solver); }},
    {"delam_solver_pending", Subject::solver, may::argument,
     [](const Asked& a) {
         std::int32_t pending = -1;
         const std::int32_t status = delam_solver_pending(a.solver, a.in.seldom() ? nullptr : &pending);
         expect(status != DELAM_OK || pending == 0 || pending == 1, "0 or 1", "delam_solver_pending");
         return status;
     }},
    {"delam_solver_save_file", Subject::solver, may::argument | may::file,
     [](const Asked& a) { return delam_solver_save_file(a.solver, some_path(a.in)); }},
    {"delam_solver_load_file", Subject::solver,
     may::cancelled | may::argument | may::numerical | may::snapshot | may::file,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return delam_solver_load_file(a.solver, some_path(a.in)); });
     }},
    {"delam_solver_jump", Subject::solver, may::argument,
     [](const Asked& a) { return read_jumps(a.in, a.solver, patterns_of(a.solver)); }},
    {"delam_solver_plan_item", Subject::solver, may::argument,
     [](const Asked& a) { return read_plan(a.in, a.solver); }},
    {"delam_solver_option", Subject::solver, may::argument,
     [](const Asked& a) {
         expect(delam_solver_option(a.solver, "solution") != nullptr, "a known option has a value",
                "delam_solver_option");
         expect(delam_solver_searched(a.solver) != nullptr, "never NULL", "delam_solver_searched");
         return DELAM_OK;
     }},
    {"delam_solver_load", Subject::solver, may::cancelled | may::argument | may::numerical | may::snapshot,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return save_and_load(a.world, a.in, a.solver); }); }},
    {"delam_experimental_solver_recover", Subject::solver, may::cancelled | may::numerical | may::state,
     [](const Asked& a) { return delam_experimental_solver_recover(a.solver); }},
    {"delam_experimental_solver_eigenstrains", Subject::solver, may::argument,
     [](const Asked& a) { return eigenstrains(a.in, a.solver); }},
    {"delam_experimental_solver_follow", Subject::solver,
     may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return follow(a.in, a.solver); }); }},
    {"delam_experimental_solver_sensitivity", Subject::solver, may::argument | may::state,
     [](const Asked& a) { return sensitivity(a.in, a.solver); }},
    {"delam_solver_destroy", Subject::solver, may::usual,
     [](const Asked& a) {
         a.world.solver.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},
};

// All functions must refuse NULL and handles of another kind; destroyed handles cannot always be recognised.
template <class T>
void refuse_others(const Call& call, World& world, Input& in) {
    void* other = in.flag() ? nullptr : static_cast<void*>(world.host[0]->context);
    Asked asked{world,
                in,
                *world.host[0],
                static_cast<delam_mesh*>(other),
                static_cast<delam_law*>(other),
                static_cast<delam_problem*>(other),
                static_cast<delam_solver*>(other)};
    world.heard = world.host[0].get();
    (void)call;
    double value = 0.0;
    std::int64_t count = 0;
    expect(delam_mesh_nodes(asked.mesh, 0, &value) == DELAM_ERROR_HANDLE, "foreign handles are refused", "mesh");
    expect(delam_law_check(asked.law) == DELAM_ERROR_HANDLE, "foreign handles are refused", "law");
    expect(delam_problem_check(asked.problem) == DELAM_ERROR_HANDLE, "foreign handles are refused", "problem");
    expect(delam_solver_advance(asked.solver, 1.0) == DELAM_ERROR_HANDLE, "foreign handles are refused", "solver");
    expect(delam_solver_jump_count(asked.solver, &count) == DELAM_ERROR_HANDLE, "foreign handles are refused",
           "solver");
}

// Runs the call, and cancels it if the row before requested that and the call can be cancelled.
std::int32_t run(World& world, const Call& call, const Asked& asked) {
    Host& host = asked.host;
    host.begin();
    if ((call.documented & may::cancelled) != 0) {
        host.cancel_in = std::exchange(world.interrupt_in, -1);
        host.cancel_by_call = world.interrupt_by_call;
    }
    world.wake(true);
    const std::int32_t status = call.make(asked);
    host.cancel_in = -1;
    // Functions whose lists have no status for it say so (experimental.h, "An engine").
    const bool has_one = (call.documented & (may::numerical | may::problem)) != 0;
    host.settle(call.name, status, call.documented | (world.engine_failed() && !has_one ? may::internal : Statuses{0}));
    world.wake(false);
    return status;
}

// One call on one object: checks the returned status, and that errors, cancellations and limits leave the object
// unchanged.
template <class T>
void ask(World& world, Input& in, const Call& call, Shelf<T>& shelf, T* Asked::*member) {
    const auto slot = static_cast<std::size_t>(in.below(slots));
    T* subject = shelf.handle[slot];
    if (subject == nullptr) {
        refuse_others<T>(call, world, in);
        return;
    }
    Host& host = *shelf.host[slot];
    world.heard = &host;
    const std::string before = print_of(subject);
    Asked asked{world, in, host, nullptr, nullptr, nullptr, nullptr};
    asked.*member = subject;
    const std::int32_t status = run(world, call, asked);
    const bool untouched = status < 0 || status == DELAM_CANCELLED || status == DELAM_LIMIT;
    if (untouched && shelf.handle[slot] == subject)
        expect(print_of(subject) == before, "an error leaves the object as it was", call.name);
}

bool too_large(const delam_mesh* mesh) { return sizes_of(mesh).nodes > nodes_at_most; }

void one(World& world, Input& in, const Call& call) {
    switch (call.subject) {
        case Subject::host: {
            Host& host = world.any_host(in);
            world.heard = &host;
            run(world, call, {world, in, host, nullptr, nullptr, nullptr, nullptr});
            break;
        }
        case Subject::mesh:
            ask(world, in, call, world.mesh, &Asked::mesh);
            break;
        case Subject::law:
            ask(world, in, call, world.law, &Asked::law);
            break;
        case Subject::problem:
            ask(world, in, call, world.problem, &Asked::problem);
            break;
        case Subject::solver:
            ask(world, in, call, world.solver, &Asked::solver);
            break;
    }
    for (std::size_t i = 0; i < slots; ++i)
        if (world.mesh.handle[i] != nullptr && too_large(world.mesh.handle[i])) world.mesh.put(i, nullptr, nullptr);
}

// The call that two bytes stand for: the one whose name, hashed with them, gives the largest value. A new row takes its
// share from all others and leaves the meaning of every other number unchanged, so that inputs stay valid.
const Call& call_of(std::uint16_t number) {
    const auto rank = [&](const Call& call) {
        std::uint64_t hash = 14695981039346656037ULL ^ number;
        for (const char* letter = call.name; *letter != '\0'; ++letter)
            hash = (hash ^ static_cast<std::uint8_t>(*letter)) * 1099511628211ULL;
        hash ^= hash >> 29;
        return hash * 0xbf58476d1ce4e5b9ULL;
    };
    return *std::max_element(std::begin(calls), std::end(calls),
                             [&](const Call& a, const Call& b) { return rank(a) < rank(b); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input in(data, size);
    World world;
    // Most calls on a solver need one, so a scene and its solver usually come first.
    if (in.byte() % 4 != 0) {
        SmallScene scene = small_scene(*world.host[0], in);
        world.mesh.put(0, scene.mesh, world.host[0].get());
        world.law.put(0, scene.law, world.host[0].get());
        world.problem.put(0, scene.problem, world.host[0].get());
        delam_solver* solver = nullptr;
        world.heard = world.host[0].get();
        world.heard->begin();
        const std::int32_t status = delam_solver_create(scene.problem, 0.0, &solver);
        world.heard->settle("delam_solver_create", status,
                            may::not_converged | may::limit | may::argument | may::problem | may::numerical);
        if (solver != nullptr) world.solver.put(0, solver, world.host[0].get());
    }
    const bool trace = std::getenv("FUZZ_TRACE") != nullptr;
    for (int i = 0; i < calls_at_most && !in.empty(); ++i) {
        const Call& call = call_of(in.raw<std::uint16_t>());
        if (trace) std::fprintf(stderr, "%s\n", call.name);
        one(world, in, call);
    }
    ::unlink(file_name().c_str());
    // Contexts may be destroyed before the objects made with them.
    if (in.flag()) world.host[0].reset(), world.host[1].reset();
    return 0;
}
