// Ground fog; glass is not foggy inside.
#include "stage.inc"
fog { fog_type 2 distance 3 color rgb <.8, .8, .85> fog_offset -.2 fog_alt .4 }
sphere { <-.7, .4, 0>, .7 pigment { rgb <.9, .3, .1> } }
sphere { <1, .4, 0>, .6 pigment { rgbf <1, 1, 1, .9> } interior { ior 1.2 } }
cylinder { <3, -.5, 6>, <3, 4, 6>, .5 pigment { rgb <.2, .6, .3> } }
