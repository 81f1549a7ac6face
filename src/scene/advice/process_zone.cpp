// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/process_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
            volume += gauss.weights[q] * jacobian(mesh.cell_type(c), x, gauss.gradients[q]);
    }
    return volume;
}

struct Mode {
    Mixity mixity;
    std::size_t component;  // of the jump
};

// The modes in which a law may differ from itself.
std::vector<Mode> modes_of(const Law& law) {
    std::vector<Mode> modes{{Mixity(0.0), 0}, {Mixity(1.0), 1}};
    if (law.two_shear_toughnesses()) modes.push_back({Mixity(1.0, 1.0), 2});
    return modes;
}

// The largest stiffness in a mode: that of both shears where their onset is one.
double stiffness_of(const Law& law, const Mode& mode) {
    if (mode.component == 0 || law.two_shear_toughnesses()) return law.stiffness(mode.component);
    return std::max(law.stiffness(1), law.stiffness(2));
}

struct Arm {
    double modulus;
    double thickness;
};

std::vector<Arm> arms_of(const Problem& problem, std::int64_t interface) {
    const auto& weight = problem.mesh->interfaces()[index(interface)].weight;
    const double area = std::accumulate(weight.begin(), weight.end(), 0.0);
    std::vector<Arm> arms;
    for (const std::int32_t body : elastic_bodies(problem, interface))
        arms.push_back(
            {plane_modulus(problem.model(body), problem.mesh->dimension()), volume_of(*problem.mesh, body) / area});
    return arms;
}

// The zone in an arm, from the length `thick` = E' Gc/s^2 that it would have in a thick body, and the other way round.
double zone_of(const Mode& mode, double thick, const Arm& arm) {
    const double h = arm.thickness;
    return std::min(thick, mode.component > 0 ? std::sqrt(thick * h) : std::pow(thick, 0.25) * std::pow(h, 0.75));
}
double thick_zone_of(const Mode& mode, double length, const Arm& arm) {
    const double ratio = length / arm.thickness;
    return length * std::max(1.0, mode.component > 0 ? ratio : ratio * ratio * ratio);
}

}  // namespace

double pair_spacing(const Problem& problem, std::int64_t interface) {
    const InterfaceProperties& properties = problem.interfaces[index(interface)];
    const InterfaceGeometry& geometry = problem.mesh->interfaces()[index(interface)];
    double adhering = 0.0, pairs = 0.0;
    for (std::size_t p = 0; p < geometry.weight.size(); ++p) {
        if (!(properties.adhesion[p] > 0.0)) continue;
        adhering += geometry.weight[p];
        pairs += 1.0;
    }
    if (!(pairs > 0.0)) return 0.0;
    return problem.mesh->dimension() == 2 ? adhering / pairs : std::sqrt(adhering / pairs);
}

std::vector<std::int32_t> elastic_bodies(const Problem& problem, std::int64_t interface) {
    const Mesh& mesh = *problem.mesh;
    const InterfaceGeometry& geometry = mesh.interfaces()[index(interface)];
    std::vector<std::int32_t> bodies;
    for (const std::int32_t body : {geometry.body_a, geometry.body_b})
        if (body >= 0 && problem.material[index(body)] && !mesh.host_body(body)) bodies.push_back(body);
    return bodies;
}

double arm_thickness(const Problem& problem, std::int64_t interface) {
    double least = 0.0;
    for (const Arm& arm : arms_of(problem, interface))
        least = least > 0.0 ? std::min(least, arm.thickness) : arm.thickness;
    return least;
}

ProcessZone predicted_process_zone(const Problem& problem, std::int64_t interface) {
    const InterfaceProperties& properties = problem.interfaces[index(interface)];
    ProcessZone zone;
    zone.spacing = pair_spacing(problem, interface);
    if (properties.bonded || !properties.law || !properties.law->softens()) return zone;
    zone.length = std::numeric_limits<double>::infinity();
    for (const Arm& arm : arms_of(problem, interface))
        for (const Mode& mode : modes_of(*properties.law)) {
            const Toughness toughness = properties.law->toughness(mode.mixity);
            const double k = stiffness_of(*properties.law, mode);
            zone.length =
                std::min(zone.length, zone_of(mode, arm.modulus * toughness.total / (2.0 * k * toughness.onset), arm));
        }
    if (std::isinf(zone.length)) zone.length = 0.0;
    return zone;
}

std::array<double, 2> resolved_strengths(const Problem& problem, std::int64_t interface, double length) {
    const InterfaceProperties& properties = problem.interfaces[index(interface)];
    std::array<double, 2> strength{};
    if (properties.bonded || !properties.law || !properties.law->softens() || !(length > 0.0)) return strength;
    for (const Arm& arm : arms_of(problem, interface))
        for (const Mode& mode : modes_of(*properties.law)) {
            const double toughness = properties.law->toughness(mode.mixity).total;
            const double largest = std::sqrt(arm.modulus * toughness / thick_zone_of(mode, length, arm));
            double& found = strength[std::min<std::size_t>(mode.component, 1)];
            found = found > 0.0 ? std::min(found, largest) : largest;
        }
    return strength;
}

}  // namespace delam
