/* SPDX-License-Identifier: BSD-3-Clause
 * What is thrown inside the archive ends there, as a status and a message: its own exception and std::bad_alloc. */
#define _POSIX_C_SOURCE 200809L
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "delam/delam.h"

static int status_is(const char *what, int32_t status, int32_t expected) {
    if (status == expected) return 0;
    fprintf(stderr, "%s: %s, expected %s\n", what, delam_status_name(status), delam_status_name(expected));
    return 1;
}

static int32_t layers(delam_context *context, double length, int64_t along, delam_mesh **mesh) {
    const double thickness[2] = {1.0, 1.0};
    const int64_t layer_divisions[2] = {1, 1};
    return delam_mesh_create_layers(context, 2, &length, &along, 2, thickness, layer_divisions, DELAM_QUAD4, mesh);
}

int main(void) {
    delam_context *context = NULL;
    delam_mesh *mesh = NULL;
    const struct rlimit little = {256u << 20, 256u << 20};
    int wrong = status_is("context", delam_context_create(&context), DELAM_OK);
    wrong += status_is("a negative length", layers(context, -1.5, 4, &mesh), DELAM_ERROR_ARGUMENT);
    if (strstr(delam_context_message(context), "-1.5") == NULL) {
        fprintf(stderr, "a negative length: the message is '%s'\n", delam_context_message(context));
        ++wrong;
    }
    wrong += status_is("a good length", layers(context, 1.5, 4, &mesh), DELAM_OK);
    delam_mesh_destroy(&mesh);
    setrlimit(RLIMIT_AS, &little);
    wrong +=
        status_is("a hundred million cells in 256 MiB", layers(context, 1.5, 100000000, &mesh), DELAM_ERROR_MEMORY);
    delam_context_destroy(&context);
    if (wrong == 0) puts("refused with a status, twice");
    return wrong == 0 ? 0 : 1;
}
