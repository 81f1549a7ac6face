! SPDX-License-Identifier: BSD-3-Clause
!
! A user element for Abaqus/Standard (and for programs that call the same interface): a part of a structure that
! delaminates, as one element. Its nodes are the nodes at which it is joined to the rest of the model or held; inside,
! libdelam finds displacements, damage and contact. The part itself is made by delam_uel_model, which you replace.
!
!     abaqus job=delam_uel user=abaqus_user.f90      abaqus_user.f90 includes this file and the modules of libdelam
!
! with, in abaqus_v6.env, `-free -I FOLDER` added to compile_fortran, FOLDER being that of the modules, and `-ldelam` to
! link_sl. In the deck: *USER ELEMENT with all displacements of its nodes, VARIABLES=8 and UNSYMM, and *STEP with
! UNSYMM=YES. MANUAL.md of this folder has the details, and what the element does not do; delam_uel.inp is a deck.
! Units are those of the deck; the library takes any consistent set.
!
! What Abaqus receives
!   RHS      minus the forces that the element's nodes need
!   AMATRX   the consistent tangent of the load step, so that Newton's method converges quadratically; not symmetric
!            with mixity_rule = converged, the library's default
!   ENERGY   (2) energy stored in bodies and interfaces; (4) energy dissipated by damage (ALLPD, since a user element
!            has no slot for damage); (5) energy released by jumps, which is neither stored nor dissipated
!   PNEWDT   0.5 if the library finds no state or no tangent: Abaqus cuts back. The reason is in the message file
!   SVARS    (1) number of the state, i.e. of increments that were accepted; (2) energy released; (3) energy dissipated;
!            (4) advance of the fronts, the sum of weight (1 - adhesion); (5) size of what has debonded; (6) pairs in
!            contact; (7) jumps in the increment; (8) estimated error of the dissipated energy because of the mixity
!
! Each element holds a libdelam solver. A call of UEL rolls back the trial step of the call before and computes a new
! one from the last accepted state. SVARS(1), which Abaqus passes as it was at the start of the increment, tells which
! state that is: if it is the number of the trial step, Abaqus has accepted this step, and the element commits it. A
! cut-back passes the old number again. UEXTERNALDB commits at the end of an increment already, because the files of a
! restart are written then. The clock of the library counts accepted increments, because damage does not depend on
! rates; the times of Abaqus have no influence.
module delam_uel_elements
  use delam
  implicit none
  private
  public :: element, element_of, elements_begin, elements_end, elements_save, restart_at, say, stop_analysis, dp

  integer, parameter :: dp = delam_real
  integer, parameter :: message_file = 7   ! of Abaqus/Standard
  integer, parameter :: lock = 17          ! number of our mutex among those of Abaqus

  type :: element
    integer :: number = 0
    logical :: pending = .false.
    integer :: step = 0                     ! number of the committed state
    type(delam_context) :: context
    type(delam_solver) :: solver
    integer(delam_index), allocatable :: patterns(:)
    character(16), allocatable :: names(:)  ! of the patterns, one for each displacement of the element
    real(dp), allocatable :: committed(:), trial(:)   ! displacements of these states
  contains
    procedure :: build
    procedure :: follow
    procedure :: try
    procedure :: accept
    procedure :: give_up
    procedure, private :: drive_node
    procedure, private :: reload
  end type element

  type :: place
    type(element), pointer :: it => null()
  end type place
  type(place), allocatable :: all_elements(:)
  logical :: restarted = .false.
  integer :: restart_step = 0, restart_increment = 0

  interface
    ! Makes mesh and problem of an element, without the displacements of its nodes: bodies, interfaces, laws, materials,
    ! adhesion, options. origin: the place in the model at which the mesh has its point 0. status, message: of the call
    ! of the library that failed.
    subroutine delam_uel_model(number, jtype, props, jprops, coords, context, mesh, problem, origin, status, message)
      import :: delam_context, delam_mesh, delam_problem, dp
      integer, intent(in) :: number, jtype, jprops(:)
      real(dp), intent(in) :: props(:), coords(:,:)
      type(delam_context), intent(in) :: context
      type(delam_mesh), intent(inout) :: mesh
      type(delam_problem), intent(inout) :: problem
      real(dp), intent(out) :: origin(:)
      integer, intent(out) :: status
      character(*), intent(out) :: message
    end subroutine delam_uel_model
    ! Utility routines of Abaqus.
    subroutine xit()
    end subroutine xit
    subroutine mutexinit(number)
      integer, intent(in) :: number
    end subroutine mutexinit
    subroutine mutexlock(number)
      integer, intent(in) :: number
    end subroutine mutexlock
    subroutine mutexunlock(number)
      integer, intent(in) :: number
    end subroutine mutexunlock
    subroutine getjobname(name, length)
      character(256), intent(out) :: name
      integer, intent(out) :: length
    end subroutine getjobname
    subroutine getoutdir(name, length)
      character(256), intent(out) :: name
      integer, intent(out) :: length
    end subroutine getoutdir
  end interface

