#include "sensors/serial/stamp_filter.h"

#include <algorithm>

namespace stereo_nav::serial {
namespace {

/// When all arrivals are late for this long, the cause is not batching: frames were lost unnoticed.
constexpr double kStepWatch_s = 0.5;
/// When no frame arrives for longer than this, either the program or the module was stopped.
constexpr double kSilence_s = 0.1;
/// When the line is re-estimated, successive stamps stay apart by at least this share of the period.
constexpr double kMinStep = 0.1;

}  // namespace

void StampFilterParams::describe(ParameterVisitor& visitor) {
  visitor.real(
      "window_s", window_s, {2.0, 600.0}, "s",
      "time of the arrivals from which the device clock is estimated; longer is smoother, shorter follows "
      "its drift");
  visitor.real("settle_s", settle_s, {0.2, 60.0}, "s",
               "time after which the rate of the device clock is re-estimated for the first time");
}

void StampFilter::reset() {
  *this = StampFilter(params_);
}

void StampFilter::beginWindow() {
  older_.clear();
  younger_.clear();
  late_since_s_.reset();
}

void StampFilter::restartClock() {
  beginWindow();
  last_x_.reset();
  last_stamp_s_.reset();
}

double StampFilter::stamp(double x, double step, double arrival_s) {
  if (last_x_ && x <= *last_x_) restartClock();
  addToWindow(x, arrival_s);
  updateSlope(x, arrival_s);
  const double slope = slope_.value_or(0.0);
  double stamp_s = slope * x + older_.offset(slope);
  watchForStep(arrival_s - stamp_s, 0.5 * slope * step, arrival_s);
  if (last_stamp_s_) stamp_s = std::max(stamp_s, *last_stamp_s_ + kMinStep * slope * (x - *last_x_));
  last_x_ = x;
  last_stamp_s_ = stamp_s;
  return stamp_s;
}

void StampFilter::updateSlope(double x, double arrival_s) {
  const double span_s = slope_ ? older_.span() * *slope_ : 0.0;
  const double needed_s = std::max(params_.settle_s, std::min(slope_span_s_, 0.5 * params_.window_s));
  if (older_.size() >= 2 && span_s >= needed_s) {
    slope_ = older_.middleSlope();
    slope_span_s_ = span_s;
  } else if (slope_span_s_ == 0.0 && x > first_x_) {
    slope_ = (arrival_s - first_arrival_s_) / (x - first_x_);
  }
}

void StampFilter::addToWindow(double x, double arrival_s) {
  if (older_.empty()) {
    window_start_s_ = younger_start_s_ = arrival_s;
    if (slope_span_s_ == 0.0) {
      first_x_ = x;
      first_arrival_s_ = arrival_s;
    }
  }
  if (arrival_s - window_start_s_ > params_.window_s) {
    older_ = younger_;
    window_start_s_ = younger_start_s_;
  }
  if (arrival_s - younger_start_s_ > 0.5 * params_.window_s) {
    younger_.clear();
    younger_start_s_ = arrival_s;
  }
  older_.add(x, arrival_s);
  younger_.add(x, arrival_s);
}

/// Measures how long arrivals have been late, starting again after each silence: frames that queued while
/// this program was stopped come late, all at once, and say nothing about lost frames.
void StampFilter::watchForStep(double late_s, double threshold_s, double arrival_s) {
  if (late_s <= threshold_s) {
    late_since_s_.reset();
  } else if (!late_since_s_ || arrival_s - last_arrival_s_ > kSilence_s) {
    late_since_s_ = arrival_s;
  } else if (arrival_s - *late_since_s_ > kStepWatch_s) {
    beginWindow();
  }
  last_arrival_s_ = arrival_s;
}

}  // namespace stereo_nav::serial
