#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
fog { distance 6 color rgb <.5, .6, .7> }
box { <-9, -9, 3>, <9, 9, 4> pigment { checker rgb 1 rgb .2 } }
difference { box { -1, 1 } cylinder { -2*z, 2*z, .25 scale <2, 2, 1> } sphere { 0, .7 translate -x } pigment { rgbt <1, .5, .5, .7> } }
