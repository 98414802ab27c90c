#pragma once

#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav {

/// Visits a list as numbered sections: the count `plural`, at most `most`, and for each item a section
/// `singular_1`, `singular_2`, ...; in a file `joints: 2`, `joint_1: {...}`, `joint_2: {...}`.
template <class Item>
void visitList(ParameterVisitor& visitor, const std::string& plural, const std::string& singular,
               std::vector<Item>& items, int most, const std::string& doc) {
  int count = static_cast<int>(items.size());
  visitor.integer(plural, count, {0, most}, "",
                  doc + "; " + singular + "_1 to " + singular + "_N describe them");
  if (count >= 0 && count <= most) items.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < items.size(); ++i)
    visitSection(visitor, singular + "_" + std::to_string(i + 1), items[i]);
}

}  // namespace stereo_nav
