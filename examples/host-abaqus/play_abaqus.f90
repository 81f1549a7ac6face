! SPDX-License-Identifier: BSD-3-Clause
!
! Plays Abaqus/Standard for the user element of delam_uel.f90: a static analysis of the structure of host_structure.f90,
! with checks. Any check that fails ends the program with an error.
!
!     host_abaqus CHECK      newton | cutback | whole | energy | restart | threads | derivative | refused | deck
program play_abaqus
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
  use abaqus_job
  use delam, only: delam_solver
  use host_structure
  use host_analysis
  use whole_structure
  use play_support
  use play_element
  use play_deck
  implicit none

  character(16) :: wanted
  integer :: rule

  interface
    integer(c_int) function setenv(name, value, overwrite) bind(c)
      import :: c_char, c_int
      character(c_char), intent(in) :: name(*), value(*)
      integer(c_int), value :: overwrite
    end function setenv
  end interface

  call get_command_argument(1, wanted)
  if (wanted /= 'deck') call begin_job('play_' // trim(wanted))
  select case (wanted)
  case ('newton')
    call newton(1, 'frozen')
    call newton(0, 'converged')
  case ('cutback')
    call forced_cut_backs()
    call natural_cut_backs()
  case ('whole')
    call whole(1, 'frozen', 20, 1e-8_dp, 1e-8_dp)
    call whole(0, 'converged', 20, 1e-8_dp, 1e-8_dp)
    call whole(2, 'converged in parts', 20, 1e-8_dp, 3e-2_dp)
    call whole(2, 'converged in parts', 160, 1e-8_dp, 1e-4_dp)
  case ('energy')
    call energy_balance()
  case ('restart')
    call restart()
  case ('threads')
    call threads()
  case ('deck')
    call write_deck()
  case ('derivative')
    do rule = 0, 1
      call derivative(2, rule)
      call derivative(3, rule)
    end do
  case ('refused')
    call refused()
  case default
    error stop 'host_abaqus newton | cutback | whole | energy | restart | threads | derivative | refused | deck'
  end select
  if (failures > 0) error stop 1

contains

  ! (a) The residuals of the host's Newton method, and of the same with a stiffness at fixed damage.
  subroutine newton(rule, name)
    integer, intent(in) :: rule
    character(*), intent(in) :: name
    real(dp), parameter :: floor = 2e-10_dp, bound = 1
    type(analysis) :: a, secant
    integer :: k, i, smooth, moving
    real(dp) :: ratio, worst, before
    call run(a, rule, 40)
    print '(3a)', 'mixity_rule = ', name, &
      '; *: other pairs in contact or softening than an iteration before'
    print '(a)', '  inc   machine N/m  dissipated J/m  advance of the fronts mm  residual / largest nodal force'
    smooth = 0
    moving = 0
    worst = 0
    before = 0
    do k = 1, size(a%history)
      associate (h => a%history(k))
        print '(i5,f14.1,f16.4,2f13.4,2x,*(es9.1,a1))', k, h%load, h%dissipated, h%fronts/mm, &
          (h%residuals(i), merge('*', ' ', h%changed(i) .and. i > 1), i=1, h%iterations)
        if (h%dissipated > before + 1e-3_dp) then
          moving = moving + 1
          do i = 1, h%iterations - 1
            if (h%changed(i + 1)) cycle
            ratio = h%residuals(i + 1)/h%residuals(i)**2
            if (h%residuals(i + 1) > floor) worst = max(worst, ratio)
            if (h%residuals(i) > 1e-4_dp .and. h%residuals(i + 1) <= bound*h%residuals(i)**2) smooth = smooth + 1
          end do
        end if
        before = h%dissipated
      end associate
    end do
    print '(a,i0,a,i0,2a)', '  in ', moving, ' increments with growing damage: ', smooth, &
      ' quadratic iterations; largest r(k+1)/r(k)^2 where the pairs stay the same: ', number(worst)
    call check(moving >= 30, 'the fronts move in 30 of 40 increments or more')
    call check(smooth >= 25, 'at least 25 iterations from a residual above 1e-4 are quadratic')
    call check(worst <= bound, 'no r(k+1)/r(k)^2 above ' // number(bound) // ' where the pairs stay the same')
    call check(maxval(a%history%iterations) <= 5, 'never more than 5 iterations')
    call set_up(secant, rule, 0)
    secant%secant = .true.
    call begin_analysis(secant, .false.)
    do k = 1, 12
      call try_increment(secant, 1.0_dp/40, 0, ratio)
      if (ratio > 0) exit
    end do
    call end_analysis(secant)
    print '(a,i0)', '  with a stiffness at fixed damage, increments that converge within 16 iterations: ', &
      size(secant%history)
    call check(ratio > 0, 'with a stiffness at fixed damage the iterations do not converge')
  end subroutine newton

  ! (c) Against the same structure as one scene of the library. Where the library follows a step in parts, the element
  ! does so at fixed displacements of its nodes and the scene at fixed travel of the machine: they are the same only in
  ! increments that are small enough to need no parts. Even then the scene, which follows its load, integrates what its
  ! pairs dissipate along a curve from increment to increment, and the element does not.
  subroutine whole(rule, name, count, close, close_dissipated)
    integer, intent(in) :: rule, count
    character(*), intent(in) :: name
    real(dp), intent(in) :: close, close_dissipated
    type(analysis) :: a
    type(delam_solver) :: solver
    real(dp), allocatable :: adhesion(:)
    real(dp) :: load, dissipated, stored, differences(4)
    integer :: k, interfaces(2)
    call set_up(a, rule, 0)
    call begin_analysis(a, .false.)
    call make_whole(a%s, travel, solver, interfaces)
    differences = 0
    do k = 1, count
      call march(a, k, count)
      call solver%advance(real(k, dp)/count)
      call solver%commit()
      load = solver%value('reaction:travel')
      dissipated = solver%value('dissipated')
      stored = solver%value('stored_bulk') + solver%value('stored_interface')
      adhesion = [pack(solver%field('adhesion', interfaces(1)), .true.), &
                  pack(solver%field('adhesion', interfaces(2)), .true.)]
      associate (h => a%history(k))
        differences = max(differences, [abs(h%load - load)/abs(load), abs(h%dissipated - dissipated), &
                                        abs(h%stored - stored)/stored, maxval(abs(a%adhesion - adhesion))])
      end associate
    end do
    differences(2) = differences(2)/dissipated
    print '(3a,i0,a)', 'against one scene of libdelam, mixity_rule = ', name, ', ', count, ' increments'
    print '(4(2x,a,1x,es8.1))', 'force', differences(1), 'dissipated', differences(2), 'stored', differences(3), &
      'adhesion', differences(4)
    call check(dissipated > 1, 'the structure cracks')
    call check(maxval(differences([1, 3, 4])) < close, 'the largest other differences are below ' // number(close))
    call check(differences(2) < close_dissipated, 'that of the dissipated energy is below ' // number(close_dissipated))
    call end_analysis(a)
  end subroutine whole

  ! (b) The library's state is rolled back: what was tried in vain leaves no trace.
  subroutine forced_cut_backs()
    integer, parameter :: count = 20
    type(analysis) :: plain, forced, silent
    real(dp) :: ratio, step
    integer :: k
    call run(plain, 0, count)
    step = 1.0_dp/count
    call set_up(forced, 0, 0)
    call begin_analysis(forced, .false.)
    do k = 1, count
      if (mod(k, 2) == 0) call try_increment(forced, 2*step, 2, ratio)
      if (mod(k, 3) == 0) call try_increment(forced, 1.5_dp*step, cut_off, ratio)
      call march(forced, k, count)
    end do
    call end_analysis(forced)
    call set_up(silent, 0, 0)
    silent%database = .false.
    call begin_analysis(silent, .false.)
    call march(silent, count, count)
    call end_analysis(silent)
    print '(i0,a,f8.4,a,f8.4,a)', forced%cut_backs, ' forced cut-backs: dissipated', &
      forced%history(count)%dissipated, ' J/m, without any', plain%history(count)%dissipated, ' J/m'
    call check(forced%cut_backs == 16, 'increments were abandoned after two iterations, or refused when converged')
    call check(plain%history(count)%dissipated > 1, 'the structure cracks')
    call check(same(forced, plain), 'with cut-backs every increment is the same to the last digit')
    call check(same(silent, plain), 'likewise if the host does not call UEXTERNALDB at the end of increments')
  end subroutine forced_cut_backs

  ! The library does not converge within few iterations, and the element asks for smaller increments. The increments
  ! that were accepted, without those that were not, give the same again.
  subroutine natural_cut_backs()
    ! Rounding must not decide whether three iterations are enough: 1e-8 and 1e-10 cut back the same increments.
    real(dp), parameter :: coarse = 1e-9_dp
    type(analysis) :: a, direct
    real(dp) :: ratio
    integer :: k, messages
    call begin_job('play_cutback')
    call set_up(a, 1, 3, coarse)
    call begin_analysis(a, .false.)
    call automatic(a, 0.5_dp, 1e-5_dp)
    call end_analysis(a)
    messages = message_count('the increment is too large', 2)
    call set_up(direct, 1, 3, coarse)
    call begin_analysis(direct, .false.)
    do k = 1, size(a%history)
      call try_increment(direct, a%history(k)%step, 0, ratio)
      if (ratio > 0) error stop 'an increment does not converge'
    end do
    call end_analysis(direct)
    print '(2(i0,a),f8.4,a,f8.4,a)', size(a%history), ' increments and ', a%cut_backs, ' cut-backs: dissipated', &
      a%history(size(a%history))%dissipated, ' J/m, the increments alone', &
      direct%history(size(a%history))%dissipated, ' J/m'
    call check(messages >= a%cut_backs .and. a%cut_backs >= 2, 'the element asked for cut-backs, and said why')
    call check(direct%cut_backs == 0 .and. same(a, direct), 'the increments alone give the same to the last digit')
  end subroutine natural_cut_backs

  ! (d) The work of the machine is stored or dissipated; the trapezoidal rule for the work has an error of second order.
  subroutine energy_balance()
    integer, parameter :: counts(4) = [20, 40, 80, 160]
    type(analysis) :: a
    real(dp) :: defect(4)
    integer :: i
    print '(a)', '  increments  work J/m    stored  dissipated  released   defect of work = stored + dissipated'
    do i = 1, 4
      call run(a, 0, counts(i))
      associate (h => a%history(counts(i)))
        defect(i) = abs(h%work - h%stored - h%dissipated)/h%work
        print '(i12,4f10.4,es12.1)', counts(i), h%work, h%stored, h%dissipated, h%released, defect(i)
      end associate
    end do
    call check(defect(1) < 1e-2_dp .and. defect(4) < 1e-4_dp, 'the energies balance')
    call check(defect(3) < 0.25_dp*defect(2) .and. defect(4) < 0.25_dp*defect(3), &
      'twice as many increments leave less than a quarter of the defect')
  end subroutine energy_balance

  ! A job that goes on for two increments after it has written its restart files, and another that continues from them.
  subroutine restart()
    integer, parameter :: count = 20, written = 11
    type(analysis) :: plain, first, second
    call run(plain, 0, count)
    call begin_job('play_first')
    call set_up(first, 0, 0)
    call begin_analysis(first, .false.)
    call march(first, written - 1, count)
    first%restart_files = 1
    call march(first, written, count)
    first%restart_files = 0
    second = first   ! what Abaqus reads from its own restart file
    call march(first, written + 2, count)
    call end_analysis(first)
    call begin_job('play_second')
    if (setenv('DELAM_UEL_OLDJOB' // c_null_char, 'play_first' // c_null_char, 1_c_int) /= 0) error stop 'setenv'
    call begin_analysis(second, .true.)
    call march(second, count, count)
    call end_analysis(second)
    call check(plain%history(count)%dissipated > 2*plain%history(written)%dissipated, &
      'the fronts move after the restart')
    call check(same(second, plain), 'the restarted job gives the same increments to the last digit')
  end subroutine restart

  ! Both user elements at the same time, in threads.
  subroutine threads()
    integer, parameter :: count = 20
    type(analysis) :: plain, threaded
    call run(plain, 0, count)
    call set_up(threaded, 0, 0)
    threaded%threads = 2
    call begin_analysis(threaded, .false.)
    call march(threaded, count, count)
    call end_analysis(threaded)
    call check(plain%history(count)%dissipated > 1, 'the structure cracks')
    call check(same(threaded, plain), 'two threads give the same to the last digit')
  end subroutine threads

  ! A deck whose element has a node where the mesh has none: ends with XIT.
  subroutine refused()
    type(analysis) :: a
    real(dp) :: ratio
    call set_up(a, 0, 0)
    a%s%users(2)%props(10) = 39*mm
    call begin_analysis(a, .false.)
    call try_increment(a, 0.05_dp, 0, ratio)
    error stop 'the element was accepted'
  end subroutine refused
end program play_abaqus
