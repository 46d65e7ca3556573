#include "run/load_run.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "config/json_text.hpp"
#include "config/whole_file.hpp"
#include "run/interruption.hpp"
#include "run/memory_watch.hpp"
#include "run/out_folder.hpp"
#include "run/patience.hpp"
#include "run/recognised_truck.hpp"
#include "run/recorder.hpp"
#include "run/run_events.hpp"
#include "run/run_inputs.hpp"
#include "run/run_processes.hpp"
#include "run/scenario_names.hpp"
#include "run/site_picture.hpp"

namespace berm::run {

namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

class LoadRun {
 public:
  explicit LoadRun(const RunOptions& options) : options_(options), uids_(choose_uids()), events_(options.quiet) { result_.options = options; }

  RunResult run() {
    expect_reachable(folder_, uids_);
    inputs_ = checked_inputs(options_, addresses_, folder_);
    prepare_out();
    try {
      begin_ = Clock::now();
      start();
      follow();
      finish();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(error.what() + what_is_left());
    }
    return std::move(result_);
  }

 private:
  void prepare_out() {
    out_ = options_.out.empty() ? folder_.file("out") : options_.out;
    if (!options_.out_held) result_.options.out_held = std::make_shared<const OutFolder>(out_);  // until whoever reads its files is done with the result
    if (options_.out.empty()) return;
    if (const std::string former = remove_former_run(out_); !former.empty()) fmt::print("{}: removed, of an earlier run: {}\n", out_, former);
    events_.write_to(events_path());
  }

  // Of a run that failed: what the journal and the app's events have until then is kept, for it can be replayed and read.
  std::string what_is_left() const {
    if (options_.out.empty()) return "";
    std::string names;
    for (const auto& part : {processes_.journal_file() + ".part", events_path() + ".part"})
      if (std::error_code none; std::filesystem::exists(part, none)) names += (names.empty() ? "" : ", ") + std::filesystem::path(part).filename().string();
    return names.empty() ? "" : fmt::format("; not complete, in {}: {}", out_, names);
  }

  [[nodiscard]] std::string events_path() const { return out_ + "/app.jsonl"; }

  void start() {
    processes_.start_kernel_and_app(uids_);
    wait_for_app();
    recorder_.connect(folder_.file("kernel.sock"));
    if (options_.realtime) recorder_.count_from_first_decision();
    processes_.start_plant();
    result_.pids[0] = plant_.pid();
    result_.pids[1] = kernel_.pid();
    result_.pids[2] = app_.pid();
    result_.pids[3] = options_.journal ? processes_.journal.pid() : 0;
    memory_.watch(kernel_.pid(), app_.pid());
    events_.say(fmt::format("plant {}, kernel {}, app {} on {}", plant_.pid(), kernel_.pid(), app_.pid(), addresses_.can()));
    if (!uids_.separate) result_.notes.emplace_back("kernel and app share your uid; run as root to give each its own");
  }

