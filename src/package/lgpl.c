// SPDX-License-Identifier: BSD-3-Clause
// External names of the LGPL modules of CHOLMOD (lgpl.cmake): functions of its supernodal module, which report that
// they are missing, and the C library's streams.
#include <stdio.h>
#include <suitesparse/cholmod.h>

extern FILE *delam_cholmod_stdout, *delam_cholmod_stderr;
FILE *delam_cholmod_stdout, *delam_cholmod_stderr;

__attribute__((constructor)) static void name_streams(void) {
    delam_cholmod_stdout = stdout;
    delam_cholmod_stderr = stderr;
}

static int absent(cholmod_common *common) {
    common->status = CHOLMOD_NOT_INSTALLED;
    return 0;
}

int cholmod_l_super_symbolic2(int for_whom, cholmod_sparse *a, cholmod_sparse *f, SuiteSparse_long *parent,
                              cholmod_factor *l, cholmod_common *common) {
    (void)for_whom, (void)a, (void)f, (void)parent, (void)l;
    return absent(common);
}

int cholmod_l_super_numeric(cholmod_sparse *a, cholmod_sparse *f, double *beta, cholmod_factor *l,
                            cholmod_common *common) {
    (void)a, (void)f, (void)beta, (void)l;
    return absent(common);
}

int cholmod_l_super_lsolve(cholmod_factor *l, cholmod_dense *x, cholmod_dense *e, cholmod_common *common) {
    (void)l, (void)x, (void)e;
    return absent(common);
}

int cholmod_l_super_ltsolve(cholmod_factor *l, cholmod_dense *x, cholmod_dense *e, cholmod_common *common) {
    (void)l, (void)x, (void)e;
    return absent(common);
}
