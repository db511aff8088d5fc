// interior_texture: what is seen from inside.
#include "stage.inc"
cylinder { <-1.2, -.4, 0>, <-.9, .8, -.4>, .6 open pigment { rgb <.9, .2, .2> } interior_texture { pigment { checker rgb .9, rgb .2 scale .2 } finish { ambient .3 } } }
cone { <1, -.4, 0>, .3, <1.1, .8, -.3>, .7 open texture { pigment { rgb <.2, .4, .9> } } interior_texture { pigment { gradient y color_map { [0 rgb y] [1 rgb 1] } scale .3 } } }
disc { <.1, 1.6, .5>, <0, 1, .3>, .6 pigment { rgb x } interior_texture { pigment { rgb <.9, .9, .1> } } }
