#include "eval/truth_frame.h"

#include <fmt/format.h>

#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::eval {
namespace {

constexpr double kSmallAte = 0.05;              ///< of the path: the positions fit
constexpr double kHugeRelative_percent = 20.0;  ///< no odometry whose positions fit is that wrong

bool positionsFitAxesDoNot(const EvaluationSummary& summary) {
  return summary.ate_rmse_m < kSmallAte * summary.path_length_m &&
         summary.rpe_translation_percent > kHugeRelative_percent;
}

}  // namespace

std::optional<std::string> wrongTruthFrame(const EvaluationInput& input, const EvaluationSummary& summary) {
  if (!positionsFitAxesDoNot(summary)) return std::nullopt;
  EvaluationInput as_camera = input;
  as_camera.ground_truth = ofOtherBody(input.ground_truth, input.T_base_camera.inverse());
  const bool is_camera =
      evaluate(as_camera).summary.rpe_translation_percent < 0.25 * summary.rpe_translation_percent;
  const std::string figures = fmt::format(
      "the ground truth's positions fit (ATE {:.1f} % of the path), its axes do not (relative error {:.0f} %)",
      100.0 * summary.ate_rmse_m / summary.path_length_m, summary.rpe_translation_percent);
  const std::string frame = input.camera_frame.empty() ? "CAMERA_FRAME" : input.camera_frame;
  return figures +
         (is_camera
              ? ": it gives the poses of the left camera, not of base_link; use --ground-truth-frame " + frame
              : ": it gives the poses of another frame than base_link; name it by --ground-truth-frame "
                "FRAME, with its transform from base_link in tf_static");
}

}  // namespace stereo_nav::eval
