// SPDX-License-Identifier: BSD-3-Clause
// A table on the disk that grows by rows and whose last rows can be replaced: a march with backtracking revises steps
// that were written long ago. Growing appends; replacing writes the whole file beside and renames it, so at any time
// the file is a whole table, the old one or the new one.
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
    // A new file with nothing but its header, one line with its end.
    RowFile(std::string path, std::string_view header);
    // Goes on after the first `rows` rows of what is there; what follows is cut off. Throws Failure(exit_scene) when
    // there are fewer whole ones.
    RowFile(std::string path, std::size_t rows);

    // row: one line with its end.
    void append(std::string_view row);
    // Rows first, first + 1, ... become these; first <= rows().
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
