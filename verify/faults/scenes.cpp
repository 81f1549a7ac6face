// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

#include "../cases/host_bilinear.hpp"

namespace faults {

// host.query("f", [&] { return f(...); }), or change.
#define QUERY(function, ...) host.query(#function, [&] { return function(__VA_ARGS__); })
#define CHANGE(function, ...) host.change(#function, [&] { return function(__VA_ARGS__); })

namespace {

constexpr double length = 0.070, notch = 0.030, layer = 3e-3, width = 7e-3, end = 2e-3;

// Handles of one scene. They are destroyed in any order, as the API allows.
struct Handles {
    delam_context* context = nullptr;
    delam_mesh* mesh = nullptr;
    delam_law* law = nullptr;
    delam_problem* problem = nullptr;
    delam_solver* solver = nullptr;
    delam_solver* other = nullptr;
    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        delam_context_destroy(&context);
        delam_solver_destroy(&other);
        delam_mesh_destroy(&mesh);
        delam_problem_destroy(&problem);
        delam_law_destroy(&law);
        delam_solver_destroy(&solver);
    }
};

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// Two layers of quadrilaterals or hexahedra; cells of the lower one are `coarse` times as long; nodes are shared if
// `shared`.
struct Cells {
    std::vector<double> nodes;
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> bodies;
};
Cells two_layers(std::int64_t along, bool shared, std::int64_t coarse) {
    Cells c;
    std::int64_t first_top = 0;
    for (std::int32_t body = 0; body < 2; ++body) {
        const std::int64_t n = body == 0 ? along / coarse : along;
        const std::int64_t row = n + 1, first = static_cast<std::int64_t>(c.nodes.size()) / 2;
        const bool skip = body == 1 && shared;
        for (std::int64_t j = skip ? 1 : 0; j <= 1; ++j)
            for (std::int64_t i = 0; i <= n; ++i) {
                c.nodes.push_back(length * static_cast<double>(i) / static_cast<double>(n));
                c.nodes.push_back(layer * static_cast<double>(j + body));
            }
        const std::int64_t low = skip ? first_top : first, high = skip ? first : first + row;
        for (std::int64_t i = 0; i < n; ++i) {
            for (const std::int64_t node : {low + i, low + i + 1, high + i + 1, high + i})
                c.connectivity.push_back(node);
            c.bodies.push_back(body);
        }
        first_top = first + row;
    }
    return c;
}

// Adds an interface in each of two slots: five rows of four cells, of which rows 1 and 3 lack the last two.
void touch_in_slots(Host& host, Handles& h) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    for (std::int64_t n = 0; n < 30; ++n) {
        nodes.insert(nodes.end(), {static_cast<double>(n % 5), static_cast<double>(n / 5)});
        if (n < 25 && n % 5 < (n / 5 % 2 == 0 ? 4 : 2)) cells.insert(cells.end(), {n, n + 1, n + 6, n + 5});
    }
    std::int64_t count = 0;
    CHANGE(delam_mesh_create, h.context, 2, 30, nodes.data(), &h.mesh);
    CHANGE(delam_mesh_add_cells, h.mesh, DELAM_QUAD4, 16, cells.data(), nullptr, 0);
    CHANGE(delam_mesh_add_self_contact, h.mesh, 1.1, &count);
    host.transcript.add("slots", &count, sizeof count);
    delam_mesh_destroy(&h.mesh);
}

