# SPDX-License-Identifier: BSD-3-Clause

"Number and nodes of the cell type of this name, which the library knows."
function cell_type(name)
    known = String[]
    for i in 0:Raw.delam_cell_type_count()-1
        own, number, dimension, nodes = Ref{Cstring}(C_NULL), Ref{Int32}(0), Ref{Int32}(0), Ref{Int32}(0)
        Raw.delam_cell_type_info(i, own, number, dimension, nodes, C_NULL, C_NULL, C_NULL, C_NULL)
        push!(known, unsafe_string(own[]))
        known[end] == name && return (number[], Int64(nodes[]))
    end
    throw(InvalidArgument("cell = \"$name\" is no cell type; known are $(join(known, ", "))"))
end

"""
    Mesh(nodes; context)

Nodes, a column each, of 2 or 3 coordinates; cells are added by type.

    Mesh(; lengths, divisions, thickness, layer_divisions, cell, context)

Layers stacked along the last axis, each a body of its own, 0 at the bottom. `lengths` and `divisions` along the other
axes, a number in 2D; `thickness` and `layer_divisions` of each layer; `cell`: "quad4" or "hex8" unless given.
"""
mutable struct Mesh <: Object
    handle::Ptr{Raw.delam_mesh}
    context::Context

    Mesh(handle::Ptr{Raw.delam_mesh}, context::Context) = finalizer(release, new(handle, context))
end

function Mesh(nodes::AbstractMatrix{<:Real}; context=Context())
    coordinates = floats(nodes)
    handle, _ = made(Raw.delam_mesh, context) do owner, out
        Raw.delam_mesh_create(owner, size(coordinates, 1), size(coordinates, 2), coordinates, out)
    end
    return Mesh(handle, context)
end

function Mesh(; lengths, divisions, thickness, layer_divisions, cell=nothing, context=Context())
    across, count = floats(lengths), indices(divisions)
    expect("divisions", count, length(across))
    layers, layer_count = floats(thickness), indices(layer_divisions)
    expect("layer_divisions", layer_count, length(layers))
    number, _ = cell_type(cell === nothing ? (length(across) == 1 ? "quad4" : "hex8") : cell)
    handle, _ = made(Raw.delam_mesh, context) do owner, out
        Raw.delam_mesh_create_layers(owner, length(across) + 1, across, count, length(layers), layers, layer_count,
            number, out)
    end
    return Mesh(handle, context)
end

# ---- cells

"""
    add_cells!(mesh, cell, connectivity, bodies=0; conforming=false)

Cells of one type, a column each. `bodies`: a label for all, or one each. `conforming`: bodies share nodes, which are
doubled; `node_origins` tells from what. Otherwise a node belongs to one body only.
"""
function add_cells!(mesh::Mesh, cell, connectivity, bodies=0; conforming=false)
    number, rows = cell_type(cell)
    table = indices(connectivity)
    count = size(table, 2)
    expect("connectivity", table, rows, count)
    labels = bodies isa Integer ? fill(Int32(bodies), count) : expect("bodies", convert(Vector{Int32}, bodies), count)
    ask(mesh) do handle
        conforming ? Raw.delam_mesh_add_conforming_cells(handle, number, count, table, labels, 1) :
        Raw.delam_mesh_add_cells(handle, number, count, table, labels, 1)
    end
    return mesh
end

"""
    add_host_body!(mesh, body, nodes)

A body without cells, of nodes that belong to no body yet; its stiffness is given by `set_stiffness!`.
"""
function add_host_body!(mesh::Mesh, body, nodes)
    own = indices(nodes)
    ask(handle -> Raw.delam_mesh_add_host_body(handle, body, length(own), own, 1), mesh)
    return mesh
end

# ---- queries

function mesh_size(mesh::Mesh)
    d, counts = Ref(Int32(0)), [Ref(Int64(0)) for _ in 1:4]
    ask(mesh) do handle
        Raw.delam_mesh_size(handle, d, counts[1], counts[2], counts[3], counts[4])
    end
    return (dimension=Int(d[]), nodes=counts[1][], cells=counts[2][], bodies=counts[3][], interfaces=counts[4][])
end

dimension(mesh::Mesh) = mesh_size(mesh).dimension
node_count(mesh::Mesh) = mesh_size(mesh).nodes
cell_count(mesh::Mesh) = mesh_size(mesh).cells
body_count(mesh::Mesh) = mesh_size(mesh).bodies
interface_count(mesh::Mesh) = mesh_size(mesh).interfaces

