// SPDX-License-Identifier: BSD-3-Clause
#include "view_fields.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "input_file.hpp"

namespace cli {

namespace {

[[noreturn]] void wrong_fields(const std::string& path, const std::string& what) {
    throw Failure(exit_scene, path + ": " + what);
}

// An identifier of HDF5, or the failure to get one.
hid_t identified(hid_t id, const std::string& path, const std::string& item) {
    if (id < 0) wrong_fields(path, item + " cannot be read (the file is damaged, or no fields.h5 of delam)");
    return id;
}

hid_t opened_fields(const std::string& path) {
    const InputFile there(path);  // says what is wrong with a file that is missing, a folder or a pipe
    return identified(h5::open(path), path, "it");
}

struct DataShape {
    std::size_t rows = 0, columns = 0;  // columns 0: a vector
};

template <class T>
std::pair<std::vector<T>, DataShape> read_data(hid_t file, const std::string& path, const std::string& item) {
    const h5::Data data(identified(H5Dopen2(file, item.c_str(), H5P_DEFAULT), path, item), item);
    const h5::Space space(identified(H5Dget_space(data.get()), path, item), item);
    std::array<hsize_t, 2> shape{0, 0};
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) < 0)
        wrong_fields(path, item + " is neither a vector nor a matrix");
    std::vector<T> values(static_cast<std::size_t>(shape[0] * (rank == 2 ? shape[1] : 1)));
    if (!values.empty() && H5Dread(data.get(), h5::type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        wrong_fields(path, item + " cannot be read (the file is damaged)");
    return {std::move(values), {static_cast<std::size_t>(shape[0]), static_cast<std::size_t>(shape[1])}};
}

std::string read_text(hid_t parent, const std::string& name) {
    if (H5Aexists(parent, name.c_str()) <= 0) return {};
    const hid_t id = H5Aopen(parent, name.c_str(), H5P_DEFAULT);
    if (id < 0) return {};
    const h5::Attribute attribute(id, name);
    const h5::Type type(H5Aget_type(attribute.get()), name);
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0) return {};
    std::string text(H5Tget_size(type.get()), '\0');
    if (H5Aread(attribute.get(), type.get(), text.data()) < 0) return {};
    return text.substr(0, text.find('\0'));
}

double attribute_number(hid_t parent, const std::string& path, const std::string& name) {
    const h5::Attribute in(identified(H5Aopen(parent, name.c_str(), H5P_DEFAULT), path, name), name);
    double value = 0;
    if (H5Aread(in.get(), H5T_NATIVE_DOUBLE, &value) < 0) wrong_fields(path, name + " cannot be read");
    return value;
}

bool has_item(hid_t parent, const std::string& name) { return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0; }

// Indices from `least` on, below `count`.
void require_indices(const std::vector<std::int64_t>& indices, std::int64_t least, std::size_t count,
                     const std::string& path, const std::string& item) {
    for (const std::int64_t index : indices)
        if (index < least || index >= static_cast<std::int64_t>(count))
            wrong_fields(path, fmt::format("{} names {}, and there are {}", item, index, count));
}

}  // namespace

FieldsFile::FieldsFile(const std::string& path) : path_(path), file_(opened_fields(path), path) {}

std::string FieldsFile::text(const std::string& name) const { return read_text(file_.get(), name); }

ViewMesh FieldsFile::mesh() const {
    ViewMesh out;
    out.dimension = static_cast<std::int32_t>(attribute_number(file_.get(), path_, "dimension"));
    DataShape shape;
    std::tie(out.points, shape) = read_data<double>(file_.get(), path_, "mesh/points");
    if (shape.columns != 3) wrong_fields(path_, fmt::format("mesh/points has {} columns, and not 3", shape.columns));
    std::tie(out.cells, shape) = read_data<std::int64_t>(file_.get(), path_, "mesh/cells");
    out.per_cell = shape.columns;
    out.body = read_data<std::int32_t>(file_.get(), path_, "mesh/body").first;
    if (out.per_cell == 0 || shape.rows != out.body.size())
        wrong_fields(path_, fmt::format("mesh/cells has {} rows, and mesh/body {}", shape.rows, out.body.size()));
    require_indices(out.cells, -1, out.nodes(), path_, "mesh/cells");
    return out;
}

std::vector<ViewInterface> FieldsFile::interfaces() const {
    std::vector<ViewInterface> out;
    const std::size_t nodes = read_data<double>(file_.get(), path_, "mesh/points").second.rows;
    for (std::size_t i = 0; has_item(file_.get(), fmt::format("interfaces/interface_{}", i)); ++i) {
        const std::string item = fmt::format("interfaces/interface_{}", i);
        const h5::Group group(identified(H5Gopen2(file_.get(), item.c_str(), H5P_DEFAULT), path_, item), item);
        ViewInterface one;
        one.name = read_text(group.get(), "name");
        one.body_a = static_cast<std::int64_t>(attribute_number(group.get(), path_, "body_a"));
        one.body_b = static_cast<std::int64_t>(attribute_number(group.get(), path_, "body_b"));
        one.nodes_a = read_data<std::int64_t>(group.get(), path_, "nodes_a").first;
        one.nodes_b = read_data<std::int64_t>(group.get(), path_, "nodes_b").first;
        if (one.nodes_a.size() != one.nodes_b.size())
            wrong_fields(path_,
                         fmt::format("{} has {} nodes_a and {} nodes_b", item, one.nodes_a.size(), one.nodes_b.size()));
        DataShape shape;
        std::tie(one.faces, shape) = read_data<std::int64_t>(group.get(), path_, "faces");
        one.per_face = shape.columns;
        if (one.body_a >= 0) require_indices(one.nodes_a, 0, nodes, path_, item + "/nodes_a");
        require_indices(one.nodes_b, 0, nodes, path_, item + "/nodes_b");
        require_indices(one.faces, 0, one.nodes_b.size(), path_, item + "/faces");
        out.push_back(std::move(one));
    }
    return out;
}

std::vector<ViewStep> FieldsFile::steps() const {
    std::vector<std::string> names;
    const h5::Group group(identified(H5Gopen2(file_.get(), "steps", H5P_DEFAULT), path_, "steps"), path_);
    const auto list = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->emplace_back(name);
        return 0;
    };
    if (H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, list, &names) < 0)
        wrong_fields(path_, "steps cannot be read (the file is damaged)");
    std::vector<ViewStep> out;
    for (const std::string& name : names) {
        const h5::Group own(identified(H5Gopen2(group.get(), name.c_str(), H5P_DEFAULT), path_, "steps/" + name), name);
        out.push_back({"steps/" + name, static_cast<std::int64_t>(attribute_number(own.get(), path_, "step")),
                       attribute_number(own.get(), path_, "time")});
    }
    std::sort(out.begin(), out.end(), [](const ViewStep& a, const ViewStep& b) { return a.step < b.step; });
    return out;
}

std::vector<double> FieldsFile::field(const ViewStep& step, const std::string& name, std::size_t rows,
                                      std::size_t columns) const {
    const std::string item = step.group + "/" + name;
    if (name.find('/') != std::string::npos && !has_item(file_.get(), item.substr(0, item.rfind('/')))) return {};
    if (!has_item(file_.get(), item)) return {};
    auto [values, shape] = read_data<double>(file_.get(), path_, item);
    if (values.size() != rows * columns)
        wrong_fields(path_, fmt::format("{} has {} values, and not {}", item, values.size(), rows * columns));
    return std::move(values);
}

}  // namespace cli
