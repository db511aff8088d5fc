// Blocks of pigments, which have blocks of pigments.
#include "stage.inc"
#declare Small = pigment { checker rgb .1, rgb .9 scale .1 }
#declare Stripes = pigment { gradient <1, 1, 0> color_map { [.5 rgb <.9, .8, .1>] [.5 rgb <.1, .3, .6>] } scale .15 }
box { -.7, .7 rotate <10, 25, 0> translate <-.9, .3, 0> pigment { checker pigment { Small }, pigment { Stripes rotate 20*z } scale .45 } }
sphere { <1, .3, 0>, .7 pigment { hexagon pigment { Small }, pigment { rgb <.8, .2, .2> }, pigment { Stripes } scale .4 } }
