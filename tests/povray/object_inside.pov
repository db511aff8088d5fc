// The camera within a sphere, an open cylinder and a box.
#declare No_camera = 1;
#include "stage.inc"
camera { location <0, .3, -1> look_at <.3, .2, 2> angle 80 }
sphere { 0, 30 pigment { gradient y color_map { [0 rgb <.4, .6, 1>] [1 rgb .1] } scale 7 } finish { ambient .8 } }
box { <-9, -3, -9>, <9, 7, 9> pigment { rgbt <.8, .9, .8, .7> } }
cylinder { -4*z, 4*z, 1.5 open pigment { radial color_map { [0 rgb .9] [1 rgb <.8, .2, .1>] } frequency 6 rotate 90*x } }
light_source { <0, .5, 0> rgb .5 }
