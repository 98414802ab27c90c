#include "estimation/ekf/fusion_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stereo_nav::estimation {
namespace {

constexpr double kAhead_s = 0.5;
constexpr double kSayAgain_s = 10.0;
constexpr int kRefusedInSuccession = 3;  // one in a thousand is refused by chance
constexpr double kClockBack_s = 1.0;

}  // namespace

FusionFilter::FusionFilter(const FilterParams& params, const StateParts& parts, std::vector<Channel> channels)
    : params_(params), estimator_(params, parts, std::move(channels)) {
  statistics_.resize(estimator_.channels().size());
}

void FusionFilter::begin(double time_s) {
  Entry entry;
  entry.memory = estimator_.initial(time_s);
  entry.measurement.time_s = time_s;
  if (start_pose_) estimator_.setPose(start_pose_->first, start_pose_->second, entry.memory);
  start_pose_.reset();
  history_.clear();
  history_.push_back(std::move(entry));
}

void FusionFilter::add(Measurement measurement, double received_s) {
  if (started() && received_s < received_s_ - kClockBack_s)
    clockSetBack(measurement.time_s, received_s_ - received_s);
  received_s_ = received_s;
  if (!stampUsable(measurement, received_s)) return;
  for (const FieldFinding& finding : checkFields(params_.defaults, measurement))
    say(nameOf(measurement) + finding.key, nameOf(measurement) + ": " + finding.text, received_s);
  if (!started()) begin(measurement.time_s);
  insert(std::move(measurement));
  forgetOld();
}

bool FusionFilter::stampUsable(const Measurement& measurement, double received_s) {
  if (measurement.time_s > received_s + kAhead_s || !(measurement.time_s > 0.0)) {
    ++statisticsOf(measurement).ahead;
    say(nameOf(measurement) + "ahead",
        fmt::format(
            "{}: a stamp lies {:.1f} s after its arrival, the measurement is left out; do the clocks of the two "
            "computers agree (chrony)?",
            nameOf(measurement), measurement.time_s - received_s),
        received_s);
    return false;
  }
  if (!started()) return true;
  const double oldest_s =
      params_.rewind ? std::max(time_s() - params_.history_s, history_.front().measurement.time_s) : time_s();
  if (measurement.time_s >= oldest_s) return true;
  ++statisticsOf(measurement).too_late;
  say(nameOf(measurement) + "late",
      fmt::format("{}: a measurement came {:.2f} s late and is left out; the history reaches back {:.2f} s "
                  "(history_length, history_megabytes)",
                  nameOf(measurement), time_s() - measurement.time_s, time_s() - oldest_s),
      received_s);
  return false;
}

/// The pose stays, its history is void.
void FusionFilter::clockSetBack(double time_s, double by_s) {
  ++clock_resets_;
  announcements_.push_back(fmt::format(
      "the clock was set back by {:.1f} s: {}", by_s,
      params_.reset_on_time_jump ? "the filter begins anew" : "the filter goes on from the present pose"));
  EstimatorMemory memory = history_.back().memory;
  begin(time_s);
  said_.clear();
  if (params_.reset_on_time_jump) return;
  EstimatorMemory& now = history_.back().memory;
  now.state = std::move(memory.state);
  now.state.time_s = time_s;
  now.pose_known = memory.pose_known;
}

void FusionFilter::insert(Measurement taken) {
  const std::size_t index = firstLaterThan(taken.time_s);
  if (index < history_.size()) ++statisticsOf(taken).rewound;
  history_.insert(history_.begin() + static_cast<std::ptrdiff_t>(index),
                  {std::move(taken), history_[index - 1].memory});
  const Measurement& measurement = history_[index].measurement;
  const Outcome outcome = estimator_.apply(measurement, history_[index].memory);
  takeInAgain(index + 1);
  report(measurement, outcome);
  // What a verdict says of the last window has harmed the state already: that is undone.
  if (!outcome.verdict.news) return;
  const std::size_t begin = std::max<std::size_t>(1, firstLaterThan(outcome.verdict.from_s));
  heed(outcome.verdict, outcome.verdict.from_s, measurement.time_s, history_[begin - 1].memory.channels);
  takeInAgain(begin);
}

std::size_t FusionFilter::firstLaterThan(double time_s) const {
  const auto later = [](double than_s, const Entry& entry) { return than_s < entry.measurement.time_s; };
  return static_cast<std::size_t>(std::upper_bound(history_.begin(), history_.end(), time_s, later) -
                                  history_.begin());
}

void FusionFilter::takeInAgain(std::size_t from) {
  for (std::size_t i = from; i < history_.size(); ++i) {
    history_[i].memory = history_[i - 1].memory;
    estimator_.apply(history_[i].measurement, history_[i].memory);
  }
}

