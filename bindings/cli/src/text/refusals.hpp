// SPDX-License-Identifier: BSD-3-Clause
// Holds several things that a file asks for and does not get, which are said together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "text/error.hpp"

namespace cli {

// Gives the first message where one is expected.
class Refusals : public SceneFailure {
public:
    // all: one at least, in the order of the file.
    explicit Refusals(std::vector<SceneFailure> all) : SceneFailure(all.front()), all_(std::move(all)) {}
    [[nodiscard]] const std::vector<SceneFailure>& all() const noexcept { return all_; }

private:
    std::vector<SceneFailure> all_;
};

// Each says something else, so that a person reads them; half and twice as many change nothing but the length of the
// list (ctest -R cli_deck_elements).
constexpr std::size_t most_refusals = 40;

// Gathers what is refused while independent things are judged one after another.
class RefusalList {
public:
    // Calls, and keeps the failure of the scene that the call throws: false then.
    template <class Call>
    bool attempt(Call&& call) {
        try {
            std::forward<Call>(call)();
            return true;
        } catch (const Refusals& several) {
            for (const SceneFailure& each : several.all()) add(each);
        } catch (const SceneFailure& one) {
            add(one);
        }
        return false;
    }

    // Throws what was kept, in the order of the lines of a file.
    void require_none() const {
        if (kept_.empty()) return;
        std::vector<SceneFailure> out = kept_;
        std::stable_sort(out.begin(), out.end(), [](const SceneFailure& a, const SceneFailure& b) {
            return a.place().file == b.place().file && a.place().line < b.place().line;
        });
        const std::size_t count = out.size();
        if (count > most_refusals) {
            const Place place = out[most_refusals].place();
            out.erase(out.begin() + most_refusals, out.end());
            out.emplace_back(place, others_text(count - most_refusals));
        }
        throw Refusals(std::move(out));
    }

    [[nodiscard]] static std::string others_text(std::size_t count) {
        return fmt::format("this and {} other things are not imported either", count);
    }

private:
    void add(const SceneFailure& failure) {
        if (said_.insert(failure.what()).second) kept_.push_back(failure);
    }

    std::vector<SceneFailure> kept_;
    std::unordered_set<std::string> said_;  // the texts of those that are kept
};

}  // namespace cli
