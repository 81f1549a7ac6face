/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: the N-th operation on a file below a folder fails. Counted are the calls of the C library that are listed
   at the end, those with a path if the path lies below the folder, those with a descriptor if it was opened there.
     FAULTS_FOLDER  the folder, without links in its name
     FAULTS_AT      N, from 1 on; 0 or unset: none fails
     FAULTS_CODE    errno of the operation that fails
     FAULTS_COUNT   a file elsewhere to which each process appends one line for each operation: its name and path
   The operations of all processes that inherit these variables are counted one by one. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

enum { most_descriptors = 4096 };

static char folder[PATH_MAX], count_path[PATH_MAX];
static long fail_at, seen;
static int fail_code, ready;
static char watched[most_descriptors];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static void prepare(void) {
    if (ready) return;
    ready = 1;
    const char *text = getenv("FAULTS_FOLDER");
    if (text != NULL) snprintf(folder, sizeof folder, "%s", text);
    text = getenv("FAULTS_COUNT");
    if (text != NULL) snprintf(count_path, sizeof count_path, "%s", text);
    text = getenv("FAULTS_AT");
    fail_at = text != NULL ? strtol(text, NULL, 10) : 0;
    text = getenv("FAULTS_CODE");
    fail_code = text != NULL ? (int)strtol(text, NULL, 10) : EIO;
}

/* True if a path, relative to a folder that is open, lies below the folder that is watched. */
static int is_below(int at, const char *path) {
    char whole[2 * PATH_MAX + 2], base[PATH_MAX];
    prepare();
    if (folder[0] == '\0' || path == NULL) return 0;
    if (path[0] == '/') {
        snprintf(whole, sizeof whole, "%s", path);
    } else {
        if (at == AT_FDCWD) {
            if (syscall(SYS_getcwd, base, sizeof base) < 0) return 0;
        } else {
            char link[64];
            snprintf(link, sizeof link, "/proc/self/fd/%d", at);
            const ssize_t length = (ssize_t)syscall(SYS_readlink, link, base, sizeof base - 1);
            if (length < 0) return 0;
            base[length] = '\0';
        }
        snprintf(whole, sizeof whole, "%s/%s", base, path);
    }
    const size_t length = strlen(folder);
    return strncmp(whole, folder, length) == 0 && (whole[length] == '/' || whole[length] == '\0');
}

/* Notes an operation; true if it is the one that fails. */
static int fails(const char *name, const char *path) {
    prepare();
    pthread_mutex_lock(&lock);
    const long number = ++seen;
    if (count_path[0] != '\0') {
        char line[PATH_MAX + 64];
        const int length = snprintf(line, sizeof line, "%s %s\n", name, path != NULL ? path : "");
        const long to = syscall(SYS_openat, AT_FDCWD, count_path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
        if (to >= 0) {
            syscall(SYS_write, to, line, (size_t)length);
            syscall(SYS_close, to);
        }
    }
    pthread_mutex_unlock(&lock);
    if (number != fail_at) return 0;
    errno = fail_code;
    return 1;
}

static int is_watched(int descriptor) {
    return descriptor >= 0 && descriptor < most_descriptors && watched[descriptor];
}

static void watch(int descriptor, int yes) {
    if (descriptor >= 0 && descriptor < most_descriptors) watched[descriptor] = (char)yes;
}

static void *real(const char *name) {
    void *found = dlsym(RTLD_NEXT, name);
    if (found == NULL) abort();
    return found;
}

#define REAL(name) ((__typeof__(&name))real(#name))

static mode_t mode_of(int flags, va_list list) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? (mode_t)va_arg(list, int) : 0;
}

