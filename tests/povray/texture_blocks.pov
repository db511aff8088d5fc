// Textures as blocks of a pattern, nested, transformed; defaults; shadows through them.
#include "stage.inc"
#declare Gold = texture { pigment { rgb <.9, .7, .2> } finish { metallic phong .8 reflection .2 } }
#declare Wood = texture { pigment { gradient x color_map { [0 rgb <.5, .3, .1>] [1 rgb <.8, .6, .3>] } scale .1 } }
#declare Clear = texture { pigment { rgbf <.9, .95, 1, .8> } }
box { -.5, .5 texture { checker texture { Gold }, texture { Wood } scale .26 } rotate 30*y translate <-1.5, .1, 0> }
sphere { <-.1, .2, 0>, .6 texture { hexagon texture { Gold } texture { Clear } texture { checker texture { Wood rotate 90*z } texture { Gold } scale .3 } scale .3 rotate 90*x } }
box { <.9, -.4, -.3>, <1.9, .7, .1> texture { brick texture { Gold } texture { Clear } scale .08 } }
