#include "tools/fuse/fusion_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "core/roll_pitch_yaw.h"
#include "core/statistics.h"
#include "eval/metrics.h"

namespace stereo_nav::tools {
namespace {

constexpr const char* kWarning =
    "errors of opposite signs cancel in this formula; it is here for comparison alone";

/// Truth at an instant, interpolated; nothing outside of it.
std::optional<Eigen::Isometry3d> truthAt(const Trajectory& truth, double time_s) {
  const auto later = std::lower_bound(truth.begin(), truth.end(), time_s,
                                      [](const StampedPose& pose, double t) { return pose.time_s < t; });
  if (later == truth.end() || (later == truth.begin() && later->time_s > time_s)) return std::nullopt;
  if (later == truth.begin() || later->time_s == time_s) return later->T_world_body;
  const auto before = std::prev(later);
  const double share = (time_s - before->time_s) / (later->time_s - before->time_s);
  const Vector6d motion = logMotion(before->T_world_body.inverse() * later->T_world_body);
  return before->T_world_body * expMotion(share * motion);
}

double informationOf(const FuseRun& run) {
  double all = 0.0;
  for (const auto& statistics : run.statistics) all += statistics.information;
  return all;
}

double perField(const estimation::ChannelStatistics& statistics) {
  return statistics.nis_fields > 0.0 ? statistics.nis_sum / statistics.nis_fields : 0.0;
}

/// Sums over the poses.
struct Sums {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), absolute = Eigen::Vector3d::Zero(),
                  squared = Eigen::Vector3d::Zero();
  double nees = 0.0;
  std::size_t inside = 0, poses = 0;
};

void addPose(const eval::FrameRecord& frame, const Eigen::Isometry3d& T_true, bool planar, Sums& sums) {
  const Eigen::Isometry3d T_true_estimated = T_true.inverse() * *frame.T_odom_base;
  const Eigen::Vector3d turn = T_true.linear() * logRotation(Eigen::Matrix3d(T_true_estimated.linear()));
  Vector6d error;
  error << frame.T_odom_base->translation() - T_true.translation(), turn;
  const Eigen::Vector3d shown(error[0], error[1], error[5]);
  sums.sum += shown;
  sums.absolute += shown.cwiseAbs();
  sums.squared += shown.cwiseAbs2();
  ++sums.poses;
  const int fields = planar ? 3 : 6;
  double nees = 0.0;
  if (planar) {
    nees = shown.dot(planarCovariance(*frame.pose_covariance).ldlt().solve(shown));
  } else {
    nees = error.dot(frame.pose_covariance->ldlt().solve(error));
  }
  sums.nees += nees;
  if (nees < chiSquareQuantile(fields, 0.95)) ++sums.inside;
}

}  // namespace

PoseErrors poseErrors(const FuseRun& run) {
  PoseErrors errors;
  errors.nees_expected = run.input.planar ? 3 : 6;
  std::optional<Eigen::Isometry3d> T_odom_truth;
  Sums sums;
  for (const eval::FrameRecord& frame : run.input.frames) {
    const auto T_truth_base = truthAt(run.input.ground_truth, frame.time_s);
    if (!T_truth_base || !frame.T_odom_base) continue;
    if (!T_odom_truth) {
      T_odom_truth = *frame.T_odom_base * T_truth_base->inverse();
      continue;
    }
    addPose(frame, *T_odom_truth * *T_truth_base, run.input.planar, sums);
  }
  errors.poses = sums.poses;
  if (sums.poses == 0) return errors;
  const auto n = static_cast<double>(sums.poses);
  errors.rmse_x_m = std::sqrt(sums.squared[0] / n);
  errors.rmse_y_m = std::sqrt(sums.squared[1] / n);
  errors.rmse_yaw_deg = std::sqrt(sums.squared[2] / n) * kDegPerRad;
  errors.mae_x_m = sums.absolute[0] / n;
  errors.mae_y_m = sums.absolute[1] / n;
  errors.mae_yaw_deg = sums.absolute[2] / n * kDegPerRad;
  errors.published_x_m = std::abs(sums.sum[0]) / std::sqrt(n);
  errors.published_y_m = std::abs(sums.sum[1]) / std::sqrt(n);
  errors.nees_mean = sums.nees / n;
  errors.nees_inside_95_percent = 100.0 * static_cast<double>(sums.inside) / n;
  return errors;
}

