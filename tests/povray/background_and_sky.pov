// sky_sphere with two pigments, transformed, over a background; seen in a mirror too.
#declare No_floor = 1;
#include "stage.inc"
sky_sphere {
  pigment { gradient y color_map { [0 rgb <.8, .85, .9>] [.4 rgb <.3, .5, .9>] [1 rgb <.1, .2, .6>] } scale 2 translate -1 }
  pigment { checker rgbt 1, rgbt <1, .9, .6, .5> scale .3 }
  rotate <10, 30, 5>
}
plane { y, -.5 pigment { rgb .3 } finish { reflection .5 } }
sphere { <0, .5, 0>, .8 pigment { rgb .1 } finish { reflection .8 } }
