#include "capture/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "capture/jpeg.h"
#include "capture/png.h"
#include "kernel/error.h"
#include "kernel/text_input.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

template <class Act>
std::string Rejection(const Act& act) {
  return MessageOf(ErrorKind::kBadInput, act);
}

cv::Mat Noise(int type) {
  cv::Mat noise(37, 53, type);
  cv::randu(noise, 0, noise.depth() == CV_16U ? 65536 : 256);
  return noise;
}

class ImageFileTest : public testing::Test {
 protected:
  std::filesystem::path Path(const char* name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
};

TEST_F(ImageFileTest, DepthKeepsItsSixteenBits) {
  WriteDepthPng(Path("d.png"), 5, 3, 60000);
  const Image<uint16_t> depth = DecodeDepthImage(Path("d.png"));
  EXPECT_EQ(depth.width(), 5);
  EXPECT_EQ(depth.height(), 3);
  EXPECT_EQ(depth(4, 2), 60004);
}

TEST_F(ImageFileTest, ColourIsRgb) {
  WriteColor(Path("c.png"), 5, 3);
  WriteColor(Path("c.jpg"), 16, 16);
  EXPECT_EQ(DecodeColorImage(Path("c.png"))(4, 2), (Rgb{200, 100, 50}));
  EXPECT_NEAR(DecodeColorImage(Path("c.jpg"))(4, 2)[0], 200, 3);  // JPEG is lossy
}

TEST_F(ImageFileTest, GreyColourImagesHaveThreeEqualChannels) {
  WriteGreyPng(Path("g.png"), 5, 3);
  EXPECT_EQ(DecodeColorImage(Path("g.png"))(1, 1), (Rgb{90, 90, 90}));
}

TEST_F(ImageFileTest, HeadersTellSizeAndBits) {
  WriteDepthPng(Path("d.png"), 50, 30, 1000);
  WriteColor(Path("c.jpg"), 40, 20);
  const ImageHeader depth = ReadImageHeader(Path("d.png"));
  EXPECT_EQ(depth.defect, "");
  EXPECT_EQ(depth.width, 50);
  EXPECT_EQ(depth.height, 30);
  EXPECT_EQ(depth.bits, 16);
  EXPECT_EQ(depth.channels, 1);
  const ImageHeader color = ReadImageHeader(Path("c.jpg"));
  EXPECT_EQ(color.defect, "");
  EXPECT_EQ(color.width, 40);
  EXPECT_EQ(color.height, 20);
  EXPECT_EQ(color.bits, 8);
  EXPECT_EQ(color.channels, 3);
}

// OpenCV decodes a JPEG that is cut off to a full-size image without a word.
TEST_F(ImageFileTest, EveryTruncationIsFound) {
  for (const char* name : {"c.jpg", "d.png"}) {
    for (const double share : {0.0, 0.01, 0.02, 0.3, 0.6, 0.9, 0.98}) {
      WriteColor(Path("c.jpg"), 64, 48);
      WriteDepthPng(Path("d.png"), 64, 48, 1000);
      Truncate(Path(name), share);
      EXPECT_NE(ReadImageHeader(Path(name)).defect, "") << name << " cut to " << share;
      EXPECT_THROW(DecodeColorImage(Path(name)), Error) << name << " cut to " << share;
    }
  }
}

TEST_F(ImageFileTest, BytesAfterTheEndMarkerAreFine) {
  WriteColor(Path("c.jpg"), 64, 48);
  std::ofstream(Path("c.jpg"), std::ios::app | std::ios::binary) << std::string(30, '\0');
  EXPECT_EQ(ReadImageHeader(Path("c.jpg")).defect, "");
}

TEST_F(ImageFileTest, ABrokenPngIsFoundWhenDecoded) {
  WriteDepthPng(Path("d.png"), 64, 48, 1000);
  std::fstream stream(Path("d.png"), std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(60);
  stream << "garbage in the compressed pixels";
  stream.close();
  EXPECT_EQ(ReadImageHeader(Path("d.png")).defect, "");
  EXPECT_THAT(Rejection([&] { DecodeDepthImage(Path("d.png")); }),
              HasSubstr("d.png: is damaged (wrong checksum in its part IDAT)"));
}

// In the text of a PNG, which no decoder needs, a wrong byte changes nothing but tells of a damage.
TEST_F(ImageFileTest, EveryByteOfAPngIsCovered) {
  WriteDepthPng(Path("d.png"), 16, 8, 1000);
  const std::string bytes = ReadFile(Path("d.png"));
  for (size_t at = 8; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    WriteText(Path("d.png"), damaged);
    EXPECT_THROW(DecodeDepthImage(Path("d.png")), Error) << "byte " << at;
  }
}

void ExpectDecodedAsByOpenCv(const std::filesystem::path& path) {
  const cv::Mat expected = cv::imread(path.string(), cv::IMREAD_COLOR);
  const ColorImage image = DecodeColorImage(path);
  ASSERT_EQ(image.width(), expected.cols);
  ASSERT_EQ(image.height(), expected.rows);
  for (int v = 0; v < expected.rows; ++v) {
    for (int u = 0; u < expected.cols; ++u) {
      const cv::Vec3b bgr = expected.at<cv::Vec3b>(v, u);
      ASSERT_EQ(image(u, v), (Rgb{bgr[2], bgr[1], bgr[0]})) << path << " " << u << ", " << v;
    }
  }
}

// The pixels are those of OpenCV, with which everything was measured.
TEST_F(ImageFileTest, JpegsAreDecodedAsByOpenCv) {
  for (const int type : {CV_8UC3, CV_8UC1}) {
    cv::imwrite(Path("c.jpg").string(), Noise(type));
    ExpectDecodedAsByOpenCv(Path("c.jpg"));
  }
}

TEST_F(ImageFileTest, PngsAreDecodedAsByOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}) {
    cv::imwrite(Path("c.png").string(), Noise(type));
    ExpectDecodedAsByOpenCv(Path("c.png"));
  }
  cv::imwrite(Path("c.png").string(), Noise(CV_8UC1) > 127, {cv::IMWRITE_PNG_BILEVEL, 1});
  ExpectDecodedAsByOpenCv(Path("c.png"));
}

