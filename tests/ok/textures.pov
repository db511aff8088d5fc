// Textures, pigments, finishes: all words.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Two = texture { pigment { rgb 1 } finish { ambient 0 } } texture { pigment { rgbt <1, 0, 0, .5> } }
#declare Map = color_map { [0 rgb 0] [.5, color rgb x] [1 colour rgb 1] }
#declare Old = colour_map { [0 .5 color rgb 0 color rgb x] [.5, 1 color rgb x color rgb 1] }
#declare Pigments = pigment_map { [0 rgb 1] [.5 checker rgb 0 rgb 1 scale .1] [1 color rgb <1, 0, 0>] }
#declare Wood = pigment { gradient x color_map { Map } frequency 4 phase .5 triangle_wave }
sphere { 0, 1 texture { Two } }
sphere { 0, 1 texture { Two pigment { rgb y } finish { phong 1 } scale 2 } }
sphere { 0, 1 pigment { color rgb <1, 2, 3>/4 } }
sphere { 0, 1 pigment { rgbft <1, .5, .25, .1, .2> } }
sphere { 0, 1 pigment { red .5 green .2 } }
plane { y, 0 pigment { checker } }
plane { y, 0 pigment { checker rgb 1 } }
plane { y, 0 pigment { checker color rgb 1 color rgb 0 scale 2 rotate 45*y translate x } }
plane { y, 0 pigment { checker rgb 1, rgb 0, scale 2 } }
plane { y, 0 pigment { checker pigment { Wood } pigment { rgb 0 } } }
plane { y, 0 pigment { brick rgb .3, rgb <1, .2, .1> brick_size <8, 3, 4> mortar .3 } }
plane { y, 0 pigment { hexagon rgb x rgb y rgb z } }
plane { y, 0 pigment { gradient <1, 1, 0> colour_map { Old } sine_wave } }
plane { y, 0 pigment { gradient x pigment_map { Pigments } } }
plane { y, 0 pigment { radial } }
plane { y, 0 pigment { onion scallop_wave } }
plane { y, 0 pigment { leopard cubic_wave } }
plane { y, 0 pigment { planar poly_wave 3 } }
plane { y, 0 pigment { spherical ramp_wave } }
plane { y, 0 pigment { cylindrical poly_wave } }
plane { y, 0 pigment { boxed } }
sphere { 0, 1 pigment { uv_mapping checker rgb 1 rgb 0 } }
sphere { 0, 1 texture { uv_mapping pigment { Wood } } }
#declare F = finish { ambient .2 diffuse .7 }
sphere { 0, 1 finish { F ambient rgb <.1, .2, .3> emission .1 diffuse albedo .5, .1 brilliance 2 } }
sphere { 0, 1 finish { phong albedo .3 phong_size 80 specular albedo .4 roughness .01 metallic } }
sphere { 0, 1 finish { phong .3 specular .4 metallic .5 reflection .3 conserve_energy } }
sphere { 0, 1 finish { reflection { .1, .9 falloff 2 exponent 1.5 metallic } } }
sphere { 0, 1 finish { reflection { rgb <.5, .6, .7> fresnel on metallic .5 } conserve_energy on } }
sphere { 0, 1 finish { reflection rgb <.1, .2, .3> reflection_exponent .8 } }
#default { texture { pigment { rgb 1 } finish { ambient .3 } } }
#default { pigment { rgb x } }
#default { finish { F phong 1 } }
sphere { 0, 1 }
