#include "sensors/camera/decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace stereo_nav::camera {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// Smooth, so that JPEG and chroma subsampling change little.
cv::Mat colourScene() {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      image.at<cv::Vec3b>(y, x) = {static_cast<uchar>(40 + x), static_cast<uchar>(60 + 2 * y),
                                   static_cast<uchar>(200 - x - y)};
    }
  }
  return image;
}

std::vector<std::uint8_t> jpegOf(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 92});
  return bytes;
}

const ImageLayout kJpegLayout{PixelFormat::kMjpg, kWidth, kHeight, 0};

double worstDifference(DecodedImage& image, const cv::Mat& expected) {
  return cv::norm(image.view(), expected, cv::NORM_INF);
}

TEST(DecoderJpeg, DecodesToColourAndGrey) {
  const cv::Mat scene = colourScene();
  const auto jpeg = jpegOf(scene);
  DecodedImage image;
  ASSERT_EQ(decode(jpeg.data(), jpeg.size(), kJpegLayout, Encoding::kBgr8, image), "");
  EXPECT_LE(worstDifference(image, scene), 16);
  ASSERT_EQ(decode(jpeg.data(), jpeg.size(), kJpegLayout, Encoding::kMono8, image), "");
  cv::Mat grey;
  cv::cvtColor(scene, grey, cv::COLOR_BGR2GRAY);
  EXPECT_LE(worstDifference(image, grey), 6);
}

TEST(DecoderJpeg, SuppliesTheHuffmanTablesThatWebcamsLeaveOut) {
  auto jpeg = jpegOf(colourScene());
  // Remove every DHT segment (0xff 0xc4, length in two bytes).
  for (std::size_t i = 2; i + 3 < jpeg.size();) {
    if (jpeg[i] != 0xff || jpeg[i + 1] == 0xda) break;
    const std::size_t length = 2u + (static_cast<std::size_t>(jpeg[i + 2]) << 8) + jpeg[i + 3];
    if (jpeg[i + 1] == 0xc4) {
      jpeg.erase(jpeg.begin() + static_cast<std::ptrdiff_t>(i),
                 jpeg.begin() + static_cast<std::ptrdiff_t>(i + length));
    } else {
      i += length;
    }
  }
  DecodedImage image;
  ASSERT_EQ(decode(jpeg.data(), jpeg.size(), kJpegLayout, Encoding::kBgr8, image), "");
  EXPECT_LE(worstDifference(image, colourScene()), 16);
}

TEST(DecoderJpeg, LetsFillingBytesBeforeTheEndPass) {
  auto jpeg = jpegOf(colourScene());
  jpeg.insert(jpeg.end() - 2, {0x00, 0x12, 0x34, 0x00});
  DecodedImage image;
  EXPECT_EQ(decode(jpeg.data(), jpeg.size(), kJpegLayout, Encoding::kBgr8, image), "");
}

