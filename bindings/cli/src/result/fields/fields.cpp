// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/fields.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "file/file.hpp"
#include "file/hash.hpp"
#include "file/input_file.hpp"
#include "file/own_files.hpp"
#include "mesh/cell_format.hpp"
#include "model/library/call.hpp"
#include "result/fields/h5.hpp"
#include "result/fields/step_file.hpp"
#include "result/fields/step_rows.hpp"
#include "result/fields/xdmf.hpp"

namespace cli {

namespace {

std::vector<double> points_3d(const std::vector<double>& nodes, std::size_t dimension) {
    std::vector<double> out(nodes.size() / dimension * 3, 0.0);
    for (std::size_t i = 0; i < nodes.size() / dimension; ++i)
        for (std::size_t a = 0; a < dimension; ++a) out[3 * i + a] = nodes[dimension * i + a];
    return out;
}

XdmfBlock write_interface(const Model& model, const InterfaceData& data, std::int64_t index, hid_t parent,
                          const std::vector<double>& points, std::size_t dimension) {
    const std::string what = "interface " + data.name;
    std::int64_t pairs = 0;
    std::int64_t faces = 0;
    std::int32_t per_face = 0;
    const delam_mesh* mesh = model.mesh.get();
    std::int32_t body_a = 0;
    std::int32_t body_b = 0;
    call(model.context.get(), delam_mesh_interface_size(mesh, index, &body_a, &body_b, &pairs, &faces, &per_face),
         what);
    const auto [a, b] = nodes_of_pairs(model, index, what);
    std::vector<double> weights(a.size());
    std::vector<double> frames(a.size() * dimension * dimension);
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(faces * per_face));
    call(model.context.get(), delam_mesh_interface_pairs(mesh, index, nullptr, nullptr, weights.data(), frames.data()),
         what);
    call(model.context.get(), delam_mesh_interface_faces(mesh, index, connectivity.data()), what);
    std::vector<double> at(3 * a.size());
    // An obstacle's node a is the control node, wherever that lies.
    const std::vector<std::int64_t>& place = body_a < 0 ? b : a;
    for (std::size_t i = 0; i < a.size(); ++i)
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(3 * place[i]), 3,
                    at.begin() + static_cast<std::ptrdiff_t>(3 * i));
    const h5::Group group(h5::new_group(parent, "interface_" + std::to_string(index)), "fields.h5");
    h5::attribute(group.get(), "name", data.name);
    h5::attribute(group.get(), "body_a", std::int64_t{body_a});
    h5::attribute(group.get(), "body_b", std::int64_t{body_b});
    h5::write(group.get(), "points", at, 3);
    h5::write(group.get(), "faces", connectivity, static_cast<std::size_t>(per_face));
    h5::write(group.get(), "nodes_a", a, 0);
    h5::write(group.get(), "nodes_b", b, 0);
    h5::write(group.get(), "weights", weights, 0);
    h5::write(group.get(), "frames", frames, dimension * dimension);
    return {data.name, pairs, faces, per_face, std::string(xdmf_face(static_cast<std::int32_t>(dimension), per_face)),
            0};
}

