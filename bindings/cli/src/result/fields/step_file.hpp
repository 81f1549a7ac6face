// SPDX-License-Identifier: BSD-3-Clause
// The fields of one step as a small HDF5 file (group "step"). `delam` makes it in memory, so that only this program's
// own checked writes touch the disk during the analysis. On many processes, the file is made with room for the fields
// of nodes and cells, which the processes then fill.
#pragma once

#include <string>
#include <vector>

#include <hdf5.h>

#include "model/model.hpp"
#include "result/fields/bulk_fields.hpp"

namespace cli {

// estimate: with the error of the mesh (bulk_facts.hpp), if the fields of nodes or cells are written.
std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time,
                       bool estimate);
// The same as a file, by many processes. A file that is there is replaced, at once.
void write_step_file(const std::string& path, const Model& model, delam_solver* solver, const Scene& scene,
                     std::int64_t step, double time, Bulk& bulk);

// True if the file holds the fields of this step.
bool is_step_file(const std::string& path, std::size_t step);

// Copies the step of an open file, which write_step_file has made at this path, to a new group of another file, with
// room in the place of the values of nodes and cells. Returns what the processes have to copy.
std::vector<FileRange> copy_step(hid_t file, const std::string& path, hid_t parent, const std::string& name,
                                 const Scene& scene);

}  // namespace cli
