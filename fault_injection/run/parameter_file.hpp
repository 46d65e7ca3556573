// Machine and site files by name or path, and their compilation into the kernel's parameter block.
#pragma once

#include <exception>
#include <string>

namespace berm::run {

class ChildProcess;

// A name ("zx200") is looked up among the files that come with Berm; anything with a slash or ".toml" is a path. Throws std::runtime_error with what there is.
std::string find_machine(const std::string& name);
std::string find_site(const std::string& name);
std::string find_scenario(const std::string& name);
std::string find_soil(const std::string& name);
// The classes of trucks that the app recognises.
std::string truck_classes_file();
// The folder of the app's scripts.
std::string scripts_folder();

// A child process has told on standard error what is wrong; nothing more is to be said.
class ToldAlready : public std::exception {
 public:
  const char* what() const noexcept override { return ""; }
};

// Of a child that has ended and tells what is wrong with its input: ToldAlready unless it exited with 0; where a signal ended it, it could not
// tell, and std::runtime_error does.
void expect_content(const ChildProcess& child);

// Compiles machine and site into a block at path, which the children can read, with berm_params, which tells what is wrong; then throws ToldAlready.
void compile_parameter_file(const std::string& machine, const std::string& site, const std::string& path);

}  // namespace berm::run
