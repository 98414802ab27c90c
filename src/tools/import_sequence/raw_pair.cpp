#include "tools/import_sequence/raw_pair.h"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/rectified_camera.h"
#include "vision/lens_model.h"

namespace stereo_nav::tools {
namespace {

namespace models = sensor_msgs::distortion_models;

class RectifiedFrames : public FrameReader {
 public:
  RectifiedFrames(std::unique_ptr<FrameReader> frames, const sensor_msgs::CameraInfo& info)
      : frames_(std::move(frames)),
        size_(static_cast<int>(info.width), static_cast<int>(info.height)),
        raw_(vision::rawPixels(ros_io::toFields(info))) {}

  std::size_t size() const override { return frames_->size(); }

  cv::Mat read(std::size_t index) override {
    cv::Mat image = frames_->read(index);
    if (image.size() != size_) return image;  // refused where the bag is written
    cv::Mat rectified;
    cv::remap(image, rectified, raw_.columns, raw_.rows, cv::INTER_LINEAR);
    return rectified;
  }

 private:
  std::unique_ptr<FrameReader> frames_;
  cv::Size size_;
  vision::RawPixels raw_;
};

/// Whether image_proc does the right thing by itself. It copies images whose coefficients are all 0, whatever
/// R says.
bool isRectifiedDownstream(const sensor_msgs::CameraInfo& info) {
  const vision::CameraFields camera = ros_io::toFields(info);
  return vision::isRectified(camera) ||
         (info.distortion_model != models::EQUIDISTANT && vision::bends(camera) && info.D.size() <= 8);
}

sensor_msgs::CameraInfo toInfo(const RawLens& lens, const cv::Size& size, const cv::Matx33d& R,
                               const cv::Matx34d& P) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(size.width);
  info.height = static_cast<std::uint32_t>(size.height);
  info.D = lens.D;
  info.distortion_model = lens.model == LensModel::kEquidistant ? models::EQUIDISTANT
                          : lens.D.size() > 5                   ? models::RATIONAL_POLYNOMIAL
                                                                : models::PLUMB_BOB;
  std::copy(lens.K.val, lens.K.val + 9, info.K.begin());
  std::copy(R.val, R.val + 9, info.R.begin());
  std::copy(P.val, P.val + 12, info.P.begin());
  return info;
}

}  // namespace

RectifyingPair rectifyingPair(const RawPair& pair, const Sequence& sequence) {
  const cv::Size size = pair.size.area() > 0 ? pair.size : sequence.left.frames->read(0).size();
  const bool fisheye =
      pair.left.model == LensModel::kEquidistant || pair.right.model == LensModel::kEquidistant;
  // Without coefficients the rectified image keeps the focal length of the middle; OpenCV's polynomials do
  // not describe the rim of a fisheye lens.
  const std::vector<double> none(5, 0.0);
  cv::Matx33d R_left, R_right;
  cv::Matx34d P_left, P_right;
  cv::Mat Q;
  cv::stereoRectify(pair.left.K, fisheye ? none : pair.left.D, pair.right.K, fisheye ? none : pair.right.D,
                    size, pair.R_right_left, pair.t_right_left, R_left, R_right, P_left, P_right, Q,
                    cv::CALIB_ZERO_DISPARITY, fisheye ? -1.0 : 0.0, size);
  return {pair.source, toInfo(pair.left, size, R_left, P_left), toInfo(pair.right, size, R_right, P_right)};
}

void useRawPair(const RawPair& pair, Sequence& sequence) {
  useRectification(rectifyingPair(pair, sequence), sequence);
}

void useRectification(const RectifyingPair& pair, Sequence& sequence) {
  ros_io::JudgedInfos judged;
  try {
    judged = ros_io::judgeInfos(pair.left, pair.right);
  } catch (const std::exception& error) {
    throw InputError(pair.source + ": " + error.what());
  }
  sequence.left.info = judged.left;
  sequence.right.info = judged.right;
  if (isRectifiedDownstream(pair.left) && isRectifiedDownstream(pair.right)) return;
  sequence.notes.push_back(pair.source +
                           ": image_proc does not rectify with such a calibration; the images are " +
                           "rectified while they are imported");
  for (CameraTrack* track : {&sequence.left, &sequence.right}) {
    const sensor_msgs::CameraInfo info = track->info;
    track->frames = std::make_unique<RectifiedFrames>(std::move(track->frames), info);
    track->info = toCameraInfo(RectifiedCamera{static_cast<int>(info.width), static_cast<int>(info.height),
                                               info.P[0], info.P[5], info.P[2], info.P[6],
                                               info.P[3] == 0.0 ? 0.0 : -info.P[3] / info.P[0]});
  }
}

}  // namespace stereo_nav::tools
