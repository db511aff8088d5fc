// material: texture and interior under one name, transformed, changed, with an interior_texture.
#include "stage.inc"
#declare M = material {
  texture { pigment { rgbf <.95, .9, .9, .9> } finish { reflection .1 phong .6 } }
  interior { ior 1.4 fade_distance .6 fade_power 1 fade_color rgb <.9, .5, .3> }
}
#declare Striped = material { texture { pigment { gradient y color_map { [.5 rgb .9] [.5 rgb <.2, .4, .8>] } scale .2 } } rotate 30*z }
sphere { <-1.4, .2, 0>, .6 material { M } }
box { -.5, .5 material { Striped } rotate 30*y translate <-.1, .1, 0> }
cylinder { <1.3, -.5, 0>, <1.3, .8, -.3>, .5 open material { Striped interior_texture { pigment { rgb <.9, .8, .1> } } } }
