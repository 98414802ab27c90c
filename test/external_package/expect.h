#pragma once

#include <cstdlib>
#include <iostream>

/// Ends the program with exit status 1 where what it expects is not so.
inline void expect(bool so, const char* what) {
  if (so) return;
  std::cerr << "not so: " << what << "\n";
  std::exit(1);
}
