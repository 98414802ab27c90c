#include "sensors/camera/device_finder.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sensors/camera/v4l2_device.h"

namespace stereo_nav::camera {
namespace {

namespace fs = std::filesystem;

const std::string kPrefix = "video";

/// N of videoN, -1 for any other name.
int videoNumber(const std::string& name) {
  const bool number = name.size() > kPrefix.size() && name.compare(0, kPrefix.size(), kPrefix) == 0 &&
                      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(kPrefix.size()), name.end(),
                                  [](unsigned char c) { return std::isdigit(c); });
  return number ? std::atoi(name.c_str() + kPrefix.size()) : -1;
}

/// A camera that is connected but cannot be opened, e.g. without the permission, may be the one that is
/// looked for.
std::string refusalsText(const std::vector<std::string>& refused) {
  std::string text;
  for (const auto& reason : refused) text += (text.empty() ? ". It may be one of these: " : "; ") + reason;
  return text;
}

int readNumber(const fs::path& path) {
  int value = 0;
  std::ifstream(path) >> value;
  return value;
}

}  // namespace

DeviceFinder::DeviceFinder(Kernel& kernel, std::string dev_root, std::string sys_root)
    : kernel_(kernel), dev_root_(std::move(dev_root)), sys_root_(std::move(sys_root)) {}

std::vector<std::string> DeviceFinder::nodes() const {
  std::vector<int> numbers;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(dev_root_, unreadable)) {
    const int number = videoNumber(entry.path().filename());
    if (number >= 0) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::string> paths;
  for (const int number : numbers) paths.push_back(dev_root_ + "/" + kPrefix + std::to_string(number));
  return paths;
}

std::vector<FoundDevice> DeviceFinder::list(std::vector<std::string>* refused) const {
  std::vector<FoundDevice> devices;
  for (const auto& path : nodes()) {
    try {
      auto device = describe(path);
      devices.push_back(std::move(device));
    } catch (const CaptureError& error) {
      // Metadata nodes and encoders are no cameras and are not reported.
      if (refused != nullptr && error.step() == Step::kOpen) refused->push_back(error.what());
    }
  }
  return devices;
}

FoundDevice DeviceFinder::find(const std::string& name) const {
  std::error_code none;
  if (name.empty()) {
    throw CaptureError(Step::kFind, 0,
                       "no camera given; `rosrun stereo_nav list_cameras` shows the names to choose from");
  }
  if (name.front() == '/') {
    const auto real = fs::canonical(name, none);
    return describe(none ? name : real.string());
  }
  std::vector<std::string> refused;
  std::string connected;
  for (auto& device : list(&refused)) {
    if (device.bus_info == name) return device;
    connected += (connected.empty() ? "" : ", ") + device.bus_info;
  }
  throw CaptureError(Step::kFind, ENOENT,
                     name +
                         ": no camera at this port (connected: " + (connected.empty() ? "none" : connected) +
                         "); plug it in there, or give another name: `rosrun stereo_nav list_cameras`" +
                         refusalsText(refused));
}

FoundDevice DeviceFinder::findAgain(const FoundDevice& seen_before) const {
  std::vector<std::string> refused;
  for (auto& device : list(&refused)) {
    if (device.bus_info == seen_before.bus_info && device.index == seen_before.index) return device;
  }
  throw CaptureError(Step::kFind, ENOENT,
                     seen_before.card + " (was " + seen_before.path + ") is no longer at port " +
                         seen_before.bus_info + "; plug it in there again, or restart with its new name" +
                         refusalsText(refused));
}

FoundDevice DeviceFinder::describe(const std::string& path) const {
  const V4l2Device opened(kernel_, path);
  const Capabilities& capabilities = opened.capabilities();
  if (!capabilities.captures_video) {
    throw CaptureError(
        Step::kFind, 0,
        path + " (" + capabilities.card +
            ") does not capture video: a camera may have a second node for metadata; use the other one, "
            "`rosrun stereo_nav list_cameras` shows it");
  }
  FoundDevice device;
  device.path = path;
  device.card = capabilities.card;
  device.driver = capabilities.driver;
  device.bus_info = capabilities.bus_info;
  device.by_id = linkTo(path, dev_root_ + "/v4l/by-id");
  device.by_path = linkTo(path, dev_root_ + "/v4l/by-path");
  readSysfs(device);
  return device;
}

std::string DeviceFinder::linkTo(const std::string& path, const std::string& folder) const {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    std::error_code dangling;
    if (fs::canonical(entry.path(), dangling) == fs::path(path) && !dangling) return entry.path();
  }
  return {};
}

void DeviceFinder::readSysfs(FoundDevice& device) const {
  const fs::path node = fs::path(sys_root_) / "class/video4linux" / fs::path(device.path).filename();
  device.index = readNumber(node / "index");
  std::error_code none;
  // .../0000:00:14.0/usb1/1-2/1-2:1.0: controller, bus, camera, interface.
  fs::path folder = fs::canonical(node / "device", none);
  for (; !none && folder.has_relative_path(); folder = folder.parent_path()) {
    const std::string name = folder.filename();
    if (device.usb_speed_mbps == 0 && fs::exists(folder / "speed", none)) {
      device.usb_speed_mbps = readNumber(folder / "speed");
    }
    if (name.size() > 3 && name.compare(0, 3, "usb") == 0) {
      device.usb_bus = name;
      device.usb_controller = folder.parent_path().filename();
      return;
    }
  }
  device.usb_speed_mbps = 0;
}

}  // namespace stereo_nav::camera
