// The V of calibration-v.toml with a block under its apex plate, in um, for Gmsh:
//   gmsh meshed-v.geo -3 -format msh41 -o meshed-v.msh
SetFactory("Built-in");
L = 115; w = 20; a = Pi/6; t = 0.6; h = 3.7;  // length, arm, half-angle, thickness, height of the block
d = 4; b = 0.5;                             // set-back of the block's axis, its half-width
c = w/Sin(a);                               // from the inner corner to the point
e = 0.2;                                    // half-width of the blunt point
fine = 1; coarse = 4;                       // edges

Point(1) = {0, (L - c)*Tan(a), -t/2, coarse};
Point(2) = {L - c, 0, -t/2, 4};
Point(3) = {0, -(L - c)*Tan(a), -t/2, coarse};
Point(4) = {0, -L*Tan(a), -t/2, coarse};
Point(5) = {L - e/Tan(a), -e, -t/2, fine};
Point(6) = {L - e/Tan(a), e, -t/2, fine};
Point(7) = {0, L*Tan(a), -t/2, coarse};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
Line(6) = {6, 7}; Line(7) = {7, 1};
Point(11) = {L - d - b, -b, -t/2, fine};
Point(12) = {L - d + b, -b, -t/2, fine};
Point(13) = {L - d + b, b, -t/2, fine};
Point(14) = {L - d - b, b, -t/2, fine};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Curve Loop(2) = {11, 12, 13, 14};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {2};
up1[] = Extrude {0, 0, t} { Surface{1}; Layers{1}; };
up2[] = Extrude {0, 0, t} { Surface{2}; Layers{1}; };
down[] = Extrude {0, 0, -h} { Surface{2}; Layers{4}; };

Physical Volume("lever") = {up1[1], up2[1]};
Physical Volume("tip") = {down[1]};
Physical Surface("face") = {1, 2};
Physical Surface("back") = {up1[0], up2[0]};
Physical Surface("clamp") = {up1[4], up1[8]};
Physical Surface("end") = {down[0]};
Mesh.ElementOrder = 2;
