#include "estimation/ekf/estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"
#include "estimation/ekf/odometry_motion.h"
#include "estimation/ekf/rest.h"

namespace stereo_nav::estimation {
namespace {

using Kind = Measurement::Kind;
constexpr double kAside_s = 1.0;
constexpr double kShown_s = 1.0;

const std::vector<int> kAllFields = {0, 1, 2, 3, 4, 5};

void addOpinion(ChannelMemory& memory, long bin, int field, double residual, double variance,
                double common_variance, double duration_s) {
  Opinion opinion;
  opinion.sum = static_cast<float>(residual);
  opinion.variance_sum = static_cast<float>(variance);
  opinion.common_variance = static_cast<float>(common_variance);
  opinion.duration_s = static_cast<float>(duration_s);
  opinion.count = 1;
  memory.opinions.bin(bin)[static_cast<std::size_t>(field)].add(opinion);
}

long binOf(double time_s) {
  return std::lround(std::floor(time_s / Opinions::kBin_s));
}

/// What the standard deviation of each field is multiplied by.
Vector6d sigmaFactors(const ChannelMemory& memory, double time_s) {
  Vector6d factors;
  for (Eigen::Index field = 0; field < 6; ++field) {
    const Doubt& doubt = memory.doubts[static_cast<std::size_t>(field)];
    const bool doubted = time_s < doubt.until_s;
    factors[field] = std::sqrt(doubted ? std::max(memory.noise_factor, doubt.factor) : memory.noise_factor);
  }
  return factors;
}

void multiplyNoise(const Vector6d& sigma_factors, Innovation& innovation) {
  for (std::size_t i = 0; i < innovation.fields.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    innovation.noise.row(row) *= sigma_factors[innovation.fields[i]];
    innovation.noise.col(row) *= sigma_factors[innovation.fields[i]];
  }
}

/// Variance of what biases and scales make of one row of an innovation.
double commonVariance(const StateLayout& layout, const State& state, const Innovation& innovation,
                      Eigen::Index row) {
  const int first = layout.movingRows(), rows = layout.coreRows() - first;
  const Eigen::VectorXd by_calibration = innovation.H.row(row).segment(first, rows);
  return by_calibration.dot(state.covariance.block(first, first, rows, rows) * by_calibration);
}

/// A motion that is refused may be the right one: the pose may be off by what it would have been moved.
void addDoubt(const StateLayout& layout, const Innovation& innovation, State& state) {
  Eigen::VectorXd off = Eigen::VectorXd::Zero(layout.rows());
  for (std::size_t i = 0; i < innovation.fields.size(); ++i)
    off[layout.at(error_row::kPosition + innovation.fields[i])] =
        innovation.residual[static_cast<Eigen::Index>(i)];
  state.covariance += off * off.transpose();
}

/// What an odometry says of velocities beyond what the filter expects.
void addOpinionOfMotion(const Measurement& measurement, const OdometryMotion& motion,
                        const Eigen::Isometry3d& corrected, const WheelScales& scale_variances,
                        const EstimatorMemory& memory, ChannelMemory& channel) {
  if (motion.duration_s > Opinions::kBins * Opinions::kBin_s || motion.duration_s <= 0.0) return;
  const Vector6d difference =
      logMotion(corrected) - logMotion(channel.T_start_reckoned.inverse() * memory.T_start_reckoned);
  const Vector6d told = logMotion(motion.motion);
  const double per_s = 1.0 / motion.duration_s;
  for (const int field : measurement.fields) {
    double common_variance = 0.0;
    for (std::size_t k = 0; k < kScalePlaces.size(); ++k) {
      if (kPlanarFields[static_cast<std::size_t>(kScalePlaces[k].axis)] == field)
        common_variance +=
            scale_variances[static_cast<Eigen::Index>(k)] *
            std::pow(told[kPlanarFields[static_cast<std::size_t>(kScalePlaces[k].of)]] * per_s, 2);
    }
    addOpinion(channel, memory.window, field, difference[field] * per_s,
               motion.covariance(field, field) * per_s * per_s, common_variance, motion.duration_s);
  }
}

}  // namespace

Estimator::Estimator(const FilterParams& params, const StateParts& parts, std::vector<Channel> channels)
    : params_(params),
      layout_(parts),
      noise_(params.noise()),
      channels_(std::move(channels)),
      gate_(params.gate_share) {
  int anchors = 0;
  for (const Channel& channel : channels_)
    anchor_of_.push_back(channel.kind == Kind::kMotion ? anchors++ : -1);
}

EstimatorMemory Estimator::initial(double time_s) const {
  using namespace error_row;
  EstimatorMemory memory;
  memory.channels.resize(channels_.size());
  memory.window = binOf(time_s);
  memory.still_since_s = time_s;
  State& state = memory.state;
  state.time_s = time_s;
  state.anchors.assign(static_cast<std::size_t>(layout_.anchors()), Eigen::Isometry3d::Identity());
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(kAnchors + 6 * layout_.anchors());
  variance.segment<6>(kPosition).setConstant(1e-9);
  variance.segment<6>(kVelocity).setConstant(1e-2);
  variance.segment<3>(kAcceleration).setConstant(1.0);
  if (params_.initial_variance) variance.head<15>() = *params_.initial_variance;
  variance.segment<3>(kGyroBias).setConstant(std::pow(params_.gyro_bias_sigma_rad_s, 2));
  variance.segment<3>(kAccelerometerBias).setConstant(std::pow(params_.accelerometer_bias_sigma_m_s2, 2));
  variance.segment<kWheelScales>(kScale) = params_.scaleVariances();
  state.covariance = Eigen::MatrixXd::Zero(layout_.rows(), layout_.rows());
  for (int i = 0; i < layout_.rows(); ++i)
    state.covariance(i, i) = variance[layout_.kept()[static_cast<std::size_t>(i)]];
  if (!params_.initial_state) return memory;
  const auto& start = *params_.initial_state;
  state.T_world_base.translation() = start.head<3>();
  state.T_world_base.linear() = RollPitchYaw{start[3], start[4], start[5]}.rotation();
  state.velocity = start.segment<3>(6);
  state.rate = start.segment<3>(9);
  state.acceleration = start.segment<3>(12);
  memory.pose_known.fill(true);
  return memory;
}

Outcome Estimator::apply(const Measurement& measurement, EstimatorMemory& memory) const {
  holdUnshownScales(measurement.time_s, memory);
  const Eigen::Isometry3d before = memory.state.T_world_base;
  predict(layout_, noise_, measurement.time_s, memory.state);
  memory.T_start_reckoned =
      renormalised(memory.T_start_reckoned * before.inverse() * memory.state.T_world_base);
  Verdict verdict = voteWhenDue(measurement.time_s, memory);
  ChannelMemory& channel = memory.channels[static_cast<std::size_t>(measurement.channel)];
  const double interval_s = measurement.time_s - channel.newest_s;
  channel.newest_s = measurement.time_s;
  const Vector6d twist = twistOf(measurement, memory.state, channel);
  channel.tells_way = tellsWay(measurement, channel);
  Outcome outcome =
      measurement.kind == Kind::kMotion ? applyMotion(measurement, memory) : applyDirect(measurement, memory);
  outcome.verdict = std::move(verdict);
  if (outcome.kind == Outcome::Kind::kUsed) channel.used_s = measurement.time_s;
  if (!params_.zero_velocity_updates) return outcome;
  smoothTwist(twist, interval_s, channel);
  holdStill(measurement, memory);
  return outcome;
}

Verdict Estimator::voteWhenDue(double time_s, EstimatorMemory& memory) const {
  const long window = binOf(time_s);
  if (window == memory.window) return {};
  Verdict verdict = vote(channels_, memory.channels);
  verdict.from_s = static_cast<double>(window - Opinions::kBins) * Opinions::kBin_s;
  verdict.news = heed(verdict, time_s, time_s + kAside_s, memory.channels);
  for (ChannelMemory& channel : memory.channels) {
    for (long bin = std::max(memory.window + 1, window - Opinions::kBins + 1); bin <= window; ++bin)
      channel.opinions.bin(bin) = {};
  }
  memory.window = window;
  return verdict;
}

/// The wheels' scales are held while nothing but the wheels tells of the way, or of the turning: what
/// corrections would make of them then is only what the model expects of velocities.
void Estimator::holdUnshownScales(double time_s, EstimatorMemory& memory) const {
  bool way_shown = false, turn_shown = false;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const bool heard = time_s - memory.channels[i].used_s < kShown_s;
    if (!heard || channels_[i].wheels || channels_[i].kind == Kind::kAcceleration) continue;
    turn_shown = true;
    way_shown = way_shown || channels_[i].kind != Kind::kRate;
  }
  for (std::size_t i = 0; i < kScalePlaces.size(); ++i)
    memory.state.scale_held[i] = kScalePlaces[i].axis == 2 ? !turn_shown : !way_shown;
}

