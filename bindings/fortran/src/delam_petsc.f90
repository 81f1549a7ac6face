! SPDX-License-Identifier: BSD-3-Clause
! The functions of include/delam/petsc.h, as in C: indices from 0, texts end with c_null_char, an absent array is NULL.
! `use delam_petsc` goes with `use delam`: a handle of libdelam-petsc is a type(c_ptr), and a problem goes to
! delam_petsc_attach as problem%handle() on rank 0, c_null_ptr on the others.
module delam_petsc
  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_char, c_int, c_int8_t, c_int32_t, &
                                         c_int64_t, c_double
  implicit none
  private
  public :: delam_petsc_create, delam_petsc_destroy, delam_petsc_message, delam_petsc_set_part, &
            delam_petsc_take_scene, delam_petsc_take_cells, delam_petsc_set_rows, delam_petsc_set_cells, &
            delam_petsc_attach, delam_petsc_run, delam_petsc_set_task, delam_petsc_everywhere, delam_petsc_explain, &
            delam_petsc_recover, delam_petsc_part_nodes, delam_petsc_part_cells, delam_petsc_part_field, &
            delam_petsc_value

  ! Signature of `work`; pass c_funloc of such a procedure.
  abstract interface
    function delam_petsc_work(user) bind(c) result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_petsc_work
  end interface
  public :: delam_petsc_work

  ! Signature of `task`, likewise. bytes: an array of c_int8_t, of `size` elements (c_f_pointer).
  abstract interface
    function delam_petsc_task(size, bytes, user) bind(c) result(status)
      import :: c_ptr, c_int32_t, c_int64_t
      integer(c_int64_t), value :: size
      type(c_ptr), value :: bytes, user
      integer(c_int32_t) :: status
    end function delam_petsc_task
  end interface
  public :: delam_petsc_task

  interface
    ! comm: the integer of the module mpi, or comm%mpi_val of mpi_f08.
    function delam_petsc_create(comm, out) bind(c, name="delam_petsc_create_fortran") result(status)
      import :: c_ptr, c_int, c_int32_t
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_petsc_create
    subroutine delam_petsc_destroy(petsc) bind(c, name="delam_petsc_destroy")
      import :: c_ptr
      type(c_ptr), intent(inout) :: petsc
    end subroutine delam_petsc_destroy
    function delam_petsc_message(petsc) bind(c, name="delam_petsc_message") result(text)
      import :: c_ptr
      type(c_ptr), value :: petsc
      type(c_ptr) :: text
    end function delam_petsc_message
    function delam_petsc_set_part(petsc, dimension, node_count, nodes, coordinates, row_starts, columns, values) &
        bind(c, name="delam_petsc_set_part") result(status)
      import :: c_ptr, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: petsc
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: node_count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: coordinates(*)
      integer(c_int64_t), intent(in), optional :: row_starts(*), columns(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_petsc_set_part
    function delam_petsc_take_scene(petsc, mesh, problem) bind(c, name="delam_petsc_take_scene") result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: petsc, mesh, problem
      integer(c_int32_t) :: status
    end function delam_petsc_take_scene
    function delam_petsc_take_cells(petsc, mesh, problem, cell_count, ranks) &
        bind(c, name="delam_petsc_take_cells") result(status)
      import :: c_ptr, c_int32_t, c_int64_t
      type(c_ptr), value :: petsc, mesh, problem
      integer(c_int64_t), value :: cell_count
      integer(c_int32_t), intent(in), optional :: ranks(*)
      integer(c_int32_t) :: status
    end function delam_petsc_take_cells
    function delam_petsc_set_rows(petsc, dimension, node_count, nodes, coordinates, row_starts, columns, values) &
        bind(c, name="delam_petsc_set_rows") result(status)
      import :: c_ptr, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: petsc
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: node_count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: coordinates(*)
      integer(c_int64_t), intent(in), optional :: row_starts(*), columns(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_petsc_set_rows
    function delam_petsc_set_cells(petsc, mesh, problem, node_count, nodes) &
        bind(c, name="delam_petsc_set_cells") result(status)
      import :: c_ptr, c_int32_t, c_int64_t
      type(c_ptr), value :: petsc, mesh, problem
      integer(c_int64_t), value :: node_count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      integer(c_int32_t) :: status
    end function delam_petsc_set_cells
    function delam_petsc_attach(petsc, problem) bind(c, name="delam_petsc_attach") result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: petsc, problem
      integer(c_int32_t) :: status
    end function delam_petsc_attach
    function delam_petsc_run(petsc, work, user) bind(c, name="delam_petsc_run") result(status)
      import :: c_ptr, c_funptr, c_int32_t
      type(c_ptr), value :: petsc
      type(c_funptr), value :: work
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_petsc_run
    function delam_petsc_set_task(petsc, task, user) bind(c, name="delam_petsc_set_task") result(status)
      import :: c_ptr, c_funptr, c_int32_t
      type(c_ptr), value :: petsc
      type(c_funptr), value :: task
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_petsc_set_task
    function delam_petsc_everywhere(petsc, size, bytes) bind(c, name="delam_petsc_everywhere") result(status)
      import :: c_ptr, c_int8_t, c_int32_t, c_int64_t
      type(c_ptr), value :: petsc
      integer(c_int64_t), value :: size
      integer(c_int8_t), intent(in), optional :: bytes(*)
      integer(c_int32_t) :: status
    end function delam_petsc_everywhere
    function delam_petsc_explain(petsc, text) bind(c, name="delam_petsc_explain") result(status)
      import :: c_ptr, c_char, c_int32_t
      type(c_ptr), value :: petsc
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int32_t) :: status
    end function delam_petsc_explain
    function delam_petsc_recover(petsc, solver) bind(c, name="delam_petsc_recover") result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: petsc, solver   ! solver%handle()
      integer(c_int32_t) :: status
    end function delam_petsc_recover
    function delam_petsc_part_nodes(petsc, capacity, nodes, owned, count) &
        bind(c, name="delam_petsc_part_nodes") result(status)
      import :: c_ptr, c_int32_t, c_int64_t
      type(c_ptr), value :: petsc
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: nodes(*)
      integer(c_int32_t), intent(inout), optional :: owned(*)
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_petsc_part_nodes
    function delam_petsc_part_cells(petsc, capacity, cells, count) bind(c, name="delam_petsc_part_cells") result(status)
      import :: c_ptr, c_int32_t, c_int64_t
      type(c_ptr), value :: petsc
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: cells(*), count
      integer(c_int32_t) :: status
    end function delam_petsc_part_cells
    function delam_petsc_part_field(petsc, key, capacity, values, rows, columns) &
        bind(c, name="delam_petsc_part_field") result(status)
      import :: c_ptr, c_char, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: petsc
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: values(*)
      integer(c_int64_t), intent(inout), optional :: rows, columns
      integer(c_int32_t) :: status
    end function delam_petsc_part_field
    function delam_petsc_value(petsc, key, value) bind(c, name="delam_petsc_value") result(status)
      import :: c_ptr, c_char, c_int32_t, c_double
      type(c_ptr), value :: petsc
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), intent(inout), optional :: value
      integer(c_int32_t) :: status
    end function delam_petsc_value
  end interface
end module delam_petsc
