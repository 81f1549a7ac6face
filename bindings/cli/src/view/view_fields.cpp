// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_fields.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <new>
#include <set>
#include <tuple>
#include <type_traits>

#include <fmt/format.h>

#include "file/input_file.hpp"
#include "mesh/cell_shape.hpp"
#include "text/reason.hpp"
#include "view/view_result.hpp"

namespace cli {

namespace {

[[noreturn]] void wrong_fields(const std::string& path, const std::string& what) {
    throw Failure(exit_scene, path + ": " + what);
}

// An identifier of HDF5, or the failure to get one.
hid_t identified(hid_t id, const std::string& path, const std::string& item) {
    if (id >= 0) return id;
    const h5::FileTrouble trouble = h5::take_trouble();
    if (trouble.code == ENOMEM) throw std::bad_alloc();
    wrong_fields(path,
                 item + " cannot be read: " +
                     (trouble.code != 0 ? reason_of(trouble.code) : "the file is damaged, or no fields.h5 of delam"));
}

hid_t opened_fields(const std::string& path) {
    const InputFile there(path);  // says what is wrong with a file that is missing, a folder or a pipe
    return identified(h5::open(path), path, "it");
}

// Links may lead to pipes, devices and other people's files; delam writes none.
void require_no_links(hid_t file, const std::string& path) {
    std::string found;
    const auto visit = [](hid_t, const char* name, const H5L_info_t* about, void* into) -> herr_t {
        if (about->type == H5L_TYPE_HARD) return 0;
        *static_cast<std::string*>(into) = name;
        return 1;
    };
    const herr_t status = H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &found);
    if (status > 0) wrong_fields(path, found + " is a link, where delam writes none");
    if (status < 0) wrong_fields(path, "its groups cannot be read (the file is damaged)");
}

struct DataShape {
    std::size_t rows = 0, columns = 0;  // columns 0: a vector
};

// Largest number of bytes for which a byte of deflated data can stand (https://zlib.net/zlib_tech.html).
constexpr std::uint64_t most_inflated = 1032;

template <class T>
std::pair<std::vector<T>, DataShape> read_data(hid_t file, const std::string& path, const std::string& item) {
    const h5::Data data(identified(H5Oopen(file, item.c_str(), H5P_DEFAULT), path, item), item);
    if (H5Iget_type(data.get()) != H5I_DATASET) wrong_fields(path, item + " is no data set");
    const h5::Space space(identified(H5Dget_space(data.get()), path, item), item);
    const h5::Type type(identified(H5Dget_type(data.get()), path, item), item);
    constexpr bool whole = std::is_integral_v<T>;
    if (H5Tget_class(type.get()) != (whole ? H5T_INTEGER : H5T_FLOAT) || H5Tget_size(type.get()) != sizeof(T))
        wrong_fields(path, fmt::format("{} has other numbers: {} of {} bytes are expected", item,
                                       whole ? "integers" : "floating-point numbers", sizeof(T)));
    std::array<hsize_t, 2> shape{0, 0};
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) < 0)
        wrong_fields(path, item + " is neither a vector nor a matrix");
    const h5::Properties made(identified(H5Dget_create_plist(data.get()), path, item), item);
    if (H5Pget_external_count(made.get()) != 0 || H5Pget_layout(made.get()) == H5D_VIRTUAL)
        wrong_fields(path, item + " lies in another file, where delam writes none");
    const std::uint64_t stored = H5Dget_storage_size(data.get()), columns = rank == 2 ? shape[1] : 1;
    // Checked before memory is taken for the numbers.
    if (columns > 0 && shape[0] > most_inflated * stored / sizeof(T) / columns)
        wrong_fields(path,
                     fmt::format("{} claims {} x {} numbers, and the {} bytes that are stored cannot stand for so "
                                 "many",
                                 item, shape[0], columns, stored));
    std::vector<T> values(static_cast<std::size_t>(shape[0] * columns));
    if (!values.empty() && H5Dread(data.get(), h5::type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        wrong_fields(path, item + " cannot be read (the file is damaged)");
    if constexpr (!whole)
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!(std::abs(values[i]) <= largest_shown))
                wrong_fields(path,
                             fmt::format("{}, row {}: {}: a finite number is expected", item, i / columns, values[i]));
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

double attribute_number(hid_t parent, const std::string& path, const std::string& item, const std::string& name) {
    const std::string where = item + (item.empty() ? "" : ": ") + name;
    if (H5Aexists(parent, name.c_str()) <= 0) wrong_fields(path, where + " is missing");
    const h5::Attribute in(identified(H5Aopen(parent, name.c_str(), H5P_DEFAULT), path, where), where);
    const h5::Space space(identified(H5Aget_space(in.get()), path, where), where);
    const h5::Type type(identified(H5Aget_type(in.get()), path, where), where);
    const H5T_class_t kind = H5Tget_class(type.get());
    double value = 0;
    if (H5Sget_simple_extent_npoints(space.get()) != 1 || (kind != H5T_INTEGER && kind != H5T_FLOAT) ||
        H5Aread(in.get(), H5T_NATIVE_DOUBLE, &value) < 0 || !(std::abs(value) <= largest_shown))
        wrong_fields(path, where + ": one finite number is expected");
    return value;
}

std::int64_t attribute_whole(hid_t parent, const std::string& path, const std::string& item, const std::string& name,
                             std::int64_t least, std::int64_t most) {
    const double value = attribute_number(parent, path, item, name);
    if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most))
        wrong_fields(path, fmt::format("{}{}{} is {}: a whole number from {} to {} is expected", item,
                                       item.empty() ? "" : ": ", name, value, least, most));
    return static_cast<std::int64_t>(value);
}

