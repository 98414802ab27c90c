#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "sensors/laser/rplidar_protocol.h"

namespace stereo_nav::laser {

/// A node that NodeFramer has accepted.
struct FramedNode {
  ScanNode node;
  /// Number of nodes that the device has sent since the first one, lost ones included.
  std::uint64_t index = 0;
  std::uint64_t last_byte = 0;  ///< position in the stream of the node's last byte, from 0
  double turned_deg = 0.0;      ///< the node's heading, without the wrap at 360: grows with the revolutions
  double expected_turned_deg = 0.0;  ///< where the steady turning of the nodes before puts it
  bool restarted = false;            ///< it is unknown how many nodes were sent since the one before
};

/// Since the start of the stream.
struct NodeFramerCounters {
  std::uint64_t bytes = 0;
  std::uint64_t bytes_skipped = 0;  ///< outside of nodes
  std::uint64_t nodes = 0;          ///< delivered
  std::uint64_t bad_nodes = 0;      ///< where a node was due stood none
  std::uint64_t dropped = 0;        ///< nodes that were sent and not delivered, by the headings around them
};

/// Finds the nodes of a scan in a byte stream. There is no check sum, only two check bits, so that the steady
/// turning of the head decides what is a node:
///
/// 1. Five bytes behind a node are a node when their check bits are right and their heading is within 8
///    degrees of the expected one: a triangulating scanner's headings depend on the distance and jump by some
///    degrees at edges.
/// 2. Where that fails, three nodes in a row that continue the turning are needed to go on, at whatever byte:
///    after damage, alignment is found anew. Their headings tell how many nodes were lost.
/// 3. Without a known turning - at the start, or when 60 bytes brought no node - six nodes in a row are
/// needed
///    that turn steadily, with at most one start among them.
///
/// Damage to a distance or a quality is not recognisable: that node is wrong, no other one is. Works on a
/// fixed buffer: no allocation, no read beyond it, bounded work per byte.
class NodeFramer {
 public:
  using Sink = std::function<void(const FramedNode&)>;

  void push(std::uint8_t byte, const Sink& sink);
  /// Forgets a partly received node and the turning, e.g. when the scan was started again.
  void reset();
  const NodeFramerCounters& counters() const { return counters_; }

 private:
  static constexpr std::size_t kKnownRun = 3;    ///< nodes in a row that continue a known turning
  static constexpr std::size_t kUnknownRun = 6;  ///< nodes in a row that begin one
  static constexpr std::size_t kForget = 60;     ///< bytes
  using Run = std::array<ScanNode, kUnknownRun>;

  bool expected(const ScanNode& node, double nodes_ahead) const;
  bool continues();
  bool begins();
  bool decodeRun(std::size_t count);
  std::size_t lostBeforeRun() const;
  void deliverRun(std::size_t count, const Sink& sink);
  void deliver(const ScanNode& node, std::size_t missing, std::size_t bytes_behind, const Sink& sink);
  void dropByte();

  std::array<std::uint8_t, kUnknownRun * rplidar::kNodeBytes> buffer_{};
  std::size_t size_ = 0;
  Run run_{};
  bool aligned_ = false;  ///< the buffer begins directly behind a node
  bool turning_known_ = false;
  double turned_deg_ = 0.0;  ///< smoothed position of the last node
  double step_deg_ = 0.0;    ///< smoothed turn from node to node; 0: none was ever known
  std::size_t skipped_ = 0;  ///< bytes since the last node
  std::uint64_t index_ = 0;
  bool restarted_ = false;
  NodeFramerCounters counters_;
};

}  // namespace stereo_nav::laser
