/* A scene as POV-Ray's scene language: not its text but what it came to, with meshes for what POV-Ray does not have. */
#ifndef TRIMRAY_EXPORT_POV_H
#define TRIMRAY_EXPORT_POV_H

#include "render/export_list.h"

#include <stdio.h>

/* Does POV-Ray get a mesh for this primitive? Those that cannot write themselves. */
bool export_pov_is_mesh(const Shape *s);

/* Meshes keep to chord_error in the world wherever they are placed. Shapes that several objects share are declared once.
 * NULL, or the name of a shape that can be written neither as itself nor as a mesh. */
const char *export_pov(FILE *file, const Scene *s, ExportList *list, double chord_error);

#endif
