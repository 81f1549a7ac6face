/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: from SIGUSR1 on, this process gets no more blocks of DELAM_SCARCE bytes or more; once MPI has begun, its
   address space grows by DELAM_SCARCE_GROWTH bytes at most (before that, it is MPI that would run out of memory). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

static size_t limit = (size_t)-1, armed = (size_t)-1;

static void arm(int number) {
    (void)number;
    limit = armed;
}

__attribute__((constructor)) static void begin(void) {
    const char *text = getenv("DELAM_SCARCE");
    if (text == NULL) return;
    armed = (size_t)strtoull(text, NULL, 10);
    signal(SIGUSR1, arm);
}

static void *refused(void) {
    errno = ENOMEM;
    return NULL;
}

void *malloc(size_t size) { return size >= limit ? refused() : __libc_malloc(size); }

void *calloc(size_t count, size_t size) {
    return size > 0 && count >= limit / size ? refused() : __libc_calloc(count, size);
}

void *realloc(void *block, size_t size) { return size >= limit ? refused() : __libc_realloc(block, size); }

static void bound_growth(const char *growth) {
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%llu", &pages) != 1) abort();
    fclose(file);
    const rlim_t most = (rlim_t)(pages * (unsigned long long)sysconf(_SC_PAGESIZE) + strtoull(growth, NULL, 10));
    const struct rlimit bound = {most, most};
    if (setrlimit(RLIMIT_AS, &bound) != 0) abort();
}

int MPI_Init(int *argc, char ***argv);

int MPI_Init(int *argc, char ***argv) {
    int (*begin_mpi)(int *, char ***);
    *(void **)&begin_mpi = dlsym(RTLD_NEXT, "MPI_Init");
    const int status = begin_mpi(argc, argv);
    const char *growth = getenv("DELAM_SCARCE_GROWTH");
    if (growth != NULL) bound_growth(growth);
    return status;
}