// Mesh and interfaces; returns what the XDMF file has to say about them.
std::vector<XdmfBlock> write_mesh(const Model& model, const Scene& scene, hid_t file) {
    const std::string what = "mesh";
    const delam_mesh* mesh = model.mesh.get();
    std::int32_t dimension = 0;
    std::int64_t nodes = 0;
    std::int64_t cells = 0;
    std::int64_t entries = 0;
    call(model.context.get(), delam_mesh_size(mesh, &dimension, &nodes, &cells, nullptr, nullptr), what);
    std::vector<double> coordinates(static_cast<std::size_t>(nodes * dimension));
    call(model.context.get(), delam_mesh_nodes(mesh, nodes * dimension, coordinates.data()), what);
    call(model.context.get(), delam_mesh_cells(mesh, nullptr, nullptr, nullptr, 0, nullptr, &entries), what);
    std::vector<std::int32_t> types(static_cast<std::size_t>(cells));
    std::vector<std::int32_t> bodies(types.size());
    std::vector<std::int64_t> offsets(types.size() + 1);
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(entries));
    call(model.context.get(),
         delam_mesh_cells(mesh, types.data(), bodies.data(), offsets.data(), entries, connectivity.data(), &entries),
         what);
    const std::vector<double> points = points_3d(coordinates, static_cast<std::size_t>(dimension));
    const bool mixed = std::adjacent_find(types.begin(), types.end(), std::not_equal_to<>()) != types.end();
    std::int64_t per_cell = 0;
    for (std::size_t c = 0; c < types.size(); ++c) per_cell = std::max(per_cell, offsets[c + 1] - offsets[c]);
    std::vector<XdmfBlock> blocks{
        {"bodies", nodes, cells, per_cell, mixed ? "Mixed" : std::string(format_of(types.front()).xdmf), 0}};
    {
        const h5::Group group(h5::new_group(file, "mesh"), "fields.h5");
        h5::write(group.get(), "points", points, 3);
        h5::write(group.get(), "body", bodies, 0);
        if (mixed) {
            // A row for each cell, with -1 behind its last node; and the list that XDMF reads: type, nodes, type, ..
            std::vector<std::int64_t> rows(types.size() * static_cast<std::size_t>(per_cell), -1);
            std::vector<std::int64_t> list;
            for (std::size_t c = 0; c < types.size(); ++c) {
                const auto begin = connectivity.begin() + offsets[c];
                const auto end = connectivity.begin() + offsets[c + 1];
                std::copy(begin, end, rows.begin() + static_cast<std::ptrdiff_t>(c) * per_cell);
                list.push_back(format_of(types[c]).xdmf_number);
                list.insert(list.end(), begin, end);
            }
            blocks.front().entries = static_cast<std::int64_t>(list.size());
            h5::write(group.get(), "cells", rows, static_cast<std::size_t>(per_cell));
            h5::write(group.get(), "mixed", list, 0);
        } else {
            h5::write(group.get(), "cells", connectivity, static_cast<std::size_t>(per_cell));
        }
        for (std::size_t i = 0; i < scene.layers.size(); ++i)
            h5::attribute(group.get(), ("body_" + std::to_string(i)).c_str(), scene.layers[i].name);
    }
    const h5::Group group(h5::new_group(file, "interfaces"), "fields.h5");
    for (std::size_t i = 0; i < model.interfaces.size(); ++i)
        blocks.push_back(write_interface(model, model.interfaces[i], static_cast<std::int64_t>(i), group.get(), points,
                                         static_cast<std::size_t>(dimension)));
    return blocks;
}

}  // namespace

Fields::Fields(std::string folder, const Scene& scene, Bulk* bulk)
    : folder_(std::move(folder)), bulk_(bulk), instants_(scene) {}

bool Fields::estimates_mesh_error(std::size_t step) const {
    const std::set<std::size_t>& fixed = instants_.fixed();
    if (instants_.first_damage() == step) return true;
    const auto at = fixed.find(step);
    if (at == fixed.end()) return false;
    const auto place = static_cast<std::size_t>(std::distance(fixed.begin(), at));
    if (step == *fixed.rbegin()) return true;
    return judges() ? place == fixed.size() / 2 : std::has_single_bit(place);
}

std::string Fields::step_path(std::size_t step) const {
    return folder_ + "/" + (earlier_.contains(step) ? earlier_step_name(step) : step_name(step));
}

std::string Fields::revised_path(std::size_t step) const { return step_path(step) + std::string(revised_suffix); }

void Fields::write_step(const Model& model, delam_solver* solver, const Scene& scene, std::size_t step,
                        bool collapses) {
    const bool again = is_there(step_path(step));
    const std::string path = again ? revised_path(step) : step_path(step);
    if (again) {
        remove_file(path);
        revised_.insert(step);
    }
    if (bulk_ != nullptr) {
        write_step_file(path, model, solver, scene, static_cast<std::int64_t>(step), scene.times[step], *bulk_);
        hashes_.erase(step);
    } else {
        const std::string bytes = step_bytes(model, solver, scene, static_cast<std::int64_t>(step), scene.times[step],
                                             {estimates_mesh_error(step), collapses && !scene.output.brief});
        Appender(path, 0).append(bytes);
        hashes_[step] = file_hash_of(bytes);
    }
    written_.insert(step);
    unsynchronised_.push_back(path);
}

void Fields::settle() {
    for (const std::size_t step : revised_) rename_file(revised_path(step), step_path(step));
    revised_.clear();
    std::erase_if(written_, [this](std::size_t step) {
        if (chosen(step)) return false;
        remove_file(step_path(step));
        hashes_.erase(step);
        return true;
    });
}

void Fields::synchronise_steps() {
    for (const std::string& path : unsynchronised_) synchronise(path);
    unsynchronised_.clear();
}

void Fields::seal(std::size_t last, Companions& companions) {
    companions.fields.clear();
    for (const std::size_t step : instants_.up_to(last)) {
        auto at = hashes_.find(step);
        if (at == hashes_.end()) {
            const std::string path = revised_.contains(step) ? revised_path(step) : step_path(step);
            at = hashes_.emplace(step, content_of_file(path).hash).first;
        }
        companions.fields.push_back(at->second);
    }
    if (judges()) companions.instants = instants_.memory();
}

