// SPDX-License-Identifier: BSD-3-Clause
// Files that are read: regular ones alone. A pipe may wait for ever and a device may have no end, so that both are
// refused without being opened, and a file that is too large is refused without being read.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace cli {

// Every failure is a Failure(exit_scene) that names the file.
class InputFile {
public:
    explicit InputFile(std::string path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    // Size in bytes when the file was opened. Bytes added later are not read.
    [[nodiscard]] std::int64_t size() const { return size_; }
    // The next bytes, `count` of them or as many as there are.
    std::string read(std::int64_t count);
    // Reads them into memory, and returns how many there are.
    std::int64_t read_into(char* bytes, std::int64_t count);
    std::string rest() { return read(size_ - at_); }

private:
    std::string path_;
    int descriptor_ = -1;
    std::int64_t size_ = 0;
    std::int64_t at_ = 0;
};

// All bytes of a file that has at most `most`.
std::string read_bytes(const std::string& path, std::int64_t most = std::numeric_limits<std::int64_t>::max());

}  // namespace cli
