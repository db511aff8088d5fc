#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
intersection {
  box { -1, 1 pigment { rgb x } }
  sphere { 0, 1.3 pigment { rgb y } }
  plane { <1, 1, -1>, .6 pigment { checker rgb 1 rgb z scale .2 } }
  rotate 20*y
}
plane { y, -1.2 pigment { rgb 1 } }
