// SPDX-License-Identifier: BSD-3-Clause
#include "scene/strain_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"

namespace delam {

StrainLoads strain_loads(const Problem& problem, std::int32_t body, std::span<const std::int64_t> cells,
                         std::span<const std::int64_t> nodes) {
    const std::size_t patterns = problem.patterns.size();
    StrainLoads loads{std::vector<std::vector<double>>(patterns), std::vector<double>(patterns * patterns, 0.0)};
    std::vector<std::size_t> pattern;  // of each strain
    std::vector<Strain> strain;
    for (const Eigenstrain& e : problem.eigenstrains) {
        if (e.body != body) continue;
        const auto p = index(e.pattern);
        const auto known = index(std::find(pattern.begin(), pattern.end(), p) - pattern.begin());
        if (known == pattern.size()) {
            pattern.push_back(p);
            strain.emplace_back();
        }
        for (std::size_t i = 0; i < 6; ++i) strain[known][i] += e.strain[i];
    }
    if (strain.empty() || problem.stiffness[index(body)] != nullptr) return loads;
    EigenstrainLoads of_body = eigenstrain_loads(*problem.mesh, cells, nodes, problem.model(body), strain);
    for (std::size_t k = 0; k < pattern.size(); ++k) {
        loads.force[pattern[k]] = std::move(of_body.force[k]);
        for (std::size_t l = 0; l < pattern.size(); ++l)
            loads.energy[pattern[k] * patterns + pattern[l]] = of_body.energy[k * pattern.size() + l];
    }
    return loads;
}

StrainLoads strain_loads(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    const std::size_t patterns = problem.patterns.size(), dim = index(mesh.dimension());
    StrainLoads loads{std::vector<std::vector<double>>(patterns), std::vector<double>(patterns * patterns, 0.0)};
    if (problem.eigenstrains.empty()) return loads;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
        const StrainLoads own = strain_loads(problem, body, mesh.body_cells(body), nodes);
        for (std::size_t i = 0; i < own.energy.size(); ++i) loads.energy[i] += own.energy[i];
        for (std::size_t p = 0; p < patterns; ++p) {
            if (own.force[p].empty()) continue;
            loads.force[p].resize(index(mesh.node_count()) * dim, 0.0);
            for (std::size_t i = 0; i < own.force[p].size(); ++i)
                loads.force[p][index(nodes[i / dim]) * dim + i % dim] += own.force[p][i];
        }
    }
    return loads;
}

StrainSizes strain_sizes(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    const auto dim = index(mesh.dimension());
    std::vector<double> low(dim, std::numeric_limits<double>::infinity()),
        high(dim, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < mesh.nodes().size(); ++i) {
        low[i % dim] = std::min(low[i % dim], mesh.nodes()[i]);
        high[i % dim] = std::max(high[i % dim], mesh.nodes()[i]);
    }
    double extent = 0.0;
    for (std::size_t d = 0; d < dim; ++d) extent = std::max(extent, high[d] - low[d]);
    StrainSizes sizes{std::vector<double>(problem.patterns.size(), 0.0),
                      std::vector<double>(problem.patterns.size(), 0.0)};
    for (const Eigenstrain& e : problem.eigenstrains)
        for (const double component : e.strain) {
            double& size = sizes.displacement[index(e.pattern)];
            size = std::max(size, extent * std::abs(component));
        }
    const StrainLoads loads = strain_loads(problem);
    for (std::size_t p = 0; p < sizes.force.size(); ++p)
        for (const double f : loads.force[p]) sizes.force[p] = std::max(sizes.force[p], std::abs(f));
    return sizes;
}

Strain strain_at(const Problem& problem, std::int32_t body, std::span<const double> factors) {
    Strain strain{};
    for (const Eigenstrain& e : problem.eigenstrains)
        for (std::size_t i = 0; i < 6 && e.body == body; ++i) strain[i] += factors[index(e.pattern)] * e.strain[i];
    return strain;
}

}  // namespace delam
