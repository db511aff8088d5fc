// Functions and operators of numbers and vectors.
#include "stage.inc"
#macro Bar(I, H) cylinder { <I*.22 - 2.2, -.5, 0>, <I*.22 - 2.2, -.49 + abs(H), 0>, .1 pigment { rgb <I/20, .4, 1 - I/20> } } #end
Bar(0, sin(1)) Bar(1, atan2(1, 2)) Bar(2, pow(1.1, 3)) Bar(3, mod(-7.5, 2)) Bar(4, int(1.9)) Bar(5, floor(-.5)) Bar(6, ceil(.2))
Bar(7, vlength(<.3, .4, .5>)) Bar(8, vdot(<.3, .4, 1>, <1, .2, .1>)) Bar(9, vcross(x, <0, .8, 0>).z) Bar(10, vnormalize(<1, 2, 2>).y)
Bar(11, vrotate(x, 30*z).y) Bar(12, vaxis_rotate(x, <1, 1, 1>, 50).y) Bar(13, max(.2, .9, .4)) Bar(14, min(.7, .3)) Bar(15, (1 > 2 ? .2 : .6))
Bar(16, select(-1, .9, .2, .3)) Bar(17, exp(-.5)) Bar(18, ln(2)) Bar(19, log(5)) Bar(20, radians(40)) Bar(21, <.1, .7, .2, .3>.t)
