#pragma once

#include <string>
#include <vector>

#include "sensors/camera/kernel.h"

namespace stereo_nav::camera {

/// A video capture device that is connected now.
struct FoundDevice {
  std::string path;  ///< e.g. /dev/video2: depends on the order of plugging in
  std::string card;
  std::string driver;
  std::string bus_info;        ///< the port, e.g. usb-0000:00:14.0-2
  int index = 0;               ///< which of the nodes that one camera may have
  std::string by_id;           ///< link in /dev/v4l/by-id, empty if none
  std::string by_path;         ///< link in /dev/v4l/by-path, empty if none
  std::string usb_controller;  ///< e.g. 0000:00:14.0; cameras on the same one share its bandwidth
  std::string usb_bus;         ///< e.g. usb1; empty when it is no USB device
  int usb_speed_mbps = 0;      ///< 480 for USB 2, 0 if unknown

  /// The name that stays the same when the camera is plugged in again: by its port.
  const std::string& stableName() const { return by_path.empty() ? bus_info : by_path; }
};

/// Finds cameras. It has no state and asks the system every time.
class DeviceFinder {
 public:
  /// The folders are arguments so that tests can replace them.
  explicit DeviceFinder(Kernel& kernel, std::string dev_root = "/dev", std::string sys_root = "/sys");

  /// All capture devices in the order of their numbers. `refused`, if given, receives the reasons why others
  /// could not be opened.
  std::vector<FoundDevice> list(std::vector<std::string>* refused = nullptr) const;

  /// The device that `name` (/dev/videoN, a link to one, or a bus_info) means. Throws a CaptureError that
  /// says what is connected instead.
  FoundDevice find(const std::string& name) const;

  /// The device at the port where one was seen before, whatever its number is now. Throws CaptureError.
  FoundDevice findAgain(const FoundDevice& seen_before) const;

 private:
  std::vector<std::string> nodes() const;  ///< /dev/video*, by number
  FoundDevice describe(const std::string& path) const;
  std::string linkTo(const std::string& path, const std::string& folder) const;
  void readSysfs(FoundDevice& device) const;

  Kernel& kernel_;
  std::string dev_root_;
  std::string sys_root_;
};

}  // namespace stereo_nav::camera
