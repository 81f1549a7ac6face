// SPDX-License-Identifier: BSD-3-Clause
#include "stability.hpp"
#include "stability_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace harness {
namespace {

using reference::DirectReference;
using reference::Exported;
using reference::Scene;
using reference::Solver;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

const char* name_of(Realisation r) {
    return r == Realisation::condensed ? "condensed" : r == Realisation::feti ? "FETI" : "direct";
}

double worse(double a, double b) { return std::isnan(a) || std::isnan(b) ? infinite : std::max(a, b); }

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The analysis of one realisation, its cost and its outcome.
struct TrialAnalysis {
    std::vector<Result> states;
    std::string status = "converged", message;
    bool ended = false;  // by an error, or by an outcome without a state
    double active_set = 0.0, krylov = 0.0, alternations = 0.0;
    double kkt = 0.0, ledger = 0.0, defect = 0.0, damage = 0.0, error = 0.0;
};

std::vector<bool> flags(const std::vector<double>& values) {
    std::vector<bool> result;
    for (const double v : values) result.push_back(v != 0.0);
    return result;
}

// Conjugates of the patterns computed from the reactions, independent of those the library reports.
std::vector<double> conjugates(const Exported& e, const std::vector<double>& reaction, const std::vector<double>& u) {
    std::vector<double> all;
    for (std::size_t p = 0; p < e.patterns; ++p) {
        long double sum = 0.0L;
        for (std::size_t c = 0; c < reaction.size(); ++c)
            sum += static_cast<long double>(reaction[c]) * e.prescribed[c * e.patterns + p];
        for (std::size_t i = 0; i < e.dofs; ++i) sum -= static_cast<long double>(e.forces[p][i]) * u[i];
        all.push_back(static_cast<double>(sum));
    }
    return all;
}

Result read(const Solver& solver, const Exported& e, Realisation realisation, std::size_t step) {
    Result r;
    r.realisation = realisation;
    r.step = step;
    r.time = solver.value("time");
    r.displacement = solver.field("displacement");
    r.jump = solver.field("jump");
    r.traction = solver.field("traction");
    r.adhesion = solver.field("adhesion");
    r.mixity = solver.field("mixity");
    r.reaction = solver.field("reaction");
    r.contact = flags(solver.field("contact"));
    r.factor = e.factors(solver.scene(), r.time);
    r.pattern = conjugates(e, r.reaction, r.displacement);
    r.stored_bulk = solver.value("stored_bulk");
    r.stored_interface = solver.value("stored_interface");
    r.load_potential = solver.value("load_potential");
    r.dissipated = solver.value("dissipated");
    r.work = solver.value("work");
    return r;
}

Result from(const reference::State& s, const Exported& e, const Scene& scene, const Result& at) {
    Result r = at;
    r.realisation = Realisation::direct;
    r.displacement = s.displacement;
    r.jump = s.jump;
    r.traction = s.traction;
    r.reaction = s.reaction;
    r.contact = s.contact;
    r.pattern = s.pattern;
    r.factor = e.factors(scene, at.time);
    r.stored_bulk = s.stored_bulk;
    r.stored_interface = s.stored_interface;
    r.load_potential = 0.0;
    for (std::size_t p = 0; p < e.patterns; ++p)
        for (std::size_t i = 0; i < e.dofs; ++i) r.load_potential -= r.factor[p] * e.forces[p][i] * s.displacement[i];
    r.dissipated = r.work = unknown;
    return r;
}

// Worst violation of all states, relative to the largest jump, traction and force of the analysis. Jumps computed as
// u_b - u_a are measured by at least a thousandth of the largest displacement: iterative solutions are no more accurate
// where only k [u] determines [u].
double kkt_of(const Trial& trial, const Scene& scene, const Exported& e, const std::vector<Result>& states) {
    constexpr double compatible = 1e-3;
    reference::Least least;
    least.traction = trial.least_traction;
    least.force = trial.least_force;
    // A factorisation leaves an error of hundreds of ulps: bending forces are small differences of the forces within
    // thin cells.
    least.ulps = 1000.0;
    double u = 0.0;
    for (const Result& r : states) {
        least.jump = std::max(least.jump, largest(r.jump));
        least.traction = std::max(least.traction, largest(r.traction));
        least.force = std::max(least.force, largest(r.reaction));
        u = std::max(u, largest(r.displacement));
    }
    least.between_displacements = compatible * u;
    double worst = 0.0;
    for (const Result& r : states) {
        const reference::Acceptance a = reference::accept(
            scene, {r.time, r.displacement, r.jump, r.traction, r.adhesion, r.reaction, r.contact}, e, least);
        for (const double v : {a.gap, a.gap_displacement, a.jump_mismatch, a.pressure, a.complementarity, a.balance,
                               a.supports, a.law, a.adhesion})
            worst = worse(worst, v);
    }
    return worst;
}

// Energies of a state from its fields: of the bodies by Clapeyron (half the work of all forces on them), of the
// interfaces from their springs.
struct Energies {
    double bulk = 0.0, interface = 0.0, potential = 0.0;
    double total() const { return bulk + interface + potential; }
};
Energies energies_of(const Scene& scene, const Exported& e, const Result& r) {
    const auto d = static_cast<std::size_t>(e.dimension);
    long double twice_bulk = 0.0L, interface = 0.0L, potential = 0.0L;
    for (std::size_t p = 0; p < e.patterns; ++p) {
        twice_bulk += static_cast<long double>(r.factor[p]) * r.pattern[p];
        for (std::size_t i = 0; i < e.dofs; ++i) {
            const long double done = static_cast<long double>(r.factor[p]) * e.forces[p][i] * r.displacement[i];
            potential -= done;
            // The conjugate of the pattern has the opposite sign.
            twice_bulk += 2.0L * done;
        }
    }
    std::size_t pair = 0;
    for (std::size_t i = 0; i < e.interfaces.size(); ++i) {
        const reference::InterfaceStiffness& k = scene.stiffness()[i];
        for (std::size_t n = 0; n < e.interfaces[i].count(); ++n, ++pair)
            for (std::size_t c = 0; c < d; ++c) {
                const long double j = r.jump[pair * d + c], w = e.interfaces[i].weight[n];
                twice_bulk -= w * static_cast<long double>(r.traction[pair * d + c]) * j;
                if (k.bonded || (c == 0 && r.contact[pair])) continue;
                interface += 0.5L * w * r.adhesion[pair] * (c == 0 ? k.normal : k.tangential) * j * j;
            }
    }
    return {static_cast<double>(0.5L * twice_bulk), static_cast<double>(interface), static_cast<double>(potential)};
}

// Energy dissipated between two states at the mixity that the later one used.
double spent_between(const OwnLaw& law, const Scene& scene, const Exported& e, const Result& before,
                     const Result& after) {
    long double sum = 0.0L;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < e.interfaces.size(); ++i)
        for (std::size_t n = 0; n < e.interfaces[i].count(); ++n, ++pair) {
            if (scene.stiffness()[i].bonded || after.adhesion[pair] == before.adhesion[pair]) continue;
            sum += static_cast<long double>(e.interfaces[i].weight[n]) *
                   (law.spent(after.mixity[pair], after.adhesion[pair]) -
                    law.spent(after.mixity[pair], before.adhesion[pair]));
        }
    return static_cast<double>(sum);
}

