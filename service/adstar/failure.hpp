#pragma once
// How a verb ends when it cannot do what was asked. The codes are the contract with scripts.

#include <stdexcept>
#include <string>

namespace adstar::cli {

enum ExitCode : int {
  kDone = 0,
  kFailed = 1,    ///< anything that has no code of its own
  kUsage = 2,     ///< the command line or the scene is wrong
  kRefused = 3,   ///< a service said no
  kNoAnswer = 4,  ///< nobody answered in time
};

/// Ends the verb: main prints "adstar VERB: what()" and exits with the code.
struct Failure : std::runtime_error {
  Failure(ExitCode exit_code, const std::string& message)
      : std::runtime_error(message), code(exit_code) {}
  ExitCode code;
};

/// Whoever read our output has gone (`adstar ... | head`): nothing to say, nothing went wrong.
struct ReaderGone {};

}  // namespace adstar::cli
