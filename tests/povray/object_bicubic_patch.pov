// A bicubic patch of fixed steps; POV-Ray's is of triangles, so only what does not bend can agree: a flat one, with uv.
#include "stage.inc"
bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 2
  <-1, 0, 0>, <-.4, 0, 0>, <.4, 0, 0>, <1, 0, 0>, <-1, .5, 0>, <-.4, .5, 0>, <.4, .5, 0>, <1, .5, 0>,
  <-1, 1, 0>, <-.4, 1, 0>, <.4, 1, 0>, <1, 1, 0>, <-1, 1.5, 0>, <-.4, 1.5, 0>, <.4, 1.5, 0>, <1, 1.5, 0>
  rotate 20*y pigment { rgb <.9, .6, .2> } }
