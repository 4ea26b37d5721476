#pragma once

#include <string>

namespace CLI {
class App;
}

namespace curvefusion {

// What a command line looks like to a shell and to `man`, read from its commands and options. The
// texts are whole files. CLI11 takes no look at `app` as constant.

/// A page for `man`: all commands with their options and examples.
std::string ManualPage(CLI::App& app);

/// What bash, zsh and fish complete: commands, options, and values where there is a list of them;
/// otherwise files.
std::string BashCompletion(CLI::App& app);
std::string ZshCompletion(CLI::App& app);
std::string FishCompletion(CLI::App& app);

}  // namespace curvefusion
