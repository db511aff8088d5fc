// Interiors within and across each other, and a camera that begins inside of one.
#declare No_camera = 1;
#include "stage.inc"
camera { location <0, .6, -4> look_at <0, .3, 0> angle 50 }
#declare T = texture { pigment { rgbf <.9, .95, .9, .9> } finish { diffuse .1 reflection .05 } }
sphere { <0, .6, -4>, 1.5 texture { T } interior { ior 1.1 } }
sphere { <-.7, .3, 0>, .7 texture { T } interior { ior 1.4 } }
sphere { <-.1, .3, .2>, .7 texture { T } interior { ior 1.2 fade_distance 1 fade_power 1 } }
sphere { <1.3, .3, .2>, .6 texture { T } }