std::vector<std::string> names_in(hid_t file, const std::string& path, const std::string& item) {
    std::vector<std::string> names;
    const h5::Group group(identified(H5Gopen2(file, item.c_str(), H5P_DEFAULT), path, item), path);
    const auto list = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->emplace_back(name);
        return 0;
    };
    if (H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, list, &names) < 0)
        wrong_fields(path, item + " cannot be read (the file is damaged)");
    return names;
}

bool has_item(hid_t parent, const std::string& name) { return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0; }

double shortest_edge_of(const ViewMesh& mesh) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const std::int64_t* cell = mesh.cells.data() + c * mesh.per_cell;
        const auto count = static_cast<std::size_t>(std::find(cell, cell + mesh.per_cell, -1) - cell);
        for (const CellShape& shape : all_shapes()) {
            if (shape.dimension != mesh.dimension || shape.nodes != count) continue;
            for (const auto& side : shape.sides)
                for (std::size_t i = 0, corners = shape.corners_of(side).size(); i < corners; ++i) {
                    const double* from = &mesh.points[3 * static_cast<std::size_t>(cell[side[i]])];
                    const double* to = &mesh.points[3 * static_cast<std::size_t>(cell[side[(i + 1) % corners]])];
                    double square = 0;
                    for (std::size_t a = 0; a < 3; ++a) square += std::pow(from[a] - to[a], 2);
                    least = std::min(least, std::sqrt(square));
                }
        }
    }
    return least;
}

// Indices from `least` on, below `count`.
void require_indices(const std::vector<std::int64_t>& indices, std::int64_t least, std::size_t count,
                     const std::string& path, const std::string& item) {
    for (const std::int64_t index : indices)
        if (index < least || index >= static_cast<std::int64_t>(count))
            wrong_fields(path, fmt::format("{} names {}, and there are {}", item, index, count));
}

}  // namespace

FieldsFile::FieldsFile(const std::string& path) : path_(path), file_(opened_fields(path), path) {
    require_no_links(file_.get(), path_);
}

std::string FieldsFile::text(const std::string& name) const { return read_text(file_.get(), name); }

