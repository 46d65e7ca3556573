// Jobs that are processes: each may go on in copies of itself from what it has prepared.
#pragma once

#include <functional>
#include <string>

namespace berm::in_process {

using Say = std::function<void(const std::string& line)>;

// Does do_one(job, say) for every job below count, each in a process of its own, so many at a time (0: one for each core). What a job says is told
// here, a line at a time. A job that throws or dies ends the rest: std::runtime_error. Once stop says so, asked ten times a
// second, all that run are ended, and it returns. The caller must have no other threads.
void run_in_processes(int count, int at_a_time, const std::function<void(int job, const Say& say)>& do_one,
                      const std::function<void(int job, const std::string& line)>& told, const std::function<bool()>& stop = {});

// Does it in a copy of this process, which ends after it, and waits for that; what went wrong there is std::runtime_error here.
void in_a_copy(const std::function<void()>& work);

}  // namespace berm::in_process
