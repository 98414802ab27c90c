#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "sensors/laser/node_framer.h"

namespace stereo_nav::laser {

using Bytes = std::vector<std::uint8_t>;

/// Node number k of a scanner that turns by 0.99 degrees from node to node: 2000 samples a second, 5.5
/// revolutions. Distances vary as in a cluttered room, from node to node and by metres.
inline ScanNode nodeOf(std::uint64_t k) {
  constexpr double kStep_deg = 0.99;
  ScanNode node;
  const double turned = kStep_deg * static_cast<double>(k);
  node.heading_deg = turned - 360.0 * std::floor(turned / 360.0);
  node.heading_deg = std::floor(node.heading_deg * 64.0) / 64.0;
  node.start = k == 0 || std::floor(turned / 360.0) > std::floor((turned - kStep_deg) / 360.0);
  std::mt19937 random(static_cast<unsigned>(k / 12));
  node.distance_mm = 200.0 + static_cast<double>(random() % 8000) + 0.25 * static_cast<double>(k % 37);
  node.quality = static_cast<std::uint8_t>(random() % 64);
  return node;
}

inline Bytes bytesOf(std::uint64_t k) {
  Bytes bytes(rplidar::kNodeBytes);
  rplidar::encodeNode(nodeOf(k), bytes.data());
  return bytes;
}

template <class Item>
inline void append(std::vector<Item>& to, const std::vector<Item>& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// The bytes of the nodes from `first` up to before `last`.
inline Bytes bytesOf(std::uint64_t first, std::uint64_t last) {
  Bytes bytes;
  for (std::uint64_t k = first; k < last; ++k) append(bytes, bytesOf(k));
  return bytes;
}

inline bool same(const ScanNode& a, const ScanNode& b) {
  return a.start == b.start && a.quality == b.quality && a.heading_deg == b.heading_deg &&
         a.distance_mm == b.distance_mm;
}

inline std::vector<FramedNode> framed(NodeFramer& framer, const Bytes& bytes) {
  std::vector<FramedNode> nodes;
  for (const std::uint8_t byte : bytes) {
    framer.push(byte, [&](const FramedNode& node) { nodes.push_back(node); });
  }
  return nodes;
}

}  // namespace stereo_nav::laser
