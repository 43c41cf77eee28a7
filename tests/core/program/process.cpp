/// @file What is put right of a process. Oracle: the system, which says how a child of this one ended.

#include "core/program/process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <functional>

#include "core/text_file.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr std::size_t kPage = 4096;

/// Exit code of a child that does this after prepare_process; -1 if a signal ended it.
int exit_code_in_child(const std::function<int()>& before, const std::function<int()>& after) {
  const pid_t child = ::fork();
  if (child == 0) {
    before();
    prepare_process();
    ::_exit(after());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("A file that is shortened while it is read ends a program with a message and 1") {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "mapped", said = folder / "said";
  write_file(file, std::string(2 * kPage, 'x'));
  const auto say_to_file = [&] {
    return ::dup2(::open(said.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
  };
  const auto read_what_is_gone = [&] {
    const int descriptor = ::open(file.c_str(), O_RDWR);
    const auto* const bytes =
        static_cast<const volatile char*>(::mmap(nullptr, 2 * kPage, PROT_READ, MAP_SHARED, descriptor, 0));
    if (::ftruncate(descriptor, 0) != 0) return 0;
    return bytes[kPage] == 'x' ? 0 : 2;
  };
  CHECK(exit_code_in_child(say_to_file, read_what_is_gone) == 1);
  CHECK_THAT(read_text(said, kPage, "a message"), Catch::Contains("got shorter while it was read"));
}

TEST_CASE("No file takes the place of a standard stream that is closed, and a limit of size is an error") {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "file";
  const auto close_streams = [] { return ::close(STDIN_FILENO) + ::close(STDERR_FILENO); };
  const auto open_and_write = [&] {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &none);
    const bool is_refused = ::write(descriptor, "x", 1) < 0 && errno == EFBIG;
    return descriptor > STDERR_FILENO && is_refused ? 7 : 0;
  };
  CHECK(exit_code_in_child(close_streams, open_and_write) == 7);
}

}  // namespace voussoir
