// SPDX-License-Identifier: BSD-3-Clause
// The columns of history.csv and its rows.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/library/model.hpp"
#include "result/history/averages.hpp"

namespace cli {

// Title of the column of a value of a pattern: the value, with several patterns VALUE_NAME.
std::string title_of(const std::string& value, const Scene& scene, std::size_t pattern);
std::string load_title(const Scene& scene, std::size_t pattern);
std::string reaction_title(const Scene& scene, std::size_t pattern);

class History {
public:
    // solver: of the analysis, which decides whether its columns of pairs that pop come; null: it is not known yet.
    // Throws SceneFailure if [output] columns names a value that a solver of the problem does not have.
    History(const Model& model, const Scene& scene, const delam_solver* solver = nullptr);

    [[nodiscard]] std::string header() const;
    // Leaves out the last columns if the table that goes on has been begun by a version without them.
    void go_on_under(std::string_view header);
    // Row of the committed state, or of the earlier step being read. Numbers have 17 significant digits, so that
    // reading them back gives the same bits.
    [[nodiscard]] std::string row(delam_solver* solver) const;
    // A value for messages: the factor of the first pattern.
    [[nodiscard]] double load(delam_solver* solver) const;
    [[nodiscard]] double value(delam_solver* solver, const std::string& key) const;

private:
    const Model& model_;
    const Scene& scene_;
    const delam_context* context_;
    struct Column {
        std::string title;
        std::string key;   // of the solver's value; "": none
        std::string text;  // the text of the column if it has no key
    };
    void add(const std::string& title, const std::string& key, const std::string& text = "");
    [[nodiscard]] bool has(const std::string& key) const;

    std::vector<Column> columns_;
    std::map<std::string, AverageColumn> averages_;     // by key
    std::map<std::string, std::size_t> sensitivities_;  // by key: entry of the matrix of derivatives
    std::size_t followed_ = 0;                          // numbers of laws
    std::string first_load_;
};

}  // namespace cli
