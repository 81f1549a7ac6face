! SPDX-License-Identifier: BSD-3-Clause
!
! libdelam for Fortran 2008 (with TS 29113, now in Fortran 2018): derived types over the interfaces of delam_raw.
!
! What every procedure here keeps to
!   status, message  optional. With `status` the caller decides what to do about an error (< 0) or an outcome (> 0), and
!                    `message` says it in words (blank: done; cut off or padded like errmsg, context%message() has it
!                    whole). Without `status` anything but DELAM_OK ends the program by error stop, after the message
!                    went to the error unit.
!   arrays           as in delam.h with the axes reversed: C's [n][3] is (3,n). Contiguous ones are handed over where
!                    they are; the compiler copies others. Array results are allocated here and filled by the library.
!   indices          from 1, outputs too (0: none). Numbers that are not indices are as in C: labels of bodies (layers
!                    have 0, 1, ...; where `body` is absent all are meant) and load steps (the initial state is step 0).
!                    Where a message of the library names a single index it counts from 0.
!   objects          are made by create, destroyed when they leave their scope or by destroy. An assignment makes a
!                    second name of the same object, which lives until the last one is gone; so does the context,
!                    and a law by Fortran procedures as long as a problem or solver uses it. (GNU Fortran 12 copies
!                    objects wrongly when a derived type that contains them is assigned as a whole: assign them singly.)
module delam
  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_char, c_size_t, c_int8_t, c_int32_t, c_int64_t, c_double, &
                                         c_null_ptr, c_null_char, c_null_funptr, c_associated, c_loc, c_funloc, &
                                         c_f_pointer
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delam_raw
  implicit none
  public
  private :: c_ptr, c_funptr, c_char, c_size_t, c_int8_t, c_int32_t, c_int64_t, c_double, c_null_ptr, c_null_char, &
             c_null_funptr, c_associated, c_loc, c_funloc, c_f_pointer, error_unit
  private :: shared, keeper, release, adopt, keep, keep_all, next_owner, settle, refuse, conclude, zero_ended, strlen, &
             on_log, on_progress, on_adhesion, on_dissipation, nodes_of, body_or_all, part_of, dimension_of, &
             take_mesh, &
             fits, paired, count_of, in_space

  integer, parameter :: delam_real = c_double
  integer, parameter :: delam_index = c_int64_t
  integer, parameter :: delam_byte = c_int8_t
  integer, parameter :: delam_label = c_int32_t

  ! Extend it to hear what the library says, and to stop it. Either procedure may be left as it is.
  type :: delam_observer
  contains
    procedure :: log => ignore_line
    procedure :: progress => ignore_progress
  end type delam_observer

  ! Extend it to give an interface law by Fortran procedures; the components of the extension are its parameters.
  type, abstract :: delam_host_law
  contains
    ! Adhesion on a first loading: the minimiser of adhesion*driving + g(mixity, adhesion) in [0,1], and its slope.
    procedure(delam_adhesion), deferred :: adhesion
    ! Energy g spent at an adhesion, with its slopes in the adhesion and in the mixity.
    procedure(delam_dissipation), deferred :: dissipation
  end type delam_host_law

  abstract interface
    subroutine delam_adhesion(self, mixity, driving, adhesion, slope, failed)
      import :: delam_host_law, delam_real
      class(delam_host_law), intent(in) :: self
      real(delam_real), intent(in) :: mixity, driving
      real(delam_real), intent(out) :: adhesion, slope
      logical, intent(inout) :: failed
    end subroutine delam_adhesion
    subroutine delam_dissipation(self, mixity, adhesion, dissipated, slope, mixity_slope, failed)
      import :: delam_host_law, delam_real
      class(delam_host_law), intent(in) :: self
      real(delam_real), intent(in) :: mixity, adhesion
      real(delam_real), intent(out) :: dissipated, slope, mixity_slope
      logical, intent(inout) :: failed
    end subroutine delam_dissipation
  end interface

  ! What the names of one object have in common: the handle, and what must outlive it.
  type :: keeper
    type(shared), pointer :: it => null()
  end type keeper
  type :: shared
    type(c_ptr) :: handle = c_null_ptr
    character(7) :: kind = ''
    integer :: owners = 1
    integer :: dimension = 0   ! of a problem's mesh
    type(shared), pointer :: context => null()
    type(keeper), allocatable :: kept(:)
    class(delam_host_law), allocatable :: law
    class(delam_observer), pointer :: observer => null()
  end type shared

  type, abstract :: delam_object
    type(shared), pointer, private :: it => null()
  contains
    ! For calls of delam_raw; stays owned by the object.
    procedure :: handle => object_handle
    procedure :: exists => object_exists
    procedure :: destroy => object_destroy
  end type delam_object

  type, extends(delam_object) :: delam_context
  contains
    procedure :: create => context_create
    procedure :: message => context_message
    procedure :: observe => context_observe
    procedure :: unobserve => context_unobserve
    procedure :: cancel => context_cancel
    procedure, private :: same_context
    generic :: assignment(=) => same_context
    final :: drop_context
  end type delam_context

  type, extends(delam_object) :: delam_mesh
  contains
    procedure :: create => mesh_create
    procedure :: create_layers => mesh_create_layers
    procedure :: add_cells => mesh_add_cells
    procedure :: add_conforming_cells => mesh_add_conforming_cells
    procedure :: add_interface => mesh_add_interface
    procedure :: add_all_interfaces => mesh_add_all_interfaces
    procedure :: add_projected_interface => mesh_add_projected_interface
    procedure :: add_obstacle => mesh_add_obstacle
    procedure :: get_size => mesh_get_size
    procedure :: nodes => mesh_nodes
    procedure :: node_bodies => mesh_node_bodies
    procedure :: node_origins => mesh_node_origins
    procedure :: node_ties => mesh_node_ties
    procedure :: cells => mesh_cells
    procedure :: interface_size => mesh_interface_size
    procedure :: interface_pairs => mesh_interface_pairs
    procedure :: interface_faces => mesh_interface_faces
    procedure :: find_nodes => mesh_find_nodes
    procedure :: find_patch => mesh_find_patch
    procedure, private :: same_mesh
    generic :: assignment(=) => same_mesh
    final :: drop_mesh
  end type delam_mesh

  type, extends(delam_object) :: delam_law
  contains
    procedure :: create => law_create
    procedure :: create_host => law_create_host
    procedure, private :: law_set_number, law_set_text
    generic :: set => law_set_number, law_set_text
    procedure :: set_table => law_set_table
    procedure :: check => law_check
    procedure :: toughness => law_toughness
    procedure :: respond => law_respond
    procedure, private :: same_law
    generic :: assignment(=) => same_law
    final :: drop_law
  end type delam_law

  type, extends(delam_object) :: delam_problem
  contains
    procedure :: create => problem_create
    procedure :: set_plane => problem_set_plane
    procedure :: set_elastic => problem_set_elastic
    procedure :: set_orthotropic => problem_set_orthotropic
    procedure :: set_orientation => problem_set_orientation
    procedure :: set_formulation => problem_set_formulation
    procedure :: set_law => problem_set_law
    procedure :: set_bonded => problem_set_bonded
    procedure :: set_contact => problem_set_contact
    procedure :: set_adhesion => problem_set_adhesion
    procedure :: add_pattern => problem_add_pattern
    procedure, private :: problem_prescribe_nodes, problem_prescribe_patterns
    generic :: prescribe_nodes => problem_prescribe_nodes, problem_prescribe_patterns
    procedure :: prescribe_mean => problem_prescribe_mean
    procedure :: add_equation => problem_add_equation
    procedure :: add_periodic => problem_add_periodic
    procedure :: add_forces => problem_add_forces
    procedure :: add_eigenstrain => problem_add_eigenstrain
    procedure, private :: problem_set_number, problem_set_whole, problem_set_text
    generic :: set => problem_set_number, problem_set_whole, problem_set_text
    procedure :: check => problem_check
    procedure :: hash => problem_hash
    procedure :: dofs => problem_dofs
    procedure :: process_zone => problem_process_zone
    procedure :: body_matrix => problem_body_matrix
    procedure :: constraints => problem_constraints
    procedure :: forces => problem_forces
    procedure :: eigenstrain_energy => problem_eigenstrain_energy
    procedure :: factors => problem_factors
    procedure :: pattern_count => problem_pattern_count
    procedure :: pattern_name => problem_pattern_name
    procedure, private :: same_problem
    generic :: assignment(=) => same_problem
    final :: drop_problem
  end type delam_problem

  type, extends(delam_object) :: delam_solver
  contains
    procedure :: create => solver_create
    procedure :: advance => solver_advance
    procedure :: commit => solver_commit
    procedure :: rollback => solver_rollback
    procedure :: equilibrate => solver_equilibrate
    procedure :: value => solver_value
    procedure :: value_count => solver_value_count
    procedure :: value_name => solver_value_name
    procedure :: field_shape => solver_field_shape
    procedure :: field => solver_field
    procedure :: fill_field => solver_fill_field
    procedure :: average => solver_average
    procedure :: front => solver_front
    procedure :: tangent => solver_tangent
    procedure :: plan => solver_plan
    procedure :: plan_count => solver_plan_count
    procedure :: plan_item => solver_plan_item
    procedure :: option => solver_option
    procedure :: searched => solver_searched
    procedure :: look => solver_look
    procedure :: jump_count => solver_jump_count
    procedure :: jump => solver_jump
    procedure :: save => solver_save
    procedure :: load => solver_load
    procedure, private :: same_solver
    generic :: assignment(=) => same_solver
    final :: drop_solver
  end type delam_solver

  interface
    pure function strlen(text) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function strlen
  end interface

