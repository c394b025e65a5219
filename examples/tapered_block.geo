// A tread block that widens towards its base, with rounded edges at the road. In mm, y upwards, the
// road at y = 0; the line "top" is held by the platen. Quadrilaterals only:
//
//     gmsh -2 -format msh22 tapered_block.geo -o tapered_block.msh
length = 20;      // along the road, between the corners before they are rounded
height = 8;
draft = 8 * Pi / 180;  // of the flanks to the vertical
radius = 0.5;     // of the edges
edge = 0.12;      // cells at the edges, at the middle of the road, and at the platen
middle = 0.7;
platen = 1.2;

// An arc touches road and flank at this distance from the corner.
t = radius * Tan(Pi / 4 - draft / 2);
Macro Half
  // side = -1: trailing half, 1: leading half, seen from the middle of the block
  x = 0.5 * length * (1 + side);
  Point(n + 1) = {x - side * t, 0, 0, edge};
  Point(n + 2) = {x - side * t, radius, 0, edge};
  Point(n + 3) = {x + side * t * Sin(draft), t * Cos(draft), 0, edge};
  Point(n + 4) = {x + side * height * Tan(draft), height, 0, platen};
  Circle(n + 1) = {n + 1, n + 2, n + 3};
  Line(n + 2) = {n + 3, n + 4};
Return
side = 1;
n = 10;
Call Half;
side = -1;
n = 20;
Call Half;
Point(1) = {0.5 * length, 0, 0, middle};
Line(1) = {21, 1};
Line(2) = {1, 11};
Line(3) = {14, 24};
Curve Loop(1) = {1, 2, 11, 12, 3, -22, -21};
Plane Surface(1) = {1};
Recombine Surface {1};
Mesh.Algorithm = 8;
Mesh.RecombinationAlgorithm = 2;
Physical Line("top") = {3};
Physical Surface("rubber") = {1};
