#include "run/load_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "config/json_text.hpp"
#include "config/whole_file.hpp"
#include "run/child_process.hpp"
#include "run/contract_text.hpp"
#include "run/event_words.hpp"
#include "run/file_pair.hpp"
#include "run/interruption.hpp"
#include "run/kernel_session.hpp"
#include "run/memory_watch.hpp"
#include "run/out_folder.hpp"
#include "run/parameter_file.hpp"
#include "run/recognised_truck.hpp"
#include "run/recorder.hpp"
#include "run/scenario_names.hpp"
#include "run/site_picture.hpp"

namespace berm::run {

namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

constexpr int kTickDescriptor = 11;    // numbers in the children
constexpr int kKernelDescriptor = 12;
constexpr int kJournalDescriptor = 13;
constexpr int kPaceDescriptor = 14;
constexpr double kConnectPatience_s = 20.0;
constexpr double kEndPatience_s = 10.0;

class LoadRun {
 public:
  explicit LoadRun(const RunOptions& options) : options_(options), uids_(choose_uids()), can_(free_can_address()), scan_port_(free_udp_port()) {
    result_.options = options;
  }

  RunResult run() {
    expect_reachable(folder_, uids_);
    const std::string scenario = find_scenario(options_.scenario);
    const auto names = scenario_names(scenario);
    machine_ = find_machine(names.machine);
    site_ = find_site(names.site);
    if (!options_.soil.empty()) soil_ = find_soil(options_.soil);
    keep_apart(scenario);
    check_scenario(scenario);
    check_scripts();
    prepare_out();
    try {
      begin_ = Clock::now();
      start_processes(scenario);
      follow();
      finish();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(error.what() + what_is_left());
    }
    return std::move(result_);
  }

 private:
  // No result goes over a file that the run reads, or over another.
  void keep_apart(const std::string& scenario) const {
    auto read = files_of_scenario(scenario), written = run_files(options_.out);
    read.push_back({"--soil", soil_});
    std::erase_if(written, [](const auto& file) { return file.name.ends_with("result.json"); });  // --json has the same in it
    written.push_back({"--json", options_.json});
    config::expect_apart(written, read);
  }

  // What is wrong with a scenario the plant says, in one line: before anything starts or is written.
  void check_scenario(const std::string& scenario) {
    ChildProcess plant;
    ChildOptions check;
    check.program = program_folder() + "/berm_plant";
    check.arguments = {"--scenario", scenario, "--can", can_, "--scan-port", std::to_string(scan_port_), "--out", folder_.file("out"), "--check"};
    append_soil(check);
    plant.start(check);
    if (!plant.wait_ended(kConnectPatience_s)) throw std::runtime_error("the plant does not end its check of the scenario");
    expect_content(plant);
  }

  // The same of the app's scripts.
  void check_scripts() {
    if (options_.scripts.empty()) return;
    ChildProcess checker;
    ChildOptions check;
    check.program = program_folder() + "/berm_scripts";
    check.arguments = {"--quiet", options_.scripts};
    checker.start(check);
    if (!checker.wait_ended(kConnectPatience_s)) throw std::runtime_error("berm_scripts does not end");
    expect_content(checker);
  }

  void append_soil(ChildOptions& plant) const {
    if (!soil_.empty()) plant.arguments.insert(plant.arguments.end(), {"--soil", soil_});
  }

  void prepare_out() {
    if (options_.out.empty()) {
      out_ = folder_.file("out");
    } else {
      out_ = options_.out;
    }
    if (!options_.out_held) result_.options.out_held = std::make_shared<const OutFolder>(out_);  // until whoever reads its files is done with the result
    if (options_.out.empty()) return;
    if (const std::string former = remove_former_run(out_); !former.empty()) fmt::print("{}: removed, of an earlier run: {}\n", out_, former);
    events_file_.open(events_path() + ".part");
    if (!events_file_) throw std::runtime_error(events_path() + ".part: cannot write");
  }

  // Of a run that failed: what the journal and the app's events have until then is kept, for it can be replayed and read.
  std::string what_is_left() const {
    if (options_.out.empty()) return "";
    std::string names;
    for (const auto& part : {journal_file() + ".part", events_path() + ".part"})
      if (std::error_code none; std::filesystem::exists(part, none)) names += (names.empty() ? "" : ", ") + std::filesystem::path(part).filename().string();
    return names.empty() ? "" : fmt::format("; not complete, in {}: {}", out_, names);
  }

