/* SIGINT and SIGTERM. At first they end the program, with exit status 130; once there is something worth keeping they ask
 * for an early end instead. */
#ifndef TRIMRAY_INTERRUPT_H
#define TRIMRAY_INTERRUPT_H

#include <stdbool.h>

#define EXIT_INTERRUPTED 130

void interrupt_install(void);
/* From now on a signal only calls `stop` (which must be safe in a signal handler; NULL: nothing) and is remembered. */
void interrupt_defer(void (*stop)(void));
bool interrupt_came(void);

#endif
