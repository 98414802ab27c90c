#include "vision/judged_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "stereo_nav/core/input_error.h"
#include "support/text.h"

namespace stereo_nav::vision {
namespace {

/// One camera of a pair with lenses that bend: 640x480, 500 px, 0.12 m apart.
CameraFields camera(bool right) {
  CameraFields fields;
  fields.size = cv::Size(640, 480);
  fields.distortion_model = "plumb_bob";
  fields.D = {-0.3, 0.1, 0.001, -0.002, 0.0};
  fields.K = {500, 0, 320, 0, 501, 240, 0, 0, 1};
  fields.R = cv::Matx33d::eye();
  fields.P = {480, 0, 310, right ? -480 * 0.12 : 0.0, 0, 480, 235, 0, 0, 0, 1, 0};
  return fields;
}

using Change = std::function<void(CameraFields&)>;

/// The message for a pair whose cameras were both changed, or "accepted".
std::string verdict(const Change& change) {
  CameraFields left = camera(false), right = camera(true);
  change(left);
  change(right);
  try {
    judgePair(left, right);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expectRefused(const std::string& part, const Change& change) {
  const std::string message = verdict(change);
  EXPECT_TRUE(contains(message, part)) << "expected '" << part << "', got: " << message;
}

cv::Matx33d turned(double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c, 0, s, 0, 1, 0, -s, 0, c};
}

void makeDistortionless(CameraFields& fields) {
  fields.D.assign(5, 0.0);
}

void makeRectified(CameraFields& fields) {
  makeDistortionless(fields);
  fields.K = fields.P.get_minor<3, 3>(0, 0);
}

TEST(JudgedPair, AGoodPairIsLeftAsItIs) {
  const JudgedPair pair = judgePair(camera(false), camera(true));
  EXPECT_TRUE(pair.notes.empty());
  EXPECT_EQ(pair.left.D, camera(false).D);
  EXPECT_EQ(pair.right.K, camera(true).K);
  EXPECT_EQ(pair.right.P, camera(true).P);
  EXPECT_EQ(pair.calibration.width, 640);
  EXPECT_NEAR(pair.calibration.baseline_m, 0.12, 1e-12);
}

TEST(JudgedPair, EveryModelHasItsNumberOfCoefficients) {
  const auto with = [](const std::string& model, std::size_t count) {
    return verdict([&](CameraFields& fields) {
      fields.distortion_model = model;
      fields.D.assign(count, 0.001);
    });
  };
  for (const std::size_t count : {4, 5}) EXPECT_EQ(with("plumb_bob", count), "accepted") << count;
  for (const std::size_t count : {8, 12, 14}) EXPECT_EQ(with("rational_polynomial", count), "accepted");
  EXPECT_EQ(with("equidistant", 4), "accepted");
  for (const std::size_t count : {1, 2, 3, 6, 8}) {
    EXPECT_TRUE(contains(with("plumb_bob", count), "coefficients, plumb_bob has 5")) << count;
  }
  for (const std::size_t count : {4, 5, 9}) {
    EXPECT_TRUE(contains(with("rational_polynomial", count), "rational_polynomial has 8")) << count;
  }
  EXPECT_TRUE(contains(with("equidistant", 5), "equidistant has 4"));
  EXPECT_TRUE(contains(with("", 5), "distortion_model is empty"));
}

TEST(JudgedPair, OtherModelsAreNamedWithTheWayOut) {
  for (const char* model : {"fisheye", "kannala_brandt", "omni", "radtan", "PLUMB_BOB", "double_sphere"}) {
    const std::string message = verdict([&](CameraFields& fields) { fields.distortion_model = model; });
    EXPECT_TRUE(contains(message, std::string("distortion_model '") + model + "' is not supported"))
        << message;
    EXPECT_TRUE(contains(message, "calibrate with one of them")) << message;
  }
  expectRefused("'fisheye' is not supported", [](CameraFields& fields) {
    makeRectified(fields);
    fields.distortion_model = "fisheye";
  });
}

TEST(JudgedPair, ARectifiedPairWithoutModelIsUsedAsItIs) {
  for (const char* model : {"", "none", "Brown Conrady"}) {
    for (const bool with_rotation : {true, false}) {
      CameraFields left = camera(false), right = camera(true);
      for (CameraFields* fields : {&left, &right}) {
        makeRectified(*fields);
        fields->D.clear();
        fields->distortion_model = model;
        if (!with_rotation) fields->R = cv::Matx33d::zeros();
      }
      const JudgedPair pair = judgePair(left, right);
      EXPECT_EQ(pair.left.distortion_model, "plumb_bob");
      EXPECT_EQ(pair.left.D, std::vector<double>(5, 0.0)) << "the images are copied";
      EXPECT_EQ(cv::norm(pair.right.R - cv::Matx33d::eye()), 0.0);
      ASSERT_EQ(pair.notes.size(), 2u);
      EXPECT_TRUE(contains(pair.notes[0], "taken as rectified already")) << pair.notes[0];
    }
  }
  expectRefused("R and P say that the image is not rectified", [](CameraFields& fields) {
    fields.D.clear();
    fields.distortion_model = "";
  });
}

TEST(JudgedPair, MatricesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefused("holds a NaN", [&](CameraFields& fields) { fields.K(0, 2) = nan; });
  expectRefused("holds a NaN", [&](CameraFields& fields) { fields.D[1] = nan; });
  expectRefused("not calibrated", [](CameraFields& fields) { fields.K = cv::Matx33d::zeros(); });
  expectRefused("not calibrated", [](CameraFields& fields) { fields.P = cv::Matx34d::zeros(); });
  expectRefused("image size is 0x480", [](CameraFields& fields) { fields.size.width = 0; });
  expectRefused("R is no rotation", [](CameraFields& fields) { fields.R(0, 1) = 0.3; });
  expectRefused("R is no rotation", [](CameraFields& fields) { fields.R(2, 2) = -1.0; });
  expectRefused("R is all zero", [](CameraFields& fields) { fields.R = cv::Matx33d::zeros(); });
  expectRefused("K[1] is 4", [](CameraFields& fields) { fields.K(0, 1) = 4.0; });
  expectRefused("P[1] is 4", [](CameraFields& fields) { fields.P(0, 1) = 4.0; });
  expectRefused("P[7] is -50", [](CameraFields& fields) { fields.P(1, 3) = -50.0; });
  expectRefused("P[10] is 2", [](CameraFields& fields) { fields.P(2, 2) = 2.0; });
  expectRefused("P[11] is 1", [](CameraFields& fields) { fields.P(2, 3) = 1.0; });
  expectRefused("K[6] is 0.5", [](CameraFields& fields) { fields.K(2, 0) = 0.5; });
}

TEST(JudgedPair, FocalLengthAndPrincipalPointFitTheImage) {
  expectRefused("K[0] is 4 px", [](CameraFields& fields) { fields.K(0, 0) = fields.K(1, 1) = 4.0; });
  expectRefused("P[0] is 1.5 px", [](CameraFields& fields) { fields.P(0, 0) = fields.P(1, 1) = 1.5; });
  expectRefused("K[0] is -500 px", [](CameraFields& fields) { fields.K(0, 0) = -500.0; });
  expectRefused("K[0] is 50000 px", [](CameraFields& fields) { fields.K(0, 0) = 50000.0; });
  expectRefused("more than twice as long as high", [](CameraFields& fields) { fields.K(1, 1) = 1200.0; });
  expectRefused("the principal point of K, (700, 240)", [](CameraFields& fields) { fields.K(0, 2) = 700; });
  expectRefused("the principal point of K, (320, -20)", [](CameraFields& fields) { fields.K(1, 2) = -20; });
  expectRefused("the principal point of P, (2000, 235)", [](CameraFields& fields) { fields.P(0, 2) = 2000; });
}

TEST(JudgedPair, BaselinesInAnotherUnitAreNamed) {
  const auto with = [](double P3) {
    return verdict([&](CameraFields& fields) {
      if (fields.P(0, 3) != 0.0) fields.P(0, 3) = P3;
    });
  };
  EXPECT_TRUE(contains(with(-480 * 122.6), "the baseline is 122.6 m")) << with(-480 * 122.6);
  EXPECT_TRUE(contains(with(-480 * 122.6), "likely in mm (0.1226 m)")) << with(-480 * 122.6);
  EXPECT_TRUE(contains(with(-480 * 12.26), "likely in cm (0.1226 m)")) << with(-480 * 12.26);
  EXPECT_TRUE(contains(with(-0.1226), "P[3] is likely the baseline itself (0.1226 m)")) << with(-0.1226);
  EXPECT_TRUE(contains(with(-480 * 0.019), "expected are 0.02 to 2 m"));
  EXPECT_TRUE(contains(with(0.0), "without baseline"));
  EXPECT_TRUE(contains(with(480 * 0.12), "swapped"));
  EXPECT_EQ(with(-480 * 0.03), "accepted");
  EXPECT_EQ(with(-480 * 1.9), "accepted");
}

TEST(JudgedPair, TwoCalibrationsMustBeOfOnePair) {
  CameraFields left = camera(false);
  left.P(0, 0) = 470;
  EXPECT_THROW(judgePair(left, camera(true)), InputError);
  left = camera(false);
  left.P(1, 2) += 1e-7;
  EXPECT_EQ(judgePair(left, camera(true)).left.P(1, 2), 235.0) << "image_geometry asserts equality";
  left = camera(false);
  left.size = cv::Size(800, 600);
  EXPECT_THROW(judgePair(left, camera(true)), InputError);
}

TEST(JudgedPair, RoiAndBinningMustFitTheImage) {
  expectRefused("roi (x_offset 160, y_offset 0, 640x480) does not lie in the image of 640x480",
                [](CameraFields& fields) { fields.roi = cv::Rect(160, 0, 640, 480); });
  expectRefused("roi (x_offset 160", [](CameraFields& fields) { fields.roi = cv::Rect(160, 0, 0, 0); });
  expectRefused("roi (x_offset 0", [](CameraFields& fields) { fields.roi = cv::Rect(0, 0, 2147483647, 1); });
  expectRefused("binning of 700x1", [](CameraFields& fields) { fields.binning = cv::Size(700, 1); });
  EXPECT_EQ(verdict([](CameraFields& fields) { fields.roi = cv::Rect(0, 0, 640, 480); }), "accepted");
}

/// The rectification of a delivered pixel is that of the calibrated pixels it is made of.
TEST(JudgedPair, RoiAndBinningAreWorkedIntoTheMatrices) {
  CameraFields left = camera(false), right = camera(true);
  for (CameraFields* fields : {&left, &right}) {
    fields->roi = cv::Rect(100, 60, 400, 300);
    fields->binning = cv::Size(2, 2);
  }
  const JudgedPair pair = judgePair(left, right);
  EXPECT_EQ(pair.left.size, cv::Size(200, 150));
  EXPECT_EQ(pair.calibration.width, 200);
  EXPECT_NEAR(pair.calibration.baseline_m, 0.12, 1e-12);
  EXPECT_EQ(pair.left.roi, cv::Rect());
  const std::vector<cv::Point2d> delivered = {{10, 20}, {150, 90}};
  std::vector<cv::Point2d> calibrated, expected, found;
  for (const cv::Point2d& px : delivered) {
    calibrated.emplace_back(100 + 2 * px.x + 0.5, 60 + 2 * px.y + 0.5);
  }
  cv::undistortPoints(calibrated, expected, left.K, left.D, left.R, left.P);
  cv::undistortPoints(delivered, found, pair.left.K, pair.left.D, pair.left.R, pair.left.P);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].x, (expected[i].x - 100 + 0.5) / 2 - 0.5, 1e-6);
    EXPECT_NEAR(found[i].y, (expected[i].y - 60 + 0.5) / 2 - 0.5, 1e-6);
  }
}

