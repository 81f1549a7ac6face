! SPDX-License-Identifier: BSD-3-Clause
! What `abaqus user=abaqus_user.f90` compiles: one file, which includes the modules of libdelam (their folder is
! `pkg-config --variable=fortrandir delam`, in their order of compilation), the user element and its model.
include 'delam_raw.f90'
include 'delam_kinds.f90'
include 'delam_texts.f90'
include 'delam_callbacks.f90'
include 'delam_objects.f90'
include 'delam_statuses.f90'
include 'delam_descriptions.f90'
include 'delam_contexts.f90'
include 'delam_meshes.f90'
include 'delam_laws.f90'
include 'delam_problems.f90'
include 'delam_solvers.f90'
include 'delam.f90'
include 'delam_uel.f90'
include 'delam_uel_model.f90'