// Bytes that this program writes, read by OpenCV.
TEST_F(ImageFileTest, WrittenPngsAndJpegsAreReadByOpenCv) {
  Image<uint16_t> depth(53, 37);
  ColorImage color(53, 37);
  for (size_t i = 0; i < depth.size(); ++i) {
    depth.data()[i] = static_cast<uint16_t>(37 * i);
    color.data()[i] = {static_cast<uint8_t>(i), static_cast<uint8_t>(2 * i), 40};
  }
  WriteText(Path("d.png"), EncodePng(depth));
  WriteText(Path("c.png"), EncodePng(color));
  WriteText(Path("c.jpg"), EncodeJpeg(color, 95));
  const cv::Mat read = cv::imread(Path("d.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_16UC1);
  EXPECT_EQ(read.at<uint16_t>(36, 52), depth(52, 36));
  EXPECT_EQ(DecodeDepthImage(Path("d.png"))(52, 36), depth(52, 36));
  ExpectDecodedAsByOpenCv(Path("c.png"));
  ExpectDecodedAsByOpenCv(Path("c.jpg"));
  EXPECT_EQ(DecodeColorImage(Path("c.png"))(52, 36), color(52, 36));
}

TEST_F(ImageFileTest, HostileSizesAreFoundInTheHeader) {
  WriteColor(Path("c.png"), 8, 8);
  std::string bytes = ReadFile(Path("c.png"));
  bytes.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8));
  WriteText(Path("c.png"), bytes);
  EXPECT_THAT(ReadImageHeader(Path("c.png")).defect, HasSubstr("has more than 268435456 pixels"));
}

TEST_F(ImageFileTest, DamagedJpegDataAreNamedWithTheirFile) {
  cv::Mat noise(64, 64, CV_8UC3);
  cv::randu(noise, 0, 256);
  cv::imwrite(Path("c.jpg").string(), noise);
  const std::string bytes = ReadFile(Path("c.jpg"));
  std::string damaged = bytes;
  damaged.replace(bytes.size() / 2, 2, "\xff\xd9");  // an end in the middle of the pixels
  WriteText(Path("c.jpg"), damaged);
  testing::internal::CaptureStderr();
  const std::string message = Rejection([&] { DecodeColorImage(Path("c.jpg")); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // libjpeg has no word of its own
  EXPECT_THAT(message, HasSubstr("c.jpg: is damaged (Corrupt JPEG data"));
  EXPECT_THAT(message, HasSubstr("copy it again, or leave the frame out"));
}

TEST_F(ImageFileTest, BytesBetweenMarkersAreARemark) {
  WriteColor(Path("c.jpg"), 16, 16);
  std::string bytes = ReadFile(Path("c.jpg"));
  bytes.insert(bytes.rfind("\xff\xd9"), std::string(40, 'a'));  // more than is read ahead
  WriteText(Path("c.jpg"), bytes);
  std::string remark;
  DecodeColorImage(Path("c.jpg"), {}, &remark);
  EXPECT_THAT(remark, HasSubstr("extraneous bytes before marker"));
}

TEST_F(ImageFileTest, APipeIsNoImageAndIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(Path("p.png").c_str(), 0600), 0);
  EXPECT_THAT(ReadImageHeader(Path("p.png")).defect, HasSubstr("is a pipe"));
  EXPECT_THROW(DecodeColorImage(Path("p.png")), Error);
}

TEST_F(ImageFileTest, EightBitDepthIsRefused) {
  WriteGreyPng(Path("d.png"), 8, 8);
  EXPECT_THAT(Rejection([&] { DecodeDepthImage(Path("d.png")); }),
              HasSubstr("has 8 bits and 1 channels, depth needs 16 bits"));
}

TEST_F(ImageFileTest, MissingAndForeignFilesAreNamed) {
  EXPECT_THAT(Rejection([&] { DecodeColorImage(Path("none.jpg")); }),
              HasSubstr("none.jpg: is not there"));
  WriteText(Path("text.png"), "this is no picture");
  EXPECT_THAT(Rejection([&] { DecodeColorImage(Path("text.png")); }),
              HasSubstr("neither a PNG nor a JPEG"));
}

}  // namespace
}  // namespace curvefusion
