// SPDX-License-Identifier: BSD-3-Clause
// Gives parts of one interface an entry each, with laws of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "model/library/model.hpp"
#include "scene/scene.hpp"

namespace cli {

// Entries of the scene for the interface between two layers or bodies, or within one, in their order.
using InterfaceEntries = std::vector<const InterfaceData*>;

// One interface of the mesh that is split among entries: the first of them in whose part a face of a pair lies has the
// pair, and one without a part has the rest.
class InterfaceParts {
public:
    // Appends the next interface of the mesh to the model, as that of the first entry with pairs. Throws SceneFailure
    // where a pair has no entry, or where entries contradict.
    InterfaceParts(Model& model, const Scene& scene, InterfaceEntries entries, std::size_t a, std::size_t b);
    // Splits off the pairs of the other entries. The mesh appends their interfaces, and so must the model: it has to
    // know all interfaces of the mesh.
    void split(Model& model, const Scene& scene);
    // Returns the entries that have pairs.
    [[nodiscard]] InterfaceEntries with_pairs() const;

private:
    void push(Model& model, const Scene& scene, const InterfaceData& entry);

    InterfaceEntries entries_;
    InterfaceEntries owner_;               // [pairs]
    const InterfaceData* rest_ = nullptr;  // the entry without a part
    std::int64_t index_;
    std::size_t a_, b_;
    std::size_t pushed_ = 0;
};

// Throws SceneFailure at an entry that is not among those with pairs, unless it is a rest in contact.
void require_pairs(const InterfaceEntries& entries, const InterfaceEntries& with_pairs);

}  // namespace cli
