// SPDX-License-Identifier: BSD-3-Clause
#include "model/library/interface_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "model/library/call.hpp"

namespace cli {

InterfacePairs::InterfacePairs(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data)
    : dimension_(static_cast<std::size_t>(scene.geometry.dimension)),
      seam_(data.within() || data.shared_bonded),
      mesh_(scene.mesh ? &*scene.mesh : nullptr),
      box_axes_(scene.mesh ? dimension_ : dimension_ - 1),
      tolerance_(1e-6 * scene.geometry.smallest_edge) {
    const Place& place = data.place;
    const delam_context* context = model.context.get();
    const delam_mesh* mesh = model.mesh.get();
    std::int64_t pairs = 0;
    std::int64_t nodes = 0;
    std::int64_t faces = 0;
    std::int32_t per_face = 0;
    call(context, delam_mesh_interface_size(mesh, index, nullptr, nullptr, &pairs, &faces, &per_face), place);
    call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), place);
    node_a_.resize(static_cast<std::size_t>(pairs));
    node_b_.resize(node_a_.size());
    origins_.resize(static_cast<std::size_t>(nodes));
    places_.resize(origins_.size() * dimension_);
    faces_.resize(static_cast<std::size_t>(faces * per_face));
    per_face_ = static_cast<std::size_t>(per_face);
    weights_.resize(node_b_.size());
    call(context, delam_mesh_interface_pairs(mesh, index, node_a_.data(), node_b_.data(), weights_.data(), nullptr),
         place);
    call(context, delam_mesh_interface_faces(mesh, index, faces_.data()), place);
    call(context, delam_mesh_node_origins(mesh, nodes, origins_.data()), place);
    call(context, delam_mesh_nodes(mesh, static_cast<std::int64_t>(places_.size()), places_.data()), place);
}

std::array<double, 2> InterfacePairs::areas(const Region& region, const std::vector<std::int64_t>& without) const {
    std::array<double, 2> out{};
    if (seam_) return out;
    for (const double weight : weights_) out[1] += weight;
    for (const std::int64_t pair : without) out[1] -= weights_[static_cast<std::size_t>(pair)];
    for (const std::size_t face : faces_in(region.set)) out[0] += area(face);
    return out;
}

std::vector<std::int64_t> InterfacePairs::in(const Region& region) const {
    if (region.outside) return outside(region);
    const std::vector<std::int64_t>& set = mesh_->node_sets.at(region.set);
    const auto in_set = [&](std::int64_t pair) {
        return either(pair, [&](std::int64_t n) { return std::binary_search(set.begin(), set.end(), n); });
    };
    // A pair from which a face leads out is a tip.
    std::vector<bool> tip(node_b_.size(), false);
    for (std::size_t f = 0; f < faces_.size(); f += per_face_) {
        const auto begin = faces_.begin() + static_cast<std::ptrdiff_t>(f);
        const auto end = begin + static_cast<std::ptrdiff_t>(per_face_);
        if (std::all_of(begin, end, in_set)) continue;
        std::for_each(begin, end, [&](std::int64_t pair) { tip[static_cast<std::size_t>(pair)] = true; });
    }
    std::vector<std::int64_t> out;
    for (std::size_t i = 0; i < node_b_.size(); ++i)
        if (!tip[i] && in_set(static_cast<std::int64_t>(i))) out.push_back(static_cast<std::int64_t>(i));
    return out;
}

std::vector<std::int64_t> InterfacePairs::touching(const Region& region) const {
    std::vector<std::int64_t> without = outside(region), out;
    if (region.outside) return without;
    for (std::int64_t pair = 0; pair < count(); ++pair)
        if (!std::binary_search(without.begin(), without.end(), pair)) out.push_back(pair);
    return out;
}

// Returns the pairs of a seam at no face of a set. A face at the tip is none of the interface, but its pair adheres.
std::vector<std::int64_t> InterfacePairs::beside(const std::vector<std::array<std::int64_t, 9>>& faces) const {
    std::set<std::int64_t> nodes;
    for (const auto& face : faces) nodes.insert(face.begin(), face.end());
    std::vector<std::int64_t> out;
    for (std::int64_t pair = 0; pair < count(); ++pair)
        if (!either(pair, [&](std::int64_t node) { return nodes.contains(node); })) out.push_back(pair);
    return out;
}

