#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
difference {
  box { -1, 1 }
  sphere { <0, 0, -1.1>, .9 }
  pigment { rgb <.5, .5, .6> }
  finish { reflection .5 }
}
sphere { <0, 0, -1>, .3 pigment { rgb x } }
plane { y, -1.2 pigment { checker rgb 1 rgb .3 } }
