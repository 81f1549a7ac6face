// SPDX-License-Identifier: BSD-3-Clause
#include "baseline.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "clock.hpp"

namespace bench {
namespace {

// As in the library: violations below this fraction of the largest jump or force are rounding.
constexpr double contact_noise = 1e-11;
// A driving energy below this fraction of the largest one, or of the onset, does not determine the mixity.
constexpr double energy_noise = 1e-20;

double largest(const std::vector<double>& values) {
    double m = 0.0;
    for (const double v : values) m = std::max(m, std::abs(v));
    return m;
}

reference::Law make_law(const reference::Scene& scene, const reference::LawData& data) {
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
    reference::Law law(raw);
    const auto set = [&](const char* key, double value) { scene.require(delam_law_set(raw, key, value), key); };
    set("normal_stiffness", data.normal_stiffness);
    set("tangential_stiffness", data.tangential_stiffness);
    set("normal_onset", data.normal_onset);
    set("tangential_onset", data.tangential_onset);
    set("normal_toughness", data.normal_toughness);
    set("tangential_toughness", data.tangential_toughness);
    for (const char* key : {"onset_exponent_1", "onset_exponent_2", "toughness_exponent_1", "toughness_exponent_2"})
        set(key, data.exponent);
    return law;
}

std::vector<double> factors(const reference::Scene& scene, std::size_t patterns, double time) {
    std::vector<double> theta(patterns);
    REQUIRE(scene, delam_problem_factors, scene.problem(), time, static_cast<std::int64_t>(patterns), theta.data());
    return theta;
}

}  // namespace

Baseline::Baseline(const reference::Scene& scene, const reference::LawData& law, std::vector<double> adhesion,
                   const BaselineOptions& options)
    : scene_(&scene),
      data_(law),
      law_(make_law(scene, law)),
      options_(options),
      dimension_(static_cast<std::size_t>(scene.dimension())),
      system_(scene),
      factor_(system_.matrix(), options.wide),
      adhesion_(std::move(adhesion)),
      mixity_(adhesion_.size(), 0.0),
      jump_(system_.jumps(), 0.0),
      force_(system_.jumps(), 0.0) {
    for (const double zeta : adhesion_) closed_.push_back(zeta == 0.0 ? 1 : 0);  // a notch starts closed
    StepRecord record;
    displace(factors(*scene_, system_.patterns(), 0.0), record, {});
    update_mixity();
}

double Baseline::driving(std::size_t pair, std::size_t component) const {
    if (component == 0) {
        const double opening = std::max(0.0, jump_[pair * dimension_]);
        return 0.5 * data_.normal_stiffness * opening * opening;
    }
    double slip = 0.0;
    for (std::size_t c = 1; c < dimension_; ++c) slip += jump_[pair * dimension_ + c] * jump_[pair * dimension_ + c];
    return 0.5 * data_.tangential_stiffness * slip;
}

// B = Y_t/Y where there is a jump; the first non-zero jump makes the state a loaded one.
void Baseline::update_mixity() {
    const double onset = std::min(data_.normal_onset, data_.tangential_onset);
    double most = 0.0;
    for (std::size_t p = 0; p < adhesion_.size(); ++p) most = std::max(most, driving(p, 0) + driving(p, 1));
    if (most > energy_noise * onset) loaded_ = true;
    for (std::size_t p = 0; p < adhesion_.size(); ++p) {
        const double total = driving(p, 0) + driving(p, 1);
        if (total > energy_noise * std::max(most, onset)) mixity_[p] = std::min(1.0, driving(p, 1) / total);
    }
}

// The factorisation is repeated if the matrix has changed: the first system of a step is the last one of the step
// before.
void Baseline::solve_linear(const std::vector<double>& theta) {
    Clock clock;
    const std::size_t pairs = adhesion_.size();
    spring_.resize(pairs * dimension_);
    held_.resize(pairs * dimension_);
    for (std::size_t p = 0; p < pairs; ++p) {
        for (std::size_t c = 0; c < dimension_; ++c) {
            const std::size_t row = p * dimension_ + c;
            spring_[row] =
                system_.weight()[p] * adhesion_[p] * (c == 0 ? data_.normal_stiffness : data_.tangential_stiffness);
            held_[row] = c == 0 ? closed_[p] : std::uint8_t{0};
        }
    }
    double factoring = 0.0;
    if (spring_ != factored_spring_ || held_ != factored_held_) {
        system_.assemble(spring_, held_);
        Clock inner;
        factor_.factorise();
        factoring = inner.seconds();
        factor_seconds_.push_back(factoring);
        factored_spring_ = spring_;
        factored_held_ = held_;
    }
    system_.right_side(theta, held_, b_);
    factor_.solve(b_, v_);
    for (std::size_t row = 0; row < jump_.size(); ++row) {
        jump_[row] = held_[row] != 0 ? 0.0 : system_.jump(row, v_);
        force_[row] = held_[row] != 0 ? system_.held_force(row, v_, theta) : spring_[row] * jump_[row];
    }
    solve_seconds_.push_back(clock.seconds() - factoring);
}

bool Baseline::displace(const std::vector<double>& theta, StepRecord& record, const std::function<bool()>& stop) {
    ++record.displacement_solves;
    std::set<std::vector<std::uint8_t>> seen;
    bool one_at_a_time = false;
    for (std::int64_t solves = 1;; ++solves) {
        if (stop && stop()) throw Stopped{};
        solve_linear(theta);
        ++record.contact_iterations;
        const double jump_scale = contact_noise * largest(jump_);
        const double force_scale = contact_noise * largest(force_);
        std::vector<std::size_t> wrong;
        for (std::size_t p = 0; p < closed_.size(); ++p) {
            const std::size_t row = p * dimension_;
            if (closed_[p] != 0 ? force_[row] > force_scale : jump_[row] < -jump_scale) wrong.push_back(p);
        }
        if (wrong.empty()) return true;
        if (solves >= options_.contact_limit) return false;
        if (!seen.insert(closed_).second) one_at_a_time = true;
        for (const std::size_t p : wrong) {
            closed_[p] ^= 1;
            if (one_at_a_time) break;
        }
    }
}

void Baseline::damage_step(const std::vector<double>& old, std::vector<double>& next) const {
    std::vector<double> jump = jump_;
    for (std::size_t p = 0; p < old.size(); ++p) jump[p * dimension_] = std::max(0.0, jump[p * dimension_]);
    next.resize(old.size());
    REQUIRE(*scene_, delam_law_respond, law_.get(), static_cast<std::int32_t>(dimension_),
            static_cast<std::int64_t>(old.size()), jump.data(), mixity_.data(), old.data(), next.data(), nullptr);
}

// Largest change of a pair's traction relative to its peak traction, |next - zeta| max(1, sqrt(Y/Go)).
double Baseline::traction_change(const std::vector<double>& next) const {
    std::vector<double> onset(next.size());
    std::vector<double> total(next.size());
    REQUIRE(*scene_, delam_law_toughness, law_.get(), static_cast<std::int64_t>(next.size()), mixity_.data(),
            onset.data(), total.data());
    double change = 0.0;
    for (std::size_t p = 0; p < next.size(); ++p) {
        const double energy = driving(p, 0) + driving(p, 1);
        change = std::max(change, std::abs(next[p] - adhesion_[p]) * std::sqrt(std::max(1.0, energy / onset[p])));
    }
    return change;
}

double Baseline::stored_interface() const {
    double sum = 0.0;
    for (std::size_t p = 0; p < adhesion_.size(); ++p)
        sum += system_.weight()[p] * adhesion_[p] * (driving(p, 0) + driving(p, 1));
    return sum;
}

// At a solution u^T K u = theta . r + 2 f . u - sum of (force of a pair * jump). This has far less rounding than the
// product itself, whose terms are the energies of single nodes moved alone.
double Baseline::stored_bulk(const std::vector<double>& theta) const {
    double twice = 2.0 * system_.work_of_dead_loads(v_, theta);
    const auto conjugate = system_.conjugate(v_, theta);
    for (std::size_t p = 0; p < theta.size(); ++p) twice += theta[p] * conjugate[p];
    for (std::size_t row = 0; row < jump_.size(); ++row) twice -= force_[row] * jump_[row];
    return 0.5 * twice;
}

// sum w (g(zeta) - g(zeta_old)),  g = Gc Go (1-zeta) / (Go + (Gc-Go) zeta)
double Baseline::dissipation(const std::vector<double>& old) const {
    std::vector<double> onset(old.size());
    std::vector<double> total(old.size());
    REQUIRE(*scene_, delam_law_toughness, law_.get(), static_cast<std::int64_t>(old.size()), mixity_.data(),
            onset.data(), total.data());
    double sum = 0.0;
    for (std::size_t p = 0; p < old.size(); ++p) {
        if (adhesion_[p] == old[p]) continue;
        const auto g = [&](double zeta) {
            return total[p] * onset[p] * (1.0 - zeta) / (onset[p] + (total[p] - onset[p]) * zeta);
        };
        sum += system_.weight()[p] * (g(adhesion_[p]) - g(old[p]));
    }
    return sum;
}

std::optional<StepRecord> Baseline::advance(double time, const std::function<bool()>& stop) {
    const auto theta = factors(*scene_, system_.patterns(), time);
    const std::vector<double> old = adhesion_;
    StepRecord record;
    record.time = time;
    record.load = theta.at(0);
    bool converged = true;
    try {
        // Before the first load there is no jump that gives a mixity; the elastic solution of this step gives it.
        if (!loaded_) converged = displace(theta, record, stop);
        update_mixity();
        std::vector<double> next;
        while (true) {
            converged = displace(theta, record, stop) && converged;
            damage_step(old, next);
            const double change = traction_change(next);
            record.damage_change = change;
            ++record.am_iterations;
            if (change <= options_.delta) break;
            adhesion_ = next;
            if (record.am_iterations < options_.minimisation_limit) continue;
            displace(theta, record, stop);
            converged = false;
            break;
        }
    } catch (const Stopped&) {
        return std::nullopt;
    }
    dissipated_ += dissipation(old);
    record.dissipated = dissipated_;
    record.reaction = system_.conjugate(v_, theta).at(0);
    record.stored_bulk = stored_bulk(theta);
    record.stored_interface = stored_interface();
    record.status = converged ? DELAM_OK : DELAM_NOT_CONVERGED;
    return record;
}

}  // namespace bench
