// Recordings of other programs: compressed and Bayer images, odd stamps, tf without tf_static, files cut off.
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/CompressedImage.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/recording.h"
#include "stereo_nav/ros/topics.h"
#include "support/fixture_bag.h"
#include "support/text.h"
#include "unit/ros/bag_copy.h"

namespace stereo_nav::ros_io {
namespace {

/// The room's recording of three frames, and copies of it.
class ForeignRecordingTest : public ::testing::Test {
 protected:
  using EditImage = std::function<void(sensor_msgs::Image&, rosbag::Bag&, const std::string& topic)>;

  ForeignRecordingTest()
      : folder_(std::filesystem::temp_directory_path() / ("foreign_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    test::FixtureBag fixture;
    fixture.frames = 3;
    fixture.with_ground_truth = false;
    test::writeFixtureBag(original_, fixture);
  }
  ~ForeignRecordingTest() override { std::filesystem::remove_all(folder_); }

  /// A copy whose images `edit` writes.
  void copyImages(const EditImage& edit) const {
    test::copyBag(original_, copy_, rosbag::bagmode::Write,
                  [&](const rosbag::MessageInstance& message, rosbag::Bag& bag) {
                    if (const auto image = message.instantiate<sensor_msgs::Image>()) {
                      edit(*image, bag, message.getTopic());
                    } else {
                      bag.write(message.getTopic(), message.getTime(), message);
                    }
                  });
  }

  static std::vector<cv::Mat> leftImages(const std::string& bag) {
    std::vector<cv::Mat> images;
    Recording(bag, {}).forEachPair([&](const RawPair& pair) { images.push_back(pair.left.clone()); });
    return images;
  }

  /// Mean difference in grey values of the copy's images from the original's, all of which must be there.
  double meanDifference() const {
    const auto expected = leftImages(original_);
    const auto images = leftImages(copy_);
    EXPECT_EQ(images.size(), expected.size());
    if (images.size() != expected.size()) return 255.0;
    return cv::norm(images.back(), expected.back(), cv::NORM_L1) /
           static_cast<double>(expected.back().total());
  }

  std::string refusalOfCopy() const {
    try {
      const Recording recording(copy_, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
  std::string original_ = (folder_ / "original.bag").string();
  std::string copy_ = (folder_ / "copy.bag").string();
};

cv::Mat pixelsOf(const sensor_msgs::Image& image) {
  return cv_bridge::toCvCopy(image)->image;
}

/// What compressed_image_transport or a driver publishes.
void writeCompressed(rosbag::Bag& bag, const std::string& topic, const sensor_msgs::Image& image,
                     const cv::Mat& pixels, const std::string& file_type, const std::string& format) {
  sensor_msgs::CompressedImage compressed;
  compressed.header = image.header;
  compressed.format = format;
  cv::imencode(file_type, pixels, compressed.data);
  bag.write(topic + "/compressed", image.header.stamp, compressed);
}

TEST_F(ForeignRecordingTest, CompressedImagesAreDecoded) {
  struct Kind {
    const char* file_type;
    const char* format;
    int conversion;  ///< from grey, or -1
    double scale;    ///< to 16 bits, or 0
    double tolerance;
  };
  for (const Kind& kind :
       {Kind{".png", "mono8; png compressed ", -1, 0.0, 0.0}, Kind{".jpg", "jpeg", -1, 0.0, 3.0},
        Kind{".jpg", "rgb8; jpeg compressed bgr8", cv::COLOR_GRAY2BGR, 0.0, 3.0},
        Kind{".png", "bgra8; png compressed bgra8", cv::COLOR_GRAY2BGRA, 0.0, 0.0},
        Kind{".png", "mono16; png compressed ", -1, 257.0, 0.0},
        Kind{".png", "16UC1; png compressed ", -1, 16.0, 1.0},
        Kind{".png", "bgr16; png compressed bgr16", cv::COLOR_GRAY2BGR, 257.0, 0.0}}) {
    copyImages([&](const sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
      cv::Mat pixels = pixelsOf(image);
      if (kind.scale > 0.0) pixels.convertTo(pixels, CV_16U, kind.scale);
      if (kind.conversion >= 0) cv::cvtColor(pixels, pixels, kind.conversion);
      writeCompressed(bag, topic, image, pixels, kind.file_type, kind.format);
    });
    EXPECT_LE(meanDifference(), kind.tolerance) << kind.format;
  }
}

/// The mosaic of a grey scene in coloured light: what a Bayer sensor sees of it.
cv::Mat mosaicOf(const cv::Mat& grey, const std::string& encoding) {
  const std::string colours = encoding.substr(6, 4);  // of pixels (0, 0), (0, 1), (1, 0), (1, 1)
  cv::Mat mosaic(grey.size(), CV_8U);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const char colour = colours[static_cast<std::size_t>(2 * (row % 2) + column % 2)];
      // Grey is 0.299 red + 0.587 green + 0.114 blue: only the right pattern restores the brightness.
      const double gain = colour == 'r'   ? 0.5
                          : colour == 'b' ? 0.6
                                          : (1.0 - 0.299 * 0.5 - 0.114 * 0.6) / 0.587;
      mosaic.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(gain * grey.at<std::uint8_t>(row, column));
    }
  }
  return mosaic;
}

/// Without the detail that a mosaic loses, and not so bright that a colour saturates.
cv::Mat smoothed(const cv::Mat& grey) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, cv::Size(), 2.0);
  return 0.6 * smooth;
}

TEST_F(ForeignRecordingTest, BayerImagesBecomeTheGreyOfTheScene) {
  copyImages([&](const sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
    bag.write(topic, image.header.stamp,
              cv_bridge::CvImage(image.header, "mono8", smoothed(pixelsOf(image))).toImageMsg());
  });
  std::filesystem::rename(copy_, original_);
  for (const char* pattern : {"bayer_rggb", "bayer_bggr", "bayer_gbrg", "bayer_grbg"}) {
    for (const int bits : {8, 12, 16}) {
      for (const bool compressed : {false, true}) {
        const std::string encoding = pattern + std::string(bits == 8 ? "8" : "16");
        copyImages([&](const sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
          cv::Mat mosaic = mosaicOf(pixelsOf(image), encoding);
          if (bits > 8) mosaic.convertTo(mosaic, CV_16U, bits == 12 ? 16.0 : 257.0);
          if (compressed) {
            writeCompressed(bag, topic, image, mosaic, ".png", encoding + "; png compressed ");
          } else {
            bag.write(topic, image.header.stamp,
                      cv_bridge::CvImage(image.header, encoding, mosaic).toImageMsg());
          }
        });
        EXPECT_LT(meanDifference(), 1.5) << encoding << " of " << bits << " bits " << compressed;
      }
    }
  }
}

TEST_F(ForeignRecordingTest, ACompressedImageThatCannotBeDecodedIsNamed) {
  copyImages([&](const sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
    sensor_msgs::CompressedImage compressed;
    compressed.header = image.header;
    compressed.format = "h264";
    compressed.data.assign(1000, 7);
    bag.write(topic + "/compressed", image.header.stamp, compressed);
  });
  EXPECT_TRUE(contains(refusalOfCopy(), "compressed image 'h264' of 1000 bytes cannot be decoded"))
      << refusalOfCopy();
}

TEST_F(ForeignRecordingTest, StampsThatRepeatOrAreZeroAreLeftOutAndSaid) {
  copyImages([&](sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
    const ros::Time stamp = image.header.stamp;
    bag.write(topic, stamp, image);
    bag.write(topic, stamp + ros::Duration(0.001), image);
    image.header.stamp = ros::Time();
    bag.write(topic, stamp + ros::Duration(0.002), image);
  });
  const Recording recording(copy_, {});
  EXPECT_EQ(recording.pairs(), 3u);
  EXPECT_EQ(recording.unpairedImages(), 12u);
  ASSERT_EQ(recording.notes().size(), 4u);
  EXPECT_TRUE(contains(recording.notes()[0], "left/image_raw: images with the stamp 0 are left out: 3"));
  EXPECT_TRUE(contains(recording.notes()[1], "images whose stamp an earlier one has are left out: 3"));
  EXPECT_EQ(meanDifference(), 0.0);
}

TEST_F(ForeignRecordingTest, ImagesRecordedInAnotherOrderComeInThatOfTheirStamps) {
  double ahead_s = 0.35;
  copyImages([&](const sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
    bag.write(topic, image.header.stamp + ros::Duration(ahead_s), image);
    if (topic == topics::kRightImage) ahead_s -= 0.15;  // the frames are 0.1 s apart
  });
  EXPECT_EQ(meanDifference(), 0.0);
}

TEST_F(ForeignRecordingTest, ARecordingWithoutStampsIsRefused) {
  copyImages([&](sensor_msgs::Image& image, rosbag::Bag& bag, const std::string& topic) {
    const ros::Time stamp = image.header.stamp;
    image.header.stamp = ros::Time();
    bag.write(topic, stamp, image);
  });
  EXPECT_TRUE(contains(refusalOfCopy(), "all images have the stamp 0")) << refusalOfCopy();
}

TEST_F(ForeignRecordingTest, ConstantTransformsOfTfStandInForTfStatic) {
  test::copyBag(original_, copy_, rosbag::bagmode::Write,
                [&](const rosbag::MessageInstance& message, rosbag::Bag& bag) {
                  const auto tf = message.instantiate<tf2_msgs::TFMessage>();
                  if (!tf) return bag.write(message.getTopic(), message.getTime(), message);
                  geometry_msgs::TransformStamped turning = tf->transforms.front();
                  turning.child_frame_id = "head";
                  for (int i = 0; i < 3; ++i) {
                    bag.write("/tf", message.getTime() + ros::Duration(i), *tf);
                    turning.transform.translation.x += 0.1;
                    tf2_msgs::TFMessage moving;
                    moving.transforms = {turning};
                    bag.write("/tf", message.getTime() + ros::Duration(i), moving);
                  }
                });
  const Recording recording(copy_, {});
  const auto T_base_camera = recording.transform("base_link", "camera_left_optical");
  ASSERT_TRUE(T_base_camera);
  EXPECT_NEAR(T_base_camera->translation().z(), 0.283, 1e-12);
  EXPECT_FALSE(recording.transform("base_link", "head")) << "it moves";
  ASSERT_EQ(recording.notes().size(), 1u);
  EXPECT_TRUE(contains(recording.notes()[0], "where it is constant: camera_left_optical, imu_link"));
}

TEST_F(ForeignRecordingTest, OneCameraInfoIsEnough) {
  std::set<std::string> seen;
  test::copyBag(original_, copy_, rosbag::bagmode::Write,
                [&](const rosbag::MessageInstance& message, rosbag::Bag& bag) {
                  const bool is_info = message.getDataType() == "sensor_msgs/CameraInfo";
                  if (is_info && !seen.insert(message.getTopic()).second) return;
                  bag.write(message.getTopic(), message.getTime(), message);
                });
  EXPECT_EQ(meanDifference(), 0.0);
}

TEST_F(ForeignRecordingTest, ABagWhoseRecorderWasKilledIsRefusedWithTheRemedy) {
  const std::string unfinished = (folder_ / "unfinished.bag").string();
  {
    rosbag::Bag source(original_);
    rosbag::Bag bag(unfinished, rosbag::bagmode::Write);
    rosbag::View view(source);
    for (const rosbag::MessageInstance& message : view)
      bag.write(message.getTopic(), message.getTime(), message);
    std::filesystem::copy_file(unfinished, copy_);  // before its index is written
  }
  EXPECT_TRUE(contains(refusalOfCopy(), "rosbag reindex " + copy_)) << refusalOfCopy();
}

TEST_F(ForeignRecordingTest, ABagThatWasCutOffIsRefusedWithTheRemedy) {
  const auto all = std::filesystem::file_size(original_);
  for (const double part : {0.1, 0.5, 0.9, 0.999}) {
    std::filesystem::copy_file(original_, copy_, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(copy_, static_cast<std::uintmax_t>(part * static_cast<double>(all)));
    EXPECT_TRUE(contains(refusalOfCopy(), "rosbag reindex " + copy_)) << refusalOfCopy();
  }
}

}  // namespace
}  // namespace stereo_nav::ros_io
