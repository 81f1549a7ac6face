! SPDX-License-Identifier: BSD-3-Clause
!
! Checks of one user element by itself, in the plane and in space.
module play_element
  use abaqus_job
  use host_structure
  use host_analysis
  use play_support
  implicit none
  private
  public :: derivative

contains

  ! Of one element: AMATRX against central differences of RHS, and what LFLAGS(3) selects.
  subroutine derivative(dimension, rule)
    integer, intent(in) :: dimension, rule   ! 0 converged, 1 frozen
    type(user_element) :: e
    real(dp), allocatable :: nodes(:,:), u(:), target(:), rhs(:), again(:), above(:), below(:), matrix(:,:), other(:,:)
    real(dp), allocatable :: shifted(:), committed(:)
    real(dp) :: svars(8), start(8), energy(8), trash(8), pnewdt, error, worst, asymmetry, h
    integer :: k, q, n
    logical :: repeated, selected
    call single_element(dimension, rule, e, nodes, target)
    n = size(target)
    allocate(rhs(n), again(n), above(n), below(n), matrix(n, n), other(n, n))
    h = 1e-10_dp
    svars = 0
    energy = 0
    worst = 0
    asymmetry = 0
    repeated = .true.
    selected = .true.
    committed = 0*target
    call begin_job('play_derivative')
    call uexternaldb(0, 0, [0.0_dp, 0.0_dp], 0.0_dp, 1, 0)
    do k = 1, 6
      u = target*k/6
      start = svars
      call call_with(u, 1, rhs, matrix)
      error = 0
      do q = 1, n
        shifted = u
        shifted(q) = u(q) + h
        call call_with(shifted, 5, above, other)
        selected = selected .and. all(other < -1e300_dp)
        shifted(q) = u(q) - h
        call call_with(shifted, 5, below, other)
        error = max(error, maxval(abs(matrix(:, q) + (above - below)/(2*h))))
      end do
      asymmetry = max(asymmetry, maxval(abs(matrix - transpose(matrix)))/maxval(abs(matrix)))
      if (k > 1) worst = max(worst, error/maxval(abs(matrix)))
      call call_with(u, 2, again, other)
      selected = selected .and. all(again == 0) .and. all(other == matrix)
      call call_with(u, 1, again, other)
      repeated = repeated .and. all(again == rhs) .and. all(other == matrix)
      svars = trash
      committed = u
    end do
    print '(2(i0,a),f7.4,2a,i0,2a)', dimension, 'D, ', n, ' displacements: dissipated', energy(4), &
      merge(' J/m', ' J  ', dimension == 2), ', pairs in contact ', nint(svars(6)), ', asymmetry of AMATRX ', &
      number(asymmetry)
    call check(energy(4) > 0, 'the element was damaged')
    if (rule == 0) call check(asymmetry > 1e-6_dp, 'AMATRX is not symmetric, because the mixity follows the jumps')
    call check(worst < 1e-6_dp, &
      'AMATRX and the differences of RHS agree to ' // number(worst) // ' of the largest entry')
    call check(repeated, 'the same displacements give the same digits again after others were tried')
    call check(selected, 'LFLAGS(3) = 2 and 5 select the stiffness and the forces')
    call uexternaldb(3, 0, [0.0_dp, 0.0_dp], 0.0_dp, 1, 0)

  contains

    subroutine call_with(displacements, wanted, forces, stiffness)
      real(dp), intent(in) :: displacements(:)
      integer, intent(in) :: wanted
      real(dp), intent(out) :: forces(:), stiffness(:,:)
      trash = start
      pnewdt = 1e9_dp
      call element_call(e, nodes, displacements, displacements - committed, trash, energy, wanted, real(k, dp), &
                        1.0_dp, k, forces, stiffness, pnewdt)
      if (pnewdt < 1) error stop 'a cut-back was asked for'
    end subroutine call_with
  end subroutine derivative

  ! In the plane the left strip of the structure; in space a strip whose nodes are two edges and the end opposite them.
  subroutine single_element(dimension, rule, e, nodes, target)
    integer, intent(in) :: dimension, rule
    type(user_element), intent(out) :: e
    real(dp), allocatable, intent(out) :: nodes(:,:), target(:)
    type(structure) :: s
    integer :: i, j
    call make_structure(s, rule, 0, exact)
    e = s%users(1)
    if (dimension == 2) then
      nodes = s%nodes
      target = spread(0.0_dp, 1, 2*size(e%nodes))
      target([2, 4, 6, 8]) = [-3e-4_dp, 2e-4_dp, 2e-4_dp, 2e-4_dp]
      return
    end if
    e%number = 103
    e%props(10:13) = [20, 2, 8, 4]*mm
    e%jprops(1:4) = [20, 1, 2, 1]
    nodes = reshape([(([0, 2*i, 4*j]*mm, i=0, 2), j=0, 1), (([20, 2*i, 2*j]*mm, i=0, 2), j=0, 2)], [3, 15])
    e%nodes = [(i, i=1, 15)]
    target = spread(0.0_dp, 1, 45)
    target(3:9:3) = -1e-4_dp
    target(12:18:3) = [1.0e-4_dp, 1.1e-4_dp, 1.2e-4_dp]
    target(10:16:3) = -1e-5_dp
  end subroutine single_element
end module play_element