  void wait_for_app() {
    const auto until = Clock::now() + std::chrono::duration<double>(kConnectPatience_s);
    for (;;) {
      take_app_lines();
      if (events_.app_connected()) return;
      if (app_.ended()) throw std::runtime_error("the app did not start: " + app_.describe_end());
      if (kernel_.ended()) throw std::runtime_error("the kernel ended: " + kernel_.describe_end());
      if (Clock::now() > until) throw std::runtime_error("the app did not connect to the kernel");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void take_app_lines() { events_.take_app(app_, recorder_.time_s()); }

  void follow() {
    while (!plant_.ended()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      recorder_.poll(0.0);
      take_app_lines();
      events_.take_plant(plant_);
      tell_of_init();
      memory_.sample(recorder_.time_s());
      tell_progress();
      inject();
      heed_interruption();
    }
    if (result_.interrupted.empty()) heed_interruption();  // a terminal's signal goes to the plant as well, which may have ended first
    recorder_.poll(0.0);
    take_app_lines();
    events_.take_plant(plant_);
    result_.wall_seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  // A kernel that waits for a sensor says nothing by itself.
  void tell_of_init() {
    constexpr double kPatience_s = 5.0;
    if (recorder_.decisions() == 0) return;
    const bool waits = recorder_.last().kernel_state == BERM_STATE_INIT;
    if (waits && init_since_s_ < 0.0) init_since_s_ = recorder_.time_s();
    if (!waits || init_told_ || recorder_.time_s() - init_since_s_ < kPatience_s) return;
    init_told_ = true;
    events_.say(fmt::format("{:7.1f} s  the kernel still waits to hear every sensor, the machine and the panel", recorder_.time_s()));
  }

  void tell_progress() {
    if (options_.progress_every_s <= 0.0 || recorder_.time_s() < next_progress_s_) return;
    next_progress_s_ = recorder_.time_s() + options_.progress_every_s;
    const double wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    fmt::print("{:5.2f} h  {} trucks away, {} passes, {} bench moves, {} stops; {:.1f} times real time\n", recorder_.time_s() / 3600, events_.trucks_away(), events_.passes(),
               events_.bench_moves(), recorder_.stop_events().size(), wall_s > 0 ? recorder_.time_s() / wall_s : 0.0);
    std::fflush(stdout);
  }

  // Time is the kernel's: as long as that stands still in real time, none passes here.
  bool pause_is_over() const {
    const ProcessFault& fault = *options_.fault;
    if (fault.kind == FaultKind::pause_kernel && options_.realtime) return std::chrono::duration<double>(Clock::now() - injected_at_).count() >= fault.for_s;
    return (fault.kind == FaultKind::pause_app || fault.kind == FaultKind::pause_kernel) && recorder_.time_s() >= fault.at_s + fault.for_s;
  }

  void inject() {
    if (injected_ && !continued_ && pause_is_over()) {
      continued_ = true;
      const bool app = options_.fault->kind == FaultKind::pause_app;
      (app ? app_ : kernel_).signal(SIGCONT);
      events_.say(fmt::format("{:7.1f} s  the {} goes on", recorder_.time_s(), app ? "app" : "kernel"));
    }
    if (!options_.fault || injected_ || recorder_.time_s() < options_.fault->at_s) return;
    injected_ = true;
    injected_at_ = Clock::now();
    switch (options_.fault->kind) {
      case FaultKind::kill_app: app_.signal(SIGKILL); break;
      case FaultKind::stop_app:
      case FaultKind::pause_app: app_.signal(SIGSTOP); break;
      case FaultKind::kill_kernel: kernel_.signal(SIGKILL); break;
      case FaultKind::pause_kernel:
        if (options_.realtime) kernel_.signal(SIGSTOP);  // in lockstep the plant gives it no cycle
        break;
      case FaultKind::kill_journal: processes_.journal.signal(SIGKILL); break;
    }
    events_.say(fmt::format("{:7.1f} s  fault injected", recorder_.time_s()));
  }

  // The plant ends its run as if its time were up, and all the rest follows from that; whoever asks twice wants no report.
  void heed_interruption() {
    const int number = interruption_.take();
    if (number == 0) return;
    if (!options_.report_when_interrupted || !result_.interrupted.empty()) throw std::runtime_error(fmt::format("interrupted ({}): there is no report", strsignal(number)));
    result_.interrupted = strsignal(number);
    plant_.signal(SIGTERM);
    events_.say(fmt::format("{:7.1f} s  interrupted ({}): the report follows; once more ends without it", recorder_.time_s(), result_.interrupted));
  }

  void finish_journal() {
    if (!options_.journal) return;
    if (processes_.journal.finish(result_.journal_lost)) return;
    journal_cut_off_ = true;
    result_.notes.push_back(fmt::format("the journal's writer ended early ({}): journal.mcap.part holds what it had written", processes_.journal.describe_end()));
  }

  void finish() {
    kernel_.signal(SIGCONT);
    kernel_.signal(SIGTERM);
    app_.signal(SIGCONT);
    app_.signal(SIGTERM);
    const bool kernel_ended = kernel_.wait_ended(kEndPatience_s);
    if (!app_.wait_ended(kEndPatience_s)) app_.signal(SIGKILL);
    take_app_lines();  // its count at its exit
    recorder_.poll(0.0);
    finish_journal();
    result_.app_events = events_.of_app();
    if (plant_.exit_status() != 0) {
      if (!result_.interrupted.empty()) throw std::runtime_error(fmt::format("interrupted ({}) before the run had begun: there is no report", result_.interrupted));
      throw std::runtime_error("the plant failed: " + plant_.describe_end());
    }
    const bool kernel_killed = options_.fault && options_.fault->kind == FaultKind::kill_kernel;
    if (!kernel_ended) throw std::runtime_error("the kernel does not end");
    result_.kernel = json::parse(last_json_line(kernel_.take_lines()), nullptr, false);
    if (result_.kernel.is_discarded()) {
      if (!kernel_killed) throw std::runtime_error("the kernel ended without its report: " + kernel_.describe_end());
      result_.kernel = nullptr;
    }
    if (journal_cut_off_ && result_.kernel.is_object()) result_.journal_lost = result_.kernel.value("journal_lost", std::uint64_t{0});
    std::ifstream truth(out_ + "/truth.json");
    result_.truth = json::parse(truth, nullptr, false);
    if (!result_.truth.is_object()) throw std::runtime_error("the plant left no ground truth");
    result_.contacts = result_.truth.value("contacts", 0);
    result_.stops = recorder_.stops();
    result_.stop_events = recorder_.stop_events();
    result_.kernel_faults = recorder_.faults();
    result_.first_fault = recorder_.first_fault();
    result_.memory = memory_.growth();
    result_.measures = measure_shift(out_, inputs_.machine, options_, result_.truth, result_.app_events, result_.stop_events);
    if (recorder_.lost() > 0) result_.notes.push_back(fmt::format("the launcher missed {} decisions: stops and the picture may lack some", recorder_.lost()));
    result_.fault_struck = injected_;
    if (!options_.out.empty()) write_out();
  }

  void write_out() {
    if (options_.picture) write_picture();
    config::write_whole_file(out_ + "/result.json", config::json_text(flat_json(result_), 2));
    events_.close();
    result_.notes.push_back(fmt::format("trace.csv, truth.json,{} app.jsonl,{} and result.json are in {}", options_.journal ? " journal.mcap," : "", options_.picture ? " site.svg" : "", out_));
  }

  void write_picture() {
    SitePictureInput picture;
    picture.title = fmt::format("{}, seed {}, at the end of the run (simulation)", options_.scenario, options_.seed);
    picture.map = recorder_.map();
    picture.swept = recorder_.fastest_swing();
    picture.path = recorder_.path();
    picture.stops = recorder_.stop_events();
    describe_site(inputs_.machine, inputs_.site, picture);
    picture.truck_bed = recognised_bed(result_.app_events);
    picture.movers = mover_paths(out_ + "/trace.csv");
    write_site_picture(out_ + "/site.svg", picture);
  }

  const Interruption interruption_;  // before the children
  RunOptions options_;
  Uids uids_;
  RunAddresses addresses_;
  RunFolder folder_;
  RunInputs inputs_;
  std::string out_;
  Clock::time_point begin_, injected_at_;
  RunProcesses processes_{options_, inputs_, addresses_, folder_, out_};
  ChildProcess &kernel_ = processes_.kernel, &app_ = processes_.app, &plant_ = processes_.plant;
  Recorder recorder_;
  RunEvents events_;
  RunResult result_;
  MemoryWatch memory_;
  double next_progress_s_ = 0.0;
  bool injected_ = false, continued_ = false, init_told_ = false;
  double init_since_s_ = -1.0;
  bool journal_cut_off_ = false;
};

}  // namespace

RunResult load_trucks(const RunOptions& options) { return LoadRun(options).run(); }

}  // namespace berm::run
