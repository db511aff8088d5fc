/* See net.h. Everything works on lines of points along one axis. */
#include "tests/stress/net.h"

static Quad4 quad4_lerp(Quad4 a, Quad4 b, Quad s)
{
    Quad r = 1 - s;
    return (Quad4){ r * a.x + s * b.x, r * a.y + s * b.y, r * a.z + s * b.z, r * a.w + s * b.w };
}

static Quad4 quad4_scale(Quad4 a, Quad s) { return (Quad4){ a.x * s, a.y * s, a.z * s, a.w * s }; }

static int stride(const Net *n, int axis) { return axis == NET_U ? 1 : n->n[NET_U]; }

/* The first point of line l along the axis. */
static Quad4 *line(const Net *n, int axis, int l) { return n->p + (axis == NET_U ? l * n->n[NET_U] : l); }

Net net_new(Arena *a, int k_u, int pieces_u, int k_v, int pieces_v)
{
    Net n = { .k = { k_u, k_v }, .n = { pieces_u * (k_u - 1) + 1, pieces_v * (k_v - 1) + 1 } };
    int pieces[2] = { pieces_u, pieces_v };
    for (int axis = 0; axis < 2; axis++) {
        n.knots[axis] = ARENA_ARRAY(a, double, n.n[axis] + n.k[axis]);
        double lengths[64];
        for (int i = 0; i < pieces[axis]; i++) lengths[i] = 1;
        net_set_lengths(&n, axis, lengths);
    }
    n.p = ARENA_ARRAY(a, Quad4, n.n[0] * n.n[1]);
    return n;
}

void net_set_lengths(Net *n, int axis, const double *lengths)
{
    int k = n->k[axis], pieces = (n->n[axis] - 1) / (k - 1), at = 0;
    double *knots = n->knots[axis], t = 0;
    knots[at++] = t;
    for (int i = 0; i <= pieces; i++) {
        for (int j = 0; j < k - 1; j++) knots[at++] = t;
        if (i < pieces) t += lengths[i];
    }
    knots[at] = t;
}

/* A net with another number of points or another order along one axis; the points are still to come. */
static Net net_like(Arena *a, const Net *n, int axis, int k, int count)
{
    Net r = *n;
    r.k[axis] = k, r.n[axis] = count;
    r.knots[axis] = ARENA_ARRAY(a, double, k + count);
    r.p = ARENA_ARRAY(a, Quad4, r.n[0] * r.n[1]);
    return r;
}

/* One piece from order k to `raised`: q_i = (i/k) p_{i-1} + (1 - i/k) p_i, again and again ([PT97] 5.33). */
static void raise_piece(const Quad4 *from, int step, int k, int raised, Quad4 *to, int step_to)
{
    Quad4 q[NURBS_MAX_ORDER];
    for (int i = 0; i < k; i++) q[i] = from[i * step];
    for (; k < raised; k++) {
        q[k] = q[k - 1];
        for (int i = k - 1; i > 0; i--) q[i] = quad4_lerp(q[i], q[i - 1], (Quad)i / k);
    }
    for (int i = 0; i < raised; i++) to[i * step_to] = q[i];
}

void net_raise(Arena *a, Net *n, int axis, int k)
{
    int k_old = n->k[axis], pieces = (n->n[axis] - 1) / (k_old - 1), lines = n->n[1 - axis];
    double lengths[64];
    for (int i = 0; i < pieces; i++) {
        const double *knots = n->knots[axis] + k_old - 1 + i * (k_old - 1);
        lengths[i] = knots[k_old - 1] - knots[0];
    }
    Net r = net_like(a, n, axis, k, pieces * (k - 1) + 1);
    net_set_lengths(&r, axis, lengths);
    int step = stride(n, axis), step_to = stride(&r, axis);
    for (int l = 0; l < lines; l++)
        for (int i = 0; i < pieces; i++)
            raise_piece(line(n, axis, l) + i * (k_old - 1) * step, step, k_old, k,
                        line(&r, axis, l) + i * (k - 1) * step_to, step_to);
    *n = r;
}

