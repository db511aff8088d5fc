#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
difference {
  sphere { 0, 1.2 }
  sphere { 0, .9 }
  box { <0, 0, -2>, 2 }
  pigment { rgbf <.9, .95, 1, .9> }
  finish { reflection .1 specular .6 }
  interior { ior 1.5 }
}
plane { y, -1.3 pigment { checker rgb 1 rgb .3 } }
