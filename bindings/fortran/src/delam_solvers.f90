! SPDX-License-Identifier: BSD-3-Clause
! The solver: load steps, energies, fields, fronts.
module delam_solvers
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_int64_t, c_null_ptr, c_associated
  use delam_raw
  use delam_kinds, only: delam_real, delam_index, delam_byte
  use delam_texts, only: delam_text, zero_ended
  use delam_objects, only: delam_object, shared, shared_of, adopt, keep_all, next_owner
  use delam_statuses, only: settle, refuse
  use delam_meshes, only: body_or_all
  use delam_problems, only: delam_problem
  implicit none
  private
  public :: delam_solver

  type, extends(delam_object) :: delam_solver
  contains
    procedure :: create => solver_create
    procedure :: advance => solver_advance
    procedure :: commit => solver_commit
    procedure :: rollback => solver_rollback
    procedure :: pending => solver_pending
    procedure :: set_history => solver_set_history
    procedure :: equilibrate => solver_equilibrate
    procedure :: value => solver_value
    procedure :: value_count => solver_value_count
    procedure :: value_name => solver_value_name
    procedure :: describe_value => solver_describe_value
    procedure :: record => solver_record
    procedure :: recorded_steps => solver_recorded_steps
    procedure :: recorded => solver_recorded
    procedure :: field_shape => solver_field_shape
    procedure :: field => solver_field
    procedure :: fill_field => solver_fill_field
    procedure :: average => solver_average
    procedure :: front => solver_front
    procedure :: tangent => solver_tangent
    procedure :: step_tangent => solver_step_tangent
    procedure :: condensed => solver_condensed
    procedure :: plan => solver_plan
    procedure :: plan_count => solver_plan_count
    procedure :: plan_item => solver_plan_item
    procedure :: option => solver_option
    procedure :: searched => solver_searched
    procedure :: look => solver_look
    procedure :: jump_count => solver_jump_count
    procedure :: jump => solver_jump
    procedure :: jump_reactions => solver_jump_reactions
    procedure :: save => solver_save
    procedure :: load => solver_load
    procedure :: save_file => solver_save_file
    procedure :: load_file => solver_load_file
    procedure, private :: same_solver
    generic :: assignment(=) => same_solver
    final :: drop_solver
  end type delam_solver

