#pragma once

#include <string>

namespace CLI {
class App;
}

namespace curvefusion {

// What a command line looks like to `man` and to shells, read from its commands and options. The
// texts are whole files.

/// A page for `man`: all commands with their options and examples.
std::string ManualPage(const CLI::App& app);

/// What bash, zsh and fish complete: commands, options, and values where there is a list of them;
/// otherwise files.
std::string BashCompletion(const CLI::App& app);
std::string ZshCompletion(const CLI::App& app);
std::string FishCompletion(const CLI::App& app);

}  // namespace curvefusion