// Distance of the adhesions from the pointwise minimisers at the given jumps.
double damage_residual(const OwnLaw& law, const Scene& scene, const Exported& e, const Result& before,
                       const Result& now) {
    const auto d = static_cast<std::size_t>(e.dimension);
    double worst = 0.0;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < e.interfaces.size(); ++i)
        for (std::size_t n = 0; n < e.interfaces[i].count(); ++n, ++pair) {
            if (scene.stiffness()[i].bonded || scene.stiffness()[i].normal == 0.0) continue;
            const long double y = law.driving(&now.jump[pair * d], e.dimension), mixity = now.mixity[pair];
            const long double gc = law.toughness(mixity);
            // Without softening the minimiser jumps at Y = Gc; both values are right there.
            if (gc - law.onset(mixity) <= 1e-9L * gc && std::abs(y - gc) < 1e-6L * gc) continue;
            const long double best = law.adhesion(mixity, y, before.adhesion[pair]);
            worst = worse(worst, static_cast<double>(std::abs(best - now.adhesion[pair])));
        }
    return worst;
}

double difference(const Result& a, const Result& b, const Compared& what) {
    double worst = 0.0;
    if (what.displacement) worst = worse(worst, relative_difference(a.displacement, b.displacement));
    if (what.jump) worst = worse(worst, relative_difference(a.jump, b.jump));
    if (what.traction) worst = worse(worst, relative_difference(a.traction, b.traction));
    if (what.pattern) worst = worse(worst, relative_difference(a.pattern, b.pattern));
    if (what.energy)
        worst =
            worse(worst, relative_difference({a.stored_bulk, a.stored_interface}, {b.stored_bulk, b.stored_interface}));
    return worst;
}

