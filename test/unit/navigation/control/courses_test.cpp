// The bounds on the courses that $STEREO_NAV_DATA/courses defines, built here from their definition.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/angles.h"
#include "navigation/control/as_published.h"
#include "navigation/control/course_run.h"
#include "navigation/control/path_driver.h"

namespace stereo_nav::control {
namespace {

/// A curve, in steps much finer than 1 cm, as points 1 cm apart and rounded to 0.1 mm, as the files have
/// them.
template <class Curve>
Path sampled(Curve curve, double from, double to) {
  std::vector<Eigen::Vector2d> points = {curve(from)};
  constexpr int kFine = 200000;
  double way_m = 0.0;
  for (int i = 1; i <= kFine; ++i) {
    const Eigen::Vector2d a = curve(from + (to - from) * (i - 1) / kFine);
    const Eigen::Vector2d b = curve(from + (to - from) * i / kFine);
    way_m += (b - a).norm();
    if (way_m < 0.01 && i < kFine) continue;
    points.emplace_back((1e4 * b).array().round().matrix() * 1e-4);
    way_m = 0.0;
  }
  return Path(points);
}

Path course(const std::string& name) {
  if (name == "corner") return Path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  if (name == "s_curve")
    return sampled([](double x) { return Eigen::Vector2d(x, 0.5 * std::sin(0.5 * kPi * x)); }, 0.0, 8.0);
  return sampled([](double t) { return Eigen::Vector2d(3.0 * std::sin(t), 1.5 * std::sin(2.0 * t)); }, 0.0,
                 2.0 * kPi);
}

struct Case {
  FollowLaw law;
  std::string course;
  double speed_m_per_s, worst_mm;
};

ControlParams paramsOf(const Case& test_case) {
  ControlParams params;
  params.law = test_case.law;
  params.speed.max_speed_m_per_s = test_case.speed_m_per_s;
  if (params.law == FollowLaw::kStanley) params.drive.wheelbase_m = 0.5;
  return params;
}

CourseRun drive(const Case& test_case, const CourseOptions& given = {}) {
  const ControlParams params = paramsOf(test_case);
  const Path path = course(test_case.course);
  CourseOptions options = given;
  options.drive.wheelbase_m = params.drive.wheelbase_m;
  options.reference_m = params.reference_m();
  PathDriver driver(params, path);
  return driveCourse(path, driver, options);
}

std::string nameOfCase(const testing::TestParamInfo<Case>& test_info) {
  const std::map<FollowLaw, std::string> names = {{FollowLaw::kHolonomic, "Holonomic"},
                                                  {FollowLaw::kPursuit, "Pursuit"},
                                                  {FollowLaw::kStanley, "Stanley"}};
  const Case& test_case = test_info.param;
  return names.at(test_case.law) + "_" + test_case.course + (test_case.speed_m_per_s > 1.5 ? "_fast" : "");
}

class Courses : public testing::TestWithParam<Case> {};

TEST_P(Courses, TheDistanceStaysWithinItsBoundAndTheBaseStopsAtTheGoal) {
  const CourseRun run = drive(GetParam());
  EXPECT_TRUE(run.finished);
  EXPECT_LE(1e3 * run.worst_m, GetParam().worst_mm);
  EXPECT_LE(1e3 * run.end_distance_m, 20.0);
  // The heading of a vehicle whose front axle follows a path is not that of the path: see the next test.
  if (GetParam().law != FollowLaw::kStanley) {
    EXPECT_LE(kDegPerRad * run.end_heading_error_rad, 2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    AsDefined, Courses,
    testing::Values(
        Case{FollowLaw::kHolonomic, "corner", 1.0, 22.0}, Case{FollowLaw::kHolonomic, "s_curve", 1.0, 22.0},
        Case{FollowLaw::kHolonomic, "eight", 1.0, 22.0}, Case{FollowLaw::kHolonomic, "corner", 2.0, 28.0},
        Case{FollowLaw::kHolonomic, "s_curve", 2.0, 28.0}, Case{FollowLaw::kHolonomic, "eight", 2.0, 28.0},
        Case{FollowLaw::kPursuit, "corner", 1.0, 55.0}, Case{FollowLaw::kPursuit, "s_curve", 1.0, 10.0},
        Case{FollowLaw::kPursuit, "eight", 1.0, 10.0}, Case{FollowLaw::kPursuit, "corner", 2.0, 57.0},
        Case{FollowLaw::kPursuit, "s_curve", 2.0, 15.0}, Case{FollowLaw::kPursuit, "eight", 2.0, 15.0},
        Case{FollowLaw::kStanley, "s_curve", 1.0, 40.0}, Case{FollowLaw::kStanley, "eight", 1.0, 40.0},
        Case{FollowLaw::kStanley, "s_curve", 2.0, 100.0}, Case{FollowLaw::kStanley, "eight", 2.0, 100.0}),
    nameOfCase);

/// Heading error at the end of a vehicle whose front axle is exactly on the path all the way: its rear axle
/// is a tractrix of it.
double exactFrontAxleError(const Path& path, double wheelbase_m) {
  double heading_rad = path.at(0.0).heading_rad;
  for (double arc_m = 0.0; arc_m < path.length_m(); arc_m += 1e-3)
    heading_rad += 1e-3 / wheelbase_m * std::sin(path.at(arc_m).heading_rad - heading_rad);
  return std::abs(path.points().back().heading_rad - heading_rad);
}

TEST(Stanley, EndsWithTheHeadingThatItsFrontAxleOnThePathMeans) {
  for (const std::string name : {"s_curve", "eight"}) {
    const CourseRun run = drive({FollowLaw::kStanley, name, 1.0, 0.0});
    EXPECT_NEAR(kDegPerRad * run.end_heading_error_rad, kDegPerRad * exactFrontAxleError(course(name), 0.5),
                2.0)
        << name;
  }
}

// Expected to fail: a car whose front axle is on the S curve does not end within 2 degrees of its heading,
// and within 40 mm of the curve no way of the front axle does; docs/results_driving.md says why. The test
// notices if it does after all.
TEST(Stanley, DoesNotEndWithTheHeadingOfTheSCurve) {
  const CourseRun run = drive({FollowLaw::kStanley, "s_curve", 1.0, 0.0});
  EXPECT_GT(kDegPerRad * run.end_heading_error_rad, 2.0);
  // The rear axle follows with a lag of one wheelbase: an offset y of the front axle, held all the way up to
  // the end, turns the car by y / wheelbase at most.
  const double most_turn_rad = 0.040 / 0.5;
  EXPECT_GT(kDegPerRad * (exactFrontAxleError(course("s_curve"), 0.5) - most_turn_rad), 2.0);
}

TEST(Pursuit, ASteeredVehicleThatFollowsWithItsRearAxleStopsWithThePathsHeading) {
  const Path path = course("s_curve");
  ControlParams params = paramsOf({FollowLaw::kPursuit, "s_curve", 1.0, 0.0});
  params.drive.wheelbase_m = 0.5;
  CourseOptions options;
  options.drive = params.drive;
  PathDriver driver(params, path);
  const CourseRun run = driveCourse(path, driver, options);
  EXPECT_LE(1e3 * run.worst_m, 10.0);
  EXPECT_LE(1e3 * run.end_distance_m, 20.0);
  EXPECT_LE(kDegPerRad * run.end_heading_error_rad, 2.0);
}

TEST(Latency, OfTheOdometryIsMadeUpForByItsStamp) {
  const Case test_case{FollowLaw::kPursuit, "eight", 2.0, 15.0};
  CourseOptions late;
  late.odometry_age_s = 0.1;
  const CourseRun run = drive(test_case, late);
  EXPECT_TRUE(run.finished);
  EXPECT_LE(1e3 * run.worst_m, test_case.worst_mm);
  EXPECT_LE(1e3 * run.end_distance_m, 20.0);
}

TEST(Latency, ADriveThatDiffersFromItsModelIsFollowedStill) {
  for (const FollowLaw law : {FollowLaw::kHolonomic, FollowLaw::kPursuit, FollowLaw::kStanley}) {
    CourseOptions slower;
    slower.drive.lag_s = 0.12;
    slower.drive.dead_time_s = 0.06;
    const CourseRun run = drive({law, "s_curve", 2.0, 0.0}, slower);
    EXPECT_TRUE(run.finished);
    EXPECT_LE(1e3 * run.worst_m, 30.0);
    EXPECT_LE(1e3 * run.end_distance_m, 20.0);
  }
}

/// Figures of the works' own forms on these courses and this drive, which docs/results.md quotes.
TEST(AsPublished, PursuitIsAsFarFromThePathAsWasMeasuredOfIt) {
  const std::map<std::string, double> worst_mm = {{"corner", 60.0}, {"s_curve", 12.0}, {"eight", 15.0}};
  for (const auto& [name, expected_mm] : worst_mm) {
    const Path path = course(name);
    PublishedPursuit follower(path, {});
    CourseOptions options;
    options.until_near_end = true;
    EXPECT_NEAR(1e3 * driveCourse(path, follower, options).worst_m, expected_mm, 5.0) << name;
  }
}

TEST(AsPublished, StanleyIsAsFarFromThePathAsWasMeasuredOfIt) {
  const std::map<std::string, double> worst_mm = {{"s_curve", 34.0}, {"eight", 35.0}};
  for (const auto& [name, expected_mm] : worst_mm) {
    const Path path = course(name);
    PublishedStanley follower(path, {});
    CourseOptions options;
    options.until_near_end = true;
    options.drive.wheelbase_m = options.reference_m = 0.5;
    EXPECT_NEAR(1e3 * driveCourse(path, follower, options).worst_m, expected_mm, 5.0) << name;
  }
}

}  // namespace
}  // namespace stereo_nav::control
