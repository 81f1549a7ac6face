# SPDX-License-Identifier: BSD-3-Clause

"An interface of a mesh; may be used wherever a number is expected. Its jump is u_b - u_a, its normals point from
a to b."
struct Interface
    mesh::Mesh
    number::Int64
end

from_zero(interface::Interface) = interface.number - 1

function new_interface(body, mesh)
    out = Ref(Int64(0))
    ask(handle -> body(handle, out), mesh)
    return Interface(mesh, out[] + 1)
end

"Pairs the coinciding faces of two bodies. `tolerance`: a fraction of the shortest edge, 0: 1e-6."
function add_interface!(mesh::Mesh, body_a, body_b; tolerance=0.0)
    new_interface(mesh) do handle, out
        Raw.delam_mesh_add_interface(handle, body_a, body_b, tolerance, out)
    end
end

"Adds an interface between every two bodies that share faces and have none yet; returns the new ones."
function add_all_interfaces!(mesh::Mesh; tolerance=0.0)
    before, count = interface_count(mesh), Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_add_all_interfaces(handle, tolerance, count), mesh)
    return [Interface(mesh, before + i) for i in 1:count[]]
end

"Adds an interface for each seam of doubled nodes within a body; returns the new ones."
function add_seams!(mesh::Mesh; tolerance=0.0)
    before, count = interface_count(mesh), Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_add_seams(handle, tolerance, count), mesh)
    return [Interface(mesh, before + i) for i in 1:count[]]
end

"Adds interfaces between walls of a body that face each other, up to `gap` apart; returns the new ones."
function add_self_contact!(mesh::Mesh, gap)
    before, count = interface_count(mesh), Ref(Int64(0))
    ask(handle -> Raw.delam_mesh_add_self_contact(handle, gap, count), mesh)
    return [Interface(mesh, before + i) for i in 1:count[]]
end

"An interface of two bodies whose meshes do not match; b should be the finer one. `gap`: distance of the faces, 0: 1e-6
of the shortest edge."
function add_projected_interface!(mesh::Mesh, body_a, body_b; gap=0.0)
    new_interface(mesh) do handle, out
        Raw.delam_mesh_add_projected_interface(handle, body_a, body_b, gap, out)
    end
end

"An interface of two bodies whose meshes do not match, either of which may be the finer one. `gap`: distance of the
faces, 0: 1e-6 of the shortest edge."
function add_mortar_interface!(mesh::Mesh, body_a, body_b; gap=0.0)
    new_interface(mesh) do handle, out
        Raw.delam_mesh_add_mortar_interface(handle, body_a, body_b, gap, out)
    end
end

"""
    add_obstacle!(mesh, nodes, normals, control_node; weights=nothing)

A rigid obstacle that moves with its control node, a node of no body. `normals`: from the obstacle into the body, a
column each or one for all.
"""
function add_obstacle!(mesh::Mesh, nodes, normals, control_node; weights=nothing)
    touching, d = indices(nodes), dimension(mesh)
    directions = normals isa AbstractString ? along("normals", normals, d) : normals
    towards = columns("normals", directions, d, length(touching))
    shares = weights === nothing ? C_NULL : expect("weights", floats(weights), length(touching))
    new_interface(mesh) do handle, out
        Raw.delam_mesh_add_obstacle(handle, length(touching), touching, towards, shares, control_node - 1, 1, out)
    end
end

"""
    add_pairs!(mesh, body_a, body_b, nodes_a, nodes_b, normals, weights; faces)

An interface of pairs that the host knows, in the order given. `normals`: from a to b, a column each or one for all;
`faces` (nodes of a face, faces): numbers of pairs, without which there are no fronts.
"""
function add_pairs!(mesh::Mesh, body_a, body_b, nodes_a, nodes_b, normals, weights; faces=Matrix{Int64}(undef, 0, 0))
    first_side, second_side, sides = indices(nodes_a), indices(nodes_b), indices(faces)
    count, d = length(first_side), dimension(mesh)
    expect("nodes_b", second_side, count)
    towards = columns("normals", normals, d, count)
    shares = spread("weights", weights, count)
    new_interface(mesh) do handle, out
        Raw.delam_mesh_add_pairs(handle, body_a, body_b, count, first_side, second_side, towards, shares,
            size(sides, 2), size(sides, 1), sides, 1, out)
    end
end

interfaces(mesh::Mesh) = [Interface(mesh, i) for i in 1:interface_count(mesh)]

function interface_size(interface::Interface)
    body_a, body_b, per_face = Ref(Int32(0)), Ref(Int32(0)), Ref(Int32(0))
    pairs, sides = Ref(Int64(0)), Ref(Int64(0))
    ask(interface.mesh) do handle
        Raw.delam_mesh_interface_size(handle, from_zero(interface), body_a, body_b, pairs, sides, per_face)
    end
    return (body_a=body_a[], body_b=body_b[], pairs=pairs[], faces=sides[], nodes_per_face=Int(per_face[]))
end

"Bodies of the two faces; -1 for an obstacle."
bodies(interface::Interface) = (interface_size(interface).body_a, interface_size(interface).body_b)

pair_count(interface::Interface) = interface_size(interface).pairs

"Nodes of body a, one for each pair."
function nodes_a(interface::Interface)
    out = Vector{Int64}(undef, pair_count(interface))
    ask(interface.mesh) do handle
        Raw.delam_mesh_interface_pairs(handle, from_zero(interface), out, C_NULL, C_NULL, C_NULL)
    end
    return from_one!(out)
end

"Nodes of body b, one for each pair."
function nodes_b(interface::Interface)
    out = Vector{Int64}(undef, pair_count(interface))
    ask(interface.mesh) do handle
        Raw.delam_mesh_interface_pairs(handle, from_zero(interface), C_NULL, out, C_NULL, C_NULL)
    end
    return from_one!(out)
end

"Length (2D) or area (3D) of each pair."
function weights(interface::Interface)
    out = Vector{Float64}(undef, pair_count(interface))
    ask(interface.mesh) do handle
        Raw.delam_mesh_interface_pairs(handle, from_zero(interface), C_NULL, C_NULL, out, C_NULL)
    end
    return out
end

"(dimension, dimension, pairs): of each pair the columns normal, tangent(s)."
function frames(interface::Interface)
    d = dimension(interface.mesh)
    out = Array{Float64}(undef, d, d, pair_count(interface))
    ask(interface.mesh) do handle
        Raw.delam_mesh_interface_pairs(handle, from_zero(interface), C_NULL, C_NULL, C_NULL, out)
    end
    return out
end

"(dimension, pairs): positions of the nodes of body b."
places(interface::Interface) = nodes(interface.mesh)[:, nodes_b(interface)]

"(nodes of a face, faces), as numbers of pairs."
function faces(interface::Interface)
    n = interface_size(interface)
    out = Matrix{Int64}(undef, n.nodes_per_face, n.faces)
    ask(handle -> Raw.delam_mesh_interface_faces(handle, from_zero(interface), out), interface.mesh)
    return from_one!(out)
end

Base.show(io::IO, interface::Interface) =
    print(io, "Interface $(interface.number) of bodies $(join(bodies(interface), " and ")), ",
        "$(pair_count(interface)) pairs")
