/* Lists of hits, and the search that fills them for shapes which only know their nearest. */
#include "render/hit_list.h"

static bool comes_after(const Hit *a, const Hit *b) { return a->t > b->t || (a->t == b->t && a->index > b->index); }

/* By insertion: lists are short, and mostly in order already. */
void hit_list_sort(HitList *l, size_t first)
{
    for (size_t i = first + 1; i < l->n; i++) {
        Hit h = l->hits[i];
        size_t at = i;
        for (; at > first && comes_after(&l->hits[at - 1], &h); at--) l->hits[at] = l->hits[at - 1];
        l->hits[at] = h;
    }
}

static void search_repeatedly(const Shape *s, const Ray *r, HitList *out, Trace *t)
{
    Ray rest = *r;
    for (Hit h = { .t = out->t_max }; shape_hit(s, &rest, &h, t); h.t = out->t_max) {
        *hit_list_add(out) = h;
        rest.t_min = h.t + 2 * h.t_error;
    }
}

void shape_all_hits(const Shape *s, const Ray *r, HitList *out, Trace *t)
{
    if (!s->type->all_hits) {
        search_repeatedly(s, r, out, t);
        return;
    }
    shape_be_prepared(s, t);
    s->type->all_hits(s, r, out, t);
}
