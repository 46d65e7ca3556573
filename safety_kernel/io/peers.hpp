// Who may see and ask: one app and up to four recorders over a Unix socket. Checked by uid, given the sealed segments, watched for hang-up.
// Nothing here blocks the cycle.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "io/shared_memory.hpp"

namespace berm::kernel {

struct PeerPolicy {
  uid_t app_uid;
  uid_t recorder_uid;
  bool refuse_app;  // --map-only
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
  // Once a cycle: accepts newcomers, greets them, drops who has gone.
  void poll();

  bool app_connected() const { return app_ >= 0; }
  std::uint32_t app_connections() const { return app_connections_; }  // since start: a change means another app

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

  std::string path_;
  PeerPolicy policy_{};
  const SharedSegment* state_ = nullptr;
  const SharedSegment* request_ = nullptr;
  int listener_ = -1;
  int app_ = -1;
  int recorder_[kRecorders] = {-1, -1, -1, -1};
  Pending pending_[kPending];
  std::uint32_t app_connections_ = 0;
};

}  // namespace berm::kernel
