// SPDX-License-Identifier: BSD-3-Clause
#include "file/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file/input_file.hpp"
#include "text/error.hpp"
#include "text/reason.hpp"

namespace cli {

namespace {

// Why a file was not opened, with O_NOFOLLOW.
std::string open_text(int code) { return code == ELOOP ? "it is a symbolic link" : reason_of(code); }

constexpr std::string_view beside_suffixes[] = {".new", ".room", revised_suffix};

// Closes the file on every path; close() itself may report a late write error.
class Descriptor {
public:
    Descriptor(const std::string& path, int flags)
        : path_(path), value_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0666)) {
        if (value_ < 0) throw OutputFailure(path, open_text(errno));
    }
    // A file that was not there: PATH + suffix, or where something has that name, with a number behind it.
    static Descriptor anew(const std::string& path, std::string_view suffix) {
        constexpr int most = 1000;  // left behind by processes that were killed, each of them one
        for (int k = 0;; ++k) {
            const std::string name = path + std::string(suffix) + (k > 0 ? "-" + std::to_string(k) : "");
            const int value = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
            if (value >= 0) return Descriptor(name, value, {});
            if (errno != EEXIST || k == most) throw OutputFailure(name, reason_of(errno));
        }
    }
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&& from) noexcept : path_(std::move(from.path_)), value_(std::exchange(from.value_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    void close() {
        const int status = ::close(value_);
        value_ = -1;
        if (status != 0) throw OutputFailure(path_, reason_of(errno));
    }
    [[nodiscard]] int get() const { return value_; }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    struct Open {};
    Descriptor(std::string path, int value, Open) : path_(std::move(path)), value_(value) {}

    std::string path_;
    int value_;
};

void write_all(int descriptor, const std::string& path, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            throw OutputFailure(path, reason_of(errno));
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace

void write_atomic(const std::string& path, std::string_view bytes) {
    Descriptor file = Descriptor::anew(path, ".new");
    const std::string beside = file.path();
    try {
        write_all(file.get(), beside, bytes);
        if (::fsync(file.get()) != 0) throw OutputFailure(beside, reason_of(errno));
        file.close();
        rename_file(beside, path);
    } catch (...) {
        ::unlink(beside.c_str());
        throw;
    }
}

bool is_beside(std::string_view name, std::string_view of) {
    if (!name.starts_with(of) || name == of) return false;
    name.remove_prefix(of.size());
    while (!name.empty()) {
        const auto has_suffix = [name](std::string_view suffix) { return name.starts_with(suffix); };
        const auto* const found = std::find_if(std::begin(beside_suffixes), std::end(beside_suffixes), has_suffix);
        if (found == std::end(beside_suffixes)) return false;
        name.remove_prefix(found->size());
        if (!name.starts_with('-')) continue;
        const std::size_t digits = std::min(name.find_first_not_of("0123456789", 1), name.size());
        if (digits == 1) return false;
        name.remove_prefix(digits);
    }
    return true;
}

void take_revised(const std::string& path, const std::function<bool(const std::string& revised)>& counts) {
    const std::string revised = path + std::string(revised_suffix);
    std::error_code code;
    if (!std::filesystem::exists(std::filesystem::symlink_status(revised, code))) return;
    if (counts(revised))
        rename_file(revised, path);
    else
        remove_file(revised);
}

void require_replaceable(const std::string& path, bool replace, const std::string& what,
                         const std::function<bool(const std::string& bytes)>& own) {
    std::error_code code;
    const std::filesystem::file_status there = std::filesystem::symlink_status(path, code);
    if (!std::filesystem::exists(there)) return;
    if (std::filesystem::is_symlink(there))
        throw Failure(exit_scene, path + ": this cannot be replaced, as it is a symbolic link; name its target");
    if (!std::filesystem::is_regular_file(there))
        throw Failure(exit_scene, path + ": this cannot be replaced, as it is no regular file");
    if (!replace) throw Failure(exit_scene, path + " is there already: --replace overwrites it");
    if (!own(read_bytes(path)))
        throw Failure(exit_scene, path + ": this is not replaced, as it is not " + what +
                                      "; choose another name, or remove it yourself");
}

void rename_file(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) throw OutputFailure(to, reason_of(errno));
}

void remove_file(const std::string& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) throw OutputFailure(path, reason_of(errno));
}

void require_room(const std::string& path, std::int64_t bytes) {
    const Descriptor file = Descriptor::anew(path, ".room");
    const int code = ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes));
    ::unlink(file.path().c_str());
    if (code == ENOSPC || code == EFBIG || code == EDQUOT)
        throw OutputFailure(path, reason_of(code) + " (" + std::to_string(bytes) + " bytes are needed)");
}

void fill_holes(const std::string& path) {
    Descriptor file(path, O_RDWR);
    struct stat about = {};
    if (::fstat(file.get(), &about) != 0) throw OutputFailure(path, reason_of(errno));
    int code = 0;
    // A signal whose handler does not restart calls may interrupt it.
    do {
        code = about.st_size > 0 && ::fallocate(file.get(), 0, 0, about.st_size) != 0 ? errno : 0;
    } while (code == EINTR);
    if (code != 0 && code != EOPNOTSUPP && code != ENOSYS)
        throw OutputFailure(path, reason_of(code) + " (" + std::to_string(about.st_size) + " bytes are needed)");
    file.close();
}

void synchronise(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw OutputFailure(path, reason_of(errno));
    const int status = ::fsync(descriptor);
    const int code = errno;
    ::close(descriptor);
    // Some file systems cannot synchronise folders; that is no error of the data.
    if (status != 0 && code != EINVAL) throw OutputFailure(path, reason_of(code));
}

Appender::Appender(std::string path, std::int64_t length)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)),
      length_(length) {
    if (descriptor_ < 0) throw OutputFailure(path_, open_text(errno));
    if (::ftruncate(descriptor_, static_cast<off_t>(length)) != 0 ||
        ::lseek(descriptor_, static_cast<off_t>(length), SEEK_SET) < 0) {
        const int code = errno;
        ::close(descriptor_);
        throw OutputFailure(path_, reason_of(code));
    }
}

Appender::~Appender() { ::close(descriptor_); }

void Appender::append(std::string_view bytes) {
    write_all(descriptor_, path_, bytes);
    length_ += static_cast<std::int64_t>(bytes.size());
}

}  // namespace cli
