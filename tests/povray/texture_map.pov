// texture_map: textures blended as they look, with highlights, reflection and transparency; waves; declared.
#include "stage.inc"
#declare Mirror = texture { pigment { rgb .1 } finish { reflection .7 phong .8 } }
#declare Red = texture { pigment { rgb <.9, .2, .1> } finish { specular .6 } }
#declare Clear = texture { pigment { rgbf <.8, 1, .8, .9> } finish { diffuse .2 } }
#declare M = texture_map { [.2 Red] [.6 Clear] [.9 Mirror] }
sphere { <-1.4, .2, 0>, .7 texture { gradient y texture_map { M } scale 1.2 translate -.5*y } interior { ior 1.2 } }
box { -.5, .5 texture { planar texture_map { [.3 Red] [.3 Mirror] [1 pigment { rgb <.2, .3, .9> } finish { ambient .3 }] } scale .5 rotate 20*z } rotate 30*y }
cylinder { <1.5, -.5, 0>, <1.5, .9, 0>, .5 texture { radial texture_map { [0 Red] [1 gradient y texture_map { [.5 Mirror] [.5 Clear] } scale .31] } frequency 4 sine_wave translate 1.5*x } }
