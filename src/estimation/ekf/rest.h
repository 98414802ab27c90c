#pragma once

#include <vector>

#include "estimation/ekf/channel.h"
#include "estimation/ekf/correction.h"

namespace stereo_nav::estimation {

/// So long every sensor must say that the robot rests.
constexpr double kRestConfirmed_s = 0.5;

/// Whether measurements of this kind tell a speed or a turn rate.
bool tellsTwist(Measurement::Kind kind);

/// What a measurement says of the twist of base_link; zero where it says nothing. `memory` is that of before
/// it.
Vector6d twistOf(const Measurement& measurement, const State& state, const ChannelMemory& memory);

/// Smooths it over 0.3 s.
void smoothTwist(const Vector6d& twist, double interval_s, ChannelMemory& memory);

/// Whether it knows the speed by its own covariance: a laser in a corridor sees no way, and says zero.
bool tellsWay(const Measurement& measurement, const ChannelMemory& memory);

/// Whether all channels that were heard in the last half second say that the robot rests, among them one that
/// measures the way: a gyroscope alone cannot tell rest from a straight way.
bool sayRest(const std::vector<Channel>& channels, const std::vector<ChannelMemory>& memories, double time_s);

/// Velocity and turn rate are zero. A start is noticed some tenths of a second late: the wheels' scales are
/// not corrected by it, which would have to explain then that the wheels turn.
Innovation observeRest(const StateLayout& layout, const State& state);

}  // namespace stereo_nav::estimation
