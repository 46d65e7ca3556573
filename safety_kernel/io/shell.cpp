#include "io/shell.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace berm::kernel {

namespace {
constexpr int kFifoPriority = 50;
}

void ask_for_realtime() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) std::fprintf(stderr, "berm_kernel: warning: memory may be paged out: mlockall: %s\n", std::strerror(errno));
  sched_param priority{};
  priority.sched_priority = kFifoPriority;
  if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    std::fprintf(stderr, "berm_kernel: warning: no real-time priority: SCHED_FIFO: %s\n", std::strerror(errno));
}

Shell::Shell(const Options& options, const berm_parameters& parameters)
    : options_(options),
      parameters_(parameters),
      receiver_(options),
      cycle_(std::make_unique<Cycle>(parameters, options.map_only)),
      in_(std::make_unique<CycleInputs>()),
      out_(std::make_unique<CycleOutputs>()),
      cpu_(std::make_unique<CpuHistogram>()) {}

bool Shell::open(std::string& error) {
  if (!state_.create("berm_state", sizeof(berm_state_segment), SegmentAccess::kKernelWrites, error)) return false;
  if (!request_.create("berm_request", sizeof(berm_request_segment), SegmentAccess::kPeerWrites, error)) return false;
  publisher_ = std::make_unique<Publisher>(*static_cast<berm_state_segment*>(state_.memory()), parameters_, !options_.map_only);
  const PeerPolicy policy{options_.app_uid, options_.recorder_uid, options_.map_only, options_.journal_uid};
  if (options_.journal_uid) {
    if (!journal_.create(parameters_, options_.map_only, options_.vlp16_mount, error)) return false;
    peers_.serve_journal(journal_.ring(), journal_.tail());
  }
  if (!options_.map_only && options_.lidar_ports != parameters_.lidars) {
    error = "--lidar-port: given " + std::to_string(options_.lidar_ports) + " times, the parameter block has " + std::to_string(parameters_.lidars) +
            " lidars";
    return false;
  }
  if (!receiver_.open(error) || !peers_.open(options_.socket, policy, state_, request_, error)) return false;
  if (!options_.lockstep && !options_.map_only) ask_for_realtime();
  if (!options_.map_only && parameters_.tail_watched == 0)
    std::fprintf(stderr, "berm_kernel: note: nobody watches the ground round the tail (tail.watched = false): fence it to %d mm from the swing axis\n",
                 parameters_.own_body_radius_mm + parameters_.tail_clearance_mm);
  if (!options_.map_only && parameters_.workspace_watched == 0)
    std::fputs("berm_kernel: note: nobody watches the workspace (workspace.watched = false): nobody may come into it\n", stderr);
  say_ready();
  return true;
}

void Shell::say_ready() const {
  if (options_.ready_fd < 0) return;
  const char byte = 'R';
  if (write(options_.ready_fd, &byte, 1) != 1) std::fprintf(stderr, "berm_kernel: warning: --ready-fd %d: %s\n", options_.ready_fd, std::strerror(errno));
  close(options_.ready_fd);
}

bool Shell::next_cycle(CycleTimer& timer, const volatile int& stop) {
  in_->clear();
  if (options_.lockstep) return receiver_.gather_lockstep(*in_, stop, peers_);
  in_->now_us = timer.wait();
  in_->cycle = cycles_;
  if (stop != 0) return false;
  receiver_.gather(*in_);
  return true;
}

void Shell::take_request() {
  in_->app_connected = peers_.app_connected();
  in_->app_connections = peers_.app_connections();
  // Copied once, word by word; the app may write meanwhile, and the CRC of the copy decides.
  const auto* from = reinterpret_cast<const std::uint32_t*>(&static_cast<const berm_request_segment*>(request_.view())->request);
  for (std::size_t i = 0; i < SK_REQUEST_BYTES / sizeof(std::uint32_t); ++i) {
    const std::uint32_t word = __atomic_load_n(from + i, i == 0 ? __ATOMIC_ACQUIRE : __ATOMIC_RELAXED);
    std::memcpy(in_->request + i * sizeof word, &word, sizeof word);
  }
}

void Shell::one_cycle() {
  in_->clock_fault = watch_.check(in_->now_us);
  in_->journal_lost = journal_.lost_before();
  cycle_->step(*in_, *out_);
  if (options_.lockstep || watch_.may_send(monotonic_us())) receiver_.can().send(out_->frames.frame, out_->frames.count);
  publisher_->state(out_->state);
  publisher_->decision(out_->decision);
  publisher_->scans(out_->blocks);
  publisher_->slices(cycle_->slices());
  publisher_->map_rows(cycle_->map(), in_->now_us);
  publisher_->wake();
  journal_.offer(*in_, *out_, cycle_->map(), peers_.journal_connected() || !peers_.journal_was_connected());
}

void Shell::run(const volatile int& stop) {
  CycleTimer timer(monotonic_us(), parameters_.cycle_us);
  cpu_mark_us_ = thread_cpu_us();
  while (stop == 0 && next_cycle(timer, stop)) {
    peers_.poll();
    take_request();
    one_cycle();
    ++cycles_;
    const std::int64_t cpu_us = thread_cpu_us();
    cpu_->add(cpu_us - cpu_mark_us_);
    in_->cycle_cpu_us = static_cast<std::uint32_t>(cpu_us - cpu_mark_us_);
    cpu_mark_us_ = cpu_us;
  }
}

std::string Shell::report() const {
  const ReceiverCounters& c = receiver_.counters();
  std::string json = "{";
  const auto add = [&json](const char* name, std::uint64_t value) {
    if (json.size() > 1) json += ", ";
    json += std::string("\"") + name + "\": " + std::to_string(value);
  };
  add("cycles", cycles_);
  add("cycle_us_p50", static_cast<std::uint64_t>(cpu_->quantile_us(0.5)));
  add("cycle_us_p99", static_cast<std::uint64_t>(cpu_->quantile_us(0.99)));
  add("cycle_us_max", static_cast<std::uint64_t>(cpu_->max_us()));
  add("frames_rejected", cycle_->frames_rejected() + receiver_.frames_rejected());
  add("frames_unsent", receiver_.can().counters().send_failed);
  add("scan_packets", c.scan_packets);
  add("scan_rejected", c.scan_rejected + cycle_->scans_rejected());
  add("scan_missing", c.scan_missing);
  add("lost_cycles", watch_.lost_cycles());
  add("unsent_cycles", watch_.unsent_cycles());
  add("vlp16_packets", c.vlp16_packets);
  add("vlp16_rejected", c.vlp16_rejected);
  add("vlp16_points", c.vlp16_points);
  add("terrain_rounds", cycle_->registration().rounds());
  add("terrain_rounds_confirmed", cycle_->registration().rounds_confirmed());
  add("lidar_packets", c.lidar_packets);
  add("lidar_rejected", c.lidar_rejected + cycle_->lidars_rejected());
  add("tail_watched", parameters_.tail_watched != 0 ? 1 : 0);
  add("workspace_watched", parameters_.workspace_watched != 0 ? 1 : 0);
  add("journal_records", journal_.offered());
  add("journal_lost", journal_.lost());
  return json + "}";
}

}  // namespace berm::kernel
