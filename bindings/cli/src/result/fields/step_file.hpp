// SPDX-License-Identifier: BSD-3-Clause
// The fields of one step as a small file (step_rows.hpp). On many processes, it is made with room for the fields of
// nodes and cells, which the processes then fill.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <hdf5.h>

#include "model/library/model.hpp"
#include "result/fields/bulk_fields.hpp"

namespace cli {

// The estimates that a step has, if the fields of nodes or cells are written (bulk_facts.hpp).
struct StepEstimates {
    bool mesh_error = false;
    bool rotation_error = false;
};
std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time,
                       const StepEstimates& estimates);
// The same as a file, by many processes. A file that is there is replaced, at once.
void write_step_file(const std::string& path, const Model& model, delam_solver* solver, const Scene& scene,
                     std::int64_t step, double time, Bulk& bulk);

// True if the file holds the fields of this step, also as a file of HDF5 as versions before 0.3 wrote it.
bool is_step_file(const std::string& path, std::size_t step);

// Copies the bytes of such a file, of which rooms may be missing, to a new group of a file of HDF5, with room in the
// place of its rooms. Returns what the processes have to copy from the file at this path.
std::vector<FileRange> copy_step(std::string_view bytes, const std::string& path, hid_t parent,
                                 const std::string& name);
// Copies a step that is a file of HDF5; false: it is none.
bool copy_earlier_step(std::string_view bytes, const std::string& path, hid_t parent, const std::string& name);

}  // namespace cli
