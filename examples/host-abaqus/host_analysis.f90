! SPDX-License-Identifier: BSD-3-Clause
!
! A static analysis as Abaqus/Standard does it: Newton's method in increments of the time, each begun by extrapolation,
! repeated with a smaller one if an element asks for it (PNEWDT) or if the iterations do not converge. Beyond what
! Abaqus sees, `assemble` looks into the elements, to tell in which iterations their contact or softening pairs change:
! between such iterations the forces have a kink, so that the square of the error does not bound the next one.
module host_analysis
  use abaqus_job, only: dp, uel, uexternaldb
  use delam_uel_elements, only: element, element_of
  use host_structure
  implicit none
  private
  public :: analysis, increment, begin_analysis, try_increment, automatic, end_analysis, cut_off, element_call

  integer, parameter :: limit = 16       ! of iterations
  integer, parameter :: variables = 8    ! of a user element

  ! What is kept of a converged increment.
  type :: increment
    real(dp) :: time = 0, step = 0, load = 0, stored = 0, dissipated = 0, released = 0, work = 0, fronts(2) = 0
    integer :: iterations = 0
    real(dp) :: residuals(limit) = 0     ! of each iteration, relative to the largest nodal force
    logical :: changed(limit) = .true.   ! pairs in contact, softening or debonded: others than an iteration before
  end type increment

  type :: analysis
    type(structure) :: s
    real(dp) :: travel = 0               ! of the machine at time 1
    real(dp) :: tolerance = 0            ! of the residual, relative
    logical :: database = .true.         ! calls UEXTERNALDB in each increment
    integer :: threads = 1               ! that call the user elements at the same time
    logical :: secant = .false.          ! takes the stiffness at fixed damage and contact in place of AMATRX
    integer :: restart_files = 0         ! LRESTART
    integer :: kinc = 0
    real(dp) :: time = 0, last_step = 0
    real(dp), allocatable :: u(:), last_change(:)
    real(dp) :: svars(variables, 2) = 0, energy(8, 2) = 0
    real(dp), allocatable :: adhesion(:) ! of all pairs
    type(increment), allocatable :: history(:)
    integer :: cut_backs = 0
  end type analysis

  ! Of one user element to the equations of an iteration.
  type :: contribution
    integer, allocatable :: dofs(:)
    real(dp), allocatable :: rhs(:), matrix(:,:)
    real(dp) :: pnewdt = 0
  end type contribution

  integer, parameter :: cut_off = 2147483647   ! a converged increment is refused

