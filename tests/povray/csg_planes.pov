#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
intersection {
  plane { -z, .8 } plane { z, .8 } plane { x, .9 } plane { -x, .9 } plane { y, .7 } plane { -y, .7 }
  plane { <1, 1, -1>, 1 pigment { rgb y } }
  pigment { rgb <.9, .6, .3> }
}
difference { plane { y, -1 } sphere { <0, -1, -1.5>, 1 pigment { rgb x } } pigment { checker rgb 1 rgb .4 } }
