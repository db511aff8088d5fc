// All ways to say a colour.
#include "stage.inc"
#declare C = rgb <.8, .4, .2>;
#declare F = rgbft <.2, .5, .9, .1, .2>;
#macro Ball(I, P) sphere { <mod(I, 4)*.9 - 1.5, div(I, 4)*.9 - .1, 0>, .4 pigment { P } } #end
Ball(0, rgb .5) Ball(1, color red .8 green .3) Ball(2, C) Ball(3, F)
Ball(4, color rgb <.3, .9, .3>*.7) Ball(5, rgbf <.9, .9, .2, .5>) Ball(6, C*.5 + <0, .2, 0>) Ball(7, srgb <.5, .25, .02>*2)
Ball(8, rgbt <.1, .2, .9, .6>) Ball(9, color C filter .6) Ball(10, rgb C.green) Ball(11, srgbt <.9, .4, .1, .3>)
