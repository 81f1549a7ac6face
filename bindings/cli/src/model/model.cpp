// SPDX-License-Identifier: BSD-3-Clause
#include "model/model.hpp"

#include <utility>

#include "model/call.hpp"

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

}  // namespace cli
