// SPDX-License-Identifier: BSD-3-Clause
// FNV-1a, 64 bits (Fowler, Noll, Vo), over the scene. Every list is hashed with its length, so that entries cannot move
// from one list to the next unnoticed.
#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "law/law_parameters.hpp"
#include "scene/problem.hpp"

namespace delam {
namespace {

class Fnv {
public:
    std::uint64_t value = checksum_start;

    void add(std::uint64_t word) { value = checksum(word, value); }
    void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
    void add(std::int32_t number) { add(static_cast<std::int64_t>(number)); }
    void add(bool flag) { add(static_cast<std::int64_t>(flag)); }
    // Negative zero is the same scene as zero.
    void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number)); }
    void add(const std::string& words) {
        add(static_cast<std::int64_t>(words.size()));
        for (const char letter : words) add(static_cast<std::int64_t>(static_cast<unsigned char>(letter)));
    }
    template <class T>
    void add_all(std::span<const T> list) {
        add(static_cast<std::int64_t>(list.size()));
        for (const T& item : list) add(item);
    }
    template <class T, class Memory>
    void add_all(const std::vector<T, Memory>& list) {
        add_all(std::span<const T>(list));
    }
};

void add_mesh(Fnv& fnv, const Mesh& mesh) {
    fnv.add(static_cast<std::int64_t>(mesh.dimension()));
    fnv.add_all(mesh.nodes());
    fnv.add(mesh.cell_count());
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("check");
        fnv.add(static_cast<std::int32_t>(mesh.cell_type(c)));
        fnv.add(mesh.body_label(mesh.cell_body(c)));
        fnv.add_all(mesh.cell(c));
    }
    fnv.add(static_cast<std::int64_t>(mesh.interfaces().size()));
    for (const InterfaceGeometry& face : mesh.interfaces()) {
        fnv.add(face.body_a);
        fnv.add(face.body_b);
        fnv.add_all(face.node_a);
        fnv.add_all(face.node_b);
        fnv.add_all(face.weight);
        fnv.add_all(face.frame);
    }
    fnv.add(static_cast<std::int64_t>(mesh.ties().size()));
    for (const NodeTie& tie : mesh.ties()) {
        fnv.add(tie.node);
        fnv.add(static_cast<std::int64_t>(tie.of.size()));
        for (const auto& [node, weight] : tie.of) {
            fnv.add(node);
            fnv.add(weight);
        }
    }
}

void add_material(Fnv& fnv, const std::optional<Material>& material) {
    fnv.add(material ? static_cast<std::int64_t>(material->index()) + 1 : std::int64_t{0});
    if (!material) return;
    if (const auto* isotropic = std::get_if<Elastic>(&*material)) {
        fnv.add(isotropic->young);
        fnv.add(isotropic->poisson);
    } else {
        for (const double constant : std::get<Orthotropic>(*material).constant) fnv.add(constant);
    }
}

void add_orientation(Fnv& fnv, const Orientation& orientation) {
    fnv.add_all(orientation.of_cell);
    for (const Axes& axes : orientation.axes) fnv.add_all(std::span<const double>(axes));
}

// Scenes without it hash as they did before there was such a thing.
void add_stiffness(Fnv& fnv, const Problem& problem) {
    for (std::int32_t body = 0; body < problem.mesh->body_count(); ++body) {
        const auto& own = problem.stiffness[index(body)];
        if (own == nullptr) continue;
        fnv.add(problem.mesh->body_label(body));
        fnv.add_all(problem.mesh->body_nodes(body));
        fnv.add_all(own->matrix.start);
        fnv.add_all(own->matrix.column);
        fnv.add_all(own->matrix.value);
        for (const HostPiece& piece : own->pieces) fnv.add(piece.free.columns);
    }
}

// Every number that laws have in common, once and in the order of the table, also where this kind ignores it.
void add_law(Fnv& fnv, const Law& law) {
    std::vector<double Law::*> added;
    const auto add = [&](double Law::*member) {
        if (member == nullptr || std::find(added.begin(), added.end(), member) != added.end()) return;
        added.push_back(member);
        fnv.add(law.*member);
    };
    for (const LawParameter& parameter : law_parameters()) {
        // An onset and a strength exclude each other, and the hash takes the given one; laws by onsets keep their old
        // hashes.
        const bool strength = parameter.instead_of != nullptr && *parameter.initial != '\0';
        const bool other = parameter.instead_of != nullptr && law.*parameter.instead_of > 0.0;
        if ((strength || other) && !(law.*parameter.value > 0.0)) continue;
        // A number that is not given, or equal to the one that takes its place, makes the same law.
        const double own = parameter.like != nullptr ? law.*parameter.value : 0.0;
        if (parameter.like != nullptr && (own == 0.0 || own == law.*parameter.like)) continue;
        if (strength || parameter.like != nullptr) fnv.add(std::string(parameter.key));
        add(parameter.value);
        add(parameter.second);
    }
    fnv.add(std::string(name_of(law.criterion)));
    if (law.criterion_of_onset() != law.criterion) fnv.add(std::string(name_of(law.criterion_of_onset())));
    fnv.add(std::string(law.kind().name));
    law.hash_shape([&](const auto& held) { fnv.add(held); });
}

