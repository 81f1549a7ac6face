! SPDX-License-Identifier: BSD-3-Clause
! Types that a host extends: its observer, its law.
module delam_callbacks
  use delam_kinds, only: delam_real, delam_index
  implicit none
  private
  public :: delam_observer, delam_host_law, delam_adhesion, delam_dissipation

  ! Extend it to receive log lines and progress, and to cancel. Either procedure may keep its default.
  type :: delam_observer
  contains
    procedure :: log => ignore_line
    procedure :: progress => ignore_progress
  end type delam_observer

  ! Extend it to define an interface law by Fortran procedures; the components of the extension are its parameters.
  type, abstract :: delam_host_law
  contains
    ! Adhesion on a first loading: the minimiser of adhesion*driving + g(mixity, adhesion) in [0,1], and its slope.
    procedure(delam_adhesion), deferred :: adhesion
    ! Energy g dissipated down to an adhesion, with its slopes in the adhesion and in the mixity.
    procedure(delam_dissipation), deferred :: dissipation
  end type delam_host_law

  abstract interface
    subroutine delam_adhesion(self, mixity, driving, adhesion, slope, failed)
      import :: delam_host_law, delam_real
      class(delam_host_law), intent(in) :: self
      real(delam_real), intent(in) :: mixity, driving
      real(delam_real), intent(out) :: adhesion, slope
      logical, intent(inout) :: failed
    end subroutine delam_adhesion
    subroutine delam_dissipation(self, mixity, adhesion, dissipated, slope, mixity_slope, failed)
      import :: delam_host_law, delam_real
      class(delam_host_law), intent(in) :: self
      real(delam_real), intent(in) :: mixity, adhesion
      real(delam_real), intent(out) :: dissipated, slope, mixity_slope
      logical, intent(inout) :: failed
    end subroutine delam_dissipation
  end interface

contains

  subroutine ignore_line(self, level, text)
    class(delam_observer), intent(inout) :: self
    integer, intent(in) :: level   ! 0 error, 1 warning, 2 information
    character(*), intent(in) :: text
  end subroutine ignore_line

  ! `total` 0: unknown. `cancel`, initially .false., ends the call with DELAM_CANCELLED unless it only reads.
  subroutine ignore_progress(self, stage, done, total, cancel)
    class(delam_observer), intent(inout) :: self
    character(*), intent(in) :: stage
    integer(delam_index), intent(in) :: done, total
    logical, intent(inout) :: cancel
  end subroutine ignore_progress

end module delam_callbacks
