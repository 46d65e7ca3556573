// The journal writer's connection to the kernel: asks for the role, maps ring and tail, notices when the kernel is gone.
#pragma once

#include <string>

#include "journal/journal_record.h"

namespace berm::record {

class KernelLink {
 public:
  KernelLink() = default;
  ~KernelLink();
  KernelLink(const KernelLink&) = delete;
  KernelLink& operator=(const KernelLink&) = delete;

  // False with one line in error.
  bool connect(const std::string& socket_path, std::string& error);
  const berm_journal_ring& ring() const { return *ring_; }
  berm_journal_tail& tail() { return *tail_; }
  // Waits at most this long; true when the kernel has hung up. The ring stays mapped.
  bool kernel_gone(int wait_ms) const;

 private:
  bool greet(const std::string& socket_path, int (&descriptors)[2], std::string& error);
  bool map(const int (&descriptors)[2], std::string& error);

  int socket_ = -1;
  const berm_journal_ring* ring_ = nullptr;
  berm_journal_tail* tail_ = nullptr;
};

}  // namespace berm::record
