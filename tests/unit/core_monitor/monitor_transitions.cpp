// Prints docs/monitor_transitions.md.
#include <iostream>

#include "transition_table.hpp"

int main() { std::cout << berm::core_test::transition_page(); }
