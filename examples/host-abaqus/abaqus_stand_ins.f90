! SPDX-License-Identifier: BSD-3-Clause
!
! Stands in for Abaqus in play_abaqus.f90: the utility routines that a user subroutine may call, and the interfaces with
! which Abaqus calls user subroutines.
module abaqus_job
  use delam_kinds, only: dp => delam_real
  implicit none
  private
  public :: dp, job_name, out_folder, uel, uexternaldb, begin_job, message_count

  character(256) :: job_name = 'play', out_folder = '.'
  integer, parameter :: message_file = 7

  interface
    subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, nnode, u, du, v, a, &
                   jtype, time, dtime, kstep, kinc, jelem, params, ndload, jdltyp, adlmag, predef, npredf, lflags, &
                   mlvarx, ddlmag, mdload, pnewdt, jprops, njprop, period)
      import :: dp
      integer, intent(in) :: ndofel, nrhs, nsvars, nprops, mcrd, nnode, jtype, kstep, kinc, jelem, ndload, npredf, &
                             mlvarx, mdload, njprop, lflags(*), jprops(*), jdltyp(mdload, *)
      real(dp), intent(inout) :: rhs(mlvarx, *), amatrx(ndofel, ndofel), svars(*), energy(8), pnewdt
      real(dp), intent(in) :: props(*), coords(mcrd, nnode), u(ndofel), du(mlvarx, *), v(ndofel), a(ndofel), time(2), &
                              dtime, params(*), adlmag(mdload, *), predef(2, npredf, nnode), ddlmag(mdload, *), period
    end subroutine uel
    subroutine uexternaldb(lop, lrestart, time, dtime, kstep, kinc)
      import :: dp
      integer, intent(in) :: lop, lrestart, kstep, kinc
      real(dp), intent(in) :: time(2), dtime
    end subroutine uexternaldb
  end interface

contains

  ! Opens the message file of a job.
  subroutine begin_job(name)
    character(*), intent(in) :: name
    job_name = name
    close (message_file)
    open (message_file, file=trim(out_folder) // '/' // trim(name) // '.msg', status='replace', action='readwrite')
  end subroutine begin_job

  ! Lines of the message file that contain the text; printed: how many of them to print.
  integer function message_count(text, printed)
    character(*), intent(in) :: text
    integer, intent(in) :: printed
    character(1024) :: line
    integer :: io
    message_count = 0
    rewind (message_file)
    do
      read (message_file, '(a)', iostat=io) line
      if (io /= 0) exit
      if (index(line, text) == 0) cycle
      message_count = message_count + 1
      if (message_count <= printed) print '(2a)', '  in the message file:', trim(line)
    end do
    backspace (message_file)
  end function message_count
end module abaqus_job

subroutine getjobname(name, length)
  use abaqus_job
  implicit none
  character(256), intent(out) :: name
  integer, intent(out) :: length
  name = job_name
  length = len_trim(name)
end subroutine getjobname

subroutine getoutdir(name, length)
  use abaqus_job
  implicit none
  character(256), intent(out) :: name
  integer, intent(out) :: length
  name = out_folder
  length = len_trim(name)
end subroutine getoutdir

! Mutexes, by locks of OpenMP; one that has not been made must not be locked.
module abaqus_mutexes
  !$ use omp_lib
  implicit none
  !$ integer(omp_lock_kind) :: locks(100)
  logical :: made(100) = .false.
end module abaqus_mutexes

subroutine mutexinit(number)
  use abaqus_mutexes
  implicit none
  integer, intent(in) :: number
  !$ if (.not. made(number)) call omp_init_lock(locks(number))
  made(number) = .true.
end subroutine mutexinit

subroutine mutexlock(number)
  use abaqus_mutexes
  implicit none
  integer, intent(in) :: number
  if (.not. made(number)) error stop 'mutexlock: there is no such mutex'
  !$ call omp_set_lock(locks(number))
end subroutine mutexlock

subroutine mutexunlock(number)
  use abaqus_mutexes
  implicit none
  integer, intent(in) :: number
  if (.not. made(number)) error stop 'mutexunlock: there is no such mutex'
  !$ call omp_unset_lock(locks(number))
end subroutine mutexunlock

! Ends the analysis, as in Abaqus; what the user subroutine has written to the message file is shown.
subroutine xit()
  use abaqus_job
  implicit none
  if (message_count('***', 5) == 0) print '(a)', '  nothing in the message file'
  print '(a)', 'XIT'
  stop 3
end subroutine xit
