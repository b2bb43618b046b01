// SPDX-License-Identifier: BSD-3-Clause
#include "engine.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/program_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// Folder of the Snakefile: that of the source tree if it exists, else the one installed with the program.
fs::path workflow_files() {
  const fs::path folders[] = {
#ifdef EDGEVO_WORKFLOW_SOURCE_DIR
      EDGEVO_WORKFLOW_SOURCE_DIR,
#endif
      data_folder() / "workflow"};
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::is_regular_file(folder / "Snakefile", ignored)) return folder;
  throw InputError(folders[0].string(), "there is no Snakefile", "reinstall edgevo");
}

std::string profile_folder(const std::string& name) {
  std::vector<fs::path> folders{workflow_files() / "profiles" / (name.empty() ? "local" : name)};
  if (!name.empty()) folders.push_back(fs::absolute(name));
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::is_regular_file(folder / "config.yaml", ignored)) return folder.string();
  throw InputError("--profile " + name, "there is no such profile",
                   "name local, slurm, kubernetes or a folder with a config.yaml");
}

// Memory of this machine, MB: limits the number of parallel jobs.
long memory_mb() { return sysconf(_SC_PHYS_PAGES) / 1024 * (sysconf(_SC_PAGESIZE) / 1024); }

std::vector<std::string> command_line(const std::string& workflow, const EngineOptions& options) {
  std::vector<std::string> words{"snakemake",
                                 "--snakefile",
                                 (workflow_files() / "Snakefile").string(),
                                 "--directory",
                                 workflow,
                                 "--profile",
                                 profile_folder(options.profile)};
  const bool here = options.profile.empty() || options.profile == "local";
  if (options.cores > 0 || here)
    words.insert(words.end(), {here ? "--cores" : "--jobs", std::to_string(std::max(1, options.cores))});
  if (here)
    words.insert(words.end(), {"--resources", "mem_mb=" + std::to_string(std::max(2000L, memory_mb()))});
  if (options.dry_run) words.insert(words.end(), {"--dry-run", "--quiet", "rules"});
  words.insert(words.end(), {"--config", "plan=" + workflow + "plan.json"});
  return words;
}

bool is_installed(const std::string& program) {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

// Profiles name their scripts without a folder.
void add_scripts_of_profile(const std::vector<std::string>& words) {
  const char* const path = std::getenv("PATH");
  const auto profile = std::find(words.begin(), words.end(), "--profile") + 1;
  setenv("PATH", (*profile + ":" + (path ? path : "")).c_str(), 1);
  setenv("PYTHONUNBUFFERED", "1", 1);
}

// Runs in a process group of its own, so that signals reach all of it; it dies with this program in any case.
pid_t start(const std::vector<std::string>& words, int output) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw InputError("snakemake", std::strerror(errno), "close other programs");
  if (child > 0) setpgid(child, child);  // here, too: a signal may come before the child has done it
  if (child > 0) return child;
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  if (output >= 0) dup2(output, STDOUT_FILENO), dup2(output, STDERR_FILENO);
  add_scripts_of_profile(words);
  execvp(argv[0], argv.data());
  _exit(127);
}

// "12 of 40 steps (30%) done"
bool read_steps(const std::string& line, int* done, int* all) {
  return std::sscanf(line.c_str(), "%d of %d steps", done, all) == 2;
}

// Ends Snakemake and its jobs once the user wants that. SIGTERM lets jobs end by themselves. Snakemake 7 may
// then wait for ever: its handler takes a lock that the interrupted thread may hold (scheduler.py,
// exit_gracefully). SIGINT raises KeyboardInterrupt there, which releases it.
class GroupEnd {
 public:
  GroupEnd(pid_t group, const std::function<bool()>& stop) : group_(group), stop_(stop) {}

  void pass_on() {
    using std::chrono::steady_clock, std::chrono::seconds;
    if (!stop_()) return;
    const auto now = steady_clock::now();
    if (next_ == steady_clock::time_point{})
      kill(-group_, SIGTERM);
    else if (now >= next_)
      kill(group_, SIGINT);
    else
      return;
    next_ = now + seconds(10);  // longer than a job takes to write what it has
  }

 private:
  pid_t group_;
  const std::function<bool()>& stop_;
  std::chrono::steady_clock::time_point next_;
};

// Reads the output of Snakemake line by line.
class Listener {
 public:
  Listener(const std::string& log, GroupEnd* end) : log_(log), end_(end) {}

  void listen(int input) {
    char buffer[4096];
    for (ssize_t count = 1; count != 0;) {
      pollfd waiting{input, POLLIN, 0};
      const int ready = poll(&waiting, 1, 200);
      end_->pass_on();
      if (ready <= 0) continue;
      count = read(input, buffer, sizeof buffer);
      if (count > 0) take({buffer, size_t(count)});
    }
  }

 private:
  void take(const std::string& bytes) {
    log_.write(bytes);
    begun_ += bytes;
    for (size_t end; (end = begun_.find('\n')) != std::string::npos; begun_.erase(0, end + 1))
      take_line(begun_.substr(0, end));
  }
  void take_line(const std::string& line) {
    int done = 0, all = 0;
    if (!read_steps(line, &done, &all)) return;
    if (on_terminal_) std::fprintf(stderr, "\r%d of %d jobs \033[K%s", done, all, done >= all ? "\n" : "");
  }

  OutputFile log_;
  GroupEnd* end_;
  std::string begun_;
  const bool on_terminal_ = isatty(STDERR_FILENO) == 1;
};

int wait_for(pid_t child, GroupEnd* end) {
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    end->pass_on();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return status;
}

int dry_run(const std::vector<std::string>& words, const std::function<bool()>& stop) {
  std::fflush(stdout);
  const pid_t child = start(words, -1);
  GroupEnd end(child, stop);
  return wait_for(child, &end);
}

int run_logged(const std::vector<std::string>& words, const std::string& log,
               const std::function<bool()>& stop) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw InputError("pipe", std::strerror(errno), "close other programs");
  const pid_t child = start(words, ends[1]);
  close(ends[1]);
  GroupEnd end(child, stop);
  Listener(log, &end).listen(ends[0]);
  close(ends[0]);
  return wait_for(child, &end);
}

}  // namespace

std::string run_engine(const std::string& workflow, const EngineOptions& options, const BenchHost& host) {
  if (!is_installed("snakemake"))
    throw InputError("snakemake", "is not installed, and runs what a list names",
                     "call share/install_dependencies.sh --workflow (or: apt install snakemake)");
  const std::vector<std::string> words = command_line(workflow, options);
  host.listen_to_signals();
  const std::string log = workflow + "engine.log";
  const int status = options.dry_run ? dry_run(words, host.stop) : run_logged(words, log, host.stop);
  if (status == 0) return "";
  return "snakemake has not done all of it; see " + log;
}

}  // namespace edgevo