// The analysis, its energies computed again from fields, and the primal KKT conditions of every state.
TrialAnalysis analyse(const Trial& trial, Realisation realisation) {
    TrialAnalysis m;
    std::optional<Scene> kept;
    try {
        kept.emplace(trial.scene());
        Scene& scene = *kept;
        scene.text("mixity_rule", "frozen");  // its dissipated energy is a function of the states
        scene.text("reduction", realisation == Realisation::feti ? "feti" : "condensed");
        if (realisation == Realisation::feti) scene.number("subdomains", trial.subdomains);
        const Exported exported(scene);
        Solver solver(scene, 0.0);
        Result before = read(solver, exported, realisation, 0);
        const double start = before.stored_bulk + before.stored_interface + before.load_potential;
        double work = 0.0, dissipated = 0.0, scale = trial.least_energy;
        std::vector<double> recorded_less_own;
        double own_before = energies_of(scene, exported, before).total();
        std::optional<OwnLaw> law;
        if (trial.law) law.emplace(*trial.law);
        for (std::size_t k = 0; k < trial.times.size(); ++k) {
            const std::int32_t status = solver.advance(trial.times[k]);
            if (status != DELAM_OK) {
                m.message = first_line(delam_context_message(scene.context()));
                m.status = delam_status_name(status);
                m.ended = status != DELAM_NOT_CONVERGED;
            }
            if (m.ended) break;
            m.active_set += solver.value("contact_iterations");
            m.krylov += solver.value("linear_iterations");
            m.alternations += solver.value("am_iterations");
            Result now = read(solver, exported, realisation, k);
            for (std::size_t p = 0; p < exported.patterns; ++p)
                work += 0.5 * (now.factor[p] - before.factor[p]) * (now.pattern[p] + before.pattern[p]);
            if (law) dissipated += spent_between(*law, scene, exported, before, now);
            const Energies own = energies_of(scene, exported, now);
            scale = std::max({scale, std::abs(own.bulk) + std::abs(own.interface), std::abs(work), dissipated});
            for (const double miss :
                 {now.stored_bulk - own.bulk, now.stored_interface - own.interface, now.load_potential - own.potential,
                  missed_work(before, now, own_before, own.total()), law ? now.dissipated - dissipated : 0.0})
                recorded_less_own.push_back(std::abs(miss));
            m.defect = std::abs(own.bulk + own.interface + own.potential + now.dissipated - work - start);
            if (law && k + 1 == trial.times.size()) m.damage = damage_residual(*law, scene, exported, before, now);
            m.states.push_back(now);
            own_before = own.total();
            before = std::move(now);
            solver.commit();
        }
        m.kkt = kkt_of(trial, scene, exported, m.states);
        for (const double miss : recorded_less_own)
            m.ledger = worse(m.ledger, miss == 0.0 ? 0.0 : scale > 0.0 ? miss / scale : infinite);
        m.defect = m.defect == 0.0 ? 0.0 : scale > 0.0 ? m.defect / scale : infinite;
    } catch (const reference::Failure& failure) {
        m.ended = true;
        m.status = failure.status() != 0 ? delam_status_name(failure.status()) : "failed";
        m.message = first_line(failure.what());
    }
    return m;
}

