#include "app/operator_advice.hpp"

#include <iterator>

#include "contract/berm_contract.h"

namespace berm::app {

namespace {

// What only a reset ends is reset with the run switch off (SK-CY-3).
#define RESET "switch run off, press reset, switch run on"

struct Advice {
  std::uint8_t reason;
  const char* text;
};

// Ground that was never seen and ground seen too long ago want the same of him, and each often becomes the other.
constexpr const char* let_it_be_seen = "lift the implements by hand and take away what hides the ground there from the scanners; if that does not help, press relearn with the implements lifted";

constexpr Advice advices[] = {
    {BERM_STOP_NONE, ""},
    {BERM_STOP_COLLISION_PREDICTED, "clear the place; if nothing stands there, press relearn; if that does not help, lift the implements by hand before it"},
    {BERM_STOP_UNKNOWN_GROUND, let_it_be_seen},
    {BERM_STOP_STALE_GROUND, let_it_be_seen},
    {BERM_STOP_DIG_FLOOR, "the bucket is too low: lift it by hand above the dig zone's floor; if it is not so low, end the app and check the floor in the site file"},
    {BERM_STOP_REQUEST_HOLD, "the app's requests come too late or are refused: look what keeps the app's computer busy; if it stays so, end the app and start it anew"},
    {BERM_STOP_APP_SILENT, "the kernel heard nothing usable of the app: look what kept the app's computer busy, then " RESET "; if it comes again, end the app and start it anew"},
    {BERM_STOP_STATE_FRAME, "the machine's frames fail: look at the bus and its plugs, the joint, inclination and azimuth sensors and the machine's controller, then " RESET},
    {BERM_STOP_SCANNER_SILENT, "a scanner or lidar sends nothing: look at the power and cable of each, and whether its head turns, then " RESET},
    {BERM_STOP_OPERATOR, "release the stop key, the spotter's too, and look whether the panel and the spotter's device are on; when the machine may go on, " RESET},
    {BERM_STOP_EMERGENCY, "look why the emergency stop was pressed; when nobody is in danger, release it, then " RESET},
    {BERM_STOP_JOINT_RANGE, "move the joint back into its range by hand"},
    {BERM_STOP_BRAKING, "the machine does not slow down as it must: have its valves, its oil and the load in the bucket checked before it goes on, then " RESET},
    {BERM_STOP_MACHINE_FAULT, "the machine reports an error of its own: read its display, look at its bus, its lock and emergency stop receivers and its switches, then " RESET},
    {BERM_STOP_INTERNAL, "the kernel found an error in itself: end kernel and app, keep the journal, start both anew; if it comes again, do not let the machine work"},
    {BERM_STOP_CLOCK, "the kernel's cycle came too late or its clock jumped: look what else runs on the kernel's computer and what sets its clock, then " RESET},
    {BERM_STOP_BASE_MOVED, "the machine tilted, turned or slipped: set it firmly, look whether truck and dig are still where the site file has them from where it stands, then " RESET},
    {BERM_STOP_UNCOMMANDED, "a joint moved otherwise than it was told: keep everybody away, look whether somebody is at the levers, have valves and joint sensors checked, then " RESET},
    {BERM_STOP_OVERPASS, "send away who or what stands there, or admit the truck, or swing the implements by hand away from over it; if nothing stands there, press relearn, with the implements lifted by hand if need be"},
    {BERM_STOP_TAIL, "send away who stands behind the machine, look all round it, beside the tracks too, then " RESET},
    {BERM_STOP_INTRUDER, "send away who or what came; if nobody is there, press relearn"},
    {BERM_STOP_SEPARATION, "make the sensors see all round the machine again, or take it out of where they cannot"},
    {BERM_STOP_SENSOR_BLOCKED, "look what lies on the sensors' windows, clean them, then " RESET "; relearn before it if that does not help"},
    {BERM_STOP_DUST, "wait until the dust has settled, or lay it with water; if there is none, clean the sensors' windows"},
};

#undef RESET

constexpr bool complete() {
  if (std::size(advices) != BERM_STOP_REASONS) return false;
  for (std::size_t i = 0; i < std::size(advices); ++i)
    if (advices[i].reason != i) return false;
  return true;
}
static_assert(complete(), "each stop reason of the contract has its advice, in the contract's order");

}  // namespace

const char* operator_advice(std::uint8_t stop_reason) {
  return stop_reason < std::size(advices) ? advices[stop_reason].text : "the kernel gives a reason that this app does not know: read the kernel's report, and start the app that belongs to it";
}

std::string eye_names(std::uint32_t sight) {
  static constexpr const char* names[BERM_SIGHT_EYES] = {"left scanner", "right scanner", "lidar 1", "lidar 2", "lidar 3", "lidar 4"};
  std::string out;
  for (std::uint32_t eye = 0; eye < BERM_SIGHT_EYES; ++eye)
    if ((sight & BERM_SIGHT_BLOCKED(eye)) != 0) out += (out.empty() ? "" : ", ") + std::string(names[eye]);
  return out;
}

}  // namespace berm::app
