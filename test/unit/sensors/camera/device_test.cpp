#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "sensors/camera/capture_params.h"
#include "sensors/camera/controls.h"
#include "sensors/camera/v4l2_device.h"
#include "unit/sensors/camera/expect_contains.h"
#include "unit/sensors/camera/fake_kernel.h"

namespace stereo_nav::camera {
namespace {

const FormatRequest kRequest{PixelFormat::kAny, 32, 16, 250.0};

/// Message of the failure of `attempt`.
template <class Attempt>
std::string messageOf(Attempt&& attempt) {
  try {
    attempt();
  } catch (const CaptureError& error) {
    return error.what();
  }
  return "no error";
}

class Device : public testing::Test {
 protected:
  std::string failure(const FakeCamera& camera) {
    kernel_.plugIn(0, camera);
    const std::string message = messageOf([this] {
      V4l2Device device(kernel_, kernel_.path(0));
      device.configure(kRequest);
      device.startStreaming(4);
      while (!device.wait(100)) {
      }
      device.dequeue();
    });
    EXPECT_EQ(kernel_.openDescriptors(), 0) << "a failed camera is closed";
    EXPECT_EQ(kernel_.mappings(), 0) << "and its memory is given back";
    return message;
  }

  FakeKernel kernel_;
};

TEST_F(Device, DeliversFramesWithStampAndSequence) {
  kernel_.plugIn(0, FakeCamera{});
  V4l2Device device(kernel_, kernel_.path(0));
  const auto format = device.configure(kRequest);
  EXPECT_EQ(format.layout.format, PixelFormat::kGrey);
  EXPECT_DOUBLE_EQ(format.rate_hz, 250.0);
  device.startStreaming(4);
  for (std::uint32_t expected = 0; expected < 10; ++expected) {
    ASSERT_TRUE(device.wait(1000));
    const auto buffer = device.dequeue();
    ASSERT_TRUE(buffer);
    EXPECT_EQ(buffer->sequence, expected);
    EXPECT_EQ(buffer->size, 32u * 16u);
    EXPECT_FALSE(buffer->isBroken());
    device.giveBack(*buffer);
  }
}

TEST_F(Device, NoBandwidthIsExplainedWithItsRemedies) {
  FakeCamera camera;
  camera.stream_on_error = ENOSPC;
  const auto message = failure(camera);
  expectContains(message, "USB bus has no bandwidth");
  expectContains(message, "mjpg");
  expectContains(message, "lower rate");
  expectContains(message, "port");
}

TEST_F(Device, PermissionNamesTheGroup) {
  FakeCamera camera;
  camera.open_error = EACCES;
  expectContains(failure(camera), "usermod -aG video");
}

TEST_F(Device, UnpluggedAndBrokenTransfersAreToldApart) {
  FakeCamera camera;
  camera.dequeue_error = ENODEV;
  expectContains(failure(camera), "unplugged");
  camera.dequeue_error = EIO;
  expectContains(failure(camera), "USB transfer failed");
}

TEST_F(Device, BusyNamesTheProcess) {
  FakeCamera camera;
  camera.buffers_error = EBUSY;
  kernel_.plugIn(0, camera);
  const int descriptor = ::open(kernel_.path(0).c_str(), O_RDONLY);
  const auto message = failure(camera);
  ::close(descriptor);
  expectContains(message, "in use by");
  expectContains(message, "(pid " + std::to_string(getpid()) + ")");
}

TEST_F(Device, BusyWithoutAVisibleProcessSaysHowToFindIt) {
  FakeCamera camera;
  camera.format_error = EBUSY;
  expectContains(failure(camera), "fuser -v");
}

TEST_F(Device, AnotherSizeIsRefusedAndSaysWhatTheDriverOffers) {
  FakeCamera camera;
  camera.width_instead = 48;
  const auto message = failure(camera);
  expectContains(message, "asked for 32x16");
  expectContains(message, "48x16");
  expectContains(message, "list_cameras");
}

TEST_F(Device, AFormatThatNobodyDecodesIsRefused) {
  FakeCamera camera;
  camera.fourcc = V4L2_PIX_FMT_H264;
  expectContains(failure(camera), "offers H264");
}

TEST_F(Device, MissingDeviceSaysHowToListThem) {
  const auto message = messageOf([this] { V4l2Device device(kernel_, kernel_.path(7)); });
  expectContains(message, "no such device");
  expectContains(message, "list_cameras");
}

TEST_F(Device, FindsCamerasByPathByLinkAndByPort) {
  FakeCamera left, right, metadata;
  left.bus_info = "usb-fake-1";
  right.bus_info = "usb-fake-2";
  metadata.bus_info = "usb-fake-1";
  metadata.metadata_node = true;
  kernel_.plugIn(1, left);
  kernel_.plugIn(2, metadata);
  kernel_.plugIn(10, right);
  const auto finder = kernel_.finder();
  const auto devices = finder.list();
  ASSERT_EQ(devices.size(), 2u) << "the metadata node is no camera";
  EXPECT_EQ(devices[0].bus_info, "usb-fake-1");

  EXPECT_EQ(finder.find("usb-fake-2").path, kernel_.path(10));
  EXPECT_EQ(finder.find(kernel_.path(1)).bus_info, "usb-fake-1");
  const std::filesystem::path links = std::filesystem::path(kernel_.path(1)).parent_path() / "v4l/by-path";
  std::filesystem::create_directories(links);
  std::filesystem::create_symlink("../../video10", links / "pci-usb-2-video-index0");
  const auto by_link = finder.find(links / "pci-usb-2-video-index0");
  EXPECT_EQ(by_link.path, kernel_.path(10));
  EXPECT_EQ(by_link.stableName(), links / "pci-usb-2-video-index0");

  kernel_.change(10, [](FakeCamera& camera) { camera.open_error = EACCES; });
  std::vector<std::string> refused;
  EXPECT_EQ(finder.list(&refused).size(), 1u);
  ASSERT_EQ(refused.size(), 1u) << "the metadata node is not worth a word";
  expectContains(refused[0], "usermod");
  expectContains(messageOf([&] { finder.find("usb-fake-2"); }), "usermod");
  kernel_.change(10, [](FakeCamera& camera) { camera.open_error = 0; });

  expectContains(messageOf([&] { finder.find("usb-fake-3"); }), "connected: usb-fake-1, usb-fake-2");
  expectContains(messageOf([&] { finder.find(kernel_.path(2)); }), "does not capture video");
  expectContains(messageOf([&] { finder.find(""); }), "list_cameras");
}

TEST_F(Device, ReadsControllerAndSpeedFromSysfs) {
  kernel_.plugIn(3, FakeCamera{});
  const std::filesystem::path root = std::filesystem::path(kernel_.path(3)).parent_path().parent_path();
  const auto interface = root / "sys/devices/pci0000:00/0000:00:14.0/usb1/1-2/1-2:1.0";
  std::filesystem::create_directories(interface);
  std::filesystem::create_directories(root / "sys/class/video4linux/video3");
  std::filesystem::create_symlink(interface, root / "sys/class/video4linux/video3/device");
  std::ofstream(interface.parent_path() / "speed") << "480\n";
  std::ofstream(root / "sys/class/video4linux/video3/index") << "1\n";
  const auto device = kernel_.finder().find(kernel_.path(3));
  EXPECT_EQ(device.usb_controller, "0000:00:14.0");
  EXPECT_EQ(device.usb_bus, "usb1");
  EXPECT_EQ(device.usb_speed_mbps, 480);
  EXPECT_EQ(device.index, 1);
}

TEST(Controls, NamesAreThoseOfV4l2Ctl) {
  EXPECT_EQ(controlName("Exposure, Auto Priority"), "exposure_auto_priority");
  EXPECT_EQ(controlName("Exposure (Absolute)"), "exposure_absolute");
  EXPECT_EQ(controlName("Power Line Frequency"), "power_line_frequency");
}

TEST(Controls, OldAndNewNamesMeanTheSame) {
  std::vector<Control> controls(2);
  controls[0].name = "auto_exposure";
  controls[1].name = "exposure_auto_priority";
  EXPECT_EQ(findControl(controls, "exposure_auto"), &controls[0]);
  EXPECT_EQ(findControl(controls, "auto_exposure"), &controls[0]);
  EXPECT_EQ(findControl(controls, "exposure_dynamic_framerate"), &controls[1]);
  EXPECT_EQ(findControl(controls, "gain"), nullptr);
}

TEST(Controls, OneSettingAControlWhateverItIsCalled) {
  std::vector<ControlSetting> settings;
  setIn(settings, {"exposure_auto", 3});
  setIn(settings, {"gain", 10});
  setIn(settings, {"auto_exposure", 1});
  setIn(settings, {"gain", 20});
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_EQ(settings[0].value, 1);
  EXPECT_EQ(settings[1].value, 20);
}

TEST(Controls, AutomaticModesAreSetFirst) {
  const auto ordered = inOrderOfSetting({{"exposure_absolute", 100}, {"exposure_auto", 1}, {"gain", 3}});
  EXPECT_EQ(ordered[0].name, "exposure_auto");
  EXPECT_EQ(ordered[1].name, "exposure_absolute");
  EXPECT_EQ(ordered[2].name, "gain");
}

TEST(Controls, ExposureAndGainStandForV4l2Settings) {
  EXPECT_TRUE(exposureControls(-1.0, -1).empty()) << "as the camera is set";
  const auto automatic = exposureControls(0.0, -1);
  ASSERT_EQ(automatic.size(), 1u);
  EXPECT_EQ(automatic[0].name, "auto_exposure");
  EXPECT_EQ(automatic[0].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
  const auto manual = exposureControls(12.5, 40);
  ASSERT_EQ(manual.size(), 3u);
  EXPECT_EQ(manual[0].name, "auto_exposure");
  EXPECT_EQ(manual[0].value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(manual[1].name, "exposure_time_absolute");
  EXPECT_EQ(manual[1].value, 125) << "V4L2 counts 100 us";
  EXPECT_EQ(manual[2].name, "gain");
  EXPECT_EQ(manual[2].value, 40);
}

}  // namespace
}  // namespace stereo_nav::camera
