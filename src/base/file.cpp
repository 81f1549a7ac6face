// SPDX-License-Identifier: BSD-3-Clause
#include "base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <system_error>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

[[noreturn]] void refuse(const std::string& path, const char* what, int number) {
    fail(DELAM_ERROR_FILE, "'", path, "': ", what, ": ", std::generic_category().message(number));
}

// Closes the file descriptor.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    int close() {
        const int result = number_ >= 0 ? ::close(number_) : 0;
        number_ = -1;
        return result;
    }

private:
    int number_;
};

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

const char* kind_of(mode_t mode) {
    return S_ISDIR(mode) ? "a directory" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

}  // namespace

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
    if (path.empty()) fail(DELAM_ERROR_FILE, "the path is empty");
    // rename() would replace a device, a pipe or a socket that others need by a regular file.
    struct stat there {};
    if (::stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode))
        fail(DELAM_ERROR_FILE, "'", path, "' is ", kind_of(there.st_mode), "; only regular files are replaced");
    // Other processes and threads may save to the same path at the same time, so the temporary name must be unique.
    std::string part;
    int opened = -1;
    for (int attempt = 0; opened < 0 && attempt < 1000; ++attempt) {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        part = text(path, ".", static_cast<long>(getpid()), "-", static_cast<long>(now.tv_nsec), ".part");
        opened = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (opened < 0 && errno != EEXIST) break;
    }
    Descriptor file(opened);
    if (file.number() < 0) refuse(part, "cannot be created", errno);
    const auto give_up = [&](const char* what) {
        const int number = errno;
        file.close();
        ::unlink(part.c_str());
        refuse(path, what, number);
    };
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written =
            ::write(file.number(), bytes.data() + at, std::min<std::size_t>(bytes.size() - at, std::size_t{1} << 30));
        if (written < 0 && errno != EINTR) give_up("cannot be written");
        if (written > 0) at += index(written);
    }
    if (::fsync(file.number()) != 0 && errno != EINVAL) give_up("cannot be written to disk");
    if (file.close() != 0) give_up("cannot be closed");
    if (std::rename(part.c_str(), path.c_str()) != 0) give_up("cannot be replaced by the new file");
    // fsync() of the folder makes the new name durable; if the file system does not support it, that is no error.
    const Descriptor folder(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.number() >= 0) (void)::fsync(folder.number());
}

InputFile::InputFile(std::string path) : path_(std::move(path)) {
    if (path_.empty()) fail(DELAM_ERROR_FILE, "the path is empty");
    const auto require_regular = [this](const struct stat& about) {
        if (!S_ISREG(about.st_mode))
            fail(DELAM_ERROR_FILE, "'", path_, "' is ", kind_of(about.st_mode), "; only regular files are read");
    };
    // To open a device may already do something, and to open a pipe waits for its other end.
    struct stat about {};
    if (::stat(path_.c_str(), &about) == 0) require_regular(about);
    number_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (number_ < 0) refuse(path_, "cannot be opened", errno);
    try {
        if (::fstat(number_, &about) != 0) refuse(path_, "cannot be read", errno);
        require_regular(about);  // it may have been replaced since
    } catch (...) {
        ::close(number_);
        throw;
    }
    size_ = static_cast<std::uint64_t>(std::max<off_t>(about.st_size, 0));
}

InputFile::~InputFile() { ::close(number_); }

std::vector<std::uint8_t> InputFile::read(std::uint64_t first, std::uint64_t count) const {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::min(count, size_ - std::min(first, size_))));
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t got = ::pread(number_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(first + at));
        if (got < 0 && errno != EINTR) refuse(path_, "cannot be read", errno);
        if (got == 0) bytes.resize(at);  // it has been cut since
        if (got > 0) at += index(got);
    }
    return bytes;
}

}  // namespace delam
