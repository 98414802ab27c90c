#include "estimation/ekf/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kMostNoise = 1e4;
constexpr double kLearningRate = 0.05;
constexpr int kFewestSamples = 2;
constexpr double kSigmas = 4.0;
constexpr double kTolerance =
    0.03;  ///< m/s or rad/s: windows of two channels do not cover quite the same time

/// A mean with its standard deviation.
struct View {
  int channel;
  double mean;
  double variance;
};

View viewOf(int index, const Channel& channel, const Opinion& opinion, std::size_t field) {
  View view{index, static_cast<double>(opinion.sum) / opinion.count,
            opinion.variance_sum / std::pow(opinion.count, 2) + opinion.common_variance};
  if (opinion.duration_s <= 0.0F) return view;
  // Noise of single poses cancels between neighbouring motions: those of the first and the last one count.
  const double reading = field < 3 ? channel.reading_sigma_m : channel.reading_sigma_rad;
  view.variance += 2.0 * std::pow(reading / opinion.duration_s, 2);
  return view;
}

/// The channel that contradicts all others that speak, when those agree; -1 without.
int outvoted(const std::vector<int>& speakers, const std::vector<Contradiction>& contradictions) {
  if (speakers.size() < 3) return -1;
  for (const int speaker : speakers) {
    const auto involves = [&](const Contradiction& c) { return c.one == speaker || c.other == speaker; };
    const auto with =
        static_cast<std::size_t>(std::count_if(contradictions.begin(), contradictions.end(), involves));
    if (with == speakers.size() - 1 && with == contradictions.size()) return speaker;
  }
  return -1;
}

}  // namespace

void Opinion::add(const Opinion& other) {
  sum += other.sum;
  variance_sum += other.variance_sum;
  common_variance = std::max(common_variance, other.common_variance);
  duration_s += other.duration_s;
  count += other.count;
}

Opinion Opinions::of(std::size_t field) const {
  Opinion all;
  for (const auto& one : bins) all.add(one[field]);
  return all;
}

Gate::Gate(double share) {
  for (int fields = 1; fields <= 6; ++fields)
    limit_[static_cast<std::size_t>(fields)] = chiSquareQuantile(fields, share);
}

bool Gate::pass(const Channel& channel, int fields, double nis, ChannelMemory& memory) const {
  const double own = limit_[static_cast<std::size_t>(fields)];
  const double limit = channel.gate > 0.0 ? channel.gate * channel.gate : own;
  const bool passes = nis <= limit;
  memory.refused = passes ? 0 : memory.refused + 1;
  // A pose that is refused says nothing of the noise of those that are not: a jump must not buy its way in.
  if (!passes && channel.kind == Measurement::Kind::kPose) return false;
  const double excess = std::min(nis, own) / fields - 1.0;
  memory.noise_factor = std::clamp(memory.noise_factor * (1.0 + kLearningRate * excess), 1.0, kMostNoise);
  return passes;
}

Verdict vote(const std::vector<Channel>& channels, const std::vector<ChannelMemory>& memories) {
  Verdict verdict;
  for (std::size_t field = 0; field < 6; ++field) {
    std::vector<View> views;
    std::vector<int> speakers;
    for (std::size_t i = 0; i < memories.size(); ++i) {
      const Opinion opinion = memories[i].opinions.of(field);
      if (opinion.count < kFewestSamples) continue;
      views.push_back(viewOf(static_cast<int>(i), channels[i], opinion, field));
      speakers.push_back(static_cast<int>(i));
    }
    std::vector<Contradiction> found;
    for (std::size_t i = 0; i < views.size(); ++i) {
      for (std::size_t j = i + 1; j < views.size(); ++j) {
        const double difference = views[i].mean - views[j].mean;
        const double sigma = std::sqrt(views[i].variance + views[j].variance);
        if (std::abs(difference) > kSigmas * sigma + kTolerance)
          found.push_back({views[i].channel, views[j].channel, static_cast<int>(field), difference,
                           std::abs(difference) / sigma});
      }
    }
    if (verdict.culprit < 0) verdict.culprit = outvoted(speakers, found);
    verdict.contradictions.insert(verdict.contradictions.end(), found.begin(), found.end());
  }
  return verdict;
}

bool heed(const Verdict& verdict, double now_s, double until_s, std::vector<ChannelMemory>& memories) {
  bool news = false;
  if (verdict.culprit >= 0) {
    ChannelMemory& culprit = memories[static_cast<std::size_t>(verdict.culprit)];
    news = culprit.aside_until_s < now_s;
    culprit.aside_until_s = std::max(culprit.aside_until_s, until_s);
    return news;
  }
  for (const Contradiction& contradiction : verdict.contradictions) {
    for (const int one : {contradiction.one, contradiction.other}) {
      Doubt& doubt =
          memories[static_cast<std::size_t>(one)].doubts[static_cast<std::size_t>(contradiction.field)];
      const bool doubted = doubt.until_s >= now_s;
      news = news || !doubted;
      const double factor = std::min(contradiction.sigmas * contradiction.sigmas, kMostNoise);
      doubt.factor = std::max(doubted ? doubt.factor : 1.0, factor);
      doubt.until_s = std::max(doubt.until_s, until_s);
    }
  }
  return news;
}

std::string describe(const Contradiction& contradiction, const std::vector<Channel>& channels) {
  static const char* const kFields[6] = {"vx", "vy", "vz", "vroll", "vpitch", "vyaw"};
  return fmt::format(
      "{} and {} disagree about {} by {:.2g} {}", channels[static_cast<std::size_t>(contradiction.one)].name,
      channels[static_cast<std::size_t>(contradiction.other)].name, kFields[contradiction.field],
      std::abs(contradiction.difference), contradiction.field < 3 ? "m/s" : "rad/s");
}

}  // namespace stereo_nav::estimation
