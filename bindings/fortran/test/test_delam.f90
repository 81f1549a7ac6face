! SPDX-License-Identifier: BSD-3-Clause
! test_delam          the contracts of the module delam; ends with a count, and with 1 where one is broken
! test_delam stop     an error nobody asked for: ends the program with the library's message
module test_parts
  use delam
  use test_counts
  implicit none

  ! The bilinear law with the same toughness in both modes.
  type, extends(delam_host_law) :: bilinear
    real(dp) :: onset = 0, toughness = 0
    logical :: broken = .false.
  contains
    procedure :: adhesion => bilinear_adhesion
    procedure :: dissipation => bilinear_dissipation
  end type bilinear

  type, extends(delam_observer) :: counter
    integer :: calls = 0, lines = 0
    integer :: cancel_at = huge(1)
    character(:), allocatable :: last
  contains
    procedure :: log => count_line
    procedure :: progress => count_call
  end type counter

contains

  subroutine bilinear_adhesion(self, mixity, driving, adhesion, slope, failed)
    class(bilinear), intent(in) :: self
    real(dp), intent(in) :: mixity, driving
    real(dp), intent(out) :: adhesion, slope
    logical, intent(inout) :: failed
    real(dp) :: r
    r = self%toughness/self%onset
    adhesion = 1
    slope = 0
    if (driving >= self%onset*r**2) then
      adhesion = 0
    else if (driving > self%onset) then
      adhesion = (r*sqrt(self%onset/driving) - 1)/(r - 1)
      slope = -0.5_dp*r/(r - 1)*sqrt(self%onset)/driving**1.5_dp
    end if
    failed = self%broken .or. mixity < 0
  end subroutine bilinear_adhesion

  subroutine bilinear_dissipation(self, mixity, adhesion, dissipated, slope, mixity_slope, failed)
    class(bilinear), intent(in) :: self
    real(dp), intent(in) :: mixity, adhesion
    real(dp), intent(out) :: dissipated, slope, mixity_slope
    logical, intent(inout) :: failed
    real(dp) :: r, below
    r = self%toughness/self%onset
    below = 1 + adhesion*(r - 1)
    dissipated = self%toughness - self%onset*r**2*adhesion/below
    slope = -self%onset*(r/below)**2
    mixity_slope = 0
    failed = self%broken .or. mixity < 0
  end subroutine bilinear_dissipation

  subroutine count_line(self, level, text)
    class(counter), intent(inout) :: self
    integer, intent(in) :: level
    character(*), intent(in) :: text
    if (level >= 0) self%lines = self%lines + 1
    self%last = text
  end subroutine count_line

  subroutine count_call(self, stage, done, total, cancel)
    class(counter), intent(inout) :: self
    character(*), intent(in) :: stage
    integer(delam_index), intent(in) :: done, total
    logical, intent(inout) :: cancel
    if (total == 0 .or. done <= total) self%calls = self%calls + 1
    self%last = stage
    cancel = self%calls >= self%cancel_at
  end subroutine count_call

  subroutine make_law(law, context, by_host)
    type(delam_law), intent(inout) :: law
    type(delam_context), intent(in) :: context
    logical, intent(in) :: by_host
    if (by_host) then
      call law%create_host(context, 'bilinear', bilinear(onset=100.0_dp, toughness=250.0_dp))
    else
      call law%create(context, 'piecewise-linear')
      call law%set('normal_onset', 100.0_dp)
      call law%set('tangential_onset', 100.0_dp)
      call law%set('normal_toughness', 250.0_dp)
      call law%set('tangential_toughness', 250.0_dp)
      call law%set('criterion', 'power')
      call law%set('onset_exponent', 1.0_dp)
      call law%set('toughness_exponent', 1.0_dp)
    end if
    call law%set('normal_stiffness', 1e13_dp)
    call law%set('tangential_stiffness', 1e13_dp)
  end subroutine make_law

  ! A double cantilever beam; everything but the solver is given up here.
  subroutine make_solver(solver, context, by_host)
    type(delam_solver), intent(inout) :: solver
    type(delam_context), intent(in) :: context
    logical, intent(in) :: by_host
    type(delam_mesh) :: mesh
    type(delam_law) :: law
    type(delam_problem) :: problem
    integer(delam_index), allocatable :: lower(:), upper(:), left(:)
    integer(delam_index) :: pattern
    character(:), allocatable :: plan
    real(dp) :: setup, memory
    call mesh%create_layers(context, [30e-3_dp], [60_delam_index], [1e-3_dp, 1e-3_dp], [2_delam_index, 2_delam_index], &
                            DELAM_QUAD4)
    call mesh%add_interface(0, 1)
    call make_law(law, context, by_host)
    call problem%create(context, mesh)
    call problem%set_elastic(70e9_dp, 0.3_dp)
    call problem%set_law(1, law)
    left = [0]
    lower = mesh%find_nodes([30e-3_dp, 0.0_dp], [30e-3_dp, 0.0_dp], 0)
    upper = mesh%find_nodes([30e-3_dp, 2e-3_dp], [30e-3_dp, 2e-3_dp], 1)
    left = mesh%find_nodes([0.0_dp, 0.0_dp], [0.0_dp, 2e-3_dp])
    call problem%add_pattern('opening', [0.0_dp, 1.0_dp], [0.0_dp, 1e-3_dp], pattern)
    call problem%prescribe_nodes(left, [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes(left(:1), [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes(lower, [0.0_dp, 1.0_dp], pattern, -0.5_dp)
    call problem%prescribe_nodes(upper, [0.0_dp, 1.0_dp], [pattern], reshape([0.5_dp], [1, 1]))
    call problem%set('solution', 'local')
    call problem%check()
    call problem%plan(plan, setup, memory)
    call solver%create(problem, 0.0_dp)
    call expect(plan == solver%plan() .and. setup > 0 .and. memory > 0, 'the plan beforehand')
  end subroutine make_solver

  subroutine test_errors()
    type(delam_context) :: context
    type(delam_law) :: law, none
    type(delam_mesh) :: mesh
    integer :: status
    real(dp) :: few(1)
    character(200) :: message
    call none%check(status=status, message=message)
    call expect(status == DELAM_ERROR_HANDLE .and. len_trim(message) > 0, 'a message without an object')
    call law%create(context, 'piecewise-linear', status, message)
    call expect(status == DELAM_ERROR_HANDLE .and. .not. law%exists(), 'a context that was not created is refused')
    call context%create(status, message)
    call expect(status == DELAM_OK .and. message == '', 'no message without an error')
    call law%create(context, 'no-such-law', status, message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, 'no-such-law') > 0, 'the message has the value')
    call expect(message == context%message(), 'the context has the same message')
    call expect(.not. law%exists(), 'nothing was made')
    call law%create(context, 'piecewise-linear   ')
    call law%set('normal_onset', -1.0_dp, status, message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, 'normal_onset') > 0, 'the message has the key')
    call law%check(status)
    call expect(status == DELAM_ERROR_PROBLEM, 'an incomplete law')
    call law%toughness([0.0_dp, 1.0_dp], onset=few, status=status, message=message)
    call expect(status == DELAM_ERROR_ARGUMENT, 'arrays of unequal size are refused')
    call mesh%create(context, reshape([real(dp) :: 0, 0, 1, 0, 1, 1, 0, 1], [2, 4]))
    call mesh%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 3, 5], [4, 1]), status=status, &
                        message=message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, '1 .. 4') > 0, 'nodes count from 1')
    call mesh%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 3], [3, 1]), status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'three nodes are no quadrilateral')
  end subroutine test_errors

  ! What there is to set, in words.
  subroutine test_descriptions()
    character(:), allocatable :: key, meaning, type, none
    integer :: i
    logical :: found, below, above
    real(dp) :: lower, upper
    found = .false.
    do i = 1, int(delam_option_count())
      call delam_describe_option(i, key, meaning=meaning)
      found = found .or. (key == 'solution' .and. len(meaning) > 0)
    end do
    call expect(found, 'options are described')
    call delam_describe_option(0, key=none)
    call expect(none == '', 'no option 0')
    found = .false.
    do i = 1, delam_parameter_count('tabulated')
      call delam_describe_parameter('tabulated', i, key=key, type=type)
      found = found .or. (key == 'normal_onset' .and. type == 'real')
    end do
    call expect(found .and. delam_parameter_count('no-such-law') == 0, 'parameters are described')
    call delam_describe_parameter('tabulated', delam_parameter_count('tabulated'), key=key)
    call expect(len(key) > 0, 'to the last')
    do i = 1, delam_parameter_count('trapezoidal')
      call delam_describe_parameter('trapezoidal', i, key=key)
      call delam_parameter_bounds('trapezoidal', i, lower, upper, below, above, found)
      call expect(found, 'each has bounds')
      if (key == 'plateau') call expect(lower == 0 .and. upper == 1 .and. .not. below .and. above, 'of the plateau')
    end do
    call delam_parameter_bounds('trapezoidal', 0, lower, upper, below, above, found)
    call expect(.not. found, 'no parameter 0')
    call delam_describe_kind(1, key, type, found)
    call expect(key == 'piecewise-linear' .and. len(type) > 0 .and. .not. found, 'a kind of law')
    call delam_describe_kind(int(delam_law_kind_count()), hosted=found)
    call expect(found, 'the kind of callbacks')
  end subroutine test_descriptions

  ! Two squares beside each other, a body each, joined by an interface of two pairs.
  subroutine test_mesh()
    type(delam_context) :: context
    type(delam_mesh) :: mesh, solid
    real(dp) :: xy(2, 6), wide(3, 8), spread_out(3, 16)
    integer(delam_index) :: cells(4, 2), nodes, bodies, interfaces, pairs
    integer(delam_index), allocatable :: a(:), b(:), offsets(:), connectivity(:), faces(:,:), found(:), origins(:)
    integer :: space
    integer(delam_label), allocatable :: types(:), labels(:)
    real(dp), allocatable :: weights(:), frames(:,:,:), back(:,:)
    integer :: interface, i
    xy = reshape([real(dp) :: 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1], [2, 6])
    cells = reshape([integer(delam_index) :: 1, 2, 5, 4, 2, 3, 6, 5], [4, 2])
    call context%create()
    call mesh%create(context, xy)
    call mesh%add_conforming_cells(DELAM_QUAD4, cells, [3, 7])
    call mesh%add_interface(3, 7, interface=interface)
    call expect(interface == 1, 'the first interface is 1')
    call mesh%get_size(dimension=space, nodes=nodes, bodies=bodies, interfaces=interfaces)
    call expect(space == 2 .and. nodes == 8 .and. bodies == 2 .and. interfaces == 1, 'sizes')
    back = mesh%nodes()
    call expect(all(shape(back) == [2, 8]) .and. all(back(:, :6) == xy), 'nodes come back as (2, n)')
    origins = mesh%node_origins()
    call expect(all(origins(:6) == [1, 2, 3, 4, 5, 6]) .and. all(back(:, 7:) == xy(:, origins(7:))), 'origins')
    call mesh%cells(types, labels, offsets, connectivity)
    call expect(all(types == DELAM_QUAD4) .and. all(labels == [3, 7]) .and. all(offsets == [1, 5, 9]), 'cells')
    call expect(all(connectivity(:4) == cells(:, 1)), 'connectivity comes back from 1')
    call mesh%interface_size(1, pairs=pairs)
    call mesh%interface_pairs(1, weights=weights)
    call expect(pairs == 2 .and. abs(sum(weights) - 1) < 1e-14_dp, 'weights alone')
    call mesh%interface_pairs(1, a, b, weights, frames)
    call expect(all(a == [2, 5]) .and. all(back(:, a) == back(:, b)), 'pairs')
    call expect(all(frames(:, 1, 1) == [1.0_dp, 0.0_dp]), 'the normal is the first column of a frame')
    faces = mesh%interface_faces(1)
    call expect(all(shape(faces) == [2, 1]) .and. minval(faces) == 1 .and. maxval(faces) == 2, 'faces')
    found = mesh%find_nodes([1.0_dp, 0.0_dp], [1.0_dp, 0.0_dp])
    call expect(size(found) == 2, 'nodes of both bodies')
    found = mesh%find_nodes([1.0_dp, 0.0_dp], [1.0_dp, 0.0_dp], 3)
    call expect(size(found) == 1 .and. found(1) == 2, 'nodes of one body')
    call mesh%find_patch(3, [0.0_dp, 0.0_dp], [0.5_dp, 0.0_dp], [0.0_dp, -1.0_dp], found, weights)
    call expect(abs(sum(weights) - 0.5_dp) < 1e-14_dp .and. all(found == [1, 2]), 'a patch')
    call mesh%find_patch(-1, [0.0_dp, 0.0_dp], [2.0_dp, 0.0_dp], [0.0_dp, -1.0_dp], found, weights)
    call expect(size(found) == 4 .and. all(abs(weights - 0.5_dp) < 1e-14_dp), 'a patch of all bodies')

    wide = reshape([real(dp) :: 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], [3, 8])
    spread_out = 7
    spread_out(:, ::2) = wide
    call solid%create(context, spread_out(:, ::2))
    call solid%add_cells(DELAM_HEX8, reshape([(int(i, delam_index), i=1, 8)], [8, 1]))
    call expect(all(solid%nodes() == wide), 'every other column')
    call expect(all(solid%node_bodies() == 0), 'absent bodies are all 0')
  end subroutine test_mesh

  ! Two squares beside each other with an interface of two pairs, and two nodes without cells.
  subroutine make_squares(mesh, context)
    type(delam_mesh), intent(inout) :: mesh
    type(delam_context), intent(in) :: context
    call mesh%create(context, reshape([real(dp) :: 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 2, 0, 1, 1, 2, 1, 9, 9, 9, 8], &
                                      [2, 10]))
    call mesh%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3, 5, 6, 8, 7], [4, 2]), [0, 1])
    call mesh%add_interface(0, 1)
  end subroutine make_squares

  ! Whatever has an index takes the last one there is, which counted from 0 would be outside.
  subroutine test_problem()
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_law) :: law
    type(delam_problem) :: problem
    integer(delam_index) :: one, two, three, inside
    integer(delam_index), allocatable :: starts(:), columns(:)
    real(dp), allocatable :: values(:), coefficients(:,:), forces(:), work(:,:)
    real(dp) :: length, stiffness, share
    integer :: status
    call context%create()
    call make_squares(mesh, context)
    call problem%create(context, mesh)
    call problem%set_elastic(1.0_dp, 0.3_dp)
    call problem%set_orthotropic([3.0_dp, 1.0_dp, 1.0_dp, 0.2_dp, 0.2_dp, 0.2_dp, 0.5_dp, 0.5_dp, 0.5_dp], 1)
    call problem%set_orientation(reshape([real(dp) :: 0, 1, 0, 1, 0, 0], [3, 2, 1]), [2_delam_index], 1)
    call problem%set_bonded(1)
    call problem%set_contact(1)
    call problem%set_contact(2, status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'there is no interface 2')
    call law%create(context, 'griffith')
    call law%set('normal_stiffness', 1.0_dp)
    call law%set('tangential_stiffness', 1.0_dp)
    call law%set('normal_toughness', 1.0_dp)
    call law%set('tangential_toughness', 1.0_dp)
    call problem%set_law(1, law)
    call problem%set_adhesion(1, [1_delam_index, 2_delam_index], [0.5_dp, 1.0_dp])
    call problem%process_zone(1, length)
    call expect(length >= 0, 'a process zone')
    call problem%set_adhesion_box(1, [-9.0_dp, -9.0_dp], [9.0_dp, 9.0_dp], 0.5_dp, inside)
    call expect(inside == 2, 'the pairs in a box')
    call problem%set_adhesion_box(1, [8.0_dp, 8.0_dp], [9.0_dp, 9.0_dp], 0.0_dp, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'without a count, a box without pairs is an error')
    call problem%propose(1, 3.0_dp, stiffness, share)
    call expect(stiffness > 0 .and. share > 0 .and. share < 1, 'a stiffness is proposed')
    call problem%add_pattern('pull', [0.0_dp], [1.0_dp], one)
    call problem%add_pattern('push', [0.0_dp, 1.0_dp], [0.0_dp, 2.0_dp], two)
    call problem%add_pattern('heat', [0.0_dp], [3.0_dp], three)
    call expect(all([one, two, three] == [1, 2, 3]) .and. problem%pattern_count() == 3, 'patterns count from 1')
    call expect(problem%pattern_name(three) == 'heat' .and. problem%pattern_name(one) == 'pull', 'names of patterns')
    call expect(all(abs(problem%factors(0.5_dp) - [1, 1, 3]) < 1e-14_dp), 'factors')
    call problem%add_forces(two, [8_delam_index], reshape([4.0_dp, 5.0_dp], [2, 1]))
    forces = problem%forces(two)
    call expect(all(abs(forces(15:16) - [4, 5]) < 1e-14_dp) .and. all(abs(forces(:14)) < 1e-14_dp), 'forces of node 8')
    call problem%add_eigenstrain(three, [1e-3_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], 1)
    work = problem%eigenstrain_energy()
    call expect(work(3, 3) > 0 .and. all(abs(work(:2, :)) < 1e-14_dp), 'energy of the strains of pattern 3')

    call problem%prescribe_nodes([1_delam_index], [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes([1_delam_index, 10_delam_index], [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes([10_delam_index], [1.0_dp, 0.0_dp], one, 7.0_dp)
    call problem%prescribe_mean([9_delam_index, 10_delam_index], [1.0_dp, 3.0_dp], [1.0_dp, 0.0_dp], [one], [2.0_dp])
    call problem%add_equation([8_delam_index, 10_delam_index], reshape([real(dp) :: 0, 1, 1, 0], [2, 2]), [one], &
                              [6.0_dp])
    call problem%constraints(starts, columns, values, coefficients)
    call expect(all(starts == [1, 2, 3, 4, 5, 7, 9]), 'rows of constraints')
    call expect(all(columns == [1, 2, 20, 19, 17, 19, 16, 19]), 'DOFs of constraints')
    call expect(all(abs(4*values - [4, 4, 4, 4, 1, 3, 4, 4]) < 1e-13_dp), 'entries of constraints')
    call expect(all(shape(coefficients) == [3, 6]) .and. all(abs(coefficients(1, :) - [0, 0, 0, 7, 2, 6]) < 1e-14_dp), &
                'prescribed: (patterns, rows)')
    call problem%body_matrix(0, starts, columns, values)
    call expect(starts(1) == 1 .and. size(starts) == 9 .and. starts(9) == size(columns) + 1, 'rows of a body')
    call expect(minval(columns) == 1 .and. maxval(columns) == 8 .and. abs(sum(values)) < 1e-12_dp, 'a body floats')
    call expect(len_trim(problem%hash()) == 16, 'a hash')
  end subroutine test_problem

  subroutine test_obstacles_ties_periods()
    type(delam_context) :: context
    type(delam_mesh) :: squares, stack, coarse, slit, slot
    type(delam_problem) :: cell
    integer(delam_index), allocatable :: a(:), b(:), nodes(:), starts(:), of(:)
    integer(delam_index) :: pattern
    real(dp), allocatable :: weights(:), xy(:,:)
    integer :: interface, status, i, seams, walls
    integer(delam_label) :: body_a, body_b
    call context%create()
    call make_squares(squares, context)
    call squares%add_obstacle([1_delam_index, 2_delam_index], reshape([real(dp) :: 0, 1, 0, 1], [2, 2]), &
                              10_delam_index, interface=interface)
    call squares%interface_pairs(interface, a, b, weights)
    call expect(interface == 2 .and. all(a == 10) .and. all(b == [1, 2]), 'an obstacle')
    call expect(all(abs(weights - 0.5_dp) < 1e-14_dp), 'nodal weights')

    ! One cell below two, whose middle node at the bottom lies on the first one's edge.
    call stack%create(context, reshape([real(dp) :: 0, 0, 2, 0, 0, 1, 2, 1, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2, 2, 2], &
                                       [2, 10]))
    call stack%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3, 5, 6, 9, 8, 6, 7, 10, 9], [4, 3]), &
                         [0, 1, 1])
    call stack%add_projected_interface(0, 1, interface=interface)
    call expect(interface == 1, 'a projected interface')
    call stack%node_ties(nodes, starts, of, weights)
    xy = stack%nodes()
    call expect(size(nodes) > 0 .and. minval(nodes) == 11 .and. maxval(nodes) == size(xy, 2), 'tied nodes are appended')
    call expect(starts(1) == 1 .and. starts(size(starts)) == size(of) + 1, 'starts of ties')
    do i = 1, size(nodes)
      call expect(all(abs(matmul(xy(:, of(starts(i):starts(i + 1) - 1)), weights(starts(i):starts(i + 1) - 1)) &
                          - xy(:, nodes(i))) < 1e-12_dp), 'a tied node lies where its nodes put it')
    end do

    call coarse%create(context, reshape([real(dp) :: 0, 0, 2, 0, 0, 1, 2, 1, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2, 2, 2], &
                                        [2, 10]))
    call coarse%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3, 5, 6, 9, 8, 6, 7, 10, 9], [4, 3]), &
                          [0, 1, 1])
    call coarse%add_mortar_interface(1, 0, interface=interface)
    call coarse%node_ties(nodes, starts, of, weights)
    call expect(interface == 1 .and. all(of == [5, 6, 7, 5, 6, 7]), 'a mortar interface')

    ! A row of two cells on another, with a node of its own on the left: node 5 is the tip, 10 is that of 4.
    call slit%create(context, reshape([real(dp) :: 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2, 2, 2, 0, 1], &
                                      [2, 10]))
    call slit%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 5, 4, 2, 3, 6, 5, 10, 5, 8, 7, &
                                              5, 6, 9, 8], [4, 4]))
    call slit%add_seams(count=seams)
    call slit%interface_pairs(1, a, b)
    call expect(seams == 1 .and. all(a == [4]) .and. all(b == [10]), 'a seam')
    call slit%add_seams(tolerance=0.7_dp, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'a tolerance above 0.5')

    ! Three rows of four cells, without the last two of the middle row: the walls of this slot are 1 apart.
    call slot%create(context, reshape([(real(mod(i, 5), dp), real(i / 5, dp), i = 0, 19)], [2, 20]))
    call slot%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 7, 6, 2, 3, 8, 7, 3, 4, 9, 8, 4, 5, 10, 9, &
                                              6, 7, 12, 11, 7, 8, 13, 12, 11, 12, 17, 16, 12, 13, 18, 17, &
                                              13, 14, 19, 18, 14, 15, 20, 19], [4, 10]))
    call slot%add_self_contact(0.5_dp, count=walls)
    call expect(walls == 0, 'walls farther apart than the gap')
    call slot%add_self_contact(1.1_dp, walls)
    call slot%interface_size(1, body_a=body_a, body_b=body_b)
    call expect(walls == 1 .and. body_a == 0 .and. body_b == 0, 'the walls of a slot')
    call slot%add_self_contact(0.0_dp, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'a gap of 0')

    call squares%create(context, reshape([real(dp) :: 0, 0, 1, 0, 0, 1, 1, 1, 9, 9, 9, 8], [2, 6]))
    call squares%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3], [4, 1]))
    call cell%create(context, squares)
    call cell%add_periodic(reshape([real(dp) :: 1, 0, 0, 1], [2, 2]), [5_delam_index, 6_delam_index], status=status)
    call expect(status == DELAM_OK, 'a periodic cell with its control nodes')
    call cell%add_pattern('found', [0.0_dp], [1.0_dp], pattern)
    call cell%begin_constraints(1_delam_index, 2_delam_index, 0.5_dp, pattern, status=status)
    call expect(status == DELAM_OK, 'constraints that begin')
    call cell%add_pattern('left', [0.0_dp], [1.0_dp], pattern)
    call cell%end_constraints(2_delam_index, 1_delam_index, 0.25_dp, pattern, status=status)
    call expect(status == DELAM_ERROR_PROBLEM, 'a constraint that ends before it begins')
  end subroutine test_obstacles_ties_periods

  ! A stiff, brittle interface between two soft squares breaks all at once.
  subroutine test_gaps()
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    integer(delam_index) :: apart
    integer :: status
    character(16) :: known, small
    call context%create()
    call mesh%create(context, reshape([real(dp) :: 0, 0, 1, 0, 0, 1, 1, 1, 0, 1.125, 1, 1.125, 0, 2, 1, 2], [2, 8]))
    call mesh%add_cells(DELAM_QUAD4, reshape([integer(delam_index) :: 1, 2, 4, 3, 5, 6, 8, 7], [4, 2]), [0, 1])
    call mesh%add_mortar_interface(0, 1, 0.25_dp)
    call problem%create(context, mesh)
    call problem%set_elastic(1.0_dp, 0.3_dp)
    call problem%set_contact(1)
    call problem%add_pattern('apart', [0.0_dp], [1.0_dp], apart)
    call problem%set_gaps(1, apart)
    known = problem%hash()
    call problem%set_gaps(1, apart, [0.125_dp, 0.5_dp], 0.25_dp)
    small = problem%hash()
    call problem%set_gaps(1, apart, [0.0_dp, 0.5_dp])
    call expect(small == problem%hash() .and. small /= known, 'small gaps count as 0')
    call problem%set_gaps(1, apart, [0.125_dp, 0.125_dp])
    call expect(known == problem%hash(), 'the distances in the mesh')
    call problem%set_gaps(1, apart, [0.125_dp], status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'one gap of two')
    call problem%set_gaps(2, apart, [0.125_dp], status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'there is no interface 2')
    call problem%set_gaps(1, apart + 1, status=status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'there is no pattern 2')
    call expect(known == problem%hash(), 'nothing has changed')
  end subroutine test_gaps

  subroutine test_jump()
    type(delam_context) :: context
    type(delam_mesh) :: mesh
    type(delam_law) :: law
    type(delam_problem) :: problem
    type(delam_solver) :: solver
    integer(delam_index) :: pull, step, interface, first, last
    real(dp) :: before, time
    real(dp), allocatable :: reaction_before(:), reaction_after(:)
    call context%create()
    call make_squares(mesh, context)
    call law%create(context, 'griffith')
    call law%set('normal_stiffness', 1e3_dp)
    call law%set('tangential_stiffness', 1e3_dp)
    call law%set('normal_toughness', 1e-3_dp)
    call law%set('tangential_toughness', 1e-3_dp)
    call problem%create(context, mesh)
    call problem%set_elastic(1.0_dp, 0.0_dp)
    call problem%set_law(1, law)
    call problem%add_pattern('pull', [0.0_dp, 1.0_dp], [0.0_dp, 4.0_dp], pull)
    call problem%prescribe_nodes([1_delam_index, 3_delam_index], [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes([1_delam_index, 5_delam_index], [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes([6_delam_index, 8_delam_index], [1.0_dp, 0.0_dp], pull)
    call problem%set('jump_tolerance', 1e-3_dp)
    call solver%create(problem, 0.0_dp)
    call solver%advance(1.0_dp)
    call expect(solver%jump_count() >= 1, 'a jump')
    if (solver%jump_count() < 1) return
    call solver%jump(1, step, before, time, interface=interface, first_pair=first, last_pair=last)
    call solver%jump_reactions(1, reaction_before, reaction_after)
    call expect(size(reaction_before) == 1 .and. reaction_before(1) > reaction_after(1), 'a jump loses load')
    call expect(step == 1 .and. before < time .and. time < 1, 'in the first step')
    call expect(interface == 1 .and. first == 1 .and. last == 2, 'of both pairs')
  end subroutine test_jump

  ! A law by Fortran procedures does what the same law of the library does, also once its names are gone.
  subroutine test_host_law()
    type(delam_context) :: context
    type(delam_law) :: ours, theirs, broken
    type(delam_solver) :: a, b
    real(dp), parameter :: jump(2, 4) = reshape([real(dp) :: 1e-6, 0, 5e-6, 1e-6, 8e-6, 2e-6, 1e-3, 0], [2, 4])
    real(dp), parameter :: mixity(4) = [0.0_dp, 0.1_dp, 0.3_dp, 0.0_dp]
    real(dp) :: adhesion(4, 2), traction(2, 4, 2), onset(4), toughness(4)
    integer :: status, step
    character(200) :: message
    call context%create()
    call make_law(ours, context, .true.)
    call make_law(theirs, context, .false.)
    call ours%check()
    call ours%toughness(mixity, onset, toughness)
    call expect(all(abs(onset - 100) < 1e-9_dp) .and. all(abs(toughness - 250) < 1e-9_dp), 'toughness of a host law')
    call ours%respond(jump, mixity, spread(1.0_dp, 1, 4), adhesion(:, 1), traction(:, :, 1))
    call theirs%respond(jump, mixity, spread(1.0_dp, 1, 4), adhesion(:, 2), traction(:, :, 2))
    call expect(all(abs(adhesion(:, 1) - adhesion(:, 2)) < 1e-12_dp), 'adhesion of a host law')
    call expect(any(adhesion > 0.1_dp .and. adhesion < 0.9_dp), 'the softening branch was met')
    call theirs%respond(jump, mixity, spread(1.0_dp, 1, 4), adhesion(:, 1))
    call expect(all(adhesion(:, 1) == adhesion(:, 2)), 'traction may be absent')
    call broken%create_host(context, 'broken', bilinear(onset=1.0_dp, toughness=2.0_dp, broken=.true.))
    call broken%set('normal_stiffness', 1.0_dp)
    call broken%set('tangential_stiffness', 1.0_dp)
    call broken%check(status, message)
    call expect(status == DELAM_ERROR_PROBLEM .and. index(message, 'broken') > 0, 'a procedure that fails')
    call make_solver(a, context, .true.)
    call make_solver(b, context, .false.)
    call context%destroy()
    do step = 1, 5
      call a%advance(0.2_dp*step)
      call b%advance(0.2_dp*step)
      call a%commit()
      call b%commit()
    end do
    call expect(abs(a%value('dissipated') - b%value('dissipated')) < 1e-8_dp*b%value('dissipated'), 'the same march')
    call expect(b%value('dissipated') > 0.1_dp, 'something broke')
  end subroutine test_host_law

  subroutine test_solver()
    type(delam_context) :: context
    type(delam_solver) :: solver, again
    real(dp), allocatable :: jump(:,:), filled(:,:), adhesion(:,:), places(:,:), rates(:,:)
    integer(delam_index), allocatable :: starts(:)
    integer(delam_byte), allocatable :: bytes(:)
    integer(delam_index) :: rows, columns
    real(dp) :: reaction, volume, strain(6)
    integer :: i, status
    logical :: listed, described
    character(200) :: message
    character(:), allocatable :: subject, reason
    call context%create()
    call make_solver(solver, context, .false.)
    call solver%advance(0.5_dp)
    call solver%advance(0.6_dp, status, message)
    call expect(status == DELAM_ERROR_STATE, 'a pending step is committed or rolled back first')
    reaction = solver%value('reaction:opening')
    call solver%rollback()
    call expect(solver%value('time') == 0, 'rolled back')
    call solver%advance(0.5_dp)
    call expect(solver%value('reaction:opening') == reaction, 'the same step gives the same')
    call solver%commit()
    jump = solver%field('jump', 1)
    call solver%field_shape('jump', columns, rows)
    call expect(all(shape(jump) == [columns, rows]) .and. columns == 2 .and. rows == 61, 'a field is (columns, rows)')
    allocate(filled(columns, rows))
    call solver%fill_field('jump', filled, 1)
    call expect(all(filled == jump) .and. maxval(jump(1, :)) > 0, 'fill_field gives the same')
    call solver%fill_field('jump', filled(:, :5), 1, status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'an array that is too small')
    filled = solver%field('no such field', status=status, message=message)
    call expect(status == DELAM_ERROR_ARGUMENT .and. index(message, 'no such field') > 0, 'an unknown field')
    adhesion = solver%field('adhesion')
    call expect(minval(adhesion) < 0.5_dp .and. maxval(adhesion) == 1, 'a crack')
    call solver%front(1, starts, places=places)
    call expect(starts(1) == 1 .and. starts(size(starts)) == size(places, 2) + 1, 'fronts count from 1')
    call solver%front(1, starts, rates=rates)
    call expect(size(rates, 1) == 3, 'rates of three modes')
    call solver%average(volume, strain)
    call expect(abs(volume - 60e-6_dp) < 1e-15_dp, 'volume of all bodies')
    call expect(size(solver%tangent()) == 1, 'tangent')
    listed = .false.
    do i = 1, solver%value_count()
      listed = listed .or. solver%value_name(i) == 'reaction:opening'
    end do
    do i = 1, solver%value_count()
      call solver%describe_value(i, alias=subject, cost=reason, recorded=described)
      if (solver%value_name(i) == 'kkt_gap') call expect(reason == 'recovers' .and. .not. described, 'a dear value')
      if (solver%value_name(i) == 'am_iterations') call expect(subject == 'staggered_iterations' .and. &
        solver%value(subject) == solver%value('am_iterations') .and. described, 'a second name')
    end do
    call expect(listed .and. len(solver%value_name(solver%value_count())) > 0, 'names of values, to the last')
    call expect(solver%option('solution') == 'local' .and. solver%option('no such option') == '', 'options')
    call solver%plan_item(1, subject=subject, reason=reason)
    call expect(solver%plan_count() > 0 .and. index(solver%plan(), subject) == 1 .and. len(reason) > 0, 'the plan')
    call expect(solver%jump_count() == 0, 'no jumps were looked for')

    bytes = solver%save()
    call make_solver(again, context, .false.)
    call again%load(bytes)
    call again%advance(1.0_dp)
    call solver%advance(1.0_dp)
    call expect(again%value('dissipated') == solver%value('dissipated'), 'saved and gone on with')
    bytes(size(bytes)/2) = not(bytes(size(bytes)/2))
    call make_solver(again, context, .false.)
    call again%load(bytes, status)
    call expect(status == DELAM_ERROR_SNAPSHOT, 'damaged bytes are refused')
    call solver%rollback()
    call solver%equilibrate(0.5_dp)
    call solver%rollback()
    call solver%equilibrate(0.5_dp, spread(1.0_dp, 1, 61))
    call expect(abs(solver%value('time') - 0.5_dp) < 1e-15_dp, 'one displacement step')
    call solver%rollback()
    call solver%equilibrate(0.5_dp, spread(1.0_dp, 1, 3), status)
    call expect(status == DELAM_ERROR_ARGUMENT, 'adhesion of some pairs alone')
  end subroutine test_solver

  subroutine test_observer()
    type(delam_context) :: context
    type(delam_solver) :: solver
    type(counter) :: watch
    integer :: status, calls
    call context%create()
    call context%observe(watch)
    call make_solver(solver, context, .false.)
    call solver%advance(0.5_dp)
    call solver%rollback()
    calls = watch%calls
    call expect(calls > 0 .and. len(watch%last) > 0, 'progress is told')
    watch%cancel_at = calls + 2
    call solver%advance(0.5_dp, status)
    call expect(status == DELAM_CANCELLED .and. watch%calls == calls + 2, 'cancelled at the second call')
    call context%unobserve()
    call solver%advance(0.5_dp)
    call expect(watch%calls == calls + 2, 'not asked any more, and the solver is usable')
    call solver%rollback()
    call context%cancel()
    call solver%advance(0.5_dp, status)
    call expect(status == DELAM_CANCELLED, 'a request is kept for the next call')
    call solver%advance(0.5_dp, status)
    call expect(status == DELAM_OK, 'and consumed by it')
  end subroutine test_observer

  ! Names of one object, arrays, components and allocated objects: valgrind says whether each ends once.
  subroutine test_owners()
    type :: part
      type(delam_mesh) :: mesh
    end type part
    type(delam_context) :: context
    type(delam_mesh) :: one, two
    type(delam_mesh), allocatable :: many(:)
    type(part), allocatable :: whole
    integer(delam_index) :: nodes
    integer :: i
    call context%create()
    call make_mesh(one)
    two = one
    call one%destroy()
    call expect(.not. one%exists() .and. two%exists(), 'a second name')
    call two%get_size(nodes=nodes)
    call expect(nodes == 8, 'the object lives')
    one = two
    one = one
    call one%get_size(nodes=nodes)
    call expect(nodes == 8, 'assigned to itself')
    call make_mesh(one)
    allocate(many(3), whole)
    do i = 1, 3
      call make_mesh(many(i))
    end do
    many(2) = many(1)
    call make_mesh(whole%mesh)
    many(3) = whole%mesh
    deallocate(whole)
    call many(3)%get_size(nodes=nodes)
    call expect(nodes == 8, 'of a component')
    call context%destroy()
    call two%get_size(nodes=nodes)
    call expect(nodes == 8, 'the context is kept by what was made with it')
    deallocate(many)
  contains
    subroutine make_mesh(mesh)
      type(delam_mesh), intent(inout) :: mesh
      call mesh%create_layers(context, [1.0_dp], [1_delam_index], [0.5_dp, 0.5_dp], [1_delam_index, 1_delam_index], &
                              DELAM_QUAD4)
    end subroutine make_mesh
  end subroutine test_owners
end module test_parts

program test_delam
  use test_parts
  implicit none
  character(16) :: word
  word = ''
  if (command_argument_count() > 0) call get_command_argument(1, word)
  if (word == 'stop') then
    call fall()
    print '(a)', 'still here'
    stop
  end if
  call expect(delam_abi() == DELAM_HEADER_ABI, 'the library has the interface of the header')
  call expect(index(delam_version_text(), '.') > 0, 'a version')
  call test_errors()
  call test_descriptions()
  call test_mesh()
  call test_problem()
  call test_obstacles_ties_periods()
  call test_gaps()
  call test_jump()
  call test_host_law()
  call test_solver()
  call test_observer()
  call test_owners()
  call finish()

contains

  subroutine fall()
    type(delam_context) :: context
    type(delam_law) :: law
    call context%create()
    call law%create(context, 'no-such-law')
  end subroutine fall
end program test_delam
