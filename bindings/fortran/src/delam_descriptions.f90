! SPDX-License-Identifier: BSD-3-Clause
! Information about the library: version, options of problems, parameters of laws.
module delam_descriptions
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int32_t, c_int64_t, c_null_ptr
  use delam_raw
  use delam_kinds, only: delam_real
  use delam_texts, only: delam_text, zero_ended
  implicit none
  private
  public :: delam_version_text, delam_describe_option, delam_parameter_count, delam_describe_parameter, &
            delam_parameter_bounds, delam_describe_kind

contains

  function delam_version_text() result(text)
    character(:), allocatable :: text
    text = delam_text(delam_version())
  end function delam_version_text

  ! An option of problems, counted from 1 to delam_option_count(); '' if there is none with that number.
  subroutine delam_describe_option(index, key, type, unit, initial, range, meaning)
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: key, type, unit, initial, range, meaning
    type(c_ptr) :: texts(6)
    texts = c_null_ptr
    if (delam_option_info(index - 1_c_int64_t, texts(1), texts(2), texts(3), texts(4), texts(5), texts(6)) &
        /= DELAM_OK) texts = c_null_ptr
    if (present(key)) key = delam_text(texts(1))
    if (present(type)) type = delam_text(texts(2))
    if (present(unit)) unit = delam_text(texts(3))
    if (present(initial)) initial = delam_text(texts(4))
    if (present(range)) range = delam_text(texts(5))
    if (present(meaning)) meaning = delam_text(texts(6))
  end subroutine delam_describe_option

  ! Number of the parameters of a kind of law, with all its criteria.
  function delam_parameter_count(kind) result(count)
    character(*), intent(in) :: kind
    integer :: count
    count = int(delam_law_parameter_count(zero_ended(kind)))
  end function delam_parameter_count

  ! One of them, likewise.
  subroutine delam_describe_parameter(kind, index, key, type, unit, initial, range, meaning)
    character(*), intent(in) :: kind
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: key, type, unit, initial, range, meaning
    type(c_ptr) :: texts(6)
    texts = c_null_ptr
    if (delam_law_parameter_info(zero_ended(kind), index - 1_c_int64_t, texts(1), texts(2), texts(3), texts(4), &
                                 texts(5), texts(6)) /= DELAM_OK) texts = c_null_ptr
    if (present(key)) key = delam_text(texts(1))
    if (present(type)) type = delam_text(texts(2))
    if (present(unit)) unit = delam_text(texts(3))
    if (present(initial)) initial = delam_text(texts(4))
    if (present(range)) range = delam_text(texts(5))
    if (present(meaning)) meaning = delam_text(texts(6))
  end subroutine delam_describe_parameter

  ! Between what a number of that index lies; where open, the bound itself is outside. ok: there is such a parameter.
  subroutine delam_parameter_bounds(kind, index, lower, upper, lower_open, upper_open, ok)
    character(*), intent(in) :: kind
    integer, intent(in) :: index
    real(delam_real), intent(out) :: lower, upper
    logical, intent(out) :: lower_open, upper_open
    logical, intent(out), optional :: ok
    integer(c_int32_t) :: below, above, status
    lower = 0
    upper = 0
    below = 0
    above = 0
    status = delam_law_parameter_bounds(zero_ended(kind), index - 1_c_int64_t, lower, upper, below, above)
    lower_open = below /= 0
    upper_open = above /= 0
    if (present(ok)) ok = status == DELAM_OK
  end subroutine delam_parameter_bounds

  ! A kind of law, counted from 1 to delam_law_kind_count(); '' where there is none of that number. hosted: it is made
  ! by create_host.
  subroutine delam_describe_kind(index, kind, meaning, hosted)
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: kind, meaning
    logical, intent(out), optional :: hosted
    type(c_ptr) :: texts(2)
    integer(c_int32_t) :: own
    texts = c_null_ptr
    own = 0
    if (delam_law_kind_info(index - 1_c_int64_t, texts(1), texts(2), own) /= DELAM_OK) texts = c_null_ptr
    if (present(kind)) kind = delam_text(texts(1))
    if (present(meaning)) meaning = delam_text(texts(2))
    if (present(hosted)) hosted = own /= 0
  end subroutine delam_describe_kind

end module delam_descriptions
