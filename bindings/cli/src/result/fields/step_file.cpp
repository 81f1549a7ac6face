// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/step_file.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "file/file.hpp"
#include "model/library/call.hpp"
#include "result/fields/h5.hpp"
#include "result/fields/step_rows.hpp"

namespace cli {

namespace {

Field fetch(const Model& model, delam_solver* solver, const std::string& key, std::int64_t part) {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    call(model.context.get(), delam_solver_field_shape(solver, key.c_str(), part, &rows, &columns), "field " + key);
    Field out{std::vector<double>(static_cast<std::size_t>(rows * columns)), static_cast<std::size_t>(rows),
              static_cast<std::size_t>(columns)};
    call(model.context.get(), delam_solver_field(solver, key.c_str(), part, rows * columns, out.values.data()),
         "field " + key);
    return out;
}

// The crack fronts of an interface; writes nothing if there are none.
void write_front(const Model& model, const delam_solver* solver, StepRows& step, const std::string& group,
                 std::int64_t index) {
    std::int64_t fronts = 0;
    std::int64_t count = 0;
    const std::string what = "crack fronts";
    call(model.context.get(), delam_solver_front_count(solver, index, &fronts, &count), what);
    if (fronts == 0) return;
    std::int32_t dimension = 0;
    call(model.context.get(), delam_mesh_size(model.mesh.get(), &dimension, nullptr, nullptr, nullptr, nullptr), what);
    const auto points = static_cast<std::size_t>(count);
    const auto columns = static_cast<std::size_t>(dimension);
    std::vector<std::int64_t> starts(static_cast<std::size_t>(fronts) + 1);
    std::vector<std::int32_t> closed(static_cast<std::size_t>(fronts));
    Field places{std::vector<double>(points * columns), points, columns};
    Field directions = places;
    std::vector<double> lengths(points), rates(3 * points), zones(points), pairs(points);
    call(model.context.get(),
         delam_solver_front(solver, index, fronts, count, starts.data(), closed.data(), places.values.data(),
                            directions.values.data(), lengths.data(), rates.data(), zones.data(), pairs.data()),
         what);
    step.rows(group + "front_starts", starts, 0);
    step.rows(group + "front_closed", closed, 0);
    step.rows(group + "front_points", padded(places, 3).values, 3);
    step.rows(group + "front_directions", padded(directions, 3).values, 3);
    step.rows(group + "front_lengths", lengths, 0);
    step.rows(group + "front_rates", rates, 3);
    step.rows(group + "front_zone_lengths", zones, 0);
    step.rows(group + "front_zone_pairs", pairs, 0);
}

// The two nodes of each pair.
struct Pairs {
    std::vector<std::int64_t> a, b;
};

Pairs pairs_of(const Model& model, std::int64_t index) {
    std::int64_t pairs = 0;
    const std::string what = "pairs of an interface";
    call(model.context.get(),
         delam_mesh_interface_size(model.mesh.get(), index, nullptr, nullptr, &pairs, nullptr, nullptr), what);
    Pairs out{std::vector<std::int64_t>(static_cast<std::size_t>(pairs)),
              std::vector<std::int64_t>(static_cast<std::size_t>(pairs))};
    call(model.context.get(),
         delam_mesh_interface_pairs(model.mesh.get(), index, out.a.data(), out.b.data(), nullptr, nullptr), what);
    return out;
}

// Returns the place of the displacement of a node, [3]; empty: it is not wanted.
using DisplacementOf = std::function<const double*(std::int64_t node)>;

void write_interface(const Model& model, delam_solver* solver, const Scene& scene, StepRows& step, std::int64_t index,
                     const DisplacementOf& displacement) {
    const std::string name = "interface_" + std::to_string(index), group = name + "/";
    step.group(name);
    for (const auto& [field, key] : {std::pair{"zeta", "adhesion"}, {"mixity", "mixity"}, {"contact", "contact"}})
        if (wants(scene, field)) step.rows(group + field, fetch(model, solver, key, index).values, 0);
    for (const char* field : {"jump", "traction"})
        if (wants(scene, field)) step.rows(group + field, padded(fetch(model, solver, field, index), 3).values, 3);
    if (wants(scene, "front")) write_front(model, solver, step, group, index);
    if (!displacement) return;
    // Mean of the two faces, so that the block can be warped with the bodies.
    const Pairs pairs = pairs_of(model, index);
    std::vector<double> mean(pairs.a.size() * 3);
    for (std::size_t i = 0; i < pairs.a.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            mean[3 * i + c] = 0.5 * (displacement(pairs.a[i])[c] + displacement(pairs.b[i])[c]);
    step.rows(group + "displacement", mean, 3);
}

// Who has the fields of nodes and cells: writes them, or leaves room for them, and knows the displacements at
// interfaces and the largest rotation of a cell.
struct BulkSource {
    std::function<void(StepRows& step)> write;
    DisplacementOf displacement;
    std::function<double()> largest_rotation;
    std::function<void(StepRows& step)> write_estimates;  // empty: there are none
};

// Everything that a step file says, in its order.
StepRows rows_of_step(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t number, double time,
                      const BulkSource& source) {
    StepRows step;
    step.number("step", number);
    step.number("time", time);
    source.write(step);
    step.number("rotation_max", bulk_fields(scene).empty() ? 0.0 : source.largest_rotation());
    if (source.write_estimates && !bulk_fields(scene).empty()) source.write_estimates(step);
    for (std::size_t i = 0; i < model.interfaces.size(); ++i)
        write_interface(model, solver, scene, step, static_cast<std::int64_t>(i),
                        wants(scene, "displacement") ? source.displacement : DisplacementOf());
    return step;
}

// The nodes of all pairs, ascending.
std::vector<std::int64_t> interface_nodes(const Model& model) {
    std::vector<std::int64_t> nodes;
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const Pairs pairs = pairs_of(model, static_cast<std::int64_t>(i));
        nodes.insert(nodes.end(), pairs.a.begin(), pairs.a.end());
        nodes.insert(nodes.end(), pairs.b.begin(), pairs.b.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

// Rows of nodes and of cells.
std::pair<std::int64_t, std::int64_t> mesh_rows(const Model& model) {
    std::int64_t nodes = 0, cells = 0;
    call(model.context.get(), delam_mesh_size(model.mesh.get(), nullptr, &nodes, &cells, nullptr, nullptr),
         std::string("mesh"));
    return {nodes, cells};
}

hid_t h5_type(StepItem::Type type) {
    return type == StepItem::Type::real   ? h5::type_of<double>()
           : type == StepItem::Type::wide ? h5::type_of<std::int64_t>()
                                          : h5::type_of<std::int32_t>();
}

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF"); }

}  // namespace

std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time,
                       const StepEstimates& estimates) {
    Field displacement;
    BulkSource source;
    source.write = [&](StepRows& to) {
        for (const BulkField& field : bulk_fields(scene)) {
            Field rows = stored(field, fetch(model, solver, field.name, -1));
            to.rows(field.name, rows.values, field.columns);
            if (field.name == "displacement") displacement = std::move(rows);
        }
    };
    source.displacement = [&](std::int64_t node) { return &displacement.values[3 * static_cast<std::size_t>(node)]; };
    source.largest_rotation = [&] {
        double largest = 0;
        call(model.context.get(), delam_solver_value(solver, "rotation_max", &largest), std::string("rotation_max"));
        return largest;
    };
    source.write_estimates = [&](StepRows& to) {
        std::vector<const char*> keys;
        if (estimates.mesh_error) keys = {"mesh_error", "mesh_error_fronts", "mesh_excess"};
        if (estimates.rotation_error) keys.push_back("rotation_error");
        for (const char* key : keys) {
            double part = 0;
            call(model.context.get(), delam_solver_value(solver, key, &part), std::string(key));
            to.number(key, part);
        }
    };
    return rows_of_step(model, solver, scene, step, time, source).bytes();
}

void write_step_file(const std::string& path, const Model& model, delam_solver* solver, const Scene& scene,
                     std::int64_t step, double time, Bulk& bulk) {
    constexpr std::int64_t numbers_of_a_pair = 16, besides = std::int64_t{1} << 20;
    const std::vector<BulkField> wanted = bulk_fields(scene);
    const std::vector<std::int64_t> nodes = interface_nodes(model);
    const std::vector<double> displacement =
        wanted.empty() ? std::vector<double>() : bulk.recover(model, solver, nodes);
    const auto [node_rows, cell_rows] = mesh_rows(model);
    std::int64_t bytes = besides + 8 * numbers_of_a_pair * static_cast<std::int64_t>(nodes.size());
    for (const BulkField& field : wanted)
        bytes += 8 * static_cast<std::int64_t>(field.columns) * (field.of_nodes ? node_rows : cell_rows);
    const std::string beside = path + ".new";
    require_room(beside, bytes);
    BulkSource source;
    source.write = [&, &node_count = node_rows, &cell_count = cell_rows](StepRows& to) {
        for (const BulkField& field : wanted)
            to.room(field.name, field.of_nodes ? node_count : cell_count, static_cast<std::int64_t>(field.columns));
    };
    source.displacement = [&](std::int64_t node) {
        return &displacement[3 * static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                                          nodes.begin())];
    };
    source.largest_rotation = [&] { return bulk.largest_rotation(); };
    try {
        const StepRows rows = rows_of_step(model, solver, scene, step, time, source);
        remove_file(beside);
        Appender(beside, 0).append(rows.bytes());
        std::vector<Room> rooms;
        std::int64_t end = 0;
        for (const StepItem& item : rows.items()) {
            end = item.offset + item.bytes();
            if (item.kind != StepItem::Kind::room) continue;
            const auto is_it = [&item](const BulkField& field) { return field.name == item.name; };
            rooms.push_back({*std::find_if(wanted.begin(), wanted.end(), is_it), item.rows(), item.offset});
        }
        if (!rooms.empty()) {
            std::filesystem::resize_file(beside, static_cast<std::uintmax_t>(end));
            fill_holes(beside);
            bulk.write(beside, rooms);
        }
        synchronise(beside);
        rename_file(beside, path);
    } catch (const std::filesystem::filesystem_error& error) {
        remove_file(beside);
        throw OutputFailure(beside, error.code().message());
    } catch (...) {
        std::error_code code;
        std::filesystem::remove(beside, code);
        throw;
    }
}

bool is_step_file(const std::string& path, std::size_t step) {
    try {
        const std::string bytes = read_step(path);
        if (is_hdf5(bytes)) {
            const h5::File file(h5::open(path), path);
            const h5::Group group(H5Gopen2(file.get(), "step", H5P_DEFAULT), path);
            return h5::read_number(group.get(), "step") == static_cast<double>(step);
        }
        return step_number(step_items(bytes, path), bytes, "step") == static_cast<double>(step);
    } catch (const Failure&) {
        return false;
    }
}

bool copy_earlier_step(std::string_view bytes, const std::string& path, hid_t parent, const std::string& name) {
    if (!is_hdf5(bytes)) return false;
    const h5::File from(h5::open(path), path);
    h5::require(H5Ocopy(from.get(), "step", parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path);
    return true;
}

std::vector<FileRange> copy_step(std::string_view bytes, const std::string& path, hid_t parent,
                                 const std::string& name) {
    const h5::Group to(h5::new_group(parent, name), "fields.h5");
    std::unique_ptr<h5::Group> inner;
    std::string group;
    std::vector<FileRange> ranges;
    for (const StepItem& item : step_items(bytes, path)) {
        const std::size_t slash = item.name.find('/');
        if (slash != std::string::npos && item.name.substr(0, slash) != group) {
            group = item.name.substr(0, slash);
            inner = std::make_unique<h5::Group>(h5::new_group(to.get(), group), "fields.h5");
        }
        if (item.kind == StepItem::Kind::group) continue;
        const hid_t parent_of = slash == std::string::npos ? to.get() : inner->get();
        const std::string own = slash == std::string::npos ? item.name : item.name.substr(slash + 1);
        const char* from = bytes.data() + (item.kind == StepItem::Kind::room ? 0 : item.offset);
        if (item.kind == StepItem::Kind::room) {
            const std::int64_t place = h5::reserve(parent_of, own, item.rows(), item.columns);
            ranges.push_back({path, item.offset, item.bytes(), place});
        } else if (item.kind == StepItem::Kind::number) {
            h5::attribute(parent_of, own, h5_type(item.type), from);
        } else {
            h5::write(parent_of, own, h5_type(item.type), from, item.rows(), item.columns);
        }
    }
    return ranges;
}

}  // namespace cli