void make_mesh(Host& host, Handles& h, const Strip& s) {
    std::int64_t index = -1;
    if (s.mesh == "layers") {
        const std::array<double, 2> lengths{length, width};
        const std::array<std::int64_t, 2> divisions{s.cells, 2};
        const std::array<double, 2> thickness{layer, layer};
        const std::array<std::int64_t, 2> layer_cells{1, 1};
        const std::int32_t type = s.dimension == 2 ? DELAM_QUAD4 : DELAM_HEX8;
        host.create(
            "delam_mesh_create_layers",
            [&] {
                return delam_mesh_create_layers(h.context, s.dimension, lengths.data(), divisions.data(), 2,
                                                thickness.data(), layer_cells.data(), type, &h.mesh);
            },
            [&] { return delam_mesh_destroy(&h.mesh), DELAM_OK; });
        CHANGE(delam_mesh_add_interface, h.mesh, 0, 1, 0.0, &index);
        return;
    }
    const bool conforming = s.mesh == "conforming";
    if (conforming) touch_in_slots(host, h);
    const Cells c = two_layers(s.cells, conforming, conforming ? 1 : 2);
    const auto nodes = static_cast<std::int64_t>(c.nodes.size()) / 2,
               cells = static_cast<std::int64_t>(c.bodies.size());
    host.create(
        "delam_mesh_create", [&] { return delam_mesh_create(h.context, 2, nodes, c.nodes.data(), &h.mesh); },
        [&] { return delam_mesh_destroy(&h.mesh), DELAM_OK; });
    if (conforming) {
        CHANGE(delam_mesh_add_conforming_cells, h.mesh, DELAM_QUAD4, cells, c.connectivity.data(), c.bodies.data(), 0);
        CHANGE(delam_mesh_add_all_interfaces, h.mesh, 0.0, &index);
        CHANGE(delam_mesh_add_seams, h.mesh, 0.0, &index);
        return;
    }
    CHANGE(delam_mesh_add_cells, h.mesh, DELAM_QUAD4, cells, c.connectivity.data(), c.bodies.data(), 0);
    CHANGE(delam_mesh_add_mortar_interface, h.mesh, 0, 1, 0.0, &index);
}

void make_law(Host& host, Handles& h, const Strip& s, laws::Bilinear& bilinear) {
    const auto destroy = [&] { return delam_law_destroy(&h.law), DELAM_OK; };
    const auto set = [&](const char* key, double value) {
        host.query(std::string("delam_law_set ") + key, [&] { return delam_law_set(h.law, key, value); });
    };
    if (s.law == "host") {
        host.create(
            "delam_law_create_host",
            [&] {
                return delam_law_create_host(h.context, "bilinear", laws::adhesion, laws::dissipation, &bilinear,
                                             &h.law);
            },
            destroy);
    } else {
        host.create(
            "delam_law_create", [&] { return delam_law_create(h.context, s.law.c_str(), &h.law); }, destroy);
        set("normal_onset", s.brittle ? 0.01 : 100.0);
        set("tangential_onset", s.brittle ? 0.01 : 160.0);
        set("normal_toughness", s.brittle ? 25.0 : 250.0);
        set("tangential_toughness", s.brittle ? 25.0 : 700.0);
    }
    set("normal_stiffness", s.brittle ? 125e15 : 125e9);
    set("tangential_stiffness", s.brittle ? 125e15 : 125e9);
    QUERY(delam_law_check, h.law);
}

// Nodes in a box.
std::vector<std::int64_t> find(Host& host, Handles& h, std::int32_t body, const std::array<double, 3>& lower,
                               const std::array<double, 3>& upper) {
    std::int64_t count = 0;
    QUERY(delam_mesh_find_nodes, h.mesh, body, lower.data(), upper.data(), 0, nullptr, &count);
    std::vector<std::int64_t> nodes(at(count));
    QUERY(delam_mesh_find_nodes, h.mesh, body, lower.data(), upper.data(), count, nodes.data(), &count);
    return nodes;
}

