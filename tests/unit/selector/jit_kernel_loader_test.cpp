#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/jit/kernel_loader.h"
#include "selector/support/files.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

/// A cache and a law file of the test's own.
class Loader : public ::testing::Test {
 protected:
  Loader() {
    law_text_ = read_text_file(ELASTOGEN_SOURCE_DIR "/laws/hooke.toml", "law");
    write_law(law_text_);
  }

  void write_law(const std::string& text) { write_text_file(law_file(), text); }
  fs::path law_file() const { return folder_.path() / "laws" / "hooke.toml"; }
  fs::path cache() const { return folder_.path() / "cache"; }

  LoaderOptions options() const {
    LoaderOptions result;
    result.cache_folder = cache();
    return result;
  }

  KernelRequest request() const {
    KernelRequest result{
        symgen::AssociationId::parse("hooke-tet4-q1-none"), symgen::read_law(law_file()), {}};
    result.what.simd = false;
    result.what.operations = {"energy"};
    return result;
  }

  LoadedKernels load(const KernelRequest& request) const {
    return KernelLoader(options()).load({request}).front();
  }

  std::ptrdiff_t num_cache_entries() const {
    return std::distance(fs::directory_iterator(cache()), fs::directory_iterator{});
  }

  TemporaryFolder folder_;
  std::string law_text_;
};

TEST_F(Loader, CompilesOnceAndThenLoads) {
  const LoadedKernels first = load(request());
  EXPECT_FALSE(first.report().up_to_date);
  EXPECT_GT(first.report().compile_seconds, 0);
  const LoadedKernels second = load(request());
  EXPECT_TRUE(second.report().up_to_date);
  EXPECT_EQ(second.report().compile_seconds, 0);
  EXPECT_EQ(num_cache_entries(), 1);

  const KernelTable<double>& table = second.table<double>();
  EXPECT_STREQ(table.association, "hooke-tet4-q1-none");
  EXPECT_EQ(table.lanes, 1);
  EXPECT_EQ(table.num_nodes, 4);
  EXPECT_NE(table.variants[0].constants, nullptr);
  EXPECT_NE(table.variants[0].energy, nullptr);
  EXPECT_EQ(table.variants[0].forces, nullptr);
  EXPECT_THROW((void)second.table<float>(), InternalError);
}

TEST_F(Loader, RegeneratesForAnEnergyAndNotForAComment) {
  (void)load(request());
  write_law("# a remark\n" + law_text_);
  EXPECT_TRUE(load(request()).report().up_to_date);
  std::string changed = law_text_;
  const std::size_t mu = changed.find("mu*tr");
  ASSERT_NE(mu, std::string::npos) << "the law no longer reads as this test supposes";
  changed.replace(mu, 3, "2*mu*");
  write_law(changed);
  EXPECT_FALSE(load(request()).report().up_to_date);
}

TEST_F(Loader, KeepsInstantiationsApart) {
  KernelRequest packs = request();
  packs.what.simd = true;
  KernelRequest single = request();
  single.what.single_precision = true;
  const std::vector<LoadedKernels> loaded =
      KernelLoader(options()).load({request(), packs, single, request()});
  ASSERT_EQ(loaded.size(), 4U);
  EXPECT_EQ(loaded[0].table<double>().lanes, 1);
  EXPECT_GT(loaded[1].table<double>().lanes, 1);
  EXPECT_EQ(loaded[2].table<float>().lanes, 1);
  EXPECT_EQ(&loaded[3].table<double>(), &loaded[0].table<double>());  // one job for both
  EXPECT_EQ(num_cache_entries(), 3);
}

TEST_F(Loader, MendsADamagedEntry) {
  const fs::path library = load(request()).report().folder / "kernels.so";
  write_text_file(library, "no library");
  const LoadedKernels mended = load(request());
  EXPECT_FALSE(mended.report().up_to_date);
  EXPECT_STREQ(mended.table<double>().association, "hooke-tet4-q1-none");
  EXPECT_TRUE(load(request()).report().up_to_date);
}

TEST_F(Loader, MendsAnEntryThatLostItsLibrary) {
  fs::remove(load(request()).report().folder / "kernels.so");
  EXPECT_FALSE(load(request()).report().up_to_date);
  EXPECT_TRUE(load(request()).report().up_to_date);
}

TEST_F(Loader, KeepsNothingWithoutACache) {
  LoaderOptions without = options();
  without.use_cache = false;
  const LoadedKernels loaded = KernelLoader(without).load({request()}).front();
  EXPECT_STREQ(loaded.table<double>().association, "hooke-tet4-q1-none");
  EXPECT_EQ(num_cache_entries(), 0);
}

TEST_F(Loader, LeavesNoEntryWhenTheCompilerIsInterrupted) {
  const fs::path compiler = folder_.path() / "interrupted";
  write_text_file(compiler, "#!/bin/sh\n[ \"$1\" = --version ] && exit 0\nkill -INT $$\n");
  fs::permissions(compiler, fs::perms::owner_all);
  const EnvironmentVariable cxx("CXX", compiler.string());
  EXPECT_THROW((void)load(request()), WorkError);
  EXPECT_EQ(num_cache_entries(), 0);
}

TEST_F(Loader, KeepsTheLogOfAFailedCompilation) {
  const fs::path compiler = folder_.path() / "failing";
  write_text_file(compiler,
                  "#!/bin/sh\n[ \"$1\" = --version ] && exit 0\necho went wrong\nexit 1\n");
  fs::permissions(compiler, fs::perms::owner_all);
  const EnvironmentVariable cxx("CXX", compiler.string());
  const std::string message = message_of<CompilationFailed>([&] { (void)load(request()); });
  const std::size_t log = message.find("whole log: ");
  ASSERT_NE(log, std::string::npos) << message;
  EXPECT_NE(message.find("went wrong"), std::string::npos) << message;
  EXPECT_TRUE(fs::exists(message.substr(log + 11))) << message;
}

TEST_F(Loader, ReportsProgress) {
  std::vector<std::string> lines;
  LoaderOptions telling = options();
  telling.progress = [&](const std::string& line) { lines.push_back(line); };
  (void)KernelLoader(telling).load({request()});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "generating hooke-tet4-q1-none");
  EXPECT_EQ(lines[1], "compiling hooke-tet4-q1-none");
  EXPECT_TRUE(lines[2].starts_with("compiled hooke-tet4-q1-none in ")) << lines[2];
}

}  // namespace
}  // namespace elastogen::selector
