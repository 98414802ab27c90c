#include "nodes/visual_odometry/odometry_session.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/angles.h"
#include "estimation/levelling.h"
#include "ros/imu_checks.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kCameraOrderInterval_s = 1.0;
/// Beyond these the camera is not where it was when the odometry began.
constexpr double kCameraTurned_rad = 0.2 * kRadPerDeg;
constexpr double kCameraMoved_m = 0.002;

std::optional<Eigen::Isometry3d> lookUp(const TransformLookup& lookup, const std::string& base_frame,
                                        const std::string& sensor_frame, const ros::Time& time,
                                        bool is_camera, std::string& problem) {
  if (sensor_frame == base_frame) return Eigen::Isometry3d::Identity();
  std::string error;
  auto transform = lookup(base_frame, sensor_frame, time, error);
  if (!transform) problem = ros_io::missingTransform(base_frame, sensor_frame, is_camera, error);
  return transform;
}

}  // namespace

OdometrySession::OdometrySession(const VisualOdometryParams& params, const odometry::OdometryConfig& config,
                                 TransformLookup lookup)
    : params_(params), config_(config), lookup_(std::move(lookup)) {}

SessionOutput OdometrySession::process(const ros_io::Inbox::Work& work, const SensorSetup& setup, bool live) {
  SessionOutput output;
  if (work.frame.after_jump) restartAfterJump(work.frame, live, output);
  for (const ImuSample& sample : work.imu) imu_history_.add(sample);
  if (!prepare(work.frame, setup, output) || !readImages(work.frame, output)) return output;

  if (!imu_frame_.empty()) {
    for (const ImuSample& sample : work.imu) odometry_->addImu(sample);
  }
  if (std::exchange(begins_, false)) level(output.images.left_time_s, output);
  output.result = odometry_->process(output.images);
  output.base = base_->update(output.result, output.images.left_time_s);
  output.processed = true;
  ++frames_processed_;
  if (!odometry::isMeasured(output.result.state)) ++frames_lost_;
  checkCameraOrder(output);
  checkRightStamps(output);
  checkImu(output);
  return output;
}

void OdometrySession::applyLive(const VisualOdometryParams& params) {
  params_ = params;
  if (base_) {
    base_->setUncertainty(params.uncertainty);
    base_->setFloor(params.floor);
  }
}

void OdometrySession::reset() {
  startAgain(Eigen::Isometry3d::Identity(), Matrix6d::Zero());
  begins_ = true;
}

bool OdometrySession::setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& covariance) {
  if (!base_) return false;
  base_->setPose(T_odom_base, covariance);
  return true;
}

void OdometrySession::startAgain(const Eigen::Isometry3d& T_odom_base, const Matrix6d& covariance) {
  if (odometry_) odometry_->reset();
  if (base_) base_->start(T_odom_base, covariance);
  if (camera_order_) camera_order_->reset();
}

void OdometrySession::restartAfterJump(const ros_io::FrameMessages& frame, bool live, SessionOutput& output) {
  std::ostringstream text;
  text << std::fixed << "the stamps jumped back to " << frame.left_stamp.toSec();
  imu_history_.clear();
  if (live && base_) {
    startAgain(base_->estimate().T_odom_base, base_->estimate().pose_covariance);
    text << ": the clock was set back. The odometry starts anew at its last pose";
  } else {
    reset();
    text << ": the bag or simulation starts again. The odometry starts anew at the origin";
  }
  output.announcements.push_back(text.str());
}

bool OdometrySession::prepare(const ros_io::FrameMessages& frame, const SensorSetup& setup,
                              SessionOutput& output) {
  if (!prepareCameras(frame, setup, output) || !prepareImu(setup, output)) return false;
  if (!odometry_) makeOdometry(output);
  return true;
}

