#include "valid_parameters.hpp"

#include "config/compile_parameters.hpp"

namespace berm::core_test {

berm_parameters valid_parameters() {
  const config::MachineFile machine = config::load_machine_file(BERM_CONFIG_FILES "/machines/zx200.toml");
  const config::SiteFile site = config::load_site_file(BERM_CONFIG_FILES "/sites/bench.toml");
  return config::compile_parameters(machine, site);
}

}  // namespace berm::core_test
