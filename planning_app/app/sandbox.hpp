// What the app may do once it runs: compute, wait for the kernel's next cycle, write its log and its tick. Nothing else.
#pragma once

#include <stdexcept>
#include <vector>

namespace berm::app {

struct SandboxError : std::runtime_error { using std::runtime_error::runtime_error; };

// Closes every descriptor but these and 0 to 2.
void close_all_but(std::vector<int> keep);

// Installs the seccomp filter for good: sends only on tick_fd (-1: none), receives only on kernel_fd, writes only on 1 and 2; memory without
// PROT_EXEC. execve kills the process, everything else not listed fails with EPERM. Throws SandboxError.
void enter_sandbox(int kernel_fd, int tick_fd);

}  // namespace berm::app
