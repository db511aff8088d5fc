// Unions: textures of parts and of the whole, transformations of both, unions in unions.
#include "stage.inc"
#declare Pair = union {
  sphere { -.3*x, .4 pigment { rgb <.9, .2, .2> } }
  box { <.1, -.3, -.3>, <.7, .3, .3> rotate 20*y }
  rotate 10*z
}
object { Pair translate <-1.4, .2, 0> pigment { checker rgb <.2, .8, .2>, rgb 1 scale .2 } }
union {
  object { Pair scale .7 }
  object { Pair scale .5 translate .8*y texture { pigment { rgb <.9, .8, .1> } } }
  pigment { gradient x color_map { [0 rgb 1] [1 rgb <.2, .3, .9>] } scale .3 }
  rotate -20*y translate <.7, .1, -.3>
}
