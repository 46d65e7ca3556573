// Which scanners have already met a point in their running epoch: no point takes two returns of one scanner's one epoch (zolynski-2012, 2.7), however
// many others have met it in between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace berm::app {

// One bit a scanner and point. When a scanner's epoch ends no point is visited: a bit counts only as long as the scan that met the point last is not
// before the epoch's first, and the next meeting drops those that no longer count.
class ScanContributors {
public:
  void add_scanner();
  // scan: the first of the scanner's new epoch, numbered over all scanners as GatheredPoint has it.
  void begin_epoch(std::size_t scanner, std::uint32_t scan) { begun_[scanner] = scan; }

  // index: a point's place in the store; last_scan: the latest that met it.
  bool has(std::uint32_t index, std::size_t scanner, std::uint32_t last_scan) const {
    return last_scan >= begun_[scanner] && (bits_[index * stride_ + scanner / 8] >> (scanner % 8) & 1) != 0;
  }
  void began(std::uint32_t index, std::size_t scanner);                            // a new point, of this scanner alone
  void joined(std::uint32_t index, std::size_t scanner, std::uint32_t last_scan);  // last_scan: the latest before this one

  void clear();
  std::size_t bytes() const { return bits_.capacity() + begun_.capacity() * sizeof(begun_[0]); }

private:
  std::size_t stride_ = 1;  // bytes a point
  std::vector<std::uint8_t> bits_;
  std::vector<std::uint32_t> begun_;  // by scanner: the first scan of its running epoch
};

}  // namespace berm::app
