! SPDX-License-Identifier: BSD-3-Clause
!
! libdelam for Fortran 2008 (with TS 29113, now in Fortran 2018): derived types over the interfaces of delam_raw.
!
! What every procedure here keeps to
!   status, message  optional. With `status` the caller decides what to do about an error (< 0) or an outcome (> 0), and
!                    `message` says it in words (blank: done; cut off or padded like errmsg, context%message() has it
!                    whole). Without `status` anything but DELAM_OK ends the program by error stop, after the message
!                    went to the error unit.
!   arrays           as in delam.h with the axes reversed: C's [n][3] is (3,n). Contiguous ones are handed over where
!                    they are; the compiler copies others. Array results are allocated here and filled by the library.
!   indices          from 1, outputs too (0: none). Numbers that are not indices are as in C: labels of bodies (layers
!                    have 0, 1, ...; where `body` is absent all are meant) and load steps (the initial state is step 0).
!                    Where a message of the library names a single index it counts from 0.
!   objects          are made by create, destroyed when they leave their scope or by destroy. An assignment makes a
!                    second name of the same object, which lives until the last one is gone; so does the context,
!                    and a law by Fortran procedures as long as a problem or solver uses it. (GNU Fortran 12 copies
!                    objects wrongly when a derived type that contains them is assigned as a whole: assign them singly.)
module delam
  use delam_raw
  use delam_kinds, only: delam_real, delam_index, delam_byte, delam_label
  use delam_texts, only: delam_text
  use delam_callbacks, only: delam_observer, delam_host_law, delam_adhesion, delam_dissipation
  use delam_objects, only: delam_object
  use delam_descriptions, only: delam_version_text, delam_describe_option, delam_parameter_count, &
                                delam_describe_parameter
  use delam_contexts, only: delam_context
  use delam_meshes, only: delam_mesh
  use delam_laws, only: delam_law
  use delam_problems, only: delam_problem
  use delam_solvers, only: delam_solver
  implicit none
  public
  private :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double   ! of delam_raw

end module delam
