! SPDX-License-Identifier: BSD-3-Clause
! The problem: materials, laws, supports, loads, options.
module delam_problems
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_double, c_ptr, c_null_ptr, &
                                         c_associated
  use delam_raw
  use delam_kinds, only: delam_real, delam_index
  use delam_texts, only: delam_text, zero_ended
  use delam_objects, only: delam_object, shared, shared_of, adopt, keep, next_owner
  use delam_statuses, only: settle, refuse
  use delam_contexts, only: delam_context
  use delam_meshes, only: delam_mesh, dimension_of, pairs_of, body_or_all
  use delam_laws, only: delam_law
  implicit none
  private
  public :: delam_problem

  type, extends(delam_object) :: delam_problem
  contains
    procedure :: create => problem_create
    procedure :: set_plane => problem_set_plane
    procedure :: set_elastic => problem_set_elastic
    procedure :: set_orthotropic => problem_set_orthotropic
    procedure :: set_orientation => problem_set_orientation
    procedure :: set_formulation => problem_set_formulation
    procedure :: set_stiffness => problem_set_stiffness
    procedure :: set_law => problem_set_law
    procedure :: set_bonded => problem_set_bonded
    procedure :: set_contact => problem_set_contact
    procedure :: set_adhesion => problem_set_adhesion
    procedure :: set_adhesion_box => problem_set_adhesion_box
    procedure :: add_pattern => problem_add_pattern
    procedure, private :: problem_prescribe_nodes, problem_prescribe_patterns
    generic :: prescribe_nodes => problem_prescribe_nodes, problem_prescribe_patterns
    procedure :: prescribe_mean => problem_prescribe_mean
    procedure :: add_equation => problem_add_equation
    procedure :: add_periodic => problem_add_periodic
    procedure :: begin_constraints => problem_begin_constraints
    procedure :: end_constraints => problem_end_constraints
    procedure :: add_forces => problem_add_forces
    procedure :: add_eigenstrain => problem_add_eigenstrain
    procedure :: set_gaps => problem_set_gaps
    procedure, private :: problem_set_number, problem_set_whole, problem_set_text
    generic :: set => problem_set_number, problem_set_whole, problem_set_text
    procedure :: check => problem_check
    procedure :: hash => problem_hash
    procedure :: dofs => problem_dofs
    procedure :: process_zone => problem_process_zone
    procedure :: propose => problem_propose
    procedure :: plan => problem_plan
    procedure :: body_matrix => problem_body_matrix
    procedure :: constraints => problem_constraints
    procedure :: forces => problem_forces
    procedure :: eigenstrain_energy => problem_eigenstrain_energy
    procedure :: factors => problem_factors
    procedure :: pattern_count => problem_pattern_count
    procedure :: pattern_name => problem_pattern_name
    procedure, private :: same_problem
    generic :: assignment(=) => same_problem
    final :: drop_problem
  end type delam_problem

