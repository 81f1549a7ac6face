// SPDX-License-Identifier: BSD-3-Clause
// Chooses the steps whose fields are written. With `every`: each n-th. Without it, where something happens: at the
// first damage, before and after jumps, at peaks of a reaction, as many as most_instants leaves beside the first step,
// the last and the snapshots of the scene, or eighths of the analysis if it names none. If more happens, the largest
// events stay. All that the choice depends on is saved, so that a run that goes on chooses the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "file/state.hpp"
#include "scene/scene.hpp"

namespace cli {

// Values by which steps are judged.
struct Sight {
    double dissipated = 0;
    double jumps = 0;               // within the step
    std::vector<double> reactions;  // sizes, [patterns]
    // True if a reaction falls by more than half.
    [[nodiscard]] bool collapses_from(const Sight& before) const;
};

class Instants {
public:
    explicit Instants(const Scene& scene);

    // False: the steps are known from the beginning.
    [[nodiscard]] bool judges() const { return judges_; }
    [[nodiscard]] bool chosen(std::size_t step) const { return fixed_.contains(step) || events_.contains(step); }
    // Chosen steps from the beginning on, ascending.
    [[nodiscard]] std::set<std::size_t> up_to(std::size_t last) const;
    // Returns the steps that are known from the beginning.
    [[nodiscard]] const std::set<std::size_t>& fixed() const { return fixed_; }

    // Judges a step by what it and the one before it show. Steps from `step` on that were chosen before are forgotten:
    // others have replaced them.
    void judge(std::size_t step, const Sight& before, const Sight& now);
    // The step of the first damage, once it has been judged.
    [[nodiscard]] std::optional<std::size_t> first_damage() const { return first_damage_; }
    [[nodiscard]] ChosenInstants memory() const;
    void restore(const ChosenInstants& memory);
    // Goes on as earlier versions began: with every step.
    void take_every_step();

private:
    // The kinds stand in descending order of weight.
    enum class Kind : std::int64_t { first_damage, jump, peak };
    struct Event {
        Kind kind;
        std::size_t pattern;  // whose reaction changes by `change`
        double change;
    };
    // True if `a` counts less than `b`: of a lighter kind, or its change is smaller, over the largest reaction so far.
    [[nodiscard]] bool less(const Event& a, const Event& b) const;
    // Adds an event at these steps, all or none; lesser ones make room.
    void add(const std::vector<std::size_t>& steps, const Event& event);

    bool judges_;
    std::size_t last_;
    std::set<std::size_t> fixed_;
    std::map<std::size_t, Event> events_;  // by step
    std::optional<std::size_t> first_damage_;
    std::vector<double> largest_, lowest_;  // [patterns] largest reaction so far; lowest one since the last peak
};

}  // namespace cli
