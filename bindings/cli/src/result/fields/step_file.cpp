// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/step_file.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "file/file.hpp"
#include "model/call.hpp"
#include "result/fields/h5.hpp"

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
void write_front(const Model& model, const delam_solver* solver, hid_t group, std::int64_t index) {
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
    h5::write(group, "front_starts", starts, 0);
    h5::write(group, "front_closed", closed, 0);
    h5::write(group, "front_points", padded(places, 3).values, 3);
    h5::write(group, "front_directions", padded(directions, 3).values, 3);
    h5::write(group, "front_lengths", lengths, 0);
    h5::write(group, "front_rates", rates, 3);
    h5::write(group, "front_zone_lengths", zones, 0);
    h5::write(group, "front_zone_pairs", pairs, 0);
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

void write_interface(const Model& model, delam_solver* solver, const Scene& scene, hid_t parent, std::int64_t index,
                     const DisplacementOf& displacement) {
    const h5::Group group(h5::new_group(parent, "interface_" + std::to_string(index)), "fields.h5");
    for (const auto& [name, key] : {std::pair{"zeta", "adhesion"}, {"mixity", "mixity"}, {"contact", "contact"}})
        if (wants(scene, name)) h5::write(group.get(), name, fetch(model, solver, key, index).values, 0);
    for (const char* name : {"jump", "traction"})
        if (wants(scene, name)) h5::write(group.get(), name, padded(fetch(model, solver, name, index), 3).values, 3);
    if (wants(scene, "front")) write_front(model, solver, group.get(), index);
    if (!displacement) return;
    // Mean of the two faces, so that the block can be warped with the bodies.
    const Pairs pairs = pairs_of(model, index);
    std::vector<double> mean(pairs.a.size() * 3);
    for (std::size_t i = 0; i < pairs.a.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            mean[3 * i + c] = 0.5 * (displacement(pairs.a[i])[c] + displacement(pairs.b[i])[c]);
    h5::write(group.get(), "displacement", mean, 3);
}

// Who has the fields of nodes and cells: writes them into the group of a step, or leaves room for them, and knows the
// displacements at interfaces and the largest rotation of a cell.
struct BulkSource {
    std::function<void(hid_t group)> write;
    DisplacementOf displacement;
    std::function<double()> largest_rotation;
    std::function<void(hid_t group)> write_mesh_error;  // empty: it is not estimated
};

constexpr const char* mesh_error_keys[] = {"mesh_error", "mesh_error_fronts", "mesh_excess"};

// Everything that a step file says, in its order.
void write_step(hid_t file, const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step,
                double time, const BulkSource& source) {
    const h5::Group group(h5::new_group(file, "step"), "fields.h5");
    h5::attribute(group.get(), "step", step);
    h5::attribute(group.get(), "time", time);
    source.write(group.get());
    h5::attribute(group.get(), "rotation_max", bulk_fields(scene).empty() ? 0.0 : source.largest_rotation());
    if (source.write_mesh_error && !bulk_fields(scene).empty()) source.write_mesh_error(group.get());
    for (std::size_t i = 0; i < model.interfaces.size(); ++i)
        write_interface(model, solver, scene, group.get(), static_cast<std::int64_t>(i),
                        wants(scene, "displacement") ? source.displacement : DisplacementOf());
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

}  // namespace

std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time,
                       bool estimate) {
    h5::begin();
    const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "fields.h5");
    // The image grows once, to about what it takes: HDF5 clears what it allocates.
    const auto [node_rows, cell_rows] = mesh_rows(model);
    std::size_t room = std::size_t{1} << 16;
    for (const BulkField& field : bulk_fields(scene))
        room += field.columns * sizeof(double) * static_cast<std::size_t>(field.of_nodes ? node_rows : cell_rows);
    h5::require(H5Pset_fapl_core(access.get(), room, false), "fields.h5");
    const h5::File file(h5::create("step", access.get()), "fields.h5");
    Field displacement;
    BulkSource source;
    source.write = [&](hid_t group) {
        for (const BulkField& field : bulk_fields(scene)) {
            Field rows = stored(field, fetch(model, solver, field.name, -1));
            h5::write(group, field.name, rows.values, field.columns);
            if (field.name == "displacement") displacement = std::move(rows);
        }
    };
    source.displacement = [&](std::int64_t node) { return &displacement.values[3 * static_cast<std::size_t>(node)]; };
    source.largest_rotation = [&] {
        double largest = 0;
        call(model.context.get(), delam_solver_value(solver, "rotation_max", &largest), std::string("rotation_max"));
        return largest;
    };
    const auto write_mesh_error = [&](hid_t group) {
        for (const char* key : mesh_error_keys) {
            double part = 0;
            call(model.context.get(), delam_solver_value(solver, key, &part), std::string(key));
            h5::attribute(group, key, part);
        }
    };
    if (estimate) source.write_mesh_error = write_mesh_error;
    write_step(file.get(), model, solver, scene, step, time, source);
    h5::require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "fields.h5");
    const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
    if (size < 0) throw OutputFailure("fields.h5", "HDF5 gave no image of a step");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file.get(), bytes.data(), bytes.size()) < 0)
        throw OutputFailure("fields.h5", "HDF5 gave no image of a step");
    return bytes;
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
    std::vector<Room> rooms;
    BulkSource source;
    source.write = [&, &node_count = node_rows, &cell_count = cell_rows](hid_t group) {
        for (const BulkField& field : wanted) {
            const std::int64_t rows = field.of_nodes ? node_count : cell_count;
            rooms.push_back(
                {field, rows, h5::reserve(group, field.name, rows, static_cast<std::int64_t>(field.columns))});
        }
    };
    source.displacement = [&](std::int64_t node) {
        return &displacement[3 * static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                                          nodes.begin())];
    };
    source.largest_rotation = [&] { return bulk.largest_rotation(); };
    try {
        h5::File file(h5::create(beside), beside);
        write_step(file.get(), model, solver, scene, step, time, source);
        h5::require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), beside);
        file.close(beside);
        fill_holes(beside);
        if (!rooms.empty()) bulk.write(beside, rooms);
        synchronise(beside);
        rename_file(beside, path);
    } catch (...) {
        std::error_code code;
        std::filesystem::remove(beside, code);
        throw;
    }
}

