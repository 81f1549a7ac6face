// SPDX-License-Identifier: BSD-3-Clause
// Files with every write checked: a full disk is an error that names the file, never a truncated result.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

// Writes PATH.new, synchronises and renames it: PATH has either the old or the new content.
void write_atomic(const std::string& path, std::string_view bytes);

// Throws Failure where a file that a person named is there already and `replace` is not set, or where it is no regular
// file: renaming would put an ordinary file in the place of a device or a pipe.
void require_replaceable(const std::string& path, bool replace);

void rename_file(const std::string& from, const std::string& to);
// A missing file is no error.
void remove_file(const std::string& path);
// Reserves space beside `path` and frees it again, to detect a full disk before calling a library that cannot recover
// from one.
void require_room(const std::string& path, std::int64_t bytes);
// Takes the space of a file's whole length, where the file system can: those who write into it later then find it.
void fill_holes(const std::string& path);
// Flushes to disk, including the entries of `folder`.
void synchronise(const std::string& path);

// An append-only file.
class Appender {
public:
    // Keeps the first `length` bytes of the existing file (0: starts anew).
    Appender(std::string path, std::int64_t length);
    ~Appender();
    Appender(const Appender&) = delete;
    Appender& operator=(const Appender&) = delete;

    void append(std::string_view bytes);
    [[nodiscard]] std::int64_t length() const { return length_; }

private:
    std::string path_;
    int descriptor_ = -1;
    std::int64_t length_ = 0;
};

}  // namespace cli
