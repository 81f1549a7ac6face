! SPDX-License-Identifier: BSD-3-Clause
!
! A host on many processes that assembles its own stiffness and lets libdelam delaminate it, from Fortran.
!
!     mpirun -n 4 host_petsc_fortran [CELLS]     CELLS: number of cells along the beam, 30 if absent
!
! The scene of host_petsc.c: each rank integrates the stiffness of a slab of the beam, libdelam on rank 0 knows only the
! nodes at the interface, the support and the loads.

! The host's grid, its elements, and the part of a rank. Nodes are numbered from 1.
module host_bodies
  use delam, only: dp => delam_real, ip => delam_index
  implicit none
  private
  public :: place, node_number, held_nodes, loaded_nodes, other_nodes, assemble

  real(dp), parameter, public :: length = 45e-3_dp    ! m
  real(dp), parameter, public :: width = 9e-3_dp      ! m
  real(dp), parameter, public :: height = 1.5e-3_dp   ! of an arm, m
  real(dp), parameter :: young = 60e9_dp              ! Pa
  real(dp), parameter :: poisson = 0.3_dp
  integer, parameter, public :: across = 3            ! cells across the width
  integer, parameter, public :: upwards = 2           ! cells over the height of an arm

  integer(ip), public :: along = 30   ! cells along the beam
  integer(ip), public :: first, last  ! sections between which this rank's cells lie

  ! Corners of a cell, x first.
  integer, parameter :: corner(3, 8) = reshape([0,0,0, 1,0,0, 0,1,0, 1,1,0, 0,0,1, 1,0,1, 0,1,1, 1,1,1], [3, 8])

