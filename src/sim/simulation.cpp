#include "sim/simulation.h"

namespace stereo_nav::sim {

Simulation::Simulation(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed)
    : scenario_(scenario),
      scene_(scenario.scene),
      trajectory_(scenario.path, scenario.motion),
      pairs_(pairInstants(scenario.timing, trajectory_.duration_s(), seed)),
      imu_(simulateImu(scenario.imu, trajectory_, trajectory_.duration_s(), seed)),
      true_drive_(trueDrive(scenario.wheels, scenario.drive, seed)),
      cameras_(scenario, calibration, seed) {
  left_exposures_ = planned(Side::kLeft);
  right_exposures_ = planned(Side::kRight);
  if (!true_drive_.wheels.empty()) wheels_ = simulateWheels(scenario.wheels, true_drive_, trajectory_, seed);
}

std::vector<ExposureSetting> Simulation::planned(Side side) const {
  return planExposures(scenario_.sensor, pairs_.size(),
                       [&](std::size_t pair, const ExposureSetting& setting) {
                         return cameras_.metered(side, scene_, path(), imageTime(side, pair), setting);
                       });
}

double Simulation::imageTime(Side side, std::size_t pair) const {
  return side == Side::kLeft ? pairs_[pair].left_s : pairs_[pair].right_s;
}

Eigen::Isometry3d Simulation::cameraPose(Side side, double time_s) const {
  return trajectory_.pose(time_s) * cameras_.T_base_raw(side);
}

cv::Mat Simulation::image(Side side, std::size_t pair) const {
  return cameras_.image(side, scene_, path(), imageTime(side, pair), exposure(side, pair), pair);
}

}  // namespace stereo_nav::sim
