#include "tests/capture/readers/sens_sample.h"

#include <zlib.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace curvefusion {

namespace {

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

SensSample::Matrix Floats(const Eigen::Matrix4d& matrix) {
  SensSample::Matrix floats;
  for (size_t i = 0; i < 16; ++i) {
    floats[i] = static_cast<float>(matrix(static_cast<int>(i / 4), static_cast<int>(i % 4)));
  }
  return floats;
}

SensSample::Matrix Intrinsic(const PinholeCamera& camera) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix(0, 0) = camera.fx;
  matrix(1, 1) = camera.fy;
  matrix(0, 2) = camera.cx;
  matrix(1, 2) = camera.cy;
  return Floats(matrix);
}

std::string GreyPng(const Image<uint8_t>& grey) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png",
               cv::Mat(grey.height(), grey.width(), CV_8UC1, const_cast<uint8_t*>(grey.data())),
               bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string SensSample::Bytes() const {
  std::string bytes;
  Append(bytes, version);
  Append(bytes, static_cast<std::uint64_t>(sensor.size()));
  bytes += sensor;
  for (const Matrix& matrix :
       {intrinsic_color, extrinsic_color, intrinsic_depth, extrinsic_depth}) {
    Append(bytes, matrix);
  }
  Append(bytes, color_compression);
  Append(bytes, depth_compression);
  Append(bytes, color_size);
  Append(bytes, depth_size);
  Append(bytes, depth_shift);
  Append(bytes, static_cast<std::uint64_t>(frames.size()));
  for (const Frame& frame : frames) {
    Append(bytes, frame.camera_to_world);
    Append(bytes, frame.color_stamp);
    Append(bytes, frame.depth_stamp);
    Append(bytes, static_cast<std::uint64_t>(frame.color.size()));
    Append(bytes, static_cast<std::uint64_t>(frame.depth.size()));
    bytes += frame.color + frame.depth;
  }
  Append(bytes, std::uint64_t{0});
  return bytes;
}

SensSample RoomAsSens(const RoomScan& scan) {
  const PinholeCamera& camera = scan.sequence.depth_camera;
  SensSample sample;
  sample.intrinsic_depth = Intrinsic(camera);
  sample.intrinsic_color = Intrinsic(scan.sequence.color_camera);
  sample.extrinsic_color = sample.extrinsic_depth = Floats(Eigen::Matrix4d::Identity());
  sample.color_compression = 1;  // PNG, so that colours are exact
  sample.color_size = sample.depth_size = {static_cast<std::uint32_t>(camera.width),
                                           static_cast<std::uint32_t>(camera.height)};
  sample.depth_shift = 5000;
  for (size_t i = 0; i < scan.sequence.frames.size(); ++i) {
    const Image<uint16_t>& depth = scan.thumbnails.depth[i];
    SensSample::Frame frame;
    frame.camera_to_world = Floats(scan.sequence.frames[i].T_world_camera.matrix());
    frame.depth_stamp = 7'000'000 + i * 1'000'000 / 30;
    frame.color_stamp = frame.depth_stamp + 4000;
    frame.color = GreyPng(scan.thumbnails.grey[i]);
    frame.depth =
        Deflated({reinterpret_cast<const char*>(depth.data()), depth.size() * sizeof(uint16_t)});
    sample.frames.push_back(frame);
  }
  return sample;
}

std::string Deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

void WriteBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace curvefusion
