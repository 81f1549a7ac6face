// SPDX-License-Identifier: BSD-3-Clause
// A file of which several processes write ranges of their own. No function throws: each returns 0 or the system's error
// number, so that a process can go on to where all learn of it.
#pragma once

#include <cstdint>
#include <string>

namespace cli {

class RangedFile {
public:
    enum class Mode { read, write };

    // The file is there already.
    RangedFile(const std::string& path, Mode mode);
    ~RangedFile();
    RangedFile(const RangedFile&) = delete;
    RangedFile& operator=(const RangedFile&) = delete;

    [[nodiscard]] int code() const { return code_; }  // of opening it
    int read(std::int64_t offset, void* bytes, std::int64_t count);
    int write(std::int64_t offset, const void* bytes, std::int64_t count);
    int sync();
    int close();

private:
    int descriptor_ = -1;
    int code_ = 0;
};

}  // namespace cli
