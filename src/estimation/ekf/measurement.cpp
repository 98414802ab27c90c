#include "estimation/ekf/measurement.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/roll_pitch_yaw.h"

namespace stereo_nav::estimation {
namespace {

using Kind = Measurement::Kind;
constexpr double kAbsurd = 1e6;
constexpr double kUnknownVariance = 1e5;
constexpr double kLeastVariance = 1e-14;
constexpr double kStartRadius_m = 0.05;

const char* nameOf(const Measurement& measurement, int field) {
  static const std::array<const char*, 6> kPoses = {"x", "y", "z", "roll", "pitch", "yaw"};
  static const std::array<const char*, 6> kRates = {"vx", "vy", "vz", "vroll", "vpitch", "vyaw"};
  static const std::array<const char*, 6> kAccelerations = {"ax", "ay", "az", "", "", ""};
  const auto i = static_cast<std::size_t>(field);
  if (measurement.kind == Kind::kAcceleration) return kAccelerations[i];
  return measurement.kind == Kind::kPose || measurement.kind == Kind::kMotion ? kPoses[i] : kRates[i];
}

double valueOf(const Measurement& measurement, int field) {
  if (measurement.kind != Kind::kPose && measurement.kind != Kind::kMotion) return measurement.value[field];
  if (field < 3) return measurement.pose.translation()[field];
  return measurement.pose.linear().sum();  // finite where the rotation is
}

double defaultSigma(const DefaultSigmas& sigmas, Kind kind, int field) {
  switch (kind) {
    case Kind::kPose:
    case Kind::kMotion:
      return field < 3 ? sigmas.position_m : sigmas.attitude_rad;
    case Kind::kTwist:
      return field < 3 ? sigmas.velocity_m_s : sigmas.turn_rate_rad_s;
    case Kind::kRate:
      return sigmas.gyro_rad_s;
    case Kind::kAcceleration:
      break;
  }
  return sigmas.acceleration_m_s2;
}

using SixBySix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

bool positive(const Measurement& measurement) {
  const auto n = static_cast<Eigen::Index>(measurement.fields.size());
  SixBySix part = SixBySix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      part(i, j) = measurement.covariance(measurement.fields[static_cast<std::size_t>(i)],
                                          measurement.fields[static_cast<std::size_t>(j)]);
  }
  const bool symmetric = (part - part.transpose()).cwiseAbs().maxCoeff() <= 1e-6 * part.cwiseAbs().maxCoeff();
  if (measurement.kind == Kind::kMotion)
    return part.allFinite() && symmetric;  // motionSince() looks at differences
  return part.allFinite() && symmetric && Eigen::LLT<SixBySix>(part).info() == Eigen::Success;
}

class FieldCheck {
 public:
  FieldCheck(const DefaultSigmas& sigmas, Measurement& measurement)
      : sigmas_(sigmas), measurement_(measurement) {}

  std::vector<FieldFinding> run() {
    std::vector<int> good;
    for (const int field : measurement_.fields) {
      if (usable(field)) good.push_back(field);
    }
    if (good.empty() && unknown_ > 0 && unknown_ == measurement_.fields.size())
      say("lost", "says of all that it measures that it does not know it: it is left out until it does");
    measurement_.fields = good;
    if (!good.empty() && !positive(measurement_)) {
      const Vector6d variances = measurement_.covariance.diagonal();
      measurement_.covariance = variances.asDiagonal();
      say("covariance",
          "covariances between fields do not fit their variances: the variances alone are used");
    }
    return findings_;
  }

 private:
  bool usable(int field) {
    const char* name = nameOf(measurement_, field);
    const double value = valueOf(measurement_, field);
    if (!(std::abs(value) < kAbsurd)) {
      say(std::string(name) + " value",
          fmt::format("{} is {:g}, which is no measurement: the field is left out until it is one", name,
                      value));
      return false;
    }
    double& variance = measurement_.covariance(field, field);
    if (variance >= kUnknownVariance || variance <= -1.0) {
      ++unknown_;
      if (!(std::abs(variance) < 1e12))
        say(std::string(name) + " unknown",
            fmt::format("the variance of {} is {:g}: the field counts as unknown", name, variance));
      return false;
    }
    if (variance > kLeastVariance || isStart(variance)) return true;
    const double sigma = defaultSigma(sigmas_, measurement_.kind, field);
    say(std::string(name) + " variance",
        fmt::format(
            "the variance of {} is {:g}, which no sensor reaches: a standard deviation of {:g} stands in; the "
            "parameters default_* change it",
            name, variance, sigma));
    measurement_.covariance.row(field).setZero();
    measurement_.covariance.col(field).setZero();
    variance = sigma * sigma;
    return true;
  }

  /// Where an odometry begins, its pose is known without error.
  bool isStart(double variance) const {
    return measurement_.kind == Kind::kMotion && variance == 0.0 &&
           measurement_.pose.translation().norm() < kStartRadius_m;
  }

  void say(const std::string& key, const std::string& text) { findings_.push_back({key, text}); }

  const DefaultSigmas& sigmas_;
  Measurement& measurement_;
  std::vector<FieldFinding> findings_;
  std::size_t unknown_ = 0;  ///< fields that are said to be unknown
};

}  // namespace

std::vector<FieldFinding> checkFields(const DefaultSigmas& sigmas, Measurement& measurement) {
  return FieldCheck(sigmas, measurement).run();
}

}  // namespace stereo_nav::estimation