void Fields::resume(std::size_t last, const std::optional<Companions>& saved) {
    if (judges() && saved && saved->instants)
        instants_.restore(*saved->instants);
    else if (judges())
        instants_.take_every_step();
    std::size_t k = 0;
    for (const std::size_t step : instants_.up_to(last)) {
        const std::string earlier = folder_ + "/" + earlier_step_name(step);
        if (is_there(earlier) || is_there(earlier + std::string(revised_suffix))) earlier_.insert(step);
        const std::string path = step_path(step);
        const std::string expected = saved && k < saved->fields.size() ? saved->fields[k] : "";
        take_revised(path,
                     [&expected](const std::string& revised) { return hash_like(expected, revised) == expected; });
        ++k;
        if (!is_there(path)) throw Failure(exit_scene, path + ": missing; run again without --resume");
        hashes_[step] = hash_like(expected, path);
        if (saved ? hashes_[step] != expected : !is_step_file(path, step))
            throw Failure(exit_scene, path + ": not as it was when the state was saved; run again without --resume");
        written_.insert(step);
    }
    // Steps after the saved state are computed again, and the state counts no longer on others that have gone.
    for (const std::string& name : names_in(folder_))
        if (const auto step = step_of(name); step && !written_.contains(*step)) remove_file(folder_ + "/" + name);
}

BulkFacts Fields::assemble(const Model& model, const Scene& scene, std::size_t last, const std::string& problem_hash,
                           const Concept& named) const {
    if (scene.output.fields.empty()) {
        for (const char* name : {"/fields.h5", "/fields.xdmf"}) remove_file(folder_ + name);  // of an earlier attempt
        return {};
    }
    const std::string path = folder_ + "/fields.h5";
    const std::set<std::size_t> chosen = instants_.up_to(last);
    std::int64_t room = std::int64_t{1} << 20;
    for (const std::size_t step : chosen)
        room += static_cast<std::int64_t>(std::filesystem::file_size(step_path(step)));
    require_room(path, room);

    BulkFacts facts;
    std::vector<XdmfStep> steps;
    std::vector<XdmfBlock> blocks;
    std::vector<FileRange> ranges;  // for the processes that have the fields
    h5::File file(h5::create(path), path);
    {
        h5::attribute(file.get(), "title", scene.title);
        h5::attribute(file.get(), "version", std::string(delam_version()));
        h5::attribute(file.get(), "commit", std::string(delam_commit()));
        h5::attribute(file.get(), "scene_hash", problem_hash);
        h5::attribute(file.get(), "scene_file_hash", scene.file_hash);
        for (const auto& [key, value] : named) h5::attribute(file.get(), key, value);
        h5::attribute(file.get(), "dimension", static_cast<std::int64_t>(scene.geometry.dimension));
        blocks = write_mesh(model, scene, file.get());
        const h5::Group group(h5::new_group(file.get(), "steps"), path);
        for (const std::size_t step : chosen) {
            const std::string name = fmt::format("{:08d}", step);
            const std::string bytes = read_step(step_path(step));
            if (!copy_earlier_step(bytes, step_path(step), group.get(), name)) {
                const std::vector<FileRange> of_step = copy_step(bytes, step_path(step), group.get(), name);
                ranges.insert(ranges.end(), of_step.begin(), of_step.end());
            }
            const h5::Group own(H5Gopen2(group.get(), name.c_str(), H5P_DEFAULT), path);
            facts.rotation_max = std::max(facts.rotation_max, h5::read_number(own.get(), "rotation_max"));
            const MeshError error{h5::read_number_if_there(own.get(), "mesh_error"),
                                  h5::read_number_if_there(own.get(), "mesh_error_fronts"),
                                  h5::read_number_if_there(own.get(), "mesh_excess"), static_cast<std::int64_t>(step),
                                  scene.times[step]};
            if (error.away > facts.mesh_error.away || !std::isfinite(facts.mesh_error.away)) facts.mesh_error = error;
            const double left_out = h5::read_number_if_there(own.get(), "rotation_error");
            if (left_out > facts.rotations.error || !std::isfinite(facts.rotations.error))
                facts.rotations = {left_out, static_cast<std::int64_t>(step), scene.times[step]};
            steps.push_back({name, scene.times[step]});
        }
        h5::require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), path);
    }
    file.close(path);
    if (!ranges.empty()) {
        fill_holes(path);
        bulk_->copy(path, ranges);
    }
    synchronise(path);
    write_atomic(folder_ + "/fields.xdmf", xdmf_text(blocks, steps, scene.output.fields));
    return facts;
}

}  // namespace cli
