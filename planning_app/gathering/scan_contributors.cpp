#include "gathering/scan_contributors.hpp"

#include <algorithm>
#include <bit>

namespace berm::app {

void ScanContributors::add_scanner() {
  begun_.push_back(0);
  if (begun_.size() <= stride_ * 8) return;
  std::vector<std::uint8_t> wider(bits_.size() / stride_ * (stride_ + 1));
  for (std::size_t from = 0, to = 0; from < bits_.size(); from += stride_, to += stride_ + 1)
    std::copy_n(&bits_[from], stride_, &wider[to]);
  bits_ = std::move(wider);
  ++stride_;
}

void ScanContributors::began(std::uint32_t index, std::size_t scanner) {
  const std::size_t at = index * stride_;
  if (at >= bits_.size()) {
    if (at + stride_ > bits_.capacity()) bits_.reserve(at + at / 2 + 1024 * stride_);  // as the store grows
    bits_.resize(at + stride_);
  }
  std::fill_n(&bits_[at], stride_, std::uint8_t{0});
  bits_[at + scanner / 8] = static_cast<std::uint8_t>(1U << (scanner % 8));
}

void ScanContributors::joined(std::uint32_t index, std::size_t scanner, std::uint32_t last_scan) {
  std::uint8_t* bits = &bits_[index * stride_];
  for (std::size_t byte = 0; byte < stride_; ++byte)
    for (unsigned left = bits[byte]; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      if (begun_[byte * 8 + bit] > last_scan) bits[byte] = static_cast<std::uint8_t>(bits[byte] & ~(1U << bit));
    }
  bits[scanner / 8] = static_cast<std::uint8_t>(bits[scanner / 8] | 1U << (scanner % 8));
}

void ScanContributors::clear() { bits_.clear(); }

}  // namespace berm::app
