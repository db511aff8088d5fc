// Lights in unions and objects move with them; so do declared ones, and what a light looks like.
#declare No_light = 1;
#include "stage.inc"
#declare Lamp = light_source { <0, 1, 0> rgb .7 spotlight point_at <0, 0, 0> radius 20 falloff 30 }
union {
  light_source { <-3, 3, -3> rgb <.6, .5, .4> }
  union { light_source { <0, 2, -4> rgb <.1, .2, .5> area_light x, y, 3, 3 } sphere { <0, 2, -2>, .15 } scale .8 rotate 30*y }
  sphere { <-.7, .2, 0>, .5 }
  pigment { rgb <.9, .8, .7> }
  translate .2*x
}
object { Lamp scale 2 translate <1, 0, -.5> }
box { <.7, -.5, -.5>, <1.3, .2, 0> pigment { rgb <.8, .3, .2> } }
