// What surrounds the objects.
#version 3.7;
global_settings { assumed_gamma srgb max_trace_level 10 adc_bailout .01 ambient_light rgb <1, .5, .2> }
camera { location -5*z }
background { color rgb <.1, .2, .3> }
#declare Sky = sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb z] } } pigment { rgbt 1 } scale 2 rotate x }
sky_sphere { Sky rotate 20*y }
#declare Mist = fog { fog_type 2 distance 10 color rgb .5 fog_offset 1 fog_alt 2 }
fog { Mist }
fog { distance 100 rgb <.5, .6, .7> up z }
sphere { 0, 1 }
