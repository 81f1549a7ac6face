// SPDX-License-Identifier: BSD-3-Clause
#include "file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "error.hpp"

namespace cli {

namespace {

std::string system_text(int code) { return std::strerror(code); }

// Closes the file on every path; close() itself may report a late write error.
class Descriptor {
public:
    Descriptor(const std::string& path, int flags)
        : path_(path), value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (value_ < 0) throw OutputFailure(path, system_text(errno));
    }
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    void close() {
        const int status = ::close(value_);
        value_ = -1;
        if (status != 0) throw OutputFailure(path_, system_text(errno));
    }
    [[nodiscard]] int get() const { return value_; }

private:
    std::string path_;
    int value_;
};

void write_all(int descriptor, const std::string& path, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            throw OutputFailure(path, system_text(errno));
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace

void write_atomic(const std::string& path, std::string_view bytes) {
    const std::string beside = path + ".new";
    try {
        Descriptor file(beside, O_WRONLY | O_CREAT | O_TRUNC);
        write_all(file.get(), beside, bytes);
        if (::fsync(file.get()) != 0) throw OutputFailure(beside, system_text(errno));
        file.close();
        rename_file(beside, path);
    } catch (...) {
        ::unlink(beside.c_str());
        throw;
    }
}

void require_replaceable(const std::string& path, bool replace) {
    std::error_code code;
    const std::filesystem::file_status there = std::filesystem::status(path, code);
    if (!std::filesystem::exists(there)) return;
    if (!std::filesystem::is_regular_file(there))
        throw Failure(exit_scene, path + ": this cannot be replaced, as it is no regular file");
    if (!replace) throw Failure(exit_scene, path + " is there already: --replace overwrites it");
}

void rename_file(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) throw OutputFailure(to, system_text(errno));
}

void remove_file(const std::string& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) throw OutputFailure(path, system_text(errno));
}

void require_room(const std::string& path, std::int64_t bytes) {
    const std::string probe = path + ".room";
    Descriptor file(probe, O_WRONLY | O_CREAT | O_TRUNC);
    const int code = ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes));
    ::unlink(probe.c_str());
    if (code == ENOSPC || code == EFBIG || code == EDQUOT)
        throw OutputFailure(path, system_text(code) + " (" + std::to_string(bytes) + " bytes are needed)");
}

void fill_holes(const std::string& path) {
    Descriptor file(path, O_RDWR);
    struct stat about = {};
    if (::fstat(file.get(), &about) != 0) throw OutputFailure(path, system_text(errno));
    int code = 0;
    // A signal whose handler does not restart calls may interrupt it.
    do {
        code = about.st_size > 0 && ::fallocate(file.get(), 0, 0, about.st_size) != 0 ? errno : 0;
    } while (code == EINTR);
    if (code != 0 && code != EOPNOTSUPP && code != ENOSYS)
        throw OutputFailure(path, system_text(code) + " (" + std::to_string(about.st_size) + " bytes are needed)");
    file.close();
}

void synchronise(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw OutputFailure(path, system_text(errno));
    const int status = ::fsync(descriptor);
    const int code = errno;
    ::close(descriptor);
    // Some file systems cannot synchronise folders; that is no error of the data.
    if (status != 0 && code != EINVAL) throw OutputFailure(path, system_text(code));
}

Appender::Appender(std::string path, std::int64_t length)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)),
      length_(length) {
    if (descriptor_ < 0) throw OutputFailure(path_, system_text(errno));
    if (::ftruncate(descriptor_, static_cast<off_t>(length)) != 0 ||
        ::lseek(descriptor_, static_cast<off_t>(length), SEEK_SET) < 0) {
        const int code = errno;
        ::close(descriptor_);
        throw OutputFailure(path_, system_text(code));
    }
}

Appender::~Appender() { ::close(descriptor_); }

void Appender::append(std::string_view bytes) {
    write_all(descriptor_, path_, bytes);
    length_ += static_cast<std::int64_t>(bytes.size());
}

}  // namespace cli
