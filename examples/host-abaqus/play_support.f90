! SPDX-License-Identifier: BSD-3-Clause
!
! What the checks of play_abaqus.f90 share.
module play_support
  use abaqus_job
  use host_structure
  use host_analysis
  implicit none
  private
  public :: check, number, set_up, march, run, same, travel, exact, failures

  real(dp), parameter :: travel = 1.4e-3_dp       ! of the machine, m
  real(dp), parameter :: exact = 1e-12_dp         ! damage_tolerance of a host that wants 1e-10
  integer, protected :: failures = 0

contains

  subroutine check(good, what)
    logical, intent(in) :: good
    character(*), intent(in) :: what
    print '(2x,a,1x,a)', merge('ok    ', 'FAILED', good), what
    if (.not. good) failures = failures + 1
  end subroutine check

  function number(value) result(text)
    real(dp), intent(in) :: value
    character(:), allocatable :: text
    character(24) :: buffer
    write (buffer, '(es10.2)') value
    text = trim(adjustl(buffer))
  end function number

  ! tolerance: of the damage, `exact` without it; the host leaves residuals a hundred times as large.
  subroutine set_up(a, rule, limit, tolerance)
    type(analysis), intent(out) :: a
    integer, intent(in) :: rule, limit
    real(dp), intent(in), optional :: tolerance
    real(dp) :: damage
    damage = exact
    if (present(tolerance)) damage = tolerance
    call make_structure(a%s, rule, limit, damage)
    a%travel = travel
    a%tolerance = 100*damage
  end subroutine set_up

  ! Equal increments, from the first one after the present up to number `last` of `count`.
  subroutine march(a, last, count)
    type(analysis), intent(inout) :: a
    integer, intent(in) :: last, count
    real(dp) :: ratio
    do while (a%kinc < last)
      call try_increment(a, 1.0_dp/count, 0, ratio)
      if (ratio > 0) error stop 'an increment does not converge'
    end do
  end subroutine march

  subroutine run(a, rule, count)
    type(analysis), intent(out) :: a
    integer, intent(in) :: rule, count
    call set_up(a, rule, 0)
    call begin_analysis(a, .false.)
    call march(a, count, count)
    call end_analysis(a)
  end subroutine run

  logical function same(a, b)
    type(analysis), intent(in) :: a, b
    integer :: k
    same = size(a%history) == size(b%history) .and. all(a%u == b%u) .and. all(a%adhesion == b%adhesion) .and. &
           all(a%svars == b%svars) .and. all(a%energy == b%energy)
    do k = 1, merge(size(a%history), 0, same)
      associate (h => a%history(k), g => b%history(k))
        same = same .and. h%time == g%time .and. h%load == g%load .and. h%dissipated == g%dissipated .and. &
               h%stored == g%stored .and. h%work == g%work .and. all(h%residuals == g%residuals)
      end associate
    end do
  end function same
end module play_support
