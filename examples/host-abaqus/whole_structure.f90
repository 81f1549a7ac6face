! SPDX-License-Identifier: BSD-3-Clause
!
! The structure of host_structure.f90 as one scene of libdelam, without host and user elements: the other route to the
! same results. Bodies 0 to 3 are the layers, body 4 is what the host has there; perfect bonds join it to the layers.
module whole_structure
  use delam
  use host_structure
  implicit none
  private
  public :: make_whole

  integer, parameter :: dp = delam_real

contains

  subroutine make_whole(s, travel, solver, interfaces)
    type(structure), intent(in) :: s
    real(dp), intent(in) :: travel      ! of the machine at time 1
    type(delam_solver), intent(out) :: solver
    integer, intent(out) :: interfaces(2)   ! those of the user elements
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    call context%create()
    call make_mesh(s, context, mesh)
    call problem%create(context, mesh)
    call problem%set_elastic(young, poisson)
    call problem%set_formulation('standard', body=4)   ! as the host assembles it
    call join(s, context, mesh, problem, interfaces)
    call hold(s, travel, mesh, problem)
    call problem%set('damage_tolerance', s%users(1)%props(9))
    call problem%set('kinematics', 'linear')            ! as the elements have them
    if (s%users(1)%jprops(5) == 0) call problem%set('path_step', 1.0_dp)
    if (s%users(1)%jprops(5) == 1) call problem%set('mixity_rule', 'frozen')
    call solver%create(problem, 0.0_dp)
  end subroutine make_whole

  subroutine make_mesh(s, context, mesh)
    type(structure), intent(in) :: s
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(inout) :: mesh
    integer(delam_index), allocatable :: cells(:,:)
    real(dp), allocatable :: nodes(:,:)
    integer(delam_label), allocatable :: bodies(:)
    integer :: i
    allocate(bodies(0))
    allocate(cells(4, 0))
    nodes = s%nodes
    do i = 1, size(s%users)
      call add_strip(s, i, nodes, cells, bodies)
    end do
    cells = reshape([cells, int(s%quads, delam_index)], [4, size(cells, 2) + size(s%quads, 2)])
    bodies = [bodies, spread(4_delam_label, 1, size(s%quads, 2))]
    call mesh%create(context, nodes)
    call mesh%add_conforming_cells(DELAM_QUAD4, cells, bodies)
    call mesh%add_all_interfaces()
  end subroutine make_mesh

  ! Both layers of user element i; where layers and host meet they name the same node.
  subroutine add_strip(s, i, nodes, cells, bodies)
    type(structure), intent(in) :: s
    integer, intent(in) :: i
    real(dp), allocatable, intent(inout) :: nodes(:,:)
    integer(delam_index), allocatable, intent(inout) :: cells(:,:)
    integer(delam_label), allocatable, intent(inout) :: bodies(:)
    integer :: along, through, x, y
    integer(delam_index), allocatable :: at(:,:)
    real(dp) :: corner(2), edge(2)
    along = s%users(i)%jprops(1)
    through = s%users(i)%jprops(2)
    corner = minval(s%nodes(:, s%users(i)%nodes), 2)
    edge = s%users(i)%props(10:11)/[along, through]
    allocate(at(0:along, 0:2*through))
    do y = 0, 2*through
      do x = 0, along
        call find_or_add(nodes, corner + edge*[x, y], at(x, y))
      end do
    end do
    do y = 1, 2*through
      do x = 1, along
        cells = reshape([cells, at(x - 1, y - 1), at(x, y - 1), at(x, y), at(x - 1, y)], [4, size(cells, 2) + 1])
        bodies = [bodies, int(2*i - 2 + (y - 1)/through, delam_label)]
      end do
    end do
  end subroutine add_strip

  subroutine find_or_add(nodes, place, at)
    real(dp), allocatable, intent(inout) :: nodes(:,:)
    real(dp), intent(in) :: place(2)
    integer(delam_index), intent(out) :: at
    do at = 1, size(nodes, 2)
      if (maxval(abs(nodes(:, at) - place)) < 1e-9_dp) return
    end do
    nodes = reshape([nodes, place], [2, size(nodes, 2) + 1])
  end subroutine find_or_add

  ! Laws and notches of the strips, perfect bonds elsewhere; the layers as delam_uel_model has them.
  subroutine join(s, context, mesh, problem, interfaces)
    type(structure), intent(in) :: s
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: mesh
    type(delam_problem), intent(in) :: problem
    integer, intent(out) :: interfaces(2)
    integer(delam_index) :: count
    integer :: k, i, a, b
    call mesh%get_size(interfaces=count)
    interfaces = 0
    do k = 1, int(count)
      call mesh%interface_size(k, body_a=a, body_b=b)
      if (b == 4) then
        call problem%set_bonded(k)
        cycle
      end if
      i = 1 + a/2
      interfaces(i) = k
      call problem%set_formulation('incompatible', body=a)
      call problem%set_formulation('incompatible', body=b)
      call set_interface(s%users(i), minval(s%nodes(1, s%users(i)%nodes)), k, context, mesh, problem)
    end do
  end subroutine join

  subroutine set_interface(user, left, k, context, mesh, problem)
    type(user_element), intent(in) :: user
    real(dp), intent(in) :: left
    integer, intent(in) :: k
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: mesh
    type(delam_problem), intent(in) :: problem
    type(delam_law) :: law
    real(dp), allocatable :: nodes(:,:), depth(:)
    integer(delam_index), allocatable :: below(:), cut(:)
    integer(delam_index) :: p
    call law%create(context, 'piecewise-linear')
    call law%set('normal_stiffness', user%props(3))
    call law%set('tangential_stiffness', user%props(4))
    call law%set('normal_onset', user%props(5))
    call law%set('tangential_onset', user%props(6))
    call law%set('normal_toughness', user%props(7))
    call law%set('tangential_toughness', user%props(8))
    call problem%set_law(k, law)
    nodes = mesh%nodes()
    call mesh%interface_pairs(k, nodes_a=below)
    depth = nodes(1, below) - left
    if (user%jprops(4) == 2) depth = user%props(10) - depth
    cut = pack([(p, p=1, size(below))], depth < user%props(12) - 1e-6_dp)
    call problem%set_adhesion(k, cut, spread(0.0_dp, 1, size(cut)))
  end subroutine set_interface

  subroutine hold(s, travel, mesh, problem)
    type(structure), intent(in) :: s
    real(dp), intent(in) :: travel
    type(delam_mesh), intent(in) :: mesh
    type(delam_problem), intent(in) :: problem
    integer(delam_index) :: pattern
    integer :: i
    call problem%add_pattern('travel', [0.0_dp, 1.0_dp], [0.0_dp, travel], pattern)
    do i = 1, size(s%held)
      call problem%prescribe_nodes(node_of(s%held(i)), direction_of(s%held(i)))
    end do
    do i = 1, size(s%driven)
      call problem%prescribe_nodes(node_of(s%driven(i)), direction_of(s%driven(i)), pattern)
    end do

  contains

    function node_of(dof) result(nodes)
      integer, intent(in) :: dof
      integer(delam_index), allocatable :: nodes(:)
      real(dp) :: place(2)
      place = s%nodes(:, (dof + 1)/2)
      nodes = mesh%find_nodes(place - 1e-9_dp, place + 1e-9_dp)
    end function node_of

    function direction_of(dof) result(direction)
      integer, intent(in) :: dof
      real(dp) :: direction(2)
      direction = [mod(dof, 2), 1 - mod(dof, 2)]
    end function direction_of
  end subroutine hold
end module whole_structure
