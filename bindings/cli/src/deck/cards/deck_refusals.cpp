// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/deck_refusals.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/abaqus_elements.hpp"
#include "deck/abaqus/keywords.hpp"
#include "text/refusals.hpp"

namespace cli::abaqus {

namespace {

// Objects that a deck may have without using them, and the parameter that asks for one.
const std::pair<const char*, const char*> kinds[] = {
    {"MATERIAL", "MATERIAL"},
    {"SURFACE INTERACTION", "INTERACTION"},
    {"AMPLITUDE", "AMPLITUDE"},
    {"ORIENTATION", "ORIENTATION"},
};

class RefusalFinder {
public:
    explicit RefusalFinder(const std::vector<InpCard>& cards) : boundary_(cards) {
        for (const InpCard& card : cards) note_uses(card);
        for (const InpCard& card : cards) examine(card);
    }

    void require_none() {
        if (said_.empty()) return;
        std::vector<SceneFailure> out;
        for (const auto& [failure, count] : said_) {
            if (out.size() == most_refusals) {
                out.emplace_back(failure.place(), RefusalList::others_text(said_.size() - most_refusals));
                break;
            }
            if (count == 1)
                out.push_back(failure);
            else
                out.emplace_back(failure.place(),
                                 fmt::format("{} (so are {} more of these)", failure.text(), count - 1));
        }
        throw Refusals(std::move(out));
    }

private:
    void note_uses(const InpCard& card) {
        for (const auto& [kind, parameter] : kinds)
            if (card.has(parameter)) used_[kind].insert(upper(card.parameter(parameter)));
        // Names that stand in data lines: materials of plies, interactions of general contact.
        const char* const in_lines = card.has("COMPOSITE")                           ? "MATERIAL"
                                     : card.keyword == "CONTACT PROPERTY ASSIGNMENT" ? "SURFACE INTERACTION"
                                                                                     : nullptr;
        if (in_lines == nullptr) return;
        for (const InpLine& line : card.lines)
            for (const std::string& field : line.fields) used_[in_lines].insert(upper(field));
    }

    // True if the card is, or belongs to, an object that nothing uses.
    [[nodiscard]] bool unused(const InpCard& card, Use use) {
        for (const auto& [kind, parameter] : kinds) {
            if (card.keyword != kind) continue;
            const bool taken = used_[kind].contains(upper(card.parameter("NAME")));
            if (kind == std::string("MATERIAL") || kind == std::string("SURFACE INTERACTION")) open_unused_ = !taken;
            return !taken;
        }
        return (use == Use::law || use == Use::no_law) && open_unused_;
    }

    void examine(const InpCard& card) {
        const Keyword* keyword = keyword_of(card.keyword);
        if (keyword == nullptr) return add({card.place, instead_of_keyword(card.keyword)});
        if (keyword->use == Use::unneeded || card.keyword == "SURFACE" || unused(card, keyword->use)) return;
        if (keyword->use == Use::never || keyword->use == Use::passed || keyword->use == Use::no_law)
            return add({card.place, instead_of_keyword(card.keyword)});
        try {
            card.check();
            if (card.keyword == "ELEMENT" && !boundary_.contains(card)) (void)type_named(card);
        } catch (const SceneFailure& failure) {
            add(failure);
        }
    }

    void add(const SceneFailure& failure) {
        const auto [at, first] = position_.emplace(failure.place().path + failure.text(), said_.size());
        if (first)
            said_.emplace_back(failure, 1);
        else
            ++said_[at->second].second;
    }

    BoundaryElements boundary_;
    std::map<std::string, std::set<std::string>> used_;       // names in upper case, by the kind of the object
    bool open_unused_ = false;                                // of the material or interaction whose cards come
    std::vector<std::pair<SceneFailure, std::size_t>> said_;  // and how often
    std::map<std::string, std::size_t> position_;             // in said_, by keyword and text
};

}  // namespace

void require_importable(const std::vector<InpCard>& cards) { RefusalFinder(cards).require_none(); }

}  // namespace cli::abaqus
