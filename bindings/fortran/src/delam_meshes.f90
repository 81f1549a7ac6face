! SPDX-License-Identifier: BSD-3-Clause
! The mesh: nodes, cells, bodies, interfaces.
module delam_meshes
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_associated
  use delam_raw
  use delam_kinds, only: delam_real, delam_index, delam_label
  use delam_objects, only: delam_object, shared, shared_of, adopt, next_owner
  use delam_statuses, only: settle, refuse
  use delam_contexts, only: delam_context
  implicit none
  private
  public :: delam_mesh, dimension_of, pairs_of, body_or_all

  type, extends(delam_object) :: delam_mesh
  contains
    procedure :: create => mesh_create
    procedure :: create_layers => mesh_create_layers
    procedure :: add_cells => mesh_add_cells
    procedure :: add_conforming_cells => mesh_add_conforming_cells
    procedure :: add_interface => mesh_add_interface
    procedure :: add_all_interfaces => mesh_add_all_interfaces
    procedure :: add_seams => mesh_add_seams
    procedure :: add_self_contact => mesh_add_self_contact
    procedure :: add_projected_interface => mesh_add_projected_interface
    procedure :: add_mortar_interface => mesh_add_mortar_interface
    procedure :: add_obstacle => mesh_add_obstacle
    procedure :: add_host_body => mesh_add_host_body
    procedure :: add_pairs => mesh_add_pairs
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

contains

  impure elemental subroutine drop_mesh(self)
    type(delam_mesh), intent(inout) :: self
    call self%destroy()
  end subroutine drop_mesh

  subroutine same_mesh(self, other)
    class(delam_mesh), intent(inout) :: self
    type(delam_mesh), intent(in) :: other
    call next_owner(self, other)
  end subroutine same_mesh

  ! Nodes of a cell, as the library has them; 0 for a number that is no cell type.
  function nodes_of(cell_type) result(nodes)
    integer, intent(in) :: cell_type
    integer(c_int32_t) :: nodes, number
    integer(c_int64_t) :: i
    integer(c_int32_t) :: status
    nodes = 0
    number = 0
    do i = 0, delam_cell_type_count() - 1
      status = delam_cell_type_info(i, cell_type=number, nodes=nodes)
      if (status == DELAM_OK .and. number == cell_type) return
    end do
    nodes = 0
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
      call adopt(self, made, 'mesh', shared_of(context))
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

  ! The library reports unknown cell types by name.
  function fits(cell_type, connectivity, bodies)
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

  ! count: of new interfaces, one for each seam of doubled nodes within a body.
  subroutine mesh_add_seams(self, tolerance, count, status, message)
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
    code = delam_mesh_add_seams(self%handle(), distance, made)
    if (present(count)) count = int(made)
    call settle(code, self, status, message)
  end subroutine mesh_add_seams

  ! count: of new interfaces between walls of a body that face each other, up to gap apart.
  subroutine mesh_add_self_contact(self, gap, count, status, message)
    class(delam_mesh), intent(in) :: self
    real(delam_real), intent(in) :: gap
    integer, intent(out), optional :: count
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made
    integer(c_int32_t) :: code
    made = 0
    code = delam_mesh_add_self_contact(self%handle(), gap, made)
    if (present(count)) count = int(made)
    call settle(code, self, status, message)
  end subroutine mesh_add_self_contact

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

  subroutine mesh_add_mortar_interface(self, body_a, body_b, gap, interface, status, message)
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
    code = delam_mesh_add_mortar_interface(self%handle(), body_a, body_b, distance, made)
    if (present(interface)) interface = int(made) + 1
    call settle(code, self, status, message)
  end subroutine mesh_add_mortar_interface

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

  ! A body without cells, whose stiffness is given by the problem's set_stiffness.
  subroutine mesh_add_host_body(self, body, nodes, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: body
    integer(delam_index), intent(in), contiguous :: nodes(:)
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    call settle(delam_mesh_add_host_body(self%handle(), int(body, c_int32_t), size(nodes, kind=c_int64_t), nodes, &
                                         1_c_int32_t), self, status, message)
  end subroutine mesh_add_host_body

  ! Pairs given by the host. normals: (dimension, pairs), from a to b; faces as pair indices: (nodes per face, faces).
  subroutine mesh_add_pairs(self, body_a, body_b, nodes_a, nodes_b, normals, weights, faces, interface, status, message)
    class(delam_mesh), intent(in) :: self
    integer, intent(in) :: body_a, body_b
    integer(delam_index), intent(in), contiguous :: nodes_a(:), nodes_b(:)
    real(delam_real), intent(in), contiguous :: normals(:,:), weights(:)
    integer(delam_index), intent(in), contiguous, optional :: faces(:,:)
    integer, intent(out), optional :: interface
    integer, intent(out), optional :: status
    character(*), intent(out), optional :: message
    integer(c_int64_t) :: made, face_count
    integer(c_int32_t) :: code, per_face
    if (size(normals, 1) /= dimension_of(self) .or. &
        any([size(nodes_b), size(normals, 2), size(weights)] /= size(nodes_a))) then
      call refuse('normals must be (dimension, pairs), nodes_a, nodes_b and weights (pairs)', status, message)
      return
    end if
    face_count = 0
    per_face = 0
    if (present(faces)) then
      face_count = size(faces, 2, c_int64_t)
      per_face = size(faces, 1, c_int32_t)
    end if
    made = -1
    code = delam_mesh_add_pairs(self%handle(), int(body_a, c_int32_t), int(body_b, c_int32_t), &
                                size(nodes_a, kind=c_int64_t), nodes_a, nodes_b, normals, weights, face_count, &
                                per_face, faces, 1_c_int32_t, made)
    if (present(interface)) interface = int(made) + 1
    call settle(code, self, status, message)
  end subroutine mesh_add_pairs

  ! 0 if the mesh does not exist.
  function dimension_of(self) result(dimension)
    class(delam_mesh), intent(in) :: self
    integer(c_int32_t) :: dimension
    dimension = 0
    if (delam_mesh_size(self%handle(), dimension=dimension) /= DELAM_OK) dimension = 0
  end function dimension_of

  ! Of each interface.
  function pairs_of(self) result(pairs)
    class(delam_mesh), intent(in) :: self
    integer(c_int64_t), allocatable :: pairs(:)
    integer(c_int64_t) :: count, i
    count = 0
    if (delam_mesh_size(self%handle(), interface_count=count) /= DELAM_OK) count = 0
    allocate(pairs(count), source=0_c_int64_t)
    do i = 1, count
      if (delam_mesh_interface_size(self%handle(), i - 1, pair_count=pairs(i)) /= DELAM_OK) pairs(i) = 0
    end do
  end function pairs_of

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

  ! Label of the body of each node; -1 for a node of no body.
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
    ! An unallocated argument is absent for the library. (GNU Fortran 12 does not pass on absent allocatable dummies.)
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

  ! body -1: of all.
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

end module delam_meshes
