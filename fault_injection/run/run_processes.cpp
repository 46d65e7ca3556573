#include "run/run_processes.hpp"

#include <filesystem>

#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"

namespace berm::run {

namespace {

constexpr int kTickDescriptor = 11;  // numbers in the children
constexpr int kKernelDescriptor = 12;
constexpr int kPaceDescriptor = 14;
constexpr double kAlone_s = 2.0;  // at standstill, as the plant's own

}  // namespace

void RunProcesses::start_kernel_and_app(const Uids& uids) {
  const std::string parameters = folder_.file("kernel.params");
  compile_parameter_file(inputs_.machine, inputs_.site, parameters);
  lifeline_.emplace(FilePair::pipe());
  ticks_.emplace(FilePair::packets());
  pace_.emplace(FilePair::packets());

  std::vector<std::string> kernel_options{"--can", addresses_.can(), "--scan-port", addresses_.scan_port.text()};
  for (std::size_t i = 0; i < lidar_count(inputs_.machine); ++i) lidar_options_.insert(lidar_options_.end(), {"--lidar-port", lidar_ports_.emplace_back().text()});
  kernel_options.insert(kernel_options.end(), lidar_options_.begin(), lidar_options_.end());
  if (!options_.realtime) kernel_options.push_back("--lockstep");
  if (options_.journal) kernel_options.insert(kernel_options.end(), {"--journal-uid", std::to_string(uids.journal)});
  start_kernel(kernel, folder_, uids, parameters, kernel_options, {{lifeline_->second(), kKernelDescriptor}});

  if (options_.journal) journal.start(journal_file(), folder_, uids, options_.realtime ? -1 : pace_->second());
  start_app(uids);
}

// It runs as a stranger to this folder: it reads copies.
void RunProcesses::start_app(const Uids& uids) {
  copy_for_children(inputs_.machine, folder_.file("machine.toml"));
  copy_for_children(inputs_.site, folder_.file("site.toml"));
  copy_for_children(truck_classes_file(), folder_.file("truck_classes.toml"));
  std::filesystem::create_directory(folder_.file("scripts"));
  for (const char* name : {"pass.script", "approach.script"})
    std::filesystem::copy_file((options_.scripts.empty() ? scripts_folder() : options_.scripts) + "/" + name, folder_.file("scripts") + "/" + name);
  open_to_children(folder_.file("scripts"));
  ChildOptions child;
  child.program = program_folder() + "/berm_app";
  child.arguments = {"--machine", folder_.file("machine.toml"), "--site", folder_.file("site.toml"), "--truck-classes", folder_.file("truck_classes.toml"),
                     "--scripts", folder_.file("scripts"),
                     "--socket", folder_.file("kernel.sock"), "--trucks", std::to_string(options_.trucks), "--tick-fd", std::to_string(kTickDescriptor)};
  if (!options_.realtime) child.arguments.push_back("--lockstep");
  child.descriptors = {{ticks_->second(), kTickDescriptor}};
  if (uids.separate) child.uid = uids.app;
  child.no_network = uids.separate;  // the bus and the scanners are the kernel's
  app.start(child);
}

void RunProcesses::start_plant() {
  ChildOptions child;
  child.program = program_folder() + "/berm_plant";
  child.arguments = {"--scenario", inputs_.scenario, "--seed", std::to_string(options_.seed), "--trucks", std::to_string(options_.trucks), "--can", addresses_.can(),
                     "--scan-port", addresses_.scan_port.text(), "--out", out_, options_.realtime ? "--realtime" : "--lockstep",
                     "--tick-fd", std::to_string(kTickDescriptor), "--kernel-fd", std::to_string(kKernelDescriptor)};
  if (!inputs_.soil.empty()) child.arguments.insert(child.arguments.end(), {"--soil", inputs_.soil});
  child.arguments.insert(child.arguments.end(), lidar_options_.begin(), lidar_options_.end());
  child.descriptors = {{ticks_->first(), kTickDescriptor}, {lifeline_->first(), kKernelDescriptor}};
  child.arguments.insert(child.arguments.end(), {"--silence", std::to_string(options_.silence_s)});
  // An app that will go on is waited for.
  if (options_.fault && options_.fault->kind == FaultKind::pause_app) child.arguments.insert(child.arguments.end(), {"--alone", std::to_string(kAlone_s + options_.fault->for_s)});
  if (!options_.realtime && options_.fault && options_.fault->kind == FaultKind::pause_kernel)
    child.arguments.insert(child.arguments.end(), {"--pause-kernel", std::to_string(options_.fault->at_s), std::to_string(options_.fault->for_s)});
  if (options_.trace_every > 1) child.arguments.insert(child.arguments.end(), {"--trace-every", std::to_string(options_.trace_every)});
  if (!options_.realtime && options_.journal) {
    child.arguments.insert(child.arguments.end(), {"--journal-fd", std::to_string(kPaceDescriptor)});
    child.descriptors.push_back({pace_->first(), kPaceDescriptor});
  }
  plant.start(child);
  for (auto* pair : {&lifeline_, &ticks_, &pace_}) pair->reset();  // the children keep theirs: only so can the end of one be seen by another
}

}  // namespace berm::run
