#include "experiments/config.h"

#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const std::string_view text = Text(data, size);
  const auto path = folder.Write("config.toml", text);
  AcceptErrors([&] { ReadConfig({.profile = {}, .file = path, .assignments = {}}); });
  AcceptErrors(
      [&] { ReadConfig({.profile = {}, .file = {}, .assignments = {std::string(text)}}); });
  return 0;
}
