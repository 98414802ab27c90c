#include "tools/find_loops/recorded_loops.h"

#include <fmt/format.h>

#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "core/angles.h"
#include "core/processor_time.h"
#include "mapping/loop/landmark_match.h"
#include "mapping/loop/loop_finder.h"
#include "tools/common/recorded_keyframes.h"
#include "tools/find_loops/pair_picture.h"

namespace stereo_nav::tools {
namespace {

using mapping::LoopCandidate;

/// What pictures and truth need of the keyframes after the run.
struct Seen {
  explicit Seen(const mapping::LoopParams& params, const vision::StereoCalibration& camera)
      : calibration(camera), params_of_loops(params), finder(params, camera) {}

  vision::StereoCalibration calibration;
  mapping::LoopParams params_of_loops;
  mapping::LoopFinder finder;
  std::vector<std::vector<std::uint8_t>> images;                 ///< as JPEG
  std::vector<std::optional<Eigen::Isometry3d>> T_world_camera;  ///< true ones
};

/// Corners of the query and of the place that agree with the pose that was found.
std::vector<std::pair<cv::Point2f, cv::Point2f>> agreeingCorners(const Seen& seen,
                                                                 const LoopCandidate& candidate) {
  constexpr double kNear = 16.0;  // squared, in standard deviations
  const vision::Keyframe &query = seen.finder.chain()[candidate.query],
                         &place = seen.finder.chain()[candidate.place];
  std::vector<std::pair<cv::Point2f, cv::Point2f>> lines;
  const auto matches = mapping::mutualMatches({query.descriptors, query.corners.size()},
                                              {place.descriptors, place.corners.size()},
                                              seen.params_of_loops.verification.max_distance);
  for (const mapping::CornerMatch& match : matches) {
    if (!place.corners[match.place].hasDepth()) continue;
    mapping::LandmarkMatch landmark;
    mapping::setPoint(seen.calibration, place.corners[match.place], landmark);
    landmark.seen = query.corners[match.query];
    const auto residual = mapping::residualOf(seen.calibration, candidate.place_query.T.inverse(), landmark);
    if (!residual || residual->squared > kNear) continue;
    const auto point = [](const Eigen::Vector2d& px) { return cv::Point2f(cv::Point2d(px.x(), px.y())); };
    lines.emplace_back(point(landmark.seen.px), point(place.corners[match.place].px));
  }
  return lines;
}

void setTruth(const FindLoopsOptions& options, const std::shared_ptr<Seen>& seen, LoopRun& run) {
  const auto truth = [seen](std::size_t query, std::size_t place) -> std::optional<Eigen::Isometry3d> {
    const auto &of_query = seen->T_world_camera[query], &of_place = seen->T_world_camera[place];
    if (!of_query || !of_place) return std::nullopt;
    return of_place->inverse() * *of_query;
  };
  run.true_pose = truth;
  run.is_same_place = [truth, near_m = options.near_m, near_rad = options.near_deg * kRadPerDeg](
                          std::size_t query, std::size_t place) {
    const auto T = truth(query, place);
    return T && T->translation().norm() <= near_m &&
           logRotation(Eigen::Matrix3d(T->linear())).norm() <= near_rad;
  };
}

/// Adds a keyframe to the finder, and what became of its candidates to the run.
void addKeyframe(const vision::Keyframe& keyframe, const cv::Mat& left, Seen& seen, LoopRun& run) {
  seen.images.emplace_back();
  cv::imencode(".jpg", left, seen.images.back());
  run.names.push_back(fmt::format("{:.6f}", keyframe.time_s));
  const double start_ms = processorTime_ms();
  const auto candidates = seen.finder.add(keyframe);
  run.loop_ms.push_back(processorTime_ms() - start_ms);
  run.past_end.push_back(seen.finder.endOfPast());
  run.candidates.insert(run.candidates.end(), candidates.begin(), candidates.end());
}

}  // namespace

LoopRun findLoopsInRecording(const FindLoopsOptions& options,
                             const std::function<void(std::size_t, std::size_t)>& progress) {
  KeyframeRun recorded({options.input, options.config, options.part, options.ground_truth,
                        options.ground_truth_frame, options.no_imu});
  LoopRun run;
  const auto seen = std::make_shared<Seen>(options.loop, recorded.calibration());
  recorded.forEachFrame(
      [&](const RecordedFrame& frame) {
        if (!frame.keyframe) return;
        run.describe_ms.push_back(frame.describe_ms);
        seen->T_world_camera.push_back(frame.T_world_camera);
        addKeyframe(*frame.keyframe, frame.frame.left, *seen, run);
      },
      progress);
  run.notes = recorded.notes();
  run.index_bytes = seen->finder.index().bytes();
  if (!recorded.groundTruth().empty()) setTruth(options, seen, run);
  run.picture = [seen](const LoopCandidate& candidate) {
    return pairPicture(cv::imdecode(seen->images[candidate.query], cv::IMREAD_GRAYSCALE),
                       cv::imdecode(seen->images[candidate.place], cv::IMREAD_GRAYSCALE),
                       agreeingCorners(*seen, candidate));
  };
  return run;
}

}  // namespace stereo_nav::tools
