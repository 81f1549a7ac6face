! SPDX-License-Identifier: BSD-3-Clause
! Kinds of numbers: reals, indices, bytes of a saved state, labels of bodies.
module delam_kinds
  use, intrinsic :: iso_c_binding, only: c_int8_t, c_int32_t, c_int64_t, c_double
  implicit none
  private
  public :: delam_real, delam_index, delam_byte, delam_label

  integer, parameter :: delam_real = c_double
  integer, parameter :: delam_index = c_int64_t
  integer, parameter :: delam_byte = c_int8_t
  integer, parameter :: delam_label = c_int32_t
end module delam_kinds
