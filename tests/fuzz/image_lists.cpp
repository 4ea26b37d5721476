#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  folder.Write("intrinsics.json", R"({"width":64,"height":48,"fx":36,"fy":36,"cx":32,"cy":24})");
  folder.Write("trajectory.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const std::string_view text = Text(data, size);
  const auto read = [] { ReadTum(folder.path(), [](const CheckFinding&) {}); };
  const auto associations = folder.Write("associations.txt", text);
  AcceptErrors(read);
  std::filesystem::remove(associations);
  // Both lists from one input; a 0 byte divides it.
  const size_t middle = std::min(text.find(char(0)), text.size());
  folder.Write("rgb.txt", text.substr(0, middle));
  folder.Write("depth.txt", text.substr(middle < text.size() ? middle + 1 : 0));
  AcceptErrors(read);
  return 0;
}
