#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
sphere { 0, 1.2
  pigment { checker rgb x rgb 1 scale .4 }
  interior_texture { pigment { rgb y } }
  clipped_by { plane { <1, .2, -.6>, .3 } plane { y, .7 } }
  rotate 20*z
}
