#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
difference {
  box { <-1, 0, -1>, <1, 1, 1> }
  box { <-.8, -1, -.8>, <.8, .8, .8> }
  cylinder { -2*z, 2*z, .4 translate .5*y }
  cylinder { -2*x, 2*x, .4 translate .5*y }
  pigment { rgbf <1, .6, .3, .5> }
  rotate 30*y
}
plane { y, -.01 pigment { rgb 1 } }
