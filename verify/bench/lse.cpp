// SPDX-License-Identifier: BSD-3-Clause
#include "lse.hpp"

#include "clock.hpp"
#include "monolithic.hpp"

namespace bench {

Lse::Lse(const Stage& stage) {
    Monolithic system(stage.scene);
    const auto d = static_cast<std::size_t>(stage.scene.dimension());
    std::vector<double> spring(system.jumps());
    for (std::size_t row = 0; row < spring.size(); ++row) {
        const double k = row % d == 0 ? stage.data.law.normal_stiffness : stage.data.law.tangential_stiffness;
        spring[row] = system.weight()[row / d] * k;
    }
    const std::vector<std::uint8_t> none(spring.size(), 0);
    matrix_ = system.assemble(spring, none);
    system.right_side(std::vector<double>(system.patterns(), 1.0), none, right_);
}

double Lse::measure(bool wide) const {
    std::vector<double> x;
    const Clock clock;
    SparseFactor factor(matrix_, wide);
    factor.factorise();
    factor.solve(right_, x);
    return clock.seconds();
}

Json Lse::choose() {
    std::vector<double> narrow_times;
    std::vector<double> wide_times;
    measure(false);  // the first one warms the caches and the allocator
    for (int i = 0; i < 3; ++i) {
        narrow_times.push_back(measure(false));
        wide_times.push_back(measure(true));
    }
    wide_ = median(wide_times) < median(narrow_times);
    return {{"index_bits", wide_ ? 64 : 32}, {"seconds_32", median(narrow_times)}, {"seconds_64", median(wide_times)}};
}

Json Lse::facts() const {
    std::vector<double> x;
    Clock clock;
    SparseFactor factor(matrix_, wide_);
    const double analyse = clock.lap();
    factor.factorise();
    const double numeric = clock.lap();
    factor.solve(right_, x);
    const double solve = clock.lap();
    return {{"unknowns", unknowns()},
            {"entries_K", matrix_.row.size()},
            {"entries_L", factor.entries()},
            {"ordering", factor.ordering()},
            {"analyse_s", analyse},
            {"factor_s", numeric},
            {"solve_s", solve},
            {"cholmod_peak_MB", 1e-6 * factor.peak_bytes()}};
}

}  // namespace bench
