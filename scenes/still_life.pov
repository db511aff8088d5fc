/* A still life, after the paper's Figure 9: a teapot, two goblets, spoons and a pencil on a table, with balls of glass and of
 * chrome, before a mirror. Surfaces: teapot 32, goblets 2, spoons 6, pencil 17, and the mirror in its frame 6 (3 trims). */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
#include "nurbs.inc"
#include "teapot.inc"
#include "goblet.inc"
#include "spoon.inc"
#declare Pencil_Paint = texture { pigment { rgb <.70, .07, .05> } finish { ambient .12 diffuse .65 phong .7 phong_size 70 } }
#include "pencil.inc"

camera { location <-1.2, 6.4, -14.5> look_at <.05, 1.72, .4> angle 38 right x * image_width / image_height }
background { rgb <.40, .38, .42> }
light_source { <-9, 14, -9>, rgb <.92, .88, .80> }
light_source { <11, 9, -12>, rgb <.26, .30, .38> }

#declare Silver = texture {
  pigment { rgb <.62, .62, .64> } finish { ambient .08 diffuse .35 phong .9 phong_size 60 metallic reflection .42 }
}
#declare Gold = texture {
  pigment { rgb <.86, .60, .20> }
  finish { ambient .12 diffuse .45 phong .9 phong_size 50 metallic reflection { .28 metallic } }
}
#declare Clear = texture {
  pigment { rgbf <.96, .98, .98, .94> } finish { ambient 0 diffuse .04 phong .9 phong_size 150 reflection .08 }
}

// The table: a cloth of squares, polished a little; and the wall.
plane {
  y, 0
  pigment { checker rgb <.72, .66, .56>, rgb <.50, .22, .16> scale 1.5 rotate 31 * y translate <.4, .5, 0> }
  finish { ambient .12 diffuse .62 reflection .07 }
}
plane { -z, -13 pigment { rgb <.44, .46, .50> } finish { ambient .2 diffuse .6 } }

// The mirror: glass, a frame with two faces' worth of outline (rim and opening), its walls, and its back.
#declare Mirror_Rim = Outline_Rounded(<-4.6, 0>, <4.6, 6.1>, .9);
#declare Mirror_Opening = Outline_Rounded(<-4.1, .5>, <4.1, 5.6>, .5);
union {
  trimmed_nurbs {
    Nurbs_Planar(0, x, y, <-4.2, .4>, <4.2, 5.7>)
    texture { pigment { rgb .05 } finish { ambient 0 diffuse .1 reflection .85 } }
  }
  union {
    trimmed_nurbs {
      Nurbs_Planar(-.25 * z, x, y, <-4.6, 0>, <4.6, 6.1>)
      Trim_Outline(Mirror_Rim, NURBS_REGION)
      Trim_Outline(Mirror_Opening, NURBS_HOLE)
    }
    trimmed_nurbs { Nurbs_Wall(Mirror_Rim, -.25 * z, x, y, .45 * z) }
    trimmed_nurbs { Nurbs_Wall(Mirror_Opening, -.25 * z, x, y, .25 * z) }
    trimmed_nurbs { Nurbs_Planar(.2 * z, x, y, <-4.6, 0>, <4.6, 6.1>) Trim_Outline(Mirror_Rim, NURBS_REGION) }
    texture { pigment { rgb <.36, .20, .10> } finish { ambient .12 diffuse .6 phong .6 phong_size 40 } }
  }
  rotate 7 * x
  rotate -14 * y
  translate <1.0, .02, 4.6>
}

object {
  Teapot
  rotate -24 * y
  translate <-.75, 0, 1.2>
  pigment { rgb <.82, .80, .72> }
  finish { ambient .12 diffuse .60 phong .9 phong_size 90 reflection .05 }
}
object { Goblet scale 1.08 translate <3.35, 0, .1> texture { Clear } interior { ior 1.5 } }
object { Goblet scale .92 translate <-3.75, 0, -.5> texture { Gold } }

#declare Teaspoon = object { Spoon scale .27 texture { Silver } }
object { Teaspoon rotate -38 * y translate <-2.6, 0, -4.4> }
object { Teaspoon rotate -30 * y translate <-1.75, 0, -4.8> }
object { Pencil_Lying scale .36 rotate -20 * y translate <.9, 0, -4.6> }

sphere { <1.15, .62, -2.3>, .62 texture { Clear } interior { ior 1.5 } }
sphere {
  <2.35, .45, -2.9>, .45
  pigment { rgb <.85, .87, .9> } finish { ambient 0 diffuse .12 phong .9 phong_size 120 reflection .78 }
}
sphere { <-2.2, .33, -2.2>, .33 pigment { rgb <.12, .34, .20> } finish { ambient .12 diffuse .6 phong .9 phong_size 90 reflection .08 } }
