#include "render/sdl.h"

#include <stdarg.h>

void sdl_text(Sdl *out, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(out->file, format, arguments);
    va_end(arguments);
}

void sdl_number(Sdl *out, double x) { fprintf(out->file, " %.17g", x); }

void sdl_vec2(Sdl *out, Vec2 v) { fprintf(out->file, " <%.17g, %.17g>", v.x, v.y); }

void sdl_vec(Sdl *out, Vec3 v) { fprintf(out->file, " <%.17g, %.17g, %.17g>", v.x, v.y, v.z); }