// The reference's displacement steps at the adhesions of an analysis.
TrialAnalysis direct_analysis(const Trial& trial, const std::vector<Result>& states) {
    TrialAnalysis m;
    try {
        const Scene scene = trial.held ? trial.held() : trial.scene();
        DirectReference direct(scene);
        double scale = trial.least_energy, miss = 0.0;
        for (const Result& at : states) {
            const reference::State s = direct.solve(at.time, at.adhesion);
            Result r = from(s, direct.exported(), scene, at);
            m.active_set += s.contact_iterations;
            const Energies own = energies_of(scene, direct.exported(), r);
            scale = std::max(scale, std::abs(own.bulk) + std::abs(own.interface));
            miss = std::max({miss, std::abs(r.stored_bulk - own.bulk), std::abs(r.stored_interface - own.interface)});
            m.states.push_back(std::move(r));
        }
        m.kkt = kkt_of(trial, scene, direct.exported(), m.states);
        m.ledger = miss == 0.0 ? 0.0 : miss / scale;
    } catch (const reference::Failure& failure) {
        m.ended = true;
        m.status = failure.status() != 0 ? delam_status_name(failure.status()) : "failed";
        m.message = first_line(failure.what());
    }
    return m;
}

// Only the direct reference runs: its states must have no damage.
std::vector<Result> undamaged(const Trial& trial) {
    const Scene scene = trial.scene();
    std::vector<Result> states(trial.times.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
        states[k].step = k;
        states[k].time = trial.times[k];
        states[k].adhesion.assign(scene.pair_count(), 1.0);
    }
    return states;
}

// Relative difference of the direct energies of the last step in two units of length.
double left_by_rounding(const Trial& trial, const TrialAnalysis& analysis) {
    constexpr double unit = 3.0;
    const Result& at = analysis.states.back();
    const Scene scene = trial.in_unit(unit);
    const reference::State s = DirectReference(scene).solve(at.time, at.adhesion);
    return std::abs((s.stored_bulk + s.stored_interface) /
                        (std::pow(unit, scene.dimension()) * (at.stored_bulk + at.stored_interface)) -
                    1.0);
}

std::string format(const char* text, double value) {
    char line[80];
    std::snprintf(line, sizeof line, text, value);
    return line;
}