TEST(JudgedPair, WithoutDistortionARotationOrAnotherFocalLengthIsNotCopiedOver) {
  const auto judged = [](const Change& change) {
    CameraFields left = camera(false), right = camera(true);
    change(left);
    change(right);
    return judgePair(left, right);
  };
  for (const Change& change : {Change([](CameraFields& fields) { fields.R = turned(0.01); }),
                               Change([](CameraFields& fields) { fields.K(0, 0) = 490.0; }),
                               Change([](CameraFields& fields) { fields.P(0, 2) = 300.0; })}) {
    const JudgedPair pair = judged([&](CameraFields& fields) {
      makeRectified(fields);
      change(fields);
    });
    EXPECT_EQ(pair.left.D, (std::vector<double>{1e-9, 0, 0, 0, 0}));
    EXPECT_EQ(pair.right.D, (std::vector<double>{1e-9, 0, 0, 0, 0}));
    ASSERT_EQ(pair.notes.size(), 2u);
    EXPECT_TRUE(contains(pair.notes[0], "image_proc would copy the images")) << pair.notes[0];
  }
  EXPECT_EQ(judged(makeRectified).left.D, std::vector<double>(5, 0.0)) << "nothing to rectify";
  const JudgedPair equidistant = judged([](CameraFields& fields) {
    makeRectified(fields);
    fields.distortion_model = "equidistant";
    fields.D.assign(4, 0.0);
  });
  EXPECT_EQ(equidistant.left.D.front(), 1e-9) << "its rays are not those of a pinhole camera";
}

}  // namespace
}  // namespace stereo_nav::vision
