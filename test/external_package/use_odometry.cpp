// What an integrator writes first: an odometry as a configuration file describes it, one frame, the message
// type. usage: use_odometry CONFIG. Exit status 0 if it behaves.
#include <stereo_nav/VoStatus.h>
#include <stereo_nav/odometry/method/odometry_config.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  stereo_nav::vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = 400.0;
  calibration.cx = calibration.right_cx = 160.0;
  calibration.cy = 120.0;
  calibration.baseline_m = 0.1;
  calibration.width = 320;
  calibration.height = 240;
  const auto odometry = stereo_nav::odometry::makeOdometry(stereo_nav::odometry::loadOdometryConfig(argv[1]),
                                                           calibration, Eigen::Matrix3d::Identity());

  stereo_nav::odometry::StereoFrame frame;
  frame.left = cv::Mat(calibration.height, calibration.width, CV_8UC1, cv::Scalar(128));
  frame.right = frame.left.clone();
  frame.disparity = cv::Mat::zeros(frame.left.size(), CV_32FC1);
  const stereo_nav::odometry::FrameResult result = odometry->process(frame);

  stereo_nav::VoStatus status;
  status.state = static_cast<std::uint8_t>(result.state);
  std::cout << "state " << int{status.state} << ", features " << result.features_detected << "\n";
  return status.state == stereo_nav::VoStatus::INITIALISING && result.features_detected == 0 ? 0 : 1;
}
