! SPDX-License-Identifier: BSD-3-Clause
!
! Writes the deck of the structure that play_abaqus.f90 analyses: delam_uel.inp.
module play_deck
  use play_support
  use abaqus_job, only: dp
  use host_structure
  implicit none
  private
  public :: write_deck

contains

  subroutine write_deck()
    type(structure) :: s
    integer :: i
    call make_structure(s, 0, 0, 0.0_dp)
    print '(a)', '** SPDX-License-Identifier: BSD-3-Clause', &
      '** Two strips that delaminate, as user elements between elastic elements: MANUAL.md has the picture.', &
      '**     abaqus job=delam_uel user=abaqus_user.f90', &
      '** Written by `host_abaqus deck`. Units: m, N, Pa, J, per metre of width.', '*HEADING', &
      'two user elements of libdelam in an elastic structure', '*NODE'
    print '(i5,",",es16.8,",",es16.8)', (i, s%nodes(:, i), i=1, s%node_count)
    print '(a)', '*ELEMENT, TYPE=CPE4, ELSET=HOST'
    print '(i5,",",i5,",",i5,",",i5,",",i5)', (i, s%quads(:, i), i=1, size(s%quads, 2))
    print '(a)', '*SOLID SECTION, ELSET=HOST, MATERIAL=ELASTIC', '1.', '*MATERIAL, NAME=ELASTIC', '*ELASTIC'
    print '(es16.8,",",f6.3)', young, poisson
    print '(a)', '** Nodes: those where the element is joined to others, loaded or held; both displacements of each.', &
      '*USER ELEMENT, TYPE=U1, NODES=9, COORDINATES=2, PROPERTIES=13, I PROPERTIES=6, VARIABLES=8, UNSYMM', '1, 2'
    do i = 1, size(s%users)
      print '(a,i0)', '*ELEMENT, TYPE=U1, ELSET=STRIP', i
      print '(9(i5,","),i5)', s%users(i)%number, s%users(i)%nodes
      print '(a)', '** PROPS and JPROPS: delam_uel_model.f90 says what they mean.'
      print '(a,i0)', '*UEL PROPERTY, ELSET=STRIP', i
      print '(7(es12.4,","),es12.4)', s%users(i)%props(:8)
      print '(5(es12.4,","),2(i4,","),i4)', s%users(i)%props(9:), s%users(i)%jprops(:3)
      print '(2(i4,","),i4)', s%users(i)%jprops(4:)
    end do
    call write_step(s)
  end subroutine write_deck

  subroutine write_step(s)
    type(structure), intent(in) :: s
    integer :: i
    print '(a)', '*BOUNDARY'
    print '(i5,",",i5,",",i5)', ((s%held(i) + 1)/2, 2 - mod(s%held(i), 2), 2 - mod(s%held(i), 2), i=1, size(s%held))
    print '(a)', '*STEP, INC=1000, UNSYMM=YES', '*STATIC', '0.025, 1., 1E-5, 0.025', '*BOUNDARY'
    print '(i5,",",i5,",",i5,",",es12.4)', &
      ((s%driven(i) + 1)/2, 2 - mod(s%driven(i), 2), 2 - mod(s%driven(i), 2), travel, i=1, size(s%driven))
    print '(a)', '*RESTART, WRITE, FREQUENCY=10', '*OUTPUT, HISTORY', '*ENERGY OUTPUT', 'ALLSE, ALLPD, ALLVD, ALLWK', &
      '*EL PRINT, ELSET=STRIP1', 'SDV', '*EL PRINT, ELSET=STRIP2', 'SDV', '*END STEP'
  end subroutine write_step
end module play_deck
