#pragma once

namespace CLI {
class App;
}

namespace curvefusion {

/// Gives `app` the name, the texts and all commands of the program. Parsing a line that names one
/// runs it and sets the exit code.
void AddCommandLine(CLI::App& app, int& exit_code);

}  // namespace curvefusion
