/* --stats FILE.json: what a run cost, the paper's counters ([MCFS00] Figure 8) under the paper's names. */
#ifndef TRIMRAY_STATS_JSON_H
#define TRIMRAY_STATS_JSON_H

#include "render/commands.h"
#include "render/inventory.h"

/* The JSON text, in the arena. */
const char *stats_json(const Run *run, const Inventory *inventory, Arena *a);

#endif
