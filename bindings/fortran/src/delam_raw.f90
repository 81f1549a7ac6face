! SPDX-License-Identifier: BSD-3-Clause
! Written by bindings/fortran/tools/make_raw.py from include/delam/delam.h: change these, not this file.
! Everything here is as in C: indices from 0, texts end with c_null_char, an absent array is NULL.
module delam_raw
  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, &
                                         c_double
  implicit none
  public

  integer(c_int32_t), parameter :: DELAM_HEADER_ABI = 1
  integer(c_int32_t), parameter :: DELAM_OK = 0
  integer(c_int32_t), parameter :: DELAM_NOT_CONVERGED = 1
  integer(c_int32_t), parameter :: DELAM_CANCELLED = 2
  integer(c_int32_t), parameter :: DELAM_LIMIT = 3
  integer(c_int32_t), parameter :: DELAM_ERROR_ARGUMENT = -1
  integer(c_int32_t), parameter :: DELAM_ERROR_HANDLE = -2
  integer(c_int32_t), parameter :: DELAM_ERROR_MESH = -3
  integer(c_int32_t), parameter :: DELAM_ERROR_PROBLEM = -4
  integer(c_int32_t), parameter :: DELAM_ERROR_STATE = -5
  integer(c_int32_t), parameter :: DELAM_ERROR_MEMORY = -6
  integer(c_int32_t), parameter :: DELAM_ERROR_NUMERICAL = -7
  integer(c_int32_t), parameter :: DELAM_ERROR_SNAPSHOT = -8
  integer(c_int32_t), parameter :: DELAM_ERROR_INTERNAL = -9
  integer(c_int32_t), parameter :: DELAM_ERROR_FILE = -10
  integer(c_int32_t), parameter :: DELAM_TRI3 = 1
  integer(c_int32_t), parameter :: DELAM_QUAD4 = 2
  integer(c_int32_t), parameter :: DELAM_TET4 = 3
  integer(c_int32_t), parameter :: DELAM_HEX8 = 4
  integer(c_int32_t), parameter :: DELAM_TRI6 = 5
  integer(c_int32_t), parameter :: DELAM_QUAD8 = 6
  integer(c_int32_t), parameter :: DELAM_QUAD9 = 7
  integer(c_int32_t), parameter :: DELAM_TET10 = 8
  integer(c_int32_t), parameter :: DELAM_HEX20 = 9
  integer(c_int32_t), parameter :: DELAM_HEX27 = 10
  integer(c_int32_t), parameter :: DELAM_WEDGE6 = 11
  integer(c_int32_t), parameter :: DELAM_PYRAMID5 = 12
  integer(c_int32_t), parameter :: DELAM_WEDGE15 = 13

  ! Signatures of callbacks; pass c_funloc of a bind(c) procedure.
  abstract interface
    subroutine delam_log_callback(level, text, user) bind(c)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int32_t), value :: level
      type(c_ptr), value :: text
      type(c_ptr), value :: user
    end subroutine delam_log_callback
    function delam_progress_callback(stage, done, total, user) bind(c) result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: stage
      integer(c_int64_t), value :: done
      integer(c_int64_t), value :: total
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_progress_callback
    function delam_adhesion_callback(mixity, driving, adhesion, slope, user) bind(c) result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      real(c_double), value :: mixity
      real(c_double), value :: driving
      real(c_double), intent(inout) :: adhesion
      real(c_double), intent(inout) :: slope
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_adhesion_callback
    function delam_dissipation_callback(mixity, adhesion, dissipated, slope, mixity_slope, user) bind(c) &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      real(c_double), value :: mixity
      real(c_double), value :: adhesion
      real(c_double), intent(inout) :: dissipated
      real(c_double), intent(inout) :: slope
      real(c_double), intent(inout) :: mixity_slope
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_dissipation_callback
  end interface

  interface
    function delam_version() bind(c, name="delam_version") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr) :: text
    end function delam_version
    function delam_commit() bind(c, name="delam_commit") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr) :: text
    end function delam_commit
    function delam_abi() bind(c, name="delam_abi") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int32_t) :: status
    end function delam_abi
    function delam_status_name(status) bind(c, name="delam_status_name") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int32_t), value :: status
      type(c_ptr) :: text
    end function delam_status_name
    function delam_blas_threads() bind(c, name="delam_blas_threads") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int32_t) :: status
    end function delam_blas_threads
    function delam_context_create(out) bind(c, name="delam_context_create") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_context_create
    subroutine delam_context_destroy(context) bind(c, name="delam_context_destroy")
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: context
    end subroutine delam_context_destroy
    function delam_context_message(context) bind(c, name="delam_context_message") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      type(c_ptr) :: text
    end function delam_context_message
    function delam_context_set_log(context, callback, user) bind(c, name="delam_context_set_log") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      type(c_funptr), value :: callback
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_context_set_log
    function delam_context_set_progress(context, callback, user) bind(c, name="delam_context_set_progress") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      type(c_funptr), value :: callback
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function delam_context_set_progress
    function delam_context_cancel(context) bind(c, name="delam_context_cancel") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      integer(c_int32_t) :: status
    end function delam_context_cancel
    function delam_cell_type_count() bind(c, name="delam_cell_type_count") result(count_)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t) :: count_
    end function delam_cell_type_count
    function delam_cell_type_info(index, name, cell_type, dimension, nodes, corners, faces, face_nodes, &
        face_corners) bind(c, name="delam_cell_type_info") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: name
      integer(c_int32_t), intent(inout), optional :: cell_type
      integer(c_int32_t), intent(inout), optional :: dimension
      integer(c_int32_t), intent(inout), optional :: nodes
      integer(c_int32_t), intent(inout), optional :: corners
      integer(c_int32_t), intent(inout), optional :: faces
      integer(c_int32_t), intent(inout), optional :: face_nodes
      integer(c_int32_t), intent(inout), optional :: face_corners
      integer(c_int32_t) :: status
    end function delam_cell_type_info
    function delam_cell_type_topology(index, face, middle) bind(c, name="delam_cell_type_topology") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      integer(c_int32_t), intent(inout), optional :: face(*)
      integer(c_int32_t), intent(inout), optional :: middle(*)
      integer(c_int32_t) :: status
    end function delam_cell_type_topology
    function delam_mesh_create(context, dimension, node_count, nodes, out) bind(c, name="delam_mesh_create") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: node_count
      real(c_double), intent(in), optional :: nodes(*)
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_mesh_create
    function delam_mesh_create_layers(context, dimension, lengths, divisions, layer_count, thickness, &
        layer_divisions, cell_type, out) bind(c, name="delam_mesh_create_layers") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      integer(c_int32_t), value :: dimension
      real(c_double), intent(in), optional :: lengths(*)
      integer(c_int64_t), intent(in), optional :: divisions(*)
      integer(c_int64_t), value :: layer_count
      real(c_double), intent(in), optional :: thickness(*)
      integer(c_int64_t), intent(in), optional :: layer_divisions(*)
      integer(c_int32_t), value :: cell_type
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_mesh_create_layers
    function delam_mesh_add_cells(mesh, cell_type, cell_count, connectivity, bodies, index_base) bind(c, &
        name="delam_mesh_add_cells") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: cell_type
      integer(c_int64_t), value :: cell_count
      integer(c_int64_t), intent(in), optional :: connectivity(*)
      integer(c_int32_t), intent(in), optional :: bodies(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_mesh_add_cells
    function delam_mesh_add_conforming_cells(mesh, cell_type, cell_count, connectivity, bodies, index_base) &
        bind(c, name="delam_mesh_add_conforming_cells") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: cell_type
      integer(c_int64_t), value :: cell_count
      integer(c_int64_t), intent(in), optional :: connectivity(*)
      integer(c_int32_t), intent(in), optional :: bodies(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_mesh_add_conforming_cells
    function delam_mesh_add_interface(mesh, body_a, body_b, tolerance, out_interface) bind(c, &
        name="delam_mesh_add_interface") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body_a
      integer(c_int32_t), value :: body_b
      real(c_double), value :: tolerance
      integer(c_int64_t), intent(inout), optional :: out_interface
      integer(c_int32_t) :: status
    end function delam_mesh_add_interface
    function delam_mesh_add_all_interfaces(mesh, tolerance, out_count) bind(c, &
        name="delam_mesh_add_all_interfaces") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      real(c_double), value :: tolerance
      integer(c_int64_t), intent(inout), optional :: out_count
      integer(c_int32_t) :: status
    end function delam_mesh_add_all_interfaces
    function delam_mesh_add_seams(mesh, tolerance, out_count) bind(c, name="delam_mesh_add_seams") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      real(c_double), value :: tolerance
      integer(c_int64_t), intent(inout), optional :: out_count
      integer(c_int32_t) :: status
    end function delam_mesh_add_seams
    function delam_mesh_add_self_contact(mesh, gap, out_count) bind(c, name="delam_mesh_add_self_contact") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      real(c_double), value :: gap
      integer(c_int64_t), intent(inout), optional :: out_count
      integer(c_int32_t) :: status
    end function delam_mesh_add_self_contact
    function delam_mesh_add_projected_interface(mesh, body_a, body_b, gap, out_interface) bind(c, &
        name="delam_mesh_add_projected_interface") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body_a
      integer(c_int32_t), value :: body_b
      real(c_double), value :: gap
      integer(c_int64_t), intent(inout), optional :: out_interface
      integer(c_int32_t) :: status
    end function delam_mesh_add_projected_interface
    function delam_mesh_add_mortar_interface(mesh, body_a, body_b, gap, out_interface) bind(c, &
        name="delam_mesh_add_mortar_interface") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body_a
      integer(c_int32_t), value :: body_b
      real(c_double), value :: gap
      integer(c_int64_t), intent(inout), optional :: out_interface
      integer(c_int32_t) :: status
    end function delam_mesh_add_mortar_interface
    function delam_mesh_add_obstacle(mesh, count, nodes, normals, weights, control_node, index_base, &
        out_interface) bind(c, name="delam_mesh_add_obstacle") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: normals(*)
      real(c_double), intent(in), optional :: weights(*)
      integer(c_int64_t), value :: control_node
      integer(c_int32_t), value :: index_base
      integer(c_int64_t), intent(inout), optional :: out_interface
      integer(c_int32_t) :: status
    end function delam_mesh_add_obstacle
    function delam_mesh_add_host_body(mesh, body, count, nodes, index_base) bind(c, &
        name="delam_mesh_add_host_body") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_mesh_add_host_body
    function delam_mesh_add_pairs(mesh, body_a, body_b, count, nodes_a, nodes_b, normals, weights, face_count, &
        nodes_per_face, faces, index_base, out_interface) bind(c, name="delam_mesh_add_pairs") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body_a
      integer(c_int32_t), value :: body_b
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes_a(*)
      integer(c_int64_t), intent(in), optional :: nodes_b(*)
      real(c_double), intent(in), optional :: normals(*)
      real(c_double), intent(in), optional :: weights(*)
      integer(c_int64_t), value :: face_count
      integer(c_int32_t), value :: nodes_per_face
      integer(c_int64_t), intent(in), optional :: faces(*)
      integer(c_int32_t), value :: index_base
      integer(c_int64_t), intent(inout), optional :: out_interface
      integer(c_int32_t) :: status
    end function delam_mesh_add_pairs
    subroutine delam_mesh_destroy(mesh) bind(c, name="delam_mesh_destroy")
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: mesh
    end subroutine delam_mesh_destroy
    function delam_mesh_size(mesh, dimension, node_count, cell_count, body_count, interface_count) bind(c, &
        name="delam_mesh_size") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout), optional :: dimension
      integer(c_int64_t), intent(inout), optional :: node_count
      integer(c_int64_t), intent(inout), optional :: cell_count
      integer(c_int64_t), intent(inout), optional :: body_count
      integer(c_int64_t), intent(inout), optional :: interface_count
      integer(c_int32_t) :: status
    end function delam_mesh_size
    function delam_mesh_nodes(mesh, capacity, nodes) bind(c, name="delam_mesh_nodes") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: nodes(*)
      integer(c_int32_t) :: status
    end function delam_mesh_nodes
    function delam_mesh_node_bodies(mesh, capacity, bodies) bind(c, name="delam_mesh_node_bodies") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout), optional :: bodies(*)
      integer(c_int32_t) :: status
    end function delam_mesh_node_bodies
    function delam_mesh_node_origins(mesh, capacity, origins) bind(c, name="delam_mesh_node_origins") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: origins(*)
      integer(c_int32_t) :: status
    end function delam_mesh_node_origins
    function delam_mesh_node_ties(mesh, count, entries, nodes, starts, of, weights) bind(c, &
        name="delam_mesh_node_ties") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int64_t), intent(inout), optional :: entries
      integer(c_int64_t), intent(inout), optional :: nodes(*)
      integer(c_int64_t), intent(inout), optional :: starts(*)
      integer(c_int64_t), intent(inout), optional :: of(*)
      real(c_double), intent(inout), optional :: weights(*)
      integer(c_int32_t) :: status
    end function delam_mesh_node_ties
    function delam_mesh_cells(mesh, types, bodies, offsets, capacity, connectivity, needed) bind(c, &
        name="delam_mesh_cells") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout), optional :: types(*)
      integer(c_int32_t), intent(inout), optional :: bodies(*)
      integer(c_int64_t), intent(inout), optional :: offsets(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: connectivity(*)
      integer(c_int64_t), intent(inout), optional :: needed
      integer(c_int32_t) :: status
    end function delam_mesh_cells
    function delam_mesh_interface_size(mesh, interface_index, body_a, body_b, pair_count, face_count, &
        nodes_per_face) bind(c, name="delam_mesh_interface_size") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: interface_index
      integer(c_int32_t), intent(inout), optional :: body_a
      integer(c_int32_t), intent(inout), optional :: body_b
      integer(c_int64_t), intent(inout), optional :: pair_count
      integer(c_int64_t), intent(inout), optional :: face_count
      integer(c_int32_t), intent(inout), optional :: nodes_per_face
      integer(c_int32_t) :: status
    end function delam_mesh_interface_size
    function delam_mesh_interface_pairs(mesh, interface_index, nodes_a, nodes_b, weights, frames) bind(c, &
        name="delam_mesh_interface_pairs") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), intent(inout), optional :: nodes_a(*)
      integer(c_int64_t), intent(inout), optional :: nodes_b(*)
      real(c_double), intent(inout), optional :: weights(*)
      real(c_double), intent(inout), optional :: frames(*)
      integer(c_int32_t) :: status
    end function delam_mesh_interface_pairs
    function delam_mesh_interface_faces(mesh, interface_index, faces) bind(c, name="delam_mesh_interface_faces") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), intent(inout), optional :: faces(*)
      integer(c_int32_t) :: status
    end function delam_mesh_interface_faces
    function delam_mesh_find_nodes(mesh, body, lower, upper, capacity, nodes, count) bind(c, &
        name="delam_mesh_find_nodes") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body
      real(c_double), intent(in), optional :: lower(*)
      real(c_double), intent(in), optional :: upper(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: nodes(*)
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_mesh_find_nodes
    function delam_mesh_find_patch(mesh, body, lower, upper, direction, capacity, nodes, weights, count) bind(c, &
        name="delam_mesh_find_patch") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: body
      real(c_double), intent(in), optional :: lower(*)
      real(c_double), intent(in), optional :: upper(*)
      real(c_double), intent(in), optional :: direction(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout), optional :: nodes(*)
      real(c_double), intent(inout), optional :: weights(*)
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_mesh_find_patch
    function delam_law_create(context, kind, out) bind(c, name="delam_law_create") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: kind(*)
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_law_create
    function delam_law_set(law, key, value) bind(c, name="delam_law_set") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function delam_law_set
    function delam_law_set_text(law, key, value) bind(c, name="delam_law_set_text") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      character(kind=c_char), intent(in) :: key(*)
      character(kind=c_char), intent(in) :: value(*)
      integer(c_int32_t) :: status
    end function delam_law_set_text
    function delam_law_set_table(law, count, xi, s) bind(c, name="delam_law_set_table") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: xi(*)
      real(c_double), intent(in), optional :: s(*)
      integer(c_int32_t) :: status
    end function delam_law_set_table
    function delam_law_parameter_count(kind) bind(c, name="delam_law_parameter_count") result(count_)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      character(kind=c_char), intent(in) :: kind(*)
      integer(c_int64_t) :: count_
    end function delam_law_parameter_count
    function delam_law_parameter_info(kind, index, key, type, unit, initial, range, meaning) bind(c, &
        name="delam_law_parameter_info") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      character(kind=c_char), intent(in) :: kind(*)
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: key
      type(c_ptr), intent(inout), optional :: type
      type(c_ptr), intent(inout), optional :: unit
      type(c_ptr), intent(inout), optional :: initial
      type(c_ptr), intent(inout), optional :: range
      type(c_ptr), intent(inout), optional :: meaning
      integer(c_int32_t) :: status
    end function delam_law_parameter_info
    function delam_law_parameter_bounds(kind, index, lower, upper, lower_open, upper_open) bind(c, &
        name="delam_law_parameter_bounds") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      character(kind=c_char), intent(in) :: kind(*)
      integer(c_int64_t), value :: index
      real(c_double), intent(inout), optional :: lower
      real(c_double), intent(inout), optional :: upper
      integer(c_int32_t), intent(inout), optional :: lower_open
      integer(c_int32_t), intent(inout), optional :: upper_open
      integer(c_int32_t) :: status
    end function delam_law_parameter_bounds
    function delam_law_kind_count() bind(c, name="delam_law_kind_count") result(count_)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t) :: count_
    end function delam_law_kind_count
    function delam_law_kind_info(index, kind, meaning, hosted) bind(c, name="delam_law_kind_info") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: kind
      type(c_ptr), intent(inout), optional :: meaning
      integer(c_int32_t), intent(inout), optional :: hosted
      integer(c_int32_t) :: status
    end function delam_law_kind_info
    function delam_law_create_host(context, name, adhesion, dissipation, user, out) bind(c, &
        name="delam_law_create_host") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: name(*)
      type(c_funptr), value :: adhesion
      type(c_funptr), value :: dissipation
      type(c_ptr), value :: user
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_law_create_host
    function delam_law_check(law) bind(c, name="delam_law_check") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      integer(c_int32_t) :: status
    end function delam_law_check
    function delam_law_toughness(law, count, mixity, onset, toughness) bind(c, name="delam_law_toughness") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: mixity(*)
      real(c_double), intent(inout), optional :: onset(*)
      real(c_double), intent(inout), optional :: toughness(*)
      integer(c_int32_t) :: status
    end function delam_law_toughness
    function delam_law_respond(law, dimension, count, jump, mixity, adhesion_old, adhesion, traction) bind(c, &
        name="delam_law_respond") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: law
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: jump(*)
      real(c_double), intent(in), optional :: mixity(*)
      real(c_double), intent(in), optional :: adhesion_old(*)
      real(c_double), intent(inout), optional :: adhesion(*)
      real(c_double), intent(inout), optional :: traction(*)
      integer(c_int32_t) :: status
    end function delam_law_respond
    subroutine delam_law_destroy(law) bind(c, name="delam_law_destroy")
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: law
    end subroutine delam_law_destroy
    function delam_problem_create(context, mesh, out) bind(c, name="delam_problem_create") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: context
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_problem_create
    subroutine delam_problem_destroy(problem) bind(c, name="delam_problem_destroy")
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: problem
    end subroutine delam_problem_destroy
    function delam_problem_set_plane(problem, assumption) bind(c, name="delam_problem_set_plane") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(in) :: assumption(*)
      integer(c_int32_t) :: status
    end function delam_problem_set_plane
    function delam_problem_set_elastic(problem, body, young, poisson) bind(c, name="delam_problem_set_elastic") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t), value :: body
      real(c_double), value :: young
      real(c_double), value :: poisson
      integer(c_int32_t) :: status
    end function delam_problem_set_elastic
    function delam_problem_set_orthotropic(problem, body, constants) bind(c, &
        name="delam_problem_set_orthotropic") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t), value :: body
      real(c_double), intent(in), optional :: constants(*)
      integer(c_int32_t) :: status
    end function delam_problem_set_orthotropic
    function delam_problem_set_orientation(problem, body, count, cells, axes, index_base) bind(c, &
        name="delam_problem_set_orientation") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t), value :: body
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: cells(*)
      real(c_double), intent(in), optional :: axes(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_set_orientation
    function delam_problem_set_formulation(problem, body, formulation) bind(c, &
        name="delam_problem_set_formulation") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t), value :: body
      character(kind=c_char), intent(in) :: formulation(*)
      integer(c_int32_t) :: status
    end function delam_problem_set_formulation
    function delam_problem_set_stiffness(problem, count, nodes, dofs, row_starts, columns, values, kernel_count, &
        kernel, index_base) bind(c, name="delam_problem_set_stiffness") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      integer(c_int64_t), intent(in), optional :: dofs(*)
      integer(c_int64_t), intent(in), optional :: row_starts(*)
      integer(c_int64_t), intent(in), optional :: columns(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_int64_t), value :: kernel_count
      real(c_double), intent(in), optional :: kernel(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_set_stiffness
    function delam_problem_set_law(problem, interface_index, law) bind(c, name="delam_problem_set_law") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      type(c_ptr), value :: law
      integer(c_int32_t) :: status
    end function delam_problem_set_law
    function delam_problem_set_bonded(problem, interface_index) bind(c, name="delam_problem_set_bonded") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      integer(c_int32_t) :: status
    end function delam_problem_set_bonded
    function delam_problem_set_contact(problem, interface_index) bind(c, name="delam_problem_set_contact") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      integer(c_int32_t) :: status
    end function delam_problem_set_contact
    function delam_problem_set_adhesion(problem, interface_index, count, pairs, adhesion, index_base) bind(c, &
        name="delam_problem_set_adhesion") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: pairs(*)
      real(c_double), intent(in), optional :: adhesion(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_set_adhesion
    function delam_problem_set_adhesion_box(problem, interface_index, lower, upper, adhesion, count) bind(c, &
        name="delam_problem_set_adhesion_box") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      real(c_double), intent(in), optional :: lower(*)
      real(c_double), intent(in), optional :: upper(*)
      real(c_double), value :: adhesion
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_problem_set_adhesion_box
    function delam_problem_add_pattern(problem, name, count, times, values, out_pattern) bind(c, &
        name="delam_problem_add_pattern") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: times(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_int64_t), intent(inout), optional :: out_pattern
      integer(c_int32_t) :: status
    end function delam_problem_add_pattern
    function delam_problem_prescribe_nodes(problem, count, nodes, direction, pattern_count, patterns, &
        coefficients, index_base) bind(c, name="delam_problem_prescribe_nodes") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: direction(*)
      integer(c_int64_t), value :: pattern_count
      integer(c_int64_t), intent(in), optional :: patterns(*)
      real(c_double), intent(in), optional :: coefficients(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_prescribe_nodes
    function delam_problem_prescribe_mean(problem, count, nodes, weights, direction, pattern_count, patterns, &
        coefficients, index_base) bind(c, name="delam_problem_prescribe_mean") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: weights(*)
      real(c_double), intent(in), optional :: direction(*)
      integer(c_int64_t), value :: pattern_count
      integer(c_int64_t), intent(in), optional :: patterns(*)
      real(c_double), intent(in), optional :: coefficients(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_prescribe_mean
    function delam_problem_add_equation(problem, count, nodes, coefficients, pattern_count, patterns, &
        prescribed, index_base) bind(c, name="delam_problem_add_equation") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: coefficients(*)
      integer(c_int64_t), value :: pattern_count
      integer(c_int64_t), intent(in), optional :: patterns(*)
      real(c_double), intent(in), optional :: prescribed(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_add_equation
    function delam_problem_begin_constraints(problem, first, count, time, pattern) bind(c, &
        name="delam_problem_begin_constraints") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: first
      integer(c_int64_t), value :: count
      real(c_double), value :: time
      integer(c_int64_t), value :: pattern
      integer(c_int32_t) :: status
    end function delam_problem_begin_constraints
    function delam_problem_end_constraints(problem, first, count, time, pattern) bind(c, &
        name="delam_problem_end_constraints") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: first
      integer(c_int64_t), value :: count
      real(c_double), value :: time
      integer(c_int64_t), value :: pattern
      integer(c_int32_t) :: status
    end function delam_problem_end_constraints
    function delam_problem_add_periodic(problem, period_count, periods, control_nodes, tolerance, index_base) &
        bind(c, name="delam_problem_add_periodic") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: period_count
      real(c_double), intent(in), optional :: periods(*)
      integer(c_int64_t), intent(in), optional :: control_nodes(*)
      real(c_double), value :: tolerance
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_add_periodic
    function delam_problem_add_forces(problem, pattern, count, nodes, forces, index_base) bind(c, &
        name="delam_problem_add_forces") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: pattern
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: nodes(*)
      real(c_double), intent(in), optional :: forces(*)
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function delam_problem_add_forces
    function delam_problem_add_eigenstrain(problem, pattern, body, strain) bind(c, &
        name="delam_problem_add_eigenstrain") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: pattern
      integer(c_int32_t), value :: body
      real(c_double), intent(in), optional :: strain(*)
      integer(c_int32_t) :: status
    end function delam_problem_add_eigenstrain
    function delam_problem_set_gaps(problem, interface_index, pattern, gaps, adjust) bind(c, &
        name="delam_problem_set_gaps") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), value :: pattern
      real(c_double), intent(in), optional :: gaps(*)
      real(c_double), value :: adjust
      integer(c_int32_t) :: status
    end function delam_problem_set_gaps
    function delam_problem_set_number(problem, key, value) bind(c, name="delam_problem_set_number") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function delam_problem_set_number
    function delam_problem_set_text(problem, key, value) bind(c, name="delam_problem_set_text") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(in) :: key(*)
      character(kind=c_char), intent(in) :: value(*)
      integer(c_int32_t) :: status
    end function delam_problem_set_text
    function delam_option_count() bind(c, name="delam_option_count") result(count_)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t) :: count_
    end function delam_option_count
    function delam_option_info(index, key, type, unit, initial, range, meaning) bind(c, &
        name="delam_option_info") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: key
      type(c_ptr), intent(inout), optional :: type
      type(c_ptr), intent(inout), optional :: unit
      type(c_ptr), intent(inout), optional :: initial
      type(c_ptr), intent(inout), optional :: range
      type(c_ptr), intent(inout), optional :: meaning
      integer(c_int32_t) :: status
    end function delam_option_info
    function delam_option_alias(index, alias) bind(c, name="delam_option_alias") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: alias
      integer(c_int32_t) :: status
    end function delam_option_alias
    function delam_option_bounds(index, lower, upper, lower_open, upper_open) bind(c, &
        name="delam_option_bounds") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      integer(c_int64_t), value :: index
      real(c_double), intent(inout), optional :: lower
      real(c_double), intent(inout), optional :: upper
      integer(c_int32_t), intent(inout), optional :: lower_open
      integer(c_int32_t), intent(inout), optional :: upper_open
      integer(c_int32_t) :: status
    end function delam_option_bounds
    function delam_problem_check(problem) bind(c, name="delam_problem_check") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t) :: status
    end function delam_problem_check
    function delam_problem_hash(problem, out) bind(c, name="delam_problem_hash") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(inout) :: out(*)
      integer(c_int32_t) :: status
    end function delam_problem_hash
    function delam_problem_dofs(problem, primal, dual) bind(c, name="delam_problem_dofs") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), intent(inout), optional :: primal
      integer(c_int64_t), intent(inout), optional :: dual
      integer(c_int32_t) :: status
    end function delam_problem_dofs
    function delam_problem_process_zone(problem, interface_index, length, spacing) bind(c, &
        name="delam_problem_process_zone") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      real(c_double), intent(inout), optional :: length
      real(c_double), intent(inout), optional :: spacing
      integer(c_int32_t) :: status
    end function delam_problem_process_zone
    function delam_problem_propose(problem, interface_index, pairs, stiffness, share, normal_strength, &
        tangential_strength) bind(c, name="delam_problem_propose") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: interface_index
      real(c_double), value :: pairs
      real(c_double), intent(inout), optional :: stiffness
      real(c_double), intent(inout), optional :: share
      real(c_double), intent(inout), optional :: normal_strength
      real(c_double), intent(inout), optional :: tangential_strength
      integer(c_int32_t) :: status
    end function delam_problem_propose
    function delam_problem_body_matrix(problem, body, rows, entries, row_starts, columns, values) bind(c, &
        name="delam_problem_body_matrix") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int32_t), value :: body
      integer(c_int64_t), intent(inout), optional :: rows
      integer(c_int64_t), intent(inout), optional :: entries
      integer(c_int64_t), intent(inout), optional :: row_starts(*)
      integer(c_int64_t), intent(inout), optional :: columns(*)
      real(c_double), intent(inout), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_problem_body_matrix
    function delam_problem_constraints(problem, rows, entries, pattern_count, row_starts, columns, values, &
        coefficients) bind(c, name="delam_problem_constraints") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), intent(inout), optional :: rows
      integer(c_int64_t), intent(inout), optional :: entries
      integer(c_int64_t), intent(inout), optional :: pattern_count
      integer(c_int64_t), intent(inout), optional :: row_starts(*)
      integer(c_int64_t), intent(inout), optional :: columns(*)
      real(c_double), intent(inout), optional :: values(*)
      real(c_double), intent(inout), optional :: coefficients(*)
      integer(c_int32_t) :: status
    end function delam_problem_constraints
    function delam_problem_forces(problem, pattern, capacity, forces) bind(c, name="delam_problem_forces") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: pattern
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: forces(*)
      integer(c_int32_t) :: status
    end function delam_problem_forces
    function delam_problem_eigenstrain_energy(problem, capacity, matrix) bind(c, &
        name="delam_problem_eigenstrain_energy") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: matrix(*)
      integer(c_int32_t) :: status
    end function delam_problem_eigenstrain_energy
    function delam_problem_factors(problem, time, capacity, factors) bind(c, name="delam_problem_factors") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      real(c_double), value :: time
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: factors(*)
      integer(c_int32_t) :: status
    end function delam_problem_factors
    function delam_problem_pattern_count(problem, count) bind(c, name="delam_problem_pattern_count") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_problem_pattern_count
    function delam_problem_pattern_name(problem, pattern) bind(c, name="delam_problem_pattern_name") &
        result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: pattern
      type(c_ptr) :: text
    end function delam_problem_pattern_name
    function delam_problem_option(problem, key) bind(c, name="delam_problem_option") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      character(kind=c_char), intent(in) :: key(*)
      type(c_ptr) :: text
    end function delam_problem_option
    function delam_problem_value_count(problem, count) bind(c, name="delam_problem_value_count") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_problem_value_count
    function delam_problem_value_info(problem, index, key, alias) bind(c, name="delam_problem_value_info") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: key
      type(c_ptr), intent(inout), optional :: alias
      integer(c_int32_t) :: status
    end function delam_problem_value_info
    function delam_problem_plan(problem, plan, setup, memory) bind(c, name="delam_problem_plan") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      type(c_ptr), intent(inout), optional :: plan
      real(c_double), intent(inout), optional :: setup
      real(c_double), intent(inout), optional :: memory
      integer(c_int32_t) :: status
    end function delam_problem_plan
    function delam_solver_create(problem, time, out) bind(c, name="delam_solver_create") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      real(c_double), value :: time
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_solver_create
    function delam_solver_create_like(problem, other, time, out) bind(c, name="delam_solver_create_like") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: problem
      type(c_ptr), value :: other
      real(c_double), value :: time
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function delam_solver_create_like
    function delam_solver_shares_bodies(solver, problem, shares) bind(c, name="delam_solver_shares_bodies") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      type(c_ptr), value :: problem
      integer(c_int32_t), intent(inout), optional :: shares
      integer(c_int32_t) :: status
    end function delam_solver_shares_bodies
    subroutine delam_solver_destroy(solver) bind(c, name="delam_solver_destroy")
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), intent(inout) :: solver
    end subroutine delam_solver_destroy
    function delam_solver_advance(solver, time) bind(c, name="delam_solver_advance") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      real(c_double), value :: time
      integer(c_int32_t) :: status
    end function delam_solver_advance
    function delam_solver_commit(solver) bind(c, name="delam_solver_commit") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int32_t) :: status
    end function delam_solver_commit
    function delam_solver_rollback(solver) bind(c, name="delam_solver_rollback") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int32_t) :: status
    end function delam_solver_rollback
    function delam_solver_pending(solver, pending) bind(c, name="delam_solver_pending") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int32_t), intent(inout), optional :: pending
      integer(c_int32_t) :: status
    end function delam_solver_pending
    function delam_solver_set_history(solver, pattern, count, times, values) bind(c, &
        name="delam_solver_set_history") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: pattern
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: times(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_solver_set_history
    function delam_solver_equilibrate(solver, time, adhesion) bind(c, name="delam_solver_equilibrate") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      real(c_double), value :: time
      real(c_double), intent(in), optional :: adhesion(*)
      integer(c_int32_t) :: status
    end function delam_solver_equilibrate
    function delam_solver_value(solver, key, value) bind(c, name="delam_solver_value") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), intent(inout), optional :: value
      integer(c_int32_t) :: status
    end function delam_solver_value
    function delam_solver_value_count(solver, count) bind(c, name="delam_solver_value_count") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_solver_value_count
    function delam_solver_value_name(solver, index) bind(c, name="delam_solver_value_name") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      type(c_ptr) :: text
    end function delam_solver_value_name
    function delam_solver_value_info(solver, index, alias, unit, cost, scope, meaning, recorded) bind(c, &
        name="delam_solver_value_info") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: alias
      type(c_ptr), intent(inout), optional :: unit
      type(c_ptr), intent(inout), optional :: cost
      type(c_ptr), intent(inout), optional :: scope
      type(c_ptr), intent(inout), optional :: meaning
      integer(c_int32_t), intent(inout), optional :: recorded
      integer(c_int32_t) :: status
    end function delam_solver_value_info
    function delam_solver_record(solver, key) bind(c, name="delam_solver_record") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int32_t) :: status
    end function delam_solver_record
    function delam_solver_recorded_size(solver, first, steps) bind(c, name="delam_solver_recorded_size") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout), optional :: first
      integer(c_int64_t), intent(inout), optional :: steps
      integer(c_int32_t) :: status
    end function delam_solver_recorded_size
    function delam_solver_recorded(solver, key, capacity, values) bind(c, name="delam_solver_recorded") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_solver_recorded
    function delam_solver_field_shape(solver, key, part, rows, columns) bind(c, name="delam_solver_field_shape") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: part
      integer(c_int64_t), intent(inout), optional :: rows
      integer(c_int64_t), intent(inout), optional :: columns
      integer(c_int32_t) :: status
    end function delam_solver_field_shape
    function delam_solver_field(solver, key, part, capacity, values) bind(c, name="delam_solver_field") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: part
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: values(*)
      integer(c_int32_t) :: status
    end function delam_solver_field
    function delam_solver_average(solver, body, volume, strain, stress) bind(c, name="delam_solver_average") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int32_t), value :: body
      real(c_double), intent(inout), optional :: volume
      real(c_double), intent(inout), optional :: strain(*)
      real(c_double), intent(inout), optional :: stress(*)
      integer(c_int32_t) :: status
    end function delam_solver_average
    function delam_solver_front_count(solver, interface_index, fronts, points) bind(c, &
        name="delam_solver_front_count") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), intent(inout), optional :: fronts
      integer(c_int64_t), intent(inout), optional :: points
      integer(c_int32_t) :: status
    end function delam_solver_front_count
    function delam_solver_front(solver, interface_index, front_capacity, point_capacity, starts, closed, places, &
        directions, lengths, rates, zone_lengths, zone_pairs) bind(c, name="delam_solver_front") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: interface_index
      integer(c_int64_t), value :: front_capacity
      integer(c_int64_t), value :: point_capacity
      integer(c_int64_t), intent(inout), optional :: starts(*)
      integer(c_int32_t), intent(inout), optional :: closed(*)
      real(c_double), intent(inout), optional :: places(*)
      real(c_double), intent(inout), optional :: directions(*)
      real(c_double), intent(inout), optional :: lengths(*)
      real(c_double), intent(inout), optional :: rates(*)
      real(c_double), intent(inout), optional :: zone_lengths(*)
      real(c_double), intent(inout), optional :: zone_pairs(*)
      integer(c_int32_t) :: status
    end function delam_solver_front
    function delam_solver_tangent(solver, capacity, matrix) bind(c, name="delam_solver_tangent") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: matrix(*)
      integer(c_int32_t) :: status
    end function delam_solver_tangent
    function delam_solver_step_tangent(solver, capacity, matrix) bind(c, name="delam_solver_step_tangent") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: matrix(*)
      integer(c_int32_t) :: status
    end function delam_solver_step_tangent
    function delam_solver_condensed_size(solver, unknowns, entries) bind(c, name="delam_solver_condensed_size") &
        result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout), optional :: unknowns
      integer(c_int64_t), intent(inout), optional :: entries
      integer(c_int32_t) :: status
    end function delam_solver_condensed_size
    function delam_solver_condensed(solver, capacity, stiffness, load, constant, row_starts, columns, values, &
        offset) bind(c, name="delam_solver_condensed") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: stiffness(*)
      real(c_double), intent(inout), optional :: load(*)
      real(c_double), intent(inout), optional :: constant(*)
      integer(c_int64_t), intent(inout), optional :: row_starts(*)
      integer(c_int64_t), intent(inout), optional :: columns(*)
      real(c_double), intent(inout), optional :: values(*)
      real(c_double), intent(inout), optional :: offset(*)
      integer(c_int32_t) :: status
    end function delam_solver_condensed
    function delam_solver_plan(solver) bind(c, name="delam_solver_plan") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      type(c_ptr) :: text
    end function delam_solver_plan
    function delam_solver_plan_count(solver, count) bind(c, name="delam_solver_plan_count") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_solver_plan_count
    function delam_solver_plan_item(solver, index, subject, decision, reason, cost, saving, unit) bind(c, &
        name="delam_solver_plan_item") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout), optional :: subject
      type(c_ptr), intent(inout), optional :: decision
      type(c_ptr), intent(inout), optional :: reason
      real(c_double), intent(inout), optional :: cost
      real(c_double), intent(inout), optional :: saving
      type(c_ptr), intent(inout), optional :: unit
      integer(c_int32_t) :: status
    end function delam_solver_plan_item
    function delam_solver_option(solver, key) bind(c, name="delam_solver_option") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: key(*)
      type(c_ptr) :: text
    end function delam_solver_option
    function delam_solver_searched(solver) bind(c, name="delam_solver_searched") result(text)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      type(c_ptr) :: text
    end function delam_solver_searched
    function delam_solver_look(solver, step) bind(c, name="delam_solver_look") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: step
      integer(c_int32_t) :: status
    end function delam_solver_look
    function delam_solver_jump_count(solver, count) bind(c, name="delam_solver_jump_count") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t) :: status
    end function delam_solver_jump_count
    function delam_solver_jump(solver, index, step, before, time, stored, dissipated, released, debonded, &
        interface_index, first_pair, last_pair) bind(c, name="delam_solver_jump") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      integer(c_int64_t), intent(inout), optional :: step
      real(c_double), intent(inout), optional :: before
      real(c_double), intent(inout), optional :: time
      real(c_double), intent(inout), optional :: stored
      real(c_double), intent(inout), optional :: dissipated
      real(c_double), intent(inout), optional :: released
      real(c_double), intent(inout), optional :: debonded
      integer(c_int64_t), intent(inout), optional :: interface_index
      integer(c_int64_t), intent(inout), optional :: first_pair
      integer(c_int64_t), intent(inout), optional :: last_pair
      integer(c_int32_t) :: status
    end function delam_solver_jump
    function delam_solver_jump_reactions(solver, index, capacity, before, after) bind(c, &
        name="delam_solver_jump_reactions") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout), optional :: before(*)
      real(c_double), intent(inout), optional :: after(*)
      integer(c_int32_t) :: status
    end function delam_solver_jump_reactions
    function delam_solver_save(solver, capacity, bytes, needed) bind(c, name="delam_solver_save") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: capacity
      integer(c_int8_t), intent(inout), optional :: bytes(*)
      integer(c_int64_t), intent(inout), optional :: needed
      integer(c_int32_t) :: status
    end function delam_solver_save
    function delam_solver_load(solver, size, bytes) bind(c, name="delam_solver_load") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: size
      integer(c_int8_t), intent(in), optional :: bytes(*)
      integer(c_int32_t) :: status
    end function delam_solver_load
    function delam_solver_save_file(solver, path) bind(c, name="delam_solver_save_file") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function delam_solver_save_file
    function delam_solver_load_file(solver, path) bind(c, name="delam_solver_load_file") result(status)
      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function delam_solver_load_file
  end interface
end module delam_raw
