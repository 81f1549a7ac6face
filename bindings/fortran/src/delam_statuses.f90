! SPDX-License-Identifier: BSD-3-Clause
! Statuses: returned to the caller that asks for them; otherwise they end the program.
module delam_statuses
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delam_raw
  use delam_texts, only: delam_text
  use delam_objects, only: delam_object, shared, shared_of
  implicit none
  private
  public :: settle, refuse, conclude

contains

  ! Returns status and message to the caller, or ends the program if it did not ask for the status.
  subroutine settle(code, object, status, message)
    integer(c_int32_t), intent(in) :: code
    class(delam_object), intent(in) :: object
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: it
    character(:), allocatable :: text
    text = ''
    it => shared_of(object)
    if (code /= DELAM_OK) then
      if (.not. associated(it)) then
        text = 'the object has not been created'
      else
        text = delam_text(delam_context_message(it%context%handle))
      end if
    end if
    call conclude(code, text, status, message)
  end subroutine settle

  ! As settle, for errors found before the library is called.
  subroutine refuse(text, status, message)
    character(*), intent(in) :: text
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call conclude(DELAM_ERROR_ARGUMENT, text, status, message)
  end subroutine refuse

  subroutine conclude(code, text, status, message)
    integer(c_int32_t), intent(in) :: code
    character(*), intent(in) :: text
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (present(message)) message = text
    if (present(status)) then
      status = code
    else if (code /= DELAM_OK) then
      write (error_unit, '(3a)') delam_text(delam_status_name(code)), ': ', text
      error stop 1
    end if
  end subroutine conclude

end module delam_statuses
