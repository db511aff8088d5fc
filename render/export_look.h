/* Appearance and surroundings as POV-Ray's scene language. */
#ifndef TRIMRAY_EXPORT_LOOK_H
#define TRIMRAY_EXPORT_LOOK_H

#include "render/scene.h"
#include "render/sdl.h"

/* " texture { ... }" for each layer, evaluated in a space from which `outer` leads to the space of the object's block; not
 * so what is mapped by uv: all of it if by_uv. */
void export_texture(Sdl *out, const char *word, const Texture *t, const Xform *outer, bool by_uv);
void export_interior(Sdl *out, const Interior *i);
void export_matrix(Sdl *out, const Xform *x);             /* " matrix <...>"; nothing for the identity */

/* #version, global_settings, camera, background, sky_sphere, fog, light_source. */
void export_surroundings(Sdl *out, const Scene *s);

#endif
