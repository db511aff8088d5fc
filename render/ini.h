/* POV-Ray's INI files: options, one or more a line, in sections. */
#ifndef TRIMRAY_INI_H
#define TRIMRAY_INI_H

#include "render/arena.h"

/* Takes one option, as it would stand on the command line ("Width=640", "+A0.3"); false ends the reading. */
typedef bool (*IniOption)(void *context, const char *option);

/* Calls `take` for the options before the first [section], and for those of the section named (NULL: none; case does not
 * matter). `;` begins a comment; a value may stand in quotes. False: the file cannot be read (*line is 0, errno says why),
 * has no such section (*line is 0, errno too), or take returned false at *line. */
bool ini_read(const char *path, const char *section, Arena *a, IniOption take, void *context, int *line);

#endif