ViewMesh FieldsFile::mesh(const ViewAbout& about) const {
    const std::int32_t dimension = about.dimension;
    const std::vector<std::string>& bodies = about.bodies;
    ViewMesh out;
    out.dimension = static_cast<std::int32_t>(attribute_whole(file_.get(), path_, "", "dimension", 2, 3));
    if (out.dimension != dimension)
        wrong_fields(path_, fmt::format("dimension is {}, and {} in result.json", out.dimension, dimension));
    DataShape shape;
    std::tie(out.points, shape) = read_data<double>(file_.get(), path_, "mesh/points");
    if (shape.columns != 3) wrong_fields(path_, fmt::format("mesh/points has {} columns, and not 3", shape.columns));
    for (std::size_t i = 2; dimension == 2 && i < out.points.size(); i += 3)
        if (out.points[i] != 0)
            wrong_fields(path_, fmt::format("mesh/points, row {}: z is {}, in the plane", i / 3, out.points[i]));
    std::tie(out.cells, shape) = read_data<std::int64_t>(file_.get(), path_, "mesh/cells");
    out.per_cell = shape.columns;
    DataShape rows;
    std::tie(out.body, rows) = read_data<std::int32_t>(file_.get(), path_, "mesh/body");
    if (out.per_cell == 0 || out.body.empty() || rows.columns != 0 || shape.rows != out.body.size())
        wrong_fields(path_, fmt::format("mesh/cells has {} rows, and mesh/body {}", shape.rows, out.body.size()));
    require_indices(out.cells, -1, out.nodes(), path_, "mesh/cells");
    for (std::size_t c = 0; c < shape.rows; ++c) {
        const auto from = out.cells.begin() + static_cast<std::ptrdiff_t>(c * out.per_cell);
        const auto to = from + static_cast<std::ptrdiff_t>(out.per_cell);
        std::vector<std::int64_t> nodes(from, std::find(from, to, -1));
        const bool padded =
            std::all_of(from + static_cast<std::ptrdiff_t>(nodes.size()), to, [](auto n) { return n == -1; });
        std::sort(nodes.begin(), nodes.end());
        if (!padded || std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end())
            wrong_fields(path_,
                         fmt::format("mesh/cells, row {}: different nodes, and -1 behind them, are expected", c));
    }
    const h5::Group group(identified(H5Gopen2(file_.get(), "mesh", H5P_DEFAULT), path_, "mesh"), "mesh");
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (const std::string name = read_text(group.get(), fmt::format("body_{}", b)); name != bodies[b])
            wrong_fields(path_, fmt::format("mesh: body_{} is \"{}\", and \"{}\" in result.json", b, name, bodies[b]));
    std::vector<bool> met(bodies.size(), false);
    for (std::size_t c = 0; c < out.body.size(); ++c) {
        const std::int32_t body = out.body[c];
        if (body < 0 || static_cast<std::size_t>(body) >= bodies.size())
            wrong_fields(path_, fmt::format("mesh/body, row {}: {}, and there are {} bodies", c, body, bodies.size()));
        met[static_cast<std::size_t>(body)] = true;
    }
    if (const auto none = std::find(met.begin(), met.end(), false); none != met.end())
        wrong_fields(path_, fmt::format("mesh/body: body {} has no cell", none - met.begin()));
    // The numbers of two data sets may be exchanged: result.json knows the mesh as well.
    constexpr double rounding = 1e-6;
    const double edge = shortest_edge_of(out);
    if (!(std::abs(edge - about.shortest_edge) <= rounding * about.shortest_edge))
        wrong_fields(path_, fmt::format("mesh/points and mesh/cells: the shortest edge is {}, and {} in result.json",
                                        edge, about.shortest_edge));
    return out;
}

