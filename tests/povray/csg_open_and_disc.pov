#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
intersection {
  cylinder { -1.2*y, 1.2*y, .7 open pigment { rgb x } }
  disc { .2*y, <.2, 1, -.3>, 20 pigment { rgb y } }
}
difference {
  sphere { <1.4, 0, 0>, .6 pigment { rgb z } }
  cone { <1.4, 0, 0>, 0, <1.4, 1, -.6>, .5 open pigment { rgb <1, 1, 0> } }
}