Outcome Estimator::takeIn(const Measurement& measurement, Innovation innovation,
                          EstimatorMemory& memory) const {
  const auto index = static_cast<std::size_t>(measurement.channel);
  ChannelMemory& channel = memory.channels[index];
  Outcome outcome;
  outcome.fields = static_cast<int>(innovation.residual.size());
  outcome.distance = outcome.fields == 0 ? 0.0 : innovation.residual.cwiseAbs().maxCoeff();
  const auto as = [&outcome](Outcome::Kind kind) {
    outcome.kind = kind;
    return outcome;
  };
  if (outcome.fields == 0) return as(Outcome::Kind::kWithoutField);
  if (measurement.time_s < channel.aside_until_s) return as(Outcome::Kind::kAside);
  multiplyNoise(sigmaFactors(channel, measurement.time_s), innovation);
  if (!weigh(memory.state, innovation)) return as(Outcome::Kind::kWithoutField);
  outcome.nis = innovation.nis;
  outcome.information = innovation.information;
  if (!gate_.pass(channels_[index], outcome.fields, innovation.nis, channel)) {
    outcome.refused = channel.refused;
    return as(Outcome::Kind::kRefused);
  }
  return as(correct(layout_, innovation, memory.state) ? Outcome::Kind::kUsed : Outcome::Kind::kRefused);
}

