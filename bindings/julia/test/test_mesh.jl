# SPDX-License-Identifier: BSD-3-Clause

@testset "mesh" begin
    mesh = Mesh(lengths=2.0, divisions=2, thickness=[1.0, 1.0], layer_divisions=[1, 1])
    glue = add_interface!(mesh, 0, 1)
    @test dimension(mesh) == 2
    @test node_count(mesh) == 12 && cell_count(mesh) == 4 && body_count(mesh) == 2
    @test size(nodes(mesh)) == (2, 12)
    @test nodes(mesh)[:, find_node(mesh, (2, 2))] == [2.0, 2.0]
    @test glue.number == 1 && length(interfaces(mesh)) == 1

    # Indices count from 1, in and out.
    @test pair_count(glue) == 3
    @test places(glue) == nodes(mesh)[:, nodes_a(glue)] == [0.0 1.0 2.0; 1.0 1.0 1.0]
    @test node_bodies(mesh)[nodes_b(glue)] == [1, 1, 1]
    @test weights(glue) == [0.5, 1.0, 0.5]
    @test frames(glue)[:, 1, 2] == [0.0, 1.0]
    @test sort(vec(faces(glue))) == [1, 2, 2, 3]
    table = cells(mesh)
    @test table.offsets == [1, 5, 9, 13, 17]
    @test extrema(table.connectivity) == (1, 12)
    found, shares = find_patch(mesh, 1, (0.0, 2.0), (1.0, 2.0), "y")
    @test sum(shares) == 1.0 && all(==(2.0), nodes(mesh)[2, found])

    # Cells by hand, of bodies that share nodes.
    square = Mesh([0.0 1.0 0.0 1.0 0.0 1.0; 0.0 0.0 1.0 1.0 2.0 2.0])
    add_cells!(square, "quad4", [1 3; 2 4; 4 6; 3 5], [0, 1]; conforming=true)
    @test node_count(square) == 8
    @test node_origins(square) == [1, 2, 3, 4, 5, 6, 3, 4]
    @test length(add_all_interfaces!(square)) == 1

    # A row of two cells on another, with a node of its own on the left: node 5 is the tip, 10 is that of 4.
    slit = Mesh([0.0 1.0 2.0 0.0 1.0 2.0 0.0 1.0 2.0 0.0; 0.0 0.0 0.0 1.0 1.0 1.0 2.0 2.0 2.0 1.0])
    add_cells!(slit, "quad4", [1 2 10 5; 2 3 5 6; 5 6 8 9; 4 5 7 8], 0)
    (seam,) = add_seams!(slit)
    @test nodes_a(seam) == [4] && nodes_b(seam) == [10]
    @test isempty(add_seams!(slit))

    # Three rows of four cells, without the last two of the middle row: the walls of this slot are 1 apart.
    slot = Mesh(Float64[k == 1 ? i % 5 : i ÷ 5 for k in 1:2, i in 0:19])
    corners = [1, 2, 3, 4, 6, 7, 11, 12, 13, 14]
    add_cells!(slot, "quad4", [n + shift for shift in (0, 1, 6, 5), n in corners], 0)
    @test isempty(add_self_contact!(slot, 0.5))
    (walls,) = add_self_contact!(slot, 1.1)
    @test all(==(0), node_bodies(slot)[nodes_b(walls)]) && all(==(0), node_bodies(slot)[node_ties(slot).of])
    @test_throws InvalidArgument add_self_contact!(slot, 0.0)

    # Errors have the library's words and leave the object as it was.
    @test_throws InvalidArgument add_interface!(mesh, 0, 7)
    @test_throws DimensionMismatch add_cells!(square, "tri3", [1 3; 2 4], 0)
    @test_throws InvalidArgument find_node(mesh, (0.1, 0.1))
    @test interface_count(mesh) == 1
    close(mesh)
    @test !isopen(mesh)
    @test_throws InvalidHandle node_count(mesh)
end
