// SPDX-License-Identifier: BSD-3-Clause
// Knows the pairs and faces of an interface of the library's mesh, and which of them lie in a region of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "model/library/model.hpp"
#include "scene/scene.hpp"

namespace cli {

class InterfacePairs {
public:
    // `model` and `scene` must outlive it. Either of its sides may hold the nodes of a set where `data` stands for a
    // seam within one body, or for bodies that share nodes.
    InterfacePairs(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data);

    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(node_b_.size()); }
    // Returns the pairs of a set: those all of whose faces lie in it, or those without a face in it (Region::outside).
    [[nodiscard]] std::vector<std::int64_t> in(const Region& region) const;
    // Returns the pairs with a face in a region, a set or a box, or those without one (Region::outside).
    [[nodiscard]] std::vector<std::int64_t> touching(const Region& region) const;
    // Returns the area of the faces in a set, and that of the pairs that are not without a face in it; zeros at seams.
    [[nodiscard]] std::array<double, 2> areas(const Region& region, const std::vector<std::int64_t>& without) const;

private:
    // True if b's node of a pair fulfils something. a's node may be a point within a face; at a seam, where the
    // order of the cells says which side is b, it counts too.
    template <typename Predicate>
    [[nodiscard]] bool either(std::int64_t pair, const Predicate& holds) const {
        const auto at = static_cast<std::size_t>(pair);
        return holds(origins_[static_cast<std::size_t>(node_b_[at])]) ||
               (seam_ && holds(origins_[static_cast<std::size_t>(node_a_[at])]));
    }
    [[nodiscard]] std::vector<std::int64_t> beside(const std::vector<std::array<std::int64_t, 9>>& faces) const;
    [[nodiscard]] std::vector<std::int64_t> outside(const Region& region) const;
    [[nodiscard]] std::vector<std::int64_t> without_face_in(const std::vector<std::size_t>& faces) const;
    [[nodiscard]] std::vector<std::size_t> faces_in(const std::string& name) const;
    [[nodiscard]] std::vector<std::size_t> faces_in_box(const Region& region) const;
    [[nodiscard]] std::size_t corners() const { return dimension_ == 2 ? 2 : per_face_ % 3 == 0 ? 3 : 4; }
    [[nodiscard]] const double* place_of(std::int64_t pair) const {
        return places_.data() + static_cast<std::size_t>(node_b_[static_cast<std::size_t>(pair)]) * dimension_;
    }
    [[nodiscard]] double area(std::size_t face) const;

    std::size_t dimension_;
    bool seam_;
    const MeshData* mesh_;  // null: of layers, without sets
    std::size_t box_axes_;  // boxes of layers have no extent across them
    double tolerance_;      // of a box
    std::size_t per_face_ = 1;
    std::vector<std::int64_t> node_a_, node_b_;
    std::vector<std::int64_t> faces_;
    std::vector<std::int64_t> origins_;
    std::vector<double> places_;  // of the nodes
    std::vector<double> weights_;
};

}  // namespace cli
