#include "ros/recorded_image.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ros/image_stamp.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

namespace image_enc = sensor_msgs::image_encodings;

cv::Mat decode(const sensor_msgs::CompressedImage& image) {
  cv::Mat pixels;
  try {
    if (!image.data.empty()) pixels = cv::imdecode(image.data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    pixels.release();  // said below
  }
  const bool usable = !pixels.empty() && (pixels.depth() == CV_8U || pixels.depth() == CV_16U);
  if (usable) return pixels;
  throw InputError("compressed image '" + image.format + "' of " + std::to_string(image.data.size()) +
                   " bytes cannot be decoded: it is damaged, or its format is none of OpenCV's with 8 or 16 "
                   "bits; record image_raw, or images compressed as jpeg or png");
}

/// compressed_image_transport writes "ENCODING; CODEC compressed ENCODING"; drivers write "jpeg".
std::string encodingOf(const sensor_msgs::CompressedImage& image, const cv::Mat& grey) {
  std::string original = image.format.substr(0, image.format.find(';'));
  if (image_enc::isBayer(original) && image_enc::bitDepth(original) == 8 * static_cast<int>(grey.elemSize()))
    return original;
  return grey.depth() == CV_8U ? image_enc::MONO8 : image_enc::MONO16;
}

/// cv_bridge takes big-endian values of 16 bits for two channels.
sensor_msgs::ImageConstPtr littleEndian(const sensor_msgs::Image& image) {
  const auto swapped = boost::make_shared<sensor_msgs::Image>(image);
  swapped->is_bigendian = 0;
  const std::string& encoding = image.encoding;
  const bool has_16_bits = encoding.size() > 2 && encoding.compare(encoding.size() - 2, 2, "16") == 0;
  for (std::size_t i = 0; has_16_bits && i + 1 < swapped->data.size(); i += 2)
    std::swap(swapped->data[i], swapped->data[i + 1]);
  return swapped;
}

}  // namespace

sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& image) {
  const cv::Mat pixels = decode(image);
  if (pixels.channels() == 1)
    return cv_bridge::CvImage(image.header, encodingOf(image, pixels), pixels).toImageMsg();
  cv::Mat grey;
  cv::cvtColor(pixels, grey, pixels.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  const char* encoding = grey.depth() == CV_8U ? "mono8" : "mono16";
  return cv_bridge::CvImage(image.header, encoding, grey).toImageMsg();
}

sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& message) {
  if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>())
    return decompressed(*compressed);
  const auto image = message.instantiate<sensor_msgs::Image>();
  return image && image->is_bigendian ? littleEndian(*image) : image;
}

std::optional<ros::Time> recordedImageStamp(const rosbag::MessageInstance& message) {
  if (const auto image = message.instantiate<ImageStamp>()) return image->stamp;
  if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>())
    return compressed->header.stamp;
  return std::nullopt;
}

}  // namespace stereo_nav::ros_io
