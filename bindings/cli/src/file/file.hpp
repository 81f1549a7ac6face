// SPDX-License-Identifier: BSD-3-Clause
// Files with every write checked: a full disk is an error that names the file, never a truncated result.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace cli {

// Writes a file beside PATH that was not there, synchronises it and gives it the name PATH, which has either the old or
// the new content. It opens neither a link nor a file of others.
void write_atomic(const std::string& path, std::string_view bytes);
// True for the names of files that are written beside the file `of`, and which a process that was killed leaves there.
bool is_beside(std::string_view name, std::string_view of);

// Suffix of a file of a run whose content a step has revised. The suffix stays until a state is saved that needs the
// new content; the state saved before needs the old one.
inline constexpr std::string_view revised_suffix = ".revised";

// Decides on a revised file beside PATH after a run has ended: it replaces PATH if `counts` says that the saved state
// needs its content; otherwise it is removed.
void take_revised(const std::string& path, const std::function<bool(const std::string& revised)>& counts);

// Throws Failure if the file that a person named exists already and is a link or no regular file, because renaming
// would put an ordinary file in its place. Throws also for a regular file, unless `replace` is set and `own` says that
// this program has written its bytes. what: "a page of delam view", for the message.
void require_replaceable(const std::string& path, bool replace, const std::string& what,
                         const std::function<bool(const std::string& bytes)>& own);

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
    // Keeps the first `length` bytes of the existing file (0: starts anew). A link is not followed.
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
