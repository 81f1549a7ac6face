// SPDX-License-Identifier: BSD-3-Clause
// fields.h5 and fields.xdmf: the fields of the chosen steps. During the analysis each step is a separate small file.
// When the result is published they are combined once, so the cost stays linear in the number of steps.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "result/fields/bulk_facts.hpp"
#include "result/fields/bulk_fields.hpp"
#include "result/history/concept.hpp"

namespace cli {

class Fields {
public:
    // folder: for the step files. bulk: where the fields are; null: here.
    Fields(std::string folder, const Scene& scene, Bulk* bulk);

    // Every n-th step, the first, the last and those nearest to the snapshot instants.
    [[nodiscard]] bool chosen(std::size_t step) const { return chosen_.contains(step); }
    void write_step(const Model& model, delam_solver* solver, const Scene& scene, std::size_t step);
    // Flushes the step files to disk, before a state that relies on them is written.
    void synchronise_steps();
    // Replaces the files of steps that were written again: the saved state counts on the new ones.
    void settle();
    // The hashes of the files of the chosen steps up to `last`, in their order.
    std::vector<std::string> hashes(std::size_t last);
    // Continues with the files of the chosen steps up to `last`. Throws Failure(exit_scene) if a file is missing or its
    // hash differs from the saved one; if no hashes were saved, if it is of another step.
    void resume(std::size_t last, const std::optional<std::vector<std::string>>& saved);
    // Combines steps 0 .. last into folder/fields.h5 and folder/fields.xdmf.
    BulkFacts assemble(const Model& model, const Scene& scene, std::size_t last, const std::string& problem_hash,
                       const Concept& named) const;
    void remove_steps() const;
    [[nodiscard]] bool on_many_processes() const { return bulk_ != nullptr; }

private:
    // True for the 1st, 2nd, 4th, 8th, .. of the steps behind the initial state, and for the last.
    [[nodiscard]] bool estimates_mesh_error(std::size_t step) const;
    [[nodiscard]] std::string step_path(std::size_t step) const;
    [[nodiscard]] std::string revised_path(std::size_t step) const;

    std::string folder_;
    Bulk* bulk_;
    std::set<std::size_t> chosen_;
    std::vector<std::string> unsynchronised_;
    std::set<std::size_t> revised_;              // steps whose files wait for settle()
    std::map<std::size_t, std::string> hashes_;  // by step; without those that many processes have written since
};

}  // namespace cli
