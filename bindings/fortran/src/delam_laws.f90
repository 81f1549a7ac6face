! SPDX-License-Identifier: BSD-3-Clause
! Interface laws, including those by Fortran procedures.
module delam_laws
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_int64_t, c_double, c_associated, c_loc, c_funloc, &
                                         c_f_pointer
  use delam_raw
  use delam_kinds, only: delam_real
  use delam_texts, only: zero_ended
  use delam_callbacks, only: delam_host_law
  use delam_objects, only: delam_object, shared, shared_of, adopt, next_owner
  use delam_statuses, only: settle, refuse
  use delam_contexts, only: delam_context
  implicit none
  private
  public :: delam_law

  type, extends(delam_object) :: delam_law
  contains
    procedure :: create => law_create
    procedure :: create_host => law_create_host
    procedure, private :: law_set_number, law_set_text
    generic :: set => law_set_number, law_set_text
    procedure :: set_table => law_set_table
    procedure :: check => law_check
    procedure :: toughness => law_toughness
    procedure :: respond => law_respond
    procedure, private :: same_law
    generic :: assignment(=) => same_law
    final :: drop_law
  end type delam_law

contains

  impure elemental subroutine drop_law(self)
    type(delam_law), intent(inout) :: self
    call self%destroy()
  end subroutine drop_law

  subroutine same_law(self, other)
    class(delam_law), intent(inout) :: self
    type(delam_law), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_law

  subroutine law_create(self, context, kind, status, message)
    class(delam_law), intent(inout) :: self
    type(delam_context), intent(in) :: context
    character(*), intent(in) :: kind
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_law_create(context%handle(), zero_ended(kind), made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'law', shared_of(context))
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine law_create

  ! `law` is copied. name identifies it in messages and in the hash of a problem.
  subroutine law_create_host(self, context, name, law, status, message)
    class(delam_law), intent(inout) :: self
    type(delam_context), intent(in) :: context
    character(*), intent(in) :: name
    class(delam_host_law), intent(in) :: law
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    allocate(made%law, source=law)
    code = delam_law_create_host(context%handle(), zero_ended(name), c_funloc(on_adhesion), c_funloc(on_dissipation), &
                                 c_loc(made), made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'law', shared_of(context))
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine law_create_host

  function on_adhesion(mixity, driving, adhesion, slope, user) bind(c, name='') result(answer)
    real(c_double), value :: mixity, driving
    real(c_double), intent(inout) :: adhesion, slope
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: failed
    call c_f_pointer(user, it)
    failed = .false.
    call it%law%adhesion(mixity, driving, adhesion, slope, failed)
    answer = merge(1_c_int32_t, 0_c_int32_t, failed)
  end function on_adhesion

  function on_dissipation(mixity, adhesion, dissipated, slope, mixity_slope, user) bind(c, name='') result(answer)
    real(c_double), value :: mixity, adhesion
    real(c_double), intent(inout) :: dissipated, slope, mixity_slope
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: failed
    call c_f_pointer(user, it)
    failed = .false.
    call it%law%dissipation(mixity, adhesion, dissipated, slope, mixity_slope, failed)
    answer = merge(1_c_int32_t, 0_c_int32_t, failed)
  end function on_dissipation

  subroutine law_set_number(self, key, value, status, message)
    class(delam_law), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_set(self%handle(), zero_ended(key), value), self, status, message)
  end subroutine law_set_number

  subroutine law_set_text(self, key, value, status, message)
    class(delam_law), intent(in) :: self
    character(*), intent(in) :: key, value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_set_text(self%handle(), zero_ended(key), zero_ended(value)), self, status, message)
  end subroutine law_set_text

  subroutine law_set_table(self, xi, s, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: xi(:), s(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(xi) /= size(s)) then
      call refuse('xi and s: unequal sizes', status, message)
      return
    end if
    call settle(delam_law_set_table(self%handle(), size(xi, kind=c_int64_t), xi, s), self, status, message)
  end subroutine law_set_table

  subroutine law_check(self, status, message)
    class(delam_law), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_check(self%handle()), self, status, message)
  end subroutine law_check

  subroutine law_toughness(self, mixity, onset, toughness, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: mixity(:)
    real(delam_real), intent(out), contiguous, optional :: onset(:), toughness(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = .true.
    if (present(onset)) equal = size(onset) == size(mixity)
    if (present(toughness)) equal = equal .and. size(toughness) == size(mixity)
    if (.not. equal) then
      call refuse('onset and toughness must have the size of mixity', status, message)
      return
    end if
    call settle(delam_law_toughness(self%handle(), size(mixity, kind=c_int64_t), mixity, onset, toughness), self, &
                status, &
                message)
  end subroutine law_toughness

  ! jump, traction: (dimension, count), local, the normal component first; mixity, adhesion_old, adhesion: (count).
  subroutine law_respond(self, jump, mixity, adhesion_old, adhesion, traction, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: jump(:,:), mixity(:), adhesion_old(:)
    real(delam_real), intent(out), contiguous :: adhesion(:)
    real(delam_real), intent(out), contiguous, optional :: traction(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = all([size(mixity), size(adhesion_old), size(adhesion)] == size(jump, 2))
    if (present(traction)) equal = equal .and. all(shape(traction) == shape(jump))
    if (.not. equal) then
      call refuse('jump, mixity, adhesion_old, adhesion and traction: unequal sizes', status, message)
      return
    end if
    call settle(delam_law_respond(self%handle(), size(jump, 1, c_int32_t), size(jump, 2, c_int64_t), jump, mixity, &
                                  adhesion_old, adhesion, traction), self, status, message)
  end subroutine law_respond

end module delam_laws