std::string fusionJson(const FuseRun& run, const PoseErrors& errors) {
  using nlohmann::ordered_json;
  ordered_json json;
  json["measurements"] = run.measurements;
  json["poses_with_ground_truth"] = errors.poses;
  if (errors.poses > 0) {
    json["rmse_x_m"] = errors.rmse_x_m;
    json["rmse_y_m"] = errors.rmse_y_m;
    json["rmse_yaw_deg"] = errors.rmse_yaw_deg;
    json["mae_x_m"] = errors.mae_x_m;
    json["mae_y_m"] = errors.mae_y_m;
    json["mae_yaw_deg"] = errors.mae_yaw_deg;
    json["pose_nees"] = {{"expected", errors.nees_expected},
                         {"mean", errors.nees_mean},
                         {"inside_95_percent", errors.nees_inside_95_percent}};
    json["published_formula"] = {
        {"x_m", errors.published_x_m}, {"y_m", errors.published_y_m}, {"warning", kWarning}};
  }
  const double all = informationOf(run);
  json["sensors"] = ordered_json::array();
  for (std::size_t i = 0; i < run.channels.size(); ++i) {
    const estimation::ChannelStatistics& statistics = run.statistics[i];
    json["sensors"].push_back({{"name", run.channels[i].name},
                               {"used", statistics.used},
                               {"refused", statistics.refused},
                               {"set_aside", statistics.aside},
                               {"without_field", statistics.without_field},
                               {"rewound", statistics.rewound},
                               {"too_late", statistics.too_late},
                               {"stamped_ahead", statistics.ahead},
                               {"nis_per_field", perField(statistics)},
                               {"information_share", all > 0.0 ? statistics.information / all : 0.0}});
  }
  json["announcements"] = run.announcements;
  return json.dump(2) + "\n";
}

void printFusion(const FuseRun& run, const PoseErrors& errors) {
  if (errors.poses == 0) {
    std::printf("  no ground truth: the errors are unknown (--ground-truth names a file or a topic)\n");
  } else {
    std::printf("  RMSE x, y, yaw   %8.3f m %8.3f m %8.2f deg\n", errors.rmse_x_m, errors.rmse_y_m,
                errors.rmse_yaw_deg);
    std::printf("  MAE x, y, yaw    %8.3f m %8.3f m %8.2f deg\n", errors.mae_x_m, errors.mae_y_m,
                errors.mae_yaw_deg);
    std::printf("  abs(sum)/sqrt(N) %8.3f m %8.3f m  (warning: %s)\n", errors.published_x_m,
                errors.published_y_m, kWarning);
    std::printf("  NEES of the pose %8.2f (%d expected), %.1f %% inside 95 %%\n", errors.nees_mean,
                errors.nees_expected, errors.nees_inside_95_percent);
  }
  const double all = informationOf(run);
  std::printf("  %-44s %8s %8s %8s %6s %6s\n", "sensor", "used", "refused", "aside", "NIS", "share");
  for (std::size_t i = 0; i < run.channels.size(); ++i) {
    const estimation::ChannelStatistics& statistics = run.statistics[i];
    std::printf("  %-44s %8zu %8zu %8zu %6.2f %5.1f%%\n", run.channels[i].name.c_str(), statistics.used,
                statistics.refused, statistics.aside, perField(statistics),
                all > 0.0 ? 100.0 * statistics.information / all : 0.0);
  }
}

}  // namespace stereo_nav::tools
