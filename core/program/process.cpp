#include "core/program/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

namespace voussoir {
namespace {

/// Only what may be called in a signal handler.
[[noreturn]] void end_for_shortened_file(int) {
  constexpr std::string_view kMessage =
      "a file got shorter while it was read: run the command again when it is whole (give files a new name "
      "with mv, do not write over them with cp)\n";
  static_cast<void>(!::write(STDERR_FILENO, kMessage.data(), kMessage.size()));
  ::_exit(1);
}

}  // namespace

void prepare_process() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, end_for_shortened_file);
  // A new descriptor is the lowest that is free, so this ends with the first beyond the standard streams.
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDWR);
  if (opened > STDERR_FILENO) ::close(opened);
}

}  // namespace voussoir
