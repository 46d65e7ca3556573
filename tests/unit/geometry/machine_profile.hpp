// Parameter blocks for the tests of the geometry, straight from the machine files (and not by the project's compiler of them).
#ifndef BERM_TESTS_GEOMETRY_MACHINE_PROFILE_HPP
#define BERM_TESTS_GEOMETRY_MACHINE_PROFILE_HPP

#include <random>
#include <string>
#include <vector>

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::kernel::test {

struct Machine {
  std::string name;
  berm_parameters parameters;
};

// Every machine file, in the order of their names.
std::vector<Machine> machine_profiles();

// A machine no one would build: short or long links, pins behind the axis, parts anywhere about their pins, any angle permitted.
Machine random_machine(std::mt19937_64& random);

// Where in the permitted range, swing up to 70 degrees wide, the others up to 10; one in eight is a single position.
sk_reach_box random_box(const berm_parameters& parameters, std::mt19937_64& random);

double uniform(std::mt19937_64& random, double low, double high);

// BERM_SAMPLES, or what is given.
long sample_count(long otherwise);

} // namespace berm::kernel::test
#endif
