// SPDX-License-Identifier: BSD-3-Clause
#include "model/library/model.hpp"

#include <algorithm>
#include <utility>

#include "model/library/call.hpp"

namespace cli {

Context new_context() {
    delam_context* handle = nullptr;
    if (delam_context_create(&handle) != DELAM_OK) throw Failure(exit_numerical, "out of memory");
    return Context(handle);
}

void note_constraints(Model& model, const Place& place) {
    std::int64_t rows = 0;
    call(model.context.get(),
         delam_problem_constraints(model.problem.get(), &rows, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr),
         place);
    model.constraint_places.resize(static_cast<std::size_t>(rows), place);
}

void push_interface(Model& model, const Scene& scene, InterfaceData data, std::size_t a, std::size_t b) {
    data.lower = a;
    data.upper = b;
    data.name = scene.layers[a].name + "-" + scene.layers[b].name;
    model.interfaces.push_back(std::move(data));
}

std::size_t pattern_count(const Model& model) {
    std::int64_t count = 0;
    call(model.context.get(), delam_problem_pattern_count(model.problem.get(), &count), std::string("patterns"));
    return static_cast<std::size_t>(count);
}

PairNodes nodes_of_pairs(const Model& model, std::int64_t interface, const std::string& what) {
    const delam_context* context = model.context.get();
    const delam_mesh* mesh = model.mesh.get();
    std::int64_t pairs = 0, nodes = 0, count = 0, entries = 0;
    call(context, delam_mesh_interface_size(mesh, interface, nullptr, nullptr, &pairs, nullptr, nullptr), what);
    call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), what);
    call(context, delam_mesh_node_ties(mesh, &count, &entries, nullptr, nullptr, nullptr, nullptr), what);
    PairNodes found{std::vector<std::int64_t>(static_cast<std::size_t>(pairs)), {}};
    found.b.resize(found.a.size());
    call(context, delam_mesh_interface_pairs(mesh, interface, found.a.data(), found.b.data(), nullptr, nullptr), what);
    if (count == 0) return found;
    std::vector<std::int64_t> origin(static_cast<std::size_t>(nodes)), tied(static_cast<std::size_t>(count)),
        start(tied.size() + 1), of(static_cast<std::size_t>(entries));
    call(context, delam_mesh_node_origins(mesh, nodes, origin.data()), what);
    call(context, delam_mesh_node_ties(mesh, nullptr, nullptr, tied.data(), start.data(), of.data(), nullptr), what);
    for (std::vector<std::int64_t>* side : {&found.a, &found.b})
        for (std::int64_t& node : *side) {
            const std::int64_t own = origin[static_cast<std::size_t>(node)];
            const auto at = std::lower_bound(tied.begin(), tied.end(), node);
            if (own == node || at == tied.end() || *at != node) continue;
            const auto first = of.begin() + start[static_cast<std::size_t>(at - tied.begin())],
                       last = of.begin() + start[static_cast<std::size_t>(at - tied.begin()) + 1];
            const auto same = std::find_if(
                first, last, [&](std::int64_t carrier) { return origin[static_cast<std::size_t>(carrier)] == own; });
            node = same == last ? own : *same;
        }
    return found;
}

}  // namespace cli