contains

  ! again: continues a job from its restart files, in the state `a` has.
  subroutine begin_analysis(a, again)
    type(analysis), intent(inout) :: a
    logical, intent(in) :: again
    if (.not. again) then
      a%u = spread(0.0_dp, 1, 2*a%s%node_count)
      a%last_change = a%u
      allocate(a%history(0))
    end if
    call uexternaldb(merge(4, 0, again), 0, [a%time, a%time], 0.0_dp, 1, a%kinc)
    if (a%database) call uexternaldb(5, 0, [a%time, a%time], 0.0_dp, 1, a%kinc)
  end subroutine begin_analysis

  subroutine end_analysis(a)
    type(analysis), intent(inout) :: a
    if (a%database) call uexternaldb(6, 0, [a%time, a%time], 0.0_dp, 1, a%kinc)
    call uexternaldb(3, 0, [a%time, a%time], 0.0_dp, 1, a%kinc)
  end subroutine end_analysis

  ! One call of UEL, as Abaqus makes it: SVARS and ENERGY come as they were at the start of the increment.
  subroutine element_call(e, nodes, u, du, svars, energy, wanted, time, dtime, kinc, rhs, matrix, pnewdt)
    type(user_element), intent(in) :: e
    real(dp), intent(in) :: nodes(:,:), u(:), du(:), time, dtime
    integer, intent(in) :: wanted, kinc
    real(dp), intent(inout) :: svars(:), energy(8), pnewdt
    real(dp), intent(out) :: rhs(:), matrix(:,:)
    real(dp) :: forces(size(u), 1), changes(size(u), 1), zero(size(u)), predefined(2, 1, size(e%nodes))
    zero = 0
    predefined = 0
    changes(:, 1) = du
    forces = -huge(1.0_dp)
    matrix = -huge(1.0_dp)
    call uel(forces, matrix, svars, energy, size(u), 1, size(svars), e%props, size(e%props), nodes(:, e%nodes), &
             size(nodes, 1), size(e%nodes), u, changes, zero, zero, 1, [time, time], dtime, 1, kinc, e%number, &
             [0.0_dp], 0, reshape([0], [1, 1]), reshape([0.0_dp], [1, 1]), predefined, 1, [1, 0, wanted, 0, 0], &
             size(u), reshape([0.0_dp], [1, 1]), 1, pnewdt, e%jprops, size(e%jprops), 1.0_dp)
    rhs = forces(:, 1)
  end subroutine element_call

  ! Internal forces and stiffness of the structure at a%u + change.
  subroutine assemble(a, change, dtime, svars, energies, forces, stiffness, stored, pnewdt)
    type(analysis), intent(in) :: a
    real(dp), intent(in) :: change(:), dtime
    real(dp), intent(out) :: svars(variables, 2), energies(8, 2), stored, pnewdt
    real(dp), intent(out), contiguous :: forces(:), stiffness(:,:)
    type(contribution) :: parts(size(a%s%users))
    integer :: i
    forces = 0
    stiffness = 0
    stored = 0
    call host_forces(a%s, a%u + change, forces, stiffness, stored)
    svars = a%svars
    energies = a%energy
    !$omp parallel do num_threads(a%threads) schedule(static, 1)
    do i = 1, size(parts)
      call contribute(a, i, change, dtime, svars(:, i), energies(:, i), parts(i))
    end do
    do i = 1, size(parts)
      associate (p => parts(i))
        forces(p%dofs) = forces(p%dofs) - p%rhs
        stiffness(p%dofs, p%dofs) = stiffness(p%dofs, p%dofs) + p%matrix
        stored = stored + energies(2, i)
      end associate
    end do
    pnewdt = minval(parts%pnewdt)
  end subroutine assemble

  subroutine contribute(a, i, change, dtime, svars, energies, part)
    type(analysis), intent(in) :: a
    integer, intent(in) :: i
    real(dp), intent(in) :: change(:), dtime
    real(dp), intent(inout) :: svars(:), energies(8)
    type(contribution), intent(inout) :: part
    integer :: n
    associate (e => a%s%users(i))
      part%dofs = [(2*e%nodes(n) - 1, 2*e%nodes(n), n=1, size(e%nodes))]
      n = size(part%dofs)
      allocate(part%rhs(n), part%matrix(n, n))
      part%pnewdt = 1e9_dp
      call element_call(e, a%s%nodes, a%u(part%dofs) + change(part%dofs), change(part%dofs), svars, energies, 1, &
                        a%time + dtime, dtime, a%kinc + 1, part%rhs, part%matrix, part%pnewdt)
      if (a%secant .and. part%pnewdt >= 1) part%matrix = fixed_damage(e%number, n)
    end associate
  end subroutine contribute

  function fixed_damage(number, n) result(matrix)
    integer, intent(in) :: number, n
    real(dp) :: matrix(n, n)
    type(element), pointer :: it
    it => element_of(number)
    matrix = it%solver%tangent()
  end function fixed_damage

  ! A field of pairs of all user elements, in their trial steps.
  function pairs(s, key) result(values)
    type(structure), intent(in) :: s
    character(*), intent(in) :: key
    real(dp), allocatable :: values(:)
    type(element), pointer :: it
    integer :: i
    allocate(values(0))
    do i = 1, size(s%users)
      it => element_of(s%users(i)%number)
      values = [values, reshape(it%solver%field(key), [size(it%solver%field(key))])]
    end do
  end function pairs

  ! What distinguishes the smooth pieces of the forces: of each pair, whether it is in contact, and whether it has lost
  ! no adhesion in this increment, some, or all.
  function sets(a) result(marks)
    type(analysis), intent(in) :: a
    integer, allocatable :: marks(:)
    real(dp), allocatable :: adhesion(:), before(:)
    adhesion = pairs(a%s, 'adhesion')
    before = spread(1.0_dp, 1, size(adhesion))
    if (allocated(a%adhesion)) before = a%adhesion
    marks = nint(pairs(a%s, 'contact')) + merge(2, 0, adhesion < before) + merge(4, 0, adhesion <= 0)
  end function sets

  ! Newton's method for one increment. stop_after: gives up after so many iterations (0: as many as it takes; cut_off:
  ! refuses the increment when it has converged). ratio: 0 if the increment was accepted, or else the one that is
  ! suggested for a smaller step.
  subroutine try_increment(a, dtime, stop_after, ratio)
    type(analysis), intent(inout) :: a
    real(dp), intent(in) :: dtime
    integer, intent(in) :: stop_after
    real(dp), intent(out) :: ratio
    real(dp), allocatable :: change(:), forces(:), stiffness(:,:)
    real(dp) :: svars(variables, 2), energies(8, 2), stored, pnewdt
    type(increment) :: now
    integer, allocatable :: marks(:), marks_before(:)
    integer :: k
    if (a%database) call uexternaldb(1, 0, [a%time, a%time], dtime, 1, a%kinc + 1)
    allocate(forces(size(a%u)), stiffness(size(a%u), size(a%u)))
    change = a%last_change
    if (a%last_step > 0) change = change*(dtime/a%last_step)
    change(a%s%driven) = a%travel*(a%time + dtime) - a%u(a%s%driven)
    do k = 1, limit
      call assemble(a, change, dtime, svars, energies, forces, stiffness, stored, pnewdt)
      ratio = pnewdt
      if (pnewdt < 1) exit
      ratio = 0.25_dp
      now%iterations = k
      marks = sets(a)
      if (k > 1) now%changed(k) = any(marks /= marks_before)
      marks_before = marks
      now%residuals(k) = maxval(abs(forces(a%s%free)))/maxval(abs(forces))
      if (now%residuals(k) <= a%tolerance .and. k > 1) then
        if (stop_after == cut_off) exit
        call keep(a, dtime, change, forces, svars, energies, stored, now)
        ratio = 0
        return
      end if
      if (k == stop_after) exit
      call correct(a%s, stiffness, forces, change)
    end do
    a%cut_backs = a%cut_backs + 1
  end subroutine try_increment

  ! The work of the machine is the integral of its force, by the trapezoidal rule.
  subroutine keep(a, dtime, change, forces, svars, energies, stored, now)
    type(analysis), intent(inout) :: a
    real(dp), intent(in) :: dtime, change(:), forces(:), svars(variables, 2), energies(8, 2), stored
    type(increment), intent(inout) :: now
    real(dp) :: load_before, work_before
    load_before = 0
    work_before = 0
    if (size(a%history) > 0) load_before = a%history(size(a%history))%load
    if (size(a%history) > 0) work_before = a%history(size(a%history))%work
    a%u = a%u + change
    a%last_change = change
    a%last_step = dtime
    a%svars = svars
    a%energy = energies
    a%adhesion = pairs(a%s, 'adhesion')
    a%time = a%time + dtime
    a%kinc = a%kinc + 1
    now%time = a%time
    now%step = dtime
    now%load = sum(forces(a%s%driven))
    now%stored = stored
    now%dissipated = sum(energies(4, :))
    now%released = sum(energies(5, :))
    now%fronts = svars(4, :)
    now%work = work_before + 0.5_dp*(load_before + now%load)*a%travel*dtime
    a%history = [a%history, now]
    if (a%database) call uexternaldb(2, a%restart_files, [a%time, a%time], dtime, 1, a%kinc)
  end subroutine keep

  ! Increments of automatic size, from `first` on, up to time 1.
  subroutine automatic(a, first, smallest)
    type(analysis), intent(inout) :: a
    real(dp), intent(in) :: first, smallest
    real(dp) :: dtime, ratio
    dtime = first
    do while (a%time < 1 - 1e-9_dp)
      dtime = min(dtime, 1 - a%time)
      call try_increment(a, dtime, 0, ratio)
      if (ratio > 0) then
        print '(2x,a,f9.6,a,f9.6,a,f5.2)', 'increment from', a%time, ' by', dtime, ': cut back to times', ratio
        dtime = dtime*ratio
        if (dtime < smallest) error stop 'the increment has become too small'
      else if (a%history(size(a%history))%iterations <= 5) then
        dtime = 1.5_dp*dtime
      end if
    end do
  end subroutine automatic

  ! Newton's correction of the free displacements. The matrix need not be symmetric; it is overwritten.
  subroutine correct(s, matrix, forces, change)
    type(structure), intent(in) :: s
    real(dp), intent(inout), contiguous :: matrix(:,:), change(:)
    real(dp), intent(in) :: forces(:)
    real(dp) :: x(size(forces))
    integer :: i
    x = 0
    x(s%free) = -forces(s%free)
    do i = 1, size(forces)
      if (any(s%free == i)) cycle
      matrix(:, i) = 0
      matrix(i, :) = 0
      matrix(i, i) = 1
    end do
    call solve(matrix, x)
    change = change + x
  end subroutine correct

  ! Elimination with row exchanges, in place.
  subroutine solve(a, x)
    real(dp), intent(inout), contiguous :: a(:,:), x(:)
    real(dp) :: row(size(x)), other
    integer :: i, j, n, best
    n = size(x)
    do i = 1, n
      best = i - 1 + maxloc(abs(a(i:, i)), 1)
      if (best /= i) then
        row = a(i, :)
        a(i, :) = a(best, :)
        a(best, :) = row
        other = x(i)
        x(i) = x(best)
        x(best) = other
      end if
      a(i+1:, i) = a(i+1:, i)/a(i, i)
      do j = i + 1, n
        if (a(i, j) == 0) cycle
        a(i+1:, j) = a(i+1:, j) - a(i+1:, i)*a(i, j)
      end do
      x(i+1:) = x(i+1:) - a(i+1:, i)*x(i)
    end do
    do i = n, 1, -1
      x(i) = x(i)/a(i, i)
      x(:i-1) = x(:i-1) - a(:i-1, i)*x(i)
    end do
  end subroutine solve
end module host_analysis