bool OdometrySession::prepareCameras(const ros_io::FrameMessages& frame, const SensorSetup& setup,
                                     SessionOutput& output) {
  if (!setup.left_info || !setup.right_info) {
    output.errors["camera_info"] = "no camera_info of both cameras yet";
    return false;
  }
  try {
    judged_ = ros_io::checkedInfos(*frame.left, *frame.right, *setup.left_info, *setup.right_info);
  } catch (const std::exception& error) {
    output.errors["cameras"] = error.what();
    return false;
  }
  const bool same = odometry_ && ros_io::sameCamera(*left_info_, *setup.left_info) &&
                    ros_io::sameCamera(*right_info_, *setup.right_info);
  const std::string motion = same ? cameraMotion(frame.left_stamp) : "";
  if (same && motion.empty()) return true;
  if (same && !begins_) {
    output.errors["camera_moves"] = motion;
    return false;
  }

  const std::string camera_frame = ros_io::withoutSlash(frame.left->header.frame_id);
  std::string problem;
  auto T_base_camera = lookUp(lookup_, params_.base_frame, camera_frame, frame.left_stamp, true, problem);
  if (!T_base_camera)  // tf has just begun
    T_base_camera = lookUp(lookup_, params_.base_frame, camera_frame, ros::Time(0), true, problem);
  if (!T_base_camera) {
    output.errors["camera_transform"] = problem;
    return false;
  }
  if (odometry_ && !same)
    output.announcements.push_back("the camera_infos changed; the odometry starts anew at its last pose");
  left_info_ = setup.left_info;
  right_info_ = setup.right_info;
  camera_frame_ = camera_frame;
  T_base_camera_ = *T_base_camera;
  odometry_.reset();
  return true;
}

/// What a camera on a servo did since the odometry began, or may have done, which would be taken for a motion
/// of the base; empty while it is in its place.
std::string OdometrySession::cameraMotion(const ros::Time& stamp) const {
  std::string problem;
  const auto now = lookUp(lookup_, params_.base_frame, camera_frame_, stamp, true, problem);
  if (!now)
    return "tf does not tell where the camera " + camera_frame_ + " was against " + params_.base_frame +
           " at the stamp of the image, and if it turns that would be taken for a motion of the base: are "
           "joint_states and robot_state_publisher alive, and their stamps in time? " +
           problem;
  const Eigen::Isometry3d moved = T_base_camera_.inverse() * *now;
  const double turned_rad = Eigen::AngleAxisd(moved.linear()).angle();
  if (turned_rad < kCameraTurned_rad && moved.translation().norm() < kCameraMoved_m) return {};
  std::ostringstream text;
  text.precision(3);
  text << "the camera " << camera_frame_ << " has moved against " << params_.base_frame << " by "
       << kDegPerRad * turned_rad << " deg and " << 1e3 * moved.translation().norm()
       << " mm since the odometry began, which would be taken for a motion of the base: turn its joint back, "
          "or call vo/reset where the camera is to stay";
  return text.str();
}

bool OdometrySession::prepareImu(const SensorSetup& setup, SessionOutput& output) {
  const std::string imu_frame = ros_io::withoutSlash(setup.imu_frame);
  if (imu_frame == imu_frame_) return true;
  std::string problem;
  const auto T_base_imu = lookUp(lookup_, params_.base_frame, imu_frame, ros::Time(0), false, problem);
  if (!T_base_imu) {
    // If an IMU appears while the odometry runs without one, the odometry goes on.
    (odometry_ ? output.warnings : output.errors)["imu_transform"] = problem;
    return odometry_ != nullptr;
  }
  if (odometry_)
    output.announcements.push_back("the IMU has appeared; the odometry starts anew with it at its last pose");
  imu_frame_ = imu_frame;
  R_base_imu_ = T_base_imu->linear();
  odometry_.reset();
  return true;
}