contains

  ! Node (arm, i, j, k): arm 0 below, 1 above; i along the beam, j across it, k away from the interface.
  pure function place(arm, i, j, k) result(x)
    integer(ip), intent(in) :: i
    integer, intent(in) :: arm, j, k
    real(dp) :: x(3)
    x = [length*i/along, width*j/across, height + merge(-1, 1, arm == 0)*height*k/upwards]
  end function place

  ! How many nodes come before the groups: those of the interface, held ones, loaded ones, all others.
  pure integer(ip) function held_nodes()
    held_nodes = 2*(along + 1)*(across + 1)
  end function held_nodes

  pure integer(ip) function loaded_nodes()
    loaded_nodes = held_nodes() + 2*upwards*(across + 1)
  end function loaded_nodes

  pure integer(ip) function other_nodes()
    other_nodes = loaded_nodes() + 2*(across + 1)
  end function other_nodes

  ! Number of a node, the same on all ranks. libdelam's mesh has the first groups; numbers behind may have gaps.
  pure integer(ip) function node_number(arm, i, j, k)
    integer(ip), intent(in) :: i
    integer, intent(in) :: arm, j, k
    integer :: layer
    layer = arm*upwards + k - 1
    if (k == 0) then
      node_number = (arm*(across + 1) + j)*(along + 1) + i + 1
    else if (i == along) then
      node_number = held_nodes() + layer*(across + 1) + j + 1
    else if (i == 0 .and. k == upwards) then
      node_number = loaded_nodes() + arm*(across + 1) + j + 1
    else
      node_number = other_nodes() + (layer*(across + 1) + j)*(along + 1) + i + 1
    end if
  end function node_number

  ! Gradients of the shape functions at a point of a cell, and the volume that a unit of its cube has there.
  pure subroutine gradients(x, point, gradient, volume)
    real(dp), intent(in) :: x(3, 8), point(3)
    real(dp), intent(out) :: gradient(3, 8), volume
    real(dp) :: slope(3, 8), jacobian(3, 3), cofactor(3, 3), factors(3)
    integer :: c, r, s, a, b, d, e
    do c = 1, 8
      factors = 1 + (2*corner(:, c) - 1)*point
      do r = 1, 3
        slope(r, c) = 0.125_dp*(2*corner(r, c) - 1)*factors(modulo(r, 3) + 1)*factors(modulo(r + 1, 3) + 1)
      end do
    end do
    jacobian = matmul(slope, transpose(x))
    do s = 1, 3
      do r = 1, 3
        a = modulo(r, 3) + 1
        b = modulo(r + 1, 3) + 1
        d = modulo(s, 3) + 1
        e = modulo(s + 1, 3) + 1
        cofactor(r, s) = jacobian(a, d)*jacobian(b, e) - jacobian(a, e)*jacobian(b, d)
      end do
    end do
    volume = dot_product(jacobian(1, :), cofactor(1, :))
    gradient = matmul(transpose(cofactor), slope)/volume
    volume = abs(volume)   ! arm 0 is the mirror image of arm 1
  end subroutine gradients

  ! Stiffness of a cell from the places of its nodes: block (:,:,b,a) holds the forces on node a due to node b.
  pure function cell_stiffness(x) result(stiffness)
    real(dp), intent(in) :: x(3, 8)
    real(dp) :: stiffness(3, 3, 8, 8)
    real(dp), parameter :: lambda = young*poisson/((1 + poisson)*(1 - 2*poisson))
    real(dp), parameter :: mu = 0.5_dp*young/(1 + poisson)
    real(dp) :: g(3, 8), volume
    integer :: point, a, b, p, q
    stiffness = 0
    do point = 1, 8
      call gradients(x, (2*corner(:, point) - 1)/sqrt(3.0_dp), g, volume)
      do a = 1, 8
        do b = 1, 8
          do p = 1, 3
            do q = 1, 3
              stiffness(q, p, b, a) = stiffness(q, p, b, a) + volume*(lambda*g(p, a)*g(q, b) + mu*g(q, a)*g(p, b))
            end do
            stiffness(p, p, b, a) = stiffness(p, p, b, a) + volume*mu*dot_product(g(:, a), g(:, b))
          end do
        end do
      end do
    end do
  end function cell_stiffness

  ! Place of a node in the part, from 1.
  pure integer(ip) function local(arm, i, j, k)
    integer(ip), intent(in) :: i
    integer, intent(in) :: arm, j, k
    local = ((arm*(upwards + 1) + k)*(across + 1) + j)*(last - first + 1) + i - first + 1
  end function local

  ! The part of this rank; a rank without cells has an empty one. Numbers in the rows count from 0, as in C.
  subroutine assemble(nodes, coordinates, row_starts, columns, values)
    integer(ip), allocatable, intent(out) :: nodes(:), row_starts(:), columns(:)
    real(dp), allocatable, intent(out) :: coordinates(:,:), values(:)
    real(dp), allocatable :: blocks(:,:,:,:)   ! 27 blocks of 3 x 3 for each node: of those around it
    integer(ip) :: count, entries, row, i, other
    integer :: arm, j, k, p, to, step(3)
    count = 0
    if (last > first) count = 2*(upwards + 1)*(across + 1)*(last - first + 1)
    allocate (nodes(count), coordinates(3, count), row_starts(0:3*count), columns(9*27*count), values(9*27*count))
    allocate (blocks(3, 3, 27, count))
    row_starts(0) = 0
    if (count == 0) return
    call add_cells(blocks)
    entries = 0
    do arm = 0, 1
      do k = 0, upwards
        do j = 0, across
          do i = first, last
            row = local(arm, i, j, k)
            nodes(row) = node_number(arm, i, j, k)
            coordinates(:, row) = place(arm, i, j, k)
            do p = 1, 3
              do to = 0, 26
                step = [modulo(to, 3), modulo(to/3, 3), to/9] - 1
                if (i + step(1) < first .or. i + step(1) > last .or. j + step(2) < 0 .or. j + step(2) > across .or. &
                    k + step(3) < 0 .or. k + step(3) > upwards) cycle
                other = local(arm, i + step(1), j + step(2), k + step(3))
                columns(entries + 1:entries + 3) = 3*(other - 1) + [0, 1, 2]
                values(entries + 1:entries + 3) = blocks(:, p, to + 1, row)
                entries = entries + 3
              end do
              row_starts(3*(row - 1) + p) = entries
            end do
          end do
        end do
      end do
    end do
  end subroutine assemble

  subroutine add_cells(blocks)
    real(dp), intent(out) :: blocks(:,:,:,:)
    real(dp) :: x(3, 8), stiffness(3, 3, 8, 8)
    integer(ip) :: i, row
    integer :: arm, j, k, a, b, to
    blocks = 0
    do arm = 0, 1
      do k = 0, upwards - 1
        do j = 0, across - 1
          do i = first, last - 1
            do a = 1, 8
              x(:, a) = place(arm, i + corner(1, a), j + corner(2, a), k + corner(3, a))
            end do
            stiffness = cell_stiffness(x)
            do a = 1, 8
              row = local(arm, i + corner(1, a), j + corner(2, a), k + corner(3, a))
              do b = 1, 8
                to = 14 + dot_product([1, 3, 9], corner(:, b) - corner(:, a))
                blocks(:, :, to, row) = blocks(:, :, to, row) + stiffness(:, :, b, a)
              end do
            end do
          end do
        end do
      end do
    end do
  end subroutine add_cells

