// The unit cube of quadratic hexahedra, with its face z = 0 as boundary:
//   gmsh -3 -format msh4 quadratic_hexahedra.geo
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Point(1) = {0, 0, 0, 1};
Point(2) = {1, 0, 0, 1};
Point(3) = {1, 1, 0, 1};
Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 2;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Physical Volume("box") = {out[1]};
Physical Surface("base") = {1};