contains

  impure elemental subroutine drop_solver(self)
    type(delam_solver), intent(inout) :: self
    call self%destroy()
  end subroutine drop_solver

  subroutine same_solver(self, other)
    class(delam_solver), intent(inout) :: self
    type(delam_solver), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_solver

  ! like: shares the condensed bodies of another solver, if they are equal (delam_solver_create_like).
  subroutine solver_create(self, problem, time, status, message, like)
    class(delam_solver), intent(inout) :: self
    type(delam_problem), intent(in) :: problem
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(delam_solver), intent(in), optional :: like
    type(shared), pointer :: made, of
    integer(c_int32_t) :: code
    allocate(made)
    if (present(like)) then
      code = delam_solver_create_like(problem%handle(), like%handle(), time, made%handle)
    else
      code = delam_solver_create(problem%handle(), time, made%handle)
    end if
    if (c_associated(made%handle)) then
      of => shared_of(problem)
      if (delam_problem_pattern_count(problem%handle(), made%patterns) /= DELAM_OK) made%patterns = 0
      call adopt(self, made, 'solver', of%context)
      call keep_all(made, of)
    else
      deallocate(made)
    end if
    call settle(code, problem, status, message)
  end subroutine solver_create

  subroutine solver_advance(self, time, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_advance(self%handle(), time), self, status, message)
  end subroutine solver_advance

  subroutine solver_commit(self, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_commit(self%handle()), self, status, message)
  end subroutine solver_commit

  subroutine solver_rollback(self, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_rollback(self%handle()), self, status, message)
  end subroutine solver_rollback

  ! Whether a step is pending, to be committed or rolled back.
  function solver_pending(self, status, message) result(pending)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: pending
    integer(c_int32_t) :: code, answer
    answer = 0
    code = delam_solver_pending(self%handle(), answer)
    pending = answer /= 0
    call settle(code, self, status, message)
  end function solver_pending

  ! Changes the history of a pattern from the committed time on: the line from there through (times, values).
  subroutine solver_set_history(self, pattern, times, values, status, message)
    class(delam_solver), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    real(delam_real), intent(in), contiguous :: times(:), values(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(times) /= size(values)) then
      call refuse('times and values: unequal sizes', status, message)
      return
    end if
    call settle(delam_solver_set_history(self%handle(), pattern - 1, size(times, kind=c_int64_t), times, values), &
                self, status, message)
  end subroutine solver_set_history

  ! adhesion: of all pairs, interface after interface; absent: the committed one.
  subroutine solver_equilibrate(self, time, adhesion, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(in) :: time
    real(delam_real), intent(in), contiguous, optional :: adhesion(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, columns
    rows = 0
    columns = 0
    if (present(adhesion)) then
      if (delam_solver_field_shape(self%handle(), zero_ended('adhesion'), -1_c_int64_t, rows, &
                                   columns) == DELAM_OK .and. &
          size(adhesion) /= rows) then
        call refuse('adhesion must have one value for each pair of all interfaces', status, message)
        return
      end if
    end if
    call settle(delam_solver_equilibrate(self%handle(), time, adhesion), self, status, message)
  end subroutine solver_equilibrate

  function solver_value(self, key, status, message) result(value)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: value
    integer(c_int32_t) :: code
    value = 0
    code = delam_solver_value(self%handle(), zero_ended(key), value)
    call settle(code, self, status, message)
  end function solver_value

  function solver_value_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: values
    integer(c_int32_t) :: code
    values = 0
    code = delam_solver_value_count(self%handle(), values)
    count = int(values)
    call settle(code, self, status, message)
  end function solver_value_count

  function solver_value_name(self, index) result(name)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable :: name
    name = delam_text(delam_solver_value_name(self%handle(), index - 1_c_int64_t))
  end function solver_value_name

  ! A value, counted as value_name does. alias: another name for it, or ''; cost: 'free', 'reads' (goes over pairs or
  ! fronts) or 'recovers' (recovers the displacements, a sparse solve); scope: 'whole', 'interface' or 'pattern';
  ! recorded: record takes it.
  subroutine solver_describe_value(self, index, alias, unit, cost, scope, meaning, recorded, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: alias, unit, cost, scope, meaning
    logical, intent(out), optional :: recorded
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(c_ptr) :: texts(5)
    integer(c_int32_t) :: taken, code
    texts = c_null_ptr
    taken = 0
    code = delam_solver_value_info(self%handle(), index - 1_c_int64_t, texts(1), texts(2), texts(3), texts(4), &
                                   texts(5), taken)
    if (present(alias)) alias = delam_text(texts(1))
    if (present(unit)) unit = delam_text(texts(2))
    if (present(cost)) cost = delam_text(texts(3))
    if (present(scope)) scope = delam_text(texts(4))
    if (present(meaning)) meaning = delam_text(texts(5))
    if (present(recorded)) recorded = taken /= 0
    call settle(code, self, status, message)
  end subroutine solver_describe_value

  ! Records this value for the committed state and, with each later commit, for every further step.
  subroutine solver_record(self, key, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_record(self%handle(), zero_ended(key)), self, status, message)
  end subroutine solver_record

  ! The recorded steps: `count` of them, from `first` to the committed one.
  subroutine solver_recorded_steps(self, first, count, status, message)
    class(delam_solver), intent(in) :: self
    integer(delam_index), intent(out) :: first, count
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    first = 0
    count = 0
    code = delam_solver_recorded_size(self%handle(), first, count)
    call settle(code, self, status, message)
  end subroutine solver_recorded_steps

  ! A recorded value for each step; NaN for steps before it was requested.
  function solver_recorded(self, key, status, message) result(values)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: values(:)
    integer(c_int64_t) :: first, count
    integer(c_int32_t) :: code
    first = 0
    count = 0
    code = delam_solver_recorded_size(self%handle(), first, count)
    allocate(values(count))
    if (code == DELAM_OK) code = delam_solver_recorded(self%handle(), zero_ended(key), count, values)
    call settle(code, self, status, message)
  end function solver_recorded

  ! The field is (columns, rows). part: an interface, for the fields of pairs; absent: all of them.
  subroutine solver_field_shape(self, key, columns, rows, part, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer(delam_index), intent(out) :: columns, rows
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    columns = 0
    rows = 0
    code = delam_solver_field_shape(self%handle(), zero_ended(key), part_of(part), rows, columns)
    call settle(code, self, status, message)
  end subroutine solver_field_shape

  pure function part_of(part) result(index)
    integer, intent(in), optional :: part
    integer(c_int64_t) :: index
    index = -1
    if (present(part)) index = part - 1
  end function part_of

  function solver_field(self, key, part, status, message) result(values)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: values(:,:)
    integer(c_int64_t) :: rows, columns
    integer(c_int32_t) :: code
    rows = 0
    columns = 0
    code = delam_solver_field_shape(self%handle(), zero_ended(key), part_of(part), rows, columns)
    allocate(values(columns, rows))
    if (code == DELAM_OK) code = delam_solver_field(self%handle(), zero_ended(key), part_of(part), rows*columns, values)
    call settle(code, self, status, message)
  end function solver_field

  ! As field, but writes to an array of the caller.
  subroutine solver_fill_field(self, key, values, part, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(inout), contiguous :: values(:,:)
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_field(self%handle(), zero_ended(key), part_of(part), size(values, kind=c_int64_t), &
                                   values), &
                self, status, message)
  end subroutine solver_fill_field

  ! strain, stress: xx, yy, zz, xy, yz, zx
  subroutine solver_average(self, volume, strain, stress, body, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(out), optional :: volume, strain(6), stress(6)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_average(self%handle(), body_or_all(body), volume, strain, stress), self, status, message)
  end subroutine solver_average

  ! Points of front f: starts(f) .. starts(f+1)-1. places, directions: (dimension, points); rates: (3, points).
  subroutine solver_front(self, interface, starts, closed, places, directions, lengths, rates, zone_lengths, &
                          zone_pairs, &
                          status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), allocatable, intent(out) :: starts(:)
    logical, allocatable, intent(out), optional :: closed(:)
    real(delam_real), allocatable, intent(out), optional :: places(:,:), directions(:,:), lengths(:), rates(:,:)
    real(delam_real), allocatable, intent(out), optional :: zone_lengths(:), zone_pairs(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: fronts, points, pairs, dimension
    integer(c_int32_t) :: code
    integer(c_int32_t), allocatable :: loops(:)
    real(delam_real), allocatable :: p(:,:), d(:,:), l(:), r(:,:), zl(:), zp(:)
    fronts = 0
    points = 0
    dimension = 0
    pairs = 0
    code = delam_solver_front_count(self%handle(), interface - 1_c_int64_t, fronts, points)
    if (code == DELAM_OK) code = delam_solver_field_shape(self%handle(), zero_ended('jump'), interface - 1_c_int64_t, &
                                                          pairs, dimension)
    allocate(starts(fronts + 1), loops(fronts))
    starts = 0
    loops = 0
    if (present(places)) allocate(p(dimension, points))
    if (present(directions)) allocate(d(dimension, points))
    if (present(lengths)) allocate(l(points))
    if (present(rates)) allocate(r(3, points))
    if (present(zone_lengths)) allocate(zl(points))
    if (present(zone_pairs)) allocate(zp(points))
    if (code == DELAM_OK) code = delam_solver_front(self%handle(), interface - 1_c_int64_t, fronts, points, starts, &
                                                    loops, &
                                                    p, d, l, r, zl, zp)
    if (present(places)) call move_alloc(p, places)
    if (present(directions)) call move_alloc(d, directions)
    if (present(lengths)) call move_alloc(l, lengths)
    if (present(rates)) call move_alloc(r, rates)
    if (present(zone_lengths)) call move_alloc(zl, zone_lengths)
    if (present(zone_pairs)) call move_alloc(zp, zone_pairs)
    starts = starts + 1
    if (present(closed)) closed = loops == 1
    call settle(code, self, status, message)
  end subroutine solver_front

  ! At fixed adhesion and contact: (patterns, patterns), symmetric.
  function solver_tangent(self, status, message) result(matrix)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int64_t) :: patterns
    integer(c_int32_t) :: code
    patterns = patterns_of(self)
    allocate(matrix(patterns, patterns))
    code = delam_solver_tangent(self%handle(), patterns*patterns, matrix)
    call settle(code, self, status, message)
  end function solver_tangent

  ! Of the pending step, damage included: matrix(q, p) is the change of the reaction of pattern p with the factor of q.
  function solver_step_tangent(self, status, message) result(matrix)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int64_t) :: patterns
    integer(c_int32_t) :: code
    patterns = patterns_of(self)
    allocate(matrix(patterns, patterns))
    code = delam_solver_step_tangent(self%handle(), patterns*patterns, matrix)
    call settle(code, self, status, message)
  end function solver_step_tangent

  ! All bodies condensed onto the interfaces. With S = stiffness: (unknowns, unknowns), L = load: (unknowns, patterns)
  ! and A = constant: (patterns, patterns), 1/2 x.S x - theta.(x L) + 1/2 theta.A theta is the energy of bodies and dead
  ! forces; the local jumps of all pairs, component by component, are N x + theta O with the rows of N as those of
  ! body_matrix and O = offset: (patterns, rows).
  subroutine solver_condensed(self, stiffness, load, constant, row_starts, columns, values, offset, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), allocatable, intent(out) :: stiffness(:,:), load(:,:), constant(:,:)
    integer(delam_index), allocatable, intent(out) :: row_starts(:), columns(:)
    real(delam_real), allocatable, intent(out) :: values(:), offset(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: patterns, unknowns, entries, pairs, dimension, rows
    integer(c_int32_t) :: code
    patterns = patterns_of(self)
    unknowns = 0
    entries = 0
    pairs = 0
    dimension = 0
    code = delam_solver_condensed_size(self%handle(), unknowns, entries)
    if (code == DELAM_OK) code = delam_solver_field_shape(self%handle(), zero_ended('jump'), -1_c_int64_t, pairs, &
                                                          dimension)
    rows = pairs*dimension
    allocate(stiffness(unknowns, unknowns), load(unknowns, patterns), constant(patterns, patterns))
    allocate(row_starts(rows + 1), columns(entries), values(entries), offset(patterns, rows))
    row_starts = 0
    if (code == DELAM_OK) code = delam_solver_condensed(self%handle(), unknowns*unknowns, stiffness, load, constant, &
                                                        row_starts, columns, values, offset)
    row_starts = row_starts + 1
    columns = columns + 1
    call settle(code, self, status, message)
  end subroutine solver_condensed

  ! 0 if the solver does not exist.
  function patterns_of(self) result(patterns)
    class(delam_solver), intent(in) :: self
    integer(c_int64_t) :: patterns
    type(shared), pointer :: it
    patterns = 0
    it => shared_of(self)
    if (associated(it)) patterns = it%patterns
  end function patterns_of

  function solver_plan(self) result(text)
    class(delam_solver), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_solver_plan(self%handle()))
  end function solver_plan

  function solver_plan_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: items
    integer(c_int32_t) :: code
    items = 0
    code = delam_solver_plan_count(self%handle(), items)
    count = int(items)
    call settle(code, self, status, message)
  end function solver_plan_count

  subroutine solver_plan_item(self, index, subject, decision, reason, cost, saving, unit, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: subject, decision, reason, unit
    real(delam_real), intent(out), optional :: cost, saving
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(c_ptr) :: texts(4)
    integer(c_int32_t) :: code
    texts = c_null_ptr
    code = delam_solver_plan_item(self%handle(), index - 1_c_int64_t, texts(1), texts(2), texts(3), cost, saving, &
                                  texts(4))
    if (present(subject)) subject = delam_text(texts(1))
    if (present(decision)) decision = delam_text(texts(2))
    if (present(reason)) reason = delam_text(texts(3))
    if (present(unit)) unit = delam_text(texts(4))
    call settle(code, self, status, message)
  end subroutine solver_plan_item

  ! '' for an unknown key.
  function solver_option(self, key) result(value)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    character(:), allocatable :: value
    value = delam_text(delam_solver_option(self%handle(), zero_ended(key)))
  end function solver_option

  function solver_searched(self) result(text)
    class(delam_solver), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_solver_searched(self%handle()))
  end function solver_searched

  ! -1: back to the pending state, or the committed one if none is pending.
  subroutine solver_look(self, step, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: step
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_look(self%handle(), int(step, c_int64_t)), self, status, message)
  end subroutine solver_look

  function solver_jump_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: jumps
    integer(c_int32_t) :: code
    jumps = 0
    code = delam_solver_jump_count(self%handle(), jumps)
    count = int(jumps)
    call settle(code, self, status, message)
  end function solver_jump_count

  subroutine solver_jump(self, index, step, before, time, stored, dissipated, released, debonded, interface, &
                         first_pair, &
                         last_pair, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    integer(delam_index), intent(out), optional :: step
    real(delam_real), intent(out), optional :: before, time, stored, dissipated, released, debonded
    integer(delam_index), intent(out), optional :: interface, first_pair, last_pair
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    if (present(interface)) interface = -1
    if (present(first_pair)) first_pair = -1
    if (present(last_pair)) last_pair = -1
    code = delam_solver_jump(self%handle(), index - 1_c_int64_t, step, before, time, stored, dissipated, released, &
                             debonded, interface, first_pair, last_pair)
    if (present(interface)) interface = interface + 1
    if (present(first_pair)) first_pair = first_pair + 1
    if (present(last_pair)) last_pair = last_pair + 1
    call settle(code, self, status, message)
  end subroutine solver_jump

  ! Reactions of all patterns before and after a jump.
  subroutine solver_jump_reactions(self, index, before, after, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    real(delam_real), allocatable, intent(out) :: before(:), after(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: patterns
    integer(c_int32_t) :: code
    patterns = patterns_of(self)
    allocate(before(patterns), after(patterns))
    code = delam_solver_jump_reactions(self%handle(), index - 1_c_int64_t, patterns, before, after)
    call settle(code, self, status, message)
  end subroutine solver_jump_reactions

  ! The committed state; load of a solver of the same scene continues from it.
  function solver_save(self, status, message) result(bytes)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_byte), allocatable :: bytes(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    needed = 0
    code = delam_solver_save(self%handle(), 0_c_int64_t, needed=needed)
    allocate(bytes(needed))
    if (code == DELAM_OK) code = delam_solver_save(self%handle(), needed, bytes, needed)
    call settle(code, self, status, message)
  end function solver_save

  subroutine solver_load(self, bytes, status, message)
    class(delam_solver), intent(in) :: self
    integer(delam_byte), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_load(self%handle(), size(bytes, kind=c_int64_t), bytes), self, status, message)
  end subroutine solver_load

  ! The same bytes in a file. Trailing blanks of the path are ignored, as in open.
  subroutine solver_save_file(self, path, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_save_file(self%handle(), zero_ended(path)), self, status, message)
  end subroutine solver_save_file

  subroutine solver_load_file(self, path, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_load_file(self%handle(), zero_ended(path)), self, status, message)
  end subroutine solver_load_file

end module delam_solvers
