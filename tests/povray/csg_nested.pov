#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
difference {
  union {
    intersection { box { -1, 1 } sphere { 0, 1.25 pigment { rgb z } } }
    cylinder { -1.4*x, 1.4*x, .3 pigment { rgb <1, 1, 0> } }
  }
  merge { cylinder { -2*z, 2*z, .4 } cylinder { -2*y, 2*y, .4 } rotate 10*x }
  difference { sphere { <-1, 1, -1>, .8 } box { <-1.2, 0, -2>, <-.8, 2, 0> } pigment { rgb y } }
  pigment { rgb x }
  rotate <20, 30, 0> scale <1, .9, 1.1>
}
