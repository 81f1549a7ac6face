// SPDX-License-Identifier: BSD-3-Clause
#include "scene/process_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cancel_scope.hpp"
#include "mesh/faces.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

double plane_modulus(const BodyModel& model, int dimension) {
    if (const auto* isotropic = std::get_if<Elastic>(&model.material)) {
        const bool stress = dimension == 2 && model.plane == Plane::stress;
        return stress ? isotropic->young : isotropic->young / (1.0 - isotropic->poisson * isotropic->poisson);
    }
    const auto& c = std::get<Orthotropic>(model.material).constant;
    return std::min({c[Orthotropic::e1], c[Orthotropic::e2], c[Orthotropic::e3]});
}

double volume_of(const Mesh& mesh, std::int32_t body) {
    double volume = 0.0;
    std::vector<double> x;
    for (const std::int64_t c : mesh.body_cells(body)) {
        poll_cancel("check");
        x.clear();
        for (const std::int64_t n : mesh.cell(c)) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
        const Quadrature& gauss = quadrature(mesh.cell_type(c));
        for (std::size_t q = 0; q < gauss.points.size(); ++q)
            volume += gauss.weights[q] * physical_gradient(mesh.cell_type(c), x, gauss.points[q]).jacobian;
    }
    return volume;
}

}  // namespace

ProcessZone predicted_process_zone(const Problem& problem, std::int64_t interface) {
    const Mesh& mesh = *problem.mesh;
    const InterfaceProperties& properties = problem.interfaces[index(interface)];
    const InterfaceGeometry& geometry = mesh.interfaces()[index(interface)];
    ProcessZone zone;
    double area = 0.0, adhering = 0.0, pairs = 0.0;
    for (std::size_t p = 0; p < geometry.weight.size(); ++p) {
        area += geometry.weight[p];
        if (!(properties.adhesion[p] > 0.0)) continue;
        adhering += geometry.weight[p];
        pairs += 1.0;
    }
    if (pairs > 0.0) zone.spacing = mesh.dimension() == 2 ? adhering / pairs : std::sqrt(adhering / pairs);
    if (properties.bonded || !properties.law || !properties.law->softens()) return zone;

    zone.length = std::numeric_limits<double>::infinity();
    for (const std::int32_t body : {geometry.body_a, geometry.body_b}) {
        if (body < 0 || !problem.material[index(body)] || mesh.host_body(body)) continue;
        const double modulus = plane_modulus(problem.model(body), mesh.dimension()), arm = volume_of(mesh, body) / area;
        for (const double mixity : {0.0, 1.0}) {
            const Toughness toughness = properties.law->toughness(mixity);
            const double k = mixity > 0.0 ? properties.law->tangential_stiffness : properties.law->normal_stiffness;
            const double thick = modulus * toughness.total / (2.0 * k * toughness.onset);
            const double slender = mixity > 0.0 ? std::sqrt(thick * arm) : std::pow(thick, 0.25) * std::pow(arm, 0.75);
            zone.length = std::min({zone.length, thick, slender});
        }
    }
    if (std::isinf(zone.length)) zone.length = 0.0;
    return zone;
}

}  // namespace delam
