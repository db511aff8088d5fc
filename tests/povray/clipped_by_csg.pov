#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
box { -1, 1 pigment { rgb <1, .8, .2> }
  clipped_by { difference { box { -1.5, 1.5 } sphere { <.6, .6, -1>, .9 } } }
  scale .9 rotate 15*y
}
torus { 1.3, .2 pigment { rgb z } clipped_by { plane { -x, 0 } } clipped_by { plane { -y, 0 inverse } } }
