#include "tools/import_sequence/sixteen_bits.h"

#include <algorithm>
#include <utility>

#include "vision/bit_depth.h"

namespace stereo_nav::tools {
namespace {

constexpr std::size_t kSamples = 10;  ///< images of each camera

class FullRangeFrames : public FrameReader {
 public:
  FullRangeFrames(std::unique_ptr<FrameReader> frames, const vision::BitDepth& depth)
      : frames_(std::move(frames)), depth_(depth) {}
  std::size_t size() const override { return frames_->size(); }
  cv::Mat read(std::size_t index) override {
    const cv::Mat image = frames_->read(index);
    return image.type() == CV_16UC1 ? vision::toFullRange(image, depth_) : image;
  }

 private:
  std::unique_ptr<FrameReader> frames_;
  vision::BitDepth depth_;
};

}  // namespace

void useFullRange(Sequence& sequence) {
  vision::BitDepthFinder finder;
  for (CameraTrack* track : {&sequence.left, &sequence.right}) {
    const std::size_t size = track->frames->size();
    if (size == 0 || track->frames->read(0).type() != CV_16UC1) continue;
    const std::size_t step = std::max<std::size_t>(1, size / kSamples);
    for (std::size_t i = 0; i < size; i += step) finder.add(track->frames->read(i));
  }
  const vision::BitDepth depth = finder.depth();
  if (!finder.hasImages() || depth.isPlain()) return;
  for (CameraTrack* track : {&sequence.left, &sequence.right}) {
    track->frames = std::make_unique<FullRangeFrames>(std::move(track->frames), depth);
  }
  sequence.notes.push_back("16-bit images whose values reach " + std::to_string(finder.largest()) +
                           (depth.swapped ? " when the bytes of each value are exchanged" : "") +
                           ": taken as " + std::to_string(depth.bits) + "-bit and scaled to the full range");
}

}  // namespace stereo_nav::tools
