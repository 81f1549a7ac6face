! SPDX-License-Identifier: BSD-3-Clause
!
! libdelam for Fortran 2008 (with TS 29113, now in Fortran 2018): derived types over the interfaces of delam_raw.
!
! Rules for every procedure
!   status, message  optional. With `status` the caller handles an error (< 0) or an outcome (> 0), and `message`
!                    describes it (blank: done; truncated or padded like errmsg; context%message() has the full text).
!                    Without `status` anything but DELAM_OK writes the message to the error unit and ends the program
!                    by error stop.
!   arrays           as in delam.h with the axes reversed: C's [n][3] is (3,n). Contiguous ones are passed without a
!                    copy; the compiler copies others. Array results are allocated here and filled by the library.
!   indices          from 1, outputs too (0: none). Numbers that are not indices are as in C: labels of bodies (layers
!                    have 0, 1, ...; an absent `body` means all) and load steps (the initial state is step 0).
!                    A single index in a message of the library counts from 0.
!   objects          are made by create, and destroyed by destroy or when they leave their scope. Assignment makes a
!                    second name for the same object, which lives until its last name is gone; the context lives as
!                    long, and a law by Fortran procedures lives as long as a problem or solver uses it. (GNU Fortran 12
!                    copies objects wrongly when a derived type that contains them is assigned as a whole: assign them
!                    singly.)
module delam
  use delam_raw
  use delam_kinds, only: delam_real, delam_index, delam_byte, delam_label
  use delam_texts, only: delam_text
  use delam_callbacks, only: delam_observer, delam_host_law, delam_adhesion, delam_dissipation
  use delam_objects, only: delam_object
  use delam_descriptions, only: delam_version_text, delam_describe_option, delam_parameter_count, &
                                delam_describe_parameter, delam_parameter_bounds, delam_describe_kind
  use delam_contexts, only: delam_context
  use delam_meshes, only: delam_mesh
  use delam_laws, only: delam_law
  use delam_problems, only: delam_problem
  use delam_solvers, only: delam_solver
  implicit none
  public
  private :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double   ! of delam_raw

end module delam
