// onion and leopard.
#include "stage.inc"
box { -.6, .6 rotate 20*y translate <-1.3, .1, 0> pigment { onion color_map { [0 rgb .1] [.5 rgb <.9, .6, .2>] [1 rgb 1] } scale .25 } }
box { -.6, .6 rotate -10*y translate <.9, .2, 0> pigment { leopard color_map { [0 rgb <.9, .7, .2>] [.3 rgb .1] [1 rgb 1] } scale .06 } }
