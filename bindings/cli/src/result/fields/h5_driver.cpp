// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/h5_driver.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cli::h5 {

namespace {

thread_local FileTrouble trouble;
// A file that cannot be opened is no failure if another way of opening works: HDF5 tries whether a file exists, then
// makes it.
thread_local FileTrouble not_opened;

void note(const std::string& path, int code) {
    if (trouble.code == 0) trouble = {path, code};
}

// A file as HDF5 holds it; the first member is its own.
struct DriverFile {
    H5FD_t base{};
    int descriptor = -1;
    haddr_t allocated = 0;  // end of what HDF5 has given away
    haddr_t length = 0;     // of the file
    dev_t device = 0;
    ino_t inode = 0;
    std::string path;
};

DriverFile& of(H5FD_t* file) { return *reinterpret_cast<DriverFile*>(file); }
const DriverFile& of(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file); }

// Calls move(bytes done so far), which returns how many more it has moved, until all are or the file ends; a signal
// interrupts it. Returns the bytes that it has moved; errno is 0 unless it failed.
template <class Move>
std::size_t moved(std::size_t count, Move&& move) {
    std::size_t done = 0;
    errno = 0;
    while (done < count) {
        const ssize_t now = move(done);
        if (now < 0 && errno == EINTR) {
            errno = 0;
            continue;
        }
        if (now <= 0) break;
        done += static_cast<std::size_t>(now);
    }
    return done;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
    int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
    if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT | O_NOFOLLOW;
    if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
    if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
    auto* file = new (std::nothrow) DriverFile;
    if (file == nullptr) return nullptr;
    file->path = name;
    struct stat about {};
    file->descriptor = ::open(name, mode | O_CLOEXEC, 0666);
    int code = file->descriptor < 0 || ::fstat(file->descriptor, &about) != 0 ? errno : 0;
    if (code == 0 && !memory_for_a_file()) code = ENOMEM;
    if (code != 0) {
        not_opened = {file->path, code};
        if (file->descriptor >= 0) ::close(file->descriptor);
        delete file;
        return nullptr;
    }
    not_opened = {};
    file->length = static_cast<haddr_t>(about.st_size);
    file->device = about.st_dev;
    file->inode = about.st_ino;
    return &file->base;
}

herr_t close_file(H5FD_t* base) {
    DriverFile* file = &of(base);
    if (::close(file->descriptor) != 0) note(file->path, errno);
    delete file;
    return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
    const auto key = [](const H5FD_t* file) { return std::pair{of(file).device, of(file).inode}; };
    return key(a) < key(b) ? -1 : key(b) < key(a) ? 1 : 0;
}

// Returns what HDF5's own driver of files does, so that the same calls lay out the same file.
herr_t features(const H5FD_t*, unsigned long* flags) {
    if (flags != nullptr)
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                 H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) { return of(file).allocated; }
herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    of(file).allocated = end;
    return 0;
}
haddr_t length(const H5FD_t* file, H5FD_mem_t) { return of(file).length; }

// Bytes behind the end of the file are zero.
herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
    DriverFile& file = of(base);
    char* bytes = static_cast<char*>(buffer);
    const std::size_t got = moved(size, [&](std::size_t done) {
        return ::pread(file.descriptor, bytes + done, size - done, static_cast<off_t>(address + done));
    });
    if (errno != 0) note(file.path, errno);
    std::fill(bytes + got, bytes + size, '\0');
    return errno != 0 ? -1 : 0;
}

herr_t write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, const void* buffer) {
    DriverFile& file = of(base);
    const char* bytes = static_cast<const char*>(buffer);
    const std::size_t put = moved(size, [&](std::size_t done) {
        return ::pwrite(file.descriptor, bytes + done, size - done, static_cast<off_t>(address + done));
    });
    if (put < size) note(file.path, errno != 0 ? errno : EIO);
    file.length = std::max<haddr_t>(file.length, address + size);
    return 0;
}

herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
    DriverFile& file = of(base);
    if (file.length == file.allocated) return 0;
    if (::ftruncate(file.descriptor, static_cast<off_t>(file.allocated)) != 0) note(file.path, errno);
    file.length = file.allocated;
    return 0;
}

H5FD_class_t driver() {
    H5FD_class_t out{};
#if H5_VERSION_GE(1, 13, 2)
    out.version = H5FD_CLASS_VERSION;
    out.value = static_cast<H5FD_class_value_t>(H5_VFD_RESERVED + 1);  // for tests and programs, not registered
#endif
    out.name = "delam";
    out.maxaddr = HADDR_MAX / 2;
    out.fc_degree = H5F_CLOSE_WEAK;
    out.open = open_file;
    out.close = close_file;
    out.cmp = compare;
    out.query = features;
    out.get_eoa = allocated;
    out.set_eoa = allocate;
    out.get_eof = length;
    out.read = read;
    out.write = write;
    out.truncate = truncate;
    // The kinds of data stand one behind the other, as in HDF5's own driver (H5FD_FLMAP_DICHOTOMY).
    const H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(kinds), std::end(kinds), out.fl_map);
    return out;
}

}  // namespace

void begin() {
    static const bool begun = H5dont_atexit() >= 0 && H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
    (void)begun;
}

FileTrouble take_trouble() {
    const FileTrouble opening = std::exchange(not_opened, {});
    const FileTrouble later = std::exchange(trouble, {});
    return later.code != 0 ? later : opening;
}

bool memory_for_a_file() {
    constexpr std::size_t of_a_file = std::size_t{1} << 20;  // twice what HDF5 1.10 takes at once
    void* const block = ::operator new(of_a_file, std::nothrow);
    ::operator delete(block);
    return block != nullptr;
}

hid_t driver_access() {
    begin();
    static const H5FD_class_t class_of_driver = driver();
    static const hid_t access = [] {
        const hid_t id = H5FDregister(&class_of_driver);
        const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
        return id < 0 || properties < 0 || H5Pset_driver(properties, id, nullptr) < 0 ? H5I_INVALID_HID : properties;
    }();
    return access;
}

}  // namespace cli::h5
