! SPDX-License-Identifier: BSD-3-Clause
! test_host FOLDER    what an embedding host does with the module delam: bodies of its own as sparse matrices, pairs
!                     that it knows, histories told on the way, tangents, the condensed operator, states as files (in
!                     FOLDER); ends with a count, and with 1 where a contract is broken
module host_parts
  use delam
  use test_counts
  implicit none
  integer, parameter :: ip = delam_index

  ! A strip of 30 mm, peeled and sheared at its left end by two devices.
  real(dp), parameter :: ends(2) = [2.5e-4_dp, -4e-5_dp]

contains

  subroutine make_strip(context, mesh, problem)
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(inout) :: mesh
    type(delam_problem), intent(inout) :: problem
    call mesh%create_layers(context, [0.03_dp], [30_ip], [1e-3_dp, 1e-3_dp], [1_ip, 1_ip], DELAM_QUAD4)
    call mesh%add_interface(0, 1)
    call problem%create(context, mesh)
    call problem%set_elastic(70e9_dp, 0.3_dp)
    call load(context, mesh, problem)
  end subroutine make_strip

  subroutine load(context, mesh, problem)
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: mesh
    type(delam_problem), intent(in) :: problem
    type(delam_law) :: law
    integer(delam_index), allocatable :: foot(:), tip(:)
    integer(delam_index) :: lift, pull
    call law%create(context, 'piecewise-linear')
    call law%set('normal_stiffness', 1e13_dp)
    call law%set('tangential_stiffness', 1e13_dp)
    call law%set('normal_onset', 20.0_dp)
    call law%set('tangential_onset', 40.0_dp)
    call law%set('normal_toughness', 200.0_dp)
    call law%set('tangential_toughness', 500.0_dp)
    call problem%set_law(1, law)
    call problem%set_adhesion(1, [integer(delam_index) :: 1, 2, 3, 4, 5, 6], spread(0.0_dp, 1, 6))
    foot = mesh%find_nodes([0.0_dp, 0.0_dp], [0.03_dp, 0.0_dp], 0)
    tip = mesh%find_nodes([0.0_dp, 2e-3_dp], [0.0_dp, 2e-3_dp], 1)
    call problem%prescribe_nodes(foot, [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes(foot, [0.0_dp, 1.0_dp])
    call problem%add_pattern('lift', [0.0_dp, 1.0_dp], [0.0_dp, ends(1)], lift)
    call problem%add_pattern('pull', [0.0_dp, 1.0_dp], [0.0_dp, ends(2)], pull)
    call problem%prescribe_nodes(tip, [0.0_dp, 1.0_dp], lift)
    call problem%prescribe_nodes(tip, [1.0_dp, 0.0_dp], pull)
    call problem%set('damage_tolerance', 1e-11_dp)
    call problem%set('kinematics', 'linear')  ! a stiffness that is given does not turn
  end subroutine load

  function nodes_of(mesh, body) result(nodes)
    type(delam_mesh), intent(in) :: mesh
    integer, intent(in) :: body
    integer(delam_index), allocatable :: nodes(:)
    integer(delam_label), allocatable :: bodies(:)
    integer(delam_index) :: i
    bodies = mesh%node_bodies()
    nodes = pack([(i, i=1, size(bodies))], bodies == body)
  end function nodes_of

  ! The nodes and pairs of a mesh, its bodies without cells.
  subroutine make_bare(context, own, mesh, with_faces)
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: own
    type(delam_mesh), intent(inout) :: mesh
    logical, intent(in) :: with_faces
    integer(delam_index), allocatable :: a(:), b(:), back(:), faces(:,:)
    integer(delam_index) :: cells
    real(dp), allocatable :: weights(:), frames(:,:,:)
    integer :: made
    call mesh%create(context, own%nodes())
    call mesh%add_host_body(0, nodes_of(own, 0))
    call mesh%add_host_body(1, nodes_of(own, 1))
    call own%interface_pairs(1, a, b, weights, frames)
    faces = own%interface_faces(1)
    if (with_faces) then
      call mesh%add_pairs(0, 1, a, b, 3*frames(:, 1, :), weights, faces, made)
      call expect(all(mesh%interface_faces(1) == faces), 'faces')
    else
      call mesh%add_pairs(0, 1, a, b, 3*frames(:, 1, :), weights, interface=made)
      call expect(size(mesh%interface_faces(1)) == 0, 'no faces')
    end if
    call mesh%interface_pairs(1, nodes_b=back)
    call mesh%get_size(cells=cells)
    call expect(made == 1 .and. all(back == b) .and. cells == 0, 'pairs')
  end subroutine make_bare

  ! (3, steps): both reactions, and what is dissipated.
  function march(problem) result(rows)
    type(delam_problem), intent(in) :: problem
    real(dp) :: rows(3, 10)
    type(delam_solver) :: solver
    integer :: k
    call solver%create(problem, 0.0_dp)
    do k = 1, 10
      call solver%advance(k/10.0_dp)
      call solver%commit()
      rows(:, k) = [solver%value('reaction:lift'), solver%value('reaction:pull'), solver%value('dissipated')]
    end do
  end function march

  subroutine expect_same(rows, expected, what)
    real(dp), intent(in) :: rows(:,:), expected(:,:)
    character(*), intent(in) :: what
    real(dp) :: largest(size(rows, 1))
    largest = maxval(abs(expected), 2)
    call expect(all(largest > 0) .and. all(maxval(abs(rows - expected), 2) <= 1e-10_dp*largest), what)
  end subroutine expect_same

  subroutine test_host_bodies()
    type(delam_context) :: context
    type(delam_mesh) :: own_mesh, mesh
    type(delam_problem) :: own, problem
    type(delam_solver) :: solver
    integer(delam_index), allocatable :: starts(:), columns(:), nodes(:), dofs(:,:), turned_starts(:), turned(:)
    integer(delam_index) :: i, r, rows
    real(dp), allocatable :: values(:), kernel(:,:), places(:,:)
    real(dp) :: expected(3, 10), whole(3, 10)
    integer :: way, body, status
    call context%create()
    call make_strip(context, own_mesh, own)
    expected = march(own)
    call own%set('step_control', 'fixed')
    whole = march(own)
    ! As it was given, without faces (then steps are taken whole), with the kernel told, with rows from the last to the
    ! first.
    do way = 1, 4
      call make_bare(context, own_mesh, mesh, way /= 2)
      call problem%create(context, mesh)
      do body = 0, 1
        nodes = nodes_of(mesh, body)
        call own%body_matrix(body, starts, columns, values)
        rows = size(starts) - 1
        select case (way)
        case (1, 2)
          call problem%set_stiffness(nodes, starts, columns, values)
        case (3)
          places = mesh%nodes()
          allocate(kernel(rows, 3))
          kernel = 0
          kernel(1::2, 1) = 1
          kernel(2::2, 2) = 1
          kernel(1::2, 3) = -places(2, nodes)
          kernel(2::2, 3) = places(1, nodes)
          call problem%set_stiffness(nodes, starts, columns, values, kernel=kernel)
          deallocate(kernel)
        case (4)
          dofs = reshape([(rows + 1 - i, i=1, rows)], [2_ip, rows/2])
          turned = rows + 1 - columns(size(columns):1:-1)
          turned_starts = [integer(delam_index) :: 1]
          do r = rows, 1, -1
            turned_starts = [turned_starts, turned_starts(size(turned_starts)) + starts(r + 1) - starts(r)]
          end do
          call problem%set_stiffness(nodes, turned_starts, turned, values(size(values):1:-1), dofs)
        end select
      end do
      call load(context, mesh, problem)
      call expect_same(march(problem), merge(whole, expected, way == 2), 'bodies handed over')
    end do

    ! One square on the host's own springs, which leave nothing free.
    call mesh%create(context, reshape([real(dp) :: 0, 0, 1, 0, 0, 1, 1, 1], [2, 4]))
    call mesh%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3], [4, 1]))
    call problem%create(context, mesh)
    call problem%set_elastic(3.0_dp, 0.0_dp)
    call problem%body_matrix(0, starts, columns, values)
    do r = 1, 4
      do i = starts(r), starts(r + 1) - 1
        if (columns(i) == r) values(i) = values(i) + 2.5_dp
      end do
    end do
    call problem%set_stiffness([integer(delam_index) :: 1, 2, 3, 4], starts, columns, values, &
                               kernel=reshape([real(dp) ::], [8, 0]))
    call problem%add_pattern('lift', [0.0_dp, 1.0_dp], [0.0_dp, 1.0_dp], i)
    call problem%prescribe_nodes([integer(delam_index) :: 3, 4], [0.0_dp, 1.0_dp], i)
    call solver%create(problem, 0.0_dp)
    call solver%advance(1.0_dp, status)
    call expect(status == DELAM_OK, 'springs hold it')
    call expect(abs(solver%value('reaction:lift') - 1/(1/3.0_dp + 1/5.0_dp)) < 1e-12_dp, 'springs in series')
  end subroutine test_host_bodies

  subroutine test_refusals()
    type(delam_context) :: context
    type(delam_mesh) :: own_mesh, mesh
    type(delam_problem) :: own, problem
    integer(delam_index), allocatable :: starts(:), columns(:), nodes(:)
    real(dp), allocatable :: values(:)
    real(dp) :: up(2, 1)
    integer :: status
    character(200) :: message
    call context%create()
    call make_strip(context, own_mesh, own)
    call make_bare(context, own_mesh, mesh, .true.)
    up = reshape([0.0_dp, 1.0_dp], [2, 1])
    call mesh%add_host_body(0, [1_ip], status)
    call expect(status == DELAM_ERROR_MESH, 'a body that is there')
    call mesh%add_host_body(7, [125_ip], status, message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, '1 .. 124') > 0, 'nodes count from 1')
    call mesh%add_pairs(0, 1, [1_ip], [63_ip, 64_ip], up, [1.0_dp], status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'unequal sizes')
    call problem%create(context, mesh)
    nodes = nodes_of(mesh, 0)
    call own%body_matrix(0, starts, columns, values)
    call problem%set_stiffness(nodes, starts(:124), columns, values, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'a row too few')
    call problem%set_stiffness(nodes, starts, columns(2:), values(2:), status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'an entry too few')
    call problem%set_stiffness(nodes, starts, columns, values, reshape([1_ip, 2_ip], [2, 1]), status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'rows of one node alone')
    call problem%set_stiffness(nodes, starts, columns, values, kernel=up, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'a part of a motion')
    values(2) = 1.001_dp*values(2)
    call problem%set_stiffness(nodes, starts, columns, values, status=status, message=message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, 'symmetric') > 0, 'not symmetric')
    call problem%check(status)
    call expect(status == DELAM_ERROR_PROBLEM, 'no stiffness was taken')
  end subroutine test_refusals

  ! What the matrices mean is tested in C; here they are those of C, in its order.
  subroutine test_step_tangent()
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    type(delam_solver) :: solver, nobody
    real(dp), allocatable :: tangent(:,:), held(:,:), recorded(:)
    integer(delam_index) :: first, count, p
    real(dp) :: time, flat(4)
    integer :: k, status
    logical :: damaged, lopsided
    call context%create()
    call make_strip(context, mesh, problem)
    ! With this rule the matrix is not symmetric: rows are not columns.
    call problem%set('mixity_rule', 'converged')
    call solver%create(problem, 0.0_dp)
    call solver%record('reaction:lift')
    damaged = .false.
    lopsided = .false.
    do k = 1, 10
      time = k/10.0_dp
      do p = 1, 2
        call solver%set_history(p, [time], [ends(p)*time])
      end do
      call solver%advance(time)
      call expect(solver%pending(), 'a step is pending')
      tangent = solver%step_tangent()
      held = solver%tangent()
      call expect(delam_solver_step_tangent(solver%handle(), 4_ip, flat) == DELAM_OK, 'the tangent of C')
      call expect(all(reshape(tangent, [4]) == flat), 'the tangent of a step')
      call expect(delam_solver_tangent(solver%handle(), 4_ip, flat) == DELAM_OK, 'the tangent of C')
      call expect(all(reshape(held, [4]) == flat), 'the tangent')
      damaged = damaged .or. any(tangent /= held)
      lopsided = lopsided .or. abs(tangent(1, 2) - tangent(2, 1)) > 1e-4_dp*abs(tangent(1, 2))
      if (k == 5) then
        call solver%rollback()
        call expect(.not. solver%pending(), 'none is pending')
        call solver%advance(time)
      end if
      call solver%commit()
    end do
    call solver%recorded_steps(first, count)
    recorded = solver%recorded('reaction:lift')
    call expect(first == 0 .and. count == 11 .and. size(recorded) == 11, 'the steps that were committed')
    call expect(recorded(11) == solver%value('reaction:lift'), 'the last one')
    call expect(damaged, 'damage was met')
    call expect(lopsided, 'a matrix that is not symmetric')
    held = solver%step_tangent(status)
    call expect(status == DELAM_ERROR_STATE, 'no step is pending')
    call solver%set_history(3_ip, [2.0_dp], [1.0_dp], status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'patterns count from 1')
    call solver%set_history(1_ip, [2.0_dp, 3.0_dp], [1.0_dp], status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'unequal sizes')
    recorded = solver%recorded('work', status)
    call expect(status == DELAM_ERROR_ARGUMENT .and. size(recorded) == 11, 'a value that is not recorded')
    recorded = nobody%recorded('work', status)
    call expect(status == DELAM_ERROR_HANDLE .and. size(recorded) == 0, 'no solver')
    held = nobody%step_tangent(status)
    call expect(status == DELAM_ERROR_HANDLE .and. size(held) == 0, 'no solver')
  end subroutine test_step_tangent

  subroutine test_condensed()
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    type(delam_solver) :: solver
    real(dp), allocatable :: stiffness(:,:), load_(:,:), constant(:,:), values(:), offset(:,:)
    real(dp), allocatable :: s(:,:), l(:,:), c(:,:), v(:), o(:,:)
    integer(delam_index), allocatable :: starts(:), columns(:), from(:), at(:)
    integer(delam_index) :: press
    integer :: status
    call context%create()
    call make_strip(context, mesh, problem)
    call problem%add_pattern('press', [0.0_dp, 1.0_dp], [0.0_dp, 1.0_dp], press)
    call problem%add_forces(press, mesh%find_nodes([0.012_dp, 2e-3_dp], [0.012_dp, 2e-3_dp], 1), &
                            reshape([0.0_dp, 2000.0_dp], [2, 1]))
    call solver%create(problem, 0.0_dp)
    call solver%condensed(stiffness, load_, constant, starts, columns, values, offset)
    call expect(size(starts) == 63 .and. size(stiffness, 1) == size(stiffness, 2), 'sizes')
    call expect(all(shape(load_) == [size(stiffness, 1), 3]) .and. all(shape(constant) == 3), 'sizes of loads')
    call expect(all(shape(offset) == [3, 62]) .and. starts(63) == size(values) + 1, 'sizes of rows')
    call expect(all(stiffness == transpose(stiffness)), 'symmetric')
    call expect(minval(columns) >= 1 .and. maxval(columns) <= size(stiffness, 1), 'columns count from 1')
    allocate(s, mold=stiffness)
    allocate(l, mold=load_)
    allocate(c, mold=constant)
    allocate(o, mold=offset)
    allocate(v, mold=values)
    allocate(from, mold=starts)
    allocate(at, mold=columns)
    call expect(delam_solver_condensed(solver%handle(), size(s, kind=ip), s, l, c, from, at, v, o) == DELAM_OK, 'of C')
    call expect(all(s == stiffness) .and. all(l == load_) .and. all(c == constant) .and. all(o == offset), &
                'the matrices')
    call expect(all(v == values) .and. all(from + 1 == starts) .and. all(at + 1 == columns), 'the rows')
    call problem%set('reduction', 'feti')
    call solver%create(problem, 0.0_dp)
    call solver%condensed(stiffness, load_, constant, starts, columns, values, offset, status)
    call expect(status == DELAM_ERROR_STATE .and. size(stiffness) == 0, 'FETI has no such operator')
    call expect(delam_blas_threads() >= 0, 'threads of the linear algebra')
  end subroutine test_condensed

  subroutine test_files(folder)
    character(*), intent(in) :: folder
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    type(delam_solver) :: solver, again
    character(len(folder) + 20) :: path
    integer(delam_byte), allocatable :: bytes(:)
    integer :: status, unit
    character(500) :: message
    call context%create()
    call make_strip(context, mesh, problem)
    call solver%create(problem, 0.0_dp)
    call solver%advance(0.4_dp)
    call solver%commit()
    path = folder // '/test_host.state'   ! blanks follow
    call solver%save_file(path)
    allocate(bytes(size(solver%save())))
    open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read')
    read (unit) bytes
    close (unit)
    call expect(all(bytes == solver%save()), 'the file has the bytes')
    call again%create(problem, 0.0_dp)
    call again%advance(0.1_dp)
    call again%load_file(path)
    call expect(.not. again%pending() .and. again%value('time') == 0.4_dp, 'loaded, in the place of a step')
    call expect(all(again%save() == bytes), 'the same state')
    call solver%save_file(folder // '/none/state', status, message)
    call expect(status == DELAM_ERROR_FILE .and. index(message, '/none/state') > 0, 'no folder to save to')
    call solver%load_file(folder // '/none/state', status, message)
    call expect(status == DELAM_ERROR_FILE .and. index(message, '/none/state') > 0, 'no file to load')
    call solver%load_file(folder, status)
    call expect(status == DELAM_ERROR_FILE, 'a folder is no file')
    open (newunit=unit, file=path, status='replace', action='write')
    write (unit, '(a)') '<?xml version="1.0"?>'
    close (unit)
    call solver%load_file(path, status)
    call expect(status == DELAM_ERROR_SNAPSHOT, 'a foreign file')
    call expect(all(solver%save() == bytes), 'refusals change nothing')
    open (newunit=unit, file=path, status='old')
    close (unit, status='delete')
  end subroutine test_files
end module host_parts

program test_host
  use host_parts
  implicit none
  character(4000) :: folder
  folder = ''
  if (command_argument_count() == 1) call get_command_argument(1, folder)
  if (folder == '') error stop 'usage: test_host FOLDER'
  call test_host_bodies()
  call test_refusals()
  call test_step_tangent()
  call test_condensed()
  call test_files(trim(folder))
  call finish()
end program test_host
