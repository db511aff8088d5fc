/* Writing POV-Ray's scene language. What is written can be read back without a bit lost. */
#ifndef TRIMRAY_SDL_H
#define TRIMRAY_SDL_H

#include "render/shape.h"
#include "render/xform.h"

#include <stdio.h>

/* For shapes that are made of others: writes one of these whole, whatever it is. */
typedef struct Sdl Sdl;
typedef void (*SdlShape)(Sdl *out, const Shape *s);

struct Sdl {
    FILE *file;
    SdlShape shape;
    const Xform *placement;  /* of the object whose block is being written; NULL: none */
    bool is_placed;          /* set by a shape that has written itself with the placement applied; else that follows it */
};

void sdl_text(Sdl *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void sdl_number(Sdl *out, double x);             /* after a blank */
void sdl_vec2(Sdl *out, Vec2 v);                 /* " <x, y>" */
void sdl_vec(Sdl *out, Vec3 v);                  /* " <x, y, z>" */

#endif