TEST(DecoderJpeg, EveryTruncationIsAnError) {
  const auto jpeg = jpegOf(colourScene());
  DecodedImage image;
  for (std::size_t size = 0; size + 2 < jpeg.size(); ++size) {
    const std::vector<std::uint8_t> cut(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(decode(cut.data(), cut.size(), kJpegLayout, Encoding::kBgr8, image), "") << size << " bytes";
  }
}

TEST(DecoderJpeg, CorruptBytesNeverReachBeyondTheImage) {
  const auto jpeg = jpegOf(colourScene());
  std::mt19937 random(7);
  std::uniform_int_distribution<std::size_t> position(0, jpeg.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  DecodedImage image;
  int refused = 0;
  for (int run = 0; run < 5000; ++run) {
    auto broken = jpeg;
    for (int change = 0; change < 1 + run % 8; ++change) {
      broken[position(random)] = static_cast<std::uint8_t>(byte(random));
    }
    const auto encoding = run % 2 == 0 ? Encoding::kBgr8 : Encoding::kMono8;
    const auto problem = decode(broken.data(), broken.size(), kJpegLayout, encoding, image);
    refused += problem.empty() ? 0 : 1;
    if (problem.empty()) {
      EXPECT_EQ(image.pixels.size(), image.step() * kHeight);
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(DecoderJpeg, AnotherSizeIsAnErrorThatNamesBoth) {
  cv::Mat small;
  cv::resize(colourScene(), small, {32, 24});
  const auto jpeg = jpegOf(small);
  DecodedImage image;
  const auto problem = decode(jpeg.data(), jpeg.size(), kJpegLayout, Encoding::kBgr8, image);
  EXPECT_NE(problem.find("32 x 24"), std::string::npos) << problem;
  EXPECT_NE(problem.find("64 x 48"), std::string::npos) << problem;
}

struct RawCase {
  PixelFormat format;
  const char* name;
};

class DecoderRaw : public testing::TestWithParam<RawCase> {
 protected:
  /// One flat colour, luma 150, Cb 90, Cr 170, in rows that are 32 bytes longer than they need be. The
  /// padding is of another value.
  static std::vector<std::uint8_t> flatImage(const ImageLayout& layout) {
    std::vector<std::uint8_t> bytes(imageBytes(layout.format, layout.height, layout.bytes_per_line), 255);
    const auto used = minimumBytesPerLine(layout.format, layout.width);
    for (std::size_t row = 0; row * layout.bytes_per_line < bytes.size(); ++row) {
      const bool chroma_row =
          layout.format == PixelFormat::kNv12 && row >= static_cast<std::size_t>(layout.height);
      for (std::size_t i = 0; i < used; ++i) {
        bytes[row * layout.bytes_per_line + i] = sample(layout.format, i, chroma_row);
      }
    }
    return bytes;
  }

  static std::uint8_t sample(PixelFormat format, std::size_t i, bool chroma_row) {
    constexpr std::uint8_t kYuyv[] = {150, 90, 150, 170};
    constexpr std::uint8_t kUyvy[] = {90, 150, 170, 150};
    if (format == PixelFormat::kYuyv) return kYuyv[i % 4];
    if (format == PixelFormat::kUyvy) return kUyvy[i % 4];
    if (chroma_row) return i % 2 == 0 ? 90 : 170;
    return 150;
  }

  ImageLayout layout() const {
    const auto format = GetParam().format;
    return {format, kWidth, kHeight, minimumBytesPerLine(format, kWidth) + 32};
  }
};

TEST_P(DecoderRaw, GreyIsTheLuma) {
  const auto bytes = flatImage(layout());
  DecodedImage image;
  ASSERT_EQ(decode(bytes.data(), bytes.size(), layout(), Encoding::kMono8, image), "");
  EXPECT_EQ(worstDifference(image, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(150))), 0);
}

TEST_P(DecoderRaw, ColourFollowsBt601) {
  const auto bytes = flatImage(layout());
  DecodedImage image;
  ASSERT_EQ(decode(bytes.data(), bytes.size(), layout(), Encoding::kBgr8, image), "");
  // Limited range: B = 1.164 (Y-16) + 2.018 (Cb-128), G = ... - 0.813 (Cr-128) - 0.391 (Cb-128), R = ...
  // + 1.596 (Cr-128) for Y 150, Cb 90, Cr 170.
  const cv::Scalar expected =
      GetParam().format == PixelFormat::kGrey ? cv::Scalar(150, 150, 150) : cv::Scalar(79, 137, 223);
  EXPECT_LE(worstDifference(image, cv::Mat(kHeight, kWidth, CV_8UC3, expected)), 2);
}

TEST_P(DecoderRaw, TooFewBytesAreAnError) {
  const auto bytes = flatImage(layout());
  DecodedImage image;
  const auto problem = decode(bytes.data(), bytes.size() - 1, layout(), Encoding::kBgr8, image);
  EXPECT_NE(problem.find("incomplete image"), std::string::npos) << problem;
}

INSTANTIATE_TEST_SUITE_P(Formats, DecoderRaw,
                         testing::Values(RawCase{PixelFormat::kYuyv, "Yuyv"},
                                         RawCase{PixelFormat::kUyvy, "Uyvy"},
                                         RawCase{PixelFormat::kGrey, "Grey"},
                                         RawCase{PixelFormat::kNv12, "Nv12"}),
                         [](const auto& test_case) { return test_case.param.name; });

TEST(Decoder, UnknownFormatIsAnError) {
  DecodedImage image;
  const std::uint8_t byte = 0;
  EXPECT_NE(decode(&byte, 1, ImageLayout{}, Encoding::kMono8, image), "");
}

}  // namespace
}  // namespace stereo_nav::camera