void add_gap(Fnv& fnv, const InterfaceProperties& interface) {
    if (interface.gap.empty()) return;
    fnv.add(interface.gap_pattern);
    fnv.add_all(interface.gap);
}

void add_bodies(Fnv& fnv, const Problem& problem) {
    add_mesh(fnv, *problem.mesh);
    fnv.add(static_cast<std::int64_t>(problem.plane));
    for (const std::optional<Material>& material : problem.material) add_material(fnv, material);
    if (problem.orientation != nullptr) add_orientation(fnv, *problem.orientation);
    for (const Formulation formulation : problem.formulation) fnv.add(static_cast<std::int64_t>(formulation));
    add_stiffness(fnv, problem);
}

void add_patterns(Fnv& fnv, const Problem& problem) {
    fnv.add(static_cast<std::int64_t>(problem.patterns.size()));
    for (const Pattern& pattern : problem.patterns) {
        fnv.add(pattern.name);
        fnv.add_all(pattern.times);
        fnv.add_all(pattern.values);
        fnv.add(static_cast<std::int64_t>(pattern.drives));
    }
}

void add_loads(Fnv& fnv, const Problem& problem) {
    fnv.add(static_cast<std::int64_t>(problem.constraints.size()));
    for (const Constraint& constraint : problem.constraints) {
        poll_cancel("check", 1 + static_cast<std::int64_t>(constraint.dof.size()) / 8);
        fnv.add_all(constraint.dof);
        fnv.add_all(constraint.coefficient);
        fnv.add_all(constraint.prescribed);
        // Scenes without them hash as they did before there were such.
        for (const auto& [word, change] : {std::pair("begin", constraint.begin), std::pair("end", constraint.end)}) {
            if (!change) continue;
            fnv.add(std::string(word));
            fnv.add(change->time);
            fnv.add(change->pattern);
        }
    }
    fnv.add(static_cast<std::int64_t>(problem.forces.size()));
    for (const NodalForce& force : problem.forces) {
        fnv.add(force.pattern);
        fnv.add(force.dof);
        fnv.add(force.value);
    }
    for (const Eigenstrain& eigenstrain : problem.eigenstrains) {
        fnv.add(eigenstrain.pattern);
        fnv.add(eigenstrain.body);
        fnv.add_all(std::span<const double>(eigenstrain.strain));
    }
}

}  // namespace

// Settings that came later hash like what was there: following the load like `fixed`, rotations that may become large
// like small ones. A state of one may go on under the other.
std::uint64_t hash(const Options& given, std::uint64_t seed, std::span<const Option> table) {
    Fnv fnv{seed};
    Options initial;
    Options options = given;
    if (options.step_control == "auto" || options.step_control == "load") options.step_control = "fixed";
    if (options.kinematics == "auto") options.kinematics = "linear";
    initial.kinematics = "linear";  // its first default
    for (const Option& row : table) {
        if (row.hashed == Hashed::never) continue;
        std::visit(
            [&](const auto member) {
                if (row.hashed == Hashed::where_set) {
                    if (options.*member == initial.*member) return;
                    fnv.add(std::string(row.key));
                }
                fnv.add(options.*member);
            },
            row.member);
    }
    return fnv.value;
}

std::uint64_t hash(const Law& law) {
    Fnv fnv;
    add_law(fnv, law);
    return fnv.value;
}

std::uint64_t hash(const Problem& problem) {
    Fnv fnv;
    add_bodies(fnv, problem);
    for (const InterfaceProperties& interface : problem.interfaces) {
        fnv.add(interface.bonded);
        fnv.add(interface.contact);
        fnv.add(interface.law.has_value());
        if (interface.law) add_law(fnv, *interface.law);
        fnv.add_all(interface.adhesion);
        add_gap(fnv, interface);
    }
    add_patterns(fnv, problem);
    add_loads(fnv, problem);
    return hash(problem.options, fnv.value);
}

std::uint64_t hash_of_bodies(const Problem& problem) {
    Fnv fnv;
    add_bodies(fnv, problem);
    for (const InterfaceProperties& interface : problem.interfaces) {
        fnv.add(interface.bonded);
        add_gap(fnv, interface);
    }
    fnv.add(static_cast<std::int64_t>(problem.patterns.size()));
    for (const Pattern& pattern : problem.patterns) fnv.add(static_cast<std::int64_t>(pattern.drives));
    add_loads(fnv, problem);
    return fnv.value;
}

}  // namespace delam
