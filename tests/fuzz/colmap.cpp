#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

// The first byte chooses text or binary; cameras and images are divided by four 0xff bytes.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  std::filesystem::create_directories(folder.path() / "images");
  std::filesystem::create_directories(folder.path() / "depth");
  const std::string_view text = Text(data, size);
  const std::string extension = !text.empty() && text[0] == 't' ? ".txt" : ".bin";
  const std::string_view files = text.substr(text.empty() ? 0 : 1);
  const size_t middle = std::min(files.find("\xff\xff\xff\xff"), files.size());
  const auto cameras = folder.Write("cameras" + extension, files.substr(0, middle));
  const auto images =
      folder.Write("images" + extension, files.substr(std::min(middle + 4, files.size())));
  AcceptErrors([&] { ReadColmap(folder.path(), [](const CheckFinding&) {}); });
  std::filesystem::remove(cameras);
  std::filesystem::remove(images);
  return 0;
}