std::vector<ViewInterface> FieldsFile::interfaces(const ViewMesh& mesh) const {
    std::vector<ViewInterface> out;
    // The bodies that have a node.
    std::vector<std::set<std::int32_t>> bodies_at(mesh.nodes());
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        if (mesh.cells[i] >= 0) bodies_at[static_cast<std::size_t>(mesh.cells[i])].insert(mesh.body[i / mesh.per_cell]);
    const std::size_t groups = names_in(file_.get(), path_, "interfaces").size();
    const std::int64_t last = *std::max_element(mesh.body.begin(), mesh.body.end());
    for (std::size_t i = 0; i < groups; ++i) {
        const std::string item = fmt::format("interfaces/interface_{}", i);
        if (!has_item(file_.get(), item))
            wrong_fields(path_, fmt::format("{} is missing, and there are {} interfaces", item, groups));
        const h5::Group group(identified(H5Gopen2(file_.get(), item.c_str(), H5P_DEFAULT), path_, item), item);
        const auto read = [&](const char* name) {
            return read_data<std::int64_t>(file_.get(), path_, item + "/" + name);
        };
        ViewInterface one;
        one.name = read_text(group.get(), "name");
        if (one.name.empty()) wrong_fields(path_, item + ": name is missing");
        one.body_a = attribute_whole(group.get(), path_, item, "body_a", -1, last);
        one.body_b = attribute_whole(group.get(), path_, item, "body_b", 0, last);
        DataShape a, b, shape;
        std::tie(one.nodes_a, a) = read("nodes_a");
        std::tie(one.nodes_b, b) = read("nodes_b");
        if (one.nodes_a.size() != one.nodes_b.size() || a.columns != 0 || b.columns != 0)
            wrong_fields(path_,
                         fmt::format("{} has {} nodes_a and {} nodes_b", item, one.nodes_a.size(), one.nodes_b.size()));
        std::tie(one.faces, shape) = read("faces");
        one.per_face = shape.columns;
        const std::set<std::size_t> known =
            mesh.dimension == 2 ? std::set<std::size_t>{2, 3} : std::set<std::size_t>{3, 4, 6, 8, 9};
        if (!known.contains(one.per_face))
            wrong_fields(path_, fmt::format("{}/faces has {} columns: no face has as many nodes", item, one.per_face));
        if (one.body_a >= 0) require_indices(one.nodes_a, 0, mesh.nodes(), path_, item + "/nodes_a");
        require_indices(one.nodes_b, 0, mesh.nodes(), path_, item + "/nodes_b");
        require_indices(one.faces, 0, one.nodes_b.size(), path_, item + "/faces");
        std::vector<bool> on_face(one.nodes_b.size(), false);
        std::set<std::vector<std::int64_t>> met;
        for (std::size_t f = 0; f < one.faces.size(); f += one.per_face) {
            const auto from = one.faces.begin() + static_cast<std::ptrdiff_t>(f);
            std::vector<std::int64_t> face(from, from + static_cast<std::ptrdiff_t>(one.per_face));
            for (const std::int64_t pair : face) on_face[static_cast<std::size_t>(pair)] = true;
            std::sort(face.begin(), face.end());
            if (!met.insert(std::move(face)).second)
                wrong_fields(path_, fmt::format("{}/faces, row {}: this face is there twice", item, f / one.per_face));
        }
        if (const auto none = std::find(on_face.begin(), on_face.end(), false); none != on_face.end())
            wrong_fields(path_, fmt::format("{}/faces: pair {} is on no face", item, none - on_face.begin()));
        // Meshes that do not match: the nodes of side a are tied to its faces and belong to no cell. A seam, or walls
        // of one body: both sides have the same body, but no node in common.
        const auto require_body = [&](const std::vector<std::int64_t>& nodes, std::int64_t body, bool tied,
                                      const char* name) {
            for (std::size_t k = 0; body >= 0 && k < nodes.size(); ++k) {
                const auto& at = bodies_at[static_cast<std::size_t>(nodes[k])];
                if (!at.contains(static_cast<std::int32_t>(body)) && !(tied && at.empty()))
                    wrong_fields(path_, fmt::format("{}/{}, row {}: node {} does not belong to body {}", item, name, k,
                                                    nodes[k], body));
            }
        };
        require_body(one.nodes_a, one.body_a, true, "nodes_a");
        require_body(one.nodes_b, one.body_b, false, "nodes_b");
        for (std::size_t k = 0; one.body_a == one.body_b && k < one.nodes_a.size(); ++k)
            if (one.nodes_a[k] == one.nodes_b[k])
                wrong_fields(path_, fmt::format("{}, pair {}: node {} is on both sides", item, k, one.nodes_a[k]));
        out.push_back(std::move(one));
    }
    return out;
}

std::vector<ViewStep> FieldsFile::steps(const std::vector<double>& times, std::size_t interfaces) const {
    std::vector<ViewStep> out;
    for (const std::string& name : names_in(file_.get(), path_, "steps")) {
        const std::string item = "steps/" + name;
        const h5::Group own(identified(H5Gopen2(file_.get(), item.c_str(), H5P_DEFAULT), path_, item), item);
        const std::int64_t step =
            attribute_whole(own.get(), path_, item, "step", 0, static_cast<std::int64_t>(times.size()) - 1);
        if (name != fmt::format("{:08}", step)) wrong_fields(path_, fmt::format("{}: step is {}", item, step));
        const double time = attribute_number(own.get(), path_, item, "time");
        if (time != times[static_cast<std::size_t>(step)])
            wrong_fields(path_, fmt::format("{}: time is {}, and {} in history.csv", item, time,
                                            times[static_cast<std::size_t>(step)]));
        if (const std::string more = fmt::format("interface_{}", interfaces); has_item(own.get(), more))
            wrong_fields(path_, fmt::format("{}: {} is there, and there are {} interfaces", item, more, interfaces));
        out.push_back({item, step, time});
    }
    std::sort(out.begin(), out.end(), [](const ViewStep& a, const ViewStep& b) { return a.step < b.step; });
    return out;
}

std::vector<double> FieldsFile::field(const ViewStep& step, const std::string& name, std::size_t rows,
                                      std::size_t columns) const {
    const std::string item = step.group + "/" + name;
    auto [values, shape] = read_data<double>(file_.get(), path_, item);
    if (shape.rows != rows || std::max<std::size_t>(shape.columns, 1) != columns)
        wrong_fields(path_, fmt::format("{} has {} values, and not {}", item, values.size(), rows * columns));
    return std::move(values);
}

}  // namespace cli
