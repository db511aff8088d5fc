/* The rows of a run: written to a log part by part, so that nothing is lost if it is interrupted and the runs of several
 * processes or machines can be summed; printed as a table in Markdown. */
#ifndef TRIMRAY_STRESS_TABLE_H
#define TRIMRAY_STRESS_TABLE_H

#include "tests/stress/run.h"

typedef struct { Row rows[N_METHODS]; } TableCell;
typedef struct {
    TableCell *cells;            /* FAMILY_VALUES for each family */
} Table;

Table table_new(void);
void table_free(Table *t);

/* What the log's parts were made with, in one line: parts that were made otherwise are not summed. */
typedef struct { long rays, surface_rays, all_hits_every; } LogHead;

/* Begins an empty log; or checks that the log's head is this one, and cuts off a last line that was not finished. False: it
 * is another head, or the file cannot be read or written. fd was opened with O_APPEND. */
bool log_begin(int fd, LogHead head);

/* Appends a part, a line by one system call: processes may share a log. */
bool log_add(int fd, Part part, const Row rows[N_METHODS]);

/* Adds the parts of a log to the table, and tells of each. */
void log_read(int fd, Table *t, void (*seen)(void *context, Part part), void *context);

/* by_knob: a row for each value of a family's knob. Rows without rays are left out. */
void table_print(const Table *t, bool by_knob);

/* Of all families. */
Row table_total(const Table *t, int method);

#endif
