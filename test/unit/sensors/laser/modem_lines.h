#pragma once

namespace stereo_nav::laser {

/// What this process has last done with the line DTR of any port, 1 on, 0 off, -1 nothing: pseudo-terminals
/// have no such line, so that the call itself is watched.
int lastDtr();
void forgetDtr();

}  // namespace stereo_nav::laser