function Base.show(io::IO, mesh::Mesh)
    isopen(mesh) || return print(io, "Mesh, closed")
    n = mesh_size(mesh)
    print(io, "Mesh in $(n.dimension)D: $(n.nodes) nodes, $(n.cells) cells, $(n.bodies) bodies, ",
        "$(n.interfaces) interfaces")
end

"Coordinates, (dimension, nodes)."
function nodes(mesh::Mesh)
    n = mesh_size(mesh)
    out = Matrix{Float64}(undef, n.dimension, n.nodes)
    ask(handle -> Raw.delam_mesh_nodes(handle, length(out), out), mesh)
    return out
end

"Body of each node, -1 for one that belongs to no body."
function node_bodies(mesh::Mesh)
    out = Vector{Int32}(undef, node_count(mesh))
    ask(handle -> Raw.delam_mesh_node_bodies(handle, length(out), out), mesh)
    return out
end

"The original of each doubled node (conforming cells); otherwise the node itself."
function node_origins(mesh::Mesh)
    out = Vector{Int64}(undef, node_count(mesh))
    ask(handle -> Raw.delam_mesh_node_origins(handle, length(out), out), mesh)
    return from_one!(out)
end

"""
    node_ties(mesh)

Tied nodes of projected interfaces: u of `nodes[i]` is the sum of `weights[e]` u of `of[e]` over e = `starts[i]` ..
`starts[i+1]-1`.
"""
function node_ties(mesh::Mesh)
    count, entries = Ref(Int64(0)), Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_node_ties(handle, count, entries, C_NULL, C_NULL, C_NULL, C_NULL), mesh)
    tied, starts = Vector{Int64}(undef, count[]), Vector{Int64}(undef, count[] + 1)
    of, shares = Vector{Int64}(undef, entries[]), Vector{Float64}(undef, entries[])
    ask(handle -> Raw.delam_mesh_node_ties(handle, C_NULL, C_NULL, tied, starts, of, shares), mesh)
    return (nodes=from_one!(tied), starts=from_one!(starts), of=from_one!(of), weights=shares)
end

"""
    cells(mesh)

In the order they were added: `types` (numbers of `Delam.CELLS`), `bodies`, and the nodes of cell i,
`connectivity[offsets[i]:offsets[i+1]-1]`.
"""
function cells(mesh::Mesh)
    count, needed = cell_count(mesh), Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_cells(handle, C_NULL, C_NULL, C_NULL, 0, C_NULL, needed), mesh)
    types, bodies = Vector{Int32}(undef, count), Vector{Int32}(undef, count)
    offsets, connectivity = Vector{Int64}(undef, count + 1), Vector{Int64}(undef, needed[])
    ask(mesh) do handle
        Raw.delam_mesh_cells(handle, types, bodies, offsets, length(connectivity), connectivity, C_NULL)
    end
    return (types=types, bodies=bodies, offsets=from_one!(offsets), connectivity=from_one!(connectivity))
end

"Nodes of a body (`nothing`: of all) inside the closed box `lower` .. `upper`, ascending; without `upper`, at a point."
function find_nodes(mesh::Mesh, lower, upper=lower; body=nothing)
    d = dimension(mesh)
    low, high = expect("lower", floats(lower), d), expect("upper", floats(upper), d)
    count = Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_find_nodes(handle, body_label(body), low, high, 0, C_NULL, count), mesh)
    out = Vector{Int64}(undef, count[])
    ask(handle -> Raw.delam_mesh_find_nodes(handle, body_label(body), low, high, length(out), out, count), mesh)
    return from_one!(out)
end

"The one node of a body at a point."
function find_node(mesh::Mesh, place; body=nothing)
    found = find_nodes(mesh, place; body=body)
    length(found) == 1 ||
        throw(InvalidArgument("place = $place: $(length(found)) nodes are there, expected 1"))
    return found[1]
end

"""
    find_patch(mesh, body, lower, upper, direction)

Nodes and weights of a uniform traction on the part of a body's boundary inside the box whose outward normal is within
45 degrees of the direction.
"""
function find_patch(mesh::Mesh, body, lower, upper, direction)
    d = dimension(mesh)
    low, high = expect("lower", floats(lower), d), expect("upper", floats(upper), d)
    normal, count = along("direction", direction, d), Ref(Int64(0))
    ask(mesh) do handle
        Raw.delam_mesh_find_patch(handle, body_label(body), low, high, normal, 0, C_NULL, C_NULL, count)
    end
    found, shares = Vector{Int64}(undef, count[]), Vector{Float64}(undef, count[])
    ask(mesh) do handle
        Raw.delam_mesh_find_patch(handle, body_label(body), low, high, normal, length(found), found, shares, count)
    end
    return from_one!(found), shares
end
