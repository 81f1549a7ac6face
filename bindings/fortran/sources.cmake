# SPDX-License-Identifier: BSD-3-Clause
# The Fortran modules, a file each, in the order of compilation.
set(DELAM_FORTRAN_MODULES delam_raw delam_kinds delam_texts delam_callbacks delam_objects delam_statuses
    delam_descriptions delam_contexts delam_meshes delam_laws delam_problems delam_solvers delam)
