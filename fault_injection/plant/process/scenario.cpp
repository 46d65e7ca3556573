#include "plant/process/scenario.hpp"

#include <filesystem>

#include "plant/machine/strict_table.hpp"
#include "plant/process/scenario_world.hpp"

namespace berm::plant {

namespace {

std::string machine_path(const std::string& scenario_file, const std::string& machine, const std::string& profiles) {
  namespace fs = std::filesystem;
  const bool name_only = machine.find('/') == std::string::npos && machine.find('.') == std::string::npos;
  if (name_only) return (fs::path(profiles) / (machine + ".toml")).string();
  return (fs::path(scenario_file).parent_path() / machine).string();
}

PanelEvent read_panel(StrictTable t) {
  PanelEvent event{};
  const std::string action = t.choice("action", {"stop", "reset", "relearn", "emergency", "pause"});
  event.action = action == "stop"      ? PanelAction::stop
                 : action == "reset"   ? PanelAction::reset
                 : action == "relearn" ? PanelAction::relearn
                 : action == "pause"   ? PanelAction::pause
                                       : PanelAction::emergency;
  event.at_s = t.number("at_s", 0.0, 36000.0);
  event.for_s = t.number("for_s", 0.05, 36000.0);
  t.finish();
  return event;
}

MachineFault read_machine_fault(StrictTable t) {
  MachineFault fault{};
  const std::string kind = t.choice("kind", {"weak_brake", "stuck_valve", "runaway", "stuck_angle", "own_error"});
  if (kind != "own_error") {
    const std::string joint = t.choice("joint", {"swing", "boom", "stick", "bucket"});
    fault.joint = joint == "swing" ? 0 : joint == "boom" ? 1 : joint == "stick" ? 2 : 3;
  }
  fault.at_s = t.number("at_s", 0.0, 36000.0);
  if (t.has("for_s")) fault.for_s = t.number("for_s", 0.05, 36000.0);
  if (kind == "weak_brake") {
    fault.kind = MachineFaultKind::weak_brake;
    fault.factor = t.number("factor", 0.05, 1.0);
  } else if (kind == "runaway") {
    fault.kind = MachineFaultKind::runaway;
    fault.factor = t.number("factor", -1.0, 1.0);
  } else {
    fault.kind = kind == "stuck_angle" ? MachineFaultKind::stuck_angle : kind == "own_error" ? MachineFaultKind::own_error : MachineFaultKind::stuck_valve;
  }
  t.finish();
  return fault;
}

JointState read_start(StrictTable t, double& ballast_kg) {
  JointState start;
  start.angle[0] = t.degrees("swing_deg", -180.0, 180.0);
  start.angle[1] = t.degrees("boom_deg", -180.0, 180.0);
  start.angle[2] = t.degrees("stick_deg", -180.0, 180.0);
  start.angle[3] = t.degrees("bucket_deg", -180.0, 180.0);
  ballast_kg = t.number_or("ballast_kg", 0.0, 50000.0, 0.0);
  t.finish();
  return start;
}

}  // namespace

Scenario load_scenario(const std::string& path, const std::string& profiles) {
  StrictTable file = StrictTable::parse_file(path);
  Scenario scenario;
  file.integer("schema", 1, 1);
  scenario.name = file.text("name");
  file.text("machine");  // what kernel and app are told; the launcher's
  file.text("site");
  scenario.machine_file = machine_path(path, file.text("plant"), profiles);
  StrictTable run = file.table("run");
  scenario.max_time_s = run.number("max_time_s", 1.0, 36000.0);
  scenario.run_from_s = run.number("operator_run_from_s", 0.0, 36000.0);
  run.finish();
  double ballast_kg = 0.0;
  scenario.start = read_start(file.table("start"), ballast_kg);
  for (StrictTable& t : file.tables("panel")) scenario.panel.push_back(read_panel(t));
  for (StrictTable& t : file.tables("machine_fault")) scenario.machine_fault.push_back(read_machine_fault(t));
  scenario.base_motions = read_base_motions(file);
  scenario.operator_config = read_operator(file);
  scenario.world = read_world(file);
  scenario.world.ballast_kg = ballast_kg;
  file.finish();
  return scenario;
}

PanelInput panel_at(const Scenario& scenario, double t) {
  constexpr double kRounding = 1e-6;  // times are multiples of the cycle in floating point
  PanelInput panel;
  panel.run = t + kRounding >= scenario.run_from_s;
  for (const PanelEvent& event : scenario.panel) {
    if (t + kRounding < event.at_s || t + kRounding >= event.at_s + event.for_s) continue;
    switch (event.action) {
      case PanelAction::stop: panel.stop = true; break;
      case PanelAction::reset: panel.reset = true; break;
      case PanelAction::relearn: panel.relearn = true; break;
      case PanelAction::emergency: panel.emergency = true; break;
      case PanelAction::pause: panel.run = false; break;
    }
  }
  return panel;
}

}  // namespace berm::plant
