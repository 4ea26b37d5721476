// Do the simulated sensors and pose sources fail as the real ones do? Every model is measured on
// test charts and compared with published figures, or said to be fitted to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/recording_checks.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/sensor_checks.h"
#include "experiments/studies/sensor_results.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

using Kind = SensorMeasurement::Kind;

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases = RecordingCases(request);
  for (const SensorMeasurement& measurement : SensorMeasurements()) {
    for (const uint64_t seed : SeedsOf(request)) {
      cases.push_back({LabelsOf(measurement), seed, std::nullopt, Config()});
    }
  }
  return cases;
}

RunOutcome Run(const RunInput& input) {
  input.progress("", 0, 0);  // ends here once the user interrupts
  if (IsRecording(input.study_case)) return MeasureRecording(input);
  for (const SensorMeasurement& measurement : SensorMeasurements()) {
    if (LabelsOf(measurement) != input.study_case.labels) continue;
    return {true, MeasureSensor(measurement, input.study_case.seed)};
  }
  return {false, {}};
}

std::string PlaceOf(const SensorMeasurement& what) {
  switch (what.kind) {
    case Kind::kWall:
      return fmt::format("wall at {} m", what.distance);
    case Kind::kWires:
      return fmt::format("{} mm at {} m{}{}", what.diameter_mm, what.distance,
                         what.albedo == 0.7 ? "" : fmt::format(", albedo {}", what.albedo),
                         what.filter ? "" : ", no filter");
    case Kind::kPoses:
      break;
  }
  return fmt::format("{} frames", what.frames);
}

std::string BandText(const SensorCheck& check) {
  if (check.least <= 0) return fmt::format("<= {:.3g}", check.greatest);
  if (std::isinf(check.greatest)) return fmt::format(">= {:.3g}", check.least);
  return fmt::format("{:.3g} to {:.3g}", check.least, check.greatest);
}

std::vector<std::string> CheckRow(const SensorCheck& check, const MeasuredSensors& measured) {
  const std::optional<Spread> spread = measured.Find(check.measurement, check.figure);
  // Every seed must pass: bands are wide enough.
  const bool pass = spread && spread->least >= check.least && spread->greatest <= check.greatest;
  const int decimals = check.greatest < 1.01 ? 3 : 2;
  return {check.measurement.subject,    check.figure,          PlaceOf(check.measurement),
          BasisName(check.basis),       check.source,          BandText(check),
          SpreadText(spread, decimals), pass ? "pass" : "FAIL"};
}

SensorMeasurement WiresBefore(const std::string& sensor, double distance, double diameter_mm) {
  return {
      .kind = Kind::kWires, .subject = sensor, .distance = distance, .diameter_mm = diameter_mm};
}

SensorMeasurement KinectBeforeWires(size_t distance, size_t diameter, bool filter) {
  SensorMeasurement wires =
      WiresBefore("kinect_v1", RecallDistances()[distance], RecallDiameters_mm()[diameter]);
  wires.filter = filter;
  return wires;
}

double Recall(const MeasuredSensors& measured, size_t distance, size_t diameter, bool filter) {
  const auto spread = measured.Find(KinectBeforeWires(distance, diameter, filter), "recall");
  return spread ? spread->median : std::nan("");
}

// The greatest amount by which a thicker or nearer wire is recalled less.
struct RecallOrder {
  double by_diameter = 0;
  double by_distance = 0;
};

RecallOrder OrderOf(const MeasuredSensors& measured, bool filter) {
  RecallOrder worst;
  for (size_t i = 0; i < RecallDistances().size(); ++i) {
    for (size_t k = 0; k < RecallDiameters_mm().size(); ++k) {
      const double here = Recall(measured, i, k, filter);
      if (std::isnan(here)) return {HUGE_VAL, HUGE_VAL};
      if (k > 0)
        worst.by_diameter = std::max(worst.by_diameter, Recall(measured, i, k - 1, filter) - here);
      if (i > 0)
        worst.by_distance = std::max(worst.by_distance, here - Recall(measured, i - 1, k, filter));
    }
  }
  return worst;
}

