// spherical, cylindrical, planar, boxed.
#include "stage.inc"
#declare M = color_map { [0 rgb <.1, .2, .5>] [.5 rgb <.9, .5, .2>] [1 rgb 1] }
#declare Cube = box { -.6, .6 }
object { Cube pigment { spherical color_map { M } scale .8 } rotate <10, 30, 0> translate <-1, 0, 0> }
object { Cube pigment { cylindrical color_map { M } scale .8 } rotate <10, 30, 0> translate <.5, 0, 0> }
object { Cube pigment { planar color_map { M } scale .8 } rotate <10, 30, 0> translate <-.4, 1.2, 0> }
object { Cube pigment { boxed color_map { M } scale .8 } rotate <10, 30, 0> translate <1.1, 1.2, 0> }
