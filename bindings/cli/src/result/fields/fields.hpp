// SPDX-License-Identifier: BSD-3-Clause
// fields.h5 and fields.xdmf: the fields of the chosen steps. During the analysis each step is a separate small file.
// When the result is published they are combined once, so the cost stays linear in the number of steps.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/library/model.hpp"
#include "result/fields/bulk_facts.hpp"
#include "result/fields/bulk_fields.hpp"
#include "result/fields/instants.hpp"
#include "result/history/concept.hpp"

namespace cli {

class Fields {
public:
    // folder: for the step files. bulk: where the fields are; null: here.
    Fields(std::string folder, const Scene& scene, Bulk* bulk);

    [[nodiscard]] bool chosen(std::size_t step) const { return instants_.chosen(step); }
    [[nodiscard]] bool written(std::size_t step) const { return written_.contains(step); }
    // Judges steps `first`, first + 1, .. by what they and the step before them show (Instants::judge).
    [[nodiscard]] bool judges() const { return instants_.judges(); }
    void judge(std::size_t step, const Sight& before, const Sight& now) { instants_.judge(step, before, now); }
    // collapses: the step after it loses most of a reaction, so that small rotations are judged before they are gone.
    void write_step(const Model& model, delam_solver* solver, const Scene& scene, std::size_t step,
                    bool collapses = false);
    // Flushes the step files to disk, before a state that relies on them is written.
    void synchronise_steps();
    // Replaces the files of steps that were written again, and removes those of steps that are chosen no more: the
    // saved state counts on what is left.
    void settle();
    // Hashes of the files of the chosen steps up to `last`, in their order, and how the next ones are chosen.
    void seal(std::size_t last, Companions& companions);
    // Continues with the files of the chosen steps up to `last`. Throws Failure(exit_scene) if a file is missing or its
    // hash differs from the saved one; if no hashes were saved, if it is of another step.
    void resume(std::size_t last, const std::optional<Companions>& saved);
    // Combines steps 0 .. last into folder/fields.h5 and folder/fields.xdmf; writes neither if the scene wants no
    // field.
    BulkFacts assemble(const Model& model, const Scene& scene, std::size_t last, const std::string& problem_hash,
                       const Concept& named) const;
    [[nodiscard]] bool on_many_processes() const { return bulk_ != nullptr; }

private:
    // True for the last of the steps that are chosen from the beginning and, of those behind the initial state, for the
    // 1st, 2nd, 4th, 8th, ..; where events choose steps, too, for the middle one and the step of the first damage:
    // until then the share of the error stays the same.
    [[nodiscard]] bool estimates_mesh_error(std::size_t step) const;
    [[nodiscard]] std::string step_path(std::size_t step) const;
    [[nodiscard]] std::string revised_path(std::size_t step) const;

    std::string folder_;
    Bulk* bulk_;
    Instants instants_;
    std::set<std::size_t> written_;  // steps that have a file
    std::vector<std::string> unsynchronised_;
    std::set<std::size_t> earlier_;              // steps whose files a version before 0.3 named
    std::set<std::size_t> revised_;              // steps whose files wait for settle()
    std::map<std::size_t, std::string> hashes_;  // by step; without those that many processes have written since
};

}  // namespace cli
