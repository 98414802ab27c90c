#include "eval/losses.h"

#include <cstdio>

namespace stereo_nav::eval {

std::vector<Loss> lossesOf(const std::vector<FrameErrors>& frames) {
  std::vector<Loss> losses;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].lost) continue;
    const bool continues = i > 0 && frames[i - 1].lost;
    if (!continues) losses.push_back({i, i, frames[i].time_s, frames[i].time_s, frames[i].reason});
    losses.back().last = i;
    losses.back().to_s = frames[i].time_s;
  }
  return losses;
}

std::string toText(const Loss& loss) {
  char when[128];
  if (loss.first == loss.last) {
    std::snprintf(when, sizeof when, "frame %zu (%.2f s)", loss.first, loss.from_s);
  } else {
    std::snprintf(when, sizeof when, "frames %zu to %zu (%.2f to %.2f s)", loss.first, loss.last, loss.from_s,
                  loss.to_s);
  }
  return std::string(when) + ": " + (loss.reason.empty() ? "no reason given" : loss.reason);
}

}  // namespace stereo_nav::eval
