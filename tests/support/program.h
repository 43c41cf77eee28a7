#pragma once
/// @file Running the real programs as child processes, also under limits, and killing them.

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <linux/capability.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace voussoir::test {

struct ProgramResult {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;
  std::string out;
  std::string err;
};

/// A running program of this build. Its output goes to files, so that it never waits for a reader.
class Program {
 public:
  using Prepare = std::function<void()>;

  /// `name`: of a program of this build, or the whole path of another. `prepare` runs in the child before the
  /// program starts (limits); it must not throw.
  Program(const std::string& name, const std::vector<std::string>& arguments, const Prepare& prepare = {}) {
    const std::string path = std::filesystem::path(VOUSSOIR_BIN_DIR) / name;
    std::vector<char*> argv = {const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const std::string out = (output_ / "out").string();
    const std::string err = (output_ / "err").string();
    child_ = ::fork();
    if (child_ != 0) return;
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    if (prepare) prepare();
    ::execv(path.c_str(), argv.data());
    ::_exit(127);
  }
  ~Program() {
    if (!child_) return;
    kill();
    wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void kill() const { ::kill(child_, SIGKILL); }

  ProgramResult wait() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
            text_of("out"), text_of("err")};
  }

 private:
  std::string text_of(const std::string& name) const {
    std::ifstream stream(output_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryFolder output_;
  pid_t child_ = 0;
};

inline ProgramResult run(const std::string& name, const std::vector<std::string>& arguments,
                         const Program::Prepare& prepare = {}) {
  return Program(name, arguments, prepare).wait();
}

/// For `prepare`: no file may grow beyond this size, as on a disk that fills up.
inline Program::Prepare file_size_limit(rlim_t bytes) {
  return [bytes] {
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
}

/// For `prepare`: permissions of files count even for root.
inline void obey_permissions() {
  ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0);
}

}  // namespace voussoir::test
