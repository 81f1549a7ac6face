// SPDX-License-Identifier: BSD-3-Clause
#include "file/row_file.hpp"

#include <cstdint>
#include <utility>

#include "file/input_file.hpp"
#include "file/own_files.hpp"
#include "text/error.hpp"

namespace cli {

RowFile::RowFile(std::string path, std::string_view header)
    : path_(std::move(path)), at_(path_), ends_{header.size()}, hash_(hash(header)) {
    file_.emplace(path_, 0);
    file_->append(header);
}

RowFile::RowFile(std::string path, std::size_t rows, const std::optional<Content>& saved)
    : path_(std::move(path)), at_(path_) {
    take_revised(path_, [&saved](const std::string& revised) {
        return saved &&
               content_of(read_bytes(revised, most_table_bytes).substr(0, static_cast<std::size_t>(saved->bytes))) ==
                   *saved;
    });
    const std::string bytes = read_bytes(path_, most_table_bytes);
    for (std::size_t end = bytes.find('\n'); end != std::string::npos && ends_.size() <= rows;
         end = bytes.find('\n', end + 1))
        ends_.push_back(end + 1);
    if (ends_.size() <= rows) throw Failure(exit_scene, path_ + ": rows are missing; run again without --resume");
    hash_ = hash(std::string_view(bytes).substr(0, ends_.back()));
    if (saved && content() != *saved)
        throw Failure(exit_scene, path_ + ": not as it was when the state was saved; run again without --resume");
    file_.emplace(path_, static_cast<std::int64_t>(ends_.back()));
}

void RowFile::append(std::string_view row) {
    file_->append(row);
    hash_ = hash(row, hash_);
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
    at_ = path_ + std::string(revised_suffix);
    write_atomic(at_, bytes);
    ends_ = std::move(ends);
    hash_ = hash(bytes);
    file_.emplace(at_, static_cast<std::int64_t>(ends_.back()));
}

void RowFile::synchronise() const { cli::synchronise(at_); }

void RowFile::settle() {
    if (at_ != path_) rename_file(at_, path_);
    at_ = path_;
}

std::string RowFile::text() const { return read_bytes(at_).substr(0, ends_.back()); }

}  // namespace cli