contains

  impure elemental subroutine drop_problem(self)
    type(delam_problem), intent(inout) :: self
    call self%destroy()
  end subroutine drop_problem

  subroutine same_problem(self, other)
    class(delam_problem), intent(inout) :: self
    type(delam_problem), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_problem

  subroutine problem_create(self, context, mesh, status, message)
    class(delam_problem), intent(inout) :: self
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: mesh
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_problem_create(context%handle(), mesh%handle(), made%handle)
    if (c_associated(made%handle)) then
      made%dimension = dimension_of(mesh)
      made%pairs = pairs_of(mesh)
      call adopt(self, made, 'problem', shared_of(context))
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine problem_create

  subroutine problem_set_plane(self, assumption, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: assumption
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_plane(self%handle(), zero_ended(assumption)), self, status, message)
  end subroutine problem_set_plane

  subroutine problem_set_elastic(self, young, poisson, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: young, poisson
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_elastic(self%handle(), body_or_all(body), young, poisson), self, status, message)
  end subroutine problem_set_elastic

  ! constants: E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
  subroutine problem_set_orthotropic(self, constants, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: constants(9)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_orthotropic(self%handle(), body_or_all(body), constants), self, status, message)
  end subroutine problem_set_orthotropic

  ! axes: (3, 2, count), directions of the material axes 1 and 2 of each of `cells`; without cells (3, 2, 1) for all.
  subroutine problem_set_orientation(self, axes, cells, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in), contiguous :: axes(:,:,:)
    integer(delam_index), intent(in), contiguous, optional :: cells(:)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = size(axes, 1) == 3 .and. size(axes, 2) == 2
    if (present(cells)) equal = equal .and. size(axes, 3) == size(cells)
    if (.not. equal) then
      call refuse('axes must be (3, 2, cells)', status, message)
      return
    end if
    call settle(delam_problem_set_orientation(self%handle(), body_or_all(body), size(axes, 3, c_int64_t), cells, axes, &
                                              1_c_int32_t), self, status, message)
  end subroutine problem_set_orientation

  subroutine problem_set_formulation(self, formulation, body, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: formulation
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_formulation(self%handle(), body_or_all(body), zero_ended(formulation)), self, &
                status, &
                message)
  end subroutine problem_set_formulation

  ! The stiffness of whole bodies as assembled by the host; by rows, as in body_matrix. nodes: all of their nodes;
  ! dofs: (dimension, nodes), the row of each displacement, absent: one after another; kernel: (rows, motions) without
  ! energy, absent: the library finds them.
  subroutine problem_set_stiffness(self, nodes, row_starts, columns, values, dofs, kernel, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:), row_starts(:), columns(:)
    real(delam_real), intent(in), contiguous :: values(:)
    integer(delam_index), intent(in), contiguous, optional :: dofs(:,:)
    real(delam_real), intent(in), contiguous, optional :: kernel(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: rows
    integer(c_int64_t) :: motions
    logical :: equal
    rows = size(row_starts) - 1
    equal = rows >= 0 .and. size(columns, kind=c_int64_t) == size(values, kind=c_int64_t)
    if (equal) equal = row_starts(rows + 1) == size(values, kind=c_int64_t) + 1
    if (equal .and. size(nodes) > 0) equal = mod(rows, size(nodes)) == 0 .and. in_space(self, rows/size(nodes))
    if (present(dofs)) equal = equal .and. size(dofs, 2) == size(nodes) .and. size(dofs) == rows
    if (present(kernel)) equal = equal .and. size(kernel, 1) == rows
    if (.not. equal) then
      call refuse('row_starts must be (dimension*nodes + 1) and end behind the columns and values, dofs ' // &
                  '(dimension, nodes), kernel (dimension*nodes, motions)', status, message)
      return
    end if
    motions = -1
    if (present(kernel)) motions = size(kernel, 2, c_int64_t)
    call settle(delam_problem_set_stiffness(self%handle(), size(nodes, kind=c_int64_t), nodes, dofs, row_starts, &
                                            columns, values, motions, kernel, 1_c_int32_t), self, status, message)
  end subroutine problem_set_stiffness

  subroutine problem_set_law(self, interface, law, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    type(delam_law), intent(in) :: law
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: it
    integer(c_int32_t) :: code
    code = delam_problem_set_law(self%handle(), interface - 1_c_int64_t, law%handle())
    if (code == DELAM_OK) then
      it => shared_of(law)
      if (allocated(it%law)) call keep(shared_of(self), it)
    end if
    call settle(code, self, status, message)
  end subroutine problem_set_law

  subroutine problem_set_bonded(self, interface, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_bonded(self%handle(), interface - 1_c_int64_t), self, status, message)
  end subroutine problem_set_bonded

  subroutine problem_set_contact(self, interface, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_contact(self%handle(), interface - 1_c_int64_t), self, status, message)
  end subroutine problem_set_contact

  subroutine problem_set_adhesion(self, interface, pairs, adhesion, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), intent(in), contiguous :: pairs(:)
    real(delam_real), intent(in), contiguous :: adhesion(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(pairs) /= size(adhesion)) then
      call refuse('pairs and adhesion: unequal sizes', status, message)
      return
    end if
    call settle(delam_problem_set_adhesion(self%handle(), interface - 1_c_int64_t, size(pairs, kind=c_int64_t), pairs, &
                                           adhesion, 1_c_int32_t), self, status, message)
  end subroutine problem_set_adhesion

  ! Of the pairs in the box from lower to upper, (dimension) each; count: their number. Without count, a box without
  ! pairs is an error.
  subroutine problem_set_adhesion_box(self, interface, lower, upper, adhesion, count, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    real(delam_real), intent(in), contiguous :: lower(:), upper(:)
    real(delam_real), intent(in) :: adhesion
    integer(delam_index), intent(out), optional :: count
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(lower) /= size(upper)) then
      call refuse('lower and upper: unequal sizes', status, message)
      return
    end if
    call settle(delam_problem_set_adhesion_box(self%handle(), interface - 1_c_int64_t, lower, upper, adhesion, count), &
                self, status, message)
  end subroutine problem_set_adhesion_box

  ! A factor that follows the line through (times, values).
  subroutine problem_add_pattern(self, name, times, values, pattern, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: name
    real(delam_real), intent(in), contiguous :: times(:), values(:)
    integer(delam_index), intent(out), optional :: pattern
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    if (size(times) /= size(values)) then
      call refuse('times and values: unequal sizes', status, message)
      return
    end if
    made = -1
    code = delam_problem_add_pattern(self%handle(), zero_ended(name), size(times, kind=c_int64_t), times, values, made)
    if (present(pattern)) pattern = made + 1
    call settle(code, self, status, message)
  end subroutine problem_add_pattern

  ! direction . u = coefficient * factor of the pattern; fixed at zero without a pattern. coefficient: 1 if absent.
  subroutine problem_prescribe_nodes(self, nodes, direction, pattern, coefficient, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: direction(:)
    integer(delam_index), intent(in), optional :: pattern
    real(delam_real), intent(in), optional :: coefficient
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: coefficients(1, size(nodes))
    if (.not. in_space(self, size(direction))) then
      call refuse('direction must have the size of the dimension', status, message)
      return
    end if
    if (.not. present(pattern)) then
      call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                                0_c_int64_t, index_base=1_c_int32_t), self, status, message)
      return
    end if
    coefficients = 1
    if (present(coefficient)) coefficients = coefficient
    call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                              1_c_int64_t, &
                                              [pattern], coefficients, 1_c_int32_t), self, status, message)
  end subroutine problem_prescribe_nodes

  ! coefficients: (patterns, nodes)
  subroutine problem_prescribe_patterns(self, nodes, direction, patterns, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:), patterns(:)
    real(delam_real), intent(in), contiguous :: direction(:), coefficients(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (any(shape(coefficients) /= [size(patterns), size(nodes)]) .or. .not. in_space(self, size(direction))) then
      call refuse('coefficients must be (patterns, nodes), direction (dimension)', status, message)
      return
    end if
    call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                              size(patterns, kind=c_int64_t), patterns, coefficients, 1_c_int32_t), &
                self, status, message)
  end subroutine problem_prescribe_patterns

  ! weights: (nodes); patterns and coefficients, both or neither: (patterns).
  subroutine problem_prescribe_mean(self, nodes, weights, direction, patterns, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: weights(:), direction(:)
    integer(delam_index), intent(in), contiguous, optional :: patterns(:)
    real(delam_real), intent(in), contiguous, optional :: coefficients(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. (paired(patterns, coefficients) .and. size(weights) == size(nodes) .and. &
               in_space(self, size(direction)))) then
      call refuse('nodes and weights, patterns and coefficients, direction and space: unequal sizes', status, message)
      return
    end if
    call settle(delam_problem_prescribe_mean(self%handle(), size(nodes, kind=c_int64_t), nodes, weights, direction, &
                                             count_of(patterns), patterns, coefficients, 1_c_int32_t), &
                self, status, message)
  end subroutine problem_prescribe_mean

  ! coefficients: (dimension, nodes); patterns and prescribed, both or neither: (patterns).
  subroutine problem_add_equation(self, nodes, coefficients, patterns, prescribed, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: coefficients(:,:)
    integer(delam_index), intent(in), contiguous, optional :: patterns(:)
    real(delam_real), intent(in), contiguous, optional :: prescribed(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. (paired(patterns, prescribed) .and. size(coefficients, 2) == size(nodes) .and. &
               in_space(self, size(coefficients, 1)))) then
      call refuse('coefficients must be (dimension, nodes), prescribed (patterns)', status, message)
      return
    end if
    call settle(delam_problem_add_equation(self%handle(), size(nodes, kind=c_int64_t), nodes, coefficients, &
                                           count_of(patterns), patterns, prescribed, 1_c_int32_t), self, status, &
                                           message)
  end subroutine problem_add_equation

  ! The library reports a problem that does not exist.
  function in_space(self, components)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: components
    logical :: in_space
    type(shared), pointer :: it
    in_space = .true.
    it => shared_of(self)
    if (associated(it)) in_space = it%dimension == components
  end function in_space

  ! Is that the number of pairs? The library reports an interface that does not exist.
  function one_each(self, interface, count)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer(c_int64_t), intent(in) :: count
    logical :: one_each
    type(shared), pointer :: it
    one_each = .true.
    it => shared_of(self)
    if (.not. associated(it)) return
    if (interface >= 1 .and. interface <= size(it%pairs)) one_each = it%pairs(interface) == count
  end function one_each

  pure function paired(patterns, values)
    integer(delam_index), intent(in), optional :: patterns(:)
    real(delam_real), intent(in), optional :: values(:)
    logical :: paired
    paired = present(patterns) .eqv. present(values)
    if (present(patterns) .and. present(values)) paired = size(patterns) == size(values)
  end function paired

  pure function count_of(patterns) result(count)
    integer(delam_index), intent(in), optional :: patterns(:)
    integer(c_int64_t) :: count
    count = 0
    if (present(patterns)) count = size(patterns)
  end function count_of

  ! periods: (dimension, periods); control_nodes: (periods).
  subroutine problem_add_periodic(self, periods, control_nodes, tolerance, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in), contiguous :: periods(:,:)
    integer(delam_index), intent(in), contiguous :: control_nodes(:)
    real(delam_real), intent(in), optional :: tolerance
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: distance
    if (size(periods, 2) /= size(control_nodes) .or. .not. in_space(self, size(periods, 1))) then
      call refuse('periods must be (dimension, control nodes)', status, message)
      return
    end if
    distance = 0
    if (present(tolerance)) distance = tolerance
    call settle(delam_problem_add_periodic(self%handle(), size(periods, 2, c_int64_t), periods, control_nodes, &
                                           distance, &
                                           1_c_int32_t), self, status, message)
  end subroutine problem_add_periodic

  ! Constraints, in the order in which they were added from 1 on, begin at a time, from where the nodes are then. The
  ! factor of the pattern, over that at the time, is what is left of the way to where they are prescribed.
  subroutine problem_begin_constraints(self, first, count, time, pattern, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: first, count, pattern
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_begin_constraints(self%handle(), first - 1, count, time, pattern - 1), self, status, &
                message)
  end subroutine problem_begin_constraints

  ! Constraints end at a time. Their forces, times the factor of the pattern over that at the time, take their place.
  subroutine problem_end_constraints(self, first, count, time, pattern, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: first, count, pattern
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_end_constraints(self%handle(), first - 1, count, time, pattern - 1), self, status, &
                message)
  end subroutine problem_end_constraints

  ! forces: (dimension, nodes)
  subroutine problem_add_forces(self, pattern, nodes, forces, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: forces(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(forces, 2) /= size(nodes) .or. .not. in_space(self, size(forces, 1))) then
      call refuse('forces must be (dimension, nodes)', status, message)
      return
    end if
    call settle(delam_problem_add_forces(self%handle(), pattern - 1, size(nodes, kind=c_int64_t), nodes, forces, &
                                         1_c_int32_t), self, status, message)
  end subroutine problem_add_forces

  ! strain: xx, yy, zz, 2xy, 2yz, 2zx
  subroutine problem_add_eigenstrain(self, pattern, strain, body, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    real(delam_real), intent(in) :: strain(6)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_add_eigenstrain(self%handle(), pattern - 1, body_or_all(body), strain), self, status, &
                message)
  end subroutine problem_add_eigenstrain

  ! gaps: (pairs), along the normals; absent for the distances in the mesh. Magnitudes up to adjust, or 0, count as 0.
  subroutine problem_set_gaps(self, interface, pattern, gaps, adjust, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), intent(in) :: pattern
    real(delam_real), intent(in), optional, contiguous :: gaps(:)
    real(delam_real), intent(in), optional :: adjust
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: distance
    if (present(gaps)) then
      if (.not. one_each(self, interface, size(gaps, kind=c_int64_t))) then
        call refuse('gaps must be (pairs)', status, message)
        return
      end if
    end if
    distance = 0
    if (present(adjust)) distance = adjust
    call settle(delam_problem_set_gaps(self%handle(), interface - 1_c_int64_t, pattern - 1, gaps, distance), self, &
                status, message)
  end subroutine problem_set_gaps

  subroutine problem_set_number(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_number(self%handle(), zero_ended(key), value), self, status, message)
  end subroutine problem_set_number

  subroutine problem_set_whole(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_number(self%handle(), zero_ended(key), real(value, c_double)), self, status, message)
  end subroutine problem_set_whole

  subroutine problem_set_text(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key, value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_text(self%handle(), zero_ended(key), zero_ended(value)), self, status, message)
  end subroutine problem_set_text

  subroutine problem_check(self, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_check(self%handle()), self, status, message)
  end subroutine problem_check

  function problem_hash(self, status, message) result(hash)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    character(16) :: hash
    character(17, kind=c_char) :: digits
    integer(c_int32_t) :: code
    digits = ''
    code = delam_problem_hash(self%handle(), digits)
    hash = digits(:16)
    call settle(code, self, status, message)
  end function problem_hash

  subroutine problem_dofs(self, primal, dual, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(out), optional :: primal, dual
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_dofs(self%handle(), primal, dual), self, status, message)
  end subroutine problem_dofs

  subroutine problem_process_zone(self, interface, length, spacing, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    real(delam_real), intent(out), optional :: length, spacing
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_process_zone(self%handle(), interface - 1_c_int64_t, length, spacing), self, status, &
                message)
  end subroutine problem_process_zone

  ! For the law of an interface, with at least `pairs` pairs in the process zone; 0: unknown or none.
  subroutine problem_propose(self, interface, pairs, stiffness, share, normal_strength, tangential_strength, status, &
                             message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    real(delam_real), intent(in) :: pairs
    real(delam_real), intent(out), optional :: stiffness, share, normal_strength, tangential_strength
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_propose(self%handle(), interface - 1_c_int64_t, pairs, stiffness, share, &
                                      normal_strength, tangential_strength), self, status, message)
  end subroutine problem_propose

  ! What an analysis would do, before it begins; nothing is factored. setup: seconds of the factorisations before the
  ! first step; memory: bytes at the peak.
  subroutine problem_plan(self, plan, setup, memory, status, message)
    class(delam_problem), intent(in) :: self
    character(:), allocatable, intent(out), optional :: plan
    real(delam_real), intent(out), optional :: setup, memory
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(c_ptr) :: text
    integer(c_int32_t) :: code
    text = c_null_ptr
    code = delam_problem_plan(self%handle(), text, setup, memory)
    if (present(plan)) plan = delam_text(text)
    call settle(code, self, status, message)
  end subroutine problem_plan

  ! Stiffness of a body by rows: those of row r are columns(row_starts(r) : row_starts(r+1)-1).
  subroutine problem_body_matrix(self, body, row_starts, columns, values, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: body
    integer(delam_index), allocatable, intent(out) :: row_starts(:), columns(:)
    real(delam_real), allocatable, intent(out) :: values(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, entries
    integer(c_int32_t) :: code
    rows = 0
    entries = 0
    code = delam_problem_body_matrix(self%handle(), body, rows, entries)
    allocate(row_starts(rows + 1), columns(entries), values(entries))
    row_starts = 0
    if (code == DELAM_OK) code = delam_problem_body_matrix(self%handle(), body, rows, entries, row_starts, columns, &
                                                           values)
    row_starts = row_starts + 1
    columns = columns + 1
    call settle(code, self, status, message)
  end subroutine problem_body_matrix

  ! As body_matrix, over the DOFs of the mesh; coefficients: (patterns, rows).
  subroutine problem_constraints(self, row_starts, columns, values, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), allocatable, intent(out) :: row_starts(:), columns(:)
    real(delam_real), allocatable, intent(out) :: values(:), coefficients(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, entries, patterns
    integer(c_int32_t) :: code
    rows = 0
    entries = 0
    patterns = 0
    code = delam_problem_constraints(self%handle(), rows, entries, patterns)
    allocate(row_starts(rows + 1), columns(entries), values(entries), coefficients(patterns, rows))
    row_starts = 0
    if (code == DELAM_OK) code = delam_problem_constraints(self%handle(), rows, entries, patterns, row_starts, &
                                                           columns, &
                                                           values, coefficients)
    row_starts = row_starts + 1
    columns = columns + 1
    call settle(code, self, status, message)
  end subroutine problem_constraints

  ! Nodal forces of a pattern at factor 1, (primal DOFs).
  function problem_forces(self, pattern, status, message) result(forces)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: forces(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_dofs(self%handle(), primal=count)
    allocate(forces(count))
    if (code == DELAM_OK) code = delam_problem_forces(self%handle(), pattern - 1, count, forces)
    call settle(code, self, status, message)
  end function problem_forces

  function problem_eigenstrain_energy(self, status, message) result(matrix)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    allocate(matrix(count, count))
    if (code == DELAM_OK) code = delam_problem_eigenstrain_energy(self%handle(), count*count, matrix)
    call settle(code, self, status, message)
  end function problem_eigenstrain_energy

  function problem_factors(self, time, status, message) result(factors)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: factors(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    allocate(factors(count))
    if (code == DELAM_OK) code = delam_problem_factors(self%handle(), time, count, factors)
    call settle(code, self, status, message)
  end function problem_factors

  function problem_pattern_count(self, status, message) result(count)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_index) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    call settle(code, self, status, message)
  end function problem_pattern_count

  function problem_pattern_name(self, pattern) result(name)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    character(:), allocatable :: name
    name = delam_text(delam_problem_pattern_name(self%handle(), pattern - 1))
  end function problem_pattern_name

end module delam_problems
