// Expressions: a part is missing, or of the wrong kind.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare A = 1 + ;
#declare B = (1 + 2;
#declare C = <1, 2, "three">;
#declare D = 5
#declare E = sqrt(-1);
#declare F = min(1, <1, 2>);
#declare G = array[3] { 1, 2 }
#declare H = array[2] { 1, 2 }
#declare I = H[2];
#declare J = "a" * 2;
#declare K = rgb 1 + rgb 1;
#declare L = 1e999;
#declare M = x.filter;
sphere { <1, 2, 3, 4>, 1 }
sphere { 0, y }
sphere { 0, 1 pigment { color rgb "red" } }
plane { y, -1 pigment { 1 } }
