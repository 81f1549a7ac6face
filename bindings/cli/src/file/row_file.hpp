// SPDX-License-Identifier: BSD-3-Clause
// A table on disk that grows by rows and whose last rows can be replaced: an analysis with backtracking revises steps
// that were written long ago. Growing appends; replacing writes a new file beside the old one, and settle() gives it
// the name. At any time both are complete tables.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "file/file.hpp"
#include "file/hash.hpp"

namespace cli {

class RowFile {
public:
    // Creates a file with only its header, one line with its end.
    RowFile(std::string path, std::string_view header);
    // Continues after the first `rows` rows of the file and removes the rest. Throws Failure(exit_scene) if there are
    // fewer complete rows, or if these are not what `saved` says; without it they are taken as they are.
    RowFile(std::string path, std::size_t rows, const std::optional<Content>& saved);

    // row: one line with its end.
    void append(std::string_view row);
    // Replaces rows first, first + 1, ... by these; first <= rows(). The file of that name stays as it was until
    // settle().
    void replace_from(std::size_t first, const std::vector<std::string>& rows);
    // Flushes to disk.
    void synchronise() const;
    // Replaces the file: what it held before is needed no more.
    void settle();
    [[nodiscard]] std::size_t rows() const { return ends_.size() - 1; }
    // Header and rows.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] Content content() const { return {static_cast<std::int64_t>(ends_.back()), hash_text(hash_)}; }

private:
    std::string path_;
    std::string at_;                        // where the table stands until settle(), else path_
    std::vector<std::size_t> ends_;         // bytes up to the end of the header and of each row
    std::uint64_t hash_ = hash_of_nothing;  // of header and rows
    std::optional<Appender> file_;
};

}  // namespace cli
