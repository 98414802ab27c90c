#include "odometry/stereo/consensus.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "core/angles.h"
#include "core/statistics.h"

namespace stereo_nav::odometry {
namespace {

/// Of the live tracks. Where the pose is expected, what is out of view or hidden says nothing against it: of
/// those found.
double share(const Consensus& consensus) {
  const std::size_t asked =
      consensus.is_expected ? foundTracks(consensus.tracks).size() : aliveTracks(consensus.tracks);
  return static_cast<double>(consensus.estimate.inliers) /
         static_cast<double>(std::max<std::size_t>(1, asked));
}

/// A known velocity leaves little room for chance, the IMU alone more.
double leastShare(const Consensus& consensus) {
  if (consensus.is_expected) return 0.1;
  return consensus.prior.R_current_previous ? 0.2 : 0.3;
}

std::string tooSmallShare(const Consensus& consensus) {
  if (share(consensus) >= leastShare(consensus)) return "";
  std::ostringstream message;
  message << "only " << consensus.estimate.inliers << " of " << aliveTracks(consensus.tracks)
          << " features agree with one motion, which may be chance: " << 100.0 * leastShare(consensus)
          << " % needed; moved too far, blurred, or moving objects fill the view";
  return message.str();
}

/// In a patch of the image all features may belong to one object.
std::string tooNarrow(const Consensus& consensus) {
  constexpr int kColumns = 4, kRows = 3;
  constexpr std::size_t kFewestCells = 3;
  if (consensus.is_expected) return "";
  std::set<int> cells;
  for (const Track& track : consensus.tracks) {
    if (!track.inlier) continue;
    const Eigen::Vector2d& px = track.in_image.left_px;
    cells.insert(static_cast<int>(px.y() * kRows / consensus.calibration.height) * kColumns +
                 static_cast<int>(px.x() * kColumns / consensus.calibration.width));
  }
  if (cells.size() >= kFewestCells) return "";
  return "the features that agree with one motion crowd in a small part of the image, which may be a thing "
         "that moves on its own: the rest is dark, covered or without texture";
}

double largestSigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
                        .eigenvalues()
                        .maxCoeff()));
}

/// Features that do not determine all six coordinates.
std::string tooVague(const Consensus& consensus) {
  constexpr double kMostTurn_rad = 0.02;
  constexpr double kMostShift = 0.1;  // of the depth
  std::vector<double> depths_m;
  for (const Track& track : consensus.tracks) {
    if (track.inlier) depths_m.push_back((consensus.estimate.view.T_camera_world * track.p_world).norm());
  }
  const Matrix6d& covariance = consensus.estimate.covariance;
  const double shift_m = largestSigma(covariance.topLeftCorner<3, 3>());
  const double turn_rad = largestSigma(covariance.bottomRightCorner<3, 3>());
  if (shift_m <= kMostShift * upperMedian(depths_m) && turn_rad <= kMostTurn_rad) return "";
  std::ostringstream message;
  message << "the features leave the motion open to " << shift_m << " m and " << turn_rad * kDegPerRad
          << " degrees (sigma): they are too few, too far away, or lie on one line";
  return message.str();
}

bool contradictsImu(const MotionPrior& prior, const PoseEstimate& estimate) {
  if (!prior.R_current_previous) return false;
  constexpr double kSigmas = 5.0;
  constexpr double kSlack_rad = 0.01;  // of stamps and mounting
  const Eigen::Matrix3d R =
      estimate.view.T_camera_world.linear() * prior.T_previous_world.linear().transpose();
  const double sigma_rad =
      std::hypot(prior.rotation_sigma_rad, largestSigma(estimate.covariance.bottomRightCorner<3, 3>()));
  return logRotation(R * prior.R_current_previous->transpose()).norm() > kSlack_rad + kSigmas * sigma_rad;
}

/// The inliers in order of what the estimate owes to them: leverages, the largest first.
TrackIndices byLeverage(const Consensus& consensus) {
  const Matrix6d inverse = consensus.estimate.covariance / consensus.estimate.variance_px2;
  std::vector<std::pair<double, std::size_t>> leverages;
  vision::ViewResidual residual;
  for (std::size_t i = 0; i < consensus.tracks.size(); ++i) {
    const Track& track = consensus.tracks[i];
    if (!track.inlier || !vision::viewResidual(consensus.calibration, consensus.estimate.view, track.p_world,
                                               track.at_stamp, residual))
      continue;
    leverages.emplace_back(-(residual.by_pose * inverse * residual.by_pose.transpose()).trace(), i);
  }
  std::sort(leverages.begin(), leverages.end());
  TrackIndices order;
  for (const auto& [leverage, i] : leverages) order.push_back(i);
  return order;
}

