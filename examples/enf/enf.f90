! SPDX-License-Identifier: BSD-3-Clause
!
! The end-notched flexure test with a ductile interface (Zeman, Kruzik, Gruber, PANM 15, 2010), from Fortran.
!
!     enf_fortran [history.csv]     without an argument the history goes to standard output
!
! The scene of enf.c. No call asks for a status here, so any failure ends the program with the library's message.
module enf_log
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delam
  implicit none

  ! What the library warns of (level 1) reaches the log alone.
  type, extends(delam_observer) :: teller
    integer :: unit = error_unit
  contains
    procedure :: log => tell
  end type teller

contains

  subroutine tell(self, level, text)
    class(teller), intent(inout) :: self
    integer, intent(in) :: level
    character(*), intent(in) :: text
    if (level == 1) write (self%unit, '(2a)') 'enf: ', text
  end subroutine tell
end module enf_log

program enf
  use, intrinsic :: iso_fortran_env, only: output_unit
  use delam
  use enf_log
  implicit none
  integer, parameter :: dp = delam_real
  real(dp), parameter :: length = 120e-3_dp   ! span, m
  real(dp), parameter :: height = 3e-3_dp     ! of an arm, m
  real(dp), parameter :: notch = 30e-3_dp     ! m
  integer, parameter :: steps = 40

  ! Columns of the history, and the library's name for each.
  character(*), parameter :: columns(2, 19) = reshape([character(23) :: &
    'step', 'step', 'time', 'time', 'load', 'load:load', 'reaction', 'reaction:load', 'stored_bulk', 'stored_bulk', &
    'stored_interface', 'stored_interface', 'dissipated', 'dissipated', &
    'stored_interface_slides', 'stored_interface_slides', 'dissipated_slides', 'dissipated_slides', 'work', 'work', &
    'lower', 'lower', 'increment', 'increment', 'upper', 'upper', 'increment_lower', 'increment_lower', &
    'am_iterations', 'am_iterations', 'linear_iterations', 'linear_iterations', 'contact_pairs', 'contact_pairs', &
    'debonded_length', 'debonded_length', 'backtracks', 'backtracks'], [2, 19])

  type(delam_context) :: context
  type(delam_mesh) :: mesh
  type(delam_law) :: law
  type(delam_problem) :: problem
  type(delam_solver) :: solver
  type(teller), target :: warnings
  integer :: unit, step, i
  character(4096) :: path

  unit = output_unit
  if (command_argument_count() > 0) then
    call get_command_argument(1, path)
    open (newunit=unit, file=trim(path), status='replace', action='write')
  end if

  call context%create()
  call context%observe(warnings)
  call mesh%create_layers(context, [length], [240_delam_index], [height, height], [6_delam_index, 6_delam_index], &
                          DELAM_QUAD4)
  call mesh%add_interface(0, 1)
  call make_law()
  call problem%create(context, mesh)
  call problem%set_plane('plane-strain')
  call problem%set_elastic(75e9_dp, 0.3_dp)
  call problem%set_law(1, law)
  call make_notch()
  call make_loads()
  call problem%check()

  call solver%create(problem, 0.0_dp)
  write (unit, '(*(a, :, ","))') (trim(columns(1, i)), i=1, size(columns, 2))
  call write_row()
  do step = 1, steps
    call solver%advance(2.0_dp*step/steps)
    call solver%commit()
    call write_row()
  end do
  if (unit /= output_unit) close (unit)

contains

  subroutine make_law()
    call law%create(context, 'piecewise-linear')
    call law%set('normal_stiffness', 125e9_dp)
    call law%set('tangential_stiffness', 125e9_dp)
    call law%set('normal_onset', 100.0_dp)
    call law%set('tangential_onset', 100.0_dp)
    call law%set('normal_toughness', 250.0_dp)
    call law%set('tangential_toughness', 250.0_dp)
    call law%set('onset_exponent_1', 2.0_dp)
    call law%set('onset_exponent_2', 2.0_dp)
    call law%set('toughness_exponent_1', 2.0_dp)
    call law%set('toughness_exponent_2', 2.0_dp)
  end subroutine make_law

  ! The notch has no adhesion from the start; the pair at its tip, on the side of the box, is bonded.
  subroutine make_notch()
    call problem%set_adhesion_box(1, [0.0_dp, 0.0_dp], [notch, 2.0_dp*height], 0.0_dp)
  end subroutine make_notch

  subroutine make_loads()
    integer(delam_index) :: load, left, right, top
    left = node_at(0, 0.0_dp, 0.0_dp)
    right = node_at(0, length, 0.0_dp)
    top = node_at(1, 0.5_dp*length, 2.0_dp*height)
    call problem%add_pattern('load', [0.0_dp, 2.0_dp], [0.0_dp, 6e-3_dp], load)
    call problem%prescribe_nodes([left], [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes([right], [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes([right], [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes([top], [0.0_dp, -1.0_dp], load)
  end subroutine make_loads

  ! The one node of a body at a place.
  function node_at(body, x, y) result(node)
    integer, intent(in) :: body
    real(dp), intent(in) :: x, y
    integer(delam_index) :: node
    integer(delam_index), allocatable :: found(:)
    found = mesh%find_nodes([x, y], [x, y], body)
    if (size(found) /= 1) error stop 'enf: one node was expected at a support or load'
    node = found(1)
  end function node_at

  subroutine write_row()
    integer :: column
    write (unit, '(*(g0, :, ","))') (solver%value(columns(2, column)), column=1, size(columns, 2))
  end subroutine write_row
end program enf
