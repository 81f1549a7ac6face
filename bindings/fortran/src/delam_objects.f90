! SPDX-License-Identifier: BSD-3-Clause
! Ownership of handles. Only delam_object is for hosts.
module delam_objects
  use, intrinsic :: iso_c_binding, only: c_ptr, c_int64_t, c_null_ptr
  use delam_raw
  use delam_callbacks, only: delam_observer, delam_host_law
  implicit none
  private
  public :: delam_object, shared, shared_of, adopt, keep, keep_all, next_owner

  ! Shared by all names of an object: the handle, and the data that must outlive it.
  type :: keeper
    type(shared), pointer :: it => null()
  end type keeper
  type :: shared
    type(c_ptr) :: handle = c_null_ptr
    character(7) :: kind = ''
    integer :: owners = 1
    integer :: dimension = 0   ! of a problem's mesh
    integer(c_int64_t), allocatable :: pairs(:)   ! of each interface of a problem's mesh
    integer(c_int64_t) :: patterns = 0   ! of a solver's problem, when it was made
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

contains

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

  ! `self` releases its handle and takes a new one, whose context is kept alive.
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

  ! For the other modules; hosts have handle().
  function shared_of(object) result(it)
    class(delam_object), intent(in) :: object
    type(shared), pointer :: it
    it => object%it
  end function shared_of

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

  ! Releases this name of the object before it leaves its scope.
  subroutine object_destroy(self)
    class(delam_object), intent(inout) :: self
    call release(self%it)
  end subroutine object_destroy

end module delam_objects
