// Tori: lying, standing, scaled, thin.
#include "stage.inc"
torus { .6, .25 translate <-1.4, -.2, 0> pigment { rgb <.9, .2, .2> } }
torus { .5, .15 rotate 80*x rotate 30*y translate <0, .3, 0> pigment { rgb <.2, .8, .2> } }
torus { 1, .4 scale <.5, .9, .3> rotate -20*z translate <1.4, .2, 0> pigment { rgb <.2, .3, .9> } }
torus { .5, .02 rotate 60*x translate <.2, 1.5, .5> pigment { rgb <.9, .8, .2> } }
