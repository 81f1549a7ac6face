! SPDX-License-Identifier: BSD-3-Clause
!
! The structure that play_abaqus.f90 analyses, in the plane (plane strain, per metre of width): two strips that
! delaminate, each a user element, joined by elements of the host itself, elastic quadrilaterals.
!
!                 machine
!       ========================      crossbeam           (host)
!       ||                    ||      legs                (host)
!       ---------......---------      upper layers        (user elements, a block of the host between them)
!       =====____      ____=====      interfaces, notched at the outer ends
!       ---------......---------      lower layers
!       ^                      ^      held
!
! The notches differ, so that the two elements crack one after the other and unload each other.
module host_structure
  use abaqus_job, only: dp
  implicit none
  private
  public :: structure, user_element, make_structure, host_forces, quad_stiffness, young, poisson, mm

  real(dp), parameter :: mm = 1e-3_dp, young = 70e9_dp, poisson = 0.3_dp
  real(dp), parameter :: strip = 40, layer = 2, block = 16, leg = 2, top = 8, beam = 8   ! mm

  type :: user_element
    integer :: number
    integer, allocatable :: nodes(:)
    real(dp) :: props(13)
    integer :: jprops(6)
  end type user_element

  type :: structure
    integer :: node_count = 0
    real(dp), allocatable :: nodes(:,:)
    integer, allocatable :: quads(:,:)
    type(user_element) :: users(2)
    integer, allocatable :: held(:), driven(:)     ! displacements at 0, and moved by the machine
    integer, allocatable :: free(:)
  end type structure

