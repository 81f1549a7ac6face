// SPDX-License-Identifier: BSD-3-Clause
// Stability against the interface: stiffness up to a rigid bond, oscillation of tractions, softening from none to eight
// decades, exponents of the criterion, mode change, mixity of a zero jump.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

// So tough that nothing is ever damaged.
LawData elastic_law(double k) { return {k, k, 1e30, 1e30, 1e30, 1e30}; }

std::vector<double> decades(double first, double last, int step = 1) {
    std::vector<double> all;
    const auto low = std::lround(std::log10(first)), high = std::lround(std::log10(last));
    for (long e = low; e <= high; e += step) all.push_back(std::pow(10.0, static_cast<double>(e)));
    return all;
}

// A notched elastic cantilever: every solve against the direct one.
void stiffness(Study& study) {
    for (const int dimension : {2, 3}) {
        const std::string subject = dimension == 2 ? "stiffness" : "stiffness-3d";
        if (!study.wanted(subject)) continue;
        for (const double k : study.range(decades(1e6, 1e22, dimension == 2 ? 1 : 2), 4)) {
            Trial t = trial_of(subject, "k, N/m3", k);
            t.scene = [=] {
                Cantilever c;
                c.dimension = dimension;
                if (dimension == 3) c.columns = 16, c.notch = 5;
                c.law = elastic_law(k);
                c.lift = 1e-5;
                return make_cantilever(c);
            };
            t.limit = 3e-9;  // ends of contact zones that just touch: 4e-10 of the largest traction
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
}

// Towards the rigid bond: the difference from it must decrease as E/(k h), to zero.
void rigid(Study& study) {
    if (!study.wanted("rigid")) return;
    const auto scene = [](double k) {
        Cantilever c;
        c.bonded = k <= 0.0;
        if (!c.bonded) c.law = elastic_law(k);
        c.notch = 0;
        c.lift = 1e-5;
        return make_cantilever(c);
    };
    const Scene bonded = scene(0.0);
    reference::DirectReference direct(bonded);
    const reference::State limit = direct.solve(1.0, std::vector<double>(bonded.pair_count(), 1.0));
    for (const double k : study.range(decades(1e15, 1e22), 3)) {
        Trial t = trial_of("rigid", "k, N/m3", k);
        t.scene = [=] { return scene(k); };
        t.reference = "bonded, direct solver";
        t.error = [&](const Result& r) {
            return std::max({relative_difference(r.displacement, limit.displacement),
                             relative_difference(r.traction, limit.traction),
                             relative_difference(r.pattern, limit.pattern)});
        };
        // A spring in series with the adjacent half cells, which are k h / (0.3 E) times as compliant. From 1e15 on the
        // spring's share is small: 2 % and less.
        const double softer = 0.3 * 70e9 / (k * 1e-3);
        t.limit = softer / (1.0 + softer) + 1e-9;
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

void bonded(Study& study) {
    if (!study.wanted("bonded")) return;
    for (const double columns : study.range({10, 40, 160}, 2)) {
        Trial t = trial_of("bonded", "columns", columns);
        t.scene = [=] {
            Cantilever c;
            c.bonded = true;
            c.columns = std::lround(columns);
            return make_cantilever(c);
        };
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// A layer 0 <= y <= 2c on a frictionless base, with springs at y = c, under the tension q (2 + cos(pi x/L)) on top:
// each half has the Airy function f(y) cos(ax), where f has four terms; springs, base and top give eight equations.
class Layer {
public:
    static constexpr double length = 1.0, half = 0.25, young = 70e9, poisson = 0.3, load = 1e6;

    explicit Layer(double k) : k_(k) {
        std::array<std::array<long double, 9>, 8> m{};
        const auto put = [&](std::size_t row, int layer, long double y, Quantity q, long double sign) {
            for (std::size_t i = 0; i < 4; ++i)
                m[row][4 * static_cast<std::size_t>(layer) + i] += sign * term(static_cast<int>(i), y, q);
        };
        put(0, 0, 0.0L, Quantity::v, 1.0L);
        put(1, 0, 0.0L, Quantity::shear, 1.0L);
        for (const auto& [row, q] : {std::pair{2, Quantity::normal}, {3, Quantity::shear}}) {
            put(static_cast<std::size_t>(row), 0, half, q, 1.0L);
            put(static_cast<std::size_t>(row), 1, half, q, -1.0L);
        }
        // Traction / k = jump, scaled to the size of displacements.
        put(4, 1, half, Quantity::v, 1.0L), put(4, 0, half, Quantity::v, -1.0L);
        put(4, 0, half, Quantity::normal, -1.0L / k_);
        put(5, 1, half, Quantity::u, 1.0L), put(5, 0, half, Quantity::u, -1.0L);
        put(5, 0, half, Quantity::shear, -1.0L / k_);
        put(6, 1, 2.0L * half, Quantity::normal, 1.0L);
        m[6][8] = load;
        put(7, 1, 2.0L * half, Quantity::shear, 1.0L);
        solve(m);
    }
    double normal(double x) const {
        return static_cast<double>(2.0L * load + amplitude(Quantity::normal) * std::cos(wave * x));
    }
    double shear(double x) const { return static_cast<double>(amplitude(Quantity::shear) * std::sin(wave * x)); }

private:
    enum class Quantity { normal, shear, u, v };
    static constexpr long double wave = 3.14159265358979323846264338327950288L / length;

    // Derivative n of the i-th term, divided by a^n, at s = a y.
    static long double derivative(int i, long double s, int n) {
        const long double ch = std::cosh(s), sh = std::sinh(s);
        const bool even = n % 2 == 0;
        switch (i) {
            case 0:
                return even ? ch : sh;
            case 1:
                return even ? sh : ch;
            case 2:
                return s * (even ? ch : sh) + static_cast<long double>(n) * (even ? sh : ch);
            default:
                return s * (even ? sh : ch) + static_cast<long double>(n) * (even ? ch : sh);
        }
    }
    static long double term(int i, long double y, Quantity q) {
        const long double s = wave * y, a = wave, nu = poisson, e = young;
        const auto f = [&](int n) { return derivative(i, s, n) * a * a; };  // everything divided by a^(n-2)
        switch (q) {
            case Quantity::normal:
                return -f(0);
            case Quantity::shear:
                return f(1);
            case Quantity::u:
                return ((1 - nu * nu) * f(2) + nu * (1 + nu) * f(0)) / (a * e);
            default:
                return -(2.0L * (1 + nu) * f(1) - (1 - nu * nu) * f(3) - nu * (1 + nu) * f(1)) / (a * e);
        }
    }
    long double amplitude(Quantity q) const {
        long double sum = 0.0L;
        for (int i = 0; i < 4; ++i) sum += c_[static_cast<std::size_t>(i)] * term(i, half, q);
        return sum;
    }
    void solve(std::array<std::array<long double, 9>, 8>& m) {
        for (auto& row : m) {
            long double size = 0.0L;
            for (std::size_t j = 0; j < 8; ++j) size = std::max(size, std::abs(row[j]));
            for (auto& v : row) v /= size;
        }
        for (std::size_t p = 0; p < 8; ++p) {
            std::size_t best = p;
            for (std::size_t i = p; i < 8; ++i)
                if (std::abs(m[i][p]) > std::abs(m[best][p])) best = i;
            std::swap(m[p], m[best]);
            for (std::size_t i = 0; i < 8; ++i) {
                if (i == p) continue;
                const long double factor = m[i][p] / m[p][p];
                for (std::size_t j = p; j < 9; ++j) m[i][j] -= factor * m[p][j];
            }
        }
        for (std::size_t i = 0; i < 8; ++i) c_[i] = m[i][8] / m[i][i];
    }

    double k_;
    std::array<long double, 8> c_{};
};

Scene make_layer(double k, std::int64_t columns) {
    Scene scene(2, {Layer::length}, {columns}, {Layer::half, Layer::half}, {columns / 4, columns / 4}, DELAM_QUAD4);
    scene.interface(0, 1);
    begin_standard(scene);
    scene.elastic(-1, Layer::young, Layer::poisson);
    scene.law(0, elastic_law(k));
    const double top = 2.0 * Layer::half, h = Layer::length / static_cast<double>(columns);
    scene.hold(scene.find(0, {0.0, 0.0}, {Layer::length, 0.0}), {0.0, 1.0});
    for (const double x : {0.0, Layer::length}) scene.hold(scene.find(-1, {x, 0.0}, {x, top}), {1.0, 0.0});
    const auto face = scene.find(1, {0.0, top}, {Layer::length, top});
    std::vector<double> forces;
    for (const auto n : face) {
        const double x = scene.coordinate(n, 0);
        const bool end = x < 0.5 * h || x > Layer::length - 0.5 * h;
        forces.push_back(0.0);
        forces.push_back((end ? 0.5 : 1.0) * h * Layer::load * (2.0 + std::cos(std::acos(-1.0) * x / Layer::length)));
    }
    const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, 1.0});
    REQUIRE(scene, delam_problem_add_forces, scene.problem(), pull, static_cast<std::int64_t>(face.size()), face.data(),
            forces.data(), 0);
    return scene;
}

double variation(const std::vector<double>& values, std::size_t component) {
    double sum = 0.0;
    for (std::size_t i = 2 + component; i < values.size(); i += 2) sum += std::abs(values[i] - values[i - 2]);
    return sum;
}

// Tractions of the layer against the closed form, and their variation against its variation: an oscillating interface
// has a total variation far above that of the smooth solution.
void oscillation(Study& study) {
    for (const bool varies : {false, true}) {
        const std::string subject = varies ? "oscillation" : "tractions";
        if (!study.wanted(subject)) continue;
        constexpr std::int64_t columns = 64;
        for (const double k : study.range(decades(1e6, 1e22), 4)) {
            const auto exact = std::make_shared<Layer>(k);
            Trial t = trial_of(subject, "k, N/m3", k);
            t.scene = [=] { return make_layer(k, columns); };
            t.reference = "closed form (Airy)";
            t.error = [=](const Result& r) {
                std::vector<double> known;
                for (std::size_t i = 0; 2 * i < r.traction.size(); ++i) {
                    const double x = Layer::length * static_cast<double>(i) / static_cast<double>(columns);
                    known.push_back(exact->normal(x));
                    known.push_back(exact->shear(x));
                }
                if (!varies) return relative_difference(r.traction, known);
                const double normal = variation(r.traction, 0) / variation(known, 0) - 1.0;
                const double shear = variation(r.traction, 1) / variation(known, 1) - 1.0;
                return std::max(std::abs(normal), std::abs(shear));
            };
            t.limit = varies ? 1e-2 : 2e-3;
            t.acceptance_limit = 5e-9;
            t.defect_limit = 1e-9;
            study.run(t);
        }
    }
}

// ---- one pair with a prescribed jump, computed by an independent scheme

struct PairState {
    double adhesion = 1.0, normal = 0.0, tangential = 0.0, stored = 0.0, spent = 0.0;  // per area
    double work = 0.0;  // from the tractions at the ends of the steps
};

// Mixity of a step: that of the last non-zero jump before it; in the first loaded step, that of its own jump.
std::vector<PairState> own_scheme(const LawData& data, const std::vector<double>& open,
                                  const std::vector<double>& slide) {
    const OwnLaw law(data);
    std::vector<PairState> all;
    PairState s;
    double before[2] = {0.0, 0.0};
    long double last = 0.0L;
    bool loaded = false;
    for (std::size_t k = 0; k < open.size(); ++k) {
        const double now[2] = {open[k], slide[k]};
        const long double y = law.driving(now, 2);
        const long double mixity = loaded ? last : law.mixity(now, 2);
        const long double old = s.adhesion, adhesion = law.adhesion(mixity, y, old);
        s.spent += static_cast<double>(law.spent(mixity, adhesion) - law.spent(mixity, old));
        const double normal = s.normal, tangential = s.tangential;
        s.adhesion = static_cast<double>(adhesion);
        s.stored = static_cast<double>(adhesion * y);
        s.normal = static_cast<double>(adhesion * data.normal_stiffness * now[0]);
        s.tangential = static_cast<double>(adhesion * data.tangential_stiffness * now[1]);
        s.work +=
            0.5 * ((s.normal + normal) * (now[0] - before[0]) + (s.tangential + tangential) * (now[1] - before[1]));
        all.push_back(s);
        loaded = loaded || now[0] != 0.0 || now[1] != 0.0;
        if (law.driving(now, 2) > 0.0L) last = law.mixity(now, 2);
        std::copy(now, now + 2, before);
    }
    return all;
}

Trial driven(const std::string& subject, const std::string& parameter_name, double parameter, const LawData& law,
             const std::vector<double>& open, const std::vector<double>& slide) {
    Trial t = trial_of(subject, parameter_name, parameter);
    t.times.clear();
    std::vector<double> times{0.0}, opens{0.0}, slides{0.0};
    for (std::size_t k = 0; k < open.size(); ++k) {
        t.times.push_back(static_cast<double>(k + 1));
        times.push_back(static_cast<double>(k + 1));
        opens.push_back(open[k]);
        slides.push_back(slide[k]);
    }
    t.delta = 1e-12;
    t.law = law;
    t.scene = [=] { return make_driven(law, times, opens, slides, 1e-12); };
    t.reference = "closed form (own scheme)";
    const auto exact = std::make_shared<std::vector<PairState>>(own_scheme(law, open, slide));
    double peak = 1e-300, energy = 1e-300;
    for (const PairState& s : *exact) {
        peak = std::max({peak, std::abs(s.normal), std::abs(s.tangential)});
        energy = std::max({energy, s.stored, s.spent, std::abs(s.work)});
    }
    const double toughness = std::max(law.normal_toughness, law.tangential_toughness);
    t.error = [=](const Result& r) {
        const PairState& s = (*exact)[r.step];
        double worst = 0.0;
        for (std::size_t p = 0; 2 * p < r.traction.size(); ++p)
            worst =
                std::max({worst, std::abs(r.traction[2 * p] - s.normal) / peak,
                          std::abs(r.traction[2 * p + 1] - s.tangential) / peak, std::abs(r.adhesion[p] - s.adhesion)});
        // 1 mm of interface.
        if (r.realisation != Realisation::direct)
            worst = std::max({worst, std::abs(r.dissipated - 1e-3 * s.spent) / (1e-3 * toughness),
                              std::abs(r.work - 1e-3 * s.work) / (1e-3 * toughness)});
        return worst;
    };
    t.limit = 5e-12;
    // Frozen mixity and the trapezoidal rule over the jumps; the scheme knows the remaining error.
    t.defect = std::abs(exact->back().stored + exact->back().spent - exact->back().work) / energy;
    t.defect_limit = closed_balance;
    t.subdomains = 2;
    return t;
}

void exponents(Study& study) {
    if (!study.wanted("exponent")) return;
    for (const double p : study.range({0.5, 0.6, 0.75, 1, 1.25, 1.5, 2, 3, 4, 5, 7, 10, 14, 20}, 4)) {
        LawData law{1e12, 2e12, 100.0, 200.0, 300.0, 900.0};
        law.exponent = p;
        std::vector<double> open, slide;
        for (int k = 1; k <= 12; ++k) {
            open.push_back(5e-6 * k);
            slide.push_back(4e-6 * k);
        }
        study.run(driven("exponent", "exponent", p, law, open, slide));
    }
}

// Opened into softening, then slid until it breaks: the toughness changes during the load history.
void mode_change(Study& study) {
    if (!study.wanted("mode-change")) return;
    for (const double steps : study.range({2, 4, 10, 30, 100, 300}, 3)) {
        const LawData law{125e9, 125e9, 100.0, 200.0, 250.0, 900.0};
        std::vector<double> open, slide;
        const int n = static_cast<int>(steps);
        for (int k = 1; k <= 2 * n; ++k) {
            const double part = static_cast<double>(k) / n;
            open.push_back(6e-5 * std::min(part, 1.0) * (part > 1.0 ? 2.0 - part : 1.0));
            slide.push_back(4e-4 * std::max(0.0, part - 1.0));
        }
        study.run(driven("mode-change", "steps a leg", steps, law, open, slide));
    }
}

// A jump so small that its energy may underflow (psi = 0/0), in mode II, at first or between loading steps, followed by
// loads that break the pair: the toughness must be that of mode II all the same. 0: no jump at all.
void no_jump(Study& study) {
    const std::vector<double> jumps{0.0, 5e-324, 1e-300, 1e-250, 1e-200, 1e-170, 1e-160, 1e-150, 1e-100, 1e-50, 1e-20};
    for (const bool between : {false, true}) {
        const std::string subject = between ? "psi-0/0-between" : "psi-0/0";
        if (!study.wanted(subject)) continue;
        for (const double tiny : study.range(jumps, 4)) {
            const LawData law{125e9, 125e9, 100.0, 200.0, 250.0, 900.0};
            std::vector<double> slide{tiny, 8e-5, 1.2e-4, 4e-4};
            if (between) slide.insert(slide.begin(), 2e-5);
            study.run(driven(subject, "jump, m", tiny, law, std::vector<double>(slide.size(), 0.0), slide));
        }
    }
}

// An elastic bar in series with the interface, 3 times stiffer than the softening slope: one continuous solution.
void brittleness(Study& study) {
    if (!study.wanted("brittleness")) return;
    constexpr double k = 125e9, toughness = 250.0, side = 0.05;
    for (const double ratio : study.range({1, 1.0001, 1.01, 1.1, 2, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}, 4)) {
        const double onset = toughness / ratio, peak = std::sqrt(2.0 * k * onset);
        const double slope = ratio > 1.0 ? 0.5 * peak * peak / (toughness - onset) : 0.0;
        const double spring = ratio > 1.0 ? 3.0 * slope : k;
        const double d0 = std::sqrt(2.0 * onset / k), dc = 2.0 * toughness / peak;
        const double start = peak * (1.0 / spring + 1.0 / k);
        const double end = 1.1 * std::max(dc, start);
        Trial t = trial_of("brittleness", "Gc/Go", ratio);
        t.times.clear();
        constexpr int steps = 20;
        // Not at the ends of branches.
        for (int i = 1; i <= steps; ++i) t.times.push_back((i - 0.37) / steps);
        const LawData law{k, k, onset, onset, toughness, toughness};
        t.law = law;
        t.delta = 1e-12;
        t.scene = [=] {
            Scene scene(2, {side}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
            scene.interface(0, 1);
            begin_standard(scene);
            scene.elastic(-1, 2.0 * spring, 0.0);
            scene.law(0, law);
            scene.hold(scene.find(-1, {0.0, 0.0}, {side, 2.0}), {1.0, 0.0});
            scene.hold(scene.find(0, {0.0, 0.0}, {side, 0.0}), {0.0, 1.0});
            const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, end});
            scene.drive(scene.find(1, {0.0, 2.0}, {side, 2.0}), {0.0, 1.0}, pull, {1.0, 1.0});
            scene.number("damage_tolerance", 1e-12);
            return scene;
        };
        t.subdomains = 2;
        t.reference = "closed form (series)";
        t.error = [=](const Result& r) {
            const double w = end * r.time;
            double jump = w / (1.0 + k / spring), traction = w / (1.0 / spring + 1.0 / k);
            if (ratio > 1.0 ? w >= dc : w > start) {
                jump = w;
                traction = 0.0;
            } else if (w > start) {
                jump = (w - slope * dc / spring) / (1.0 - slope / spring);
                traction = slope * (dc - jump);
            }
            double worst = 0.0;
            for (std::size_t p = 0; 2 * p < r.jump.size(); ++p)
                worst = std::max({worst, std::abs(r.jump[2 * p] - jump) / std::max(w, d0),
                                  std::abs(r.traction[2 * p] - traction) / peak});
            return worst;
        };
        // Go is so much smaller than Gc that rounding leaves fewer of its digits.
        t.limit = std::max(1e-10, 1e-15 * ratio);
        t.acceptance_limit = 1e-8;
        study.run(t);
    }
}

// The mixed-mode cantilever over all steps: there is no closed form, so every state is checked.
void brittleness_cantilever(Study& study) {
    if (!study.wanted("brittleness-cantilever")) return;
    for (const double ratio : study.range({1, 1.01, 2, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}, 4)) {
        Cantilever c;
        c.law = {1e13, 1e13, 200.0 / ratio, 400.0 / ratio, 200.0, 400.0};
        c.delta = 1e-9;
        Trial t = trial_of("brittleness-cantilever", "Gc/Go", ratio);
        t.times = {0.25, 0.5, 0.75, 1.0};
        t.law = c.law;
        t.delta = c.delta;
        t.scene = [=] { return make_cantilever(c); };
        t.limit = 1e-9;
        study.run(t);
    }
}

}  // namespace

void stability_interface(Study& study) {
    stiffness(study);
    rigid(study);
    bonded(study);
    oscillation(study);
    brittleness(study);
    brittleness_cantilever(study);
    exponents(study);
    mode_change(study);
    no_jump(study);
}

}  // namespace harness
