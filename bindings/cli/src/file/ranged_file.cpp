// SPDX-License-Identifier: BSD-3-Clause
#include "file/ranged_file.hpp"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace cli {

namespace {

// Calls move(bytes done so far), which returns how many more it has moved, until all are; a signal interrupts it.
template <class Move>
int moved(std::int64_t count, Move&& move) {
    for (std::int64_t done = 0; done < count;) {
        const ssize_t now = move(done);
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) return errno;
        if (now == 0) return EIO;  // the file ends before
        done += now;
    }
    return 0;
}

}  // namespace

RangedFile::RangedFile(const std::string& path, Mode mode) {
    descriptor_ = ::open(path.c_str(), (mode == Mode::read ? O_RDONLY : O_WRONLY) | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor_ < 0) code_ = errno;
}

RangedFile::~RangedFile() { (void)close(); }

int RangedFile::read(std::int64_t offset, void* bytes, std::int64_t count) {
    return moved(count, [&](std::int64_t done) {
        return ::pread(descriptor_, static_cast<char*>(bytes) + done, static_cast<std::size_t>(count - done),
                       offset + done);
    });
}

int RangedFile::write(std::int64_t offset, const void* bytes, std::int64_t count) {
    return moved(count, [&](std::int64_t done) {
        return ::pwrite(descriptor_, static_cast<const char*>(bytes) + done, static_cast<std::size_t>(count - done),
                        offset + done);
    });
}

int RangedFile::sync() { return ::fsync(descriptor_) == 0 ? 0 : errno; }

int RangedFile::close() {
    if (descriptor_ < 0) return 0;
    const int code = ::close(descriptor_) == 0 ? 0 : errno;
    descriptor_ = -1;
    return code;
}

}  // namespace cli