contains

  ! rule: of the mixity, as JPROPS(5) of delam_uel_model.f90; limit: of the library's minimisation, 0: default;
  ! tolerance: of its damage.
  subroutine make_structure(s, rule, limit, tolerance)
    type(structure), intent(out) :: s
    integer, intent(in) :: rule, limit
    real(dp), intent(in) :: tolerance
    real(dp) :: right
    integer :: i
    logical, allocatable :: fixed(:)
    right = 2*strip + block
    allocate(s%nodes(2, 0), s%quads(4, 0))
    call add_grid(s, [(strip + 2*i, i=0, 8)]*mm, [(i, i=0, 4)]*mm)
    call add_grid(s, [0, 1, 2]*mm, [4, 6, 8]*mm)
    call add_grid(s, (right - [2, 1, 0])*mm, [4, 6, 8]*mm)
    call add_grid(s, [0.0_dp, 1.0_dp, (2.0_dp + 4*i, i=0, 23), right - 1, right]*mm, (top + [0, 4, 8])*mm)
    s%users(1) = strip_element(s, 101, 0.0_dp, 12.0_dp, 1)
    s%users(2) = strip_element(s, 102, strip + block, 15.0_dp, 2)
    do i = 1, 2
      s%users(i)%props(9) = tolerance
      s%users(i)%jprops(5:6) = [rule, limit]
    end do
    s%held = [dof(s, 0.0_dp, 0.0_dp, 1), dof(s, 0.0_dp, 0.0_dp, 2), dof(s, right, 0.0_dp, 2)]
    s%driven = [(dof(s, 46.0_dp + 4*i, top + beam, 2), i=0, 1)]
    allocate(fixed(2*s%node_count))
    fixed = .false.
    fixed(s%held) = .true.
    fixed(s%driven) = .true.
    s%free = pack([(i, i=1, size(fixed))], .not. fixed)
  end subroutine make_structure

  ! Nodes on the lines x and y that do not exist yet, and the quadrilaterals between them.
  subroutine add_grid(s, x, y)
    type(structure), intent(inout) :: s
    real(dp), intent(in) :: x(:), y(:)
    integer :: i, j, at(size(x), size(y))
    do j = 1, size(y)
      do i = 1, size(x)
        at(i, j) = node_at(s, x(i), y(j))
      end do
    end do
    do j = 1, size(y) - 1
      do i = 1, size(x) - 1
        s%quads = reshape([s%quads, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], [4, size(s%quads, 2) + 1])
      end do
    end do
  end subroutine add_grid

  integer function node_at(s, x, y)
    type(structure), intent(inout) :: s
    real(dp), intent(in) :: x, y
    do node_at = 1, s%node_count
      if (maxval(abs(s%nodes(:, node_at) - [x, y])) < 1e-9_dp) return
    end do
    s%nodes = reshape([s%nodes, x, y], [2, s%node_count + 1])
    s%node_count = s%node_count + 1
    node_at = s%node_count
  end function node_at

  ! x, y in mm
  integer function dof(s, x, y, axis)
    type(structure), intent(inout) :: s
    real(dp), intent(in) :: x, y
    integer, intent(in) :: axis
    dof = 2*(node_at(s, x*mm, y*mm) - 1) + axis
  end function dof

  ! A strip from x = left on, notched at end 1 (left) or 2 (right); it shares nodes with the block and a leg.
  function strip_element(s, number, left, notch, end) result(e)
    type(structure), intent(inout) :: s
    integer, intent(in) :: number, end
    real(dp), intent(in) :: left, notch
    type(user_element) :: e
    real(dp) :: outer, inner, foot(3)
    integer :: i
    outer = merge(left, left + strip, end == 1)
    inner = merge(left + strip, left, end == 1)
    foot = merge(left, left + strip - leg, end == 1) + [0, 1, 2]
    e%number = number
    allocate(e%nodes(9))
    e%nodes(1) = node_at(s, outer*mm, 0.0_dp)
    do i = 1, 3
      e%nodes(1 + i) = node_at(s, foot(i)*mm, 2*layer*mm)
    end do
    do i = 0, 4
      e%nodes(5 + i) = node_at(s, inner*mm, i*mm)
    end do
    e%props = [young, poisson, 1e12_dp, 1e12_dp, 20.0_dp, 40.0_dp, 200.0_dp, 500.0_dp, 0.0_dp, strip*mm, layer*mm, &
               notch*mm, 0.0_dp]
    e%jprops = [40, 2, 0, end, 0, 0]
  end function strip_element

  ! Stiffness of a rectangle of width w and height h, in plane strain, by four points of Gauss.
  function quad_stiffness(w, h) result(k)
    real(dp), intent(in) :: w, h
    real(dp) :: k(8, 8), b(3, 8), c(3, 3), dx(4), dy(4), xi, eta
    real(dp), parameter :: sx(4) = [-1, 1, 1, -1], sy(4) = [-1, -1, 1, 1]
    integer :: g
    c = 0
    c(1, 1) = 1 - poisson
    c(2, 2) = 1 - poisson
    c(1, 2) = poisson
    c(2, 1) = poisson
    c(3, 3) = (1 - 2*poisson)/2
    c = c*young/((1 + poisson)*(1 - 2*poisson))
    k = 0
    do g = 1, 4
      xi = sx(g)/sqrt(3.0_dp)
      eta = sy(g)/sqrt(3.0_dp)
      dx = sx*(1 + eta*sy)/(2*w)
      dy = sy*(1 + xi*sx)/(2*h)
      b = 0
      b(1, 1::2) = dx
      b(2, 2::2) = dy
      b(3, 1::2) = dy
      b(3, 2::2) = dx
      k = k + matmul(transpose(b), matmul(c, b))*w*h/4
    end do
  end function quad_stiffness

  ! Adds forces and stiffness of the host's own elements; energy: what they store.
  subroutine host_forces(s, u, forces, stiffness, energy)
    type(structure), intent(in) :: s
    real(dp), intent(in) :: u(:)
    real(dp), intent(inout) :: forces(:), stiffness(:,:), energy
    real(dp) :: k(8, 8), f(8), size_of(2)
    integer :: e, d(8)
    do e = 1, size(s%quads, 2)
      size_of = s%nodes(:, s%quads(3, e)) - s%nodes(:, s%quads(1, e))
      k = quad_stiffness(size_of(1), size_of(2))
      d(1::2) = 2*s%quads(:, e) - 1
      d(2::2) = 2*s%quads(:, e)
      f = matmul(k, u(d))
      forces(d) = forces(d) + f
      stiffness(d, d) = stiffness(d, d) + k
      energy = energy + 0.5_dp*dot_product(u(d), f)
    end do
  end subroutine host_forces
end module host_structure
