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
    procedure :: equilibrate => solver_equilibrate
    procedure :: value => solver_value
    procedure :: value_count => solver_value_count
    procedure :: value_name => solver_value_name
    procedure :: field_shape => solver_field_shape
    procedure :: field => solver_field
    procedure :: fill_field => solver_fill_field
    procedure :: average => solver_average
    procedure :: front => solver_front
    procedure :: tangent => solver_tangent
    procedure :: plan => solver_plan
    procedure :: plan_count => solver_plan_count
    procedure :: plan_item => solver_plan_item
    procedure :: option => solver_option
    procedure :: searched => solver_searched
    procedure :: look => solver_look
    procedure :: jump_count => solver_jump_count
    procedure :: jump => solver_jump
    procedure :: save => solver_save
    procedure :: load => solver_load
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

  subroutine solver_create(self, problem, time, status, message)
    class(delam_solver), intent(inout) :: self
    type(delam_problem), intent(in) :: problem
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made, of
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_solver_create(problem%handle(), time, made%handle)
    if (c_associated(made%handle)) then
      of => shared_of(problem)
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

  ! As field, into an array of the caller.
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

  ! (patterns, patterns)
  function solver_tangent(self, patterns, status, message) result(matrix)
    class(delam_solver), intent(in) :: self
    integer(delam_index), intent(in) :: patterns
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int32_t) :: code
    allocate(matrix(patterns, patterns))
    code = delam_solver_tangent(self%handle(), patterns*patterns, matrix)
    call settle(code, self, status, message)
  end function solver_tangent

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

  ! -1: back to the pending state, else the committed one.
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

  ! The committed state; load of a solver of the same scene takes it up again.
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

end module delam_solvers
