/* A job is a process group of its own: its memory is its own and can be measured, it can fail in any way, and it can be
 * ended with all that it started. What it says on the standard error is kept for the report. */
#include "render/report.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* Globals, because signal handlers have no other way to reach them. */
static atomic_int running;
static atomic_bool is_late;

static void end_job(void)
{
    int pid = running;
    if (pid > 0) kill(-pid, SIGKILL);
}

static void on_alarm(int signal_number)
{
    (void)signal_number;
    is_late = true;
    end_job();
}

void *report_shared(size_t n_bytes)
{
    void *p = mmap(NULL, n_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return p == MAP_FAILED ? NULL : p;
}

static void run_job(FILE *said, int (*work)(void *), void *context)
{
    setpgid(0, 0);
    signal(SIGINT, SIG_DFL), signal(SIGTERM, SIG_DFL);
    dup2(fileno(said), STDERR_FILENO);
    int status = work(context);
    fflush(stderr);
    _exit(status);
}

static const char FAIL[] = "trimray: error: ";   /* run_fail */

static const char *what_it_said(Arena *a, FILE *said, int status)
{
    char text[2000];
    rewind(said);
    size_t n = fread(text, 1, sizeof text - 1, said);
    while (n > 0 && text[n - 1] == '\n') n--;
    text[n] = '\0';
    size_t skipped = strncmp(text, FAIL, sizeof FAIL - 1) == 0 ? sizeof FAIL - 1 : 0;   /* it is said again by the parent */
    return n > 0 ? arena_strdup(a, text + skipped) : arena_printf(a, "exit status %d", status);
}

static void limit(double seconds)
{
    struct sigaction action = { .sa_handler = on_alarm, .sa_flags = SA_RESTART };
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
    is_late = false;
    alarm((unsigned)ceil(fmax(seconds, 1)));
}

static const char *wait_for(Arena *a, pid_t pid, double seconds, FILE *said)
{
    int status = 0;
    setpgid(pid, pid);               /* whichever of the two processes comes first */
    running = (int)pid;
    limit(seconds);
    interrupt_defer(end_job);
    if (interrupt_came()) end_job();
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    running = 0;
    alarm(0);
    if (interrupt_came()) return "interrupted";
    if (is_late) return arena_printf(a, "took more than %.0f s", seconds);
    if (WIFSIGNALED(status)) return arena_printf(a, "ended by signal %d (%s)", WTERMSIG(status),
        strsignal(WTERMSIG(status)));
    return WEXITSTATUS(status) == 0 ? NULL : what_it_said(a, said, WEXITSTATUS(status));
}

const char *report_job(Arena *a, double seconds, int (*work)(void *context), void *context)
{
    FILE *said = tmpfile();
    if (!said) return arena_printf(a, "no temporary file: %s", strerror(errno));
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) run_job(said, work, context);
    const char *failure = pid < 0 ? arena_printf(a, "no process: %s", strerror(errno)) : wait_for(a, pid, seconds, said);
    fclose(said);
    return failure;
}
