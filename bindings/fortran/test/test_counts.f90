! SPDX-License-Identifier: BSD-3-Clause
! What the tests share: contracts that are counted.
module test_counts
  use delam, only: delam_real
  implicit none
  integer, parameter :: dp = delam_real
  integer :: checked = 0, broken_ones = 0

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what
    checked = checked + 1
    if (holds) return
    broken_ones = broken_ones + 1
    print '(2a)', 'does not hold: ', what
  end subroutine expect

  subroutine finish()
    print '(i0, a, i0, a)', checked, ' checked, ', broken_ones, ' broken'
    if (broken_ones > 0) error stop 1
  end subroutine finish
end module test_counts
