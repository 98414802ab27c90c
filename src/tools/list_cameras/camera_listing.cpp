#include "tools/list_cameras/camera_listing.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sensors/camera/capture_error.h"
#include "sensors/camera/v4l2_device.h"

namespace stereo_nav::tools {
namespace {

using namespace camera;  // NOLINT: everything here is about cameras

std::string ratesText(const std::vector<double>& rates_hz) {
  std::ostringstream text;
  for (const double rate : rates_hz) text << (text.tellp() > 0 ? ", " : "") << std::setprecision(4) << rate;
  return text.str();
}

/// One line a format and rate list: many sizes share both.
void printFormats(V4l2Device& device, std::ostream& out) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& format : device.offeredFormats()) {
    const bool usable = pixelFormatOf(format.fourcc) != PixelFormat::kAny;
    const std::string key = fourccText(format.fourcc) + (usable ? "" : " (not usable here)") + " at " +
                            ratesText(format.rates_hz) + " Hz";
    const std::string size = std::to_string(format.width) + "x" + std::to_string(format.height);
    const auto line =
        std::find_if(lines.begin(), lines.end(), [&](const auto& entry) { return entry.first == key; });
    if (line == lines.end()) {
      lines.emplace_back(key, size);
    } else {
      line->second += " " + size;
    }
  }
  for (const auto& [key, sizes] : lines) out << "    " << key << ": " << sizes << "\n";
}

void printControls(V4l2Device& device, std::ostream& out) {
  for (const auto& control : device.controls().list()) {
    out << "    " << std::left << std::setw(34) << control.name << std::right << control.minimum << " to "
        << control.maximum << ", default " << control.default_value;
    try {
      out << ", now " << device.controls().get(control);
    } catch (const CaptureError&) {
      // Buttons and write-only controls have no value.
    }
    for (const auto& entry : control.menu) out << "\n" << std::string(40, ' ') << entry;
    out << "\n";
  }
}

void printCamera(Kernel& kernel, const FoundDevice& camera, bool with_controls, std::ostream& out) {
  out << camera.card << "\n"
      << "  name by port:   " << camera.stableName() << "\n";
  if (!camera.by_id.empty()) out << "  name by camera: " << camera.by_id << "\n";
  out << "  now:            " << camera.path << ", driver " << camera.driver << ", port " << camera.bus_info;
  if (camera.usb_speed_mbps > 0) out << ", USB at " << camera.usb_speed_mbps << " Mbit/s";
  out << "\n";
  V4l2Device device(kernel, camera.path);
  out << "  formats:\n";
  printFormats(device, out);
  if (!with_controls) return;
  out << "  controls:\n";
  printControls(device, out);
}

/// Two cameras on one controller can starve each other.
void printSharedControllers(const std::vector<FoundDevice>& cameras, std::ostream& out) {
  std::map<std::string, std::vector<std::string>> by_controller;
  for (const auto& camera : cameras) {
    if (!camera.usb_bus.empty()) {
      by_controller[camera.usb_controller + " (" + camera.usb_bus + ")"].push_back(camera.path);
    }
  }
  for (const auto& [controller, paths] : by_controller) {
    if (paths.size() < 2) continue;
    out << "Share the USB controller " << controller << ":";
    for (const auto& path : paths) out << " " << path;
    out << "\n  Uncompressed images of two cameras do not fit onto one USB 2 bus: use format mjpg, or a port "
           "of another controller.\n";
  }
}

void printLaunchArguments(const std::vector<FoundDevice>& cameras, std::ostream& out) {
  if (cameras.size() < 2) {
    out << "A stereo camera needs two cameras; " << cameras.size() << " found.\n";
    return;
  }
  out << "To start with the first two (exchange them if left is right):\n"
      << "  roslaunch stereo_nav capture.launch left:=" << cameras[0].stableName()
      << " right:=" << cameras[1].stableName() << "\n";
}

}  // namespace

void listCameras(Kernel& kernel, const DeviceFinder& finder, bool with_controls, std::ostream& out) {
  std::vector<std::string> refused;
  const auto cameras = finder.list(&refused);
  for (const auto& reason : refused) out << reason << "\n";
  if (cameras.empty() && refused.empty()) {
    out << "No camera found. Is one plugged in (`lsusb` shows it)?\n";
  }
  for (const auto& camera : cameras) {
    try {
      printCamera(kernel, camera, with_controls, out);
    } catch (const CaptureError& error) {  // e.g. unplugged in this moment
      out << "  " << error.what() << "\n";
    }
  }
  printSharedControllers(cameras, out);
  printLaunchArguments(cameras, out);
}

}  // namespace stereo_nav::tools