// The upper body as a host would provide it: with the stiffness that the library itself assembles.
void give_stiffness(Host& host, Handles& h) {
    std::int64_t rows = 0, entries = 0;
    QUERY(delam_problem_body_matrix, h.problem, 1, &rows, &entries, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> starts(at(rows) + 1), columns(at(entries));
    std::vector<double> values(at(entries));
    QUERY(delam_problem_body_matrix, h.problem, 1, &rows, &entries, starts.data(), columns.data(), values.data());
    const std::vector<std::int64_t> own = find(host, h, 1, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
    QUERY(delam_problem_set_stiffness, h.problem, static_cast<std::int64_t>(own.size()), own.data(), nullptr,
          starts.data(), columns.data(), values.data(), -1, nullptr, 0);
}

// A distance of the faces for each pair, 0 ahead of the notch.
std::vector<double> gaps_of_notch(Host& host, Handles& h, const Strip& s) {
    std::int64_t pairs = 0;
    QUERY(delam_mesh_interface_size, h.mesh, 0, nullptr, nullptr, &pairs, nullptr, nullptr);
    std::vector<std::int64_t> node_b(at(pairs));
    QUERY(delam_mesh_interface_pairs, h.mesh, 0, nullptr, node_b.data(), nullptr, nullptr);
    std::int64_t node_count = 0;
    QUERY(delam_mesh_size, h.mesh, nullptr, &node_count, nullptr, nullptr, nullptr);
    const auto dim = at(s.dimension);
    std::vector<double> nodes(at(node_count) * dim);
    QUERY(delam_mesh_nodes, h.mesh, static_cast<std::int64_t>(nodes.size()), nodes.data());
    std::vector<double> gaps;
    for (const std::int64_t node : node_b) gaps.push_back(nodes[at(node) * dim] < notch - 1e-4 ? 1e-6 : 0.0);
    return gaps;
}

void make_problem(Host& host, Handles& h, const Strip& s) {
    host.create(
        "delam_problem_create", [&] { return delam_problem_create(h.context, h.mesh, &h.problem); },
        [&] { return delam_problem_destroy(&h.problem), DELAM_OK; });
    QUERY(delam_problem_set_elastic, h.problem, -1, 75e9, 0.3);
    QUERY(delam_problem_set_law, h.problem, 0, h.law);

    const auto dim = at(s.dimension);
    const std::vector<double> gaps = gaps_of_notch(host, h, s);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < gaps.size(); ++p)
        if (gaps[p] > 0.0) open.push_back(static_cast<std::int64_t>(p));
    const std::vector<double> zero(open.size(), 0.0);
    QUERY(delam_problem_set_adhesion, h.problem, 0, static_cast<std::int64_t>(open.size()), open.data(), zero.data(),
          0);

    const std::array<double, 2> times{0.0, 2.0}, peel{0.0, end};
    std::int64_t pull = -1;
    CHANGE(delam_problem_add_pattern, h.problem, "peel", 2, times.data(), peel.data(), &pull);
    const std::array<double, 3> low{0.0, 0.0, 0.0};
    const std::array<double, 3> bottom =
        s.dimension == 2 ? std::array{length, 0.0, 0.0} : std::array{length, width, 0.0};
    const std::vector<std::int64_t> held = find(host, h, 0, low, bottom);
    for (std::size_t axis = 0; axis < dim; ++axis) {
        std::array<double, 3> direction{};
        direction[axis] = 1.0;
        CHANGE(delam_problem_prescribe_nodes, h.problem, static_cast<std::int64_t>(held.size()), held.data(),
               direction.data(), 0, nullptr, nullptr, 0);
    }
    std::array<double, 3> top_left{0.0, 2 * layer, 0.0}, top_right = top_left, up{0.0, 1.0, 0.0};
    const std::array<double, 3> along{1.0, 0.0, 0.0};
    if (s.dimension == 3) {
        top_left = {0.0, 0.0, 2 * layer};
        top_right = {0.0, width, 2 * layer};
        up = {0.0, 0.0, 1.0};
    }
    const std::vector<std::int64_t> edge = find(host, h, 1, top_left, top_right);
    const std::vector<double> one(edge.size(), 1.0);
    CHANGE(delam_problem_prescribe_nodes, h.problem, static_cast<std::int64_t>(edge.size()), edge.data(), up.data(), 1,
           &pull, one.data(), 0);
    if (s.strained) {
        std::array<double, 3> right = top_left, far = top_right;
        right[0] = far[0] = length;
        const std::vector<std::int64_t> stop = find(host, h, 1, right, far);
        CHANGE(delam_problem_prescribe_nodes, h.problem, static_cast<std::int64_t>(stop.size()), stop.data(),
               along.data(), 0, nullptr, nullptr, 0);
        const std::array<double, 2> ramp{0.0, 1.0};
        std::int64_t dead = -1, heat = -1, apart = -1;
        CHANGE(delam_problem_add_pattern, h.problem, "push", 2, times.data(), ramp.data(), &dead);
        std::vector<double> force(edge.size() * dim, 0.0);
        for (std::size_t i = 0; i < edge.size(); ++i) force[i * dim] = 1e3;
        CHANGE(delam_problem_add_forces, h.problem, dead, static_cast<std::int64_t>(edge.size()), edge.data(),
               force.data(), 0);
        CHANGE(delam_problem_add_pattern, h.problem, "heat", 2, times.data(), ramp.data(), &heat);
        const std::array<double, 6> strain{1e-4, 1e-4, 1e-4, 0.0, 0.0, 0.0};
        CHANGE(delam_problem_add_eigenstrain, h.problem, heat, 1, strain.data());
        CHANGE(delam_problem_add_pattern, h.problem, "apart", 2, times.data(), ramp.data(), &apart);
        CHANGE(delam_problem_set_gaps, h.problem, 0, apart, nullptr, 0.0);
        CHANGE(delam_problem_set_gaps, h.problem, 0, apart, gaps.data(), 0.0);
    }
    for (const auto& option : s.texts)
        host.query("delam_problem_set_text " + option.first,
                   [&] { return delam_problem_set_text(h.problem, option.first.c_str(), option.second.c_str()); });
    for (const auto& option : s.numbers)
        host.query("delam_problem_set_number " + option.first,
                   [&] { return delam_problem_set_number(h.problem, option.first.c_str(), option.second); });
    if (s.given) give_stiffness(host, h);
    QUERY(delam_problem_check, h.problem);
    std::array<char, 17> hash{};
    QUERY(delam_problem_hash, h.problem, hash.data());
    host.transcript.add("hash", hash.data(), hash.size());
}

// A text of the library, or "" if it cannot be allocated.
std::string words(Host& host, const std::string& name, const std::function<const char*()>& ask) {
    const char* text = nullptr;
    host.query(name, [&] {
        text = ask();
        return text == nullptr || *text == '\0' ? DELAM_ERROR_MEMORY : DELAM_OK;
    });
    return text;
}

// Everything that can be read from a solver, except the counts over its lifetime.
void read(Host& host, Handles& h, const Strip& s) {
    delam_solver* solver = h.solver;
    std::int64_t count = 0;
    QUERY(delam_solver_value_count, solver, &count);
    for (std::int64_t i = 0; i < count; ++i) {
        const char* name = delam_solver_value_name(solver, i);
        if (std::strcmp(name, "bulk_factorisations") == 0 || std::strcmp(name, "field_recoveries") == 0) continue;
        double value = 0.0;
        host.query(std::string("delam_solver_value ") + name, [&] { return delam_solver_value(solver, name, &value); });
        host.transcript.add(name, &value, sizeof value);
    }
    for (const char* key :
         {"displacement", "stress", "rotation", "jump", "traction", "adhesion", "mixity", "contact", "reaction"}) {
        std::int64_t rows = 0, columns = 0;
        QUERY(delam_solver_field_shape, solver, key, -1, &rows, &columns);
        std::vector<double> values(at(rows * columns));
        host.query(std::string("delam_solver_field ") + key,
                   [&] { return delam_solver_field(solver, key, -1, rows * columns, values.data()); });
        host.transcript.add(key, values);
    }
    std::int64_t fronts = 0, points = 0;
    QUERY(delam_solver_front_count, solver, 0, &fronts, &points);
    std::vector<double> places(at(points) * at(s.dimension)), rates(at(points) * 3);
    QUERY(delam_solver_front, solver, 0, fronts, points, nullptr, nullptr, places.data(), nullptr, nullptr,
          rates.data(), nullptr, nullptr);
    host.transcript.add("places", places);
    host.transcript.add("rates", rates);
    std::vector<double> average(13);
    QUERY(delam_solver_average, solver, 1, &average[0], &average[1], &average[7]);
    host.transcript.add("average", average);
    const std::size_t patterns = s.strained ? 4 : 1;
    std::vector<double> tangent(patterns * patterns);
    QUERY(delam_solver_tangent, solver, static_cast<std::int64_t>(tangent.size()), tangent.data());
    host.transcript.add("tangent", tangent);
    std::int32_t pending = 0;
    QUERY(delam_solver_pending, solver, &pending);
    if (pending != 0) {
        QUERY(delam_solver_step_tangent, solver, static_cast<std::int64_t>(tangent.size()), tangent.data());
        host.transcript.add("step tangent", tangent);
    }
    if (s.condensed()) {
        std::int64_t unknowns = 0, entries = 0;
        QUERY(delam_solver_condensed_size, solver, &unknowns, &entries);
        std::vector<double> stiffness(at(unknowns * unknowns)), load(at(unknowns) * patterns);
        QUERY(delam_solver_condensed, solver, unknowns * unknowns, stiffness.data(), load.data(), nullptr, nullptr,
              nullptr, nullptr, nullptr);
        host.transcript.add("condensed", stiffness);
        host.transcript.add("condensed", load);
    }
    host.transcript.add("plan", words(host, "delam_solver_plan", [&] { return delam_solver_plan(solver); }));
    host.transcript.add(
        "option", words(host, "delam_solver_option", [&] { return delam_solver_option(solver, "damage_tolerance"); }));
    std::int64_t jumps = 0;
    QUERY(delam_solver_jump_count, solver, &jumps);
    host.transcript.add("jumps", &jumps, sizeof jumps);
    for (std::int64_t j = 0; j < jumps; ++j) {
        std::array<double, 2> place{};
        QUERY(delam_solver_jump, solver, j, nullptr, &place[0], &place[1], nullptr, nullptr, nullptr, nullptr, nullptr,
              nullptr, nullptr);
        host.transcript.add("jump", place.data(), sizeof place);
    }
}

std::vector<std::uint8_t> save(Host& host, delam_solver* solver) {
    std::int64_t needed = 0;
    QUERY(delam_solver_save, solver, 0, nullptr, &needed);
    std::vector<std::uint8_t> bytes(at(needed));
    QUERY(delam_solver_save, solver, needed, bytes.data(), &needed);
    return bytes;
}

}  // namespace

