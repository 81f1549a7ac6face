// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/scene_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "mesh/face_gaps.hpp"
#include "mesh/pairing/seams.hpp"
#include "mesh/points.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

constexpr double brittle = 0.5;  // onset over toughness: softening then ends at twice the jump at which it begins

// Warnings, each with the interfaces that it is of.
using Warnings = std::vector<std::pair<std::string, std::vector<std::int64_t>>>;

void add(Warnings& warnings, std::int64_t interface, const std::string& warning) {
    for (auto& [known, interfaces] : warnings)
        if (known == warning) {
            interfaces.push_back(interface);
            return;
        }
    warnings.push_back({warning, {interface}});
}

// Predictions are good to a factor, not to more digits.
std::string about(double value) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(3) << value;
    return out.str();
}

void judge_zone(const Problem& problem, std::int64_t i, Warnings& warnings) {
    if (problem.options.solution == "energetic") return;
    const ProcessZone zone = predicted_process_zone(problem, i);
    if (!(zone.length > 0.0) || zone.length >= resolving_pairs * zone.spacing) return;
    add(warnings, i,
        text("the process zone, about ", about(zone.length), ", is shorter than ", resolving_pairs,
             " pairs of spacing ", about(zone.spacing),
             ": loads and crack lengths of a local solution then depend on the mesh; a spacing of ",
             about(zone.length / resolving_pairs),
             " would do, or a lower strength (delam_problem_propose), or solution = energetic"));
}

// A law that does not soften debonds a pair when its spring holds the toughness: with the spring of a stiff interface,
// that is far behind the load at which the crack could grow.
void judge_spring(const Problem& problem, std::int64_t i, Warnings& warnings) {
    if (problem.options.solution == "energetic") return;
    add(warnings, i,
        "the law does not soften: in a local solution a crack waits until the spring of a pair holds the toughness, so "
        "that loads depend on the mesh and on the stiffness, and are too high; use a law with strengths, or solution = "
        "energetic");
}

bool adheres(const InterfaceProperties& properties) {
    return std::any_of(properties.adhesion.begin(), properties.adhesion.end(), [](double zeta) { return zeta > 0.0; });
}

void judge_law(const Problem& problem, std::int64_t i, Warnings& warnings) {
    const Law& law = *problem.interfaces[index(i)].law;
    const double thickness = arm_thickness(problem, i);
    for (const auto& [mode, mixity, component] :
         {std::tuple{"normal", Mixity(0.0), std::size_t{0}}, std::tuple{"tangential", Mixity(1.0), std::size_t{1}},
          std::tuple{"second tangential", Mixity(1.0, 1.0), std::size_t{2}}}) {
        if (component == 2 && !law.two_shear_toughnesses()) continue;
        const Toughness toughness = law.toughness(mixity);
        const double k = law.stiffness(component);
        if (!(toughness.onset > 0.0)) continue;
        const double share = toughness.onset / toughness.total;
        if (share > brittle) {
            add(warnings, i,
                text("the ", mode, " onset is ", about(share),
                     " of the toughness, so that the law hardly softens, and loads depend on the stiffness and on the "
                     "mesh: give more stiffness or less strength"));
            continue;
        }
        const double last = 2.0 * toughness.total / std::sqrt(2.0 * k * toughness.onset);
        if (thickness > 0.0 && last > thickness)
            add(warnings, i,
                text("it debonds at a ", mode, " jump of about 2 G/s = ", about(last),
                     ", but a body beside it is only ", about(thickness),
                     " thick: do toughness, strength and lengths have units that fit together?"));
    }
}

// Faces with a law, or in contact, that overlap although nothing says so (delam_problem_set_gaps): bodies that stand in
// the wrong place, or a cohesive element with its sides exchanged.
void judge_overlap(const Problem& problem, std::int64_t i, Warnings& warnings) {
    const InterfaceGeometry& faces = problem.mesh->interfaces()[index(i)];
    if (faces.body_a < 0 || !problem.interfaces[index(i)].gap.empty()) return;
    // Distances cost little, but do not know rounding and facets of curved faces, which cost more.
    const std::vector<double> distances = pair_distances(*problem.mesh, faces);
    if (std::none_of(distances.begin(), distances.end(), [](double n) { return n < 0.0; })) return;
    const std::vector<double> gaps = face_gaps(*problem.mesh, faces);
    const auto least = std::min_element(gaps.begin(), gaps.end());
    if (least == gaps.end() || *least >= 0.0) return;
    add(warnings, i,
        text("its faces overlap by up to ", about(-*least), " at ",
             place(*problem.mesh, faces.node_b[index(least - gaps.begin())]),
             ", and touch from the start all the same: do the bodies stand where they should? "
             "(delam_problem_set_gaps makes distances count)"));
}

void warn_of_seams(const Mesh& mesh, const Monitor& monitor) {
    for (const Seam& seam : find_seams(mesh)) {
        const bool within = seam.body == seam.other;
        monitor.log(1, text(within ? "body " : "bodies ", mesh.body_label(seam.body),
                            within ? std::string() : text(" and ", mesh.body_label(seam.other)), ": ", seam.faces,
                            " outer faces between ", place(mesh.dimension(), seam.box.low), " and ",
                            place(mesh.dimension(), seam.box.high),
                            " lie on each other without an interface: they open freely and pass through each other "
                            "where they are pressed"));
    }
}

}  // namespace

void warn_of_scene(const Problem& problem, const Monitor& monitor) {
    warn_of_seams(*problem.mesh, monitor);
    Warnings warnings;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(problem.interfaces.size()); ++i) {
        const InterfaceProperties& properties = problem.interfaces[index(i)];
        if (!properties.bonded) judge_overlap(problem, i, warnings);
        if (properties.bonded || !properties.law) continue;
        if (!adheres(properties)) {
            add(warnings, i, "no pair adheres at the start, so that contact alone acts");
            continue;
        }
        if (!properties.law->softens()) {
            judge_spring(problem, i, warnings);
            continue;
        }
        judge_zone(problem, i, warnings);
        judge_law(problem, i, warnings);
    }
    for (const auto& [warning, interfaces] : warnings) {
        std::string of = interfaces.size() > 1 ? "interfaces " : "interface ";
        for (std::size_t k = 0; k < interfaces.size(); ++k)
            of += (k == 0 ? "" : k + 1 == interfaces.size() ? " and " : ", ") + std::to_string(interfaces[k]);
        monitor.log(1, text(of, ": ", warning));
    }
}

}  // namespace delam
