// The members of a library of kernels as binutils show them.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "selector/support/process.h"

namespace elastogen::test {

/// The set that a member of a library of kernels is compiled for, by its name; "" for the source
/// that chooses.
inline std::string set_of(const std::string& member) {
  for (const char* set : {"x86_64", "avx2", "avx512", "native"}) {
    if (member.find(std::string("_") + set + ".cpp") != std::string::npos) return set;
  }
  return "";
}

/// Calls `look(member, line)` for the lines that a program prints about a library's members.
inline void for_each_line(
    const std::vector<std::string>& command, const std::string& library,
    const std::function<void(const std::string& member, const std::string& line)>& look) {
  std::vector<std::string> words = command;
  words.push_back(library);
  const selector::ProcessResult result = selector::run_process(words);
  ASSERT_EQ(result.exit_status, 0) << result.output;
  std::istringstream stream(result.output);
  std::string member;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t name_end = line.find(".o:");
    if (name_end != std::string::npos) member = line.substr(0, name_end);
    look(member, line);
  }
}

/// Names that members define for others, weak and unique ones too, by set.
inline std::map<std::string, std::set<std::string>> defined_symbols(const std::string& library) {
  std::map<std::string, std::set<std::string>> symbols;
  for_each_line({"nm", "--defined-only"}, library,
                [&symbols](const std::string& member, const std::string& line) {
                  std::istringstream words(line);
                  std::string value, type, name;
                  if (!(words >> value >> type >> name) || type.size() != 1) return;
                  const bool is_local = std::islower(static_cast<unsigned char>(type[0])) != 0 &&
                                        std::string("uvw").find(type) == std::string::npos;
                  if (!is_local) symbols[set_of(member)].insert(name);
                });
  return symbols;
}

/// Fails for each name that members for two sets define.
inline void expect_disjoint(const std::map<std::string, std::set<std::string>>& symbols) {
  std::map<std::string, std::string> owner;
  for (const auto& [set, names] : symbols) {
    for (const std::string& name : names) {
      const auto [known, is_new] = owner.emplace(name, set);
      EXPECT_TRUE(is_new) << name << " in '" << set << "' and '" << known->second << "'";
    }
  }
}

}  // namespace elastogen::test
