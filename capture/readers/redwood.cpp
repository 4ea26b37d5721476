#include <fmt/format.h>

#include <limits>
#include <map>

#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/text_lines.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr double kMillimetreUnits = 1000;

double NumberAt(const TextLine& line, size_t column, const std::filesystem::path& path) {
  const auto number = column < line.fields.size() ? ParseNumber(line.fields[column]) : std::nullopt;
  if (number) return *number;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}:{}: column {} is no number; poses are one line of three numbers and "
                          "four lines of a 4x4 matrix",
                          path.string(), line.number, column + 1));
}

// Poses by the first number of their header line.
std::map<int, RigidTransform> ReadTrajectoryLog(const std::filesystem::path& path,
                                                const FindingHandler& on_finding) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.size() % 5 != 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has {} lines, not a multiple of 5; a pose is a header line and "
                            "four lines of a 4x4 matrix",
                            path.string(), lines.size()));
  }
  std::map<int, RigidTransform> poses;
  for (size_t i = 0; i < lines.size(); i += 5) {
    const double number = NumberAt(lines[i], 0, path);
    if (!(number >= 0 && number <= std::numeric_limits<int>::max())) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}:{}: {} is no frame number", path.string(),
                                                    lines[i].number, number));
    }
    const int frame = static_cast<int>(number);
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        matrix(row, column) = NumberAt(lines[i + 1 + row], column, path);
      }
    }
    const std::string what =
        fmt::format("{}:{}: pose of frame {}", path.string(), lines[i].number, frame);
    const auto pose = RigidFromMatrix(matrix, what, on_finding);
    if (pose && !poses.emplace(frame, *pose).second) {
      on_finding({Severity::kWarning,
                  fmt::format("{} stands there more than once; the first is used", what)});
    }
  }
  return poses;
}

Sequence ReadWith(const std::filesystem::path& folder, const PoseLookup& find_pose,
                  const FindingHandler& on_finding) {
  Sequence sequence;
  UseIntrinsics(ReadRedwoodIntrinsics(folder / "intrinsic.json", on_finding), kMillimetreUnits,
                sequence);
  AddFrames(ImagesByFrameNumber(ColorFolder(folder)), DepthByFrameNumber(folder), find_pose,
            sequence);
  return sequence;
}

}  // namespace

Sequence ReadRedwood(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  const auto poses = ReadTrajectoryLog(folder / "trajectory.log", on_finding);
  const auto find_pose = [&poses](int rank, const std::filesystem::path&) {
    const auto pose = poses.find(rank);
    return pose == poses.end() ? std::optional<RigidTransform>() : pose->second;
  };
  return ReadWith(folder, find_pose, on_finding);
}

Sequence ReadRedwoodImages(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, NoPose, on_finding);
}

}  // namespace curvefusion