// Returns the area of a face by its corners.
double InterfacePairs::area(std::size_t face) const {
    std::vector<std::array<double, 3>> at;
    for (std::size_t i = 0; i < corners(); ++i) {
        std::array<double, 3> x{};
        std::copy_n(place_of(faces_[face + i]), dimension_, x.begin());
        at.push_back(x);
    }
    const auto from_first = [&](std::size_t i) {
        return std::array{at[i][0] - at[0][0], at[i][1] - at[0][1], at[i][2] - at[0][2]};
    };
    if (at.size() == 2) return std::hypot(from_first(1)[0], from_first(1)[1]);
    double sum = 0;
    for (std::size_t i = 2; i < at.size(); ++i) {
        const auto u = from_first(i - 1), v = from_first(i);
        sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }
    return sum;
}

// Returns the pairs without a face in the region.
std::vector<std::int64_t> InterfacePairs::outside(const Region& region) const {
    if (region.set.empty()) return without_face_in(faces_in_box(region));
    const auto faces = mesh_->face_sets.find(region.set);
    if (seam_ && faces != mesh_->face_sets.end()) return beside(faces->second);
    return without_face_in(faces_in(region.set));
}

std::vector<std::int64_t> InterfacePairs::without_face_in(const std::vector<std::size_t>& faces) const {
    std::vector<bool> held(node_b_.size(), false);
    for (const std::size_t f : faces)
        for (std::size_t i = 0; i < per_face_; ++i) held[static_cast<std::size_t>(faces_[f + i])] = true;
    std::vector<std::int64_t> out;
    for (std::size_t i = 0; i < held.size(); ++i)
        if (!held[i]) out.push_back(static_cast<std::int64_t>(i));
    return out;
}

// Returns where the faces begin that lie in a set, which is one of faces or else one of nodes that hold all corners.
std::vector<std::size_t> InterfacePairs::faces_in(const std::string& name) const {
    const auto key_of = [](auto begin, auto end) {
        std::set<std::int64_t> key(begin, end);  // a triangle among quadrilaterals repeats a corner
        key.erase(-1);
        return key;
    };
    std::set<std::set<std::int64_t>> known;
    const auto faces = mesh_->face_sets.find(name);
    if (faces != mesh_->face_sets.end())
        for (const auto& face : faces->second) {
            const auto all = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
            const std::size_t of_it = dimension_ == 2 ? 2 : all % 3 == 0 ? 3 : 4;
            known.insert(key_of(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(of_it)));
        }
    const std::vector<std::int64_t>& nodes = mesh_->node_sets.at(name);
    std::vector<std::size_t> out;
    for (std::size_t f = 0; f < faces_.size(); f += per_face_) {
        std::vector<std::int64_t> at;
        for (std::size_t i = 0; i < corners(); ++i)
            at.push_back(origins_[static_cast<std::size_t>(node_b_[static_cast<std::size_t>(faces_[f + i])])]);
        const auto among = [&](std::int64_t node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
        const auto first = faces_.begin() + static_cast<std::ptrdiff_t>(f);
        const bool in_set = faces != mesh_->face_sets.end()
                                ? known.contains(key_of(at.begin(), at.end()))
                                : std::all_of(first, first + static_cast<std::ptrdiff_t>(corners()),
                                              [&](std::int64_t pair) { return either(pair, among); });
        if (in_set) out.push_back(f);
    }
    return out;
}

// Returns where the faces begin all of whose corners lie in a box.
std::vector<std::size_t> InterfacePairs::faces_in_box(const Region& region) const {
    const auto inside = [&](std::int64_t pair) {
        const double* x = place_of(pair);
        for (std::size_t i = 0; i < box_axes_; ++i)
            if (x[i] < region.lower[i] - tolerance_ || x[i] > region.upper[i] + tolerance_) return false;
        return true;
    };
    std::vector<std::size_t> out;
    for (std::size_t f = 0; f < faces_.size(); f += per_face_) {
        const auto first = faces_.begin() + static_cast<std::ptrdiff_t>(f);
        if (std::all_of(first, first + static_cast<std::ptrdiff_t>(corners()), inside)) out.push_back(f);
    }
    return out;
}

}  // namespace cli
