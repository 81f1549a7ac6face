// SPDX-License-Identifier: BSD-3-Clause
// The double cantilever beam of this folder for Gmsh, cut into parts of which each process reads its own:
//
//     gmsh -3 -setnumber cells 30 -part 4 -part_split -format msh22 beam.geo        writes beam_1.msh .. beam_4.msh
//
// The arms have nodes of their own at the interface: they are boxes that share nothing.
SetFactory("OpenCASCADE");
DefineConstant[ cells = 30 ];  // along the beam
length = 45e-3; width = 9e-3; height = 1.5e-3;
across = 3; upwards = 2;
slack = 1e-6;

For arm In {0:1}
  Box(arm + 1) = {0, 0, arm * height, length, width, height};
EndFor
// Curves along the beam, across it, and upwards.
For level In {0:2}
  z = level * height;
  For side In {0:1}
    y = side * width;
    lines[] = Curve In BoundingBox{-slack, y - slack, z - slack, length + slack, y + slack, z + slack};
    Transfinite Curve{lines[]} = cells + 1;
    x = side * length;
    lines[] = Curve In BoundingBox{x - slack, -slack, z - slack, x + slack, width + slack, z + slack};
    Transfinite Curve{lines[]} = across + 1;
  EndFor
EndFor
For arm In {0:1}
  For corner In {0:3}
    x = (corner % 2) * length;
    y = (corner > 1) * width;
    z = arm * height;
    lines[] = Curve In BoundingBox{x - slack, y - slack, z - slack, x + slack, y + slack, z + height + slack};
    Transfinite Curve{lines[]} = upwards + 1;
  EndFor
EndFor
Transfinite Surface{:};
Recombine Surface{:};
Transfinite Volume{:};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