bool is_step_file(const std::string& path, std::size_t step) {
    try {
        const h5::File file(h5::open(path), path);
        const h5::Group group(H5Gopen2(file.get(), "step", H5P_DEFAULT), path);
        return h5::read_number(group.get(), "step") == static_cast<double>(step);
    } catch (const OutputFailure&) {
        return false;
    }
}

std::vector<FileRange> copy_step(hid_t file, const std::string& path, hid_t parent, const std::string& name,
                                 const Scene& scene) {
    const h5::Group from(H5Gopen2(file, "step", H5P_DEFAULT), path);
    const h5::Group to(h5::new_group(parent, name), "fields.h5");
    h5::attribute(to.get(), "step", static_cast<std::int64_t>(h5::read_number(from.get(), "step")));
    for (const char* number : {"time", "rotation_max"})
        h5::attribute(to.get(), number, h5::read_number(from.get(), number));
    std::vector<FileRange> ranges;
    std::vector<std::string> small;
    for (const BulkField& field : bulk_fields(scene)) {
        const h5::Extent extent = h5::extent(from.get(), field.name);
        if (extent.offset < 0) {
            small.push_back(field.name);  // compressed: a step of `delam`
            continue;
        }
        const std::int64_t place = h5::reserve(to.get(), field.name, extent.rows, extent.columns);
        ranges.push_back({path, extent.offset, 8 * extent.rows * extent.columns, place});
    }
    for (hsize_t i = 0; H5Lexists(from.get(), ("interface_" + std::to_string(i)).c_str(), H5P_DEFAULT) > 0; ++i)
        small.push_back("interface_" + std::to_string(i));
    for (const std::string& item : small)
        h5::require(H5Ocopy(from.get(), item.c_str(), to.get(), item.c_str(), H5P_DEFAULT, H5P_DEFAULT), "fields.h5");
    return ranges;
}

}  // namespace cli
