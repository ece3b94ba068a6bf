// A fuzz target without a fuzzer: its seeds, and random changes of them, the same in every run.
//   replay_NAME RUNS SEED_FILE...
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

/// One change as users and disks make them: a byte, a piece left out, doubled or cut off.
void change(Bytes& bytes, std::mt19937& generator) {
  if (bytes.empty()) return;
  const std::size_t at = generator() % bytes.size();
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const std::size_t count = std::min<std::size_t>(1 + generator() % 16, bytes.size() - at);
  const Bytes piece(begin, begin + static_cast<std::ptrdiff_t>(count));
  switch (generator() % 4) {
    case 0:
      bytes[at] = static_cast<std::uint8_t>(generator());
      break;
    case 1:
      bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
      break;
    case 2:
      bytes.insert(begin, piece.begin(), piece.end());
      break;
    default:
      if (generator() % 8 == 0) bytes.resize(at);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s RUNS SEED_FILE...\n", argv[0]);
    return 2;
  }
  const int runs = std::atoi(argv[1]);
  std::mt19937 generator(1);
  for (int a = 2; a < argc; ++a) {
    std::ifstream file(argv[a], std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "cannot read %s\n", argv[a]);
      return 2;
    }
    const Bytes seed{std::istreambuf_iterator<char>(file), {}};
    LLVMFuzzerTestOneInput(seed.data(), seed.size());
    for (int run = 0; run < runs; ++run) {
      Bytes bytes = seed;
      for (std::uint32_t n = 1 + generator() % 4; n > 0; --n) change(bytes, generator);
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
  }
  std::printf("%d inputs, no crash\n", (argc - 2) * (runs + 1));
  return 0;
}