void analyse(Host& host, const Strip& s) {
    Handles h;
    laws::Bilinear bilinear;
    host.create(
        "delam_context_create", [&] { return delam_context_create(&h.context); },
        [&] { return delam_context_destroy(&h.context), DELAM_OK; });
    host.made(h.context);
    make_mesh(host, h, s);
    make_law(host, h, s, bilinear);
    make_problem(host, h, s);
    host.create(
        "delam_solver_create", [&] { return delam_solver_create(h.problem, 0.0, &h.solver); },
        [&] { return delam_solver_destroy(&h.solver), DELAM_OK; });
    host.watch(h.solver);

    const auto rollback = [&] { return delam_solver_rollback(h.solver); };
    const auto advance = [&](double time) {
        host.create(
            "delam_solver_advance", [&] { return delam_solver_advance(h.solver, time); }, rollback);
    };
    for (const char* key : {"time", "dissipated", "energy_release_rate"}) CHANGE(delam_solver_record, h.solver, key);
    const auto commit = [&] { CHANGE(delam_solver_commit, h.solver); };
    const auto time = [&](int k) { return 2.0 * k / s.steps; };
    std::vector<std::uint8_t> half;
    for (int k = 1; k <= s.steps; ++k) {
        if (k == s.steps) {  // another step and a displacement step, both rolled back
            advance(time(k + 1));
            host.change("delam_solver_rollback", rollback);
            host.create(
                "delam_solver_equilibrate", [&] { return delam_solver_equilibrate(h.solver, time(k), nullptr); },
                rollback);
            host.change("delam_solver_rollback", rollback);
        }
        advance(time(k));
        if (k == (s.steps + 1) / 2) read(host, h, s);
        commit();
        if (k == (s.steps + 1) / 2) half = save(host, h.solver);
    }
    read(host, h, s);
    const std::vector<std::uint8_t> last = save(host, h.solver);
    host.transcript.add("saved bytes", last);
    QUERY(delam_solver_look, h.solver, s.steps);
    QUERY(delam_solver_look, h.solver, -1);

    // Through files, and with another load history from here on.
    const std::string path = "delam-fault-" + s.name + "-" + std::to_string(gettid()) + ".state";
    QUERY(delam_solver_save_file, h.solver, path.c_str());
    QUERY(delam_solver_load_file, h.solver, path.c_str());
    std::remove(path.c_str());
    expect(save(host, h.solver) == last, s.name + ": a file holds something else");
    const std::array<double, 1> later{3.0}, back{0.5 * end};
    QUERY(delam_solver_set_history, h.solver, 0, 1, later.data(), back.data());
    advance(2.5);
    commit();
    host.transcript.add("saved bytes", save(host, h.solver));

    // Back to the middle, in this solver and in a new one, and on from there.
    QUERY(delam_solver_load, h.solver, static_cast<std::int64_t>(half.size()), half.data());
    host.transcript.add("loaded bytes", save(host, h.solver));
    for (int k = (s.steps + 1) / 2 + 1; k <= s.steps; ++k) {
        advance(time(k));
        commit();
    }
    expect(save(host, h.solver) == last, s.name + ": an analysis that was loaded ends elsewhere");
    host.watch(nullptr);
    host.create(
        "delam_solver_create", [&] { return delam_solver_create(h.problem, 0.0, &h.other); },
        [&] { return delam_solver_destroy(&h.other), DELAM_OK; });
    QUERY(delam_solver_load, h.other, static_cast<std::int64_t>(last.size()), last.data());
    expect(save(host, h.other) == last, s.name + ": what a new solver has loaded is something else");
}

