// SPDX-License-Identifier: BSD-3-Clause
// A table on disk that grows by rows and whose last rows can be replaced: an analysis with backtracking revises steps
// that were written long ago. Growing appends; replacing writes a new file and renames it. At any time the file is a
// complete table, the old one or the new one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "file.hpp"

namespace cli {

class RowFile {
public:
    // Creates a file with only its header, one line with its end.
    RowFile(std::string path, std::string_view header);
    // Continues after the first `rows` rows of the file and removes the rest. Throws Failure(exit_scene) if there are
    // fewer complete rows.
    RowFile(std::string path, std::size_t rows);

    // row: one line with its end.
    void append(std::string_view row);
    // Replaces rows first, first + 1, ... by these; first <= rows().
    void replace_from(std::size_t first, const std::vector<std::string>& rows);
    [[nodiscard]] std::size_t rows() const { return ends_.size() - 1; }
    // Header and rows.
    [[nodiscard]] std::string text() const;

private:
    std::string path_;
    std::vector<std::size_t> ends_;  // bytes up to the end of the header and of each row
    std::optional<Appender> file_;
};

}  // namespace cli