#define OPEN(name)                                            \
    int name(const char *path, int flags, ...) {              \
        va_list list;                                         \
        va_start(list, flags);                                \
        const mode_t mode = mode_of(flags, list);             \
        va_end(list);                                         \
        const int below = is_below(AT_FDCWD, path);           \
        if (below && fails(#name, path)) return -1;           \
        const int descriptor = REAL(name)(path, flags, mode); \
        watch(descriptor, below);                             \
        return descriptor;                                    \
    }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                              \
    int name(int at, const char *path, int flags, ...) {          \
        va_list list;                                             \
        va_start(list, flags);                                    \
        const mode_t mode = mode_of(flags, list);                 \
        va_end(list);                                             \
        const int below = is_below(at, path);                     \
        if (below && fails(#name, path)) return -1;               \
        const int descriptor = REAL(name)(at, path, flags, mode); \
        watch(descriptor, below);                                 \
        return descriptor;                                        \
    }
OPENAT(openat)
OPENAT(openat64)

DIR *opendir(const char *path) {
    if (is_below(AT_FDCWD, path) && fails("opendir", path)) return NULL;
    return REAL(opendir)(path);
}

#define STAT(name, type)                                               \
    int name(const char *path, struct type *about) {                   \
        if (is_below(AT_FDCWD, path) && fails(#name, path)) return -1; \
        return REAL(name)(path, about);                                \
    }
STAT(stat, stat)
STAT(stat64, stat64)
STAT(lstat, stat)
STAT(lstat64, stat64)

#define FSTAT(name, type)                                            \
    int name(int descriptor, struct type *about) {                   \
        if (is_watched(descriptor) && fails(#name, NULL)) return -1; \
        return REAL(name)(descriptor, about);                        \
    }
FSTAT(fstat, stat)
FSTAT(fstat64, stat64)

#define FSTATAT(name, type)                                                      \
    int name(int at, const char *path, struct type *about, int flags) {          \
        const int below = path[0] != '\0' ? is_below(at, path) : is_watched(at); \
        if (below && fails(#name, path)) return -1;                              \
        return REAL(name)(at, path, about, flags);                               \
    }
FSTATAT(fstatat, stat)
FSTATAT(fstatat64, stat64)

int statx(int at, const char *path, int flags, unsigned mask, struct statx *about) {
    const int below = path[0] != '\0' ? is_below(at, path) : is_watched(at);
    if (below && fails("statx", path)) return -1;
    return REAL(statx)(at, path, flags, mask, about);
}

ssize_t read(int descriptor, void *bytes, size_t count) {
    if (is_watched(descriptor) && fails("read", NULL)) return -1;
    return REAL(read)(descriptor, bytes, count);
}

ssize_t write(int descriptor, const void *bytes, size_t count) {
    if (is_watched(descriptor) && fails("write", NULL)) return -1;
    return REAL(write)(descriptor, bytes, count);
}

#define PREAD(name, offset_type)                                                  \
    ssize_t name(int descriptor, void *bytes, size_t count, offset_type offset) { \
        if (is_watched(descriptor) && fails(#name, NULL)) return -1;              \
        return REAL(name)(descriptor, bytes, count, offset);                      \
    }
PREAD(pread, off_t)
PREAD(pread64, off64_t)

#define PWRITE(name, offset_type)                                                       \
    ssize_t name(int descriptor, const void *bytes, size_t count, offset_type offset) { \
        if (is_watched(descriptor) && fails(#name, NULL)) return -1;                    \
        return REAL(name)(descriptor, bytes, count, offset);                            \
    }
PWRITE(pwrite, off_t)
PWRITE(pwrite64, off64_t)

#define FTRUNCATE(name, offset_type)                                 \
    int name(int descriptor, offset_type length) {                   \
        if (is_watched(descriptor) && fails(#name, NULL)) return -1; \
        return REAL(name)(descriptor, length);                       \
    }
FTRUNCATE(ftruncate, off_t)
FTRUNCATE(ftruncate64, off64_t)

#define FALLOCATE(name, offset_type)                                           \
    int name(int descriptor, int mode, offset_type from, offset_type length) { \
        if (is_watched(descriptor) && fails(#name, NULL)) return -1;           \
        return REAL(name)(descriptor, mode, from, length);                     \
    }
FALLOCATE(fallocate, off_t)
FALLOCATE(fallocate64, off64_t)

#define POSIX_FALLOCATE(name, offset_type)                                  \
    int name(int descriptor, offset_type from, offset_type length) {        \
        if (is_watched(descriptor) && fails(#name, NULL)) return fail_code; \
        return REAL(name)(descriptor, from, length);                        \
    }
POSIX_FALLOCATE(posix_fallocate, off_t)
POSIX_FALLOCATE(posix_fallocate64, off64_t)

int fsync(int descriptor) {
    if (is_watched(descriptor) && fails("fsync", NULL)) return -1;
    return REAL(fsync)(descriptor);
}

/* Where it fails, the descriptor is closed nevertheless, as in Linux. */
int close(int descriptor) {
    const int failed = is_watched(descriptor) && fails("close", NULL);
    watch(descriptor, 0);
    const int status = REAL(close)(descriptor);
    if (!failed) return status;
    errno = fail_code;
    return -1;
}

int rename(const char *from, const char *to) {
    if ((is_below(AT_FDCWD, from) || is_below(AT_FDCWD, to)) && fails("rename", to)) return -1;
    return REAL(rename)(from, to);
}

int mkdir(const char *path, mode_t mode) {
    if (is_below(AT_FDCWD, path) && fails("mkdir", path)) return -1;
    return REAL(mkdir)(path, mode);
}

int unlink(const char *path) {
    if (is_below(AT_FDCWD, path) && fails("unlink", path)) return -1;
    return REAL(unlink)(path);
}

int rmdir(const char *path) {
    if (is_below(AT_FDCWD, path) && fails("rmdir", path)) return -1;
    return REAL(rmdir)(path);
}

int remove(const char *path) {
    if (is_below(AT_FDCWD, path) && fails("remove", path)) return -1;
    return REAL(remove)(path);
}

int flock(int descriptor, int operation) {
    if (is_watched(descriptor) && fails("flock", NULL)) return -1;
    return REAL(flock)(descriptor, operation);
}