end module host_bodies

! What libdelam knows: on rank 0, in functions that delam_petsc_run calls. And the task of all ranks.
module host_scene
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_int64_t, c_null_ptr, c_null_char
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi_f08
  use delam, dp => delam_real, ip => delam_index
  use delam_petsc
  use host_bodies
  implicit none
  private
  public :: make_scene, march, find_largest, problem

  real(dp), parameter :: notch = 15e-3_dp   ! m
  integer, parameter :: steps = 10

  type(delam_context) :: context
  type(delam_mesh) :: mesh
  type(delam_law) :: law
  type(delam_problem) :: problem
  type(c_ptr), public :: petsc = c_null_ptr
  real(dp) :: largest                       ! displacement of a node that libdelam does not know, m; on rank 0
  integer :: status = DELAM_OK              ! of the last call
  character(500) :: message = ''

contains

  ! Tells the message of a call that has failed.
  logical function failed()
    failed = status /= DELAM_OK
    if (failed) write (error_unit, '(2a)') 'host_petsc: ', trim(message)
  end function failed

  function make_scene(user) bind(c) result(answer)
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    call describe()
    answer = status
  end function make_scene

  subroutine describe()
    integer :: i
    character(20), parameter :: keys(6) = [character(20) :: 'normal_stiffness', 'tangential_stiffness', &
      'normal_onset', 'tangential_onset', 'normal_toughness', 'tangential_toughness']
    real(dp), parameter :: numbers(6) = [3e12_dp, 3e12_dp, 5.0_dp, 5.0_dp, 250.0_dp, 250.0_dp]
    call context%create(status, message)
    if (failed()) return
    call make_mesh()
    if (status /= DELAM_OK) return
    call law%create(context, 'piecewise-linear', status, message)
    if (failed()) return
    do i = 1, size(keys)
      call law%set(trim(keys(i)), numbers(i), status, message)
      if (failed()) return
    end do
    call problem%create(context, mesh, status, message)
    if (failed()) return
    call problem%set_law(1, law, status, message)
    if (failed()) return
    call problem%set('damage_tolerance', 1e-10_dp, status, message)   ! to compare hosts closely
    if (failed()) return
    call make_notch()
    if (status == DELAM_OK) call make_loads()
  end subroutine describe

  subroutine make_mesh()
    real(dp), allocatable :: x(:,:), normals(:,:), weights(:)
    integer, allocatable :: arms(:)
    integer(ip), allocatable :: faces(:,:)
    integer(ip) :: i, n, pairs
    integer :: arm, j, k
    pairs = (along + 1)*(across + 1)
    allocate (x(3, other_nodes()), arms(other_nodes()), normals(3, pairs), weights(pairs), faces(4, along*across))
    do arm = 0, 1
      do k = 0, upwards
        do j = 0, across
          do i = 0, along
            n = node_number(arm, i, j, k)
            if (n > other_nodes()) cycle
            x(:, n) = place(arm, i, j, k)
            arms(n) = arm
          end do
        end do
      end do
    end do
    call mesh%create(context, x, status, message)
    if (failed()) return
    do arm = 0, 1
      call mesh%add_host_body(arm, pack([(i, i=1, size(arms))], arms == arm), status, message)
      if (failed()) return
    end do
    ! A pair stands for a quarter of each cell around it.
    normals = spread([0.0_dp, 0.0_dp, 1.0_dp], 2, int(pairs))
    do j = 0, across
      do i = 0, along
        n = node_number(0, i, j, 0)
        weights(n) = length/along*width/across
        if (i == 0 .or. i == along) weights(n) = 0.5_dp*weights(n)
        if (j == 0 .or. j == across) weights(n) = 0.5_dp*weights(n)
        if (i < along .and. j < across) &
          faces(:, j*along + i + 1) = [n, n + 1, node_number(0, i + 1, j + 1, 0), node_number(0, i, j + 1, 0)]
      end do
    end do
    call mesh%add_pairs(0, 1, [(i, i=1, pairs)], [(pairs + i, i=1, pairs)], normals, weights, faces, &
                        status=status, message=message)
    if (failed()) return
  end subroutine make_mesh

  ! Pairs left of the notch tip have no adhesion from the start.
  subroutine make_notch()
    integer(ip) :: cut((along + 1)*(across + 1)), i
    integer :: j, count
    real(dp) :: x(3)
    count = 0
    do j = 0, across
      do i = 0, along
        x = place(0, i, j, 0)
        if (x(1) >= notch - 1e-9_dp) cycle
        count = count + 1
        cut(count) = node_number(0, i, j, 0)
      end do
    end do
    call problem%set_adhesion(1, cut(:count), spread(0.0_dp, 1, count), status, message)
    if (failed()) return
  end subroutine make_notch

  ! The right end is held, the outer edges of the left one are driven apart.
  subroutine make_loads()
    real(dp), parameter :: axes(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
    integer(ip) :: opening
    integer :: arm, axis, j, k
    call problem%add_pattern('opening', [0.0_dp, 1.0_dp], [0.0_dp, 1.6e-3_dp], opening, status, message)
    if (failed()) return
    do arm = 0, 1
      do axis = 1, 3
        call problem%prescribe_nodes([((node_number(arm, along, j, k), j=0, across), k=0, upwards)], axes(:, axis), &
                                     status=status, message=message)
        if (failed()) return
      end do
      call problem%prescribe_nodes([(node_number(arm, 0_ip, j, upwards), j=0, across)], (2*arm - 1)*axes(:, 3), &
                                   opening, 0.5_dp, status, message)
      if (failed()) return
    end do
  end subroutine make_loads

  function march(user) bind(c) result(answer)
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    call all_steps()
    answer = status
  end function march

  subroutine all_steps()
    type(delam_solver) :: solver
    character(16), parameter :: keys(4) = [character(16) :: 'load:opening', 'reaction:opening', 'dissipated', &
                                           'debonded_length']
    real(dp) :: values(4)
    integer :: step, i
    call problem%check(status, message)
    if (failed()) return
    call solver%create(problem, 0.0_dp, status, message)
    if (failed()) return
    print '(a)', 'step          load/m       reaction/N     dissipated/J       debonded/m'
    do step = 1, steps
      call solver%advance(real(step, dp)/steps, status, message)
      if (failed()) return
      call solver%commit(status, message)
      if (failed()) return
      do i = 1, size(keys)
        values(i) = solver%value(trim(keys(i)), status, message)
        if (failed()) return
      end do
      values(4) = values(4)/width   ! in space libdelam counts the debonded area
      print '(i4, 4(1x, es16.9))', step, values
    end do
    status = delam_petsc_recover(petsc, solver%handle())
    if (status == DELAM_OK) status = delam_petsc_everywhere(petsc, 0_ip)
    message = delam_text(delam_petsc_message(petsc))
    if (failed()) return
    print '(a, es15.9, a)', 'largest displacement of nodes that only the ranks know: ', largest, ' m'
  end subroutine all_steps

  ! The task of each rank: the largest displacement of the nodes that only the ranks know, for rank 0.
  function find_largest(size, bytes, user) bind(c) result(answer)
    integer(c_int64_t), value :: size
    type(c_ptr), value :: bytes, user
    integer(c_int32_t) :: answer
    integer(ip), allocatable :: nodes(:)
    real(dp), allocatable :: u(:,:)
    real(dp) :: own
    integer(ip) :: count
    own = 0
    answer = delam_petsc_part_nodes(petsc, 0_ip, count=count)
    if (answer == DELAM_OK .and. count > 0) then
      allocate (nodes(count), u(3, count))
      answer = delam_petsc_part_nodes(petsc, count, nodes)
      if (answer == DELAM_OK) answer = delam_petsc_part_field(petsc, 'displacement' // c_null_char, 3*count, u)
      ! libdelam counts nodes from 0 here.
      if (answer == DELAM_OK) own = maxval(norm2(u, 1), nodes >= other_nodes())
      own = max(own, 0.0_dp)
    end if
    call MPI_Reduce(own, largest, 1, MPI_DOUBLE_PRECISION, MPI_MAX, 0, MPI_COMM_WORLD)   ! all ranks come here
  end function find_largest

end module host_scene

program host_petsc
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_null_ptr, c_funloc
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi_f08
  use delam, dp => delam_real, ip => delam_index
  use delam_petsc
  use host_bodies
  use host_scene
  implicit none
  integer :: rank, ranks, result

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  result = 2
  if (arguments_are_right()) then
    first = along*rank/ranks
    last = along*(rank + 1)/ranks
    result = 1
    if (.not. failed(delam_petsc_create(MPI_COMM_WORLD%mpi_val, petsc), 'PETSc')) then
      if (done()) result = 0
    end if
    call delam_petsc_destroy(petsc)
  end if
  call MPI_Finalize()
  if (result == 1) stop 1
  if (result == 2) stop 2

contains

  logical function arguments_are_right()
    character(20) :: word
    integer :: error
    error = 0
    if (command_argument_count() > 0) then
      call get_command_argument(1, word)
      read (word, *, iostat=error) along
    end if
    arguments_are_right = error == 0 .and. along >= 3 .and. along <= 100000
    if (.not. arguments_are_right .and. rank == 0) &
      write (error_unit, '(a)') 'usage: host_petsc_fortran [CELLS]     3 to 100000 cells along the beam'
  end function arguments_are_right

  ! Tells on rank 0 what has failed; all ranks have the same status.
  logical function failed(status, what)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(in) :: what
    failed = status /= DELAM_OK
    if (failed .and. rank == 0) write (error_unit, '(6a)') &
      'host_petsc: ', what, ': ', delam_text(delam_status_name(status)), ': ', delam_text(delam_petsc_message(petsc))
  end function failed

  logical function done()
    integer(ip), allocatable :: nodes(:), row_starts(:), columns(:)
    real(dp), allocatable :: coordinates(:,:), values(:)
    done = .false.
    call assemble(nodes, coordinates, row_starts, columns, values)
    if (failed(delam_petsc_set_part(petsc, 3_c_int32_t, size(nodes, kind=ip), nodes - 1, coordinates, row_starts, &
                                    columns, values), 'part')) return
    if (failed(delam_petsc_run(petsc, c_funloc(make_scene), c_null_ptr), 'scene')) return
    if (failed(delam_petsc_attach(petsc, problem%handle()), 'engine')) return   ! NULL but on rank 0
    if (failed(delam_petsc_set_task(petsc, c_funloc(find_largest), c_null_ptr), 'task')) return
    done = .not. failed(delam_petsc_run(petsc, c_funloc(march), c_null_ptr), 'march')
  end function done

end program host_petsc
