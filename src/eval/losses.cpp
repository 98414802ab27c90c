#include "eval/losses.h"

#include <fmt/format.h>

namespace stereo_nav::eval {

std::vector<Loss> lossesOf(const std::vector<FrameErrors>& frames) {
  std::vector<Loss> losses;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].lost) continue;
    const bool continues = i > 0 && frames[i - 1].lost;
    if (!continues)
      losses.push_back({i, i, frames[i].time_s, frames[i].time_s,
                        frames[i].reason.empty() ? "no reason given" : frames[i].reason});
    losses.back().last = i;
    losses.back().to_s = frames[i].time_s;
  }
  return losses;
}

std::string framesText(const Loss& loss) {
  if (loss.first == loss.last) return fmt::format("frame {} ({:.2f} s)", loss.first, loss.from_s);
  return fmt::format("frames {} to {} ({:.2f} to {:.2f} s)", loss.first, loss.last, loss.from_s, loss.to_s);
}

std::string toText(const Loss& loss) {
  return framesText(loss) + ": " + loss.reason;
}

}  // namespace stereo_nav::eval
