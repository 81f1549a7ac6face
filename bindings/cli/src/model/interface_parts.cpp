// SPDX-License-Identifier: BSD-3-Clause
#include "model/interface_parts.hpp"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "delam/experimental.h"
#include "model/library/call.hpp"
#include "model/library/interface_pairs.hpp"

namespace cli {

namespace {

// Entries between the same two bodies make one pairing.
void require_one_pairing(const InterfaceEntries& entries) {
    const InterfaceData& first = *entries.front();
    for (const InterfaceData* entry : entries) {
        if (entry->shared_bonded)
            throw SceneFailure(entry->place, "shared = \"bonded\" is for the only entry between two bodies");
        if (entry->projected != first.projected || entry->points != first.points || entry->gap != first.gap ||
            entry->tolerance != first.tolerance)
            throw SceneFailure(entry->place,
                               fmt::format("projected, projection, gap and tolerance must be those of {}: entries "
                                           "between the same two bodies share one pairing",
                                           first.place.path));
    }
}

const InterfaceData* entry_of_rest(const InterfaceEntries& entries) {
    const InterfaceData* rest = nullptr;
    for (const InterfaceData* entry : entries) {
        if (!entry->parts.empty()) continue;
        if (rest != nullptr)
            throw SceneFailure(entry->place, fmt::format("there is another interface between these bodies ({}); part "
                                                         "says for which of its faces each entry stands",
                                                         rest->place.path));
        rest = entry;
    }
    return rest;
}

// Returns the entry of each pair; rest: of those that lie in no part.
InterfaceEntries owners(const Scene& scene, const InterfacePairs& pairs, const InterfaceEntries& entries,
                        const InterfaceData* rest) {
    InterfaceEntries owner(static_cast<std::size_t>(pairs.count()), nullptr);
    for (const InterfaceData* entry : entries)
        for (const Region& part : entry->parts)
            for (const std::int64_t pair : pairs.touching(part))
                if (const auto at = static_cast<std::size_t>(pair); owner[at] == nullptr) owner[at] = entry;
    std::replace(owner.begin(), owner.end(), static_cast<const InterfaceData*>(nullptr), rest);
    for (const InterfaceData* entry : entries) {
        if (std::find(owner.begin(), owner.end(), entry) != owner.end() || (entry == rest && rest->contact)) continue;
        throw SceneFailure(entry->place, entry == rest ? "the parts of the other entries leave no pair to this one"
                                                       : "part: no face of the interface lies in it, or entries "
                                                         "before this one have all of its pairs");
    }
    if (const auto left = std::count(owner.begin(), owner.end(), nullptr); left > 0)
        throw SceneFailure(entries.front()->place,
                           fmt::format("{} of the {} pairs of this interface lie in the part of no entry: one without "
                                       "part says how the rest holds together{}",
                                       left, owner.size(), scene.mesh ? " (contact = true: not at all)" : ""));
    return owner;
}

// Returns the set of a part, or a number.
std::string suffix(const InterfaceData& entry, std::size_t number) {
    const std::string& set = entry.parts.front().set;
    return "-" + (set.empty() ? std::to_string(number) : set);
}

}  // namespace

void push_parts(Model& model, const Scene& scene, const InterfaceEntries& entries, std::size_t a, std::size_t b) {
    const std::size_t first = model.interfaces.size();
    const auto index = static_cast<std::int64_t>(first);
    if (entries.size() == 1 && entries.front()->parts.empty()) return push_interface(model, scene, *entries[0], a, b);
    require_one_pairing(entries);
    const InterfaceData* rest = entry_of_rest(entries);
    InterfaceEntries owner = owners(scene, InterfacePairs(model, scene, index, *entries.front()), entries, rest);
    const InterfaceData* stays = owner.back();
    const auto named = [&](const InterfaceData& entry) {
        push_interface(model, scene, entry, a, b);
        if (&entry != rest) model.interfaces.back().name += suffix(entry, model.interfaces.size() - first);
    };
    named(*stays);
    for (const InterfaceData* entry : entries) {
        if (entry == stays) continue;
        std::vector<std::int64_t> own;
        for (std::size_t p = 0; p < owner.size(); ++p)
            if (owner[p] == entry) own.push_back(static_cast<std::int64_t>(p));
        if (own.empty()) continue;  // a rest in contact that is none
        std::int64_t made = 0;
        call(model.context.get(),
             delam_experimental_mesh_split_interface(model.mesh.get(), index, static_cast<std::int64_t>(own.size()),
                                                     own.data(), 0, &made),
             entry->place);
        std::erase(owner, entry);  // the pairs that are left keep their order
        named(*entry);
    }
}

}  // namespace cli
