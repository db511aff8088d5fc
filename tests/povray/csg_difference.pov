#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
difference {
  box { -1, 1 }
  cylinder { <0, 0, -2>, <0, 0, 2>, .6 pigment { rgb y } }
  sphere { <1, 1, -1>, .7 }
  torus { .8, .15 translate y pigment { rgb <1, .5, 0> } }
  pigment { rgb x }
}
plane { y, -1.2 pigment { rgb 1 } }