// Rows of a trial from its analyses, and from the direct ones beside them.
void judge(Study& study, const Trial& trial, std::vector<std::pair<Realisation, TrialAnalysis>> all,
           std::vector<std::optional<TrialAnalysis>> beside) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        TrialAnalysis& m = all[i].second;
        const TrialAnalysis* other = beside[i] ? &*beside[i] : beside[0] ? &*beside[0] : nullptr;
        for (std::size_t k = 0; k < m.states.size(); ++k) {
            if (trial.error) {
                m.error = worse(m.error, trial.error(m.states[k]));
            } else if (other != nullptr && k < other->states.size()) {
                m.error = worse(m.error, difference(m.states[k], other->states[k], trial.compared));
            } else {
                m.error = infinite;
            }
        }
        if (m.states.empty()) m.error = unknown;
    }
    double raised = 0.0;
    if (beside[0] && trial.refused.empty()) {
        TrialAnalysis& m = *beside[0];
        for (const Result& r : m.states) m.error = trial.error ? worse(m.error, trial.error(r)) : 0.0;
        if (m.ended) m.error = unknown;
        if (trial.in_unit && !m.states.empty()) {
            constexpr double often = 20.0, most = 1e-2;
            m.error = left_by_rounding(trial, m);
            raised = std::min(most, often * m.error);
        }
        all.emplace_back(Realisation::direct, std::move(m));
    }
    const std::string right = trial.error || trial.direct ? "right to " + format("%.0e", trial.limit) : "accepted";
    for (const auto& [realisation, m] : all) {
        const bool direct = realisation == Realisation::direct;
        const double limit = std::max(raised, direct && trial.direct_limit > 0.0 ? trial.direct_limit : trial.limit);
        std::string expected = right;
        if (raised > trial.limit) expected = "right to " + format("%.0e", limit) + " (its matrices' rounding)";
        if (direct && !trial.error && !trial.in_unit) expected = "accepted";
        if (direct && trial.direct_limit > 0.0) expected = "right to " + format("%.0e", limit);
        const bool may_say = !direct && (trial.may_say || (trial.feti_may_say && realisation == Realisation::feti));
        if (may_say) expected += ", or says that it is not";
        if (!trial.refused.empty()) expected = "refused: " + trial.refused;
        std::string why;
        if (!trial.refused.empty()) {
            if (m.message.find(trial.refused) == std::string::npos) why = "other words";
        } else if (m.status != "converged") {
            if (!(may_say && m.status == "DELAM_NOT_CONVERGED")) why = "not expected";
        } else {
            const auto check = [&](const char* what, double value, double bound) {
                if (!(value <= bound)) why += (why.empty() ? "" : ", ") + std::string(what);
            };
            check("error", m.error, limit);
            check("kkt", m.kkt, std::max(raised, trial.acceptance_limit));
            check("ledger", m.ledger, std::max(raised, trial.acceptance_limit));
            if (trial.defect_limit > 0.0 && !direct)
                check("defect", std::abs(m.defect - trial.defect), trial.defect_limit);
            check("damage", m.damage, 1.01 * trial.delta + 1e-10);
        }
        study.table().rows.push_back({trial.subject, trial.parameter_name, trial.parameter, name_of(realisation),
                                      direct && trial.in_unit  ? "itself in other units, energy"
                                      : trial.error || !direct ? trial.reference
                                                               : "is the reference",
                                      m.error, limit, m.kkt, m.ledger, m.defect, m.damage, m.active_set, m.krylov,
                                      m.alternations, m.status, expected, why.empty() ? "pass" : "fail: " + why,
                                      m.message});
    }
    for (const auto& [has, who] :
         {std::pair{trial.condensed, "condensed"}, {trial.feti, "FETI"}, {trial.direct, "direct"}}) {
        if (!has && !trial.left_out.empty()) study.leave_out(trial, who, trial.left_out);
    }
}

}  // namespace

std::vector<Result> states_of(const Trial& trial, Realisation realisation) {
    TrialAnalysis m = analyse(trial, realisation);
    if (m.states.size() != trial.times.size()) throw reference::Failure(0, m.message);
    return std::move(m.states);
}

double largest(const std::vector<double>& values) {
    double size = 0.0;
    for (const double v : values) size = std::isnan(v) ? infinite : std::max(size, std::abs(v));
    return size;
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return infinite;
    double miss = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) miss = worse(miss, std::abs(a[i] - b[i]));
    const double size = largest(b);
    return miss == 0.0 ? 0.0 : size > 0.0 ? miss / size : infinite;
}

