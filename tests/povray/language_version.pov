// #version changes in the middle of a file; version can be asked.
#version 3.5;
#declare Old = version;
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
sphere { -x, .8 pigment { rgb <Old/4, .2, .1> } }
sphere { x, .8 pigment { rgb <.1, version/5, clock> } }
#ifdef (Nothing) sphere { y, 1 } #else box { <-.3, 1, 0>, <.3, 1.4, .3> pigment { rgb <image_width/320, image_height/240, 0> } } #end
