// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr double noticeable = 0.01;  // of the work, or of the dissipated energy
constexpr double told_apart = 0.02;  // of what is released, by pairs that popped

// Share of the energy below which work is rounding; with a tenth or ten times of it the same analyses have none
// (ctest -R cli_decks).
constexpr double least_work = 1e-9;

}  // namespace

double Balance::relative() const {
    if (defect == 0.0) return 0.0;
    return work > 0.0 ? std::abs(defect) / work : std::numeric_limits<double>::infinity();
}

double Balance::open() const {
    if (defect == 0.0 || !(dissipated > 0.0)) return relative();
    return std::abs(defect) / dissipated;
}

Balance balance_of(const Rows& rows, bool slides) {
    const std::string split = slides ? "_slides" : "";
    const auto stored = [&](const Row& row) {
        return number_of(row, "stored_bulk") + number_of(row, "stored_interface" + split) +
               number_of(row, "load_potential");
    };
    Balance out;
    double released = 0.0;
    for (const Row& row : rows) {
        released += number_of(row, "released");
        const double work = number_of(row, "work");
        out.last_work = work;
        out.stored = stored(row) - stored(rows.front());
        out.dissipated = number_of(row, "dissipated" + split);
        out.released = released;
        out.last_defect = out.stored + out.dissipated + released - work;
        out.work = std::max(out.work, std::abs(work));
        // Negated, so that NaN counts, and stays.
        if (std::isnan(out.defect) || std::abs(out.last_defect) <= std::abs(out.defect)) continue;
        out.defect = out.last_defect;
        out.step = static_cast<std::int64_t>(number_of(row, "step"));
        out.time = number_of(row, "time");
    }
    return out;
}

namespace {

// Energies beside each other have the unit of the work.
auto in_one_unit(const Balance& balance, const Scene& scene) {
    return [&balance, &scene](double energy) { return energy_text(energy, scene, balance.work); };
}

// Returns what is said where there is no work to compare with; empty: there is.
std::string without_work(const Balance& balance, const Scene& scene) {
    const auto energy = in_one_unit(balance, scene);
    if (balance.work == 0.0 && balance.defect == 0.0) return "energy balance: no work was done";
    if (balance.work > least_work * std::abs(balance.defect)) return "";
    return fmt::format(
        "warning: energy balance: no work was done, and stored + dissipated + released is {} in {}: the steps are too "
        "long to follow the load",
        energy(balance.defect), instant_text(balance.step, balance.time));
}

}  // namespace

std::string balance_line(const Balance& balance, const Scene& scene) {
    const auto energy = in_one_unit(balance, scene);
    if (std::string none = without_work(balance, scene); !none.empty()) return none;
    return fmt::format(
        "{}energy balance: off by {} of the work (stored + dissipated + released - work is {} in {}; the "
        "work is up to {})",
        balance.relative() <= noticeable ? "" : "warning: ", percent_text(balance.relative()), energy(balance.defect),
        instant_text(balance.step, balance.time), energy(balance.work));
}

std::string energies_line(const Balance& balance, const JumpSum& jumps, const Scene& scene) {
    const auto energy = in_one_unit(balance, scene);
    if (std::string none = without_work(balance, scene); !none.empty()) return none;
    const std::string count = counted(static_cast<std::int64_t>(jumps.count), "jump");
    std::string released = " " + energy(balance.released);
    if (jumps.count > 0)
        released = jumps.released < (1.0 - told_apart) * balance.released
                       ? fmt::format("{} ({} in {})", released, energy(jumps.released), count)
                       : fmt::format(" in {}{}", count, released);
    return fmt::format(
        "{}energy balance: work {} = stored {} + dissipated {} + released{} + open {}; open is {} of the {} at most "
        "({} in {})",
        balance.open() <= noticeable ? "" : "warning: ", energy(balance.last_work), energy(balance.stored),
        energy(balance.dissipated), released, energy(-balance.last_defect), percent_text(balance.open()),
        balance.dissipated > 0.0 ? "dissipated energy" : "work", energy(-balance.defect),
        instant_text(balance.step, balance.time));
}

}  // namespace cli
