#include "support/room_frame.h"

#include <cv_bridge/cv_bridge.h>

#include <boost/make_shared.hpp>

#include "stereo_nav/ros/topics.h"
#include "support/textured_room.h"

namespace stereo_nav::test {
namespace {

sensor_msgs::ImagePtr imageMessage(const cv::Mat& image, const char* encoding, const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = ros_io::frames::kLeftOptical;
  return cv_bridge::CvImage(header, encoding, image).toImageMsg();
}

}  // namespace

RoomFrame roomFrame(double drive_s, const ros::Time& stamp) {
  const auto calibration = roomCalibration();
  const TexturedRoom room;
  const Eigen::Isometry3d pose = roomDrive(drive_s);
  const auto pair = room.renderPair(pose, pose, calibration);
  RoomFrame frame;
  frame.left = imageMessage(pair.left, "mono8", stamp);
  frame.right = imageMessage(pair.right, "mono8", stamp);
  frame.disparity = boost::make_shared<stereo_msgs::DisparityImage>();
  frame.disparity->image = *imageMessage(room.disparity(pose, calibration), "32FC1", stamp);
  frame.disparity->header = frame.disparity->image.header;
  return frame;
}

RoomFrame withStamp(const RoomFrame& frame, const ros::Time& stamp) {
  RoomFrame copy;
  copy.left = boost::make_shared<sensor_msgs::Image>(*frame.left);
  copy.right = boost::make_shared<sensor_msgs::Image>(*frame.right);
  copy.disparity = boost::make_shared<stereo_msgs::DisparityImage>(*frame.disparity);
  copy.left->header.stamp = copy.right->header.stamp = stamp;
  copy.disparity->header.stamp = copy.disparity->image.header.stamp = stamp;
  return copy;
}

}  // namespace stereo_nav::test
