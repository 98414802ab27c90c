#include "ros/frame_synchroniser.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stereo_nav::ros_io {

void FrameSynchroniserParams::describe(ParameterVisitor& visitor) {
  visitor.integer(
      "queue_size", queue_size, {2, 1000}, "frames",
      "left images that wait for the rest of their frame; when there are more, the oldest is dropped");
  visitor.real("max_time_offset_s", max_time_offset_s, {0.0, 0.45}, "s",
               "without camera/sync: a right image further from the left stamp is no partner");
  visitor.real(
      "rolling_shutter_ms", rolling_shutter_ms, {0.0, 200.0}, "ms",
      "without camera/sync: time from the first row of an image to its last, with stamps of the middle "
      "row; 0: global shutter");
}

FrameSynchroniser::FrameSynchroniser(const FrameSynchroniserParams& params)
    : params_(params),
      lefts_(static_cast<std::size_t>(params.queue_size)),
      rights_(static_cast<std::size_t>(params.queue_size)),
      disparities_(static_cast<std::size_t>(params.queue_size)),
      syncs_(static_cast<std::size_t>(params.queue_size)),
      rolling_shutter_s_(1e-3 * params.rolling_shutter_ms) {}

void FrameSynchroniser::addLeft(const sensor_msgs::ImageConstPtr& image, SteadyTime arrival) {
  const auto added = lefts_.add(image->header.stamp, {image, arrival});
  if (added == StampBuffer<Left>::Added::kJumpedBack) jumped_ = true;
}

void FrameSynchroniser::addRight(const sensor_msgs::ImageConstPtr& image) {
  const ros::Time stamp = image->header.stamp;
  const double interval_s = rights_.received() > 0 ? (stamp - rights_.newest()).toSec() : 0.0;
  if (interval_s > 0.0) {
    // Grows slowly, so that one late image does not make a lost one look like a short period.
    constexpr double kGrowth = 1.05;
    right_period_s_ = right_period_s_ > 0.0 ? std::min(interval_s, kGrowth * right_period_s_) : interval_s;
  }
  rights_.add(stamp, image);
}

void FrameSynchroniser::addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  disparities_.add(disparity->header.stamp, disparity);
}

void FrameSynchroniser::addSync(const StereoSyncConstPtr& sync) {
  syncs_.add(sync->header.stamp, sync);
  rolling_shutter_s_ = sync->rolling_shutter_s;  // remains valid when camera/sync stops
}

std::optional<FrameMessages> FrameSynchroniser::take() {
  auto& waiting = lefts_.items();
  for (auto left = waiting.begin(); left != waiting.end();) {
    FrameMessages frame;
    frame.left_stamp = left->stamp;
    frame.left = left->message.image;
    frame.arrival = left->message.arrival;
    frame.rolling_shutter_s = rolling_shutter_s_;
    const Match right = matchRight(frame.left_stamp, frame);
    if (right == Match::kHopeless) {
      left = waiting.erase(left);
      ++incomplete_;
    } else if (right == Match::kFound && matchDisparity(frame.left_stamp, frame)) {
      incomplete_ += lefts_.discardUpTo(frame.left_stamp) - 1;
      forgetUpTo(frame);
      frame.after_jump = std::exchange(jumped_, false);
      return frame;
    } else {
      ++left;
    }
  }
  return std::nullopt;
}

FrameSynchroniser::Match FrameSynchroniser::matchRight(const ros::Time& left_stamp,
                                                       FrameMessages& frame) const {
  // A capture node that stopped publishing camera/sync must not stop the odometry.
  const bool sync_alive =
      syncs_.received() > 0 && std::abs((left_stamp - syncs_.newest()).toSec()) < 2.0 * kClockJump_s;
  if (!sync_alive) return matchNearestRight(left_stamp, frame);

  const StereoSyncConstPtr sync = syncs_.find(left_stamp);
  if (!sync) return Match::kWaiting;
  frame.right_stamp = sync->right_stamp;
  frame.right = rights_.find(left_stamp);  // one common stamp for the pair
  if (!frame.right) frame.right = rights_.find(sync->right_stamp);
  return frame.right ? Match::kFound : Match::kWaiting;
}

FrameSynchroniser::Match FrameSynchroniser::matchNearestRight(const ros::Time& left_stamp,
                                                              FrameMessages& frame) const {
  const decltype(rights_)::Item* nearest = nullptr;
  double nearest_offset_s = kClockJump_s;  // stamps further apart are from before and after a clock's jump
  bool later_seen = false;
  for (const auto& item : rights_.items()) {
    const double offset_s = (item.stamp - left_stamp).toSec();
    later_seen = later_seen || (offset_s >= 0.0 && offset_s < kClockJump_s);
    if (std::abs(offset_s) >= nearest_offset_s) continue;
    nearest = &item;
    nearest_offset_s = std::abs(offset_s);
  }
  if (nearest == nullptr) return Match::kWaiting;
  const bool none_nearer_to_come = later_seen || nearest_offset_s < 0.5 * right_period_s_;
  if (!none_nearer_to_come) return Match::kWaiting;
  if (nearest_offset_s > params_.max_time_offset_s) return later_seen ? Match::kHopeless : Match::kWaiting;
  frame.right = nearest->message;
  frame.right_stamp = nearest->stamp;
  return Match::kFound;
}

bool FrameSynchroniser::matchDisparity(const ros::Time& left_stamp, FrameMessages& frame) const {
  switch (params_.disparity) {
    case odometry::DisparityUse::kNone:
      return true;
    case odometry::DisparityUse::kLatest:
      if (!disparities_.items().empty()) frame.disparity = disparities_.items().back().message;
      return true;
    case odometry::DisparityUse::kMatched:
      frame.disparity = disparities_.find(left_stamp);
      return frame.disparity != nullptr;
  }
  return false;
}

void FrameSynchroniser::forgetUpTo(const FrameMessages& frame) {
  rights_.discardUpTo(frame.right->header.stamp);
  syncs_.discardUpTo(frame.left_stamp);
  if (params_.disparity == odometry::DisparityUse::kMatched) disparities_.discardUpTo(frame.left_stamp);
}

}  // namespace stereo_nav::ros_io
