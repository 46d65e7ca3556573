// A folder for one run and the kernel process in it: sockets, uids. Used by berm_load and berm_map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/child_process.hpp"

namespace berm::run {

// A private folder under TMPDIR, removed with all it holds; that of a run that was killed by the next run, for the lock on its file `alive` is free then.
class RunFolder {
 public:
  RunFolder();
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  void give_to(uid_t uid) const;  // so that the kernel can make its socket there

 private:
  std::string path_;
  int alive_ = -1;
};

// Run as root, kernel and app get uids of their own; otherwise all share the caller's.
struct Uids {
  bool separate;
  uid_t kernel, app, recorder, journal;
};
Uids choose_uids();

// The run's folder under the user's TMPDIR must be one that kernel and app can get to as well. Throws std::runtime_error naming TMPDIR.
void expect_reachable(const RunFolder& folder, const Uids& uids);

// What the children read or enter, whatever the umask, and whatever mode it was copied with. Throw std::system_error naming the path.
void open_to_children(const std::string& path);  // a file, or a folder with what is in it then
void copy_for_children(const std::string& source, const std::string& target);

// Folder of this program's siblings (berm_kernel, ...).
std::string program_folder();
// Removes ended lines of one JSON object a child printed last; empty when there is none.
std::string last_json_line(const std::vector<std::string>& lines);

// Starts the kernel in the folder with its socket at folder/kernel.sock and waits until it says that it is ready; throws
// std::runtime_error with its end otherwise. extra: options besides --parameters, --socket, --app-uid, --recorder-uid, --ready-fd.
void start_kernel(ChildProcess& kernel, const RunFolder& folder, const Uids& uids, const std::string& parameters, std::vector<std::string> extra,
                  std::vector<std::pair<int, int>> descriptors = {});

}  // namespace berm::run