void net_mobius(Net *n, int axis, double ratio)
{
    int degree = n->k[axis] - 1, step = stride(n, axis);
    Quad c = powl(ratio, 1.0L / degree);   /* any number near it will do */
    for (int l = 0; l < n->n[1 - axis]; l++) {
        Quad scale = 1;
        Quad4 *p = line(n, axis, l);
        for (int i = 0; i < n->n[axis]; i++) {
            if (i > 0) scale = (i - 1) / degree % 2 == 0 ? scale * c : scale / c;
            p[i * step] = quad4_scale(p[i * step], scale);
        }
    }
}

void net_insert(Arena *a, Net *n, int axis, double t)
{
    int k = n->k[axis], count = n->n[axis], mu = k - 1;
    const double *tau = n->knots[axis];
    while (mu < count - 1 && tau[mu + 1] <= t) mu++;
    Net r = net_like(a, n, axis, k, count + 1);
    for (int i = 0; i <= mu; i++) r.knots[axis][i] = tau[i];
    r.knots[axis][mu + 1] = t;
    for (int i = mu + 1; i < count + k; i++) r.knots[axis][i + 1] = tau[i];
    int step = stride(n, axis), step_to = stride(&r, axis);
    for (int l = 0; l < n->n[1 - axis]; l++) {
        const Quad4 *p = line(n, axis, l);
        Quad4 *q = line(&r, axis, l);
        for (int i = 0; i <= count; i++) {
            if (i <= mu - k + 1) q[i * step_to] = p[i * step];
            else if (i > mu) q[i * step_to] = p[(i - 1) * step];
            else {
                Quad s = ((Quad)t - tau[i]) / ((Quad)tau[i + k - 1] - tau[i]);
                q[i * step_to] = quad4_lerp(p[(i - 1) * step], p[i * step], s);
            }
        }
    }
    *n = r;
}

void net_map(Net *n, const QuadMap *m)
{
    for (int i = 0; i < n->n[0] * n->n[1]; i++) {
        Quad4 *p = &n->p[i];
        Quad3 q = quad3_add(quad_map_vector(m, quad3(p->x, p->y, p->z)), quad3_scale(m->o, p->w));
        p->x = q.x, p->y = q.y, p->z = q.z;
    }
}

/* De Boor's triangle on k points, `step` apart, that matter in the span mu; the result is p[k-1]. */
static Quad4 de_boor(int k, const double *tau, int mu, double t, const Quad4 *from, int step)
{
    Quad4 p[NURBS_MAX_ORDER];
    for (int i = 0; i < k; i++) p[i] = from[i * step];
    for (int level = 1; level < k; level++)
        for (int i = k - 1; i >= level; i--) {
            int at = mu - k + 1 + i;
            p[i] = quad4_lerp(p[i - 1], p[i], ((Quad)t - tau[at]) / ((Quad)tau[at + k - level] - tau[at]));
        }
    return p[k - 1];
}

static int span(const Net *n, int axis, double t)
{
    int mu = n->k[axis] - 1;
    while (mu < n->n[axis] - 1 && n->knots[axis][mu + 1] <= t) mu++;
    while (n->knots[axis][mu] == n->knots[axis][mu + 1]) mu--;
    return mu;
}

Quad3 net_point(const Net *n, double u, double v)
{
    int mu_u = span(n, NET_U, u), mu_v = span(n, NET_V, v), k_u = n->k[0], k_v = n->k[1];
    Quad4 rows[NURBS_MAX_ORDER];
    for (int j = 0; j < k_v; j++)
        rows[j] = de_boor(k_u, n->knots[0], mu_u, u, n->p + (mu_v - k_v + 1 + j) * n->n[0] + mu_u - k_u + 1, 1);
    Quad4 p = de_boor(k_v, n->knots[1], mu_v, v, rows, 1);
    return quad3(p.x / p.w, p.y / p.w, p.z / p.w);
}

SurfaceDesc net_round(Arena *a, const Net *n)
{
    int count = n->n[0] * n->n[1];
    Vec4 *p = ARENA_ARRAY(a, Vec4, count);
    for (int i = 0; i < count; i++) {
        Quad4 q = n->p[i];
        p[i] = vec4((double)(q.x / q.w), (double)(q.y / q.w), (double)(q.z / q.w), (double)q.w);
    }
    return (SurfaceDesc){ .order_u = n->k[0], .order_v = n->k[1], .n_u = n->n[0], .n_v = n->n[1],
                          .knots_u = n->knots[0], .knots_v = n->knots[1], .points = p };
}
