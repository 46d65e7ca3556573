// What the kernel's CheckCell and MergeCell do with every flag, class of height difference, neighbourhood, border and region, found by running them; as the
// page docs/monitor_transitions.md.
#pragma once

#include <string>

namespace berm::core_test {

std::string transition_page();

}  // namespace berm::core_test