Outcome Estimator::applyDirect(const Measurement& measurement, EstimatorMemory& memory) const {
  const auto index = static_cast<std::size_t>(measurement.channel);
  if (measurement.kind == Kind::kPose) openUnknownPose(measurement, memory);
  Innovation innovation = observe(layout_, memory.state, measurement, channels_[index].wheels,
                                  channels_[index].feels_gravity ? params_.gravity_m_s2 : 0.0);
  if (measurement.kind == Kind::kTwist || measurement.kind == Kind::kRate) {
    for (std::size_t i = 0; i < innovation.fields.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      addOpinion(memory.channels[index], memory.window, innovation.fields[i], innovation.residual[row],
                 innovation.noise(row, row), commonVariance(layout_, memory.state, innovation, row), 0.0);
    }
  }
  return takeIn(measurement, std::move(innovation), memory);
}

Outcome Estimator::applyMotion(const Measurement& measurement, EstimatorMemory& memory) const {
  const auto index = static_cast<std::size_t>(measurement.channel);
  const Channel& channel = channels_[index];
  ChannelMemory& remembered = memory.channels[index];
  if (!remembered.anchored || measurement.fields.empty()) {
    startAnchor(measurement, memory);
    Outcome outcome;
    outcome.kind = measurement.fields.empty() ? Outcome::Kind::kWithoutField : Outcome::Kind::kAnchored;
    return outcome;
  }
  const int anchor = anchor_of_[index];
  const OdometryMotion motion = motionSince(remembered, measurement);
  const Eigen::Isometry3d corrected =
      channel.wheels ? scaled(motion.motion, memory.state.wheel_scale) : motion.motion;
  WheelScales scale_variances = WheelScales::Zero();
  if (channel.wheels)
    scale_variances = layout_.covarianceOf(memory.state, error_row::kScale, kWheelScales).diagonal();
  addOpinionOfMotion(measurement, motion, corrected, scale_variances, memory, remembered);
  const Vector6d factors = sigmaFactors(remembered, measurement.time_s);
  moveAnchor(layout_, anchor, motion.motion, factors.asDiagonal() * motion.covariance * factors.asDiagonal(),
             channel.wheels, memory.state);
  Vector6d reading;
  reading << Eigen::Vector3d::Constant(std::pow(channel.reading_sigma_m, 2)),
      Eigen::Vector3d::Constant(std::pow(channel.reading_sigma_rad, 2));
  const Innovation innovation = observeAnchor(layout_, memory.state, anchor, measurement.fields, reading);
  const Outcome outcome = takeIn(measurement, innovation, memory);
  if (outcome.kind == Outcome::Kind::kRefused) addDoubt(layout_, innovation, memory.state);
  const bool held = outcome.kind == Outcome::Kind::kUsed;
  const bool all = measurement.fields.size() == 6 || (layout_.planar() && outcome.fields == 3);
  if (!held) {
    startAnchor(measurement, memory);
    return outcome;
  }
  if (!all) {
    std::vector<int> unmeasured;
    for (const int field : kAllFields) {
      if (std::find(measurement.fields.begin(), measurement.fields.end(), field) == measurement.fields.end())
        unmeasured.push_back(field);
    }
    cloneAnchor(layout_, anchor, unmeasured, memory.state);
  }
  remembered.T_odometry_base = measurement.pose;
  remembered.odometry_covariance = measurement.covariance;
  remembered.anchored_s = measurement.time_s;
  remembered.T_start_reckoned = memory.T_start_reckoned;
  return outcome;
}

