#pragma once

#include <sensor_msgs/Image.h>
#include <stereo_msgs/DisparityImage.h>

namespace stereo_nav::test {

/// Rectified images and exact disparity of the textured room, as the odometry node receives them.
struct RoomFrame {
  sensor_msgs::ImagePtr left;
  sensor_msgs::ImagePtr right;
  stereo_msgs::DisparityImagePtr disparity;
};

/// The frame of roomDrive() at `drive_s`; left optical frame id, all stamped `stamp`.
RoomFrame roomFrame(double drive_s, const ros::Time& stamp);

/// A copy with another stamp; the messages given may still be on their way.
RoomFrame withStamp(const RoomFrame& frame, const ros::Time& stamp);

}  // namespace stereo_nav::test
