! SPDX-License-Identifier: BSD-3-Clause
!
! calls_fortran CALLS STEPS: as calls.c, through the module delam.
program calls_fortran
  use delam
  implicit none
  integer, parameter :: dp = delam_real
  type(delam_context) :: context
  type(delam_solver) :: solver
  integer :: calls, steps, i
  real(dp) :: begin, per_call, per_step, total
  character(32) :: word

  call get_command_argument(1, word)
  read (word, *) calls
  call get_command_argument(2, word)
  read (word, *) steps
  call context%create()
  call make_solver()
  total = 0
  begin = now()
  do i = 1, calls
    total = total + solver%value('time')
  end do
  per_call = (now() - begin)/calls
  begin = now()
  do i = 1, steps
    call solver%advance(real(i, dp)/steps)
    call solver%commit()
  end do
  per_step = (now() - begin)/steps
  do i = 1, 10
    call solver%advance(1 + i/10.0_dp)
    call solver%commit()
  end do
  print '(2(g0.6, 1x), *(es24.16e3, 1x))', per_call, per_step, total, solver%value('reaction:pull'), &
    solver%value('stored_bulk'), solver%value('stored_interface'), solver%value('dissipated'), solver%value('work'), &
    solver%field('adhesion')

contains

  function now() result(nanoseconds)
    real(dp) :: nanoseconds
    real(dp) :: seconds
    call cpu_time(seconds)
    nanoseconds = 1e9_dp*seconds
  end function now

  subroutine make_solver()
    type(delam_mesh) :: mesh
    type(delam_law) :: law
    type(delam_problem) :: problem
    integer(delam_index) :: pull
    call mesh%create_layers(context, [0.1_dp], [20_delam_index], [2e-3_dp, 2e-3_dp], [1_delam_index, 1_delam_index], &
                            DELAM_QUAD4)
    call mesh%add_interface(0, 1)
    call law%create(context, 'piecewise-linear')
    call law%set('normal_stiffness', 1e12_dp)
    call law%set('tangential_stiffness', 1e12_dp)
    call law%set('normal_onset', 50.0_dp)
    call law%set('tangential_onset', 50.0_dp)
    call law%set('normal_toughness', 250.0_dp)
    call law%set('tangential_toughness', 250.0_dp)
    call problem%create(context, mesh)
    call problem%set_elastic(70e9_dp, 0.3_dp)
    call problem%set_law(1, law)
    call problem%add_pattern('pull', [0.0_dp, 1.0_dp, 2.0_dp], [0.0_dp, 1e-6_dp, 4e-3_dp], pull)
    call problem%prescribe_nodes(mesh%find_nodes([0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp]), [1.0_dp, 0.0_dp])
    call problem%prescribe_nodes(mesh%find_nodes([0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp]), [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes(mesh%find_nodes([0.1_dp, 0.0_dp], [0.1_dp, 0.0_dp]), [0.0_dp, 1.0_dp])
    call problem%prescribe_nodes(mesh%find_nodes([0.05_dp, 4e-3_dp], [0.05_dp, 4e-3_dp]), [0.0_dp, -1.0_dp], pull)
    call solver%create(problem, 0.0_dp)
  end subroutine make_solver
end program calls_fortran
