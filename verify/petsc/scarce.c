/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: from SIGUSR1 on, this process gets no more blocks of DELAM_SCARCE bytes or more. */
#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>

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
