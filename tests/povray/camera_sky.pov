// A tilted sky vector; `look_at` keeps the lengths of the others.
#include "world.inc"
camera { location <2, 3, -5> sky <.4, 1, .2> right 1.5*x up 1.2*y direction 1.7*z look_at <0, .5, 0> }
