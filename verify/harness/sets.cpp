// SPDX-License-Identifier: BSD-3-Clause
// An experiment: search over all sets of broken pairs, not only over fronts. With a Griffith-type law the least elastic
// energy E(Z) is nearly submodular in the set Z of broken pairs, because a broken neighbour makes a pair easier to
// break, and the dissipation at frozen mixity is modular. The minimum-norm point then searches all sets with a dual
// bound. This file measures how nearly submodular E is and how tight the bound is.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>

#include "fronts.hpp"
#include "submodular.hpp"
#include "table.hpp"

namespace harness {
namespace {

using reference::dual_bound;
using reference::Set;
using reference::SetFunction;

constexpr double unit_load = 1e-3;
constexpr double ruled_out = 1e300;

// E(Z) at the unit load, solved once for every set. The last pair of the interface never breaks, so that nothing
// floats.
class Energy {
public:
    explicit Energy(const reference::FlexureScene& flexure) : flexure_(flexure), solver_(flexure.scene, 0.0) {
        for (std::size_t p = 0; p + 1 < flexure.adhesion.size(); ++p)
            if (flexure.adhesion[p] > 0.0) pairs_.push_back(p);
    }
    std::size_t size() const { return pairs_.size(); }
    std::size_t pair(std::size_t element) const { return pairs_[element]; }
    std::vector<Set> known() const {
        std::vector<Set> sets;
        for (const auto& [key, energy] : known_) sets.emplace_back(key.begin(), key.end());
        return sets;
    }
    long calls() const { return static_cast<long>(known_.size()); }

    double operator()(const Set& broken) {
        const std::string key(broken.begin(), broken.end());
        if (const auto found = known_.find(key); found != known_.end()) return found->second;
        std::vector<double> adhesion = flexure_.adhesion;
        for (std::size_t i = 0; i < broken.size(); ++i)
            if (broken[i] != 0) adhesion[pairs_[i]] = 0.0;
        solver_.equilibrate(flexure_.data.time(unit_load), adhesion);
        const double energy = solver_.value("stored_bulk") + solver_.value("stored_interface");
        solver_.commit();  // the next set is likely to be close to this one
        return known_[key] = energy;
    }

private:
    const reference::FlexureScene& flexure_;
    reference::Solver solver_;
    std::vector<std::size_t> pairs_;
    std::map<std::string, double> known_;
};

struct Violations {
    long tests = 0, violated = 0;
    double worst = 0.0;    // J/m at the unit load, largest increase of a marginal
    double typical = 0.0;  // mean size of the tested marginals
    double share() const { return tests > 0 ? static_cast<double>(violated) / static_cast<double>(tests) : 0.0; }
};

// A is a subset of B, i is in neither: breaking i must release no less energy from B than from A. Three families: any
// sets; a front and a longer one, i anywhere; a front and the same front with some pairs broken ahead of it, i close to
// the front.
Violations measure(Energy& energy, int tests, int family, std::mt19937& random) {
    const std::size_t n = energy.size();
    std::uniform_int_distribution<std::size_t> element(0, n - 1);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    Violations v;
    double sum = 0.0;
    while (v.tests < tests) {
        Set a(n, 0);
        Set b(n, 0);
        if (family == 0) {
            const double dense = part(random);
            const double within = part(random);
            for (std::size_t i = 0; i < n; ++i) {
                b[i] = part(random) < dense ? 1 : 0;
                a[i] = b[i] != 0 && part(random) < within ? 1 : 0;
            }
        } else {
            const std::size_t front = element(random);
            const std::size_t longer = family == 1 ? front + element(random) % (n - front) : front;
            for (std::size_t i = 0; i < n; ++i) {
                a[i] = i < front ? 1 : 0;
                b[i] = i < longer || (family == 2 && i >= front && i < front + 8 && part(random) < 0.4) ? 1 : a[i];
            }
        }
        std::size_t i = element(random);
        if (family == 2) {
            std::size_t front = 0;
            while (front < n && a[front] != 0) ++front;
            i = front + element(random) % 10;
        }
        if (i >= n || b[i] != 0 || a == b) continue;
        Set ai = a;
        Set bi = b;
        ai[i] = bi[i] = 1;
        const double from_a = energy(ai) - energy(a);
        const double from_b = energy(bi) - energy(b);
        ++v.tests;
        sum += std::abs(from_a) + std::abs(from_b);
        if (from_b > from_a) ++v.violated;
        v.worst = std::max(v.worst, from_b - from_a);
    }
    v.typical = sum / (2.0 * static_cast<double>(v.tests));
    return v;
}

// Runs of broken pairs as positions in mm, e.g. "30-52, 61".
std::string describe(const Energy& energy, const reference::FlexureScene& flexure, const Set& set) {
    std::string text;
    const auto mm = [&](std::size_t i) {
        char line[20];
        std::snprintf(line, sizeof line, "%g", flexure.position[energy.pair(i)] * 1e3);
        return std::string(line);
    };
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (set[i] == 0 || (i > 0 && set[i - 1] != 0)) continue;
        std::size_t last = i;
        while (last + 1 < set.size() && set[last + 1] != 0) ++last;
        if (!text.empty()) text += ", ";
        text += mm(i);
        if (last > i) text.append("-").append(mm(last));
    }
    return text.empty() ? "none" : text;
}

// Least value found by descent, exchanging one pair at a time, from random sets with up to the fraction `densest`
// broken and from the best of `known`.
struct Descent {
    double value = 0.0;
    Set set;
};
Descent descend(const SetFunction& f, std::size_t n, const std::vector<Set>& known, double densest, int starts,
                std::mt19937& random) {
    Descent least{0.0, Set(n, 0)};
    const auto keep = [&](double value, const Set& set) {
        if (value < least.value) least = {value, set};
    };
    const auto go_down = [&](Set set) {
        double level = f(set);
        for (bool moved = true; moved;) {
            moved = false;
            for (std::size_t i = 0; i < n; ++i) {
                set[i] ^= 1U;
                const double value = f(set);
                if (value < level - 1e-14 * std::abs(level)) {
                    level = value;
                    moved = true;
                } else {
                    set[i] ^= 1U;
                }
            }
        }
        keep(level, set);
    };
    for (const Set& set : known) keep(f(set), set);
    go_down(least.set);
    std::uniform_real_distribution<double> part(0.0, densest);
    for (int start = 0; start < starts; ++start) {
        Set set(n, 0);
        const double dense = part(random);
        for (std::uint8_t& member : set) member = part(random) < dense ? 1 : 0;
        go_down(std::move(set));
    }
    return least;
}

bool is_front(const Set& set) {
    return std::is_sorted(set.begin(), set.end(), [](std::uint8_t a, std::uint8_t b) { return a > b; });
}

}  // namespace

