// SPDX-License-Identifier: BSD-3-Clause
#include "step_file.hpp"

#include <algorithm>
#include <utility>

#include "call.hpp"
#include "h5.hpp"

namespace cli {

namespace {

struct Field {
    std::vector<double> values;
    std::size_t rows = 0;
    std::size_t columns = 0;
};

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

// ParaView knows vectors of 3 and symmetric tensors of 6 (xx, yy, zz, xy, yz, zx); in 2D the remaining components are
// zero.
Field padded(const Field& field, std::size_t columns) {
    Field out{std::vector<double>(field.rows * columns, 0.0), field.rows, columns};
    for (std::size_t i = 0; i < field.rows; ++i)
        std::copy_n(field.values.begin() + static_cast<std::ptrdiff_t>(i * field.columns), field.columns,
                    out.values.begin() + static_cast<std::ptrdiff_t>(i * columns));
    return out;
}

bool wants(const Scene& scene, const std::string& name) {
    return std::find(scene.output.fields.begin(), scene.output.fields.end(), name) != scene.output.fields.end();
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

void write_interface(const Model& model, delam_solver* solver, const Scene& scene, hid_t parent, std::int64_t index,
                     const Field& displacement) {
    const h5::Group group(h5::new_group(parent, "interface_" + std::to_string(index)), "fields.h5");
    for (const auto& [name, key] : {std::pair{"zeta", "adhesion"}, {"mixity", "mixity"}, {"contact", "contact"}})
        if (wants(scene, name)) h5::write(group.get(), name, fetch(model, solver, key, index).values, 0);
    for (const char* name : {"jump", "traction"})
        if (wants(scene, name)) h5::write(group.get(), name, padded(fetch(model, solver, name, index), 3).values, 3);
    if (wants(scene, "front")) write_front(model, solver, group.get(), index);
    if (displacement.rows == 0) return;
    // Mean of the two faces, so that the block can be warped with the bodies.
    std::int64_t pairs = 0;
    const std::string what = "pairs of an interface";
    call(model.context.get(),
         delam_mesh_interface_size(model.mesh.get(), index, nullptr, nullptr, &pairs, nullptr, nullptr), what);
    std::vector<std::int64_t> a(static_cast<std::size_t>(pairs));
    std::vector<std::int64_t> b(a.size());
    call(model.context.get(), delam_mesh_interface_pairs(model.mesh.get(), index, a.data(), b.data(), nullptr, nullptr),
         what);
    std::vector<double> mean(a.size() * 3);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            mean[3 * i + c] = 0.5 * (displacement.values[3 * static_cast<std::size_t>(a[i]) + c] +
                                     displacement.values[3 * static_cast<std::size_t>(b[i]) + c]);
    h5::write(group.get(), "displacement", mean, 3);
}

}  // namespace

std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time) {
    const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "fields.h5");
    h5::require(H5Pset_fapl_core(access.get(), std::size_t{1} << 20, false), "fields.h5");
    const h5::File file(H5Fcreate("step", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), "fields.h5");
    {
        const h5::Group group(h5::new_group(file.get(), "step"), "fields.h5");
        h5::attribute(group.get(), "step", step);
        h5::attribute(group.get(), "time", time);
        Field displacement;
        if (wants(scene, "displacement")) {
            displacement = padded(fetch(model, solver, "displacement", -1), 3);
            h5::write(group.get(), "displacement", displacement.values, 3);
        }
        if (wants(scene, "stress"))
            h5::write(group.get(), "stress", padded(fetch(model, solver, "stress", -1), 6).values, 6);
        if (wants(scene, "rotation")) {
            // In the plane the rotation is about z.
            Field rotation = fetch(model, solver, "rotation", -1);
            if (rotation.columns == 1) {
                Field about_z{std::vector<double>(rotation.rows * 3, 0.0), rotation.rows, 3};
                for (std::size_t i = 0; i < rotation.rows; ++i) about_z.values[3 * i + 2] = rotation.values[i];
                rotation = std::move(about_z);
            }
            h5::write(group.get(), "rotation", rotation.values, 3);
        }
        double largest = 0;
        if (wants(scene, "displacement") || wants(scene, "stress") || wants(scene, "rotation"))
            call(model.context.get(), delam_solver_value(solver, "rotation_max", &largest),
                 std::string("rotation_max"));
        h5::attribute(group.get(), "rotation_max", largest);
        for (std::size_t i = 0; i < model.interfaces.size(); ++i)
            write_interface(model, solver, scene, group.get(), static_cast<std::int64_t>(i), displacement);
    }
    h5::require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "fields.h5");
    const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
    if (size < 0) throw OutputFailure("fields.h5", "HDF5 gave no image of a step");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file.get(), bytes.data(), bytes.size()) < 0)
        throw OutputFailure("fields.h5", "HDF5 gave no image of a step");
    return bytes;
}

}  // namespace cli
