// SPDX-License-Identifier: BSD-3-Clause
// Functions outside the promise (experimental.h).
#include "delam/experimental.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "capi/handles.hpp"
#include "scene/engine.hpp"
#include "scene/part.hpp"

using namespace delam;

int32_t delam_experimental_problem_set_engine(delam_problem* problem, const delam_experimental_engine* engine) {
    return guard(problem, [&] {
        std::shared_ptr<Engine> own;
        if (engine != nullptr) own = std::make_shared<Engine>(*engine);
        problem->core->engine = std::move(own);
    });
}

int32_t delam_experimental_problem_part(const delam_problem* problem, int64_t count, const int64_t* cells,
                                        int64_t capacity, uint8_t* bytes, int64_t* size) {
    return guard_read(problem, [&] {
        const Problem& core = *problem->core;
        require_count(count, "count", 1);
        const std::vector<std::int64_t> list = require_indices(cells, count, core.mesh->cell_count(), 0, "cells");
        for (std::size_t i = 1; i < list.size(); ++i)
            if (list[i] <= list[i - 1])
                fail(DELAM_ERROR_ARGUMENT, "cells[", i, "] = ", list[i], " must be > cells[", i - 1,
                     "] = ", list[i - 1]);
        const std::vector<std::uint8_t> part = save(part_of(core, list));
        const auto needed = static_cast<std::int64_t>(part.size());
        if (bytes != nullptr) {
            require_capacity(capacity, needed, "bytes");
            std::copy(part.begin(), part.end(), bytes);
        }
        if (size != nullptr) *size = needed;
    });
}

int32_t delam_experimental_part_matrix(delam_context* context, int64_t size, const uint8_t* bytes, int64_t* dimension,
                                       int64_t* node_count, int64_t* entries, int64_t* nodes, double* coordinates,
                                       int64_t* row_starts, int64_t* columns, double* values) {
    return guard_read(context, [&] {
        require_count(size, "size");
        require_pointer(bytes, "bytes");
        const Part part = load_part({bytes, static_cast<std::size_t>(size)});
        const SoundPart sound(part);
        std::int64_t counted = 0;
        if (row_starts != nullptr || columns != nullptr || values != nullptr) {
            const SparseMatrix matrix = sound.stiffness([] { poll_cancel_now("assemble"); });
            counted = matrix.entries();
            if (row_starts != nullptr) std::copy(matrix.start.begin(), matrix.start.end(), row_starts);
            if (columns != nullptr) std::copy(matrix.column.begin(), matrix.column.end(), columns);
            if (values != nullptr) std::copy(matrix.value.begin(), matrix.value.end(), values);
        } else if (entries != nullptr) {
            counted = sound.entries();
        }
        if (nodes != nullptr) std::copy(part.nodes.begin(), part.nodes.end(), nodes);
        if (coordinates != nullptr) std::copy(part.coordinates.begin(), part.coordinates.end(), coordinates);
        if (dimension != nullptr) *dimension = part.dimension;
        if (node_count != nullptr) *node_count = static_cast<std::int64_t>(part.nodes.size());
        if (entries != nullptr) *entries = counted;
    });
}