void OdometrySession::makeOdometry(SessionOutput& output) {
  vision::StereoCalibration calibration = judged_.calibration;
  calibration.left_raw_rows = ros_io::rawRows(judged_.left);
  calibration.right_raw_rows = ros_io::rawRows(judged_.right);
  odometry_ = std::make_unique<odometry::WatchedOdometry>(
      config_, calibration, odometry::SensorAxes{T_base_camera_.linear(), R_base_imu_});
  const std::optional<estimation::BaseOdometry> before = std::move(base_);
  base_.emplace(params_.uncertainty, T_base_camera_);
  base_->setFloor(params_.floor);
  if (before) base_->start(before->estimate().T_odom_base, before->estimate().pose_covariance);
  camera_order_.emplace(calibration);
  for (const std::string& note : judged_.notes) output.notes.push_back(note);
  output.notes.push_back("odometry of " + params_.base_frame + " from camera " + camera_frame_ +
                         (imu_frame_.empty() ? " without IMU" : " with IMU " + imu_frame_));
}

void OdometrySession::level(double time_s, SessionOutput& output) {
  if (params_.initial_attitude != VisualOdometryParams::InitialAttitude::kGravity) return;
  const auto R_odom_base =
      imu_frame_.empty() ? std::nullopt : estimation::levelledAttitude(imu_history_, time_s, R_base_imu_);
  if (!R_odom_base) {
    output.announcements.push_back(
        "initial_attitude is gravity, but the IMU gives neither attitude nor acceleration before the first "
        "frame; the odometry frame is that of the base at the start, not levelled. Is the IMU running, and "
        "sampled at the image's time?");
    return;
  }
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  T_odom_base.linear() = *R_odom_base;
  base_->start(T_odom_base, Matrix6d::Zero());
}

bool OdometrySession::readImages(const ros_io::FrameMessages& frame, SessionOutput& output) const {
  try {
    output.images.left_time_s = frame.left_stamp.toSec();
    output.images.right_time_s = frame.right_stamp.toSec();
    output.images.readout_s = frame.rolling_shutter_s;
    output.images.left = ros_io::toMono8(frame.left);
    output.images.right = ros_io::toMono8(frame.right);
    if (frame.disparity)
      output.images.disparity = ros_io::toDisparityMap(*frame.disparity, judged_.calibration);
    if (frame.rolling_shutter_s >= 0.0 && frame.rolling_shutter_s <= odometry::kLongestReadout_s) return true;
    output.errors["rolling_shutter"] =
        "rolling_shutter_s of camera/sync is " + std::to_string(frame.rolling_shutter_s) +
        ": it must be from 0 (global shutter) to " + std::to_string(odometry::kLongestReadout_s) +
        "; correct it where the cameras are captured";
    return false;
  } catch (const InputError& error) {
    output.errors["image"] = error.what();
    return false;
  }
}

void OdometrySession::checkCameraOrder(SessionOutput& output) {
  const double time_s = output.images.left_time_s;
  if (std::abs(time_s - camera_order_checked_s_) >= kCameraOrderInterval_s) {
    camera_order_->observe(output.images.left, output.images.right);
    camera_order_checked_s_ = time_s;
  }
  if (camera_order_->verdict() != vision::CameraOrderCheck::Verdict::kSwapped) return;
  output.warnings["camera_order"] = ros_io::swappedCameras();
}

void OdometrySession::checkRightStamps(SessionOutput& output) {
  if (output.result.right_stamps_are_corrected)
    output.warnings["right_stamps"] = ros_io::wrongRightStamps(output.result.right_stamp_error_s);
}

void OdometrySession::checkImu(SessionOutput& output) {
  if (imu_frame_.empty()) return;
  const double ahead_s =
      imu_history_.newest_s() - std::max(output.images.left_time_s, output.images.right_time_s);
  if (std::isfinite(ahead_s) && std::abs(ahead_s) > ros_io::kImuOffClock_s)
    output.warnings["imu_stamps"] = ros_io::imuOffClock(ahead_s);
  const std::string& problem = odometry_->imuProblem();
  if (!problem.empty()) {
    output.warnings["imu"] = "the IMU contradicts the images and is set aside: " + problem;
    if (imu_problem_.empty()) output.announcements.push_back(output.warnings["imu"]);
  }
  imu_problem_ = problem;
}

}  // namespace stereo_nav::nodes
