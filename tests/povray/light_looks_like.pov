// looks_like: an object where the light is, which casts no shadow; it moves with the light.
#declare No_light = 1;
#include "stage.inc"
light_source { <-1, 1.5, -1> rgb <.9, .8, .6> looks_like { sphere { 0, .2 pigment { rgb <1, 1, .8> } finish { ambient 1 } } } }
#declare Lamp = light_source { <0, .3, 0> rgb <.3, .4, .7> looks_like { box { -.1, .1 rotate 45*y pigment { rgb <.6, .7, 1> } finish { ambient 1 } } } rotate 20*z }
object { Lamp translate <1.2, .6, -.5> }
sphere { <0, .1, 0>, .5 pigment { rgb .9 } finish { reflection .2 } }
