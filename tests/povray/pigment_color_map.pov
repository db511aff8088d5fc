// Entries that overlap, steps, the old form with two keys, filter in a map, a declared map, keys out of [0, 1].
#include "stage.inc"
#declare M = color_map { [0, .3 color rgb x color rgb y] [.3, .6 color rgb y color rgb <0, .3, 1>] [.6, 1.001 color rgb .2 color rgb 1] }
box { <-2, -.5, 0>, <-.8, .9, .6> pigment { gradient y color_map { M } scale 1.5 translate -.5*y } }
sphere { <-.1, .1, 0>, .55 pigment { gradient x color_map { [.2 rgb x] [.2 rgbt <1, 1, 0, .8>] [.8 rgbf <0, 1, 1, .9>] [.8 rgb .8] } scale .6 } }
cylinder { <1.4, -.5, 0>, <1.4, 1.2, 0>, .4 pigment { gradient y color_map { [.25 rgb .1] [.5 rgb <1, .5, 0>] [.75 rgb 1] } } }