  [[nodiscard]] std::string events_path() const { return out_ + "/app.jsonl"; }

  void start_processes(const std::string& scenario) {
    const std::string parameters = folder_.file("kernel.params");
    compile_parameter_file(machine_, site_, parameters);
    const std::string mode = options_.realtime ? "--realtime" : "--lockstep";
    auto lifeline = FilePair::pipe();   // the kernel alone holds the write end: its death is a hang-up
    auto ticks = FilePair::packets();   // app to plant, simulation only
    auto pace = FilePair::packets();    // journal's writer to plant, simulation only
    const std::string port = std::to_string(scan_port_);

    std::vector<std::string> kernel_options{"--can", can_, "--scan-port", port}, lidar_options;
    for (std::size_t i = 0; i < lidar_count(machine_); ++i) lidar_options.insert(lidar_options.end(), {"--lidar-port", std::to_string(free_udp_port())});
    kernel_options.insert(kernel_options.end(), lidar_options.begin(), lidar_options.end());
    if (!options_.realtime) kernel_options.push_back("--lockstep");
    if (options_.journal) kernel_options.insert(kernel_options.end(), {"--journal-uid", std::to_string(uids_.journal)});
    start_kernel(kernel_, folder_, uids_, parameters, kernel_options, {{lifeline.second(), kKernelDescriptor}});

    if (options_.journal) start_journal(pace.second());

    // The app runs as a stranger to this folder: it reads copies.
    copy_for_children(machine_, folder_.file("machine.toml"));
    copy_for_children(site_, folder_.file("site.toml"));
    copy_for_children(truck_classes_file(), folder_.file("truck_classes.toml"));
    std::filesystem::create_directory(folder_.file("scripts"));
    for (const char* name : {"pass.script", "approach.script"})
      std::filesystem::copy_file((options_.scripts.empty() ? scripts_folder() : options_.scripts) + "/" + name, folder_.file("scripts") + "/" + name);
    open_to_children(folder_.file("scripts"));
    ChildOptions app;
    app.program = program_folder() + "/berm_app";
    app.arguments = {"--machine", folder_.file("machine.toml"), "--site", folder_.file("site.toml"), "--truck-classes", folder_.file("truck_classes.toml"),
                     "--scripts", folder_.file("scripts"),
                     "--socket", folder_.file("kernel.sock"), "--trucks", std::to_string(options_.trucks), "--tick-fd", std::to_string(kTickDescriptor)};
    if (!options_.realtime) app.arguments.push_back("--lockstep");
    app.descriptors = {{ticks.second(), kTickDescriptor}};
    if (uids_.separate) app.uid = uids_.app;
    app.no_network = uids_.separate;  // the bus and the scanners are the kernel's
    app_.start(app);
    wait_for_app();
    recorder_.connect(folder_.file("kernel.sock"));
    if (options_.realtime) recorder_.count_from_first_decision();

    ChildOptions plant;
    plant.program = program_folder() + "/berm_plant";
    plant.arguments = {"--scenario", scenario, "--seed", std::to_string(options_.seed), "--trucks", std::to_string(options_.trucks), "--can", can_,
                       "--scan-port", port, "--out", out_, mode, "--tick-fd", std::to_string(kTickDescriptor), "--kernel-fd", std::to_string(kKernelDescriptor)};
    append_soil(plant);
    plant.arguments.insert(plant.arguments.end(), lidar_options.begin(), lidar_options.end());
    plant.descriptors = {{ticks.first(), kTickDescriptor}, {lifeline.first(), kKernelDescriptor}};
    plant.arguments.insert(plant.arguments.end(), {"--silence", std::to_string(options_.silence_s)});
    if (options_.trace_every > 1) plant.arguments.insert(plant.arguments.end(), {"--trace-every", std::to_string(options_.trace_every)});
    if (!options_.realtime && options_.journal) {
      plant.arguments.insert(plant.arguments.end(), {"--journal-fd", std::to_string(kPaceDescriptor)});
      plant.descriptors.push_back({pace.first(), kPaceDescriptor});
    }
    plant_.start(plant);
    result_.pids[0] = plant_.pid();
    result_.pids[1] = kernel_.pid();
    result_.pids[2] = app_.pid();
    result_.pids[3] = options_.journal ? journal_.pid() : 0;
    memory_.watch(kernel_.pid(), app_.pid());
    say(fmt::format("plant {}, kernel {}, app {} on {}", plant_.pid(), kernel_.pid(), app_.pid(), can_));
    if (!uids_.separate) result_.notes.emplace_back("kernel and app share your uid; run as root to give each its own");
  }

