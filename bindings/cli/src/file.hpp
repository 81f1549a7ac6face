// SPDX-License-Identifier: BSD-3-Clause
// Files whose every write is checked: a full disk is an error that names the file, never a truncated result.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

// All bytes; throws Failure(exit_scene) naming the file when it cannot be read.
std::string read_bytes(const std::string& path);

// Written beside as PATH.new, synchronised and renamed: PATH is either the old or the new content.
void write_atomic(const std::string& path, std::string_view bytes);

void rename_file(const std::string& from, const std::string& to);
// Missing is fine.
void remove_file(const std::string& path);
// Reserves room beside `path` and frees it again: tells a full disk before a library that cannot recover from one meets
// it.
void require_room(const std::string& path, std::int64_t bytes);
// To the disk, folder entries of `folder` included.
void synchronise(const std::string& path);

// An append-only file.
class Appender {
public:
    // Keeps the first `length` bytes of what is there (0: starts anew).
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
