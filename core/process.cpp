#include "core/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace voussoir {

void prepare_process() {
  std::signal(SIGXFSZ, SIG_IGN);
  // A new descriptor is the lowest that is free, so this ends with the first beyond the standard streams.
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDWR);
  if (opened > STDERR_FILENO) ::close(opened);
}

}  // namespace voussoir
