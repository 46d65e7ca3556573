// Who may see and ask: one app, one writer of the journal and up to four recorders over a Unix socket. Checked by uid, given the sealed segments, watched for hang-up.
// Nothing here blocks the cycle.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "io/shared_memory.hpp"

namespace berm::kernel {

struct PeerPolicy {
  uid_t app_uid;
  uid_t recorder_uid;
  bool refuse_app;  // --map-only
  std::optional<uid_t> journal_uid = std::nullopt;  // none: nobody may write the journal
};

class PeerServer {
 public:
  static constexpr int kRecorders = 4;
  static constexpr int kPending = 4;               // connected, role not yet told
  static constexpr int kHandshakePolls = 200;      // then a silent newcomer is dropped

  PeerServer() = default;
  ~PeerServer();
  PeerServer(const PeerServer&) = delete;
  PeerServer& operator=(const PeerServer&) = delete;

  // Listens at path (a socket left over there is replaced). The segments must outlive this.
  bool open(const std::string& path, const PeerPolicy& policy, const SharedSegment& state, const SharedSegment& request, std::string& error);
  // What the journal's writer is given; before open.
  void serve_journal(const SharedSegment& ring, const SharedSegment& tail);
  // Once a cycle: accepts newcomers, greets them, drops who has gone.
  void poll();

  bool app_connected() const { return app_ >= 0; }
  std::uint32_t app_connections() const { return app_connections_; }  // since start: a change means another app
  bool journal_connected() const { return journal_ >= 0; }
  bool journal_was_connected() const { return journal_seen_; }

 private:
  struct Pending {
    int fd = -1;
    int polls = 0;
  };
  void accept_newcomers();
  void greet(Pending& pending);
  const char* refusal(std::uint8_t role, uid_t uid) const;
  void admit(int fd, std::uint8_t role, uid_t uid);
  int* free_recorder();
  int* place_for(std::uint8_t role);

  std::string path_;
  PeerPolicy policy_{};
  const SharedSegment* state_ = nullptr;
  const SharedSegment* request_ = nullptr;
  const SharedSegment* ring_ = nullptr;
  const SharedSegment* tail_ = nullptr;
  int listener_ = -1;
  int app_ = -1;
  int journal_ = -1;
  bool journal_seen_ = false;
  int recorder_[kRecorders] = {-1, -1, -1, -1};
  Pending pending_[kPending];
  std::uint32_t app_connections_ = 0;
};

}  // namespace berm::kernel
