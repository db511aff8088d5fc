/* What all shapes share: preparation on first use, and the calls through the table. */
#include "render/shape.h"

#include <pthread.h>

void shape_init(Shape *s, const ShapeType *type)
{
    s->type = type;
    s->n_primitives = 1;
    s->depth = 0;
    s->own = NULL;
    atomic_init(&s->state, type->prepare ? SHAPE_RAW : SHAPE_READY);
}

/* One lock for all shapes: it is held for a few instructions, some times in a shape's life. Waiting cannot come round
 * in a circle, because a shape only ever prepares what lies below it. */
static pthread_mutex_t prepare_lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t prepare_done = PTHREAD_COND_INITIALIZER;

/* What a preparation shares with the threads that wait for it; changed under the lock alone. */
typedef struct Crew Crew;
struct Crew {
    const Shape *shape;
    ShapeWork *work;
    void *context;
    uint32_t next, n;          /* pieces */
    int n_helpers;
    Arena *theirs;             /* the arenas of those that are done */
    Crew *older;
};
static Crew *crews;

static Crew *crew_of(const Shape *s)
{
    Crew *c = crews;
    while (c && c->shape != s) c = c->older;
    return c;
}

/* The lock is held, but for the work itself. */
static void do_pieces(Crew *c, Arena *own, Trace *t)
{
    while (c->next < c->n) {
        uint32_t i = c->next++;
        pthread_mutex_unlock(&prepare_lock);
        c->work(c->context, i, own, t);
        pthread_mutex_lock(&prepare_lock);
    }
}

/* Whoever waits for a shape helps with it alone: it may be preparing another one, but none that lies below this. */
static void help(Crew *c, Trace *t)
{
    Arena *own = arena_new();
    c->n_helpers++;
    do_pieces(c, own, t);
    arena_adopt(own, c->theirs);
    c->theirs = own;
    if (--c->n_helpers == 0) pthread_cond_broadcast(&prepare_done);
}

static void remove_crew(const Crew *c)
{
    Crew **at = &crews;
    while (*at != c) at = &(*at)->older;
    *at = c->older;
}

void shape_share_work(const Shape *s, Arena *own, uint32_t n, ShapeWork *work, void *context, Trace *t)
{
    pthread_mutex_lock(&prepare_lock);
    Crew c = { .shape = s, .work = work, .context = context, .n = n, .older = crews };
    crews = &c;
    pthread_cond_broadcast(&prepare_done);     /* those that wait for s may help */
    do_pieces(&c, own, t);
    while (c.n_helpers > 0) pthread_cond_wait(&prepare_done, &prepare_lock);
    remove_crew(&c);
    pthread_mutex_unlock(&prepare_lock);
    arena_adopt(own, c.theirs);
}

/* Is the preparation ours to do? If another thread has it, waits until it is done, and helps where it can. */
static bool claim(Shape *s, Trace *t)
{
    pthread_mutex_lock(&prepare_lock);
    bool is_ours = atomic_load(&s->state) == SHAPE_RAW;
    if (is_ours) atomic_store(&s->state, SHAPE_BUSY);
    while (!is_ours && atomic_load(&s->state) != SHAPE_READY) {
        Crew *c = crew_of(s);
        if (c && c->next < c->n) help(c, t);
        else pthread_cond_wait(&prepare_done, &prepare_lock);
    }
    pthread_mutex_unlock(&prepare_lock);
    return is_ours;
}

static void announce(Shape *s)
{
    pthread_mutex_lock(&prepare_lock);
    atomic_store_explicit(&s->state, SHAPE_READY, memory_order_release);
    pthread_cond_broadcast(&prepare_done);
    pthread_mutex_unlock(&prepare_lock);
}

/* own NULL: in an arena of its own. */
static void prepare(Shape *s, Arena *own, Trace *t)
{
    if (shape_was_prepared(s) || !claim(s, t)) return;
    double begun = stats_now(), counted = t->counters.prep_seconds;
    s->own = own ? NULL : arena_new();
    s->type->prepare(s, own ? own : s->own, t);
    double within = t->counters.prep_seconds - counted;
    t->counters.prep_seconds += stats_now() - begun - within;
    announce(s);
}

void shape_prepare(Shape *s, Trace *t) { prepare(s, NULL, t); }
void shape_prepare_in(Shape *s, Arena *own, Trace *t) { prepare(s, own, t); }

void shape_release(Shape *s)
{
    if (s->type->release) s->type->release(s);
    arena_free(s->own);
    s->own = NULL;
    if (s->type->prepare) atomic_store(&s->state, SHAPE_RAW);
}

bool shape_blocks_by_hit(const Shape *s, const Ray *r, double t_max, Trace *t)
{
    Hit nearest = { .t = t_max };
    return s->type->hit(s, r, &nearest, t);
}
