#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "sensors/camera/stereo_camera.h"

namespace stereo_nav::nodes {

/// The capture node's reports on /diagnostics: one status for each camera and one for their pairs.
class CaptureDiagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  struct Sources {
    std::function<camera::StereoStatus()> status;
    /// The problem with a camera's calibration; empty when there is none.
    std::function<std::string(camera::Side)> calibration_problem;
    std::function<std::string(camera::Side)> calibration_warning;
    /// What is wrong with two calibrations that are each usable alone; empty when nothing is.
    std::function<std::string()> pair_problem;
    double wanted_rate_hz = 0.0;
  };

  CaptureDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, Sources sources);

  /// Publishes when the next report is due.
  void update() { updater_.update(); }

 private:
  void describeCamera(camera::Side side, Status& status);
  void describePairs(Status& status);

  Sources sources_;
  diagnostic_updater::Updater updater_;
};

}  // namespace stereo_nav::nodes
