// A round arch of hexahedra, pyramids, tetrahedra and prisms, for scenes/arch.toml.
// Made again by: gmsh -3 -format msh41 arch.geo -o arch.msh
inner = 1.0;  // radius, m
depth = 0.4;  // radial
width = 0.8;  // along y

// The section of the left foot, meshed with quadrilaterals. The arch turns about the y axis.
Point(1) = {-inner - depth, 0, 0};
Point(2) = {-inner, 0, 0};
Point(3) = {-inner, width, 0};
Point(4) = {-inner - depth, width, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 3} = 4;
Transfinite Curve {2, 4} = 7;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};

// Layers of quadrilaterals: hexahedra.
left[] = Extrude {{0, 1, 0}, {0, 0, 0}, Pi / 3} { Surface{1}; Layers{9}; Recombine; };
// No layers: tetrahedra, and pyramids on the quadrilaterals of the left part.
crown[] = Extrude {{0, 1, 0}, {0, 0, 0}, Pi / 3} { Surface{left[0]}; };
// Layers of triangles: prisms.
right[] = Extrude {{0, 1, 0}, {0, 0, 0}, Pi / 3} { Surface{crown[0]}; Layers{9}; Recombine; };

Physical Volume("left") = {left[1]};
Physical Volume("crown") = {crown[1]};
Physical Volume("right") = {right[1]};
Physical Surface("feet") = {1, right[0]};
Physical Surface("outside") = {left[5], crown[5], right[5]};

Mesh.MeshSizeMin = 0.13;
Mesh.MeshSizeMax = 0.13;
Mesh.Algorithm3D = 1;  // Delaunay: the one that makes pyramids
