// The modifiers that all objects share, several at once.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare T = texture { pigment { rgb 1 } }
#declare P = pigment { rgb x }
#declare F = finish { phong 1 }
#declare I = interior { ior 1.5 }
sphere { 0, 1 texture { T } texture { T } }
sphere { 0, 1 pigment { P } finish { F } interior { I } }
sphere { 0, 1 uv_mapping pigment { P } no_shadow no_image no_reflection inverse hollow double_illuminate }
sphere { 0, 1 hollow on hollow off hollow true }
sphere { 0, 1 interior_texture { T } interior { ior 1.2 fade_distance 2 fade_power 1 fade_color rgb x caustics .5 } }
sphere { 0, 1 interior { I fade_colour rgb <1, .5, .2> } }
sphere { 0, 1 translate x rotate 90*y scale <1, 2, 3> scale 2 matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 6, 7> }
#declare M = transform { rotate x*90 translate y }
#declare N = transform { M inverse scale 2 }
sphere { 0, 1 transform M transform { N } transform { translate x transform M inverse } }
sphere { 0, 1 scale 2 texture { T rotate 45 } translate 3 }
