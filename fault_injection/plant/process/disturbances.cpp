#include "plant/process/disturbances.hpp"

namespace berm::plant {

std::vector<Disturbance> disturbances(const Scenario& scenario) {
  std::vector<Disturbance> all;
  const auto span = [&all](const char* what, double at_s, double for_s) { all.push_back({what, at_s, at_s + for_s}); };
  for (const PanelEvent& event : scenario.panel)
    if (event.action != PanelAction::reset && event.action != PanelAction::relearn) span("panel", event.at_s, event.for_s);
  for (const MachineFault& fault : scenario.machine_fault)
    all.push_back({"machine", fault.at_s, fault.for_s ? std::optional(fault.at_s + *fault.for_s) : std::nullopt});
  for (const BaseMotionConfig& motion : scenario.base_motions) all.push_back({"base", motion.at_s, std::nullopt});
  for (const SensorFault& fault : scenario.world.lidar_faults) span("lidar", fault.at_s, fault.for_s);
  for (const SensorFault& fault : scenario.world.scanner_faults) span("scanner", fault.at_s, fault.for_s);
  for (const DustConfig& dust : scenario.world.dust) span("dust", dust.at_s, dust.for_s);
  for (const CloudConfig& cloud : scenario.world.clouds) span("cloud", cloud.at_s, cloud.for_s);
  return all;
}

}  // namespace berm::plant
