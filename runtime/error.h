// Errors have owners: InputError is the user's to mend, InternalError is ours.
#pragma once

#include <stdexcept>
#include <string>

namespace elastogen {

/// Something in the input is wrong. The message names the object, what was found, what is
/// allowed and the remedy; `main` prints it after "error: " and exits with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work itself failed (Newton did not converge, the compiler is missing): exit status 1.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A contract inside elastogen was broken: our bug. Exit status 1.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace elastogen