void Estimator::startAnchor(const Measurement& measurement, EstimatorMemory& memory) const {
  const auto index = static_cast<std::size_t>(measurement.channel);
  ChannelMemory& channel = memory.channels[index];
  cloneAnchor(layout_, anchor_of_[index], kAllFields, memory.state);
  channel.anchored = !measurement.fields.empty();
  channel.anchored_s = measurement.time_s;
  channel.T_odometry_base = measurement.pose;
  channel.odometry_covariance = measurement.covariance;
  channel.T_start_reckoned = memory.T_start_reckoned;
}

/// Nothing has told of this field of the pose so far: the start at zero was a convention, which gives way.
void Estimator::openUnknownPose(const Measurement& measurement, EstimatorMemory& memory) const {
  Vector6d opened = Vector6d::Zero();
  for (const int field : measurement.fields) {
    bool& known = memory.pose_known[static_cast<std::size_t>(field)];
    if (!known) opened[field] = field < 3 ? 1e6 : kPi * kPi;
    known = true;
  }
  if (opened.isZero()) return;
  const Eigen::Matrix3d R = memory.state.T_world_base.linear();
  const Matrix6d added = turned(R.transpose(), opened.asDiagonal());
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      if (layout_.at(i) >= 0 && layout_.at(j) >= 0)
        memory.state.covariance(layout_.at(i), layout_.at(j)) += added(i, j);
    }
  }
  for (ChannelMemory& channel : memory.channels) channel.anchored = false;
}

void Estimator::setPose(const Eigen::Isometry3d& T_world_base, const Matrix6d& covariance,
                        EstimatorMemory& memory) const {
  const Matrix6d in_base = turned(T_world_base.linear().transpose(), covariance);
  State& state = memory.state;
  state.T_world_base = T_world_base;
  for (int i = 0; i < 6; ++i) {
    const int row = layout_.at(i);
    if (row < 0) continue;
    state.covariance.row(row).setZero();
    state.covariance.col(row).setZero();
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      if (layout_.at(i) >= 0 && layout_.at(j) >= 0)
        state.covariance(layout_.at(i), layout_.at(j)) = in_base(i, j) + (i == j ? 1e-12 : 0.0);
    }
  }
  memory.pose_known.fill(true);
  for (ChannelMemory& channel : memory.channels) channel.anchored = false;
}

void Estimator::holdStill(const Measurement& measurement, EstimatorMemory& memory) const {
  if (!sayRest(channels_, memory.channels, measurement.time_s)) memory.still_since_s = measurement.time_s;
  if (measurement.time_s - memory.still_since_s < kRestConfirmed_s || !tellsTwist(measurement.kind)) return;
  Innovation innovation = observeRest(layout_, memory.state);
  if (weigh(memory.state, innovation)) correct(layout_, innovation, memory.state);
}

}  // namespace stereo_nav::estimation