/// Median distance between where two motions put the inliers of the second one.
double difference_px(const Consensus& consensus, const std::vector<Track>& others, const PoseEstimate& rival,
                     const TrackIndices& judged) {
  std::vector<double> distances_px;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    if (!rival.inlier[k]) continue;
    const Track& track = others[judged[k]];
    distances_px.push_back((predictedPixel(consensus.calibration, rival.view, track) -
                            predictedPixel(consensus.calibration, consensus.estimate.view, track))
                               .norm());
  }
  return upperMedian(distances_px);
}

}  // namespace

std::string doubtAbout(const Consensus& consensus) {
  for (const auto& doubt : {tooSmallShare, tooNarrow, tooVague}) {
    std::string reason = doubt(consensus);
    if (!reason.empty()) return reason;
  }
  if (share(consensus) < kStrongShare && contradictsImu(consensus.prior, consensus.estimate))
    return "the few features that agree with one motion turned otherwise than the IMU: they may belong to "
           "something that moves on its own, or the IMU's mounting or stamps are wrong";
  return "";
}

bool hasRival(const Consensus& consensus, const CliqueParams& clique, const NoisyRigidityParams& rigidity,
              const PoseEstimator& estimator, double max_error_px) {
  constexpr double kNearly = 0.5;
  const double enough = kNearly * static_cast<double>(consensus.estimate.inliers);
  std::vector<Track> others = consensus.tracks;
  for (Track& track : others) {
    track.found = track.found && !track.inlier;
    track.reliable = true;
  }
  const TrackIndices left_over = foundTracks(others);
  if (static_cast<double>(left_over.size()) < enough) return false;
  const vision::StereoView& view = consensus.estimate.view;
  const RigidSelection rigid = selectRigidTracks(clique, rigidity, consensus.calibration,
                                                 consensus.prior.T_previous_world, view, others);
  const PoseEstimate by_rigid = estimator.estimate(observations(others, rigid.tracks), consensus.prior, view);
  if (!by_rigid.converged) return false;
  const PoseEstimate rival =
      estimator.estimate(observations(others, left_over), consensus.prior, by_rigid.view);
  return rival.converged && static_cast<double>(rival.inliers) >= enough &&
         !contradictsImu(consensus.prior, rival) &&
         difference_px(consensus, others, rival, left_over) > max_error_px;
}

bool restsOnFew(const Consensus& consensus, const PoseEstimator& estimator, double max_error_px) {
  constexpr std::size_t kFew = 8;  // one in so many
  constexpr double kSigmas = 6.0;
  TrackIndices order = byLeverage(consensus);
  const std::size_t few = std::max<std::size_t>(3, order.size() / kFew);
  if (order.size() < 2 * few) return false;
  const TrackIndices others(order.begin() + static_cast<std::ptrdiff_t>(few), order.end());
  const PoseEstimate by_others =
      estimator.estimate(observations(consensus.tracks, others), consensus.prior, consensus.estimate.view);
  if (!by_others.converged) return false;
  const Vector6d difference =
      logMotion(by_others.view.T_camera_world * consensus.estimate.view.T_camera_world.inverse());
  if (difference.dot(by_others.covariance.ldlt().solve(difference)) <= kSigmas * kSigmas) return false;
  order.resize(few);
  std::vector<double> errors_px;
  for (const std::size_t i : order) {
    const Track& track = consensus.tracks[i];
    errors_px.push_back(
        (predictedPixel(consensus.calibration, by_others.view, track) - track.at_stamp.left_px).norm());
  }
  return upperMedian(errors_px) > max_error_px;
}

std::string doubtAboutStart(const std::vector<Track>& tracks, int min_inliers) {
  constexpr double kShare = 0.3;
  constexpr int kRigidBefore = 2;  // where they were detected, and in the frame after it
  int before = 0, still = 0;
  for (const Track& track : tracks) {
    if (!track.alive || track.confirmations < kRigidBefore) continue;
    ++before;
    if (track.inlier) ++still;
  }
  if (still >= min_inliers && still >= kShare * before) return "";
  std::ostringstream message;
  message << "only " << still << " of the " << before
          << " features that agreed with the first motion of the map agree with the second one: neither is "
             "believed; moved too far, blurred, or moving objects fill the view";
  return message.str();
}

}  // namespace stereo_nav::odometry
