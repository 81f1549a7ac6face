// SPDX-License-Identifier: BSD-3-Clause
// Whole binary files. Error(DELAM_ERROR_FILE) names the file and gives the system's message.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delam {

// Writes a temporary file and renames it to `path`: the path then holds either all of the new content, on disk, or the
// old.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);

// A regular file open for reading. Refuses everything else without waiting for it: pipes and devices may have no end.
class InputFile {
public:
    explicit InputFile(std::string path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    std::uint64_t size() const { return size_; }
    // Reads up to `count` bytes, beginning with byte `first`; returns fewer at the end of the file.
    std::vector<std::uint8_t> read(std::uint64_t first, std::uint64_t count) const;

private:
    std::string path_;
    std::uint64_t size_ = 0;
    int number_ = -1;
};

}  // namespace delam
