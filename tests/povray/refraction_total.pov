// From under water: total reflection beyond the critical angle.
#declare No_camera = 1;
#declare No_floor = 1;
#include "stage.inc"
camera { location <0, -1.5, -4> look_at <0, -.2, 0> angle 70 }
plane { y, 0 pigment { rgbf <.8, .95, 1, .9> } finish { diffuse 0 ambient 0 reflection .1 } interior { ior 1.33 } }
plane { y, -3 pigment { checker rgb .9, rgb .5 } }
sphere { <-1, .8, 1>, .7 pigment { rgb <.9, .3, .2> } }
sphere { <1.2, -1, 1>, .6 pigment { rgb <.9, .8, .2> } }
