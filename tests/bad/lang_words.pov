// Words: unknown, unsupported, in the wrong place.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Radius = 2;
#declare Rouge = rgb <1, 0, 0>;

sphre { 0, Radius }
sphere { 0, Raduis }
sphere { 0, Radius pigment { color Rogue } }
sphere { 0, Radius Rouge }
sphere { 0, sphere }
isosurface { function { x } }
sphere { 0, 1 pigment { granite } }
media { scattering { 1, 1 } }
sphere <0, 0, 0>, 1 }
Qwertyuiop { 1 }
