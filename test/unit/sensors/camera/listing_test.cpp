// The output of list_cameras.
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tools/list_cameras/camera_listing.h"
#include "unit/sensors/camera/expect_contains.h"
#include "unit/sensors/camera/fake_kernel.h"

namespace stereo_nav::camera {
namespace {

namespace fs = std::filesystem;

class Listing : public testing::Test {
 protected:
  /// A camera with its link by port, on port `port` of the bus `bus` of a USB controller.
  void plugIn(int number, const std::string& controller, const std::string& bus, const std::string& port) {
    FakeCamera camera;
    camera.bus_info = "usb-" + controller + "-" + port;
    camera.controls = {{V4L2_CID_GAIN, "Gain", 0, 100, 30}};
    kernel_.plugIn(number, camera);
    const fs::path dev = fs::path(kernel_.path(number)).parent_path(), root = dev.parent_path();
    const auto video = fs::path(kernel_.path(number)).filename();
    fs::create_directories(dev / "v4l/by-path");
    fs::create_symlink("../../" + video.string(), dev / "v4l/by-path" / ("pci-" + controller + "-" + port));
    const auto interface = root / "sys/devices" / controller / bus / ("1-" + port) / ("1-" + port + ":1.0");
    fs::create_directories(interface);
    std::ofstream(interface.parent_path() / "speed") << "480\n";
    fs::create_directories(root / "sys/class/video4linux" / video);
    fs::create_symlink(interface, root / "sys/class/video4linux" / video / "device");
  }

  std::string list(bool with_controls = false) {
    std::ostringstream text;
    tools::listCameras(kernel_, kernel_.finder(), with_controls, text);
    return text.str();
  }

  FakeKernel kernel_;
};

TEST_F(Listing, TwoCamerasOnOneControllerAreNamedWithTheRemedyAndTheLaunchArguments) {
  plugIn(0, "0000:00:14.0", "usb1", "1");
  plugIn(2, "0000:00:14.0", "usb1", "2");
  const std::string text = list();
  expectContains(text, "Fake camera");
  expectContains(text, "USB at 480 Mbit/s");
  expectContains(text,
                 "Share the USB controller 0000:00:14.0 (usb1): " + kernel_.path(0) + " " + kernel_.path(2));
  expectContains(text, "use format mjpg");
  const std::string by_path = fs::path(kernel_.path(0)).parent_path() / "v4l/by-path/pci-0000:00:14.0-";
  expectContains(text, "roslaunch stereo_nav capture.launch left:=" + by_path + "1 right:=" + by_path + "2");
  EXPECT_EQ(text.find("gain"), std::string::npos);
  expectContains(list(true), "0 to 100");
}

TEST_F(Listing, CamerasOnTwoControllersShareNothing) {
  plugIn(0, "0000:00:14.0", "usb1", "1");
  plugIn(2, "0000:00:1a.0", "usb3", "1");
  EXPECT_EQ(list().find("Share"), std::string::npos);
}

TEST_F(Listing, OneCameraIsNoStereoCameraAndARefusedOneIsExplained) {
  plugIn(0, "0000:00:14.0", "usb1", "1");
  plugIn(2, "0000:00:14.0", "usb1", "2");
  kernel_.change(2, [](FakeCamera& camera) { camera.open_error = EACCES; });
  const std::string text = list();
  expectContains(text, "usermod -aG video");
  expectContains(text, "A stereo camera needs two cameras; 1 found");
}

TEST_F(Listing, NoCameraSaysHowToLook) {
  expectContains(list(), "No camera found. Is one plugged in (`lsusb` shows it)?");
}

}  // namespace
}  // namespace stereo_nav::camera
