#include "ros/keyframe_message.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <cstring>

#include "ros/pose_messages.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

[[noreturn]] void refuse(const Keyframe& message, const std::string& why) {
  throw InputError(
      fmt::format("vo/keyframe: keyframe {} {}: it was made by another version of the package, or "
                  "was damaged",
                  message.id, why));
}

void checkSizes(const Keyframe& message) {
  const std::size_t corners = message.landmark_ids.size();
  for (const auto* list :
       {&message.x_px, &message.y_px, &message.disparity_px, &message.disparity_sigma_px}) {
    if (list->size() != corners)
      refuse(message, fmt::format("has a list of {} values for {} corners", list->size(), corners));
  }
  const std::size_t of_all_corners = corners * sizeof(vision::Descriptor);
  const bool fits = corners == 0
                        ? message.descriptors.empty()
                        : !message.descriptors.empty() && message.descriptors.size() % of_all_corners == 0;
  if (!fits)
    refuse(message, fmt::format("has {} bytes of descriptors for {} corners of {} bytes each at every scale",
                                message.descriptors.size(), corners, sizeof(vision::Descriptor)));
}

vision::KeyframeCorner cornerOf(const Keyframe& message, std::size_t i) {
  vision::KeyframeCorner corner;
  corner.landmark_id = message.landmark_ids[i];
  corner.px = Eigen::Vector2f(message.x_px[i], message.y_px[i]).cast<double>();
  corner.disparity_px = message.disparity_px[i];
  corner.disparity_sigma_px = message.disparity_sigma_px[i];
  const bool is_sound = corner.px.allFinite() && std::isfinite(corner.disparity_px) &&
                        std::isfinite(corner.disparity_sigma_px) && corner.disparity_sigma_px >= 0.0;
  if (!is_sound) refuse(message, fmt::format("has a corner {} whose numbers cannot be", i));
  return corner;
}

}  // namespace

Keyframe toMessage(const vision::Keyframe& keyframe, const std::string& frame_id) {
  Keyframe message;
  message.header.stamp.fromSec(keyframe.time_s);
  message.header.frame_id = frame_id;
  message.id = keyframe.id;
  message.follows = static_cast<std::uint8_t>(keyframe.follows);
  message.motion.pose = tf2::toMsg(keyframe.T_previous_keyframe);
  fillCovariance(keyframe.covariance, message.motion.covariance);
  for (const vision::KeyframeCorner& corner : keyframe.corners) {
    message.landmark_ids.push_back(corner.landmark_id);
    message.x_px.push_back(static_cast<float>(corner.px.x()));
    message.y_px.push_back(static_cast<float>(corner.px.y()));
    message.disparity_px.push_back(static_cast<float>(corner.disparity_px));
    message.disparity_sigma_px.push_back(static_cast<float>(corner.disparity_sigma_px));
  }
  message.descriptors.resize(keyframe.descriptors.size() * sizeof(vision::Descriptor));
  if (!message.descriptors.empty())
    std::memcpy(message.descriptors.data(), keyframe.descriptors.data(), message.descriptors.size());
  return message;
}

vision::Keyframe toKeyframe(const Keyframe& message) {
  checkSizes(message);
  vision::Keyframe keyframe;
  keyframe.id = message.id;
  keyframe.time_s = message.header.stamp.toSec();
  keyframe.follows = message.follows != 0;
  const auto motion = toPose(message.motion.pose);
  keyframe.covariance = toCovariance(message.motion.covariance);
  if (!motion || !keyframe.covariance.allFinite()) refuse(message, "has a motion that cannot be");
  keyframe.T_previous_keyframe = *motion;
  for (std::size_t i = 0; i < message.landmark_ids.size(); ++i)
    keyframe.corners.push_back(cornerOf(message, i));
  keyframe.descriptors.resize(message.descriptors.size() / sizeof(vision::Descriptor));
  if (!message.descriptors.empty())
    std::memcpy(keyframe.descriptors.data(), message.descriptors.data(), message.descriptors.size());
  return keyframe;
}

}  // namespace stereo_nav::ros_io
