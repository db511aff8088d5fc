// fade_distance, fade_power and fade_color, also in shadows.
#include "stage.inc"
#declare Glass = texture { pigment { rgbf 1 } finish { ambient 0 diffuse 0 specular .3 } }
sphere { <-1.5, .3, 0>, .6 texture { Glass } interior { ior 1.2 fade_distance .5 fade_power 1 fade_color rgb <.9, .4, .1> } }
box { <-.5, -.4, -.4>, <.5, .8, .4> rotate 20*y texture { Glass } interior { ior 1.1 fade_distance .4 fade_power 1001 fade_color rgb <.2, .7, .9> } }
sphere { <1.5, .3, 0>, .6 texture { Glass } interior { ior 1 fade_distance .7 fade_power 2 } }
