// Retrieval among 2600 keyframes and the matching of two: processor time and memory. Words are those of
// random descriptors, or of a folder of images (FOLDER: the rest are words drawn from all of its images).
//
//   loop_bench_test [FOLDER_OF_IMAGES]
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "core/processor_time.h"
#include "core/statistics.h"
#include "mapping/loop/descriptor_matching.h"
#include "mapping/loop/place_index.h"
#include "vision/corner_describer.h"

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kKeyframes = 2600;
using Descriptors = std::vector<vision::Descriptor>;

std::vector<Descriptors> placesOf(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  std::vector<Descriptors> places;
  for (const std::string& path : paths) {
    const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (!image.empty()) places.push_back(vision::detectAndDescribe(image, 1000, 10).descriptors);
  }
  return places;
}

std::vector<Descriptors> randomPlaces(std::size_t corners, std::mt19937_64& random) {
  std::vector<Descriptors> places(100, Descriptors(corners));
  for (Descriptors& place : places)
    for (auto& descriptor : place) descriptor = {random(), random(), random(), random()};
  return places;
}

void report(const std::vector<Descriptors>& seen, std::mt19937_64& random) {
  PlaceIndex index(RetrievalParams{});
  for (const Descriptors& place : seen) index.add(place);
  while (index.size() < kKeyframes) {
    Descriptors place(seen[random() % seen.size()].size());
    for (auto& descriptor : place) {
      const Descriptors& from = seen[random() % seen.size()];
      if (!from.empty()) descriptor = from[random() % from.size()];
    }
    index.add(place);
  }
  std::vector<double> query_ms, match_ms;
  for (const Descriptors& place : seen) {
    double start_ms = processorTime_ms();
    index.query(place, index.size());
    query_ms.push_back(processorTime_ms() - start_ms);
    start_ms = processorTime_ms();
    mutualMatches({place, place.size()}, {seen.front(), seen.front().size()}, 64);
    match_ms.push_back(processorTime_ms() - start_ms);
  }
  std::cout << fmt::format(
      "{} keyframes: a query {:.3f} ms median, {:.3f} ms at most; {:.2f} kB a keyframe; matching two {:.2f} ms\n",
      index.size(), quantile(query_ms, 0.5), *std::max_element(query_ms.begin(), query_ms.end()),
      1e-3 * static_cast<double>(index.bytes()) / static_cast<double>(index.size()), quantile(match_ms, 0.5));
}

}  // namespace
}  // namespace stereo_nav::mapping

int main(int argc, char** argv) {
  using namespace stereo_nav::mapping;
  std::mt19937_64 random(1);
  report(argc > 1 ? placesOf(argv[1]) : randomPlaces(500, random), random);
  return 0;
}