contains

  ! The element of this number; new if UEL has not been called for it. Abaqus may call UEL in several threads; they meet
  ! only here, because each element has a context of its own.
  function element_of(number, new) result(it)
    integer, intent(in) :: number
    logical, intent(out), optional :: new
    type(element), pointer :: it
    type(place), allocatable :: more(:)
    integer :: i, n
    nullify(it)
    call mutexlock(lock)
    n = 0
    if (allocated(all_elements)) n = size(all_elements)
    do i = 1, n
      if (all_elements(i)%it%number == number) it => all_elements(i)%it
    end do
    if (present(new)) new = .not. associated(it)
    if (.not. associated(it)) then
      allocate(more(n + 1))
      if (n > 0) more(:n) = all_elements
      allocate(more(n + 1)%it)
      it => more(n + 1)%it
      it%number = number
      call move_alloc(more, all_elements)
    end if
    call mutexunlock(lock)
  end function element_of

  subroutine elements_begin()
    call mutexinit(lock)
  end subroutine elements_begin

  subroutine elements_end()
    integer :: i
    restarted = .false.
    if (.not. allocated(all_elements)) return
    do i = 1, size(all_elements)
      deallocate(all_elements(i)%it)
    end do
    deallocate(all_elements)
  end subroutine elements_end

  ! At the end of an increment: commits it, and writes the states if Abaqus writes its restart files.
  subroutine elements_save(write_files, kstep, kinc)
    logical, intent(in) :: write_files
    integer, intent(in) :: kstep, kinc
    integer :: i, status
    character(1024) :: message
    if (.not. allocated(all_elements)) return
    do i = 1, size(all_elements)
      associate (it => all_elements(i)%it)
        if (it%pending) call it%accept()
        if (.not. write_files .or. .not. it%solver%exists()) cycle
        call it%solver%save_file(state_file(it%number, kstep, kinc, ''), status, message)
        if (status /= DELAM_OK) call say(it%number, 'cannot write the state for a restart: ' // message)
      end associate
    end do
  end subroutine elements_save

  subroutine restart_at(kstep, kinc)
    integer, intent(in) :: kstep, kinc
    restarted = .true.
    restart_step = kstep
    restart_increment = kinc
  end subroutine restart_at

  ! Beside the files of the job, or of the job `old`.
  function state_file(number, kstep, kinc, old) result(path)
    integer, intent(in) :: number, kstep, kinc
    character(*), intent(in) :: old
    character(:), allocatable :: path
    character(256) :: folder, job
    character(80) :: tail
    integer :: folder_length, job_length
    call getoutdir(folder, folder_length)
    call getjobname(job, job_length)
    if (old /= '') then
      job = old
      job_length = len_trim(old)
    end if
    write (tail, '(3(a,i0),a)') '-e', number, '-s', kstep, '-i', kinc, '.delam'
    path = folder(:folder_length) // '/' // job(:job_length) // trim(tail)
  end function state_file

  ! Into the message file of the job.
  subroutine say(number, text)
    integer, intent(in) :: number
    character(*), intent(in) :: text
    write (message_file, '(a,i0,2a)') ' ***NOTE: libdelam, user element ', number, ': ', trim(text)
    flush (message_file)
  end subroutine say

  subroutine stop_analysis(number, text)
    integer, intent(in) :: number
    character(*), intent(in) :: text
    call say(number, text)
    call xit()
  end subroutine stop_analysis

  ! Makes the solver, with a pattern for each displacement of the element's nodes.
  subroutine build(self, jtype, props, jprops, coords)
    class(element), intent(inout) :: self
    integer, intent(in) :: jtype, jprops(:)
    real(dp), intent(in) :: props(:), coords(:,:)
    type(delam_mesh) :: mesh
    type(delam_problem) :: problem
    real(dp) :: origin(size(coords, 1))
    character(1024) :: message
    integer :: status, node
    call self%context%create(status, message)
    if (status == DELAM_OK) call delam_uel_model(self%number, jtype, props, jprops, coords, self%context, mesh, &
                                                 problem, origin, status, message)
    if (status == DELAM_OK) then
      if (problem%pattern_count() > 0) call stop_analysis(self%number, 'delam_uel_model must not add load patterns')
      allocate(self%patterns(size(coords)), self%names(size(coords)), self%committed(size(coords)), &
               self%trial(size(coords)))
      self%committed = 0
    end if
    do node = 1, size(coords, 2)
      if (status == DELAM_OK) call self%drive_node(mesh, problem, node, coords(:, node) - origin, status, message)
    end do
    if (status == DELAM_OK) call self%solver%create(problem, 0.0_dp, status, message)
    if (status /= DELAM_OK) call stop_analysis(self%number, message)
    if (restarted) call self%reload()
  end subroutine build

  ! The displacements of one node of the element move the nodes of the mesh at its place: two or more where bodies meet.
  subroutine drive_node(self, mesh, problem, node, at, status, message)
    class(element), intent(inout) :: self
    type(delam_mesh), intent(in) :: mesh
    type(delam_problem), intent(in) :: problem
    integer, intent(in) :: node
    real(dp), intent(in) :: at(:)
    integer, intent(out) :: status
    character(*), intent(out) :: message
    real(dp), parameter :: close = 1e-6_dp   ! of the size of the mesh: decks have few digits
    real(dp), allocatable :: nodes(:,:)
    integer(delam_index), allocatable :: here(:)
    real(dp) :: reach, direction(size(at))
    integer :: axis, p
    nodes = mesh%nodes()
    reach = close*maxval(maxval(nodes, 2) - minval(nodes, 2))
    here = mesh%find_nodes(at - reach, at + reach)
    if (size(here) == 0) then
      status = DELAM_ERROR_MESH
      write (message, '(a,i0,a,3(1x,g0.6))') 'no node of the mesh lies at node ', node, &
        ' of the element, relative to the origin of the mesh at', at
      return
    end if
    do axis = 1, size(at)
      p = size(at)*(node - 1) + axis
      write (self%names(p), '(2(a,i0))') 'n', node, '_', axis
      call problem%add_pattern(trim(self%names(p)), [0.0_dp], [0.0_dp], self%patterns(p), status, message)
      direction = 0
      direction(axis) = 1
      if (status == DELAM_OK) call problem%prescribe_nodes(here, direction, self%patterns(p), 1.0_dp, status, message)
      if (status /= DELAM_OK) return
    end do
  end subroutine drive_node

  ! Reads the state with which a restart begins. A restarted job has a new name: that of the old one is in the
  ! environment, because Abaqus has no routine that tells it.
  subroutine reload(self)
    class(element), intent(inout) :: self
    character(256) :: old
    character(1024) :: message
    integer :: status, p
    call get_environment_variable('DELAM_UEL_OLDJOB', old)
    call self%solver%load_file(state_file(self%number, restart_step, restart_increment, trim(old)), status, message)
    if (status /= DELAM_OK) call stop_analysis(self%number, 'no state to restart from: ' // message)
    self%step = nint(self%solver%value('step'))
    self%committed = [(self%solver%value('load:' // trim(self%names(p))), p=1, size(self%names))]
  end subroutine reload

  ! Follows the host, which begins an iteration from the state of this number with these displacements.
  subroutine follow(self, state, start)
    class(element), intent(inout) :: self
    integer, intent(in) :: state
    real(dp), intent(in) :: start(:)
    real(dp), parameter :: rounding = 1e-9_dp
    character(1024) :: message
    integer :: status
    if (self%pending .and. state == self%step + 1) then
      ! The host accepts the last trial, usually the one that was computed last.
      status = DELAM_OK
      if (maxval(abs(start - self%trial)) > rounding*maxval(abs(start))) call self%try(start, status, message)
      if (status /= DELAM_OK) call stop_analysis(self%number, message)
      call self%accept()
    end if
    if (state /= self%step) then
      write (message, '(2(a,i0))') 'the host is at state ', state, ' (SVARS(1)), but the element is at ', self%step
      call stop_analysis(self%number, message)
    end if
    if (maxval(abs(start - self%committed)) > rounding*maxval(abs(start))) &
      call stop_analysis(self%number, 'the increment does not start from the displacements of the last one')
  end subroutine follow

  ! Computes the trial step to these displacements, from the committed state.
  subroutine try(self, u, status, message)
    class(element), intent(inout) :: self
    real(dp), intent(in) :: u(:)
    integer, intent(out) :: status
    character(*), intent(out) :: message
    real(dp) :: clock
    integer :: p
    status = DELAM_OK
    message = ''
    if (self%pending) then
      if (all(self%trial == u)) return
      call self%solver%rollback()
      self%pending = .false.
    end if
    clock = self%step + 1
    do p = 1, size(u)
      call self%solver%set_history(self%patterns(p), [clock], u(p:p), status, message)
      if (status /= DELAM_OK) return
    end do
    call self%solver%advance(clock, status, message)
    self%pending = self%solver%pending()
    self%trial = u
  end subroutine try

  subroutine accept(self)
    class(element), intent(inout) :: self
    character(1024) :: message
    integer :: status
    call self%solver%commit(status, message)
    if (status /= DELAM_OK) then
      call say(self%number, message)
      return   ! the next call of UEL finds the number of the state wrong, and stops
    end if
    self%pending = .false.
    self%step = self%step + 1
    self%committed = self%trial
  end subroutine accept

  ! No trial step could be used: discards it. matrix: a stiffness of the committed state, for a host that wants one.
  subroutine give_up(self, matrix)
    class(element), intent(inout) :: self
    real(dp), intent(out) :: matrix(:,:)
    integer :: status
    if (self%pending) call self%solver%rollback()
    self%pending = .false.
    matrix = self%solver%tangent(status)
    if (status /= DELAM_OK) matrix = 0
  end subroutine give_up
end module delam_uel_elements

subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, nnode, u, du, v, a, &
               jtype, time, dtime, kstep, kinc, jelem, params, ndload, jdltyp, adlmag, predef, npredf, lflags, mlvarx, &
               ddlmag, mdload, pnewdt, jprops, njprop, period)
  use delam
  use delam_uel_elements
  implicit none
  integer, intent(in) :: ndofel, nrhs, nsvars, nprops, mcrd, nnode, jtype, kstep, kinc, jelem, ndload, npredf, mlvarx, &
                         mdload, njprop, lflags(*), jprops(*), jdltyp(mdload, *)
  real(dp), intent(inout) :: rhs(mlvarx, *), amatrx(ndofel, ndofel), svars(*), energy(8), pnewdt
  real(dp), intent(in) :: props(*), coords(mcrd, nnode), u(ndofel), du(mlvarx, *), v(ndofel), a(ndofel), time(2), &
                          dtime, params(*), adlmag(mdload, *), predef(2, npredf, nnode), ddlmag(mdload, *), period
  real(dp), parameter :: cut_back = 0.5_dp
  type(element), pointer :: it
  character(1024) :: message
  integer :: status, p
  logical :: new, matrix, forces
  if (ndofel /= nnode*(ndofel/nnode) .or. ndofel/nnode < 2 .or. ndofel/nnode > mcrd) &
    call stop_analysis(jelem, 'each node of the element has the displacements 1, 2 and in space 3, and no others')
  if (nsvars < 2) call stop_analysis(jelem, 'VARIABLES must be at least 2')
  if (all(lflags(1) /= [1, 2]) .or. lflags(4) /= 0 .or. all(lflags(3) /= [1, 2, 5])) &
    call stop_analysis(jelem, 'only general steps of *STATIC are possible')
  matrix = lflags(3) /= 5
  forces = lflags(3) /= 2
  rhs(:ndofel, :nrhs) = 0
  it => element_of(jelem, new)
  if (new) then
    call it%build(jtype, props(:nprops), jprops(:njprop), coords(:ndofel/nnode, :))
    if (lflags(2) == 1) call say(jelem, 'NLGEOM has no effect: the element has small displacements')
  end if
  call it%follow(nint(svars(1)), u - du(:ndofel, 1))
  call it%try(u, status, message)
  if (status == DELAM_OK .and. matrix) amatrx = transpose(it%solver%step_tangent(status, message))
  if (status /= DELAM_OK) then
    call say(jelem, 'the increment is too large: ' // message)
    call it%give_up(amatrx)
    pnewdt = min(pnewdt, cut_back)
    return
  end if
  if (.not. forces) return
  rhs(:ndofel, 1) = [(-it%solver%value('reaction:' // trim(it%names(p))), p=1, ndofel)]
  energy = 0
  energy(2) = it%solver%value('stored_bulk') + it%solver%value('stored_interface')
  energy(4) = it%solver%value('dissipated')
  energy(5) = svars(2) + it%solver%value('released')
  call set_variables(it, svars(:nsvars), energy)

contains

  subroutine set_variables(it, variables, energy)
    type(element), intent(in) :: it
    real(dp), intent(inout) :: variables(:)
    real(dp), intent(in) :: energy(8)
    real(dp) :: values(8)
    integer :: n
    n = min(size(variables), size(values))
    values = [real(it%step + 1, dp), energy(5), energy(4), it%solver%value('front'), &
              it%solver%value('debonded_length'), it%solver%value('contact_pairs'), it%solver%value('jumps'), &
              it%solver%value('mixity_error')]
    variables(:n) = values(:n)
  end subroutine set_variables
end subroutine uel

! Abaqus calls it at the start and at the end of the analysis, of steps and of increments.
subroutine uexternaldb(lop, lrestart, time, dtime, kstep, kinc)
  use delam_uel_elements
  implicit none
  integer, intent(in) :: lop, lrestart, kstep, kinc
  real(dp), intent(in) :: time(2), dtime
  select case (lop)
  case (0)
    call elements_begin()
  case (2)
    call elements_save(lrestart /= 0, kstep, kinc)
  case (3)
    call elements_end()
  case (4)
    call elements_begin()
    call restart_at(kstep, kinc)
  end select
end subroutine uexternaldb
