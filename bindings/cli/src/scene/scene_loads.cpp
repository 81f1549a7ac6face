// SPDX-License-Identifier: BSD-3-Clause
// Patterns, supports, loads and dead forces of a scene.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/scene_parts.hpp"

namespace cli {

const Places any_place{"point", "box", "patch", "set", "body", "control"};

namespace {

// Returns those places that a scene with layers, or with a mesh, can have.
Places places_of(const Scene& scene, const Places& places) {
    Places out;
    for (const std::string& place : places)
        if (scene.mesh || (place != "set" && place != "body")) out.push_back(place);
    return out;
}

}  // namespace

namespace {

std::size_t axis_of(const Table& table, std::string_view key, char letter, const Geometry& geometry) {
    const std::string axes = geometry.dimension == 2 ? "xy" : "xyz";
    const std::size_t axis = axes.find(letter);
    if (axis == std::string::npos)
        table.fail(
            key, fmt::format("'{}' is no component: one of {}", letter, geometry.dimension == 2 ? "x, y" : "x, y, z"));
    return axis;
}

Patch read_patch(const Table& table, const Geometry& geometry) {
    const auto dimension = static_cast<std::size_t>(geometry.dimension);
    const std::vector<double> centre = table.numbers("centre", dimension);
    const std::string face = table.text("face");
    const std::size_t normal_axis = axis_of(table, "face", face[1], geometry);
    Patch patch{centre, centre, std::vector<double>(dimension, 0.0)};
    patch.normal[normal_axis] = face[0] == '+' ? 1.0 : -1.0;
    const std::vector<double> sizes = table.is_list("length")
                                          ? table.numbers("length", dimension - 1)
                                          : std::vector<double>(dimension - 1, table.number("length"));
    const double slack = 1e-6 * geometry.smallest_edge;
    std::size_t next = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        const double half = axis == normal_axis ? slack : 0.5 * sizes[next++];
        patch.lower[axis] -= half;
        patch.upper[axis] += half;
    }
    return patch;
}

}  // namespace

Selection read_selection(const Table& table, const Scene& scene, const Places& allowed) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    Selection out;
    out.place = table.place();
    if (table.has("name")) out.name = table.text("name");
    out.tolerance = table.number("tolerance", 1e-3 * scene.geometry.smallest_edge);
    const std::string body = scene.mesh ? "body" : "layer";
    if (table.has(body))
        out.body = static_cast<std::int32_t>(find_named(table, body, table.text(body), scene.layers, body));
    const Places places = places_of(scene, allowed);
    const auto is_place = [&](const char* key) { return std::find(places.begin(), places.end(), key) != places.end(); };
    const bool other =
        std::any_of(places.begin(), places.end(), [&](const std::string& p) { return p != "body" && table.has(p); });
    const bool whole = is_place("body") && !other;
    if (is_place("control") && table.has("control")) {
        out.shape = ControlNode{find_named(table, "control", table.text("control"), scene.controls, "control node")};
    } else if (whole) {
        out.shape = NamedSet{};
    } else if (table.has("set")) {
        out.shape = NamedSet{set_name(table, "set", scene)};
    } else if (table.has("point")) {
        out.shape = Point{table.numbers("point", dimension)};
    } else if (table.has("box")) {
        const Table box = table.table("box");
        Box shape{box.numbers("lower", dimension), box.numbers("upper", dimension)};
        for (std::size_t i = 0; i < dimension; ++i)
            if (shape.upper[i] < shape.lower[i])
                box.fail("upper", fmt::format("entry {} is {}: >= {} is expected", i, shape.upper[i], shape.lower[i]));
        out.shape = std::move(shape);
    } else {
        out.shape = read_patch(table.table("patch"), scene.geometry);
    }
    return out;
}

namespace {

std::vector<double> read_direction(const Table& table, const Geometry& geometry) {
    std::vector<double> direction = table.numbers("direction", static_cast<std::size_t>(geometry.dimension));
    if (std::all_of(direction.begin(), direction.end(), [](double d) { return std::fpclassify(d) == FP_ZERO; }))
        table.fail("direction", "is zero: any length > 0");
    return direction;
}

}  // namespace

// Either `direction`, or components by letter under `key`.
std::vector<std::vector<double>> read_directions(const Table& table, std::string_view key, const Geometry& geometry) {
    if (table.has("direction")) return {read_direction(table, geometry)};
    std::vector<std::vector<double>> out;
    std::string seen;
    for (const std::string& name : table.texts(key)) {
        const std::size_t axis = axis_of(table, key, name.size() == 1 ? name[0] : '?', geometry);
        if (seen.find(name) != std::string::npos) table.fail(key, fmt::format("\"{}\" is listed twice", name));
        seen += name;
        out.emplace_back(static_cast<std::size_t>(geometry.dimension), 0.0);
        out.back()[axis] = 1.0;
    }
    return out;
}

