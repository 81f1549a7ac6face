// SPDX-License-Identifier: BSD-3-Clause
#include "body/turned/turned_strains.hpp"

#include <cstddef>

namespace delam {

void TurnedStrains::subtract(std::span<const double> theta, Pulls& pulls) const {
    for (std::size_t p = 0; p < pulls_.size(); ++p)
        for (std::size_t c = 0; c < pulls_[p].size(); ++c)
            for (std::size_t n = 0; n < pulls_[p][c].size(); ++n)
                for (std::size_t k = 0; k < 3; ++k) pulls[c][n][k] -= theta[p] * pulls_[p][c][n][k];
}

std::vector<std::vector<double>> TurnedStrains::forces(const TurnedBodies& bodies) const {
    std::vector<std::vector<double>> forces;
    for (const Pulls& pulls : pulls_) forces.push_back(pulls.empty() ? std::vector<double>{} : bodies.force_of(pulls));
    return forces;
}

double TurnedStrains::energy(std::span<const double> theta, const TurnedBodies& bodies) const {
    const std::size_t patterns = pulls_.size();
    double sum = 0.0;
    for (std::size_t p = 0; p < patterns; ++p) {
        if (pulls_[p].empty()) continue;
        sum -= theta[p] * bodies.work(pulls_[p]);
        for (std::size_t q = 0; q < patterns; ++q) sum += 0.5 * theta[p] * energy_[p * patterns + q] * theta[q];
    }
    return sum;
}

void TurnedStrains::set_conjugate(std::span<const double> theta, const TurnedBodies& bodies,
                                  std::span<double> conjugate) const {
    const std::size_t patterns = pulls_.size();
    for (std::size_t p = 0; p < patterns; ++p) {
        if (pulls_[p].empty()) continue;
        conjugate[p] = -bodies.work(pulls_[p]);
        for (std::size_t q = 0; q < patterns; ++q) conjugate[p] += energy_[p * patterns + q] * theta[q];
    }
}

void TurnedStrains::add_energy(std::span<double> tangent) const {
    for (std::size_t i = 0; i < tangent.size(); ++i) tangent[i] += energy_[i];
}

}  // namespace delam
