// uv_mapping of spheres, tori and boxes, which have parameters of their own.
#include "stage.inc"
#declare P = pigment { uv_mapping checker rgb <.9, .8, .3>, rgb <.2, .3, .6> scale <1/12, 1/8, 1> }
sphere { 0, .7 pigment { P } rotate <20, 40, 0> translate <-1.5, .2, 0> }
torus { .5, .25 pigment { P } rotate <-40, 20, 0> translate <0, .4, 0> }
box { -.5, .5 pigment { uv_mapping gradient x color_map { [0 rgb x] [.5 rgb y] [1 rgb z] } } rotate <20, 30, 0> translate <1.4, .2, 0> }
