! SPDX-License-Identifier: BSD-3-Clause
!
! A double cantilever beam in space whose interface obeys a law of the host's own, from Fortran.
!
!     dcb_host_law_fortran [history.csv]     without an argument the history goes to standard output
!
! The scene of dcb_host_law.c. No call asks for a status here, so any failure ends the program with the library's
! message.
module bilinear_by_hand
  use delam, only: delam_host_law, dp => delam_real
  implicit none
  private
  public :: bilinear

  ! Traction falls on a straight line, alike in every mode.
  type, extends(delam_host_law) :: bilinear
    real(dp) :: onset = 0       ! energy at which the traction begins to fall, J/m2
    real(dp) :: toughness = 0   ! J/m2
  contains
    procedure :: adhesion => bilinear_adhesion
    procedure :: dissipation => bilinear_dissipation
  end type bilinear

contains

  ! The minimiser of adhesion * driving + dissipated, and its slope by the driving energy.
  subroutine bilinear_adhesion(self, mixity, driving, adhesion, slope, failed)
    class(bilinear), intent(in) :: self
    real(dp), intent(in) :: mixity, driving
    real(dp), intent(out) :: adhesion, slope
    logical, intent(inout) :: failed
    real(dp) :: r, root
    r = self%toughness/self%onset
    adhesion = 1
    slope = 0
    if (driving >= self%onset*r*r) then
      adhesion = 0
    else if (driving > self%onset) then
      root = sqrt(self%onset/driving)
      adhesion = (r*root - 1)/(r - 1)
      slope = -0.5_dp*r/(r - 1)*root/driving
    end if
    failed = mixity < 0
  end subroutine bilinear_adhesion

  ! The energy spent down to an adhesion, and its slopes by adhesion and mixity.
  subroutine bilinear_dissipation(self, mixity, adhesion, dissipated, slope, mixity_slope, failed)
    class(bilinear), intent(in) :: self
    real(dp), intent(in) :: mixity, adhesion
    real(dp), intent(out) :: dissipated, slope, mixity_slope
    logical, intent(inout) :: failed
    real(dp) :: r, below
    r = self%toughness/self%onset
    below = 1 + adhesion*(r - 1)
    dissipated = self%toughness - self%onset*r*r*adhesion/below
    slope = -self%onset*(r/below)*(r/below)
    mixity_slope = 0
    failed = mixity < 0
  end subroutine bilinear_dissipation
end module bilinear_by_hand

program dcb_host_law
  use, intrinsic :: iso_fortran_env, only: output_unit
  use delam
  use bilinear_by_hand
  implicit none
  integer, parameter :: dp = delam_real
  real(dp), parameter :: length = 60e-3_dp    ! m
  real(dp), parameter :: width = 8e-3_dp      ! m
  real(dp), parameter :: height = 1.5e-3_dp   ! of an arm, m
  real(dp), parameter :: notch = 20e-3_dp     ! m
  integer, parameter :: steps = 16

  ! Columns of the history, and the library's name for each.
  character(*), parameter :: columns(2, 9) = reshape([character(16) :: &
    'step', 'step', 'time', 'time', 'load', 'load:opening', 'reaction', 'reaction:opening', &
    'stored_bulk', 'stored_bulk', 'stored_interface', 'stored_interface', 'dissipated', 'dissipated', 'work', 'work', &
    'front', 'front'], [2, 9])

  type(delam_context) :: context
  type(delam_mesh) :: mesh
  type(delam_law) :: law
  type(delam_problem) :: problem
  type(delam_solver) :: solver
  integer :: unit, step, i
  character(4096) :: path

  unit = output_unit
  if (command_argument_count() > 0) then
    call get_command_argument(1, path)
    open (newunit=unit, file=trim(path), status='replace', action='write')
  end if

  call context%create()
  call mesh%create_layers(context, [length, width], [60_delam_index, 4_delam_index], [height, height], &
                          [2_delam_index, 2_delam_index], DELAM_HEX8)
  call mesh%add_interface(0, 1)
  call law%create_host(context, 'bilinear by hand', bilinear(onset=5.0_dp, toughness=250.0_dp))
  call law%set('normal_stiffness', 1e13_dp)
  call law%set('tangential_stiffness', 1e13_dp)
  call problem%create(context, mesh)
  call problem%set_elastic(120e9_dp, 0.3_dp)
  call problem%set_formulation('incompatible')
  call problem%set_law(1, law)
  call make_notch()
  call make_loads()
  call problem%check()

  call solver%create(problem, 0.0_dp)
  write (unit, '(*(a, :, ","))') (trim(columns(1, i)), i=1, size(columns, 2))
  call write_row()
  do step = 1, steps
    call solver%advance(real(step, dp)/steps)
    call solver%commit()
    call write_row()
  end do
  if (unit /= output_unit) close (unit)

contains

  ! The notch has no adhesion from the start; the pairs at its tip, on the side of the box, are bonded.
  subroutine make_notch()
    call problem%set_adhesion_box(1, [0.0_dp, 0.0_dp, 0.0_dp], [notch, width, 2.0_dp*height], 0.0_dp)
  end subroutine make_notch

  subroutine make_loads()
    real(dp), parameter :: axes(3, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, &
                                                 0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
    integer(delam_index) :: opening
    integer(delam_index), allocatable :: right(:)
    integer :: axis
    call problem%add_pattern('opening', [0.0_dp, 1.0_dp], [0.0_dp, 1.6e-3_dp], opening)
    right = mesh%find_nodes([length, 0.0_dp, 0.0_dp], [length, width, 2*height])
    do axis = 1, 3
      call problem%prescribe_nodes(right, axes(:, axis))
    end do
    call problem%prescribe_nodes(mesh%find_nodes([0.0_dp, 0.0_dp, 2*height], [0.0_dp, width, 2*height]), &
                                 axes(:, 3), opening, 0.5_dp)
    call problem%prescribe_nodes(mesh%find_nodes([0.0_dp, 0.0_dp, 0.0_dp], [0.0_dp, width, 0.0_dp]), &
                                 -axes(:, 3), opening, 0.5_dp)
  end subroutine make_loads

  subroutine write_row()
    integer :: column
    write (unit, '(*(g0, :, ","))') (solver%value(columns(2, column)), column=1, size(columns, 2))
  end subroutine write_row
end program dcb_host_law
