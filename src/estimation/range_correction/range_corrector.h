#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "estimation/range_correction/range_params.h"
#include "estimation/range_correction/seen_walls.h"

namespace stereo_nav::estimation {

/// A reading of a range finder.
struct RangeReading {
  std::size_t sensor = 0;
  double time_s = 0.0;
  /// The beam runs along the x axis of the range finder. The robot stands upright.
  Eigen::Isometry2d T_base_sensor = Eigen::Isometry2d::Identity();
  double half_width_rad = 0.0;
  bool nearest = false;  ///< Beam::nearest
  double range_m = 0.0;
  double max_range_m = 12.0;  ///< of the range finder
};

/// What became of a reading.
enum class RangeOutcome {
  kWaiting,    ///< it is one of several, or the robot has not moved on
  kUsed,       ///< with those before it, it corrected the pose
  kAmbiguous,  ///< several walls may be meant, or perhaps none
  kForeign,    ///< most likely no wall of the map is meant
};
constexpr std::size_t kRangeOutcomes = 4;

/// Corrects the pose of the robot in a map by single beams against its walls: a Kalman filter of the pose (x,
/// y, yaw) and of a constant error of each range finder, which turning the robot tells from its place. Where
/// a beam may mean several walls, or something that the map does not have, each is weighed by its probability
/// (Thrun, Burgard and Fox 2005, "Probabilistic Robotics", section 6.3, has the mixture). A wall counts only
/// with 95 %, where it explains each of the readings as the robot moves, and where it lies within 99 % of
/// what the pose allows. How often a range finder meets what the map does not have is learned, finder by
/// finder.
class RangeCorrector {
 public:
  RangeCorrector(const RangeParams& params, std::size_t sensors);

  void setMap(const grid::OccupancyGrid& map) { map_ = map; }
  /// Where the robot is, x y yaw; what is known of the range finders stays.
  void setPose(const Eigen::Isometry2d& T_map_base, const Eigen::Matrix3d& covariance);
  /// A reading, and where the odometry had the robot then, with its covariance (x, y, yaw; axes of the
  /// odometry's frame) where that is known: what it has grown by since the reading before counts where it is
  /// more than the parameters say. Ranges must be finite and within the range finder's limits.
  RangeOutcome add(const RangeReading& reading, const Eigen::Isometry2d& T_odom_base,
                   const std::optional<Eigen::Matrix3d>& odom_covariance = std::nullopt);

  /// At the newest reading.
  const Eigen::Isometry2d& T_map_base() const { return T_map_base_; }
  Eigen::Isometry2d T_map_odom() const { return T_map_base_ * T_odom_base_.inverse(); }
  Eigen::Matrix3d covariance() const { return P_.topLeftCorner<3, 3>(); }
  double bias_m(std::size_t sensor) const { return bias_[static_cast<Eigen::Index>(sensor)]; }
  std::size_t count(RangeOutcome outcome) const { return counts_[static_cast<std::size_t>(outcome)]; }

 private:
  struct Past {
    RangeReading reading;
    Eigen::Isometry2d T_odom_base;
  };
  struct Finder {
    std::deque<Past> readings;
    double foreign_share = 0.0;  ///< of its beams, as seen so far
    bool measured = false;
    Eigen::Isometry2d T_odom_base = Eigen::Isometry2d::Identity();  ///< of its last measurement
  };
  /// The mean of readings against one wall.
  struct Candidate {
    Eigen::VectorXd H;
    double residual_m = 0.0;
    double variance = 0.0;    ///< of the residual, with that of the state
    double noise = 0.0;       ///< without
    double likelihood = 0.0;  ///< density, 1/m; 0 where the readings do not change as they would before it
    double range_m = 0.0;     ///< expected, of the newest reading
  };

  void moveTo(double time_s, const Eigen::Isometry2d& T_odom_base,
              const std::optional<Eigen::Matrix3d>& odom_covariance);
  Eigen::Matrix3d motionNoise(const Eigen::Isometry2d& motion,
                              const std::optional<Eigen::Matrix3d>& odom_covariance) const;
  bool movedOn(const Finder& finder) const;
  RangeOutcome measure(std::size_t sensor);
  Beam beamOf(const Past& past) const;
  Candidate candidateOf(const SeenWall& wall, std::size_t sensor) const;
  void judge(Candidate& candidate, const std::vector<double>& residuals_m) const;
  void correct(const Candidate& candidate);

  RangeParams params_;
  grid::OccupancyGrid map_;
  std::vector<Finder> finders_;
  Eigen::Isometry2d T_map_base_ = Eigen::Isometry2d::Identity();
  Eigen::VectorXd bias_;
  Eigen::MatrixXd P_;  ///< of x, y (axes of the map), yaw, biases
  bool moving_ = false;
  double time_s_ = 0.0;
  Eigen::Isometry2d T_odom_base_ = Eigen::Isometry2d::Identity();
  std::optional<Eigen::Matrix3d> odom_covariance_;
  std::array<std::size_t, kRangeOutcomes> counts_{};
};

}  // namespace stereo_nav::estimation
