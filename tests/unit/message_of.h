// What tests of messages say.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace elastogen::test {

/// The message of the Error that `call` throws; a failed test when it throws none.
template <class Error, class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace elastogen::test