  std::string journal_file() const { return out_ + "/journal.mcap"; }

  // The writer runs under a uid that can write nothing here: it is given the open file, and renaming it is ours.
  void start_journal(int pace) {
    const std::string part = journal_file() + ".part";
    const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) throw std::system_error(errno, std::generic_category(), part);
    ChildOptions journal;
    journal.program = program_folder() + "/berm_journal";
    journal.arguments = {"--socket", folder_.file("kernel.sock"), "--file-fd", std::to_string(kJournalDescriptor)};
    journal.descriptors = {{file, kJournalDescriptor}};
    if (!options_.realtime) {
      journal.arguments.insert(journal.arguments.end(), {"--pace-fd", std::to_string(kPaceDescriptor)});
      journal.descriptors.push_back({pace, kPaceDescriptor});
    }
    if (uids_.separate) journal.uid = uids_.journal;
    journal_.start(journal);
    close(file);
    const auto until = Clock::now() + std::chrono::duration<double>(kConnectPatience_s);
    while (journal_.take_lines().empty()) {
      if (journal_.ended()) throw std::runtime_error("the journal's writer did not start: " + journal_.describe_end());
      if (Clock::now() > until) throw std::runtime_error("the journal's writer did not connect to the kernel");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  // After the kernel's end: the writer empties the ring and closes the file.
  void finish_journal() {
    if (!options_.journal) return;
    if (!journal_.wait_ended(kEndPatience_s)) {
      journal_.signal(SIGKILL);
      journal_.wait_ended(kEndPatience_s);
    }
    const auto report = json::parse(last_json_line(journal_.take_lines()), nullptr, false);
    if (journal_.exit_status() == 0 && report.is_object() && report.contains("lost")) {
      std::filesystem::rename(journal_file() + ".part", journal_file());
      result_.journal_lost = report.value("lost", std::uint64_t{0});
      return;
    }
    journal_cut_off_ = true;
    result_.notes.push_back(fmt::format("the journal's writer ended early ({}): journal.mcap.part holds what it had written", journal_.describe_end()));
  }

  void wait_for_app() {
    const auto until = Clock::now() + std::chrono::duration<double>(kConnectPatience_s);
    for (;;) {
      take_app_lines();
      for (const auto& event : result_.app_events)
        if (event.value("event", "") == "connected") return;
      if (app_.ended()) throw std::runtime_error("the app did not start: " + app_.describe_end());
      if (kernel_.ended()) throw std::runtime_error("the kernel ended: " + kernel_.describe_end());
      if (Clock::now() > until) throw std::runtime_error("the app did not connect to the kernel");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void follow() {
    while (!plant_.ended()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      recorder_.poll(0.0);
      take_app_lines();
      take_plant_lines();
      tell_of_init();
      memory_.sample(recorder_.time_s());
      tell_progress();
      inject();
      heed_interruption();
    }
    if (result_.interrupted.empty()) heed_interruption();  // a terminal's signal goes to the plant as well, which may have ended first
    recorder_.poll(0.0);
    take_app_lines();
    take_plant_lines();
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
    say(fmt::format("{:7.1f} s  the kernel still waits to hear every sensor, the machine and the panel", recorder_.time_s()));
  }

  void tell_progress() {
    if (options_.progress_every_s <= 0.0 || recorder_.time_s() < next_progress_s_) return;
    next_progress_s_ = recorder_.time_s() + options_.progress_every_s;
    const double wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    fmt::print("{:5.2f} h  {} trucks away, {} passes, {} bench moves, {} stops; {:.1f} times real time\n", recorder_.time_s() / 3600, trucks_away_, passes_, bench_moves_,
               recorder_.stop_events().size(), wall_s > 0 ? recorder_.time_s() / wall_s : 0.0);
    std::fflush(stdout);
  }

  void inject() {
    if (!options_.fault || injected_ || recorder_.time_s() < options_.fault->at_s) return;
    injected_ = true;
    switch (options_.fault->kind) {
      case FaultKind::kill_app: app_.signal(SIGKILL); break;
      case FaultKind::stop_app: app_.signal(SIGSTOP); break;
      case FaultKind::kill_kernel: kernel_.signal(SIGKILL); break;
      case FaultKind::kill_journal: journal_.signal(SIGKILL); break;
    }
    say(fmt::format("{:7.1f} s  fault injected", recorder_.time_s()));
  }

  // The plant ends its run as if its time were up, and all the rest follows from that; whoever asks twice wants no report.
  void heed_interruption() {
    const int number = interruption_.take();
    if (number == 0) return;
    if (!options_.report_when_interrupted || !result_.interrupted.empty()) throw std::runtime_error(fmt::format("interrupted ({}): there is no report", strsignal(number)));
    result_.interrupted = strsignal(number);
    plant_.signal(SIGTERM);
    say(fmt::format("{:7.1f} s  interrupted ({}): the report follows; once more ends without it", recorder_.time_s(), result_.interrupted));
  }

  void take_app_lines() {
    for (const auto& line : app_.take_lines()) {
      auto event = json::parse(line, nullptr, false);
      if (!event.is_object()) continue;
      if (event.value("event", "") == "pass") ++passes_;
      say(app_event_words(event, recorder_.time_s()));
      if (events_file_.is_open() && events_file_ && !(events_file_ << event.dump() << std::endl)) events_error_ = strerror(errno);  // told of at the end
      result_.app_events.push_back(std::move(event));
    }
  }

  void take_plant_lines() {
    for (const auto& line : plant_.take_lines()) {
      const auto event = json::parse(line, nullptr, false);
      if (!event.is_object()) continue;
      const std::string name = event.value("event", "");
      if (name == "bench_move") ++bench_moves_;
      if (name == "truck_left") ++trucks_away_;
      say(plant_event_words(event));
    }
  }

  void finish() {
    kernel_.signal(SIGTERM);
    app_.signal(SIGCONT);
    app_.signal(SIGTERM);
    const bool kernel_ended = kernel_.wait_ended(kEndPatience_s);
    if (!app_.wait_ended(kEndPatience_s)) app_.signal(SIGKILL);
    take_app_lines();  // its count at its exit
    recorder_.poll(0.0);
    finish_journal();
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
    result_.measures = measure_shift(out_, machine_, options_, result_.truth, result_.app_events, result_.stop_events);
    if (recorder_.lost() > 0) result_.notes.push_back(fmt::format("the launcher missed {} decisions: stops and the picture may lack some", recorder_.lost()));
    result_.fault_struck = injected_;
    if (!options_.out.empty()) write_out();
  }

  void write_out() {
    if (options_.picture) write_picture();
    config::write_whole_file(out_ + "/result.json", config::json_text(flat_json(result_), 2));
    events_file_.close();
    if (!events_file_) throw std::runtime_error(fmt::format("{}.part: not all could be written: {}", events_path(), events_error_));
    std::filesystem::rename(events_path() + ".part", events_path());
    result_.notes.push_back(fmt::format("trace.csv, truth.json,{} app.jsonl,{} and result.json are in {}", options_.journal ? " journal.mcap," : "", options_.picture ? " site.svg" : "", out_));
  }

  void write_picture() {
    SitePictureInput picture;
    picture.title = fmt::format("{}, seed {}, at the end of the run (simulation)", options_.scenario, options_.seed);
    picture.map = recorder_.map();
    picture.swept = recorder_.fastest_swing();
    picture.path = recorder_.path();
    picture.stops = recorder_.stop_events();
    describe_site(machine_, site_, picture);
    picture.truck_bed = recognised_bed(result_.app_events);
    picture.movers = mover_paths(out_ + "/trace.csv");
    write_site_picture(out_ + "/site.svg", picture);
  }

  void say(const std::string& words) const {
    if (options_.quiet || words.empty()) return;
    fmt::print("{}\n", words);
    std::fflush(stdout);
  }

  const Interruption interruption_;  // before the children
  RunOptions options_;
  Uids uids_;
  std::string can_;
  std::uint16_t scan_port_;
  RunFolder folder_;
  std::string out_, machine_, site_, soil_;
  Clock::time_point begin_;
  ChildProcess kernel_, app_, plant_, journal_;
  Recorder recorder_;
  RunResult result_;
  MemoryWatch memory_;
  std::ofstream events_file_;  // the app's events as they come, so that a run that is cut off leaves them
  std::string events_error_;
  int trucks_away_ = 0, passes_ = 0, bench_moves_ = 0;
  double next_progress_s_ = 0.0;
  bool injected_ = false, init_told_ = false;
  double init_since_s_ = -1.0;
  bool journal_cut_off_ = false;
};

}  // namespace

RunResult load_trucks(const RunOptions& options) { return LoadRun(options).run(); }

}  // namespace berm::run
