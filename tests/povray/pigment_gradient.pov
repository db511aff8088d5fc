// gradient along any vector, below zero, default map, frequency and phase.
#include "stage.inc"
box { <-2.2, -.5, -.5>, <-1.1, .9, .5> pigment { gradient y color_map { [0 rgb 0] [.3 rgb x] [.7 rgb <.9, .9, 0>] [1 rgb 1] } } }
sphere { <-.3, .1, 0>, .6 pigment { gradient <1, 2, -1> scale .7 } }
box { <.5, -.5, -.4>, <1.1, .9, .4> pigment { gradient y color_map { [.2 rgb x] [.2 rgb y] [.6 rgb y] [.6 rgb z] } frequency 3 phase .3 } }
cylinder { <1.7, -.5, 0>, <1.7, 1, 0>, .4 pigment { gradient -y frequency -1.5 color_map { [0 rgb 1] [1 rgb <0, .4, .8>] } } }
