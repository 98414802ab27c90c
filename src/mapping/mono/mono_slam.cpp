#include "mapping/mono/mono_slam.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mapping/mono/known_start.h"
#include "mapping/mono/mono_landmarks.h"
#include "mapping/mono/one_point_ransac.h"
#include "mapping/mono/patch_search.h"
#include "stereo_nav/core/input_error.h"
#include "vision/image_pyramid.h"

namespace stereo_nav::mapping {
namespace {

using Outcome = SearchedLandmark::Outcome;

constexpr double kMargin_px = 8.0;
/// With fewer agreeing landmarks than this, chance may have made them agree.
constexpr std::size_t kLeastInliers = 5;
constexpr int kLostAfter = 15;   ///< frames without these
constexpr int kTrials = 10;      ///< searches after which a landmark that is seldom found leaves the map
constexpr double kBehind = 3.0;  ///< standard deviations below 0 at which an inverse depth is no depth
constexpr int kPastPoses = 3;    ///< that the state has room for
constexpr double kKnownPointSigma_m = 5e-4;
constexpr unsigned kSeed = 1;
constexpr int kLeastSide_px = 64;

vision::GridCornerDetectorParams detectorParams(const MonoParams& params) {
  vision::GridCornerDetectorParams detector;
  detector.features = params.most_measured;
  detector.cells = 2 * params.most_measured;
  detector.initial_threshold = params.fast_threshold;
  detector.min_threshold = std::max(1, params.fast_threshold / 4);
  detector.min_distance_px = params.search.window_px;
  return detector;
}

/// Covariance of velocity and rate of turn of a camera that may move or not.
Matrix6d startRates(const MonoParams& params) {
  Vector6d variances;
  variances.head<3>().setConstant(params.start_speed_sigma * params.start_speed_sigma);
  variances.tail<3>().setConstant(params.start_turn_sigma_rad_per_s * params.start_turn_sigma_rad_per_s);
  return variances.asDiagonal();
}

cv::Point2f toCv(const Eigen::Vector2d& px) {
  return {static_cast<float>(px.x()), static_cast<float>(px.y())};
}

}  // namespace

MonoSlam::MonoSlam(const MonoParams& params, const MonoCamera& camera)
    : params_(params),
      camera_(camera),
      model_{camera, params.pixel_sigma_px, 0.0},
      detector_(detectorParams(params), camera.size),
      state_(kCameraRows + 6 * (params.most_landmarks + kPastPoses)),
      random_(kSeed) {
  if (camera.size.width < kLeastSide_px || camera.size.height < kLeastSide_px)
    throw InputError(fmt::format("an image of {}x{} px is too small for SLAM; needed are {} px a side",
                                 camera.size.width, camera.size.height, kLeastSide_px));
}

void MonoSlam::reset() {
  *this = MonoSlam(params_, camera_);
}

MonoResult MonoSlam::process(const MonoFrame& frame) {
  if (frame.image.size() != camera_.size || frame.image.type() != CV_8UC1)
    throw InputError(
        fmt::format("an image of {}x{} px where the calibration has {}x{} px, one channel of 8 bits",
                    frame.image.cols, frame.image.rows, camera_.size.width, camera_.size.height));
  const vision::ImagePyramid pyramid(frame.image, 1);
  const cv::Mat& image = pyramid.level(0);
  model_.readout_s = frame.readout_s;
  MonoResult result;
  if (!last_s_) {
    begin(frame);
  } else {
    predict(state_, frame.time_s - *last_s_, params_.motion, frame.turn);
    result.inliers = correct(image, result);
    if (frame.velocity) {
      correctByVelocity(state_, *frame.velocity);
      scale_known_ = true;
    }
    forget();
    convertToPoints(state_, params_.linearity_index);
  }
  if (coasting_ == 0) addLandmarks(image, state_.camera);
  complete(frame, result);
  if (result.state == MonoResult::State::kLost) startNewMap(image);
  return result;
}

void MonoSlam::startNewMap(const cv::Mat& image) {
  for (std::size_t i = state_.blocks.size(); i-- > 0;) {
    if (state_.blocks[i].isLandmark()) state_.remove(i);
  }
  Matrix12d keep_pose = Matrix12d::Identity();
  keep_pose.bottomRightCorner<6, 6>().setZero();
  Matrix12d rates = Matrix12d::Zero();
  rates.bottomRightCorner<6, 6>() = startRates(params_);
  state_.covariance.moveCamera(keep_pose, rates);
  state_.camera.v_world.setZero();
  state_.camera.omega_camera.setZero();
  scale_known_ = false;
  coasting_ = 0;
  addLandmarks(image, state_.camera);
}

MonoResult MonoSlam::start(const MonoFrame& frame, const std::vector<KnownPoint>& points) {
  reset();
  const PoseWithCovariance pose = knownStart(camera_, points, params_.pixel_sigma_px);
  begin(frame);
  state_.camera.p_world = pose.T_world_camera.translation();
  state_.camera.q_world_camera = Eigen::Quaterniond(pose.T_world_camera.linear()).normalized();
  Matrix12d P = state_.covariance.matrix();
  P.topLeftCorner<6, 6>() = pose.covariance;
  state_.covariance.start(P);
  scale_known_ = true;
  const vision::ImagePyramid pyramid(frame.image, 1);
  for (const KnownPoint& point : points) {
    if (static_cast<int>(state_.blocks.size()) == params_.most_landmarks) break;
    addKnownPoint(state_, point.p_world, kKnownPointSigma_m).view =
        keepView(pyramid.level(0), point.px, state_.camera.T_world_camera());
  }
  addLandmarks(pyramid.level(0), state_.camera);
  MonoResult result;
  complete(frame, result);
  return result;
}

void MonoSlam::begin(const MonoFrame& frame) {
  state_.camera = CameraState();
  Matrix12d P = Matrix12d::Zero();
  P.bottomRightCorner<6, 6>() = startRates(params_);
  state_.covariance.start(P);
  last_s_ = frame.time_s;
}

std::optional<PixelMatch> MonoSlam::look(const cv::Mat& image, std::size_t block,
                                         SearchedLandmark& searched) const {
  const StateBlock& landmark = state_.blocks[block];
  const auto expected = expectedPixel(camera_, state_.camera, landmark, model_.readout_s);
  if (!expected || !camera_.sees(expected->px, kMargin_px)) return std::nullopt;
  const auto warp = warpOf(camera_, *landmark.view, landmark, state_.camera, expected->px);
  if (!warp) return std::nullopt;
  const Eigen::Matrix2d S = innovationCovariance(state_, landmark, *expected, model_.pixel_sigma_px);
  const auto found = searchPatch(image, *landmark.view, *warp, expected->px, S, params_.search);
  searched = {landmark.id, expected->px, S, found.value_or(expected->px),
              found ? Outcome::kRejected : Outcome::kNotFound};
  return PixelMatch{block, *expected, searched.found_px};
}

std::vector<PixelMatch> MonoSlam::search(const cv::Mat& image, MonoResult& result) {
  std::vector<PixelMatch> matches;
  // The oldest first: they hold the map together.
  for (std::size_t i = 0; i < state_.blocks.size(); ++i) {
    if (!state_.blocks[i].isLandmark()) continue;
    if (static_cast<int>(result.searched.size()) == params_.most_measured) break;
    SearchedLandmark searched;
    const auto match = look(image, i, searched);
    if (!match) continue;
    ++state_.blocks[i].searched;
    result.searched.push_back(searched);
    if (searched.outcome != Outcome::kNotFound) matches.push_back(*match);
  }
  return matches;
}

std::vector<PixelMatch> MonoSlam::searchAgain(const cv::Mat& image, MonoResult& result) const {
  std::vector<PixelMatch> matches;
  std::size_t block = 0;
  for (SearchedLandmark& searched : result.searched) {
    while (state_.blocks[block].id != searched.id) ++block;
    if (searched.outcome == Outcome::kLowInnovation) continue;
    SearchedLandmark again;
    const auto match = look(image, block, again);
    if (match && again.outcome != Outcome::kNotFound) matches.push_back(*match);
  }
  return matches;
}

std::size_t MonoSlam::correct(const cv::Mat& image, MonoResult& result) {
  const std::vector<PixelMatch> matches = search(image, result);
  const std::vector<std::size_t> low = lowInnovationInliers(state_, model_, matches, params_.ransac, random_);
  if (low.size() < kLeastInliers) {
    ++coasting_;
    result.reason = fmt::format(
        "{} of {} landmarks in view are found where they agree, needed are {}; is the camera covered, the "
        "picture blurred, or the turn too quick?",
        low.size(), result.searched.size(), kLeastInliers);
    return low.size();
  }
  coasting_ = 0;
  std::vector<PixelMatch> agreeing;
  for (const std::size_t i : low) agreeing.push_back(matches[i]);
  correctByPixels(state_, agreeing, model_.pixel_sigma_px);
  account(agreeing, Outcome::kLowInnovation, result);
  const std::vector<PixelMatch> high =
      highInnovationInliers(state_, model_, searchAgain(image, result), params_.ransac);
  correctByPixels(state_, high, model_.pixel_sigma_px);
  account(high, Outcome::kHighInnovation, result);
  return low.size() + high.size();
}

void MonoSlam::account(const std::vector<PixelMatch>& matches, Outcome outcome, MonoResult& result) {
  for (const PixelMatch& match : matches) {
    StateBlock& landmark = state_.blocks[match.block];
    ++landmark.found;
    landmark.last_found = frame_;
    for (SearchedLandmark& searched : result.searched) {
      if (searched.id != landmark.id) continue;
      searched.outcome = outcome;
      searched.found_px = match.found_px;
    }
  }
}

void MonoSlam::forget() {
  for (std::size_t i = state_.blocks.size(); i-- > 0;) {
    const StateBlock& block = state_.blocks[i];
    if (!block.isLandmark()) continue;
    const bool seldom = block.searched >= kTrials && block.found < params_.least_found_share * block.searched;
    const bool behind = block.form == StateBlock::Form::kInverseDepth &&
                        block.value(5) + kBehind * state_.rhoSigma(block) < 0.0;
    if (behind || (seldom && coasting_ == 0)) state_.remove(i);
  }
}

void MonoSlam::addLandmarks(const cv::Mat& image, const CameraState& camera) {
  std::vector<cv::Point2f> occupied;
  for (const StateBlock& block : state_.blocks) {
    if (!block.isLandmark()) continue;
    const auto px = pixelOf(camera_, camera, block, model_.readout_s);
    if (px && camera_.sees(*px, 0.0)) occupied.push_back(toCv(*px));
  }
  for (const cv::Point2f& corner : detector_.detect(image, occupied)) {
    auto landmarks = [&] {
      return std::count_if(state_.blocks.begin(), state_.blocks.end(),
                           [](const StateBlock& block) { return block.isLandmark(); });
    };
    if (landmarks() >= params_.most_landmarks) {
      const auto unseen = std::min_element(
          state_.blocks.begin(), state_.blocks.end(), [](const StateBlock& a, const StateBlock& b) {
            return a.isLandmark() != b.isLandmark() ? a.isLandmark() : a.last_found < b.last_found;
          });
      if (unseen->last_found == frame_) return;
      state_.remove(static_cast<std::size_t>(unseen - state_.blocks.begin()));
    }
    const Eigen::Vector2d px(corner.x, corner.y);
    StateBlock& landmark =
        addInverseDepth(state_, camera_, px, params_.pixel_sigma_px,
                        {params_.inverse_depth_start, params_.inverse_depth_sigma}, model_.readout_s);
    landmark.view = keepView(image, px, camera.T_world_camera());
    landmark.last_found = frame_;
  }
}

void MonoSlam::complete(const MonoFrame& frame, MonoResult& result) {
  result.time_s = frame.time_s;
  result.state = coasting_ == 0            ? MonoResult::State::kTracking
                 : coasting_ <= kLostAfter ? MonoResult::State::kCoasting
                                           : MonoResult::State::kLost;
  result.camera = state_.camera;
  result.pose_covariance = poseCovariance(state_);
  result.velocity_covariance = state_.covariance.matrix().block<6, 6>(6, 6);
  result.scale_known = scale_known_;
  for (const StateBlock& block : state_.blocks) result.landmarks += block.isLandmark() ? 1 : 0;
  last_s_ = frame.time_s;
  ++frame_;
}

int MonoSlam::renewPastPose(std::optional<int> old_id) {
  for (std::size_t i = 0; i < state_.blocks.size(); ++i) {
    if (old_id && state_.blocks[i].id == *old_id) {
      state_.remove(i);
      break;
    }
  }
  return addPastPose(state_);
}

RelativePose MonoSlam::sincePastPose(int id) const {
  const auto past = std::find_if(state_.blocks.begin(), state_.blocks.end(),
                                 [id](const StateBlock& block) { return block.id == id; });
  if (past == state_.blocks.end()) throw std::logic_error("MonoSlam::sincePastPose(): no such pose");
  return relativeTo(state_, *past);
}

}  // namespace stereo_nav::mapping