// Where nearly all is recalled, order is a matter of single pixels: 1 % is allowed.
std::vector<std::string> OrderRow(const std::string& name, double worst) {
  constexpr double kAllowed = 0.01;
  return {"kinect_v1",
          "recall",
          name,
          "predicted",
          "monotone",
          "<= 0.01",
          fmt::format("{:.3f}", worst),
          worst <= kAllowed ? "pass" : "FAIL"};
}

Table CheckTable(const MeasuredSensors& measured) {
  Table table{
      {"subject", "figure", "where", "basis", "source", "band", "measured", "result"}, {}, 5};
  for (const SensorCheck& check : SensorChecks()) table.rows.push_back(CheckRow(check, measured));
  for (const bool filter : {true, false}) {
    const RecallOrder worst = OrderOf(measured, filter);
    const char* where = filter ? "" : ", no filter";
    table.rows.push_back(
        OrderRow(fmt::format("fall to a thicker wire{}", where), worst.by_diameter));
    table.rows.push_back(
        OrderRow(fmt::format("rise to a farther wire{}", where), worst.by_distance));
  }
  return table;
}

// With the filter of small components, without, and in brackets the prototype's, which had none.
Table RecallTable(const MeasuredSensors& measured) {
  Table table{{"distance (m)"}, {}, 1};
  for (const double diameter_mm : RecallDiameters_mm()) {
    table.headings.push_back(fmt::format("{} mm", diameter_mm));
  }
  for (size_t i = 0; i < RecallDistances().size(); ++i) {
    std::vector<std::string> row = {fmt::format("{}", RecallDistances()[i])};
    for (size_t k = 0; k < RecallDiameters_mm().size(); ++k) {
      row.push_back(fmt::format("{:.2f} / {:.2f} ({:.2f})", Recall(measured, i, k, true),
                                Recall(measured, i, k, false), PrototypeRecall(i, k)));
    }
    table.rows.push_back(row);
  }
  return table;
}

constexpr const char* kSensors[] = {"kinect_v1", "kinect_v2", "azure_kinect", "sr300", "d400"};
constexpr const char* kSources[] = {"orbslam2", "bundlefusion", "kinfu", "kitchen", "ptam"};
constexpr int kLengths[] = {150, 300, 500, 750, 900, 1500};

Table OtherSensorsTable(const MeasuredSensors& measured) {
  Table table{{"sensor"}, {}, 1};
  for (const double diameter_mm : SensorDiameters_mm()) {
    table.headings.push_back(fmt::format("{} mm", diameter_mm));
  }
  for (const char* sensor : kSensors) {
    std::vector<std::string> row = {sensor};
    for (const double diameter_mm : SensorDiameters_mm()) {
      row.push_back(SpreadText(measured.Find(WiresBefore(sensor, 0.7, diameter_mm), "recall"), 2));
    }
    table.rows.push_back(row);
  }
  return table;
}

Table PoseTable(const MeasuredSensors& measured) {
  Table table{{"poses", "frames", "ATE (mm)", "RPE 1 s (mm)", "RPE 1 s (degrees)"}, {}, 1};
  for (const char* source : kSources) {
    for (const int frames : kLengths) {
      const SensorMeasurement poses{.kind = Kind::kPoses, .subject = source, .frames = frames};
      table.rows.push_back({source, std::to_string(frames),
                            SpreadText(measured.Find(poses, "ate_mm"), 1),
                            SpreadText(measured.Find(poses, "rpe_mm"), 1),
                            SpreadText(measured.Find(poses, "rpe_degree"), 2)});
    }
  }
  return table;
}

