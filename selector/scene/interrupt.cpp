#include "selector/scene/interrupt.h"

namespace elastogen::selector {
namespace {

volatile std::sig_atomic_t seen = 0;

void note(int) { seen = 1; }

}  // namespace

InterruptGuard::InterruptGuard() {
  seen = 0;
  struct sigaction action {};
  action.sa_handler = note;
  sigemptyset(&action.sa_mask);
  // The second signal finds the default handler: whoever is in a hurry gets out.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &before_);
}

InterruptGuard::~InterruptGuard() { sigaction(SIGINT, &before_, nullptr); }

bool InterruptGuard::interrupted() const { return seen != 0; }

}  // namespace elastogen::selector
