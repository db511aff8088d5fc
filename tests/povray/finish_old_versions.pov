// Before 3.7: no gamma; filter counts by the brightest channel.
#version 3.5;
camera { location <1, 2.5, -6> look_at <0, .6, 0> angle 40 }
light_source { <-5, 8, -6> rgb 1 }
plane { y, -.501 pigment { checker rgb <.8, .75, .7>, rgb <.3, .35, .4> } }
sphere { <-1, .2, 0>, .6 pigment { rgbf <.8, .5, .2, .5> } finish { phong .5 reflection .1 } }
sphere { <.6, .2, 0>, .6 pigment { rgbft <.3, .5, .9, .4, .3> } interior { ior 1.3 } }
background { rgb <.2, .3, .5> }