Study::Study(const Options& options) : options_(options) {
    table_.name = "stability";
    table_.note =
        "Hard cases, each over a range of one parameter, by every realisation. error: against the reference named, "
        "largest relative difference (of displacements, jumps, tractions, reactions, energies) over all steps unless "
        "the subject says otherwise. kkt: worst violation of the primal KKT conditions of all states, from exported "
        "fields. ledger: energies and work recorded less those computed from the fields, over the largest. defect: "
        "what "
        "the balance of energies at the end misses (it falls with the steps where something is damaged). damage: "
        "adhesions less the minimisers at their jumps. direct: the monolithic reference at the adhesions of the "
        "condensed analysis; FETI whose adhesions are others is compared with a direct solution at its own. Where the "
        "error of the direct reference is against itself in other units, that is what rounding of the assembled "
        "matrices leaves, and twenty times as much is allowed. active_set, krylov, alternations: sums over "
        "the steps.";
    table_.columns = {"subject", "parameter",    "value",  "realisation", "reference", "error",
                      "limit",   "kkt",          "ledger", "defect",      "damage",    "active_set",
                      "krylov",  "alternations", "status", "expected",    "verdict",   "message"};
}

bool Study::wanted(const std::string& subject) const {
    if (!options_.subjects.empty() && options_.subjects.count(subject) == 0) return false;
    progress("stability: " + subject);
    return true;
}

std::vector<double> Study::range(std::vector<double> values, std::size_t stride) const {
    if (!options_.quick) return values;
    std::vector<double> thin;
    for (std::size_t i = 0; i < values.size(); i += stride) thin.push_back(values[i]);
    if ((values.size() - 1) % stride != 0) thin.push_back(values.back());
    return thin;
}

void Study::row(const std::string& subject, const std::string& parameter_name, double parameter,
                const std::string& realisation, const std::string& reference, double error, double limit,
                const std::string& status, const std::string& expected, bool good, const std::string& message) {
    table_.rows.push_back({subject, parameter_name, parameter, realisation, reference, error, limit, 0.0, 0.0, 0.0, 0.0,
                           0.0, 0.0, 0.0, status, expected, good ? "pass" : "fail", message});
}

void Study::run(const Trial& trial, const Trial* also) {
    std::vector<std::pair<Realisation, TrialAnalysis>> all;
    if (trial.condensed) all.emplace_back(Realisation::condensed, analyse(trial, Realisation::condensed));
    if (trial.feti) all.emplace_back(Realisation::feti, analyse(trial, Realisation::feti));
    // FETI at its own adhesions if they differ from the condensed ones, so that only the solves are compared.
    std::vector<std::optional<TrialAnalysis>> beside(std::max<std::size_t>(all.size(), 1));
    if (all.empty() && trial.direct) beside[0] = direct_analysis(trial, undamaged(trial));
    for (std::size_t i = 0; i < all.size() && trial.direct; ++i) {
        const bool first = i == 0;
        const auto same = [&] {
            const auto &a = all[0].second.states, &b = all[i].second.states;
            if (a.size() != b.size()) return false;
            for (std::size_t k = 0; k < a.size(); ++k)
                if (a[k].adhesion != b[k].adhesion) return false;
            return true;
        };
        if (first || !same()) beside[i] = direct_analysis(trial, all[i].second.states);
    }
    if (also != nullptr) {
        judge(*this, trial, all, beside);
        judge(*this, *also, std::move(all), std::move(beside));
    } else {
        judge(*this, trial, std::move(all), std::move(beside));
    }
}

void Study::leave_out(const Trial& trial, const std::string& realisation, const std::string& why) {
    table_.rows.push_back({trial.subject, trial.parameter_name, trial.parameter, realisation, trial.reference, unknown,
                           trial.limit, unknown, unknown, unknown, unknown, unknown, unknown, unknown, "left out",
                           "left out", "left out", why});
}

Table stability(const Options& options) {
    Study study(options);
    stability_interface(study);
    stability_bodies(study);
    stability_units(study);
    stability_contact(study);
    stability_analysis(study);
    stability_partition(study);
    if (study.table().rows.empty())
        throw reference::Failure(DELAM_ERROR_ARGUMENT, "no subject '" + *options.subjects.begin() + "'");
    return study.table();
}

}  // namespace harness