Table sets(const Options& options) {
    Table table;
    table.name = "sets";
    table.note =
        "Brittle specimens, h = 1 mm, point supports, J/m; F(Z) = E(Z) - E({}) + sum of the pairs' toughness at the "
        "mixity of the unbroken state. "
        "load_part: load over that at which fronts cross. fronts: least F of all fronts; best: least F met by the "
        "minimum-norm point, and its set in mm; "
        "descent: least F met by exchanges of single pairs from random sets. bound: dual bound if F were submodular, "
        "gap: best - bound over E({}). v: "
        "largest growth of a marginal in random tests (shares violated in three families: any sets / fronts / front "
        "and pairs ahead; then v over the "
        "mean marginal); bound_v, gap_v: what follows if v holds for all sets. excess: largest x(A) - F(A) of the dual "
        "vector x found by descent "
        "from random sets that no energy rules out (those that cost at most `budget`), at the set failing_mm, whose F "
        "is F_failing; gap_x: gap of bound - excess, which holds if no set exceeds more. calls: distinct "
        "sets solved for by the minimum-norm point.";
    table.columns = {"specimen", "load_part", "load_mm",   "fronts", "best",       "set_mm",          "is_front",
                     "descent",  "bound",     "gap",       "v",      "v_share",    "v_over_marginal", "bound_v",
                     "gap_v",    "budget",    "excess",    "gap_x",  "failing_mm", "F_failing",       "E_0",
                     "major",    "minor",     "wolfe_gap", "calls",  "bound_holds"};
    const int tests = options.quick ? 100 : 2000;
    const int limit = options.quick ? 20 : 400;
    for (const char* name : {"enf-brittle", "mmf-brittle"}) {
        progress(std::string("sets: ") + name);
        const reference::Fronts fronts(reference::find_flexure(name));
        const reference::FlexureScene& flexure = fronts.flexure();
        Energy energy(flexure);
        const std::size_t n = energy.size();
        std::vector<double> cost;
        for (std::size_t i = 0; i < n; ++i) cost.push_back(fronts.cost(0, energy.pair(i)));
        std::mt19937 random(20101);
        Violations all[3];
        double worst = 0.0;
        for (int family = 0; family < 3; ++family) {
            progress("sets: violations, family " + std::to_string(family));
            all[family] = measure(energy, tests, family, random);
            worst = std::max(worst, all[family].worst);
        }
        char shares[60];
        std::snprintf(shares, sizeof shares, "%.2f / %.2f / %.2f", all[0].share(), all[1].share(), all[2].share());
        char relative[60];
        std::snprintf(relative, sizeof relative, "%.1e / %.1e / %.1e", all[0].worst / all[0].typical,
                      all[1].worst / all[1].typical, all[2].worst / all[2].typical);
        const auto crossing = fronts.crossing(reference::MixityRule::frozen);
        for (const double part : {0.95, 0.99, 1.01, 1.05, 1.5}) {
            if (options.quick && part != 1.01) continue;
            progress("sets: load part " + std::to_string(part));
            const double load = part * crossing.load;
            const double square = (load / unit_load) * (load / unit_load);
            const double none = energy(Set(n, 0));
            const auto f = [&](const Set& set) {
                double value = square * (energy(set) - none);
                for (std::size_t i = 0; i < n; ++i) value += set[i] != 0 ? cost[i] : 0.0;
                return value;
            };
            double least = 0.0;
            Set front(n, 0);
            for (std::size_t i = 0; i < n; ++i) {
                front[i] = 1;
                least = std::min(least, f(front));
            }
            const long before = energy.calls();
            const auto found = reference::minimise_submodular(n, f, limit);
            const long calls = energy.calls() - before;
            // The dual vector proves the bound if x(A) <= F(A) for every set A. Other means search for the set that
            // violates this most, and for one of lower F. E decreases with the set, so F(A) >= E(V) - E({}) + cost(A):
            // sets that cost more than `budget` are excluded for good.
            const double budget = found.value + square * (none - energy(Set(n, 1)));
            const double all_cost = std::accumulate(cost.begin(), cost.end(), 0.0);
            const auto less_dual = [&](const Set& set) {
                double spent = 0.0;
                for (std::size_t i = 0; i < n; ++i) spent += set[i] != 0 ? cost[i] : 0.0;
                if (spent > budget) return ruled_out;
                double value = f(set);
                for (std::size_t i = 0; i < n; ++i) value -= set[i] != 0 ? found.dual[i] : 0.0;
                return value;
            };
            const int starts = options.quick ? 2 : 10;
            const Descent failure =
                descend(less_dual, n, energy.known(), std::min(1.0, budget / all_cost), starts, random);
            const Descent other = descend(f, n, energy.known(), 1.0, starts, random);
            const double best = std::min({least, found.value, other.value});
            const double scale = square * none;
            const double v = square * worst;
            const double corrected = dual_bound(found.dual, v);
            const std::string verdict = found.bound > best + 1e-12 * scale ? "refuted: it lies above a set's value"
                                        : failure.value < -1e-9 * scale    ? "not proven: x(A) > F(A) for failing_mm"
                                        : worst > 0.0                      ? "not refuted, not proven"
                                                                           : "if no set violates";
            table.rows.push_back({name,
                                  part,
                                  load * 1e3,
                                  least,
                                  found.value,
                                  describe(energy, flexure, found.best),
                                  is_front(found.best) ? "yes" : "no",
                                  other.value,
                                  found.bound,
                                  (best - found.bound) / scale,
                                  v,
                                  shares,
                                  relative,
                                  corrected,
                                  (best - corrected) / scale,
                                  budget,
                                  -failure.value,
                                  (best - found.bound - failure.value) / scale,
                                  describe(energy, flexure, failure.set),
                                  f(failure.set),
                                  scale,
                                  found.major,
                                  found.minor,
                                  found.wolfe_gap,
                                  calls,
                                  verdict});
        }
    }
    return table;
}

}  // namespace harness
