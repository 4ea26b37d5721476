#pragma once

namespace curvefusion {

/// From now on a file that reaches its size limit and a reader that has closed its pipe are errors
/// of writing instead of the end of the program.
void IgnoreWriteSignals();

/// Tells the user what the exception that is being handled means, on the error stream, and returns
/// the exit code for it. To be called in a catch block.
int ReportFailure();

/// Writes out what standard output still holds. Returns `exit_code`, or that of a lack of resources
/// where it cannot be written, which it tells; a reader that has gone away wants no more and is no
/// failure.
int FlushedOutput(int exit_code);

}  // namespace curvefusion
