/* Open CASCADE behind a C interface: its own is C++. */
#ifndef TRIMRAY_BENCH_OCCT_H
#define TRIMRAY_BENCH_OCCT_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct OcctFace OcctFace;

/* knots as nurbs.h has them; points: 4 doubles each, Euclidean with weight, u fastest. NULL: refused. */
OcctFace *occt_face_new(int order_u, int order_v, int n_u, int n_v, const double *knots_u, const double *knots_v,
                        const double *points, double tolerance);

/* A hole, as a rational curve in the (u, v) plane: 3 doubles a point {u, v, weight}. False: refused. */
int occt_face_trim(OcctFace *f, int order, int n, const double *knots, const double *points);

double occt_face_nearest(OcctFace *f, const double origin[3], const double dir[3], double t_min, double t_max);
void occt_face_free(OcctFace *f);

#ifdef __cplusplus
}
#endif

#endif
