// SPDX-License-Identifier: BSD-3-Clause
#include "fronts.hpp"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

// B = Y_t / (Y_n + Y_t) of every pair. Where the jump is negligible (1e-10 of the largest), the known value stays.
std::vector<double> mixities(const LawData& law, const std::vector<double>& jump, const std::vector<double>& known) {
    const std::size_t pairs = jump.size() / 2;
    std::vector<double> normal(pairs), tangential(pairs);
    double largest = 0.0;
    for (std::size_t p = 0; p < pairs; ++p) {
        const double opening = std::max(0.0, jump[2 * p]);
        normal[p] = 0.5 * law.normal_stiffness * opening * opening;
        tangential[p] = 0.5 * law.tangential_stiffness * jump[2 * p + 1] * jump[2 * p + 1];
        largest = std::max(largest, normal[p] + tangential[p]);
    }
    std::vector<double> b = known;
    for (std::size_t p = 0; p < pairs; ++p) {
        const double total = normal[p] + tangential[p];
        if (total > 1e-20 * largest) b[p] = tangential[p] / total;
    }
    return b;
}

}  // namespace

const char* rule_name(MixityRule rule) {
    return rule == MixityRule::pure ? "pure" : rule == MixityRule::frozen ? "frozen" : "converged";
}

MixityRule find_rule(const std::string& name) {
    for (const MixityRule rule : {MixityRule::pure, MixityRule::frozen, MixityRule::converged})
        if (name == rule_name(rule)) return rule;
    throw Failure(0, "mixity rule '" + name + "' is not known: pure, frozen, converged");
}

Fronts::Fronts(const Flexure& data, double load, std::size_t kept) : flexure_(make_flexure(data)), unit_(load) {
    const Scene& scene = flexure_.scene;
    const std::size_t pairs = flexure_.weight.size();
    Solver solver(scene, 0.0);
    std::vector<double> adhesion = flexure_.adhesion;
    std::size_t tip = 0;
    while (tip < pairs && adhesion[tip] == 0.0) ++tip;
    std::vector<double> known(pairs, 0.0);
    double advance = 0.0;
    for (std::size_t next = tip; next + kept <= pairs; ++next) {
        solver.equilibrate(data.time(load), adhesion);
        Front front;
        front.first_intact = next;
        front.advance = advance;
        front.stored = solver.value("stored_bulk") + solver.value("stored_interface");
        front.mixity = known = mixities(data.law, solver.field("jump"), known);
        solver.commit();  // the next front starts from this one's contact set
        fronts_.push_back(std::move(front));
        if (next == pairs) break;
        adhesion[next] = 0.0;
        advance += flexure_.weight[next];
    }
    // The library updates its operator from front to front; the rounding errors that this leaves must not matter. (Cold
    // starts with the arms nearly separated take hundreds of active-set steps, so the last front is not checked.)
    for (const std::size_t f : {fronts_.size() / 2, fronts_.size() * 9 / 10}) {
        adhesion = flexure_.adhesion;
        std::fill_n(adhesion.begin(), fronts_[f].first_intact, 0.0);
        Solver unused(scene, 0.0);
        unused.equilibrate(data.time(load), adhesion);
        const double stored = unused.value("stored_bulk") + unused.value("stored_interface");
        if (std::abs(fronts_[f].stored - stored) > 2e-8 * stored)
            throw Failure(0, "fronts: energy of front " + std::to_string(f) + " is " +
                                 std::to_string(fronts_[f].stored / stored - 1.0) + " off a solution from scratch");
    }
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
    const Law law(raw);
    const LawData& d = data.law;
    const std::pair<const char*, double> parameters[] = {
        {"normal_stiffness", d.normal_stiffness}, {"tangential_stiffness", d.tangential_stiffness},
        {"normal_onset", d.normal_onset},         {"tangential_onset", d.tangential_onset},
        {"normal_toughness", d.normal_toughness}, {"tangential_toughness", d.tangential_toughness},
        {"onset_exponent_1", d.exponent},         {"onset_exponent_2", d.exponent},
        {"toughness_exponent_1", d.exponent},     {"toughness_exponent_2", d.exponent}};
    for (const auto& [key, value] : parameters) scene.require(delam_law_set(raw, key, value), key);
    for (const Front& front : fronts_) {
        std::vector<double> cost(pairs);
        REQUIRE(scene, delam_law_toughness, raw, static_cast<std::int64_t>(pairs), front.mixity.data(), nullptr,
                cost.data());
        for (std::size_t p = 0; p < pairs; ++p) cost[p] *= flexure_.weight[p];
        cost_.push_back(std::move(cost));
    }
}

double Fronts::stored(std::size_t front, double load) const {
    const double ratio = load / unit_;
    return fronts_[front].stored * ratio * ratio;
}

double Fronts::dissipated(std::size_t from, std::size_t to, MixityRule rule) const {
    double sum = 0.0;
    for (std::size_t f = from; f < to; ++f) {
        const std::size_t pair = fronts_[f].first_intact;
        sum += rule == MixityRule::pure     ? flexure_.weight[pair] * flexure_.data.law.tangential_toughness
               : rule == MixityRule::frozen ? cost_[from][pair]
                                            : cost_[f][pair];
    }
    return sum;
}

std::vector<ScanStep> Fronts::scan(const std::vector<double>& loads, MixityRule rule) const {
    std::vector<ScanStep> steps;
    ScanStep state;
    for (const double load : loads) {
        const std::size_t from = state.front;
        const double before = state.dissipated;
        ++state.step;
        state.load = load;
        for (std::size_t f = from; f < fronts_.size(); ++f) {
            const double energy = stored(f, load);
            const double spent = before + dissipated(from, f, rule);
            if (f > from && !(energy + spent < state.total())) continue;
            state.front = f;
            state.stored = energy;
            state.dissipated = spent;
        }
        steps.push_back(state);
    }
    return steps;
}

Crossing Fronts::crossing(MixityRule rule, bool only_next) const {
    Crossing first;
    for (std::size_t f = 1; f < fronts_.size() && (f == 1 || !only_next); ++f) {
        const double gain = fronts_[0].stored - fronts_[f].stored;
        if (!(gain > 0.0)) continue;
        const double spent = dissipated(0, f, rule);
        const double load = unit_ * std::sqrt(spent / gain);
        if (first.front == 0 || load < first.load) first = {load, f, spent};
    }
    return first;
}

}  // namespace reference
