#include "stereo_nav/eval/evaluation.h"

#include "eval/losses.h"
#include "eval/truth_frame.h"
#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav::eval {
namespace {

/// Thirteen frames, one a second, one metre apart along x: 12 m, so that the lengths are 1, 2 and 5 m.
EvaluationInput straightDrive(double scale) {
  EvaluationInput input;
  input.input = "drive.bag";
  input.config = "vo.yaml";
  for (int i = 0; i <= 12; ++i) {
    FrameRecord frame;
    frame.time_s = 100.0 + i;
    frame.T_odom_base = pose(scale * i, 0, 0);
    frame.features = 150;
    frame.inliers = i == 0 ? 0 : 60;
    input.frames.push_back(frame);
    input.ground_truth.push_back({100.0 + i, pose(i, 0, 0)});
  }
  return input;
}

TEST(Evaluation, perfectOdometryHasNoError) {
  const auto summary = evaluate(straightDrive(1.0)).summary;
  EXPECT_EQ(summary.frames, 13u);
  EXPECT_EQ(summary.frames_lost, 0u);
  EXPECT_EQ(summary.frames_with_ground_truth, 13u);
  EXPECT_NEAR(summary.path_length_m, 12.0, 1e-12);
  EXPECT_NEAR(summary.ate_rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(summary.rpe_translation_percent, 0.0, 1e-9);
  EXPECT_NEAR(summary.end_error_percent, 0.0, 1e-9);
  EXPECT_EQ(summary.segment_lengths_m, (std::vector<double>{1.0, 2.0, 5.0}));
  EXPECT_DOUBLE_EQ(summary.features_mean, 150.0);
  EXPECT_DOUBLE_EQ(summary.inliers_mean, 60.0);
}

TEST(Evaluation, tenPercentTooLong) {
  const auto summary = evaluate(straightDrive(1.1)).summary;
  EXPECT_NEAR(summary.path_length_m, 12.0, 1e-12);  // of the ground truth
  EXPECT_NEAR(summary.rpe_translation_percent, 10.0, 1e-9);
  EXPECT_NEAR(summary.end_error_percent, 10.0, 1e-9);
  // Errors 0, 0.1 ... 1.2 m with the starts together: mean 0.6, mean square 6.5/13; y stays clean.
  EXPECT_NEAR(summary.mae_x_m, 0.6, 1e-9);
  EXPECT_NEAR(summary.rmse_x_m, std::sqrt(6.5 / 13.0), 1e-9);
  EXPECT_NEAR(summary.rmse_y_m, 0.0, 1e-9);
  // With the centres together -0.6 ... 0.6 m: mean square 0.01 * 182 / 13 = 0.14.
  EXPECT_NEAR(summary.ate_rmse_m, std::sqrt(0.14), 1e-9);
}

TEST(Evaluation, axesAreThoseOfOdomWhateverTheWorldFrame) {
  auto input = straightDrive(1.1);
  for (auto& truth : input.ground_truth) truth.T_world_body = pose(5, 6, 7, 90.0) * truth.T_world_body;
  const auto summary = evaluate(input).summary;
  EXPECT_NEAR(summary.mae_x_m, 0.6, 1e-9);
  EXPECT_NEAR(summary.mae_y_m, 0.0, 1e-9);
  EXPECT_NEAR(summary.ate_rmse_m, std::sqrt(0.14), 1e-9);
}

TEST(Evaluation, lostFrameKeepsThePoseAndCounts) {
  auto input = straightDrive(1.0);
  input.frames[6].T_odom_base.reset();  // stays at 5 m where the truth is at 6 m
  const auto evaluation = evaluate(input);
  EXPECT_EQ(evaluation.summary.frames_lost, 1u);
  EXPECT_NEAR(evaluation.summary.mae_x_m, 1.0 / 13.0, 1e-9);
  EXPECT_TRUE(evaluation.frames[6].lost);
  EXPECT_TRUE(evaluation.frames[6].position_m.isApprox(Eigen::Vector3d(5, 0, 0)));
  EXPECT_EQ(estimatedTrajectory(input).size(), 12u);
  const auto camera = cameraTrajectory(input);
  ASSERT_EQ(camera.size(), 13u);
  EXPECT_TRUE(camera[6].T_world_body.isApprox(camera[5].T_world_body));
}

TEST(Evaluation, framesBeforeTheFirstPoseTakeIt) {
  auto input = straightDrive(1.0);
  for (auto& frame : input.frames) frame.T_odom_base = pose(0, 0, 1) * *frame.T_odom_base;
  input.frames[0].T_odom_base.reset();
  const auto evaluation = evaluate(input);
  EXPECT_EQ(evaluation.summary.frames_lost, 1u);
  EXPECT_TRUE(evaluation.frames[0].position_m.isApprox(Eigen::Vector3d(1, 0, 1)));
}

TEST(Evaluation, cameraErrorsAreOfTheCamera) {
  // base_link turns on the spot; the camera 2 m ahead of it runs along an arc.
  EvaluationInput input;
  input.T_base_camera = pose(2, 0, 0);
  for (int i = 0; i <= 180; ++i) {
    FrameRecord frame;
    frame.time_s = 0.1 * i;
    frame.T_odom_base = pose(0, 0, 0, i);
    input.frames.push_back(frame);
    input.ground_truth.push_back({0.1 * i, pose(0, 0, 0, i)});
  }
  const auto summary = evaluate(input).summary;
  EXPECT_NEAR(summary.path_length_m, 2.0 * M_PI, 1e-3);
  EXPECT_NEAR(summary.ate_rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(summary.rmse_x_m, 0.0, 1e-9);
  EXPECT_TRUE(cameraTrajectory(input).back().T_world_body.translation().isApprox(
      Eigen::Vector3d(-4, 0, 0), 1e-9));  // in the first camera's own axes: half a turn, 4 m behind
}

TEST(Evaluation, errorsOnlyWhereThereIsGroundTruth) {
  auto input = straightDrive(1.1);
  input.ground_truth.erase(input.ground_truth.begin(), input.ground_truth.begin() + 3);
  const auto evaluation = evaluate(input);
  EXPECT_EQ(evaluation.summary.frames_with_ground_truth, 10u);
  EXPECT_FALSE(evaluation.frames[2].ground_truth_m);
  EXPECT_TRUE(std::isnan(evaluation.frames[2].absolute_error_m));
  EXPECT_NEAR(evaluation.summary.path_length_m, 9.0, 1e-12);
  EXPECT_NEAR(evaluation.summary.mae_x_m, 0.45, 1e-9);
}

TEST(Evaluation, withoutGroundTruthTheErrorsAreNull) {
  auto input = straightDrive(1.1);
  input.ground_truth.clear();
  const auto evaluation = evaluate(input);
  EXPECT_NEAR(evaluation.summary.path_length_m, 13.2, 1e-9);  // of the estimate
  EXPECT_NE(toJson(evaluation.summary).find("\"ate_rmse_m\": null"), std::string::npos);
  EXPECT_NE(toJson(evaluation.summary).find("\"segment_lengths_m\": []"), std::string::npos);
}

TEST(Evaluation, refusesGroundTruthOfAnotherTime) {
  auto input = straightDrive(1.0);
  for (auto& truth : input.ground_truth) truth.time_s += 1e6;
  EXPECT_EQ(
      messageOf<InputError>([&input] { evaluate(input); }),
      "only 0 of 13 frames have ground truth: the frames are from 100.000 to 112.000 s, the ground truth "
      "from 1000100.000 to 1000112.000 s; give the ground truth of this recording, in the same clock");
  EXPECT_THROW(evaluate(EvaluationInput{}), InputError);
}

TEST(EvaluationSummary, fileHasFixedKeysAndRoundTripNumbers) {
  EvaluationSummary summary;
  summary.frames = 3;
  summary.path_length_m = 0.1;
  summary.ate_rmse_m = 1.0 / 3.0;
  summary.segment_lengths_m = {0.5, 1.0};
  summary.config = "a \"quoted\" name";
  summary.input = "x.bag";
  const std::string no_nees =
      "      \"expected\": 6,\n      \"mean\": null,\n      \"translation\": null,\n      \"rotation\": null,\n"
      "      \"inside_95_percent\": null,\n      \"pairs\": 0\n";
  EXPECT_EQ(toJson(summary),
            "{\n"
            "  \"frames\": 3,\n"
            "  \"frames_lost\": 0,\n"
            "  \"path_length_m\": 0.1,\n"
            "  \"ate_rmse_m\": 0.3333333333333333,\n"
            "  \"rpe_translation_percent\": null,\n"
            "  \"rpe_rotation_deg_per_m\": null,\n"
            "  \"segment_lengths_m\": [0.5,1.0],\n"
            "  \"segments\": {},\n"
            "  \"steps_off\": 0,\n"
            "  \"end_error_percent\": null,\n"
            "  \"rmse_x_m\": null,\n"
            "  \"rmse_y_m\": null,\n"
            "  \"mae_x_m\": null,\n"
            "  \"mae_y_m\": null,\n"
            "  \"inliers_mean\": null,\n"
            "  \"features_mean\": null,\n"
            "  \"config\": \"a \\\"quoted\\\" name\",\n"
            "  \"input\": \"x.bag\",\n"
            "  \"frames_with_ground_truth\": 0,\n"
            "  \"imu_set_aside\": \"\",\n"
            "  \"stretches\": 1,\n"
            "  \"nees\": {\n"
            "    \"0.2\": {\n" +
                no_nees +
                "    },\n"
                "    \"1\": {\n" +
                no_nees +
                "    },\n"
                "    \"5\": {\n" +
                no_nees +
                "    }\n"
                "  }\n"
                "}\n");
  summary.config = "not UTF-8: \xff";
  EXPECT_NE(toJson(summary).find("not UTF-8"), std::string::npos);
}

TEST(Evaluation, frameTableLeavesOutWhatIsNotKnown) {
  FrameErrors frame;
  frame.time_s = 0.5;
  frame.features = 150;
  frame.inliers = 60;
  frame.position_m = {1.0, -0.25, 0.0};
  FrameErrors lost = frame;
  lost.lost = true;
  lost.reason = "3 features, \"few\"";
  lost.ground_truth_m = Eigen::Vector3d(2.0, 0.0, 0.125);
  lost.absolute_error_m = 1e-3;
  lost.rotation_error_deg = 3.0;
  frame.pose_covariance = Matrix6d::Identity();
  (*frame.pose_covariance)(0, 0) = 0.25;
  (*frame.pose_covariance)(0, 5) = 0.125;
  const std::string text = toCsv({frame, lost});
  EXPECT_EQ(text.substr(0, text.find(',')), "time_s");
  EXPECT_EQ(text.substr(text.find('\n') + 1),
            "0.5,0,150,60,1,-0.25,0,,,,,,,0.25,0,0,0,0,0.125,1,0,0,0,0,1,0,0,0,1,0,0,1,0,1\n"
            "0.5,1,150,60,1,-0.25,0,2,0,0.125,0.001,3,\"3 features, \"\"few\"\"\",,,,,,,,,,,,,,,,,,,,,\n");
}

TEST(Losses, framesLostOneAfterAnotherAreOneLossWithItsFirstReason) {
  auto input = straightDrive(1.0);
  for (const std::size_t i : {3u, 4u, 5u, 9u}) input.frames[i].T_odom_base.reset();
  input.frames[3].reason = "dark";
  input.frames[4].reason = "darker";
  const auto losses = lossesOf(evaluate(input).frames);
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(toText(losses[0]), "frames 3 to 5 (3.00 to 5.00 s): dark");
  EXPECT_EQ(toText(losses[1]), "frame 9 (9.00 s): no reason given");
}

TEST(TruthFrame, groundTruthOfTheCameraIsRecognised) {
  auto input = straightDrive(1.0);
  // A bend, so that the positions fix the alignment.
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    input.frames[i].T_odom_base =
        pose(10.0 * std::sin(angle), 10.0 - 10.0 * std::cos(angle), 0, angle * 180.0 / M_PI);
    input.ground_truth[i].T_world_body = *input.frames[i].T_odom_base;
  }
  input.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  input.camera_frame = "camera_left_optical";
  EXPECT_FALSE(wrongTruthFrame(input, evaluate(input).summary));
  const Trajectory of_base = input.ground_truth;
  input.ground_truth = ofOtherBody(of_base, input.T_base_camera);
  const auto camera = wrongTruthFrame(input, evaluate(input).summary);
  ASSERT_TRUE(camera);
  EXPECT_NE(camera->find("use --ground-truth-frame camera_left_optical"), std::string::npos) << *camera;
  input.ground_truth = ofOtherBody(of_base, pose(0, 0, 0, 90.0));
  const auto other = wrongTruthFrame(input, evaluate(input).summary);
  ASSERT_TRUE(other);
  EXPECT_NE(other->find("another frame than base_link"), std::string::npos) << *other;
}

TEST(TruthFrame, aHeadingThatSwaysIsNoOtherFrame) {
  auto input = straightDrive(1.0);
  for (std::size_t i = 0; i < input.frames.size(); ++i)
    input.frames[i].T_odom_base = pose(static_cast<double>(i), 0, 0, i % 2 == 0 ? 40.0 : -40.0);
  const EvaluationSummary summary = evaluate(input).summary;
  EXPECT_LT(summary.ate_rmse_m, 0.05 * summary.path_length_m);
  EXPECT_GT(summary.rpe_translation_percent, 20.0);
  EXPECT_FALSE(wrongTruthFrame(input, summary));
}

}  // namespace
}  // namespace stereo_nav::eval
