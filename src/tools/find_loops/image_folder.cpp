#include "tools/find_loops/image_folder.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "core/processor_time.h"
#include "mapping/loop/epipolar_check.h"
#include "mapping/loop/place_index.h"
#include "stereo_nav/core/input_error.h"
#include "tools/find_loops/pair_picture.h"
#include "vision/corner_describer.h"

namespace stereo_nav::tools {
namespace {

/// Bits by which matches differ at most: fewer than where stereo tells wrong matches.
constexpr int kMaxDistance = 50;
/// More than stereo needs: an epipolar line leaves one coordinate free.
constexpr std::size_t kMinInliers = 30;

using mapping::CornerMatch;
using mapping::LoopCandidate;
using mapping::LoopStage;
using vision::DescribedCorners;

/// Of two names the one whose first number is smaller, else the one that comes first in the alphabet.
bool namedBefore(const std::string& a, const std::string& b) {
  const auto number = [](const std::string& name) {
    const std::size_t first = name.find_first_of("0123456789");
    return first == std::string::npos ? 0.0 : std::strtod(name.c_str() + first, nullptr);
  };
  return number(a) != number(b) ? number(a) < number(b) : a < b;
}

std::vector<std::string> imagesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".pgm")
      names.push_back(entry.path().filename().string());
  }
  if (names.empty())
    throw InputError(folder + ": holds no png, jpg or pgm; is it the folder of one camera's images?");
  std::sort(names.begin(), names.end(), namedBefore);
  return names;
}

cv::Mat readImage(const std::string& folder, const std::string& name) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError(path + ": cannot be read as an image; damaged, or of another format");
  return image;
}

std::vector<CornerMatch> agreeingMatches(const FindLoopsOptions& options, const DescribedCorners& query,
                                         const DescribedCorners& place, std::size_t& mutual) {
  const auto matches =
      mapping::mutualMatches({query.descriptors, query.px.size()}, {place.descriptors, place.px.size()},
                             options.loop.verification.max_distance);
  mutual = matches.size();
  return mapping::epipolarInliers(query.px, place.px, matches, options.epipolar_px);
}

void verify(const FindLoopsOptions& options, const std::vector<DescribedCorners>& images,
            LoopCandidate& candidate) {
  candidate.inliers =
      agreeingMatches(options, images[candidate.query], images[candidate.place], candidate.matches).size();
  const auto min_matches = static_cast<std::size_t>(options.loop.verification.min_matches);
  const bool enough_matches = candidate.matches >= min_matches;
  candidate.figure = static_cast<double>(enough_matches ? candidate.inliers : candidate.matches);
  candidate.bound = static_cast<double>(enough_matches ? kMinInliers : min_matches);
  candidate.stage = LoopStage::kAccepted;
  if (candidate.figure < candidate.bound)
    candidate.stage = enough_matches ? LoopStage::kInliers : LoopStage::kMatches;
}

/// Of the accepted candidates from `first` on, which are of one query, only the one with most inliers stays:
/// an epipolar check leaves like places in, with fewer.
void keepBest(LoopRun& run, std::size_t first) {
  const auto begin = run.candidates.begin() + static_cast<std::ptrdiff_t>(first);
  const auto best = std::max_element(begin, run.candidates.end(),
                                     [](const auto& a, const auto& b) { return a.inliers < b.inliers; });
  for (auto candidate = begin; candidate != run.candidates.end(); ++candidate) {
    if (candidate == best || !candidate->accepted()) continue;
    candidate->stage = LoopStage::kInliers;
    candidate->bound = static_cast<double>(best->inliers);
  }
}

/// Whether a place is known to be shown again after so many images.
bool isSame(const FindLoopsOptions& options, std::size_t query, std::size_t place) {
  return std::any_of(options.same_after.begin(), options.same_after.end(), [&](std::size_t after) {
    const std::size_t apart = query - place;
    return apart + options.same_within >= after && apart <= after + options.same_within;
  });
}

}  // namespace

LoopRun findLoopsInFolder(const FindLoopsOptions& options) {
  LoopRun run;
  run.names = imagesIn(options.input);
  const auto images = std::make_shared<std::vector<DescribedCorners>>();
  mapping::PlaceIndex index(options.loop.retrieval);
  const auto recent = static_cast<std::size_t>(options.loop.retrieval.exclude_recent);
  for (std::size_t query = 0; query < run.names.size(); ++query) {
    const cv::Mat image = readImage(options.input, run.names[query]);
    const double start_ms = processorTime_ms();
    images->push_back(vision::detectAndDescribe(image, options.features, options.threshold));
    const double described_ms = processorTime_ms();
    run.past_end.push_back(query < recent ? 0 : query - recent);
    const auto places = index.query(images->back().descriptors, run.past_end.back());
    const double retrieved_ms = processorTime_ms();
    const std::size_t first = run.candidates.size();
    for (const mapping::Retrieved& retrieved : places) {
      LoopCandidate candidate;
      candidate.query = query;
      candidate.place = retrieved.place;
      candidate.query_id = static_cast<std::uint32_t>(query + 1);
      candidate.place_id = static_cast<std::uint32_t>(retrieved.place + 1);
      candidate.score = retrieved.score;
      verify(options, *images, candidate);
      run.candidates.push_back(candidate);
    }
    keepBest(run, first);
    index.add(images->back().descriptors);
    run.describe_ms.push_back(described_ms - start_ms);
    run.retrieval_ms.push_back(retrieved_ms - described_ms);
    run.loop_ms.push_back(processorTime_ms() - described_ms);
  }
  run.index_bytes = index.bytes();
  if (!options.same_after.empty())
    run.is_same_place = [options](std::size_t query, std::size_t place) {
      return isSame(options, query, place);
    };
  run.picture = [options, images, names = run.names](const LoopCandidate& candidate) {
    const DescribedCorners &query = (*images)[candidate.query], &place = (*images)[candidate.place];
    std::size_t mutual = 0;
    std::vector<std::pair<cv::Point2f, cv::Point2f>> lines;
    for (const CornerMatch& match : agreeingMatches(options, query, place, mutual))
      lines.emplace_back(query.px[match.query], place.px[match.place]);
    return pairPicture(readImage(options.input, names[candidate.query]),
                       readImage(options.input, names[candidate.place]), lines);
  };
  return run;
}

}  // namespace stereo_nav::tools
