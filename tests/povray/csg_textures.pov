#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
#declare Part = difference {
  box { -1, 1 }
  sphere { -z, .8 pigment { checker rgb 1 rgb y scale .3 } }
  cylinder { -2*y, 2*y, .35 translate .4*x }
}
object { Part pigment { gradient <1, .1, .2> translate .013 color_map { [0 rgb 1] [1 rgb x] } } scale .7 translate -.9*x }
object { Part scale .7 rotate 30*y translate .9*x pigment { checker rgb z rgb <1, 1, 0> scale .25 } }
