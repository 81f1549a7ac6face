// SPDX-License-Identifier: BSD-3-Clause
#include "row_file.hpp"

#include <cstdint>
#include <utility>

#include "error.hpp"
#include "input_file.hpp"

namespace cli {

RowFile::RowFile(std::string path, std::string_view header) : path_(std::move(path)), ends_{header.size()} {
    file_.emplace(path_, 0);
    file_->append(header);
}

RowFile::RowFile(std::string path, std::size_t rows) : path_(std::move(path)) {
    const std::string bytes = read_bytes(path_);
    for (std::size_t end = bytes.find('\n'); end != std::string::npos && ends_.size() <= rows;
         end = bytes.find('\n', end + 1))
        ends_.push_back(end + 1);
    if (ends_.size() <= rows) throw Failure(exit_scene, path_ + ": rows are missing; run again without --resume");
    file_.emplace(path_, static_cast<std::int64_t>(ends_.back()));
}

void RowFile::append(std::string_view row) {
    file_->append(row);
    ends_.push_back(ends_.back() + row.size());
}

void RowFile::replace_from(std::size_t first, const std::vector<std::string>& rows) {
    if (first > this->rows()) throw Failure(exit_numerical, path_ + ": rows are replaced beyond the last one");
    std::string bytes = text().substr(0, ends_[first]);
    std::vector<std::size_t> ends(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    for (const std::string& row : rows) {
        bytes += row;
        ends.push_back(bytes.size());
    }
    file_.reset();
    write_atomic(path_, bytes);
    ends_ = std::move(ends);
    file_.emplace(path_, static_cast<std::int64_t>(ends_.back()));
}

std::string RowFile::text() const { return read_bytes(path_).substr(0, ends_.back()); }

}  // namespace cli
