// SPDX-License-Identifier: BSD-3-Clause
#include "file/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "text/error.hpp"
#include "text/reason.hpp"

namespace cli {

namespace {

[[noreturn]] void unreadable(const std::string& path, const std::string& reason) {
    throw Failure(exit_scene, path + ": cannot be read: " + reason);
}

void require_regular(const std::string& path, mode_t mode) {
    if (S_ISREG(mode)) return;
    const char* kind = S_ISDIR(mode)    ? "a folder"
                       : S_ISFIFO(mode) ? "a pipe"
                       : S_ISSOCK(mode) ? "a socket"
                                        : "a device";
    unreadable(path, std::string("it is ") + kind + ", and a regular file is expected");
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
    struct stat about {};
    if (::stat(path_.c_str(), &about) != 0) unreadable(path_, reason_of(errno));
    require_regular(path_, about.st_mode);
    // Something else may have taken its place: a pipe must not wait here.
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) unreadable(path_, reason_of(errno));
    try {
        if (::fstat(descriptor_, &about) != 0) unreadable(path_, reason_of(errno));
        require_regular(path_, about.st_mode);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
    size_ = static_cast<std::int64_t>(about.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::string InputFile::read(std::int64_t count) {
    std::string out(static_cast<std::size_t>(std::clamp<std::int64_t>(count, 0, size_ - at_)), '\0');
    out.erase(static_cast<std::size_t>(read_into(out.data(), std::ssize(out))));
    return out;
}

std::int64_t InputFile::read_into(char* bytes, std::int64_t count) {
    const std::int64_t wanted = std::clamp<std::int64_t>(count, 0, size_ - at_);
    std::int64_t got = 0;
    while (got < wanted) {
        const ssize_t now = ::read(descriptor_, bytes + got, static_cast<std::size_t>(wanted - got));
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) unreadable(path_, reason_of(errno));
        if (now == 0) break;
        got += now;
    }
    at_ += got;
    return got;
}

std::string read_bytes(const std::string& path, std::int64_t most) {
    InputFile file(path);
    if (file.size() > most)
        unreadable(path, fmt::format("it has {} bytes, and at most {} are allowed", file.size(), most));
    return file.rest();
}

}  // namespace cli
