// What stereo capturing of 640x480 MJPG images costs: decoding and pairing alone, and the whole with its
// threads.
//
// Frames: the images of $STEREO_NAV_DATA/unibo_robot (real camera images, coded as JPEG of quality 90 with
// 4:2:2 chroma, as webcams do), else a synthetic scene.
#include <benchmark/benchmark.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <thread>
#include <vector>

#include "stereo_nav/capture/decoder.h"
#include "stereo_nav/capture/pairer.h"
#include "stereo_nav/capture/stereo_camera.h"
#include "unit/capture/fake_kernel.h"

namespace stereo_nav::capture {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kFrames = 60;
const ImageLayout kLayout{PixelFormat::Mjpg, kWidth, kHeight, 0};

using Jpeg = std::vector<std::uint8_t>;

cv::Mat syntheticScene(int index) {
  cv::Mat noise(kHeight / 4, kWidth / 4, CV_8UC3), image;
  cv::RNG random(static_cast<std::uint64_t>(index) + 1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::resize(noise, image, {kWidth, kHeight}, 0, 0, cv::INTER_CUBIC);
  return image;
}

std::vector<Jpeg> readFrames(const std::string& video) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  cv::VideoCapture recording;
  if (data != nullptr) recording.open(std::string(data) + "/unibo_robot/" + video);
  std::vector<Jpeg> frames;
  for (int index = 0; index < kFrames; ++index) {
    cv::Mat image;
    if (!recording.isOpened() || !recording.read(image)) image = syntheticScene(index);
    frames.emplace_back();
    cv::imencode(".jpg", image, frames.back(), {cv::IMWRITE_JPEG_QUALITY, 90});
  }
  return frames;
}

/// Both images of a pair, decoded and paired, as the two capture threads do; CPU time is what both cost.
void pairOfMjpg(benchmark::State& state) {
  const auto encoding = state.range(0) == 0 ? Encoding::Bgr8 : Encoding::Mono8;
  const std::vector<Jpeg> left = readFrames("robotL.mp4"), right = readFrames("robotR.mp4");
  constexpr std::int64_t kPeriod_ns = 33'333'333;
  Pairer pairer(kPeriod_ns, kPeriod_ns / 2);
  std::int64_t time_ns = 0;
  std::size_t index = 0, bytes = 0;
  for (auto _ : state) {
    time_ns += kPeriod_ns;
    for (const auto side : {Side::Left, Side::Right}) {
      const Jpeg& jpeg = (side == Side::Left ? left : right)[index];
      Frame frame;
      const auto problem = decode(jpeg.data(), jpeg.size(), kLayout, encoding, frame.image);
      if (!problem.empty()) state.SkipWithError(problem.c_str());
      frame.time_ns = time_ns;
      bytes += jpeg.size();
      benchmark::DoNotOptimize(pairer.push(side, std::move(frame)));
    }
    index = (index + 1) % kFrames;
  }
  state.counters["kB_per_image"] = static_cast<double>(bytes) / 2e3 / static_cast<double>(state.iterations());
  // Share of one core at 30 pairs a second.
  // Seconds of processor time for 30 pairs: the share of one core at 30 Hz.
  state.counters["cores_at_30Hz"] =
      benchmark::Counter(static_cast<double>(state.iterations()) / 30.0,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.SetLabel(encodingName(encoding));
}
std::int64_t median(std::vector<std::int64_t>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

FakeCamera webcam(const std::string& port, const Jpeg& image) {
  FakeCamera camera;
  camera.bus_info = port;
  camera.fourcc = V4L2_PIX_FMT_MJPEG;
  camera.payload = image;
  camera.period_ns = 33'333'333;
  return camera;
}

/// Both capture threads and the delivery at 30 Hz, on cameras that are played: processor time of the whole
/// process, and the time from taking the later image from the driver to handing the pair on.
void captureAt30Hz(benchmark::State& state) {
  FakeKernel kernel;
  kernel.plugIn(0, webcam("usb-fake-1", readFrames("robotL.mp4").front()));
  kernel.plugIn(1, webcam("usb-fake-2", readFrames("robotR.mp4").front()));
  StereoConfig config;
  config.left = {"left", kernel.path(0), {PixelFormat::Mjpg, kWidth, kHeight, 30.0}, Encoding::Bgr8, {}, 4,
                 1.0};
  config.right = config.left;
  config.right.device = kernel.path(1);
  std::mutex mutex;
  std::vector<std::int64_t> latencies_ns;
  StereoCamera camera(
      config, kernel, kernel.finder(),
      [&](const StereoImages& images) {
        const auto& [left, right] = images.pair;
        const std::lock_guard<std::mutex> lock(mutex);
        latencies_ns.push_back(kernel.monotonicNow() - std::max(left.dequeued_ns, right.dequeued_ns));
      },
      [](Severity, const std::string&) {});
  camera.start();
  for (auto _ : state) std::this_thread::sleep_for(std::chrono::seconds(1));
  camera.stop();
  state.counters["pairs"] = static_cast<double>(latencies_ns.size());
  state.counters["latency_ms_median"] =
      latencies_ns.empty() ? 0.0 : 1e-6 * static_cast<double>(median(latencies_ns));
  state.counters["decode_ms_latest"] = 1e3 * camera.status().left.decode_time_s;
}
BENCHMARK(captureAt30Hz)
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

BENCHMARK(pairOfMjpg)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stereo_nav::capture

BENCHMARK_MAIN();
