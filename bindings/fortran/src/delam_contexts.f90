! SPDX-License-Identifier: BSD-3-Clause
! The context: messages, log, progress.
module delam_contexts
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_int64_t, c_null_ptr, c_null_funptr, c_associated, &
                                         c_loc, c_funloc, c_f_pointer
  use delam_raw
  use delam_texts, only: delam_text
  use delam_callbacks, only: delam_observer
  use delam_objects, only: delam_object, shared, shared_of, adopt, next_owner
  use delam_statuses, only: settle, conclude
  implicit none
  private
  public :: delam_context

  type, extends(delam_object) :: delam_context
  contains
    procedure :: create => context_create
    procedure :: message => context_message
    procedure :: observe => context_observe
    procedure :: unobserve => context_unobserve
    procedure :: cancel => context_cancel
    procedure, private :: same_context
    generic :: assignment(=) => same_context
    final :: drop_context
  end type delam_context

contains

  impure elemental subroutine drop_context(self)
    type(delam_context), intent(inout) :: self
    call self%destroy()
  end subroutine drop_context

  subroutine same_context(self, other)
    class(delam_context), intent(inout) :: self
    type(delam_context), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_context

  subroutine context_create(self, status, message)
    class(delam_context), intent(inout) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_context_create(made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'context', null())
    else
      deallocate(made)
    end if
    if (code == DELAM_OK) then
      call conclude(code, '', status, message)
    else
      call conclude(code, 'no context could be made', status, message)
    end if
  end subroutine context_create

  ! Message of the last status that was not DELAM_OK.
  function context_message(self) result(text)
    class(delam_context), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_context_message(self%handle()))
  end function context_message

  ! `observer` is not copied: the caller owns it, and it must live as long as the context may call it.
  subroutine context_observe(self, observer, status, message)
    class(delam_context), intent(inout) :: self
    class(delam_observer), intent(in), target :: observer
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: it
    integer(c_int32_t) :: code
    it => shared_of(self)
    if (.not. associated(it)) then
      call settle(DELAM_ERROR_HANDLE, self, status, message)
      return
    end if
    code = delam_context_set_log(it%handle, c_funloc(on_log), c_loc(it))
    if (code == DELAM_OK) code = delam_context_set_progress(it%handle, c_funloc(on_progress), c_loc(it))
    if (code == DELAM_OK) it%observer => observer
    call settle(code, self, status, message)
  end subroutine context_observe

  subroutine context_unobserve(self, status, message)
    class(delam_context), intent(inout) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: it
    integer(c_int32_t) :: code
    code = delam_context_set_log(self%handle(), c_null_funptr, c_null_ptr)
    if (code == DELAM_OK) code = delam_context_set_progress(self%handle(), c_null_funptr, c_null_ptr)
    it => shared_of(self)
    if (code == DELAM_OK .and. associated(it)) nullify(it%observer)
    call settle(code, self, status, message)
  end subroutine context_unobserve

  ! May be called from any thread.
  subroutine context_cancel(self, status, message)
    class(delam_context), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_context_cancel(self%handle()), self, status, message)
  end subroutine context_cancel

  subroutine on_log(level, text, user) bind(c, name='')
    integer(c_int32_t), value :: level
    type(c_ptr), value :: text, user
    type(shared), pointer :: it
    call c_f_pointer(user, it)
    call it%observer%log(int(level), delam_text(text))
  end subroutine on_log

  function on_progress(stage, done, total, user) bind(c, name='') result(answer)
    type(c_ptr), value :: stage, user
    integer(c_int64_t), value :: done, total
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: cancel
    call c_f_pointer(user, it)
    cancel = .false.
    call it%observer%progress(delam_text(stage), done, total, cancel)
    answer = merge(1_c_int32_t, 0_c_int32_t, cancel)
  end function on_progress

end module delam_contexts
