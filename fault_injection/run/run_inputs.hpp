// The files that a run reads, found and looked at before anything starts or is written.
#pragma once

#include <string>

#include "run/kernel_session.hpp"
#include "run/reserved_port.hpp"
#include "run/run_options.hpp"

namespace berm::run {

struct RunInputs {
  std::string scenario, machine, site;
  std::string soil;  // empty: the scenario's own
};

// Where the run's processes hear one another, and no other run's.
struct RunAddresses {
  ReservedPort can_port, scan_port;
  std::string can() const { return can_port.can_address(); }
};

// Throws std::runtime_error with one line, or ToldAlready where plant or script checker has told what is wrong.
RunInputs checked_inputs(const RunOptions& options, const RunAddresses& addresses, const RunFolder& folder);

}  // namespace berm::run
