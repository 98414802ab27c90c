// Time per stage and per frame of the stereo odometry, and the floor that OpenCV sets for the same work:
//   taskset -c 1 build/devel/lib/stereo_nav/vo_bench_test
// Images are synthetic noise, moved from frame to frame: nothing to download, and every size alike.
#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>

#include "odometry/stereo/stereo_odometry.h"
#include "panned_wall.h"

namespace {

using namespace stereo_nav;
using namespace stereo_nav;
using namespace stereo_nav::odometry;
using namespace stereo_nav::vision;

vision::StereoCalibration calibrationOf(const benchmark::State& state) {
  return bench::wallCamera({static_cast<int>(state.range(0)), static_cast<int>(state.range(1))});
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({320, 240})
      ->Args({640, 480})
      ->Args({752, 480})
      ->Args({1226, 370})
      ->Unit(benchmark::kMillisecond);
}

void wholeFrame(benchmark::State& state, int features) {
  cv::setNumThreads(1);
  const vision::StereoCalibration calibration = calibrationOf(state);
  odometry::StereoParams params;
  params.corners.features = features;
  params.corners.cells = features * 3 / 2;
  odometry::StereoOdometry odometry(params, calibration, Eigen::Matrix3d::Identity());
  bench::PannedWall wall(calibration);
  double inliers = 0.0;
  std::map<std::string, double> stages_ms;
  for (int i = 0; i < 5; ++i) odometry.process(wall.next());
  for (auto _ : state) {
    state.PauseTiming();
    const odometry::StereoFrame frame = wall.next();
    state.ResumeTiming();
    const odometry::FrameResult result = odometry.process(frame);
    inliers += result.inliers;
    for (const auto& stage : result.stage_times) stages_ms[stage.stage] += stage.milliseconds;
  }
  const auto frames = static_cast<double>(state.iterations());
  state.counters["inliers"] = inliers / frames;
  for (const auto& [stage, ms] : stages_ms) state.counters[stage + "_ms"] = ms / frames;
}
BENCHMARK_CAPTURE(wholeFrame, features_150, 150)->Apply(sizes);
BENCHMARK_CAPTURE(wholeFrame, features_200, 200)->Apply(sizes);
BENCHMARK_CAPTURE(wholeFrame, features_1000, 1000)->Apply(sizes);

/// Both pyramids, one FAST pass, one forward and one left-right KLT of 200 points.
void opencvFloor(benchmark::State& state) {
  cv::setNumThreads(1);
  const vision::StereoCalibration calibration = calibrationOf(state);
  const vision::PatchTrackerParams params;
  bench::PannedWall wall(calibration);
  const odometry::StereoFrame before = wall.next();
  const odometry::StereoFrame now = wall.next();
  std::vector<cv::Point2f> points;
  for (const cv::Point2f& px :
       vision::GridCornerDetector(vision::GridCornerDetectorParams(), before.left.size())
           .detect(before.left, {})) {
    points.push_back(px);
  }
  const cv::Size window(params.window_px, params.window_px);
  const int levels = 3;
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, params.iterations,
                                  params.min_step_px);
  std::vector<cv::Mat> previous;
  cv::buildOpticalFlowPyramid(before.left, previous, window, levels);
  for (auto _ : state) {
    std::vector<cv::Mat> left;
    std::vector<cv::Mat> right;
    cv::buildOpticalFlowPyramid(now.left, left, window, levels);
    cv::buildOpticalFlowPyramid(now.right, right, window, levels);
    std::vector<cv::KeyPoint> corners;
    cv::FAST(now.left, corners, 20, true);
    std::vector<cv::Point2f> found;
    std::vector<uchar> status;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(previous, left, points, found, status, error, window, levels, criteria);
    cv::calcOpticalFlowPyrLK(left, right, points, found, status, error, window, levels, criteria);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK(opencvFloor)->Apply(sizes);

void pyramid(benchmark::State& state) {
  cv::setNumThreads(1);
  const odometry::StereoFrame frame = bench::PannedWall(calibrationOf(state)).next();
  for (auto _ : state) benchmark::DoNotOptimize(vision::ImagePyramid(frame.left, 4));
}
BENCHMARK(pyramid)->Apply(sizes);

void detect(benchmark::State& state) {
  cv::setNumThreads(1);
  const odometry::StereoFrame frame = bench::PannedWall(calibrationOf(state)).next();
  vision::GridCornerDetector detector(vision::GridCornerDetectorParams(), frame.left.size());
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(frame.left, {}));
}
BENCHMARK(detect)->Apply(sizes);

void stereoSearch(benchmark::State& state) {
  cv::setNumThreads(1);
  const vision::StereoCalibration calibration = calibrationOf(state);
  const odometry::StereoFrame frame = bench::PannedWall(calibration).next();
  const vision::ImagePyramid left(frame.left, 4);
  const vision::ImagePyramid right(frame.right, 4);
  const auto corners = vision::GridCornerDetector(vision::GridCornerDetectorParams(), frame.left.size())
                           .detect(frame.left, {});
  const vision::SparseStereoMatcher matcher(vision::SparseStereoParams(), calibration);
  for (auto _ : state) {
    for (const cv::Point2f& px : corners) {
      const Eigen::Vector2d left_px(static_cast<double>(px.x), static_cast<double>(px.y));
      benchmark::DoNotOptimize(matcher.search(left, right, Eigen::Isometry3d::Identity(), left_px, 0.0));
    }
  }
}
BENCHMARK(stereoSearch)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
