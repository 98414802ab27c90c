#include "nodes/stereo_capture/capture_diagnostics.h"

#include <cmath>

#include "sensors/camera/pixel_format.h"

namespace stereo_nav::nodes {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// A rate below this share of the requested one causes a warning.
constexpr double kSlow = 0.8;

const char* likelyCause(const camera::CameraStatus& camera, double wanted_rate_hz) {
  const bool has_no_such_rate = camera.format.rate_hz > 0.0 && camera.format.rate_hz < kSlow * wanted_rate_hz;
  return has_no_such_rate ? "the camera has no higher rate in this format and size (list_cameras shows which)"
                          : "long exposure in poor light, or a busy USB bus";
}

void addCounts(const camera::CameraStatus& camera, CaptureDiagnostics::Status& status) {
  status.add("Device", camera.device.path);
  status.add("Camera", camera.device.card);
  status.add("Port", camera.device.bus_info);
  status.add("Format", camera::fourccText(camera::fourccOf(camera.format.layout.format)));
  status.addf("Size (px)", "%dx%d", camera.format.layout.width, camera.format.layout.height);
  status.addf("Rate agreed with the driver (Hz)", "%.2f", camera.format.rate_hz);
  status.addf("Rate (Hz)", "%.2f", camera.rate_hz);
  status.add("Frames", camera.frames);
  status.add("Lost by the driver", camera.lost);
  status.add("Flagged broken by the driver", camera.flagged_broken);
  status.add("Undecodable", camera.undecodable);
  status.add("Skipped for a newer one", camera.skipped);
  status.add("Stalls", camera.stalls);
  status.add("Reconnections", camera.reconnections);
  status.add("Failed attempts", camera.failed_attempts);
  status.addf("Decoding (ms)", "%.2f", 1e3 * camera.decode_time_s);
}

}  // namespace

CaptureDiagnostics::CaptureDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                       Sources sources)
    : sources_(std::move(sources)), updater_(handle, private_handle) {
  updater_.setHardwareID("stereo camera");
  updater_.add("Left camera", [this](Status& status) { describeCamera(camera::Side::kLeft, status); });
  updater_.add("Right camera", [this](Status& status) { describeCamera(camera::Side::kRight, status); });
  updater_.add("Stereo pairs", [this](Status& status) { describePairs(status); });
}

void CaptureDiagnostics::describeCamera(camera::Side side, Status& status) {
  const auto stereo = sources_.status();
  const camera::CameraStatus& camera = side == camera::Side::kLeft ? stereo.left : stereo.right;
  if (camera.state != camera::CameraState::kStreaming) {
    status.summary(DiagnosticStatus::ERROR, camera.problem.empty() ? "No image yet" : camera.problem);
  } else {
    status.summary(DiagnosticStatus::OK, "Images are coming");
    if (camera.rate_hz < kSlow * sources_.wanted_rate_hz) {
      status.mergeSummaryf(DiagnosticStatus::WARN, "%.1f of %.1f images a second: %s", camera.rate_hz,
                           sources_.wanted_rate_hz, likelyCause(camera, sources_.wanted_rate_hz));
    }
    if (!camera.clock_warning.empty()) status.mergeSummary(DiagnosticStatus::WARN, camera.clock_warning);
    for (const auto& warning : camera.control_warnings) status.mergeSummary(DiagnosticStatus::WARN, warning);
  }
  const std::string calibration_problem = sources_.calibration_problem(side);
  if (!calibration_problem.empty()) status.mergeSummary(DiagnosticStatus::ERROR, calibration_problem);
  const std::string calibration_warning = sources_.calibration_warning(side);
  if (!calibration_warning.empty()) status.mergeSummary(DiagnosticStatus::WARN, calibration_warning);
  addCounts(camera, status);
}

void CaptureDiagnostics::describePairs(Status& status) {
  const auto stereo = sources_.status();
  const auto& alone = stereo.pairing.without_partner;
  status.summary(DiagnosticStatus::OK, "Pairs are coming");
  if (stereo.pair_rate_hz == 0.0) {
    status.summary(
        DiagnosticStatus::ERROR,
        "No pairs: look at the status of the cameras; if both deliver images, max_time_offset_s is too small");
  } else if (stereo.pair_rate_hz < kSlow * std::min(stereo.left.rate_hz, stereo.right.rate_hz)) {
    status.summary(
        DiagnosticStatus::WARN,
        "Many images have no partner: raise max_time_offset_s to half the time between images, and see that both "
        "cameras run at the same rate");
  }
  const std::string pair_problem = sources_.pair_problem();
  if (!pair_problem.empty()) status.mergeSummary(DiagnosticStatus::ERROR, pair_problem);
  status.addf("Rate (Hz)", "%.2f", stereo.pair_rate_hz);
  status.add("Pairs", stereo.pairing.pairs);
  status.add("Left images without partner", alone[0]);
  status.add("Right images without partner", alone[1]);
  status.add("Images out of order", stereo.pairing.out_of_order[0] + stereo.pairing.out_of_order[1]);
  status.add("Pairs overtaken by newer ones", stereo.delivered_late);
  status.addf("Time offset, right - left (ms)", "%.3f", 1e3 * stereo.time_offset_s);
  status.addf("Largest time offset allowed (ms)", "%.3f", 1e3 * stereo.max_time_offset_s);
  if (std::isfinite(stereo.time_offset_rate)) {
    status.addf("Clock beat, change of the time offset (ms/s)", "%.4f", 1e3 * stereo.time_offset_rate);
  }
  status.addf("Latency, dequeued to published (ms)", "%.2f", 1e3 * stereo.latency_s);
}

}  // namespace stereo_nav::nodes
