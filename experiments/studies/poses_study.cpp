// Which poses are good enough? BundleFusion "performed as well as ORB-SLAM", KinFu gives
// "reasonable camera calibration", PTAM "failed to provide sufficient quality camera calibration"
// (CurveFusion 5, Effect of different camera calibration). And is the factory calibration between
// colour and depth good enough, on which no registration was run ("insufficient", 4)? "It is
// desirable to employ both visual and geometric features": our tracker with and without colour.
#include "capture/content/colour_findings.h"
#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "experiments/metrics/trajectory_metrics.h"
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "fusion/tracking/track_sequence.h"
#include "fusion/tracking/tracked_poses.h"

namespace curvefusion {

namespace {

constexpr FrameCounts kFrames = {.quick = 30};

struct Calibration {
  const char* poses;  // a pose source of the simulator, or what our tracker is given
  Registration colour;
};
constexpr const char* kTracked = "depth and colour";
constexpr const char* kTrackedByDepth = "depth alone";

constexpr Calibration kCalibrations[] = {
    {"true", Registration::kRegistered},         {"orbslam2", Registration::kRegistered},
    {"bundlefusion", Registration::kRegistered}, {"kinfu", Registration::kRegistered},
    {"ptam", Registration::kRegistered},         {"orbslam2", Registration::kRaw},
    {kTracked, Registration::kRegistered},       {kTrackedByDepth, Registration::kRegistered}};

bool IsTracked(const std::string& poses) { return poses == kTracked || poses == kTrackedByDepth; }

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const Calibration& calibration : kCalibrations) {
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan = ObjectScan(request, "cat", seed, kFrames);
      if (!IsTracked(calibration.poses)) scan.pose_source = calibration.poses;
      scan.color.registration = calibration.colour;
      for (const Profile profile : request.profiles) {
        cases.push_back({{{"poses", calibration.poses},
                          {"colour", RegistrationName(calibration.colour)},
                          {"profile", ProfileName(profile)}},
                         seed,
                         scan,
                         CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

// The absolute trajectory error of the poses of a sequence in millimetres.
double TrajectoryError(const Sequence& sequence, const Trajectory& truth) {
  std::vector<RigidTransform> estimates, true_poses;
  for (const SequenceFrame& frame : sequence.frames) {
    const StampedPose* true_pose = NearestPose(truth, frame.timestamp);
    if (true_pose == nullptr) continue;
    estimates.push_back(frame.T_world_camera);
    true_poses.push_back(true_pose->T_world_camera);
  }
  return AbsoluteTrajectoryError(estimates, true_poses) / kMillimetre;
}

// With the poses of the case: those of the scan, or tracked without looking at them.
Sequence PosedSequence(const RunInput& input) {
  Sequence sequence = OpenSequence(input.scan);
  // As the command does; the paper has the camera's own calibration here.
  if (std::holds_alternative<BestOptions>(input.study_case.config.pipeline)) {
    UseFittedColourCamera(sequence);
  }
  const std::string poses = LabelOf(input.study_case.labels, "poses");
  if (!IsTracked(poses)) return sequence;
  TrackingOptions options;
  options.use_color = poses == kTracked;
  return TrackSequence(sequence, GivenStart(sequence), options, input.progress).sequence;
}

RunOutcome Run(const RunInput& input) {
  const Sequence sequence = PosedSequence(input);
  InterruptibleObserver observer(input.progress);
  const Reconstruction result = Reconstruct(sequence, input.study_case.config.pipeline, observer);
  RunOutcome outcome = EvaluateAndKeep(result.skeleton, input);
  const Trajectory truth =
      ReadTumTrajectory(input.scan / "truth" / "trajectory.txt", [](const auto&) {});
  outcome.figures["trajectory_error_mm"] = TrajectoryError(sequence, truth);
  outcome.figures["corrected_trajectory_error_mm"] = TrajectoryError(result.sequence, truth);
  return outcome;
}

const std::vector<TableColumn> kColumns = {
    {"F2", "aligned.curves.2mm.f"},
    {"F5", "aligned.curves.5mm.f"},
    {"junction recall", "aligned.junctions_10mm.recall"},
    {"trajectory error (mm)", "trajectory_error_mm"},
    {"after correction (mm)", "corrected_trajectory_error_mm"}};

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"poses", "colour", "profile"}), kColumns));
  DrawBarPanels(results, {"poses", "colour"},
                {{"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Junction recall", "aligned.junctions_10mm.recall"},
                 {"Trajectory error as given (mm)", "trajectory_error_mm"},
                 {"Trajectory error after correction (mm)", "corrected_trajectory_error_mm"}});
}

}  // namespace

Study PosesStudy() {
  return {
      "poses",
      "The cat with poses of four trackers, of our own with and without colour, and true ones, and "
      "with colour that is not registered",
      Cases, Run, Report};
}

}  // namespace curvefusion
