// Light sources in all forms.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 }
light_source { <1, 2, 3>, 1 }
light_source { <1, 2, 3> color rgb <1, .9, .8> shadowless }
light_source { 10*y, colour rgb 1 spotlight point_at 0 radius 10 falloff 20 tightness 5 }
light_source { 10*y, 1 cylinder point_at x radius 1 falloff 2 tightness 3 }
light_source { 10*y, rgb .5 parallel point_at 0 }
light_source { 10*y, 1 fade_distance 5 fade_power 2 }
light_source { 10*y, 1 area_light x, z, 4, 4 adaptive 1 circular orient area_illumination on }
#declare Lamp = light_source { 0, 1 translate 5*y spotlight point_at 0 }
light_source { Lamp }
light_source { Lamp rotate 90*x }
