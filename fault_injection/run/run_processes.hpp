// The processes of a run, and what each is started with: the kernel, the journal's writer and the app, then the plant, which sets all going.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/child_process.hpp"
#include "run/file_pair.hpp"
#include "run/journal_writer.hpp"
#include "run/kernel_session.hpp"
#include "run/reserved_port.hpp"
#include "run/run_inputs.hpp"
#include "run/run_options.hpp"

namespace berm::run {

class RunProcesses {
 public:
  // All outlive it. out: the folder that plant and journal's writer write to.
  RunProcesses(const RunOptions& options, const RunInputs& inputs, const RunAddresses& addresses, const RunFolder& folder, const std::string& out)
      : options_(options), inputs_(inputs), addresses_(addresses), folder_(folder), out_(out) {}

  // Kernel and journal's writer are connected when it returns; the app says itself when it is. Throws std::runtime_error.
  void start_kernel_and_app(const Uids& uids);
  void start_plant();

  std::string journal_file() const { return out_ + "/journal.mcap"; }

  ChildProcess kernel, app, plant;
  JournalWriter journal;

 private:
  void start_app(const Uids& uids);

  const RunOptions& options_;
  const RunInputs& inputs_;
  const RunAddresses& addresses_;
  const RunFolder& folder_;
  const std::string& out_;
  std::vector<ReservedPort> lidar_ports_;
  std::vector<std::string> lidar_options_;
  std::optional<FilePair> lifeline_;  // the kernel alone holds the write end: its death is a hang-up
  std::optional<FilePair> ticks_;     // app to plant, simulation only
  std::optional<FilePair> pace_;      // journal's writer to plant, simulation only
};

}  // namespace berm::run
