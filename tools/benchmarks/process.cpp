#include "tools/benchmarks/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "core/error.h"
#include "core/text_file.h"
#include "lookup/readings/readings_csv.h"
#include "lookup/readings/simulate.h"

namespace voussoir {
namespace {

constexpr double kLevel = 0.05;  // of the simulated noise

/// Readings of a scene that stands, of the reference one with two missing blocks, in a file that goes when
/// this does. The bridge without missing blocks stands.
class TemporaryReadings {
 public:
  explicit TemporaryReadings(const Library& library)
      : path_(std::filesystem::temp_directory_path() / fmt::format("voussoir-{}.csv", ::getpid())) {
    Random random(1);
    std::size_t row = library.table.rows / 2;
    while (row > 0 && !library.table.stands(row)) --row;
    NoiseModel noise{NoiseShape::uniform, kLevel};
    noise.silence = 0.0;
    write_file(path_, to_csv(simulate_readings(library.table.row(row), noise, random), library.points));
  }
  ~TemporaryReadings() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryReadings(const TemporaryReadings&) = delete;
  TemporaryReadings& operator=(const TemporaryReadings&) = delete;

  std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// From before the process exists until it has ended [ms].
double time_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  int status = 0;
  const auto start = std::chrono::steady_clock::now();
  const int error = posix_spawnp(&process, arguments.front(), &actions, nullptr, arguments.data(), environ);
  const bool ended = error == 0 && ::waitpid(process, &status, 0) == process;
  const auto end = std::chrono::steady_clock::now();
  ::posix_spawn_file_actions_destroy(&actions);
  if (!ended || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Failure(fmt::format("{}: cannot be run", command.front()));
  return std::chrono::duration<double, std::milli>(end - start).count();
}

}  // namespace

std::vector<Timing> time_processes(const std::filesystem::path& locate_damage,
                                   const std::filesystem::path& database, const Library& library, int runs) {
  const TemporaryReadings readings(library);
  const std::vector<std::string> locate = {locate_damage.string(), readings.name(), "-d", database.string()};
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command = locate;
    command.insert(command.end(), options.begin(), options.end());
    return command;
  };
  const std::vector<std::pair<std::string, std::vector<std::string>>> commands = {
      {"a process that does nothing", {"true"}},
      {"locate-damage", locate},
      {"locate-damage --known-bridge", with({"--known-bridge"})},
      {"the same, --noise 5% --noise-model uniform",
       with({"--known-bridge", "--noise", "5%", "--noise-model", "uniform"})},
      {"locate-damage --objective paper", with({"--objective", "paper"})}};
  std::vector<std::vector<double>> times(commands.size());
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < commands.size(); ++i) times[i].push_back(time_of(commands[i].second));
  std::vector<Timing> timings;
  for (std::size_t i = 0; i < commands.size(); ++i)
    timings.push_back(timing_of(commands[i].first, std::move(times[i])));
  return timings;
}

}  // namespace voussoir
