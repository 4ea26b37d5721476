#include <fmt/format.h>

#include <string>

#include "graph/io/graph_formats.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

// What comes before the curves: a product of AP214 and its units (ISO 10303-214, -41, -42); #13 is
// the context of the geometry, #8 the shape.
constexpr const char* kProduct =
    "#1=APPLICATION_CONTEXT('automotive design');\n"
    "#2=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);\n"
    "#3=PRODUCT_CONTEXT('',#1,'mechanical');\n"
    "#4=PRODUCT('wires','wires','',(#3));\n"
    "#5=PRODUCT_DEFINITION_FORMATION('','',#4);\n"
    "#6=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n"
    "#7=PRODUCT_DEFINITION('design','',#5,#6);\n"
    "#8=PRODUCT_DEFINITION_SHAPE('','',#7);\n"
    "#9=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#10=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
    "#11=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
    "#12=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#9,'distance_accuracy_value','');\n"
    "#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#12))"
    "GLOBAL_UNIT_ASSIGNED_CONTEXT((#9,#10,#11))REPRESENTATION_CONTEXT('',''));\n";
constexpr int kFirstFree = 14;  // derived: #13 is the last of kProduct

// A real of STEP has a decimal point.
std::string Real(double value) { return fmt::format("{:#.15G}", value); }

// Entities with numbers that count up.
class StepText {
 public:
  int Add(const std::string& entity) {
    text_ += fmt::format("#{}={};\n", next_, entity);
    return next_++;
  }
  int AddSpline(EdgeId edge, const CubicSpline& spline) {
    std::string points;
    for (const Vec3& p : spline.points) {
      const Vec3 mm = p / kMillimetre;
      const int point = Add(
          fmt::format("CARTESIAN_POINT('',({},{},{}))", Real(mm.x()), Real(mm.y()), Real(mm.z())));
      points += fmt::format("{}#{}", points.empty() ? "" : ",", point);
    }
    std::string multiplicities;
    std::string knots;
    for (size_t i = 0; i < spline.knots.size();) {
      size_t next = i;
      while (next < spline.knots.size() && spline.knots[next] == spline.knots[i]) ++next;
      const char* comma = i == 0 ? "" : ",";
      multiplicities += fmt::format("{}{}", comma, next - i);
      knots += fmt::format("{}{}", comma, Real(spline.knots[i] / kMillimetre));
      i = next;
    }
    return Add(fmt::format(
        "B_SPLINE_CURVE_WITH_KNOTS('edge {}',3,({}),.UNSPECIFIED.,.U.,.U.,({}),({}),.UNSPECIFIED.)",
        edge, points, multiplicities, knots));
  }
  const std::string& text() const { return text_; }

 private:
  int next_ = kFirstFree;
  std::string text_;
};

}  // namespace

void WriteStepSplines(const std::filesystem::path& path, const FittedCurves& fitted) {
  StepText step;
  std::string curves;
  for (const auto& [edge, spline] : fitted) {
    curves += fmt::format("{}#{}", curves.empty() ? "" : ",", step.AddSpline(edge, spline));
  }
  const int set = step.Add(fmt::format("GEOMETRIC_CURVE_SET('wires',({}))", curves));
  const int shape = step.Add(
      fmt::format("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('wires',(#{}),#13)", set));
  step.Add(fmt::format("SHAPE_DEFINITION_REPRESENTATION(#8,#{})", shape));
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    // Without a date, so that the same curves give the same bytes.
    stream << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('wires as cubic B-splines'),'2;1');\n"
              "FILE_NAME('','',(''),(''),'CurveFusion','','');\n"
              "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
           << kProduct << step.text() << "ENDSEC;\nEND-ISO-10303-21;\n";
  });
}

}  // namespace curvefusion
