#include "stereo_nav/eval/report.h"

#include <cstdlib>

#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav::eval {
namespace {

/// Sets an environment variable for the length of a test.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name), before_(std::getenv(name)) {
    ::setenv(name, value.c_str(), 1);
  }
  ~EnvironmentVariable() { ::setenv(name_, before_.c_str(), 1); }

 private:
  const char* name_;
  std::string before_;
};

EvaluationInput circle(bool with_ground_truth) {
  EvaluationInput input;
  input.input = "a <bag> & its name";
  input.config = "vo.yaml";
  for (int i = 0; i < 60; ++i) {
    FrameRecord frame;
    frame.time_s = 0.1 * i;
    const double angle = 0.1 * i;
    const Eigen::Isometry3d T_odom_base = pose(std::sin(angle), 1.0 - std::cos(angle), 0.01 * i, 5.7 * i);
    if (i != 30) {
      frame.T_odom_base = T_odom_base;
    } else {
      frame.reason = "a <dark> frame";
    }
    frame.features = 150;
    frame.inliers = 70;
    frame.timing = {5.0, 12.0, {{"it's corners", 2.0}, {"tracking_klt", 3.0}}};
    input.frames.push_back(frame);
    if (with_ground_truth) input.ground_truth.push_back({0.1 * i, pose(0, 0.01, 0) * T_odom_base});
  }
  return input;
}

std::optional<std::string> write(const TemporaryFolder& folder, const EvaluationInput& input) {
  std::vector<FrameTiming> timings;
  for (const auto& frame : input.frames) timings.push_back(frame.timing);
  return writeReport(folder.path(), evaluate(input), input, summariseTiming(timings));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Report, holdsItsPictures) {
  const TemporaryFolder folder;
  EXPECT_EQ(write(folder, circle(true)).value_or(""), "");
  const auto html = folder.read("report.html");
  EXPECT_EQ(count(html, "<svg"), 5u);
  EXPECT_EQ(count(html, "</svg>"), 5u);
  EXPECT_EQ(count(html, "frame 30 (3.00 s)</td><td>a &lt;dark> frame"), 1u);
  EXPECT_NE(html.find("a &lt;bag> &amp; its name"), std::string::npos);
  EXPECT_NE(html.find("1 / 60"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos) << "the page must not need other files";
  for (const char* name : {"path_top", "path_height", "error", "features", "stages"}) {
    EXPECT_NE(folder.read(std::string(name) + ".svg").find("</svg>"), std::string::npos) << name;
  }
  EXPECT_EQ(folder.countFiles(), 6u);
}

TEST(Report, withoutGroundTruthThereIsNoErrorPicture) {
  const TemporaryFolder folder;
  EXPECT_EQ(write(folder, circle(false)).value_or(""), "");
  EXPECT_EQ(count(folder.read("report.html"), "<svg"), 4u);
  EXPECT_FALSE(std::filesystem::exists(folder / "error.svg"));
}

TEST(Report, aSingleFrameAtRestIsDrawn) {
  const TemporaryFolder folder;
  auto input = circle(false);
  input.frames.resize(1);
  EXPECT_EQ(write(folder, input).value_or(""), "");
}

TEST(Report, everyFrameLostIsDrawn) {
  const TemporaryFolder folder;
  auto input = circle(true);
  for (auto& frame : input.frames) {
    frame.T_odom_base.reset();
    frame.timing = {};
  }
  EXPECT_EQ(write(folder, input).value_or(""), "");
}

TEST(Report, withoutGnuplotTheFiguresAreStillWritten) {
  const TemporaryFolder folder;
  const EnvironmentVariable no_programs("PATH", folder.path());
  const auto warning = write(folder, circle(true));
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("sudo apt-get install gnuplot-nox"), std::string::npos) << *warning;
  EXPECT_EQ(warning->find('\n'), std::string::npos);
  EXPECT_NE(folder.read("report.html").find("gnuplot cannot be started"), std::string::npos);
  EXPECT_EQ(folder.countFiles(), 1u);
}

TEST(Report, anUnwritableFolderIsAnError) {
  const TemporaryFolder folder;
  const auto input = circle(false);
  folder.write("file", "");
  EXPECT_THROW(writeReport(folder / "file", evaluate(input), input, summariseTiming({})), InputError);
}

}  // namespace
}  // namespace stereo_nav::eval