void FusionFilter::forgetOld() {
  const double oldest_s = time_s() - params_.history_s;
  const auto most = std::max<std::size_t>(
      2, static_cast<std::size_t>(params_.history_megabytes * 1e6 / static_cast<double>(entryBytes())));
  while (history_.size() > 1 &&
         (history_.size() > most || history_[1].measurement.time_s < oldest_s || !params_.rewind))
    history_.pop_front();
}

std::size_t FusionFilter::entryBytes() const {
  const auto rows = static_cast<std::size_t>(layout().rows());
  return sizeof(Entry) + sizeof(double) * rows * rows + channels().size() * sizeof(ChannelMemory) +
         static_cast<std::size_t>(layout().anchors()) * sizeof(Eigen::Isometry3d);
}

FusedEstimate FusionFilter::estimate(double time_s) const {
  const State* state = &history_.back().memory.state;
  State later;
  if (time_s > state->time_s) {
    later = *state;
    predict(layout(), estimator_.noise(), time_s, later);
    state = &later;
  }
  FusedEstimate estimate;
  estimate.time_s = state->time_s;
  estimate.T_world_base = state->T_world_base;
  estimate.pose_covariance =
      turned(state->T_world_base.linear(), layout().covarianceOf(*state, error_row::kPosition, 6));
  estimate.twist << state->velocity, state->rate;
  estimate.twist_covariance = layout().covarianceOf(*state, error_row::kVelocity, 6);
  const WheelScales scale_variances =
      layout().covarianceOf(*state, error_row::kScale, kWheelScales).diagonal();
  const WheelScales by_scale = velocityByScale(*state);
  for (int i = 0; i < kWheelScales; ++i) {
    const int field = kPlanarFields[static_cast<std::size_t>(kScalePlaces[static_cast<std::size_t>(i)].axis)];
    estimate.twist_covariance(field, field) += std::pow(by_scale[i], 2) * scale_variances[i];
  }
  estimate.acceleration = state->acceleration;
  return estimate;
}

void FusionFilter::setPose(const Eigen::Isometry3d& T_world_base, const Matrix6d& covariance) {
  if (!started()) {
    start_pose_ = {T_world_base, covariance};
    return;
  }
  history_.erase(history_.begin(), history_.end() - 1);
  estimator_.setPose(T_world_base, covariance, history_.back().memory);
}

void FusionFilter::reset() {
  history_.clear();
  start_pose_.reset();
}

void FusionFilter::report(const Measurement& measurement, const Outcome& outcome) {
  ChannelStatistics& statistics = statisticsOf(measurement);
  switch (outcome.kind) {
    case Outcome::Kind::kUsed:
      ++statistics.used;
      statistics.nis_sum += outcome.nis;
      statistics.nis_fields += outcome.fields;
      statistics.information += outcome.information;
      break;
    case Outcome::Kind::kRefused:
      ++statistics.refused;
      if (outcome.refused != kRefusedInSuccession) break;
      say(nameOf(measurement) + "refused",
          fmt::format(
              "{} disagrees with what the others and the motion so far say: off by {:.2g}, normalised {:.0f} "
              "where {} is usual; it is left out while it does",
              nameOf(measurement), outcome.distance, outcome.nis, outcome.fields),
          measurement.time_s);
      break;
    case Outcome::Kind::kAside:
      ++statistics.aside;
      break;
    case Outcome::Kind::kWithoutField:
      ++statistics.without_field;
      break;
    case Outcome::Kind::kAnchored:
      break;
  }
  reportVerdict(outcome.verdict, measurement.time_s);
}

void FusionFilter::reportVerdict(const Verdict& verdict, double time_s) {
  for (const Contradiction& contradiction : verdict.contradictions)
    say(fmt::format("pair {} {} {}", contradiction.one, contradiction.other, contradiction.field),
        describe(contradiction, channels()), time_s);
  if (verdict.culprit < 0) return;
  const std::string& name = channels()[static_cast<std::size_t>(verdict.culprit)].name;
  say(name + "culprit", name + " is outvoted by all others and set aside until it agrees again", time_s);
}

void FusionFilter::say(const std::string& key, const std::string& text, double time_s) {
  const auto found = said_.find(key);
  const bool repeated = found != said_.end() && std::abs(time_s - found->second) < kSayAgain_s;
  said_[key] = time_s;
  if (!repeated) announcements_.push_back(text);
}

std::vector<std::string> FusionFilter::takeAnnouncements() {
  return std::exchange(announcements_, {});
}

const std::string& FusionFilter::nameOf(const Measurement& measurement) const {
  return channels()[static_cast<std::size_t>(measurement.channel)].name;
}

ChannelStatistics& FusionFilter::statisticsOf(const Measurement& measurement) {
  return statistics_[static_cast<std::size_t>(measurement.channel)];
}

}  // namespace stereo_nav::estimation