// Blocks: the wall (0), recall by distance (1 to 4), by sensor (5 to 9), ATE by source (10 to 14).
std::string PlotData(const MeasuredSensors& measured) {
  std::string data;
  for (const SensorCheck& check : SensorChecks()) {
    const SensorMeasurement& what = check.measurement;
    if (what.kind != Kind::kWall || what.subject != "kinect_v1" || check.figure != "sigma_mm") {
      continue;
    }
    data += fmt::format("{} {}\n", what.distance, measured.Data(what, "sigma_mm"));
  }
  for (size_t i = 0; i < RecallDistances().size(); ++i) {
    data += "\n\n";
    for (size_t k = 0; k < RecallDiameters_mm().size(); ++k) {
      data += fmt::format("{} {} {}\n", RecallDiameters_mm()[k],
                          measured.Data(KinectBeforeWires(i, k, true), "recall"),
                          Recall(measured, i, k, false));
    }
  }
  for (const char* sensor : kSensors) {
    data += "\n\n";
    for (const double diameter_mm : SensorDiameters_mm()) {
      data += fmt::format("{} {}\n", diameter_mm,
                          measured.Data(WiresBefore(sensor, 0.7, diameter_mm), "recall"));
    }
  }
  for (const char* source : kSources) {
    data += "\n\n";
    for (const int frames : kLengths) {
      const SensorMeasurement poses{.kind = Kind::kPoses, .subject = source, .frames = frames};
      data += fmt::format("{} {}\n", frames / 30.0, measured.Data(poses, "ate_mm"));
    }
  }
  return data;
}

// One curve a name, from data blocks that begin at `first`.
template <class Names>
std::string Curves(const Names& names, int first, const std::string& unit) {
  std::vector<std::string> curves;
  for (size_t i = 0; i < std::size(names); ++i) {
    curves.push_back(fmt::format("data index {} using 1:2:3:4 with yerrorlines lt {} title '{}{}'",
                                 first + i, i + 1, names[i], unit));
  }
  return fmt::format("{}", fmt::join(curves, ", "));
}

std::string PlotCommands(double greatest_ate_mm) {
  std::string unfiltered;
  for (size_t i = 0; i < RecallDistances().size(); ++i) {
    unfiltered +=
        fmt::format(", data index {} using 1:5 with lines dashtype 3 lt {}", i + 1, i + 1);
  }
  return "set datafile missing '?'\nset key noenhanced samplen 1.5 font ',7'\n"
         "set multiplot layout 2,2 margins 0.11,0.98,0.12,0.94 spacing 0.12,0.20\n"
         "set title 'Kinect V1: noise before a wall'\nset xlabel 'Distance (m)'\n"
         "set ylabel 'Standard deviation (mm)'\nset key top left\nset yrange [0:*]\n"
         "set xrange [0.7:2.5]\n"
         "plot data index 0 using 1:2:3:4 with yerrorbars lt 1 title 'simulated', "
         "1.425*x*x with lines lt 2 title 'Khoshelham 2012', "
         "1.2+1.9*(x-0.4)**2 with lines lt 3 title 'Nguyen 2012'\n"
         "set title 'Kinect V1: recall (dotted: no filter)'\n"
         "set xlabel 'Diameter (mm)'\nset ylabel 'Recall'\nset key bottom right\n"
         "set yrange [0:1.05]\nset xrange [0:12.5]\n"
         "plot " +
         Curves(RecallDistances(), 1, " m") + unfiltered +
         "\nset title 'Recall of wires at 0.7 m by sensor'\nplot " + Curves(kSensors, 5, "") +
         "\nset title 'Absolute trajectory error'\nset xlabel 'Length of the scan (s)'\n"
         "set ylabel 'ATE (mm)'\nset key at graph 0.99,0.42\nset xrange [0:55]\n" +
         fmt::format("set yrange [0:{}]\nplot ", 1.1 * greatest_ate_mm) + Curves(kSources, 10, "") +
         "\nunset multiplot";
}

void Report(const StudyResults& results) {
  const MeasuredSensors measured(results);
  WriteTable(results.folder, results.stem, CheckTable(measured));
  WriteTable(results.folder, results.stem + "_recordings", RecordingTable(results));
  WriteTable(results.folder, results.stem + "_recall", RecallTable(measured));
  WriteTable(results.folder, results.stem + "_sensors", OtherSensorsTable(measured));
  WriteTable(results.folder, results.stem + "_poses", PoseTable(measured));
  DrawPlot(results.folder, results.stem,
           {PlotData(measured), PlotCommands(GreatestOf(results.runs, "ate_mm", 20)), 6.8, 5.4});
}

}  // namespace

Study SensorValidationStudy() {
  return {"sensor-validation",
          "Do the simulated sensors and pose sources fail as the real ones do?", Cases, Run,
          Report};
}

}  // namespace curvefusion
