// One way for all commands to read their options: --help to standard output and status 0; anything wrong is one line and status 2. Numbers are finite and
// of the type they go to; names are not empty; files that a command writes are none that it reads, and none twice; what does not reach standard output is
// told of.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "config/output_file.hpp"
#include "config/shell_word.hpp"
#include "config/standard_error.hpp"
#include "config/standard_output.hpp"

namespace berm::config {

namespace command_line {

inline constexpr const char *kOutput = "OUTPUT", *kOutputOrNone = "OUTPUT or \"\"";

inline bool of_type(const CLI::Option& option, const char* type) { return option.get_type_name().find(type) == 0; }

// What CLI11 lets through: a number that is none is within any range, a negative or too large one wraps round or is cut off, and 010 is eight.
inline std::string wrong_number(const CLI::Option& option, const std::string& text) {
  const std::string name = option.get_name();
  char* end = nullptr;
  if (of_type(option, "FLOAT")) return std::isfinite(std::strtod(text.c_str(), &end)) ? "" : fmt::format("{}: {} is no number", name, text);
  const bool counts = of_type(option, "UINT");
  if (!counts && !of_type(option, "INT")) return "";
  if (counts && text.find('-') != std::string::npos) return fmt::format("{}: {} is negative", name, text);
  const std::string digits = text.substr(text.find_first_of("+-") == 0 ? 1 : 0);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos || (digits.size() > 1 && digits[0] == '0'))
    return fmt::format("{}: {} is no whole number in decimal digits without leading zeros", name, text);
  if (!counts) return "";
  errno = 0;
  const unsigned long long value = std::strtoull(text.c_str(), &end, 10);
  return errno == ERANGE ? fmt::format("{}: {} is beyond {}", name, text, value) : "";
}

// An empty text is a shell variable that was never set: taken for "not given", the result that it should have named is lost after the work.
inline std::string wrong_text(const CLI::Option& option, const std::string& text) {
  const bool named = of_type(option, "TEXT") || (of_type(option, kOutput) && !of_type(option, kOutputOrNone));
  return named && text.empty() ? option.get_name() + ": must not be empty" : "";
}

inline std::string wrong_values(const CLI::App& app) {
  std::vector<NamedFile> read, written;
  for (const CLI::Option* option : app.get_options()) {
    const bool is_output = of_type(*option, kOutput);
    std::vector<std::string> texts = option->results();
    for (const std::string& text : texts)
      if (std::string wrong = wrong_text(*option, text); !wrong.empty()) return wrong;
    if (texts.empty() && is_output) texts.push_back(option->get_default_str());
    for (const std::string& text : texts) {
      if (std::string wrong = wrong_number(*option, text); !wrong.empty()) return wrong;
      if (!text.empty() && (is_output || of_type(*option, "TEXT"))) (is_output ? written : read).push_back({option->get_name(), text});
    }
  }
  for (const auto& [option, file] : written)
    if (const std::string why = why_not_written(file); !why.empty()) return fmt::format("{}: {}: {}", option, file, why);
  return overwritten(written, read);
}

}  // namespace command_line

// Of an option: the file that the command writes.
inline CLI::Option* output(CLI::Option* option) { return option->type_name(command_line::kOutput); }

// The same, where the help gives empty text a meaning: that it is not written.
inline CLI::Option* output_or_none(CLI::Option* option) { return option->type_name(command_line::kOutputOrNone); }

// Of a number that counts from 0: why it is none of so many; empty when it is one.
inline std::string not_below(const char* option, int number, const char* of, int count) {
  return number < count ? "" : fmt::format("{}: {} is not below {} {}", option, number, of, count);
}

// What was given on the command line, but for the options without, each with a space before it: the end of a command that does the same again.
inline std::string options_again(const CLI::App& app, const std::vector<std::string>& without) {
  std::string again;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || std::find(without.begin(), without.end(), option->get_name()) != without.end()) continue;
    if (!option->get_positional()) again += " " + option->get_name();
    if (option->get_items_expected_max() == 0) continue;  // a flag
    for (const std::string& value : option->results()) again += " " + shell_word(value);
  }
  return again;
}

// The exit status when the program should end now.
inline std::optional<int> parse_options(CLI::App& app, int argc, char** argv) {
  const auto refused = [&app](std::string what) {
    std::replace(what.begin(), what.end(), '\n', ' ');
    print_error("{}: {} (see --help)\n", app.get_name(), what);
    return 2;
  };
  watch_standard_output(app.get_name());
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return refused(error.what());
  }
  if (const std::string wrong = command_line::wrong_values(app); !wrong.empty()) return refused(wrong);
  return std::nullopt;
}

}  // namespace berm::config
