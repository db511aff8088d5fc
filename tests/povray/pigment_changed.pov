// A pigment that changes a declared one, a texture's or the object's.
#include "stage.inc"
#declare P = pigment { gradient x color_map { [0 rgb x] [1 rgb y] } scale .3 }
#declare T = texture { pigment { P } finish { phong .8 } }
sphere { <-1.5, .1, 0>, .6 pigment { P scale .5 } }
sphere { <0, .1, 0>, .6 texture { T pigment { rgb <.2, .3, .9> } } }
sphere { <1.5, .1, 0>, .6 texture { T } pigment { rotate 45*z } }
object { sphere { <.6, 1.3, 0>, .5 pigment { rgb x } } pigment { rgb <.9, .8, .2> } }
