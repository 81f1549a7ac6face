/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: a Scotch that takes no graph, so that PETSc's partitioning ends with an error of an external library. */
int SCOTCH_graphBuild(void);
int SCOTCH_dgraphBuild(void);

int SCOTCH_graphBuild(void) { return 1; }
int SCOTCH_dgraphBuild(void) { return 1; }
