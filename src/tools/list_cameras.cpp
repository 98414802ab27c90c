// What is connected, in words to choose from: list_cameras [--controls]
#include <algorithm>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "stereo_nav/capture/device_finder.h"
#include "stereo_nav/capture/v4l2_device.h"

namespace {

using namespace stereo_nav::capture;  // NOLINT: a program of one file

std::string ratesText(const std::vector<double>& rates_hz) {
  std::ostringstream text;
  for (const double rate : rates_hz) text << (text.tellp() > 0 ? ", " : "") << std::setprecision(4) << rate;
  return text.str();
}

/// One line a format and rate list: many sizes share both.
void printFormats(V4l2Device& device) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& format : device.offeredFormats()) {
    const bool usable = pixelFormatOf(format.fourcc) != PixelFormat::Any;
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
  for (const auto& [key, sizes] : lines) std::cout << "    " << key << ": " << sizes << "\n";
}

void printControls(V4l2Device& device) {
  for (const auto& control : device.controls()) {
    std::cout << "    " << std::left << std::setw(34) << control.name << std::right << control.minimum
              << " to " << control.maximum << ", default " << control.default_value;
    try {
      std::cout << ", now " << device.getControl(control);
    } catch (const CaptureError&) {
      // Buttons and write-only controls have no value.
    }
    for (const auto& entry : control.menu) std::cout << "\n" << std::string(40, ' ') << entry;
    std::cout << "\n";
  }
}

void printCamera(const FoundDevice& camera, bool with_controls) {
  std::cout << camera.card << "\n"
            << "  name by port:   " << camera.stableName() << "\n";
  if (!camera.by_id.empty()) std::cout << "  name by camera: " << camera.by_id << "\n";
  std::cout << "  now:            " << camera.path << ", driver " << camera.driver << ", port "
            << camera.bus_info;
  if (camera.usb_speed_mbps > 0) std::cout << ", USB at " << camera.usb_speed_mbps << " Mbit/s";
  std::cout << "\n";
  V4l2Device device(linuxKernel(), camera.path);
  std::cout << "  formats:\n";
  printFormats(device);
  if (!with_controls) return;
  std::cout << "  controls:\n";
  printControls(device);
}

/// Two cameras on one controller can starve each other.
void printSharedControllers(const std::vector<FoundDevice>& cameras) {
  std::map<std::string, std::vector<std::string>> by_controller;
  for (const auto& camera : cameras) {
    if (!camera.usb_bus.empty()) {
      by_controller[camera.usb_controller + " (" + camera.usb_bus + ")"].push_back(camera.path);
    }
  }
  for (const auto& [controller, paths] : by_controller) {
    if (paths.size() < 2) continue;
    std::cout << "Share the USB controller " << controller << ":";
    for (const auto& path : paths) std::cout << " " << path;
    std::cout << "\n  Uncompressed images of two cameras do not fit onto one USB 2 bus: use format mjpg, or "
                 "a port of "
                 "another controller.\n";
  }
}

void printLaunchArguments(const std::vector<FoundDevice>& cameras) {
  if (cameras.size() < 2) {
    std::cout << "A stereo camera needs two cameras; " << cameras.size() << " found.\n";
    return;
  }
  std::cout << "To start with the first two (exchange them if left is right):\n"
            << "  roslaunch stereo_nav capture.launch left:=" << cameras[0].stableName()
            << " right:=" << cameras[1].stableName() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  const bool with_controls = argc == 2 && std::strcmp(argv[1], "--controls") == 0;
  if (argc > 1 && !with_controls) {
    std::cerr
        << "usage: list_cameras [--controls]\n"
           "Lists the connected cameras with their stable names, formats and, if asked for, controls.\n";
    return std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
  }
  std::vector<std::string> refused;
  const auto cameras = DeviceFinder(linuxKernel()).list(&refused);
  for (const auto& reason : refused) std::cout << reason << "\n";
  if (cameras.empty() && refused.empty())
    std::cout << "No camera found. Is one plugged in (`lsusb` shows it)?\n";
  for (const auto& camera : cameras) printCamera(camera, with_controls);
  printSharedControllers(cameras);
  printLaunchArguments(cameras);
  return 0;
}
