// One way for all commands to read their options: --help to standard output and status 0; anything wrong is one line and status 2.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>

namespace berm::config {

// The exit status when the program should end now.
inline std::optional<int> parse_options(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    fmt::print(stderr, "{}: {} (see --help)\n", app.get_name(), what);
    return 2;
  }
}

}  // namespace berm::config
