#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
intersection {
  sphere { 0, 1.3 pigment { rgb x } }
  intersection { box { <-.8, -.8, -2>, <.8, .8, .5> } sphere { -z, 1.2 } pigment { rgb y } inverse }
}
