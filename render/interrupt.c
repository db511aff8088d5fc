#include "render/interrupt.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <unistd.h>

typedef void (*Stop)(void);

/* Globals, because a signal handler has no other way to reach anything. */
static atomic_bool is_deferred, has_come;
static _Atomic Stop stop_now;

static void on_signal(int signal_number)
{
    (void)signal_number;
    if (!is_deferred) _exit(EXIT_INTERRUPTED);
    has_come = true;
    Stop stop = stop_now;
    if (stop) stop();
}

void interrupt_install(void)
{
    struct sigaction action = { .sa_handler = on_signal, .sa_flags = SA_RESTART };
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void interrupt_defer(void (*stop)(void))
{
    stop_now = stop;
    is_deferred = true;
}

bool interrupt_came(void) { return has_come; }