bool Strip::condensed() const {
    for (const auto& [key, value] : texts)
        if (key == "reduction") return value == "condensed";
    return false;
}

const std::vector<Strip>& strips() {
    static const std::vector<Strip> list = [] {
        using Texts = std::vector<std::pair<std::string, std::string>>;
        std::vector<Strip> all;
        Strip s;
        s.name = "condensed";
        s.texts = Texts{{"reduction", "condensed"}};
        all.push_back(s);

        s = {};
        s.name = "brittle";
        s.cells = 42;
        s.brittle = true;
        s.texts = Texts{{"reduction", "condensed"}, {"minimisation", "accelerated"}};
        all.push_back(s);

        s = {};
        s.name = "feti";
        s.cells = 24;
        s.mesh = "conforming";
        s.strained = true;
        s.texts = Texts{{"reduction", "feti"}};
        s.numbers = {{"subdomains", 4.0}, {"threads", 2.0}};
        s.steps = 2;
        all.push_back(s);

        s = {};
        s.name = "iterated";
        s.cells = 24;
        s.strained = true;
        s.texts = Texts{{"reduction", "iterated"}};
        s.steps = 2;
        all.push_back(s);

        s = {};
        s.name = "energetic";
        s.brittle = true;
        s.texts = Texts{{"solution", "energetic"}, {"reduction", "condensed"}, {"step_control", "adaptive"}};
        s.numbers = {{"jump_tolerance", 0.1}, {"step_tolerance", 0.3}};
        s.steps = 3;
        all.push_back(s);

        s = {};
        s.name = "host-law";
        s.mesh = "projected";
        s.given = true;
        s.law = "host";
        s.texts = Texts{{"reduction", "condensed"}, {"mixity_rule", "converged"}};
        s.steps = 3;
        all.push_back(s);

        s = {};
        s.name = "space";
        s.dimension = 3;
        s.cells = 7;
        s.strained = true;
        s.texts = Texts{{"reduction", "condensed"}, {"kinematics", "linear"}};
        s.steps = 3;
        all.push_back(s);

        s = {};
        s.name = "space-feti";
        s.dimension = 3;
        s.cells = 12;
        s.texts = Texts{{"reduction", "feti"}};
        s.numbers = {{"subdomains", 4.0}};
        s.steps = 2;
        all.push_back(s);
        return all;
    }();
    return list;
}

}  // namespace faults
