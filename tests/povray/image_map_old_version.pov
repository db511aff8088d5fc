// A version below 3.7: pictures are not decoded either.
#version 3.6;
camera { location <1, 2.5, -6> look_at <0, .6, 0> angle 40 }
light_source { <-5, 8, -6> rgb 1 }
box { <-1.5, -.5, 0>, <1.5, 1.9, .2> pigment { image_map { png "picture.png" } scale 1.3 } }
plane { y, -.5 pigment { image_map { png "picture.png" gamma 2.2 } rotate 90*x scale 2 } }
