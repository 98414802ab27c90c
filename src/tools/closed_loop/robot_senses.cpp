#include "tools/closed_loop/robot_senses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/planar_motion.h"
#include "ros/sensor_messages.h"
#include "stereo_nav/odometry/method/odometry_config.h"

namespace stereo_nav::tools {
namespace {

/// Slower than this it stands, and what touches it has come by itself.
constexpr double kStands_m_per_s = 0.01;

ros_io::StereoProcessing processingOf(const sim::DrivenSimulation& simulation, const SenseOptions& options) {
  const auto cameras = simulation.cameras();
  return {ros_io::toCameraInfo(cameras->calibration(sim::Side::kLeft), {}),
          ros_io::toCameraInfo(cameras->calibration(sim::Side::kRight), {}), options.disparity};
}

}  // namespace

RobotSenses::RobotSenses(const sim::DrivenSimulation& simulation, const SenseOptions& options)
    : options_(options),
      simulation_(simulation),
      T_base_camera_(simulation.scenario().rig.T_base_camera()),
      processing_(processingOf(simulation, options)),
      base_(estimation::UncertaintyParams(), T_base_camera_),
      obstacles_(options.obstacles) {
  if (options.odometry_config.empty()) return;
  odometry_ = std::make_unique<odometry::WatchedOdometry>(
      odometry::loadOdometryConfig(options.odometry_config), processing_.calibration(),
      odometry::SensorAxes{T_base_camera_.linear(), Eigen::Matrix3d::Identity()});
}

double RobotSenses::nearestFloor_m() const {
  const vision::StereoCalibration& calibration = processing_.calibration();
  return T_base_camera_.translation().x() +
         calibration.fx * calibration.baseline_m / options_.disparity.disparity_range;
}

void RobotSenses::takeTicks(const sim::SimulatedTicks& /*ticks*/, const sim::BaseState& /*truth*/) {}
void RobotSenses::takeScan(const laser::Scan& /*scan*/) {}
void RobotSenses::takeRange(std::size_t /*finder*/, double /*time_s*/, double /*range_m*/) {}

void RobotSenses::takeImu(const ImuSample& sample) {
  if (odometry_ && options_.imu) odometry_->addImu(sample);
}

void RobotSenses::takeShot(sim::StereoShot shot) {
  shots_.push_back(std::move(shot));
}

void RobotSenses::takeContacts(double /*time_s*/, const std::vector<std::string>& names) {
  const sim::BaseState state = simulation_.state();
  if (state.velocity_base.norm() < kStands_m_per_s && state.angular_velocity_base.norm() < kStands_m_per_s)
    return;
  collisions_.insert(collisions_.end(), names.begin(), names.end());
}

void RobotSenses::process(double now_s) {
  const auto isDone = [&](const sim::StereoShot& shot) {
    return std::max(shot.instants.left_s, shot.instants.right_s) + options_.latency_s <= now_s;
  };
  for (; !shots_.empty() && isDone(shots_.front()); shots_.pop_front()) see(shots_.front());
}

estimation::BaseEstimate RobotSenses::truth(const sim::BaseState& state) const {
  estimation::BaseEstimate estimate;
  estimate.T_odom_base = simulation_.start().inverse() * state.T_world_base;
  estimate.twist << state.velocity_base, state.angular_velocity_base;
  return estimate;
}

void RobotSenses::see(const sim::StereoShot& shot) {
  odometry::StereoFrame frame;
  frame.left_time_s = shot.instants.left_s;
  frame.right_time_s = shot.instants.right_s;
  frame.readout_s = 1e-3 * simulation_.scenario().sensor.rolling_shutter_ms;
  frame.left = processing_.rectifyLeft(shot.image(sim::Side::kLeft, *simulation_.cameras()));
  frame.right = processing_.rectifyRight(shot.image(sim::Side::kRight, *simulation_.cameras()));
  const cv::Mat disparity = processing_.disparity(frame.left, frame.right);
  frame.disparity = disparity;
  ++frames_;
  stamp_s_ = frame.left_time_s;
  if (odometry_) {
    const odometry::FrameResult result = odometry_->process(frame);
    estimate_ = base_.update(result, stamp_s_);
    lost_ = result.state == odometry::State::kLost;
    if (!odometry::isMeasured(result.state)) ++frames_lost_;
  } else {
    estimate_ = truth(shot.motion.state(stamp_s_));
  }
  if (lost_) return;
  const vision::StereoCalibration& calibration = processing_.calibration();
  const navigation::DisparityCamera camera{calibration.fx,
                                           calibration.fy,
                                           calibration.cx,
                                           calibration.cy,
                                           calibration.baseline_m,
                                           T_base_camera_,
                                           calibration.right_cx - calibration.cx};
  obstacles_.follow(estimate_->T_odom_base.translation().head<2>());
  obstacles_.addDisparity(stamp_s_, disparity, camera, estimate_->T_odom_base);
  if (stamp_s_ - grid_stamp_s_ < 1.0 / options_.grid_rate_hz) return;
  grid_stamp_s_ = stamp_s_;
  surroundings_.emplace(std::make_shared<const grid::OccupancyGrid>(obstacles_.grid()));
}

std::shared_ptr<const grid::OccupancyGrid> RobotSenses::localGrid() const {
  return surroundings_ ? surroundings_->grid() : nullptr;
}

std::optional<navigator::Situation> RobotSenses::situation(double now_s) const {
  if (!estimate_) return std::nullopt;
  navigator::Situation situation;
  situation.now_s = now_s;
  situation.localisation_lost = lost_;
  situation.T_map_odom = planarPart(simulation_.start());
  situation.odometry_stamp_s = stamp_s_;
  situation.position_sigma_m = largestSigma(estimate_->pose_covariance.topLeftCorner<2, 2>());
  situation.state.T_world_base = planarPart(estimate_->T_odom_base);
  situation.state.twist = {estimate_->twist(0), estimate_->twist(1), estimate_->twist(5)};
  if (surroundings_) {
    situation.surroundings = &*surroundings_;
    situation.surroundings_stamp_s = grid_stamp_s_;
  }
  return situation;
}

}  // namespace stereo_nav::tools
