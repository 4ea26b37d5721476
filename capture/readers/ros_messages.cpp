#include "capture/readers/ros_messages.h"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "capture/trajectory.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr std::uint32_t kMaxSide = 65536;       // pixels, as in intrinsics.json
constexpr std::uint32_t kMaxCoefficients = 64;  // chosen: the longest lens model of ROS has 14
constexpr size_t kIntrinsicMatrix = 9;

// One value after the other; little-endian, without gaps.
class Fields {
 public:
  Fields(std::string_view message, const std::string& where) : rest_(message), where_(where) {}

  template <class T>
  T Next() {
    T value{};
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string Text() { return std::string(Take(Next<std::uint32_t>())); }
  // std_msgs/Header: a number, a stamp and the name of a frame.
  double Header() {
    Next<std::uint32_t>();
    const auto seconds = Next<std::uint32_t>();
    const auto nanoseconds = Next<std::uint32_t>();
    Text();
    return seconds + 1e-9 * nanoseconds;
  }
  int Side() {
    const auto pixels = Next<std::uint32_t>();
    if (pixels >= 1 && pixels <= kMaxSide) return static_cast<int>(pixels);
    Fail(fmt::format("an image side of {} pixels; 1 to {} can be", pixels, kMaxSide));
  }
  size_t left() const { return rest_.size(); }
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kBadInput, where_ + ": " + what);
  }

 private:
  std::string_view Take(size_t count) {
    if (count > rest_.size()) Fail("its message ends too early");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
  const std::string& where_;
};

}  // namespace

RosImage ParseRosImage(const std::string& head, const std::string& where) {
  Fields fields(head, where);
  RosImage image;
  image.stamp = fields.Header();
  image.height = fields.Side();
  image.width = fields.Side();
  image.encoding = fields.Text();
  image.is_big_endian = fields.Next<std::uint8_t>() != 0;
  image.row_bytes = fields.Next<std::uint32_t>();
  image.pixel_bytes = fields.Next<std::uint32_t>();
  image.pixel_offset = head.size() - fields.left();
  return image;
}

RosCamera ParseCameraInfo(const std::string& message, const std::string& where) {
  Fields fields(message, where);
  RosCamera read;
  fields.Header();
  read.camera.height = fields.Side();
  read.camera.width = fields.Side();
  read.lens = fields.Text();
  const auto count = fields.Next<std::uint32_t>();
  if (count > kMaxCoefficients) fields.Fail(fmt::format("{} lens coefficients", count));
  for (std::uint32_t i = 0; i < count; ++i) read.coefficients.push_back(fields.Next<double>());
  double k[kIntrinsicMatrix];  // row by row
  for (double& value : k) value = fields.Next<double>();
  read.camera.fx = k[0];
  read.camera.cx = k[2];
  read.camera.fy = k[4];
  read.camera.cy = k[5];
  return read;
}

RigidTransform ParseTransform(const std::string& message, const std::string& where) {
  Fields fields(message, where);
  Vec3 translation;
  for (int i = 0; i < 3; ++i) translation[i] = fields.Next<double>();
  Eigen::Quaterniond rotation;
  for (int i = 0; i < 4; ++i) rotation.coeffs()[i] = fields.Next<double>();  // x, y, z, w
  const auto fail = [](const CheckFinding& finding) {
    throw Error(ErrorKind::kBadInput, finding.message);
  };
  return *RigidFromQuaternion(rotation, translation, where, fail);
}

float ParseFloat(const std::string& message, const std::string& where) {
  return Fields(message, where).Next<float>();
}

}  // namespace curvefusion
