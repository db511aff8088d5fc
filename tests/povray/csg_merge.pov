#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
merge {
  sphere { -.5*x, .9 }
  sphere { .5*x, .9 }
  cone { y*.2, .5, y*1.6, .1 }
  pigment { rgbt <.6, .9, .6, .6> }
  finish { phong .5 }
}
plane { y, -1.2 pigment { checker rgb 1 rgb .3 } }
