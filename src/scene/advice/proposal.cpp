// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/proposal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

constexpr double stiff_enough = 50.0;  // Turon et al. (2007): less than 2 % of the stiffness is lost
constexpr double flat = 0.99;          // length of the mean of the unit normals of a flat interface

using Normal = std::array<double, 3>;

// The mean normal of a flat interface; 0, 0, 0 for others.
Normal mean_normal(const InterfaceGeometry& interface, std::size_t dimension) {
    Normal mean{};
    double area = 0.0;
    for (std::size_t p = 0; p < interface.weight.size(); ++p) {
        for (std::size_t d = 0; d < dimension; ++d)
            mean[d] += interface.weight[p] * interface.frame[p * dimension * dimension + d];
        area += interface.weight[p];
    }
    const double length = std::hypot(mean[0], mean[1], mean[2]);
    if (!(length > flat * area)) return {};
    for (double& component : mean) component /= length;
    return mean;
}

// Young's modulus along a direction given in material axes (Lekhnitskii, Theory of Elasticity of an Anisotropic Body,
// 1963): the inverse of sum of m_i^4/E_i + sum of m_i^2 m_j^2 (1/G_ij - 2 nu_ij/E_i).
double modulus_along(const Orthotropic& material, const Normal& m) {
    const auto& c = material.constant;
    const double a = m[0] * m[0], b = m[1] * m[1], d = m[2] * m[2];
    using O = Orthotropic;
    return 1.0 / (a * a / c[O::e1] + b * b / c[O::e2] + d * d / c[O::e3] +
                  a * b * (1.0 / c[O::g12] - 2.0 * c[O::nu12] / c[O::e1]) +
                  a * d * (1.0 / c[O::g13] - 2.0 * c[O::nu13] / c[O::e1]) +
                  b * d * (1.0 / c[O::g23] - 2.0 * c[O::nu23] / c[O::e2]));
}

// The largest of the cells of a body.
double modulus_of(const Problem& problem, std::int32_t body, const Normal& normal) {
    const Material& material = *problem.material[index(body)];
    if (const auto* isotropic = std::get_if<Elastic>(&material)) return isotropic->young;
    const auto& orthotropic = std::get<Orthotropic>(material);
    std::set<std::int32_t> orientations;
    if (problem.orientation == nullptr) orientations.insert(-1);
    for (const std::int64_t c : problem.mesh->body_cells(body)) {
        if (problem.orientation == nullptr) break;
        poll_cancel("check");
        orientations.insert(problem.orientation->of_cell[index(c)]);
    }
    double modulus = 0.0;
    for (const std::int32_t o : orientations) {
        Normal m = normal;
        if (o >= 0) {
            const Axes& axes = problem.orientation->axes[index(o)];
            for (std::size_t i = 0; i < 3; ++i)
                m[i] = axes[3 * i] * normal[0] + axes[3 * i + 1] * normal[1] + axes[3 * i + 2] * normal[2];
        }
        modulus = std::max(modulus, modulus_along(orthotropic, m));
    }
    return modulus;
}

// Extent of a body along a direction.
double extent_of(const Mesh& mesh, std::int32_t body, const Normal& normal) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const std::int64_t c : mesh.body_cells(body)) {
        poll_cancel("check");
        for (const std::int64_t n : mesh.cell(c)) {
            double along = 0.0;
            for (std::size_t d = 0; d < index(mesh.dimension()); ++d) along += normal[d] * mesh.node(n)[d];
            least = std::min(least, along);
            most = std::max(most, along);
        }
    }
    return most - least;
}

// The larger E3/t of the two bodies; 0: unknown.
double layer_stiffness(const Problem& problem, std::int64_t interface) {
    const Mesh& mesh = *problem.mesh;
    const InterfaceGeometry& geometry = mesh.interfaces()[index(interface)];
    const Normal normal = mean_normal(geometry, index(mesh.dimension()));
    double stiffness = 0.0;
    if (normal == Normal{}) return stiffness;
    for (const std::int32_t body : elastic_bodies(problem, interface))
        stiffness = std::max(stiffness, modulus_of(problem, body, normal) / extent_of(mesh, body, normal));
    return stiffness;
}

}  // namespace

Proposal proposal(const Problem& problem, std::int64_t interface, double pairs) {
    const InterfaceProperties& properties = problem.interfaces[index(interface)];
    Proposal found;
    if (properties.bonded || !properties.law) return found;
    const double layer = layer_stiffness(problem, interface);
    if (layer > 0.0) {
        found.stiffness = stiff_enough * layer;
        found.share = 1.0 / (1.0 + layer / properties.law->normal_stiffness);
    }
    found.strength = resolved_strengths(problem, interface, pairs * pair_spacing(problem, interface));
    return found;
}

}  // namespace delam
