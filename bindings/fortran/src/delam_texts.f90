! SPDX-License-Identifier: BSD-3-Clause
! Conversion of texts from and to C.
module delam_texts
  use, intrinsic :: iso_c_binding, only: c_ptr, c_char, c_size_t, c_null_char, c_associated, c_f_pointer
  implicit none
  private
  public :: delam_text, zero_ended

  interface
    pure function strlen(text) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function strlen
  end interface

contains

  ! A text of the library; '' if there is none.
  function delam_text(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    if (.not. c_associated(address)) then
      text = ''
      return
    end if
    call c_f_pointer(address, letters, [strlen(address)])
    allocate(character(size(letters)) :: text)
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function delam_text

  function zero_ended(text) result(ended)
    character(*), intent(in) :: text
    character(len_trim(text) + 1, kind=c_char) :: ended
    ended = trim(text) // c_null_char
  end function zero_ended

end module delam_texts
