#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
sphere { -1*x, .8 inverse
  texture { pigment { rgb x } } interior_texture { pigment { rgb y } } }
box { <.3, -.6, -.6>, <1.5, .6, .6>
  texture { pigment { rgbt <1, 1, 1, .7> } } interior_texture { pigment { rgbt <0, 0, 1, .3> } } inverse }
