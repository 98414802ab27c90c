#include "sim/scenario.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_test_support.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::sim {
namespace {

std::string write(const std::string& text) {
  const std::string path = testing::TempDir() + "scenario.yaml";
  std::ofstream(path) << text;
  return path;
}

std::string messageOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    loadScenario(write(text), overrides);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(Scenario, ListsSectionsAndOverrides) {
  const Scenario scenario = loadScenario(write("path:\n"
                                               "  - {x_m: 1, y_m: 2}\n"
                                               "  - {action: wait, duration_s: 3}\n"
                                               "objects:\n"
                                               "  - {shape: cylinder, x_m: 4, material: {texture: wood}}\n"
                                               "timing: {time_offset_ms: 5}\n"),
                                         {"timing.jitter_ms=2", "imu.kind=raw", "timing.time_offset_ms=6"});
  ASSERT_EQ(scenario.path.size(), 2u);
  EXPECT_EQ(scenario.path[1].action, PathStep::Action::kWait);
  ASSERT_EQ(scenario.scene.objects.size(), 1u);
  EXPECT_EQ(scenario.scene.objects[0].material.texture, TextureKind::kWood);
  EXPECT_EQ(scenario.timing.time_offset_ms, 6.0);
  EXPECT_EQ(scenario.timing.jitter_ms, 2.0);
  EXPECT_EQ(scenario.imu.kind, ImuKind::kRaw);
}

TEST(Scenario, MessagesNameTheItem) {
  EXPECT_NE(messageOf("path:\n  - {x: 1}\n").find("path[0]: unknown parameter x"), std::string::npos);
  EXPECT_NE(messageOf("objects: {x_m: 1}\n").find("objects must be a list"), std::string::npos);
  EXPECT_NE(messageOf("weather: rain\n").find("unknown parameter weather"), std::string::npos);
  EXPECT_NE(messageOf("", {"timing.rate_hz=0"}).find("timing.rate_hz is 0"), std::string::npos);
  EXPECT_NE(messageOf("", {"rate"}).find("must look like"), std::string::npos);
  EXPECT_NE(messageOf("", {"imu.kind=["}).find("setting 'imu.kind=['"), std::string::npos);
  EXPECT_NE(messageOf("room: {y_min_m: 3, y_max_m: -3}\n").find("room.y_min_m is 3 and room.y_max_m is -3"),
            std::string::npos);
  EXPECT_NE(messageOf("events:\n  - {kind: light, from_s: 2, to_s: 1}\n").find("events[0].from_s is 2"),
            std::string::npos);
}

TEST(Scenario, AllThatAreShippedCanBeDriven) {
  std::size_t scenarios = 0;
  for (const auto& entry : std::filesystem::directory_iterator(STEREO_NAV_SOURCE_DIR "/config/scenarios")) {
    if (!entry.is_regular_file()) continue;  // parts of scenarios
    // The exposure has no part in this, and takes its time.
    const Scenario scenario = loadScenario(entry.path().string(), {"sensor.auto_exposure.on=false"});
    const Simulation simulation(scenario, thesisRig(), 1);
    EXPECT_GT(simulation.duration_s(), 5.0) << entry.path();
    EXPECT_GT(simulation.pairs().size(), 100u) << entry.path();
    // The robot never drives through an object: nothing is nearer to the camera than 0.2 m.
    const Scene scene(simulation.scenario().scene);
    for (double time_s = 0.0; time_s < simulation.duration_s(); time_s += 0.5) {
      const Eigen::Isometry3d T = simulation.cameraPose(Side::kLeft, time_s);
      EXPECT_GT(scene.castRay(T.translation(), T.linear().col(2), time_s), 0.2)
          << entry.path() << " at " << time_s;
    }
    ++scenarios;
  }
  EXPECT_GE(scenarios, 9u);
}

TEST(Scenario, AFileExtendsOthers) {
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "base.yaml") << "path:\n  - {x_m: 1}\n"
                                         "objects:\n  - {x_m: 4}\n"
                                         "sensor: {read_noise: 2, exposure_ms: 7}\n"
                                         "room: {height_m: 3, floor: {contrast: 0.5}}\n";
  std::ofstream(folder + "part.yaml") << "objects:\n  - {x_m: 5}\nroom: {floor: {brightness: 0.7}}\n";
  const Scenario scenario =
      loadScenario(write("extends: [base.yaml, part.yaml]\n"
                         "objects:\n  - {x_m: 6}\n"
                         "sensor: {exposure_ms: 9}\n"));
  ASSERT_EQ(scenario.scene.objects.size(), 3u);
  EXPECT_EQ(scenario.scene.objects[0].x_m, 4.0);
  EXPECT_EQ(scenario.scene.objects[2].x_m, 6.0);
  EXPECT_EQ(scenario.path.size(), 1u);
  EXPECT_EQ(scenario.sensor.read_noise, 2.0);
  EXPECT_EQ(scenario.sensor.exposure_ms, 9.0);
  EXPECT_EQ(scenario.scene.room.height_m, 3.0);
  EXPECT_EQ(scenario.scene.room.floor.contrast, 0.5);
  EXPECT_EQ(scenario.scene.room.floor.brightness, 0.7);
  const Scenario webcam =
      loadScenario(write("extends: base.yaml\nsensor: {preset: webcam, exposure_ms: 20}\n"));
  EXPECT_EQ(webcam.sensor.exposure_ms, 20.0);
  EXPECT_EQ(webcam.sensor.read_noise, 0.45);  // that of the base was for another camera
  EXPECT_NE(messageOf("extends: scenario.yaml\n").find("does one of them extend itself?"), std::string::npos);
  EXPECT_NE(messageOf("extends: {x: 1}\n").find("extends must be the name"), std::string::npos);
  EXPECT_NE(messageOf("extends: nowhere.yaml\n").find("nowhere.yaml"), std::string::npos);
  EXPECT_NE(messageOf("sensor: {auto_exposure: {on: true}}\n").find("full_scale_ms is 0"), std::string::npos);
}

TEST(Scenario, LampsFailAndLensesAreCovered) {
  const Simulation dark(loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/dark.yaml"), thesisRig(), 1);
  const auto brightness = [](const Simulation& simulation, Side side, double time_s) {
    return cv::mean(simulation.image(side, static_cast<std::size_t>(time_s * 30.0)))[0];
  };
  EXPECT_GT(brightness(dark, Side::kLeft, 2.0), 50.0);
  EXPECT_LT(brightness(dark, Side::kLeft, 14.0), 5.0);
  const Simulation blocked(loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/blocked.yaml"), thesisRig(),
                           1);
  EXPECT_LT(brightness(blocked, Side::kRight, 5.0), 15.0);
  EXPECT_GT(brightness(blocked, Side::kLeft, 5.0), 50.0);
  EXPECT_LT(brightness(blocked, Side::kLeft, 15.0), 15.0);
}

}  // namespace
}  // namespace stereo_nav::sim