std::vector<Term> read_terms(const Table& table, const Scene& scene) {
    const auto one = [&scene](const Table& from) {
        return Term{find_named(from, "pattern", from.text("pattern"), scene.patterns, "pattern"),
                    from.number("coefficient")};
    };
    if (!table.has("terms")) return {one(table)};
    std::vector<Term> out;
    for (const Table& term : table.tables("terms")) {
        out.push_back(one(term));
    }
    if (out.empty()) table.fail("terms", "is empty: at least one is expected");
    return out;
}

namespace {

// A total force, or a force per area.
void read_force(const Table& table, const Scene& scene, DeadForce& force) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    if (table.has("force")) {
        force.force = table.numbers("force", dimension);
        return;
    }
    if (table.has("traction")) {
        force.kind = ForceKind::traction;
        force.force = table.numbers("traction", dimension);
        return;
    }
    force.kind = ForceKind::pressure;
    force.force = {table.number("pressure")};
}

}  // namespace

// Returns the instant of the scene at this time, which must lie within its times.
double instant_of(const Table& table, const char* key, const Scene& scene) {
    const double time = table.number(key);
    const std::vector<double>& times = scene.times;
    const auto first = times.begin() + 1, last = times.end() - 1;
    auto next = std::lower_bound(first, last, time);
    if (next == last || (next != first && time - *(next - 1) < *next - time)) --next;
    const double near = *next;
    // Instants that steps have divided are not to the last digit what people write.
    if (std::abs(time - near) <= 1e-9 * std::max(std::abs(near), times.back() - times.front())) return near;
    if (!(time > times.front() && time < times.back()))
        table.fail(key, fmt::format("{} is not allowed: an instant between {} and {}, the first and the last", time,
                                    times.front(), times.back()));
    table.fail(
        key, fmt::format("{} is no instant of [time]: a load step must end there; the nearest does at {}", time, near));
}

// Reads `key` and the time by which its change is over; nothing: the scene does not give it.
std::optional<Change> read_change(const Table& table, const char* key, const char* over, const Scene& scene) {
    if (!table.has(key)) return {};
    if (scene.times.size() < 3) table.fail(key, "there is one load step alone: nothing begins or ends within it");
    Change change{instant_of(table, key, scene), {}};
    if (table.has(over)) change.over = table.number(over);
    if (change.over && !(*change.over > change.at))
        table.fail(over, fmt::format("{} is not allowed: > {} ({})", *change.over, change.at, key));
    return change;
}

// Reads when a support or a load holds.
void read_times_of(const Table& table, const Scene& scene, Prescription& own) {
    own.begin = read_change(table, "from", "reached", scene);
    own.end = read_change(table, "until", "released", scene);
    if (own.begin && own.end && !(own.end->at > own.begin->at))
        table.fail("until", fmt::format("{} is not allowed: > {} (from)", own.end->at, own.begin->at));
    if (own.end && !own.end->over)
        own.end->over = *std::upper_bound(scene.times.begin(), scene.times.end(), own.end->at);
}

void read_patterns(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("patterns")) {
        PatternData pattern;
        pattern.name = new_name(table, scene.patterns, "pattern");
        const bool plain = std::all_of(pattern.name.begin(), pattern.name.end(), [](char c) {
            return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
        });
        if (!plain)
            table.fail("name", fmt::format("\"{}\" is not allowed: letters, digits, '_' and '-'", pattern.name));
        pattern.times = table.numbers("times");
        pattern.values = table.numbers("values", pattern.times.size());
        for (std::size_t i = 1; i < pattern.times.size(); ++i)
            if (!(pattern.times[i] > pattern.times[i - 1]))
                table.fail("times", fmt::format("entry {} is {}: > {} is expected (strictly increasing)", i,
                                                pattern.times[i], pattern.times[i - 1]));
        pattern.place = table.place();
        scene.patterns.push_back(std::move(pattern));
    }
}

void read_supports_and_loads(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("supports")) {
        scene.prescriptions.push_back({read_selection(table, scene),
                                       read_directions(table, "fix", scene.geometry),
                                       {},
                                       scene.mesh && table.flag("mean"),
                                       table.place()});
        read_times_of(table, scene, scene.prescriptions.back());
    }
    for (const Table& table : root.tables("loads")) {
        scene.prescriptions.push_back({read_selection(table, scene),
                                       read_directions(table, "component", scene.geometry), read_terms(table, scene),
                                       scene.mesh && table.flag("mean"), table.place()});
        read_times_of(table, scene, scene.prescriptions.back());
    }
}

void read_forces(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("forces")) {
        const Places places{"point", "patch", "set", "control"};
        DeadForce force;
        force.where = read_selection(table, scene, places);
        read_force(table, scene, force);
        force.pattern = find_named(table, "pattern", table.text("pattern"), scene.patterns, "pattern");
        force.place = table.place();
        scene.forces.push_back(std::move(force));
    }
}

}  // namespace cli
