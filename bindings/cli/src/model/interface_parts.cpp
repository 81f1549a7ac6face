// SPDX-License-Identifier: BSD-3-Clause
#include "model/interface_parts.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

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
InterfaceEntries owners(const InterfacePairs& pairs, const InterfaceEntries& entries, const InterfaceData* rest,
                        bool layers) {
    InterfaceEntries owner(static_cast<std::size_t>(pairs.count()), nullptr);
    for (const InterfaceData* entry : entries)
        for (const Region& part : entry->parts)
            for (const std::int64_t pair : pairs.touching(part))
                if (const auto at = static_cast<std::size_t>(pair); owner[at] == nullptr) owner[at] = entry;
    std::replace(owner.begin(), owner.end(), static_cast<const InterfaceData*>(nullptr), rest);
    if (const auto left = std::count(owner.begin(), owner.end(), nullptr); left > 0)
        throw SceneFailure(entries.front()->place,
                           fmt::format("{} of the {} pairs of this interface lie in the part of no entry: one without "
                                       "part says how the rest holds together{}",
                                       left, owner.size(), layers ? "" : " (contact = true: not at all)"));
    return owner;
}

// Returns the set of a part, or a number.
std::string suffix(const InterfaceData& entry, std::size_t number) {
    const std::string& set = entry.parts.front().set;
    return "-" + (set.empty() ? std::to_string(number + 1) : set);
}

}  // namespace

void require_pairs(const InterfaceEntries& entries, const InterfaceEntries& with_pairs) {
    for (const InterfaceData* entry : entries) {
        if (std::find(with_pairs.begin(), with_pairs.end(), entry) != with_pairs.end()) continue;
        if (!entry->parts.empty())
            throw SceneFailure(entry->place,
                               "part: no face of the interface lies in it, or entries before this one have all of its "
                               "pairs");
        if (!entry->contact)
            throw SceneFailure(entry->place, "the parts of the other entries leave no pair to this one");
    }
}

InterfaceParts::InterfaceParts(Model& model, const Scene& scene, InterfaceEntries entries, std::size_t a, std::size_t b)
    : entries_(std::move(entries)), index_(static_cast<std::int64_t>(model.interfaces.size())), a_(a), b_(b) {
    rest_ = entry_of_rest(entries_);
    if (entries_.size() == 1 && rest_ != nullptr) {
        push(model, scene, *rest_);
        return;
    }
    require_one_pairing(entries_);
    owner_ = owners(InterfacePairs(model, scene, index_, *entries_.front()), entries_, rest_, !scene.mesh);
    push(model, scene, *with_pairs().front());
}

InterfaceEntries InterfaceParts::with_pairs() const {
    if (owner_.empty()) return entries_;
    InterfaceEntries found;
    for (const InterfaceData* entry : entries_)
        if (std::find(owner_.begin(), owner_.end(), entry) != owner_.end()) found.push_back(entry);
    return found;
}

void InterfaceParts::push(Model& model, const Scene& scene, const InterfaceData& entry) {
    push_interface(model, scene, entry, a_, b_);
    if (&entry != rest_) model.interfaces.back().name += suffix(entry, pushed_);
    ++pushed_;
}

void InterfaceParts::split(Model& model, const Scene& scene) {
    if (owner_.empty()) return;
    InterfaceEntries left = owner_;  // of the pairs of the first interface, which keep their order
    const InterfaceEntries entries = with_pairs();
    for (const InterfaceData* entry : std::span(entries).subspan(1)) {
        std::vector<std::int64_t> own;
        for (std::size_t p = 0; p < left.size(); ++p)
            if (left[p] == entry) own.push_back(static_cast<std::int64_t>(p));
        std::int64_t made = 0;
        call(model.context.get(),
             delam_experimental_mesh_split_interface(model.mesh.get(), index_, static_cast<std::int64_t>(own.size()),
                                                     own.data(), 0, &made),
             entry->place);
        std::erase(left, entry);
        push(model, scene, *entry);
    }
}

}  // namespace cli