contains

  ! ---- texts -------------------------------------------------------------------------------------------------------

  ! A text of the library; '' where there is none.
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

  function delam_version_text() result(text)
    character(:), allocatable :: text
    text = delam_text(delam_version())
  end function delam_version_text

  ! An option of problems, counted from 1 to delam_option_count(); '' where there is none of that number.
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

  ! Number of the parameters of a kind of law, all its criteria taken together.
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

  function zero_ended(text) result(ended)
    character(*), intent(in) :: text
    character(len_trim(text) + 1, kind=c_char) :: ended
    ended = trim(text) // c_null_char
  end function zero_ended

  ! ---- owners ------------------------------------------------------------------------------------------------------

  recursive subroutine release(it)
    type(shared), pointer, intent(inout) :: it
    type(shared), pointer :: was
    integer :: i
    if (.not. associated(it)) return
    was => it
    nullify(it)
    was%owners = was%owners - 1
    if (was%owners > 0) return
    select case (was%kind)
    case ('context')
      call delam_context_destroy(was%handle)
    case ('mesh')
      call delam_mesh_destroy(was%handle)
    case ('law')
      call delam_law_destroy(was%handle)
    case ('problem')
      call delam_problem_destroy(was%handle)
    case ('solver')
      call delam_solver_destroy(was%handle)
    end select
    if (allocated(was%kept)) then
      do i = 1, size(was%kept)
        call release(was%kept(i)%it)
      end do
    end if
    deallocate(was)
  end subroutine release

  ! `self` gives up what it has and takes a new handle, whose context is kept alive.
  subroutine adopt(self, made, kind, context)
    class(delam_object), intent(inout) :: self
    type(shared), pointer, intent(in) :: made, context
    character(*), intent(in) :: kind
    made%kind = kind
    made%context => made
    if (associated(context)) then
      made%context => context
      call keep(made, context)
    end if
    call release(self%it)
    self%it => made
  end subroutine adopt

  subroutine keep(it, other)
    type(shared), pointer, intent(in) :: it, other
    type(keeper), allocatable :: kept(:)
    integer :: i, n
    n = 0
    if (allocated(it%kept)) n = size(it%kept)
    do i = 1, n
      if (associated(it%kept(i)%it, other)) return
    end do
    allocate(kept(n + 1))
    if (n > 0) kept(:n) = it%kept
    kept(n + 1)%it => other
    other%owners = other%owners + 1
    call move_alloc(kept, it%kept)
  end subroutine keep

  subroutine keep_all(it, of)
    type(shared), pointer, intent(in) :: it, of
    integer :: i
    if (.not. allocated(of%kept)) return
    do i = 1, size(of%kept)
      call keep(it, of%kept(i)%it)
    end do
  end subroutine keep_all

  subroutine next_owner(self, other)
    class(delam_object), intent(inout) :: self
    class(delam_object), intent(in) :: other
    type(shared), pointer :: it
    it => other%it
    if (associated(it)) it%owners = it%owners + 1
    call release(self%it)
    self%it => it
  end subroutine next_owner

  function object_handle(self) result(handle)
    class(delam_object), intent(in) :: self
    type(c_ptr) :: handle
    handle = c_null_ptr
    if (associated(self%it)) handle = self%it%handle
  end function object_handle

  function object_exists(self) result(exists)
    class(delam_object), intent(in) :: self
    logical :: exists
    exists = associated(self%it)
  end function object_exists

  ! Gives up this name of the object before it leaves its scope.
  subroutine object_destroy(self)
    class(delam_object), intent(inout) :: self
    call release(self%it)
  end subroutine object_destroy

  impure elemental subroutine drop_context(self)
    type(delam_context), intent(inout) :: self
    call release(self%it)
  end subroutine drop_context

  impure elemental subroutine drop_mesh(self)
    type(delam_mesh), intent(inout) :: self
    call release(self%it)
  end subroutine drop_mesh

  impure elemental subroutine drop_law(self)
    type(delam_law), intent(inout) :: self
    call release(self%it)
  end subroutine drop_law

  impure elemental subroutine drop_problem(self)
    type(delam_problem), intent(inout) :: self
    call release(self%it)
  end subroutine drop_problem

  impure elemental subroutine drop_solver(self)
    type(delam_solver), intent(inout) :: self
    call release(self%it)
  end subroutine drop_solver

  subroutine same_context(self, other)
    class(delam_context), intent(inout) :: self
    type(delam_context), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_context

  subroutine same_mesh(self, other)
    class(delam_mesh), intent(inout) :: self
    type(delam_mesh), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_mesh

  subroutine same_law(self, other)
    class(delam_law), intent(inout) :: self
    type(delam_law), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_law

  subroutine same_problem(self, other)
    class(delam_problem), intent(inout) :: self
    type(delam_problem), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_problem

  subroutine same_solver(self, other)
    class(delam_solver), intent(inout) :: self
    type(delam_solver), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_solver

  ! ---- statuses ----------------------------------------------------------------------------------------------------

  ! Hands status and message to the caller, or ends the program where it did not ask for the status.
  subroutine settle(code, object, status, message)
    integer(c_int32_t), intent(in) :: code
    class(delam_object), intent(in) :: object
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    character(:), allocatable :: text
    text = ''
    if (code /= DELAM_OK) then
      if (.not. associated(object%it)) then
        text = 'the object has not been created'
      else
        text = delam_text(delam_context_message(object%it%context%handle))
      end if
    end if
    call conclude(code, text, status, message)
  end subroutine settle

  ! As settle, for what is refused before the library is asked.
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

  ! ---- context -----------------------------------------------------------------------------------------------------

  subroutine context_create(self, status, message)
    class(delam_context), intent(inout) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_context_create(made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'context', null())
    else
      deallocate(made)
    end if
    if (code == DELAM_OK) then
      call conclude(code, '', status, message)
    else
      call conclude(code, 'no context could be made', status, message)
    end if
  end subroutine context_create

  ! Text of the last status that was not DELAM_OK.
  function context_message(self) result(text)
    class(delam_context), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_context_message(self%handle()))
  end function context_message

  ! `observer` is not copied: it stays the caller's, and must live as long as it is asked.
  subroutine context_observe(self, observer, status, message)
    class(delam_context), intent(inout) :: self
    class(delam_observer), intent(in), target :: observer
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    if (.not. associated(self%it)) then
      call settle(DELAM_ERROR_HANDLE, self, status, message)
      return
    end if
    self%it%observer => observer
    code = delam_context_set_log(self%it%handle, c_funloc(on_log), c_loc(self%it))
    if (code == DELAM_OK) code = delam_context_set_progress(self%it%handle, c_funloc(on_progress), c_loc(self%it))
    call settle(code, self, status, message)
  end subroutine context_observe

  subroutine context_unobserve(self, status, message)
    class(delam_context), intent(inout) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    code = delam_context_set_log(self%handle(), c_null_funptr, c_null_ptr)
    if (code == DELAM_OK) code = delam_context_set_progress(self%handle(), c_null_funptr, c_null_ptr)
    if (associated(self%it)) nullify(self%it%observer)
    call settle(code, self, status, message)
  end subroutine context_unobserve

  ! From any thread.
  subroutine context_cancel(self, status, message)
    class(delam_context), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_context_cancel(self%handle()), self, status, message)
  end subroutine context_cancel

  subroutine ignore_line(self, level, text)
    class(delam_observer), intent(inout) :: self
    integer, intent(in) :: level   ! 0 error, 1 warning, 2 information
    character(*), intent(in) :: text
  end subroutine ignore_line

  ! `total` 0: not known. `cancel`, .false. before, ends the call with DELAM_CANCELLED.
  subroutine ignore_progress(self, stage, done, total, cancel)
    class(delam_observer), intent(inout) :: self
    character(*), intent(in) :: stage
    integer(delam_index), intent(in) :: done, total
    logical, intent(inout) :: cancel
  end subroutine ignore_progress

  subroutine on_log(level, text, user) bind(c, name='')
    integer(c_int32_t), value :: level
    type(c_ptr), value :: text, user
    type(shared), pointer :: it
    call c_f_pointer(user, it)
    call it%observer%log(int(level), delam_text(text))
  end subroutine on_log

  function on_progress(stage, done, total, user) bind(c, name='') result(answer)
    type(c_ptr), value :: stage, user
    integer(c_int64_t), value :: done, total
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: cancel
    call c_f_pointer(user, it)
    cancel = .false.
    call it%observer%progress(delam_text(stage), done, total, cancel)
    answer = merge(1_c_int32_t, 0_c_int32_t, cancel)
  end function on_progress

  ! ---- mesh --------------------------------------------------------------------------------------------------------

  pure function nodes_of(cell_type) result(nodes)
    integer, intent(in) :: cell_type
    integer :: nodes
    integer, parameter :: of(9) = [3, 4, 4, 8, 6, 8, 9, 10, 20]
    nodes = 0
    if (cell_type >= 1 .and. cell_type <= size(of)) nodes = of(cell_type)
  end function nodes_of

  pure function body_or_all(body) result(label)
    integer, intent(in), optional :: body
    integer(c_int32_t) :: label
    label = -1
    if (present(body)) label = int(body, c_int32_t)
  end function body_or_all

  ! nodes: (dimension, count)
  subroutine mesh_create(self, context, nodes, status, message)
    class(delam_mesh), intent(inout) :: self
    type(delam_context), intent(in) :: context
    real(delam_real), intent(in), contiguous :: nodes(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_mesh_create(context%handle(), size(nodes, 1, c_int32_t), size(nodes, 2, c_int64_t), nodes, made%handle)
    call take_mesh(self, made, context)
    call settle(code, context, status, message)
  end subroutine mesh_create

  subroutine take_mesh(self, made, context)
    class(delam_mesh), intent(inout) :: self
    type(shared), pointer, intent(inout) :: made
    type(delam_context), intent(in) :: context
    if (c_associated(made%handle)) then
      call adopt(self, made, 'mesh', context%it)
    else
      deallocate(made)
    end if
  end subroutine take_mesh

  ! lengths, divisions: along the other axes; thickness, layer_divisions: of each layer.
  subroutine mesh_create_layers(self, context, lengths, divisions, thickness, layer_divisions, cell_type, status, &
                                message)
    class(delam_mesh), intent(inout) :: self
    type(delam_context), intent(in) :: context
    real(delam_real), intent(in), contiguous :: lengths(:), thickness(:)
    integer(delam_index), intent(in), contiguous :: divisions(:), layer_divisions(:)
    integer, intent(in) :: cell_type
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    if (size(lengths) /= size(divisions) .or. size(thickness) /= size(layer_divisions)) then
      call refuse('lengths and divisions, thickness and layer_divisions: unequal sizes', status, message)
      return
    end if
    allocate(made)
    code = delam_mesh_create_layers(context%handle(), int(size(lengths) + 1, c_int32_t), lengths, divisions, &
                                    size(thickness, kind=c_int64_t), thickness, layer_divisions, cell_type, made%handle)
    call take_mesh(self, made, context)
    call settle(code, context, status, message)
  end subroutine mesh_create_layers

  ! connectivity: (nodes of the type, cells); bodies: (cells), absent for all 0.
  subroutine mesh_add_cells(self, cell_type, connectivity, bodies, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: cell_type
    integer(delam_index), intent(in), contiguous :: connectivity(:,:)
    integer(delam_label), intent(in), contiguous, optional :: bodies(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. fits(cell_type, connectivity, bodies)) then
      call refuse('connectivity must be (nodes of the cell type, cells), bodies (cells)', status, message)
      return
    end if
    call settle(delam_mesh_add_cells(self%handle(), cell_type, size(connectivity, 2, c_int64_t), connectivity, bodies, &
                                     1_c_int32_t), self, status, message)
  end subroutine mesh_add_cells

  subroutine mesh_add_conforming_cells(self, cell_type, connectivity, bodies, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: cell_type
    integer(delam_index), intent(in), contiguous :: connectivity(:,:)
    integer(delam_label), intent(in), contiguous, optional :: bodies(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. fits(cell_type, connectivity, bodies)) then
      call refuse('connectivity must be (nodes of the cell type, cells), bodies (cells)', status, message)
      return
    end if
    call settle(delam_mesh_add_conforming_cells(self%handle(), cell_type, size(connectivity, 2, c_int64_t), &
                                                connectivity, bodies, 1_c_int32_t), self, status, message)
  end subroutine mesh_add_conforming_cells

  ! Unknown cell types are left to the library, which names them.
  pure function fits(cell_type, connectivity, bodies)
    integer, intent(in) :: cell_type
    integer(delam_index), intent(in) :: connectivity(:,:)
    integer(delam_label), intent(in), optional :: bodies(:)
    logical :: fits
    fits = nodes_of(cell_type) == 0 .or. size(connectivity, 1) == nodes_of(cell_type)
    if (present(bodies)) fits = fits .and. size(bodies) == size(connectivity, 2)
  end function fits

  subroutine mesh_add_interface(self, body_a, body_b, tolerance, interface, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: body_a, body_b
    real(delam_real), intent(in), optional :: tolerance
    integer, intent(out), optional :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    real(delam_real) :: distance
    distance = 0
    if (present(tolerance)) distance = tolerance
    made = -1
    code = delam_mesh_add_interface(self%handle(), body_a, body_b, distance, made)
    if (present(interface)) interface = int(made) + 1
    call settle(code, self, status, message)
  end subroutine mesh_add_interface

  subroutine mesh_add_all_interfaces(self, tolerance, count, status, message)
    class(delam_mesh), intent(in) :: self
    real(delam_real), intent(in), optional :: tolerance
    integer, intent(out), optional :: count
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    real(delam_real) :: distance
    distance = 0
    if (present(tolerance)) distance = tolerance
    made = 0
    code = delam_mesh_add_all_interfaces(self%handle(), distance, made)
    if (present(count)) count = int(made)
    call settle(code, self, status, message)
  end subroutine mesh_add_all_interfaces

  subroutine mesh_add_projected_interface(self, body_a, body_b, gap, interface, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: body_a, body_b
    real(delam_real), intent(in), optional :: gap
    integer, intent(out), optional :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    real(delam_real) :: distance
    distance = 0
    if (present(gap)) distance = gap
    made = -1
    code = delam_mesh_add_projected_interface(self%handle(), body_a, body_b, distance, made)
    if (present(interface)) interface = int(made) + 1
    call settle(code, self, status, message)
  end subroutine mesh_add_projected_interface

  ! nodes: (count); normals: (dimension, count); weights: (count), absent for the nodal ones.
  subroutine mesh_add_obstacle(self, nodes, normals, control_node, weights, interface, status, message)
    class(delam_mesh), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: normals(:,:)
    integer(delam_index), intent(in) :: control_node
    real(delam_real), intent(in), contiguous, optional :: weights(:)
    integer, intent(out), optional :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    logical :: equal
    equal = size(normals, 1) == dimension_of(self)
    equal = equal .and. size(normals, 2) == size(nodes)
    if (present(weights)) equal = equal .and. size(weights) == size(nodes)
    if (.not. equal) then
      call refuse('normals must be (dimension, nodes), weights (nodes)', status, message)
      return
    end if
    made = -1
    code = delam_mesh_add_obstacle(self%handle(), size(nodes, kind=c_int64_t), nodes, normals, weights, &
                                   control_node - 1, 1_c_int32_t, made)
    if (present(interface)) interface = int(made) + 1
    call settle(code, self, status, message)
  end subroutine mesh_add_obstacle

  ! 0 where the mesh does not exist.
  function dimension_of(self) result(dimension)
    class(delam_mesh), intent(in) :: self
    integer(c_int32_t) :: dimension
    dimension = 0
    if (delam_mesh_size(self%handle(), dimension=dimension) /= DELAM_OK) dimension = 0
  end function dimension_of

  subroutine mesh_get_size(self, dimension, nodes, cells, bodies, interfaces, status, message)
    class(delam_mesh), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: dimension
    integer(delam_index), intent(out), optional :: nodes, cells, bodies, interfaces
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_mesh_size(self%handle(), dimension, nodes, cells, bodies, interfaces), self, status, message)
  end subroutine mesh_get_size

  ! (dimension, nodes)
  function mesh_nodes(self, status, message) result(nodes)
    class(delam_mesh), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: nodes(:,:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_mesh_size(self%handle(), node_count=count)
    allocate(nodes(dimension_of(self), count))
    if (code == DELAM_OK) code = delam_mesh_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes)
    call settle(code, self, status, message)
  end function mesh_nodes

  ! Label of the body of each node; -1 for a node without cells.
  function mesh_node_bodies(self, status, message) result(bodies)
    class(delam_mesh), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_label), allocatable :: bodies(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_mesh_size(self%handle(), node_count=count)
    allocate(bodies(count))
    if (code == DELAM_OK) code = delam_mesh_node_bodies(self%handle(), count, bodies)
    call settle(code, self, status, message)
  end function mesh_node_bodies

  function mesh_node_origins(self, status, message) result(origins)
    class(delam_mesh), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_index), allocatable :: origins(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_mesh_size(self%handle(), node_count=count)
    allocate(origins(count))
    if (code == DELAM_OK) code = delam_mesh_node_origins(self%handle(), count, origins)
    origins = origins + 1
    call settle(code, self, status, message)
  end function mesh_node_origins

  ! u of nodes(i) is the sum of weights(e) * u of of(e) over e = starts(i) .. starts(i+1)-1.
  subroutine mesh_node_ties(self, nodes, starts, of, weights, status, message)
    class(delam_mesh), intent(in) :: self
    integer(delam_index), allocatable, intent(out) :: nodes(:), starts(:), of(:)
    real(delam_real), allocatable, intent(out) :: weights(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: count, entries
    integer(c_int32_t) :: code
    count = 0
    entries = 0
    code = delam_mesh_node_ties(self%handle(), count, entries)
    allocate(nodes(count), starts(count + 1), of(entries), weights(entries))
    starts = 0
    if (code == DELAM_OK) code = delam_mesh_node_ties(self%handle(), nodes=nodes, starts=starts, of=of, weights=weights)
    nodes = nodes + 1
    starts = starts + 1
    of = of + 1
    call settle(code, self, status, message)
  end subroutine mesh_node_ties

  ! Nodes of cell c: connectivity(offsets(c) : offsets(c+1)-1).
  subroutine mesh_cells(self, types, bodies, offsets, connectivity, status, message)
    class(delam_mesh), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: types(:)
    integer(delam_label), allocatable, intent(out) :: bodies(:)
    integer(delam_index), allocatable, intent(out) :: offsets(:), connectivity(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: count, entries
    integer(c_int32_t) :: code
    count = 0
    entries = 0
    code = delam_mesh_size(self%handle(), cell_count=count)
    if (code == DELAM_OK) code = delam_mesh_cells(self%handle(), capacity=0_c_int64_t, needed=entries)
    allocate(types(count), bodies(count), offsets(count + 1), connectivity(entries))
    offsets = 0
    if (code == DELAM_OK) code = delam_mesh_cells(self%handle(), types, bodies, offsets, entries, connectivity)
    offsets = offsets + 1
    connectivity = connectivity + 1
    call settle(code, self, status, message)
  end subroutine mesh_cells

  ! body_a is -1 for an obstacle.
  subroutine mesh_interface_size(self, interface, body_a, body_b, pairs, faces, nodes_per_face, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_label), intent(out), optional :: body_a, body_b
    integer(delam_index), intent(out), optional :: pairs, faces
    integer(c_int32_t), intent(out), optional :: nodes_per_face
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_mesh_interface_size(self%handle(), interface - 1_c_int64_t, body_a, body_b, pairs, faces, &
                                          nodes_per_face), self, status, message)
  end subroutine mesh_interface_size

  ! nodes_a, nodes_b, weights: (pairs); frames: (dimension, dimension, pairs), frames(:,1,p) the normal, then tangents.
  subroutine mesh_interface_pairs(self, interface, nodes_a, nodes_b, weights, frames, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), allocatable, intent(out), optional :: nodes_a(:), nodes_b(:)
    real(delam_real), allocatable, intent(out), optional :: weights(:), frames(:,:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code, dimension
    ! What is not allocated is absent to the library. (GNU Fortran 12 does not pass on absent allocatable dummies.)
    integer(delam_index), allocatable :: a(:), b(:)
    real(delam_real), allocatable :: w(:), f(:,:,:)
    count = 0
    dimension = dimension_of(self)
    code = delam_mesh_interface_size(self%handle(), interface - 1_c_int64_t, pair_count=count)
    if (present(nodes_a)) allocate(a(count))
    if (present(nodes_b)) allocate(b(count))
    if (present(weights)) allocate(w(count))
    if (present(frames)) allocate(f(dimension, dimension, count))
    if (code == DELAM_OK) code = delam_mesh_interface_pairs(self%handle(), interface - 1_c_int64_t, a, b, w, f)
    if (present(nodes_a)) call move_alloc(a, nodes_a)
    if (present(nodes_b)) call move_alloc(b, nodes_b)
    if (present(weights)) call move_alloc(w, weights)
    if (present(frames)) call move_alloc(f, frames)
    if (present(nodes_a)) nodes_a = nodes_a + 1
    if (present(nodes_b)) nodes_b = nodes_b + 1
    call settle(code, self, status, message)
  end subroutine mesh_interface_pairs

  ! Faces as pair indices: (nodes per face, faces).
  function mesh_interface_faces(self, interface, status, message) result(faces)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_index), allocatable :: faces(:,:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code, per_face
    count = 0
    per_face = 0
    code = delam_mesh_interface_size(self%handle(), interface - 1_c_int64_t, face_count=count, nodes_per_face=per_face)
    allocate(faces(per_face, count))
    if (code == DELAM_OK) code = delam_mesh_interface_faces(self%handle(), interface - 1_c_int64_t, faces)
    faces = faces + 1
    call settle(code, self, status, message)
  end function mesh_interface_faces

  ! Nodes of a body (absent: of all) in the closed box lower .. upper, ascending.
  function mesh_find_nodes(self, lower, upper, body, status, message) result(nodes)
    class(delam_mesh), intent(in) :: self
    real(delam_real), intent(in), contiguous :: lower(:), upper(:)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_index), allocatable :: nodes(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    if (any([size(lower), size(upper)] /= dimension_of(self))) then
      allocate(nodes(0))
      call refuse('lower and upper must have the size of the dimension of an existing mesh', status, message)
      return
    end if
    count = 0
    code = delam_mesh_find_nodes(self%handle(), body_or_all(body), lower, upper, 0_c_int64_t, count=count)
    allocate(nodes(count))
    if (code == DELAM_OK .and. count > 0) code = delam_mesh_find_nodes(self%handle(), body_or_all(body), lower, upper, &
                                                                       count, nodes, count)
    nodes = nodes + 1
    call settle(code, self, status, message)
  end function mesh_find_nodes

  subroutine mesh_find_patch(self, body, lower, upper, direction, nodes, weights, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: body
    real(delam_real), intent(in), contiguous :: lower(:), upper(:), direction(:)
    integer(delam_index), allocatable, intent(out) :: nodes(:)
    real(delam_real), allocatable, intent(out) :: weights(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    if (any([size(lower), size(upper), size(direction)] /= dimension_of(self))) then
      allocate(nodes(0), weights(0))
      call refuse('lower, upper and direction must have the size of the dimension of an existing mesh', status, message)
      return
    end if
    count = 0
    code = delam_mesh_find_patch(self%handle(), body, lower, upper, direction, 0_c_int64_t, count=count)
    allocate(nodes(count), weights(count))
    if (code == DELAM_OK) code = delam_mesh_find_patch(self%handle(), body, lower, upper, direction, count, nodes, &
                                                       weights, count)
    nodes = nodes + 1
    call settle(code, self, status, message)
  end subroutine mesh_find_patch

  ! ---- law ---------------------------------------------------------------------------------------------------------

  subroutine law_create(self, context, kind, status, message)
    class(delam_law), intent(inout) :: self
    type(delam_context), intent(in) :: context
    character(*), intent(in) :: kind
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_law_create(context%handle(), zero_ended(kind), made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'law', context%it)
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine law_create

  ! `law` is copied. name stands for it in messages and in the hash of a problem.
  subroutine law_create_host(self, context, name, law, status, message)
    class(delam_law), intent(inout) :: self
    type(delam_context), intent(in) :: context
    character(*), intent(in) :: name
    class(delam_host_law), intent(in) :: law
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    allocate(made%law, source=law)
    code = delam_law_create_host(context%handle(), zero_ended(name), c_funloc(on_adhesion), c_funloc(on_dissipation), &
                                 c_loc(made), made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'law', context%it)
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine law_create_host

  function on_adhesion(mixity, driving, adhesion, slope, user) bind(c, name='') result(answer)
    real(c_double), value :: mixity, driving
    real(c_double), intent(inout) :: adhesion, slope
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: failed
    call c_f_pointer(user, it)
    failed = .false.
    call it%law%adhesion(mixity, driving, adhesion, slope, failed)
    answer = merge(1_c_int32_t, 0_c_int32_t, failed)
  end function on_adhesion

  function on_dissipation(mixity, adhesion, dissipated, slope, mixity_slope, user) bind(c, name='') result(answer)
    real(c_double), value :: mixity, adhesion
    real(c_double), intent(inout) :: dissipated, slope, mixity_slope
    type(c_ptr), value :: user
    integer(c_int32_t) :: answer
    type(shared), pointer :: it
    logical :: failed
    call c_f_pointer(user, it)
    failed = .false.
    call it%law%dissipation(mixity, adhesion, dissipated, slope, mixity_slope, failed)
    answer = merge(1_c_int32_t, 0_c_int32_t, failed)
  end function on_dissipation

  subroutine law_set_number(self, key, value, status, message)
    class(delam_law), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_set(self%handle(), zero_ended(key), value), self, status, message)
  end subroutine law_set_number

  subroutine law_set_text(self, key, value, status, message)
    class(delam_law), intent(in) :: self
    character(*), intent(in) :: key, value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_set_text(self%handle(), zero_ended(key), zero_ended(value)), self, status, message)
  end subroutine law_set_text

  subroutine law_set_table(self, xi, s, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: xi(:), s(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(xi) /= size(s)) then
      call refuse('xi and s: unequal sizes', status, message)
      return
    end if
    call settle(delam_law_set_table(self%handle(), size(xi, kind=c_int64_t), xi, s), self, status, message)
  end subroutine law_set_table

  subroutine law_check(self, status, message)
    class(delam_law), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_law_check(self%handle()), self, status, message)
  end subroutine law_check

  subroutine law_toughness(self, mixity, onset, toughness, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: mixity(:)
    real(delam_real), intent(out), contiguous, optional :: onset(:), toughness(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = .true.
    if (present(onset)) equal = size(onset) == size(mixity)
    if (present(toughness)) equal = equal .and. size(toughness) == size(mixity)
    if (.not. equal) then
      call refuse('onset and toughness must have the size of mixity', status, message)
      return
    end if
    call settle(delam_law_toughness(self%handle(), size(mixity, kind=c_int64_t), mixity, onset, toughness), self, &
                status, &
                message)
  end subroutine law_toughness

  ! jump, traction: (dimension, count), local, the normal component first; mixity, adhesion_old, adhesion: (count).
  subroutine law_respond(self, jump, mixity, adhesion_old, adhesion, traction, status, message)
    class(delam_law), intent(in) :: self
    real(delam_real), intent(in), contiguous :: jump(:,:), mixity(:), adhesion_old(:)
    real(delam_real), intent(out), contiguous :: adhesion(:)
    real(delam_real), intent(out), contiguous, optional :: traction(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = all([size(mixity), size(adhesion_old), size(adhesion)] == size(jump, 2))
    if (present(traction)) equal = equal .and. all(shape(traction) == shape(jump))
    if (.not. equal) then
      call refuse('jump, mixity, adhesion_old, adhesion and traction: unequal sizes', status, message)
      return
    end if
    call settle(delam_law_respond(self%handle(), size(jump, 1, c_int32_t), size(jump, 2, c_int64_t), jump, mixity, &
                                  adhesion_old, adhesion, traction), self, status, message)
  end subroutine law_respond

  ! ---- problem -----------------------------------------------------------------------------------------------------

  subroutine problem_create(self, context, mesh, status, message)
    class(delam_problem), intent(inout) :: self
    type(delam_context), intent(in) :: context
    type(delam_mesh), intent(in) :: mesh
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_problem_create(context%handle(), mesh%handle(), made%handle)
    if (c_associated(made%handle)) then
      made%dimension = dimension_of(mesh)
      call adopt(self, made, 'problem', context%it)
    else
      deallocate(made)
    end if
    call settle(code, context, status, message)
  end subroutine problem_create

  subroutine problem_set_plane(self, assumption, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: assumption
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_plane(self%handle(), zero_ended(assumption)), self, status, message)
  end subroutine problem_set_plane

  subroutine problem_set_elastic(self, young, poisson, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: young, poisson
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_elastic(self%handle(), body_or_all(body), young, poisson), self, status, message)
  end subroutine problem_set_elastic

  ! constants: E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
  subroutine problem_set_orthotropic(self, constants, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: constants(9)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_orthotropic(self%handle(), body_or_all(body), constants), self, status, message)
  end subroutine problem_set_orthotropic

  ! axes: (3, 2, count), directions of the material axes 1 and 2 of each of `cells`; without cells (3, 2, 1) for all.
  subroutine problem_set_orientation(self, axes, cells, body, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in), contiguous :: axes(:,:,:)
    integer(delam_index), intent(in), contiguous, optional :: cells(:)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    logical :: equal
    equal = size(axes, 1) == 3 .and. size(axes, 2) == 2
    if (present(cells)) equal = equal .and. size(axes, 3) == size(cells)
    if (.not. equal) then
      call refuse('axes must be (3, 2, cells)', status, message)
      return
    end if
    call settle(delam_problem_set_orientation(self%handle(), body_or_all(body), size(axes, 3, c_int64_t), cells, axes, &
                                              1_c_int32_t), self, status, message)
  end subroutine problem_set_orientation

  subroutine problem_set_formulation(self, formulation, body, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: formulation
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_formulation(self%handle(), body_or_all(body), zero_ended(formulation)), self, &
                status, &
                message)
  end subroutine problem_set_formulation

  subroutine problem_set_law(self, interface, law, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    type(delam_law), intent(in) :: law
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    code = delam_problem_set_law(self%handle(), interface - 1_c_int64_t, law%handle())
    if (code == DELAM_OK) then
      if (allocated(law%it%law)) call keep(self%it, law%it)
    end if
    call settle(code, self, status, message)
  end subroutine problem_set_law

  subroutine problem_set_bonded(self, interface, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_bonded(self%handle(), interface - 1_c_int64_t), self, status, message)
  end subroutine problem_set_bonded

  subroutine problem_set_contact(self, interface, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_contact(self%handle(), interface - 1_c_int64_t), self, status, message)
  end subroutine problem_set_contact

  subroutine problem_set_adhesion(self, interface, pairs, adhesion, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), intent(in), contiguous :: pairs(:)
    real(delam_real), intent(in), contiguous :: adhesion(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(pairs) /= size(adhesion)) then
      call refuse('pairs and adhesion: unequal sizes', status, message)
      return
    end if
    call settle(delam_problem_set_adhesion(self%handle(), interface - 1_c_int64_t, size(pairs, kind=c_int64_t), pairs, &
                                           adhesion, 1_c_int32_t), self, status, message)
  end subroutine problem_set_adhesion

  ! A factor that follows the line through (times, values).
  subroutine problem_add_pattern(self, name, times, values, pattern, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: name
    real(delam_real), intent(in), contiguous :: times(:), values(:)
    integer(delam_index), intent(out), optional :: pattern
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    if (size(times) /= size(values)) then
      call refuse('times and values: unequal sizes', status, message)
      return
    end if
    made = -1
    code = delam_problem_add_pattern(self%handle(), zero_ended(name), size(times, kind=c_int64_t), times, values, made)
    if (present(pattern)) pattern = made + 1
    call settle(code, self, status, message)
  end subroutine problem_add_pattern

  ! direction . u = coefficient * factor of the pattern; held at zero without a pattern. coefficient: 1 where absent.
  subroutine problem_prescribe_nodes(self, nodes, direction, pattern, coefficient, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: direction(:)
    integer(delam_index), intent(in), optional :: pattern
    real(delam_real), intent(in), optional :: coefficient
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: coefficients(1, size(nodes))
    if (.not. in_space(self, size(direction))) then
      call refuse('direction must have the size of the dimension', status, message)
      return
    end if
    if (.not. present(pattern)) then
      call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                                0_c_int64_t, index_base=1_c_int32_t), self, status, message)
      return
    end if
    coefficients = 1
    if (present(coefficient)) coefficients = coefficient
    call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                              1_c_int64_t, &
                                              [pattern], coefficients, 1_c_int32_t), self, status, message)
  end subroutine problem_prescribe_nodes

  ! coefficients: (patterns, nodes)
  subroutine problem_prescribe_patterns(self, nodes, direction, patterns, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:), patterns(:)
    real(delam_real), intent(in), contiguous :: direction(:), coefficients(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (any(shape(coefficients) /= [size(patterns), size(nodes)]) .or. .not. in_space(self, size(direction))) then
      call refuse('coefficients must be (patterns, nodes), direction (dimension)', status, message)
      return
    end if
    call settle(delam_problem_prescribe_nodes(self%handle(), size(nodes, kind=c_int64_t), nodes, direction, &
                                              size(patterns, kind=c_int64_t), patterns, coefficients, 1_c_int32_t), &
                self, status, message)
  end subroutine problem_prescribe_patterns

  ! weights: (nodes); patterns and coefficients, both or neither: (patterns).
  subroutine problem_prescribe_mean(self, nodes, weights, direction, patterns, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: weights(:), direction(:)
    integer(delam_index), intent(in), contiguous, optional :: patterns(:)
    real(delam_real), intent(in), contiguous, optional :: coefficients(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. (paired(patterns, coefficients) .and. size(weights) == size(nodes) .and. &
               in_space(self, size(direction)))) then
      call refuse('nodes and weights, patterns and coefficients, direction and space: unequal sizes', status, message)
      return
    end if
    call settle(delam_problem_prescribe_mean(self%handle(), size(nodes, kind=c_int64_t), nodes, weights, direction, &
                                             count_of(patterns), patterns, coefficients, 1_c_int32_t), &
                self, status, message)
  end subroutine problem_prescribe_mean

  ! coefficients: (dimension, nodes); patterns and prescribed, both or neither: (patterns).
  subroutine problem_add_equation(self, nodes, coefficients, patterns, prescribed, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: coefficients(:,:)
    integer(delam_index), intent(in), contiguous, optional :: patterns(:)
    real(delam_real), intent(in), contiguous, optional :: prescribed(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (.not. (paired(patterns, prescribed) .and. size(coefficients, 2) == size(nodes) .and. &
               in_space(self, size(coefficients, 1)))) then
      call refuse('coefficients must be (dimension, nodes), prescribed (patterns)', status, message)
      return
    end if
    call settle(delam_problem_add_equation(self%handle(), size(nodes, kind=c_int64_t), nodes, coefficients, &
                                           count_of(patterns), patterns, prescribed, 1_c_int32_t), self, status, &
                                           message)
  end subroutine problem_add_equation

  ! A problem that does not exist is left to the library.
  function in_space(self, components)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: components
    logical :: in_space
    in_space = .true.
    if (associated(self%it)) in_space = self%it%dimension == components
  end function in_space

  pure function paired(patterns, values)
    integer(delam_index), intent(in), optional :: patterns(:)
    real(delam_real), intent(in), optional :: values(:)
    logical :: paired
    paired = present(patterns) .eqv. present(values)
    if (present(patterns) .and. present(values)) paired = size(patterns) == size(values)
  end function paired

  pure function count_of(patterns) result(count)
    integer(delam_index), intent(in), optional :: patterns(:)
    integer(c_int64_t) :: count
    count = 0
    if (present(patterns)) count = size(patterns)
  end function count_of

  ! periods: (dimension, periods); control_nodes: (periods).
  subroutine problem_add_periodic(self, periods, control_nodes, tolerance, status, message)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in), contiguous :: periods(:,:)
    integer(delam_index), intent(in), contiguous :: control_nodes(:)
    real(delam_real), intent(in), optional :: tolerance
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: distance
    if (size(periods, 2) /= size(control_nodes) .or. .not. in_space(self, size(periods, 1))) then
      call refuse('periods must be (dimension, control nodes)', status, message)
      return
    end if
    distance = 0
    if (present(tolerance)) distance = tolerance
    call settle(delam_problem_add_periodic(self%handle(), size(periods, 2, c_int64_t), periods, control_nodes, &
                                           distance, &
                                           1_c_int32_t), self, status, message)
  end subroutine problem_add_periodic

  ! forces: (dimension, nodes)
  subroutine problem_add_forces(self, pattern, nodes, forces, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    integer(delam_index), intent(in), contiguous :: nodes(:)
    real(delam_real), intent(in), contiguous :: forces(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    if (size(forces, 2) /= size(nodes) .or. .not. in_space(self, size(forces, 1))) then
      call refuse('forces must be (dimension, nodes)', status, message)
      return
    end if
    call settle(delam_problem_add_forces(self%handle(), pattern - 1, size(nodes, kind=c_int64_t), nodes, forces, &
                                         1_c_int32_t), self, status, message)
  end subroutine problem_add_forces

  ! strain: xx, yy, zz, 2xy, 2yz, 2zx
  subroutine problem_add_eigenstrain(self, pattern, strain, body, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    real(delam_real), intent(in) :: strain(6)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_add_eigenstrain(self%handle(), pattern - 1, body_or_all(body), strain), self, status, &
                message)
  end subroutine problem_add_eigenstrain

  subroutine problem_set_number(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_number(self%handle(), zero_ended(key), value), self, status, message)
  end subroutine problem_set_number

  subroutine problem_set_whole(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(in) :: value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_number(self%handle(), zero_ended(key), real(value, c_double)), self, status, message)
  end subroutine problem_set_whole

  subroutine problem_set_text(self, key, value, status, message)
    class(delam_problem), intent(in) :: self
    character(*), intent(in) :: key, value
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_set_text(self%handle(), zero_ended(key), zero_ended(value)), self, status, message)
  end subroutine problem_set_text

  subroutine problem_check(self, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_check(self%handle()), self, status, message)
  end subroutine problem_check

  function problem_hash(self, status, message) result(hash)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    character(16) :: hash
    character(17, kind=c_char) :: digits
    integer(c_int32_t) :: code
    digits = ''
    code = delam_problem_hash(self%handle(), digits)
    hash = digits(:16)
    call settle(code, self, status, message)
  end function problem_hash

  subroutine problem_dofs(self, primal, dual, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(out), optional :: primal, dual
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_dofs(self%handle(), primal, dual), self, status, message)
  end subroutine problem_dofs

  subroutine problem_process_zone(self, interface, length, spacing, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: interface
    real(delam_real), intent(out), optional :: length, spacing
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_problem_process_zone(self%handle(), interface - 1_c_int64_t, length, spacing), self, status, &
                message)
  end subroutine problem_process_zone

  ! Stiffness of a body by rows: those of row r are columns(row_starts(r) : row_starts(r+1)-1).
  subroutine problem_body_matrix(self, body, row_starts, columns, values, status, message)
    class(delam_problem), intent(in) :: self
    integer, intent(in) :: body
    integer(delam_index), allocatable, intent(out) :: row_starts(:), columns(:)
    real(delam_real), allocatable, intent(out) :: values(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, entries
    integer(c_int32_t) :: code
    rows = 0
    entries = 0
    code = delam_problem_body_matrix(self%handle(), body, rows, entries)
    allocate(row_starts(rows + 1), columns(entries), values(entries))
    row_starts = 0
    if (code == DELAM_OK) code = delam_problem_body_matrix(self%handle(), body, rows, entries, row_starts, columns, &
                                                           values)
    row_starts = row_starts + 1
    columns = columns + 1
    call settle(code, self, status, message)
  end subroutine problem_body_matrix

  ! As body_matrix, over the DOFs of the mesh; coefficients: (patterns, rows).
  subroutine problem_constraints(self, row_starts, columns, values, coefficients, status, message)
    class(delam_problem), intent(in) :: self
    integer(delam_index), allocatable, intent(out) :: row_starts(:), columns(:)
    real(delam_real), allocatable, intent(out) :: values(:), coefficients(:,:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, entries, patterns
    integer(c_int32_t) :: code
    rows = 0
    entries = 0
    patterns = 0
    code = delam_problem_constraints(self%handle(), rows, entries, patterns)
    allocate(row_starts(rows + 1), columns(entries), values(entries), coefficients(patterns, rows))
    row_starts = 0
    if (code == DELAM_OK) code = delam_problem_constraints(self%handle(), rows, entries, patterns, row_starts, &
                                                           columns, &
                                                           values, coefficients)
    row_starts = row_starts + 1
    columns = columns + 1
    call settle(code, self, status, message)
  end subroutine problem_constraints

  ! Nodal forces of a pattern at factor 1, (primal DOFs).
  function problem_forces(self, pattern, status, message) result(forces)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: forces(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_dofs(self%handle(), primal=count)
    allocate(forces(count))
    if (code == DELAM_OK) code = delam_problem_forces(self%handle(), pattern - 1, count, forces)
    call settle(code, self, status, message)
  end function problem_forces

  function problem_eigenstrain_energy(self, status, message) result(matrix)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    allocate(matrix(count, count))
    if (code == DELAM_OK) code = delam_problem_eigenstrain_energy(self%handle(), count*count, matrix)
    call settle(code, self, status, message)
  end function problem_eigenstrain_energy

  function problem_factors(self, time, status, message) result(factors)
    class(delam_problem), intent(in) :: self
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: factors(:)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    allocate(factors(count))
    if (code == DELAM_OK) code = delam_problem_factors(self%handle(), time, count, factors)
    call settle(code, self, status, message)
  end function problem_factors

  function problem_pattern_count(self, status, message) result(count)
    class(delam_problem), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_index) :: count
    integer(c_int32_t) :: code
    count = 0
    code = delam_problem_pattern_count(self%handle(), count)
    call settle(code, self, status, message)
  end function problem_pattern_count

  function problem_pattern_name(self, pattern) result(name)
    class(delam_problem), intent(in) :: self
    integer(delam_index), intent(in) :: pattern
    character(:), allocatable :: name
    name = delam_text(delam_problem_pattern_name(self%handle(), pattern - 1))
  end function problem_pattern_name

  ! ---- solver ------------------------------------------------------------------------------------------------------

  subroutine solver_create(self, problem, time, status, message)
    class(delam_solver), intent(inout) :: self
    type(delam_problem), intent(in) :: problem
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(shared), pointer :: made
    integer(c_int32_t) :: code
    allocate(made)
    code = delam_solver_create(problem%handle(), time, made%handle)
    if (c_associated(made%handle)) then
      call adopt(self, made, 'solver', problem%it%context)
      call keep_all(made, problem%it)
    else
      deallocate(made)
    end if
    call settle(code, problem, status, message)
  end subroutine solver_create

  subroutine solver_advance(self, time, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(in) :: time
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_advance(self%handle(), time), self, status, message)
  end subroutine solver_advance

  subroutine solver_commit(self, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_commit(self%handle()), self, status, message)
  end subroutine solver_commit

  subroutine solver_rollback(self, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_rollback(self%handle()), self, status, message)
  end subroutine solver_rollback

  ! adhesion: of all pairs, interface after interface; absent: the committed one.
  subroutine solver_equilibrate(self, time, adhesion, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(in) :: time
    real(delam_real), intent(in), contiguous, optional :: adhesion(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: rows, columns
    rows = 0
    columns = 0
    if (present(adhesion)) then
      if (delam_solver_field_shape(self%handle(), zero_ended('adhesion'), -1_c_int64_t, rows, &
                                   columns) == DELAM_OK .and. &
          size(adhesion) /= rows) then
        call refuse('adhesion must have one value for each pair of all interfaces', status, message)
        return
      end if
    end if
    call settle(delam_solver_equilibrate(self%handle(), time, adhesion), self, status, message)
  end subroutine solver_equilibrate

  function solver_value(self, key, status, message) result(value)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real) :: value
    integer(c_int32_t) :: code
    value = 0
    code = delam_solver_value(self%handle(), zero_ended(key), value)
    call settle(code, self, status, message)
  end function solver_value

  function solver_value_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: values
    integer(c_int32_t) :: code
    values = 0
    code = delam_solver_value_count(self%handle(), values)
    count = int(values)
    call settle(code, self, status, message)
  end function solver_value_count

  function solver_value_name(self, index) result(name)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable :: name
    name = delam_text(delam_solver_value_name(self%handle(), index - 1_c_int64_t))
  end function solver_value_name

  ! The field is (columns, rows). part: an interface, for the fields of pairs; absent: all of them.
  subroutine solver_field_shape(self, key, columns, rows, part, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer(delam_index), intent(out) :: columns, rows
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    columns = 0
    rows = 0
    code = delam_solver_field_shape(self%handle(), zero_ended(key), part_of(part), rows, columns)
    call settle(code, self, status, message)
  end subroutine solver_field_shape

  pure function part_of(part) result(index)
    integer, intent(in), optional :: part
    integer(c_int64_t) :: index
    index = -1
    if (present(part)) index = part - 1
  end function part_of

  function solver_field(self, key, part, status, message) result(values)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: values(:,:)
    integer(c_int64_t) :: rows, columns
    integer(c_int32_t) :: code
    rows = 0
    columns = 0
    code = delam_solver_field_shape(self%handle(), zero_ended(key), part_of(part), rows, columns)
    allocate(values(columns, rows))
    if (code == DELAM_OK) code = delam_solver_field(self%handle(), zero_ended(key), part_of(part), rows*columns, values)
    call settle(code, self, status, message)
  end function solver_field

  ! As field, into an array of the caller.
  subroutine solver_fill_field(self, key, values, part, status, message)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    real(delam_real), intent(inout), contiguous :: values(:,:)
    integer, intent(in), optional :: part
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_field(self%handle(), zero_ended(key), part_of(part), size(values, kind=c_int64_t), &
                                   values), &
                self, status, message)
  end subroutine solver_fill_field

  ! strain, stress: xx, yy, zz, xy, yz, zx
  subroutine solver_average(self, volume, strain, stress, body, status, message)
    class(delam_solver), intent(in) :: self
    real(delam_real), intent(out), optional :: volume, strain(6), stress(6)
    integer, intent(in), optional :: body
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_average(self%handle(), body_or_all(body), volume, strain, stress), self, status, message)
  end subroutine solver_average

  ! Points of front f: starts(f) .. starts(f+1)-1. places, directions: (dimension, points); rates: (3, points).
  subroutine solver_front(self, interface, starts, closed, places, directions, lengths, rates, zone_lengths, &
                          zone_pairs, &
                          status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: interface
    integer(delam_index), allocatable, intent(out) :: starts(:)
    logical, allocatable, intent(out), optional :: closed(:)
    real(delam_real), allocatable, intent(out), optional :: places(:,:), directions(:,:), lengths(:), rates(:,:)
    real(delam_real), allocatable, intent(out), optional :: zone_lengths(:), zone_pairs(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: fronts, points, pairs, dimension
    integer(c_int32_t) :: code
    integer(c_int32_t), allocatable :: loops(:)
    real(delam_real), allocatable :: p(:,:), d(:,:), l(:), r(:,:), zl(:), zp(:)
    fronts = 0
    points = 0
    dimension = 0
    pairs = 0
    code = delam_solver_front_count(self%handle(), interface - 1_c_int64_t, fronts, points)
    if (code == DELAM_OK) code = delam_solver_field_shape(self%handle(), zero_ended('jump'), interface - 1_c_int64_t, &
                                                          pairs, dimension)
    allocate(starts(fronts + 1), loops(fronts))
    starts = 0
    loops = 0
    if (present(places)) allocate(p(dimension, points))
    if (present(directions)) allocate(d(dimension, points))
    if (present(lengths)) allocate(l(points))
    if (present(rates)) allocate(r(3, points))
    if (present(zone_lengths)) allocate(zl(points))
    if (present(zone_pairs)) allocate(zp(points))
    if (code == DELAM_OK) code = delam_solver_front(self%handle(), interface - 1_c_int64_t, fronts, points, starts, &
                                                    loops, &
                                                    p, d, l, r, zl, zp)
    if (present(places)) call move_alloc(p, places)
    if (present(directions)) call move_alloc(d, directions)
    if (present(lengths)) call move_alloc(l, lengths)
    if (present(rates)) call move_alloc(r, rates)
    if (present(zone_lengths)) call move_alloc(zl, zone_lengths)
    if (present(zone_pairs)) call move_alloc(zp, zone_pairs)
    starts = starts + 1
    if (present(closed)) closed = loops == 1
    call settle(code, self, status, message)
  end subroutine solver_front

  ! (patterns, patterns)
  function solver_tangent(self, patterns, status, message) result(matrix)
    class(delam_solver), intent(in) :: self
    integer(delam_index), intent(in) :: patterns
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    real(delam_real), allocatable :: matrix(:,:)
    integer(c_int32_t) :: code
    allocate(matrix(patterns, patterns))
    code = delam_solver_tangent(self%handle(), patterns*patterns, matrix)
    call settle(code, self, status, message)
  end function solver_tangent

  function solver_plan(self) result(text)
    class(delam_solver), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_solver_plan(self%handle()))
  end function solver_plan

  function solver_plan_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: items
    integer(c_int32_t) :: code
    items = 0
    code = delam_solver_plan_count(self%handle(), items)
    count = int(items)
    call settle(code, self, status, message)
  end function solver_plan_count

  subroutine solver_plan_item(self, index, subject, decision, reason, cost, saving, unit, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out), optional :: subject, decision, reason, unit
    real(delam_real), intent(out), optional :: cost, saving
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    type(c_ptr) :: texts(4)
    integer(c_int32_t) :: code
    texts = c_null_ptr
    code = delam_solver_plan_item(self%handle(), index - 1_c_int64_t, texts(1), texts(2), texts(3), cost, saving, &
                                  texts(4))
    if (present(subject)) subject = delam_text(texts(1))
    if (present(decision)) decision = delam_text(texts(2))
    if (present(reason)) reason = delam_text(texts(3))
    if (present(unit)) unit = delam_text(texts(4))
    call settle(code, self, status, message)
  end subroutine solver_plan_item

  ! '' for an unknown key.
  function solver_option(self, key) result(value)
    class(delam_solver), intent(in) :: self
    character(*), intent(in) :: key
    character(:), allocatable :: value
    value = delam_text(delam_solver_option(self%handle(), zero_ended(key)))
  end function solver_option

  function solver_searched(self) result(text)
    class(delam_solver), intent(in) :: self
    character(:), allocatable :: text
    text = delam_text(delam_solver_searched(self%handle()))
  end function solver_searched

  ! -1: back to the pending state, else the committed one.
  subroutine solver_look(self, step, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: step
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_look(self%handle(), int(step, c_int64_t)), self, status, message)
  end subroutine solver_look

  function solver_jump_count(self, status, message) result(count)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer :: count
    integer(c_int64_t) :: jumps
    integer(c_int32_t) :: code
    jumps = 0
    code = delam_solver_jump_count(self%handle(), jumps)
    count = int(jumps)
    call settle(code, self, status, message)
  end function solver_jump_count

  subroutine solver_jump(self, index, step, before, time, stored, dissipated, released, debonded, interface, &
                         first_pair, &
                         last_pair, status, message)
    class(delam_solver), intent(in) :: self
    integer, intent(in) :: index
    integer(delam_index), intent(out), optional :: step
    real(delam_real), intent(out), optional :: before, time, stored, dissipated, released, debonded
    integer(delam_index), intent(out), optional :: interface, first_pair, last_pair
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: code
    if (present(interface)) interface = -1
    if (present(first_pair)) first_pair = -1
    if (present(last_pair)) last_pair = -1
    code = delam_solver_jump(self%handle(), index - 1_c_int64_t, step, before, time, stored, dissipated, released, &
                             debonded, interface, first_pair, last_pair)
    if (present(interface)) interface = interface + 1
    if (present(first_pair)) first_pair = first_pair + 1
    if (present(last_pair)) last_pair = last_pair + 1
    call settle(code, self, status, message)
  end subroutine solver_jump

  ! The committed state; load of a solver of the same scene takes it up again.
  function solver_save(self, status, message) result(bytes)
    class(delam_solver), intent(in) :: self
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(delam_byte), allocatable :: bytes(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    needed = 0
    code = delam_solver_save(self%handle(), 0_c_int64_t, needed=needed)
    allocate(bytes(needed))
    if (code == DELAM_OK) code = delam_solver_save(self%handle(), needed, bytes, needed)
    call settle(code, self, status, message)
  end function solver_save

  subroutine solver_load(self, bytes, status, message)
    class(delam_solver), intent(in) :: self
    integer(delam_byte), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_solver_load(self%handle(), size(bytes, kind=c_int64_t), bytes), self, status, message)
  end subroutine solver_load

end module delam
