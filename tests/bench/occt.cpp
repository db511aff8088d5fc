#include "tests/bench/occt.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IntCurvesFace_Intersector.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Lin.hxx>

#include <cmath>
#include <memory>
#include <vector>

struct OcctFace {
    Handle(Geom_BSplineSurface) surface;
    TopoDS_Face face;
    double tolerance;
    std::unique_ptr<IntCurvesFace_Intersector> intersector;   // made for the first line, when all trims are there
};

namespace {

// Open CASCADE has each knot once, with its multiplicity.
struct Knots {
    std::vector<double> value;
    std::vector<int> multiplicity;
    Knots(const double *knots, int count)
    {
        for (int i = 0; i < count; i++) {
            if (!value.empty() && value.back() == knots[i]) multiplicity.back()++;
            else value.push_back(knots[i]), multiplicity.push_back(1);
        }
    }
    TColStd_Array1OfReal values() const { return TColStd_Array1OfReal(value[0], 1, int(value.size())); }
    TColStd_Array1OfInteger multiplicities() const
    {
        return TColStd_Array1OfInteger(multiplicity[0], 1, int(multiplicity.size()));
    }
};

}

OcctFace *occt_face_new(int order_u, int order_v, int n_u, int n_v, const double *knots_u, const double *knots_v,
                        const double *points, double tolerance)
try {
    TColgp_Array2OfPnt poles(1, n_u, 1, n_v);
    TColStd_Array2OfReal weights(1, n_u, 1, n_v);
    for (int j = 0; j < n_v; j++)
        for (int i = 0; i < n_u; i++) {
            const double *p = points + 4 * (j * n_u + i);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
            weights.SetValue(i + 1, j + 1, p[3]);
        }
    Knots u(knots_u, n_u + order_u), v(knots_v, n_v + order_v);
    auto f = std::make_unique<OcctFace>();
    f->tolerance = tolerance;
    f->surface = new Geom_BSplineSurface(poles, weights, u.values(), v.values(), u.multiplicities(), v.multiplicities(),
                                         order_u - 1, order_v - 1);
    f->face = BRepBuilderAPI_MakeFace(f->surface, tolerance).Face();
    return f.release();
} catch (const Standard_Failure &) {
    return nullptr;
}

int occt_face_trim(OcctFace *f, int order, int n, const double *knots, const double *points)
try {
    TColgp_Array1OfPnt2d poles(1, n);
    TColStd_Array1OfReal weights(1, n);
    for (int i = 0; i < n; i++) {
        poles.SetValue(i + 1, gp_Pnt2d(points[3 * i], points[3 * i + 1]));
        weights.SetValue(i + 1, points[3 * i + 2]);
    }
    Knots k(knots, n + order);
    Handle(Geom2d_BSplineCurve) curve = new Geom2d_BSplineCurve(poles, weights, k.values(), k.multiplicities(), order - 1);
    TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve, f->surface).Edge()).Wire();
    BRepLib::BuildCurves3d(wire);
    BRepBuilderAPI_MakeFace face(f->face, wire);
    f->face = face.Face();
    return 1;
} catch (const Standard_Failure &) {
    return 0;
}

double occt_face_nearest(OcctFace *f, const double o[3], const double d[3], double t_min, double t_max)
{
    if (!f->intersector) f->intersector = std::make_unique<IntCurvesFace_Intersector>(f->face, f->tolerance);
    double nearest = INFINITY;
    if (!(t_max < 1e30)) t_max = 1e30;
    f->intersector->Perform(gp_Lin(gp_Pnt(o[0], o[1], o[2]), gp_Dir(d[0], d[1], d[2])), t_min, t_max);
    if (!f->intersector->IsDone()) return nearest;
    for (int i = 1; i <= f->intersector->NbPnt(); i++) {
        double t = f->intersector->WParameter(i);
        if (t > t_min && t < t_max && t < nearest) nearest = t;
    }
    return nearest;
}

void occt_face_free(OcctFace *f) { delete f; }
