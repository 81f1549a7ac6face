// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/instants.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// Instants that are written at most, unless the scene asks for more snapshots. Reason: eighths of an analysis, its
// first damage and five jumps, each with the state before it. Measured as `valgrind --tool=callgrind delam run`: the
// ENF with cells of 0.5 mm took 26 M instructions an instant, 560 M besides. Half of it leaves one event beside the
// eighths; by these numbers twice of it makes the fields dearer than the analysis.
constexpr std::size_t most_instants = 20;
constexpr std::size_t parts = 8;
// Rise of a reaction since its last peak, over the largest one so far, from which on its fall makes a peak. Reason:
// what the closing lines tell of a drop (load_drops.cpp), so that small waves of a load are no events. Measured by
// bindings/cli/test/test_instants.py, whose loads rise by 10 to 100 %: half and twice of it are below all of them.
constexpr double noticeable_rise = 0.02;

}  // namespace

bool Sight::collapses_from(const Sight& before) const {
    for (std::size_t p = 0; p < reactions.size(); ++p)
        if (reactions[p] < 0.5 * before.reactions[p]) return true;
    return false;
}

Instants::Instants(const Scene& scene) : judges_(!scene.output.every), last_(scene.step_count()) {
    const Output& output = scene.output;
    if (output.fields.empty()) {
        judges_ = false;
        return;
    }
    fixed_ = {0, last_};
    for (std::size_t k = 0; output.every && k <= last_; k += static_cast<std::size_t>(*output.every)) fixed_.insert(k);
    if (judges_ && !output.own_snapshots) {
        for (std::size_t part = 1; part < parts; ++part) fixed_.insert(part * last_ / parts);
        return;
    }
    for (const double instant : output.snapshots) {
        const auto nearer = [instant](double a, double b) { return std::abs(a - instant) < std::abs(b - instant); };
        fixed_.insert(static_cast<std::size_t>(std::min_element(scene.times.begin(), scene.times.end(), nearer) -
                                               scene.times.begin()));
    }
}

std::set<std::size_t> Instants::up_to(std::size_t last) const {
    std::set<std::size_t> steps(fixed_.begin(), fixed_.upper_bound(last));
    for (const auto& [step, size] : events_)
        if (step <= last) steps.insert(step);
    return steps;
}

void Instants::judge(std::size_t step, const Sight& before, const Sight& now) {
    events_.erase(events_.lower_bound(step), events_.end());
    const std::size_t patterns = std::max<std::size_t>(now.reactions.size(), 1);
    largest_.resize(patterns, 0.0);
    lowest_.resize(patterns, 0.0);
    Event change{Kind::jump, 0, 0.0};
    for (std::size_t p = 0; p < now.reactions.size(); ++p) {
        const double then = before.reactions[p], present = now.reactions[p];
        largest_[p] = std::max({largest_[p], then, present});
        if (const Event own{Kind::jump, p, std::abs(present - then)}; less(change, own)) change = own;
        lowest_[p] = std::min(lowest_[p], then);
        const double rise = then - lowest_[p];
        if (present < then && rise > noticeable_rise * largest_[p]) {
            add({step - 1}, {Kind::peak, p, rise});
            lowest_[p] = present;
        }
    }
    if (before.dissipated <= 0.0 && now.dissipated > 0.0) {
        first_damage_ = step;
        add({step}, {Kind::first_damage, 0, 0.0});
    }
    if (now.jumps > 0.0) add({step - 1, step}, change);
}

bool Instants::less(const Event& a, const Event& b) const {
    if (a.kind != b.kind) return a.kind > b.kind;
    return a.change * largest_[b.pattern] < b.change * largest_[a.pattern];
}

void Instants::add(const std::vector<std::size_t>& steps, const Event& event) {
    std::vector<std::size_t> missing;
    for (const std::size_t step : steps) {
        if (fixed_.contains(step)) continue;
        const auto known = events_.find(step);
        if (known == events_.end())
            missing.push_back(step);
        else if (less(known->second, event))
            known->second = event;
    }
    const std::size_t room = most_instants > fixed_.size() ? most_instants - fixed_.size() : 0;
    if (missing.size() > room) return;
    while (events_.size() + missing.size() > room) {
        const auto least = std::min_element(events_.begin(), events_.end(),
                                            [this](const auto& a, const auto& b) { return less(a.second, b.second); });
        if (!less(least->second, event)) return;
        events_.erase(least);
    }
    for (const std::size_t step : missing) events_.emplace(step, event);
}

ChosenInstants Instants::memory() const {
    ChosenInstants out{{}, {}, {}, {}, largest_, lowest_};
    for (const auto& [step, event] : events_) {
        out.steps.push_back(static_cast<std::int64_t>(step));
        out.kinds.push_back(static_cast<std::int64_t>(event.kind));
        out.patterns.push_back(static_cast<std::int64_t>(event.pattern));
        out.changes.push_back(event.change);
    }
    return out;
}

void Instants::restore(const ChosenInstants& memory) {
    events_.clear();
    for (std::size_t i = 0; i < memory.steps.size(); ++i)
        events_.emplace(
            static_cast<std::size_t>(memory.steps[i]),
            Event{static_cast<Kind>(memory.kinds[i]), static_cast<std::size_t>(memory.patterns[i]), memory.changes[i]});
    largest_ = memory.largest;
    lowest_ = memory.lowest;
}

void Instants::take_every_step() {
    judges_ = false;
    for (std::size_t k = 0; k <= last_; ++k) fixed_.insert(k);
}

}  // namespace cli
