// map_type 1, 2 and 5: round a sphere, a cylinder, a torus.
#include "stage.inc"
sphere { 0, .7 pigment { image_map { png "picture.png" map_type 1 } } rotate <20, 50, 10> translate <-1.4, .3, 0> }
cylinder { 0, y, .5 pigment { image_map { png "picture.png" map_type 2 interpolate 2 } scale <1, .8, 1> } rotate 130*y translate <0, -.3, 0> }
torus { .5, .25 pigment { image_map { png "picture.png" map_type 5 } scale .5 } rotate <-50, 20, 0> translate <1.3, .3, 0> }
box { -.3, .3 pigment { image_map { png "picture.png" map_type 1 interpolate 2 } } rotate 30*y translate <.3, 1.5, .5> }
torus { .25, .1 pigment { image_map { png "picture.png" map_type 2 once } scale .1 } rotate -50*x translate <1.3, 1.4, 0> }
