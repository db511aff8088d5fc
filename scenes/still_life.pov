/* A still life, after the paper's Figure 9: a teapot, goblets of gold and of glass, spoons and a pencil on a table before a
 * mirror, with balls of glass, chrome and stone.
 * Surfaces: teapot 32, goblets 2, spoons 6, pencil 17, mirror 5, table 2, cloth 1.
 * Trims: pencil 9, mirror 4, table 1, cloth 1. */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
#include "nurbs.inc"
#include "teapot.inc"
#include "goblet.inc"
#include "spoon.inc"
#declare Pencil_Paint = texture {
  pigment { rgb <.62, .05, .05> } finish { ambient .12 diffuse .65 phong .7 phong_size 70 }
}
#include "pencil.inc"

camera { location <-1.2, 6.0, -14.5> look_at <.1, 1.9, .4> angle 38 right x * image_width / image_height }
background { rgb <.30, .30, .34> }
light_source { <-9, 14, -9>, rgb <.94, .90, .82> }
light_source { <11, 9, -12>, rgb <.24, .28, .36> }

#declare Silver = texture {
  pigment { rgb <.62, .62, .64> } finish { ambient .06 diffuse .30 phong .9 phong_size 60 metallic reflection .5 }
}
#declare Gold = texture {
  pigment { rgb <.88, .56, .16> }
  finish { ambient .10 diffuse .42 phong 1 phong_size 45 metallic reflection { .30 metallic } }
}
#declare Clear = texture {
  pigment { rgbf <.96, .98, .98, .94> } finish { ambient 0 diffuse .03 phong .9 phong_size 150 reflection .08 }
}

// The room: floor, wall behind, and the wall that only the mirror sees.
plane { y, -9 pigment { rgb <.20, .17, .15> } finish { ambient .15 diffuse .6 } }
plane { -z, -12 pigment { rgb <.22, .31, .33> } finish { ambient .15 diffuse .62 } }
plane { z, -40 pigment { rgb <.34, .30, .27> } finish { ambient .3 diffuse .6 } }
// A window beside the camera, for things that shine to mirror; the light comes from its place.
union {
  #for (I, 0, 3) box { <mod(I, 2) * 2.4, int(I / 2) * 2.8, 0>, <mod(I, 2) * 2.4 + 2.2, int(I / 2) * 2.8 + 2.6, .1> } #end
  pigment { rgb <1, .97, .90> }
  finish { ambient 1.1 diffuse 0 }
  no_shadow
  translate <-2.3, 0, 0>
  scale 2.8
  rotate 50 * y
  translate <-17, 1, -14>
}

// The table, round: a plane with a circle for a trim, and its edge, half a torus in section.
#declare Table_Top = 11;
#declare Table_Edge = Curve_Arc(<Table_Top, -.3, 0>, .3, 90, -90, 2);
union {
  trimmed_nurbs {
    Nurbs_Planar(0, x, z, -<Table_Top, Table_Top>, <Table_Top, Table_Top>)
    Trim_Circle(<0, 0>, Table_Top, NURBS_REGION)
  }
  trimmed_nurbs { Nurbs_Revolution(Curve_Piece_Knots(3, 5), Table_Edge, 360) }
  pigment { rgb <.17, .07, .035> }
  finish { ambient .10 diffuse .55 phong .3 phong_size 90 reflection .14 }
}
trimmed_nurbs {
  Nurbs_Planar(.015 * y, x, z, <-4.4, -3.4>, <4.4, 3.4>)
  Trim_Rounded(<-4.4, -3.4>, <4.4, 3.4>, .5, NURBS_REGION)
  pigment { checker rgb <.80, .76, .66>, rgb <.20, .30, .40> scale 1.1 }
  finish { ambient .13 diffuse .66 }
  rotate 12 * y
  translate <-.5, 0, -.4>
}

// The mirror: glass, and a frame with a face, a rim, an opening and a back.
#declare Mirror_Rim = Outline_Rounded(<-4.4, 0>, <4.4, 5.9>, .9);
#declare Mirror_Opening = Outline_Rounded(<-3.95, .45>, <3.95, 5.45>, .5);
union {
  trimmed_nurbs {
    Nurbs_Planar(0, x, y, <-4.2, .2>, <4.2, 5.7>)
    Trim_Outline(Mirror_Opening, NURBS_REGION)
    texture { pigment { rgb .03 } finish { ambient 0 diffuse .1 reflection .88 } }
  }
  union {
    trimmed_nurbs {
      Nurbs_Planar(-.25 * z, x, y, <-4.4, 0>, <4.4, 5.9>)
      Trim_Outline(Mirror_Rim, NURBS_REGION)
      Trim_Outline(Mirror_Opening, NURBS_HOLE)
    }
    trimmed_nurbs { Nurbs_Wall(Mirror_Rim, -.25 * z, x, y, .45 * z) }
    trimmed_nurbs { Nurbs_Wall(Mirror_Opening, -.25 * z, x, y, .25 * z) }
    trimmed_nurbs { Nurbs_Planar(.2 * z, x, y, <-4.4, 0>, <4.4, 5.9>) Trim_Outline(Mirror_Rim, NURBS_REGION) }
    texture { pigment { rgb <.70, .44, .14> } finish { ambient .10 diffuse .5 phong .8 phong_size 40 metallic } }
  }
  rotate -4 * x
  rotate -20 * y
  translate <1.3, .02, 4.9>
}

object {
  Teapot
  rotate -24 * y
  translate <-.75, .016, .9>
  pigment { rgb <.80, .78, .70> }
  finish { ambient .12 diffuse .60 phong .9 phong_size 90 reflection .05 }
}
object { Goblet scale 1.08 translate <3.1, .016, -.2> texture { Clear } interior { ior 1.5 } }
object { Goblet scale .94 translate <-3.75, .016, -.5> texture { Gold } }

#declare Teaspoon = object { Spoon scale .26 texture { Silver } }
object { Teaspoon rotate -34 * y translate <-2.7, .016, -4.3> }
object { Teaspoon rotate -28 * y translate <-1.9, .001, -4.9> }
object { Pencil_Lying scale .33 rotate -52 * y translate <1.7, .001, -5.1> }

sphere { <1.15, .63, -2.2>, .61 texture { Clear } interior { ior 1.5 } }
sphere {
  <2.35, .47, -2.8>, .45
  pigment { rgb <.85, .87, .9> } finish { ambient 0 diffuse .1 phong .9 phong_size 120 reflection .8 }
}
sphere {
  <-2.2, .35, -2.0>, .33
  pigment { rgb <.10, .32, .18> } finish { ambient .12 diffuse .6 phong .9 phong_size 90 reflection .08 }
}
