// Stability stress test: random but reproducible scenes, far beyond what anybody should ask for. Every scene runs in a
// process of its own, so that a crash or a hang is a result like any other.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "draw.h"
#include "judge.h"

namespace {

using namespace geocontainer_mpm::stability;

struct Options {
  int count = 100, jobs = 1;
  std::uint64_t seed = 1;
  std::string json, csv, keep;
  unsigned cpu_limit_s = 60;
};

/// A scene in a child process, and the pipe that its verdict comes through.
struct Child {
  std::uint64_t seed;
  int pipe;
};

nlohmann::json to_json(std::uint64_t seed, const Drawing& drawing, const Verdict& v)
{
  return { { "seed", seed },
           { "family", drawing.family },
           { "class", to_string(v.what) },
           { "reason", v.reason },
           { "time_s", v.time_s },
           { "end_s", v.end_s },
           { "steps", v.steps },
           { "particles", v.particles },
           { "retries", v.retries },
           { "balance_error", v.balance_error },
           { "gained", v.gained },
           { "lost", v.lost } };
}

/// In the child: runs the scene, writes the verdict and ends.
[[noreturn]] void be_child(std::uint64_t seed, unsigned cpu_limit_s, int pipe)
{
  const rlimit limit{ cpu_limit_s, cpu_limit_s };
  setrlimit(RLIMIT_CPU, &limit);
  const Drawing drawing = draw(seed);
  const std::string text = to_json(seed, drawing, judge(drawing)).dump();
  const bool written = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  _exit(written ? 0 : 1);
}

pid_t start_child(std::uint64_t seed, const Options& options, std::map<pid_t, Child>& children)
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  const pid_t pid = fork();
  if (pid < 0)
    throw std::runtime_error("no process");
  if (pid == 0) {
    close(ends[0]);
    be_child(seed, options.cpu_limit_s, ends[1]);
  }
  close(ends[1]);
  children[pid] = { seed, ends[0] };
  return pid;
}

std::string read_all(int pipe)
{
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(pipe, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(pipe);
  return text;
}

/// Waits for any child. Its verdict, or what the way it ended says.
nlohmann::json reap(std::map<pid_t, Child>& children)
{
  int status = 0;
  rusage usage{};
  const pid_t pid = wait4(-1, &status, 0, &usage);
  const Child child = children.at(pid);
  children.erase(pid);
  const std::string text = read_all(child.pipe);
  nlohmann::json result;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && nlohmann::json::accept(text)) {
    result = nlohmann::json::parse(text);
  } else {
    Verdict verdict;
    verdict.what = Class::failed;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    verdict.reason = signal == SIGXCPU || signal == SIGKILL
                         ? "did not end within its CPU time"
                         : fmt::format("crashed: signal {}, status {}", signal, WEXITSTATUS(status));
    result = to_json(child.seed, draw(child.seed), verdict);
  }
  result["cpu_s"] = static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  return result;
}

void keep_scene(const std::string& folder, std::uint64_t seed, const std::string& reason)
{
  std::filesystem::create_directories(folder);
  std::ofstream(fmt::format("{}/stability_{}.yaml", folder, seed)) << "# " << reason << "\n" << draw(seed).yaml;
}

/// A row for every scene that did not survive.
void write_csv(const std::string& file, const std::vector<nlohmann::json>& scenes)
{
  std::ofstream out(file);
  out << "seed,family,class,time_s,reason\n";
  for (const nlohmann::json& scene : scenes)
    if (scene["class"] != "survived")
      out << fmt::format("{},{},{},{:.4g},\"{}\"\n", scene["seed"].get<std::uint64_t>(),
                         scene["family"].get<std::string>(), scene["class"].get<std::string>(),
                         scene["time_s"].get<double>(), scene["reason"].get<std::string>());
}

int run(const Options& options)
{
  std::map<std::string, int> counts{ { "survived", 0 }, { "stopped", 0 }, { "failed", 0 } };
  std::vector<nlohmann::json> scenes;
  std::map<pid_t, Child> children;
  std::uint64_t next = options.seed;
  const std::uint64_t end = options.seed + static_cast<std::uint64_t>(options.count);
  while (next < end || !children.empty()) {
    if (next < end && children.size() < static_cast<std::size_t>(options.jobs)) {
      start_child(next++, options, children);
      continue;
    }
    const nlohmann::json result = reap(children);
    const std::string what = result["class"];
    ++counts[what];
    scenes.push_back(result);
    if (what != "survived")
      fmt::print("{:8} seed {} ({}): {}\n", what, result["seed"].get<std::uint64_t>(),
                 result["family"].get<std::string>(), result["reason"].get<std::string>());
    if (what == "failed" && !options.keep.empty())
      keep_scene(options.keep, result["seed"], result["reason"]);
    std::fflush(stdout);
  }
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a["seed"] < b["seed"]; });
  double cpu = 0.0;
  for (const auto& scene : scenes)
    cpu += scene["cpu_s"].get<double>();
  fmt::print("{} scenes from seed {}: {} survived, {} stopped, {} failed; {:.2f} s of CPU a scene\n", options.count,
             options.seed, counts["survived"], counts["stopped"], counts["failed"], cpu / std::max(1, options.count));
  if (!options.json.empty())
    std::ofstream(options.json) << nlohmann::json{
      { "count", options.count },       { "seed", options.seed },       { "survived", counts["survived"] },
      { "stopped", counts["stopped"] }, { "failed", counts["failed"] }, { "scenes", scenes }
    }.dump(1) << "\n";
  if (!options.csv.empty())
    write_csv(options.csv, scenes);
  return counts["failed"] == 0 ? 0 : 1;
}

/// A scene that was kept, run to its end.
int judge_file(const std::string& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  const Drawing drawing{ file, text.str(), std::numeric_limits<double>::infinity(), false };
  const Verdict verdict = judge(drawing);
  std::cout << to_json(0, drawing, verdict).dump(1) << "\n";
  return verdict.what == Class::failed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("Draws scenes by chance and says which survived, were stopped cleanly, or failed.");
  app.add_option("--count", options.count, "how many scenes")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the first; the others follow");
  app.add_option("--jobs", options.jobs, "scenes at a time")->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "file for all results");
  app.add_option("--csv", options.csv, "file for the scenes that did not survive, a row each");
  app.add_option("--keep", options.keep, "folder for the scenes that failed");
  app.add_option("--cpu-limit", options.cpu_limit_s, "seconds of CPU after which a scene counts as hanging");
  std::string file;
  app.add_option("--scene", file, "judge this scene file instead, in this process")->check(CLI::ExistingFile);
  bool show = false;
  app.add_flag("--show", show, "write the scene of --seed and run nothing");
  CLI11_PARSE(app, argc, argv);
  if (show) {
    std::cout << draw(options.seed).yaml;
    return 0;
  }
  if (!file.empty())
    return judge_file(file);
  return run(options);
}
