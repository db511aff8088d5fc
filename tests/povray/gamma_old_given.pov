// No #version at all, but an assumed_gamma.
global_settings { assumed_gamma 1.8 }
camera { location <0, 1, -5> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
sphere { 0, 1 pigment { rgb <.5, .25, .75> } finish { phong .3 } }
plane { y, -1 pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } scale 2 } finish { ambient .4 } }
