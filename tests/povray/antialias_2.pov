// povray: +A0.1 +AM2 +R3 -J
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
sphere { 0, 1 pigment { checker rgb 1 rgb x scale .3 } finish { phong .8 } }
box { <-1.5, -1, .5>, <1.8, -.4, 1.5> pigment { rgb <1, .8, .2> } rotate 15*y }
plane { y, -1.2 pigment { checker rgb 1 rgb .3 } }
