#pragma once

#include <stdexcept>
#include <string>

namespace stereo_nav::camera {

/// What was being done with a camera when it failed.
enum class Step {
  kFind,
  kOpen,
  kQuery,
  kSetFormat,
  kSetRate,
  kGetBuffers,
  kStreamOn,
  kWait,
  kDequeue,
  kQueue,
  kControl
};

/// A camera that cannot be used now. The message says what was seen, the likely cause and the remedy.
class CaptureError : public std::runtime_error {
 public:
  CaptureError(Step step, int error_number, const std::string& message)
      : std::runtime_error(message), step_(step), error_number_(error_number) {}

  Step step() const { return step_; }
  int errorNumber() const { return error_number_; }  ///< errno, or 0 when no call failed

 private:
  Step step_;
  int error_number_;
};

/// Explains a failed system call on the camera `path`; `details` tells what was asked for, e.g. the format.
CaptureError explainFailure(Step step, int error_number, const std::string& path, const std::string& details);

/// The processes that have `path` open, e.g. "guvcview (pid 4711)". Empty when none can be seen; to see those
/// of other users takes root.
std::string processesUsing(const std::string& path);

}  // namespace stereo_nav::camera
