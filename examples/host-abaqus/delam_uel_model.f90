! SPDX-License-Identifier: BSD-3-Clause
!
! The part that delaminates, for delam_uel.f90: replace this routine by one of your own. This one makes a strip of two
! equal layers, joined by an interface that has a notch at one end; in space the strip has a width. It lies along x, and
! its lower left corner is at the smallest coordinates of the element's nodes. Units are those of the deck.
!
!   PROPS    (1) Young's modulus (2) Poisson's ratio
!            the law: (3,4) normal and tangential stiffness (5,6) onset (7,8) toughness; normal, then tangential
!            (9) damage_tolerance, 0: the library's default, which suits the tolerances of Abaqus
!            (10) length (11) thickness of a layer (12) length of the notch (13) width, in space
!   JPROPS   (1) elements along x (2) through each layer (3) across the width, in space
!            (4) the notch is at: 1 left, 2 right end
!            (5) mixity_rule: 0 converged, each increment in one part, so that AMATRX is exact; 1 frozen; 2 converged,
!            in parts where the library wants them
!            (6) minimisation_limit, 0: the library's default
subroutine delam_uel_model(number, jtype, props, jprops, coords, context, mesh, problem, origin, status, message)
  use delam
  implicit none
  integer, parameter :: dp = delam_real
  integer, intent(in) :: number, jtype, jprops(:)
  real(dp), intent(in) :: props(:), coords(:,:)
  type(delam_context), intent(in) :: context
  type(delam_mesh), intent(inout) :: mesh
  type(delam_problem), intent(inout) :: problem
  real(dp), intent(out) :: origin(:)
  integer, intent(out) :: status
  character(*), intent(out) :: message
  character(22), parameter :: keys(6) = [character(22) :: 'normal_stiffness', 'tangential_stiffness', 'normal_onset', &
                                         'tangential_onset', 'normal_toughness', 'tangential_toughness']
  type(delam_law) :: law
  integer :: i

  origin = minval(coords, 2)
  status = DELAM_ERROR_ARGUMENT
  if (size(props) < 13 .or. size(jprops) < 6) then
    message = 'PROPERTIES must be 13 and I PROPERTIES 6'
    return
  end if
  if (any(props(10:12) <= 0) .or. jprops(1) < 1) then
    message = 'length, thickness, notch and the number of elements must be positive'
    return
  end if
  call make_mesh()
  if (status == DELAM_OK) call law%create(context, 'piecewise-linear', status, message)
  do i = 1, size(keys)
    if (status == DELAM_OK) call law%set(trim(keys(i)), props(2 + i), status, message)
  end do
  if (status == DELAM_OK) call problem%create(context, mesh, status, message)
  if (status == DELAM_OK) call problem%set_elastic(props(1), props(2), status=status, message=message)
  if (status == DELAM_OK) call problem%set_formulation('incompatible', status=status, message=message)
  if (status == DELAM_OK) call problem%set_law(1, law, status, message)
  if (status == DELAM_OK) call make_notch()
  if (status == DELAM_OK) call problem%set('kinematics', 'linear', status, message)  ! the host knows its tangents
  if (status == DELAM_OK .and. props(9) > 0) call problem%set('damage_tolerance', props(9), status, message)
  if (status == DELAM_OK .and. jprops(5) == 1) call problem%set('mixity_rule', 'frozen', status, message)
  if (status == DELAM_OK .and. jprops(5) == 0) call problem%set('path_step', 1.0_dp, status, message)
  if (status == DELAM_OK .and. jprops(6) > 0) call problem%set('minimisation_limit', jprops(6), status, message)

contains

  subroutine make_mesh()
    real(dp) :: layers(2)
    integer(delam_index) :: cells(2)
    layers = props(11)
    cells = jprops(2)
    if (size(origin) == 2) then
      call mesh%create_layers(context, [props(10)], [int(jprops(1), delam_index)], layers, cells, DELAM_QUAD4, status, &
                              message)
    else
      call mesh%create_layers(context, props([10, 13]), int(jprops([1, 3]), delam_index), layers, cells, DELAM_HEX8, &
                              status, message)
    end if
    if (status == DELAM_OK) call mesh%add_interface(0, 1, status=status, message=message)
  end subroutine make_mesh

  ! Pairs in the notch have no adhesion from the start; those at its tip are bonded.
  subroutine make_notch()
    real(dp), allocatable :: nodes(:,:), depth(:)
    integer(delam_index), allocatable :: below(:), cut(:)
    integer(delam_index) :: p
    nodes = mesh%nodes()
    call mesh%interface_pairs(1, nodes_a=below)
    depth = nodes(1, below)
    if (jprops(4) == 2) depth = props(10) - depth
    cut = pack([(p, p=1, size(below))], depth < props(12) - 1e-3_dp*props(10)/jprops(1))
    call problem%set_adhesion(1, cut, spread(0.0_dp, 1, size(cut)), status, message)
  end subroutine make_notch
end subroutine delam_uel_model
