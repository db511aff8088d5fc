/* trimray: dispatch and the exit status. */
#include "render/commands.h"

static int usage_error(const Options *o)
{
    return run_fail(EXIT_USAGE, "%s (trimray --help lists the options)", o->error);
}

static int dispatch(const Options *o)
{
    switch (o->command) {
    case COMMAND_RENDER: return cmd_render(o);
    case COMMAND_CHECK: return cmd_check(o);
    case COMMAND_SHOOT: return cmd_shoot(o);
    case COMMAND_EXPORT: return cmd_export(o);
    case COMMAND_COMPARE: return cmd_compare(o);
    case COMMAND_REPORT: return cmd_report(o);
    }
    return EXIT_USAGE;
}

int main(int argc, char *argv[])
{
    Arena *arena = arena_new();
    Options o;
    int status = EXIT_DONE;
    interrupt_install();
    if (!options_read(argc - 1, argv + 1, arena, &o)) status = usage_error(&o);
    else if (o.wants_help) options_print_help(stdout);
    else if (o.wants_version) puts("trimray " TRIMRAY_VERSION);
    else status = dispatch(&o);
    arena_free(arena);
    return status;
}
