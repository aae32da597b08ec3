// The plug-in's side: the server that loads it or starts a command, describes it, and forks
// sessions of it.
#include <cerrno>
#include <cstdio>
#include <dlfcn.h>
#include <exception>
#include <fcntl.h>
#include <memory>
#include <sched.h>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"
#include "candidates/host/spoken_command.hpp"

namespace touchstone {
namespace {

/// Large enough for any plug-in; a larger count is corrupt.
constexpr int max_candidates = 1000;

/// A candidate of interface version 3, which knew no context.
struct CandidateOfVersion3 {
  const char *name, *version, *settings, *models;
  const ts_parameter* parameter;
  int (*supports)(ts_shape_kind other);
  ts_prepared* (*prepare)(const ts_shape* a, const ts_shape* b, double threshold, double parameter);
  decltype(ts_candidate::query) query;
  decltype(ts_candidate::release) release;
  decltype(ts_candidate::model_distance) model_distance;
};

/// A plug-in of this interface version, whatever it was made for, or a command.
struct LoadedPlugin {
  std::vector<ts_candidate> candidates;
  std::vector<Description> descriptions;
  void (*after_fork)() = nullptr;
  Roundings roundings = nullptr;
  std::unique_ptr<SpokenCommand> spoken;
};

const CandidateOfVersion3& given_back(void* context) {
  return *static_cast<const CandidateOfVersion3*>(context);
}

ts_candidate of_version_3(const CandidateOfVersion3& old) {
  ts_candidate c{};
  c.name = old.name;
  c.version = old.version;
  c.settings = old.settings;
  c.models = old.models;
  c.parameter = old.parameter;
  c.query = old.query;
  c.release = old.release;
  c.model_distance = old.model_distance;
  c.context = const_cast<CandidateOfVersion3*>(&old);
  if (old.supports) {
    c.supports = [](void* context, ts_shape_kind other) {
      return given_back(context).supports(other);
    };
  }
  if (old.prepare) {
    c.prepare = [](void* context, const ts_shape* a, const ts_shape* b, double threshold,
                   double parameter) {
      return given_back(context).prepare(a, b, threshold, parameter);
    };
  }
  return c;
}

/// `kinds`: of how many shapes it has heard.
Description describe(const ts_candidate& c, std::size_t kinds) {
  const std::string name = c.name ? c.name : "";
  if (!is_candidate_name(name)) {
    throw std::runtime_error(std::string("has a candidate whose name is not of ") +
                             candidate_names);
  }
  if (!c.version || !c.settings || !c.supports || !c.prepare || !c.query || !c.release) {
    throw std::runtime_error(std::string("leaves something out in the candidate ") + c.name);
  }
  if (const ts_parameter* const p = c.parameter) {
    if (!p->meaning || !(p->least <= p->usual && p->usual <= p->most)) {
      throw std::runtime_error("gives the candidate " + name +
                               " a parameter without meaning or whose usual value is not between "
                               "its least and most");
    }
  }
  Description d{};
  copy_text(c.name, d.name);
  copy_text(c.version, d.version);
  copy_text(c.settings, d.settings);
  copy_text(c.models, d.models);
  if (c.parameter) {
    d.has_parameter = true;
    copy_text(c.parameter->meaning, d.meaning);
    d.min = c.parameter->least;
    d.max = c.parameter->most;
    d.usual = c.parameter->usual;
    d.whole = c.parameter->whole != 0;
    d.bare = c.parameter->bare != 0;
  }
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    d.supports[kind] = c.supports(c.context, static_cast<ts_shape_kind>(kind)) != 0;
  }
  return d;
}

LoadedPlugin load(const char* file) {
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  const auto entry =
      reinterpret_cast<decltype(&touchstone_plugin)>(dlsym(library, "touchstone_plugin"));
  if (!entry) throw std::runtime_error("exports no touchstone_plugin");
  const ts_plugin* plugin = entry();
  if (!plugin) throw std::runtime_error("gives no candidates");
  const int version = plugin->interface_version;
  if (version < 3 || version > TOUCHSTONE_INTERFACE_VERSION) {
    throw std::runtime_error("was made for version " + std::to_string(version) +
                             " of candidate.h; this is version " +
                             std::to_string(TOUCHSTONE_INTERFACE_VERSION));
  }
  const bool is_without_context = version == 3;
  const std::size_t kinds = version < 5 ? shape_kinds - 1 : shape_kinds;  // without the last one
  if (plugin->count < 1 || !plugin->candidates) throw std::runtime_error("gives no candidates");
  if (plugin->count > max_candidates) {
    throw std::runtime_error("gives " + std::to_string(plugin->count) + " candidates, more than " +
                             std::to_string(max_candidates));
  }
  LoadedPlugin result;
  const auto* const old = reinterpret_cast<const CandidateOfVersion3*>(plugin->candidates);
  for (int i = 0; i < plugin->count; ++i) {
    result.candidates.push_back(is_without_context ? of_version_3(old[i]) : plugin->candidates[i]);
    result.descriptions.push_back(describe(result.candidates.back(), kinds));
    result.descriptions.back().unforked = !is_without_context && plugin->unforked != 0;
  }
  if (!is_without_context) result.after_fork = plugin->after_fork;
  if (version >= 5) result.roundings = plugin->roundings;
  return result;
}

LoadedPlugin load(const char* line, const char* folder) {
  LoadedPlugin result;
  result.spoken = std::make_unique<SpokenCommand>(line, folder);
  result.candidates = {result.spoken->candidate()};
  result.descriptions = {result.spoken->description()};
  result.roundings = result.spoken->roundings();
  return result;
}

/// Bytes of this process's address space.
rlim_t address_space() {
  unsigned long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void bound_memory(rlim_t bytes) {
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_AS, &memory);
}

/// Waits for a process to end and returns its wait status; kills it if it has only been stopped (by
/// ptrace).
int wait_for(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 ? errno == EINTR : WIFSTOPPED(status)) {
    if (WIFSTOPPED(status)) kill(pid, SIGKILL);
  }
  return status;
}

/// Is any descendant still running? Reaps those that have ended.
bool others_run() {
  pid_t pid;
  while ((pid = waitpid(-1, nullptr, WNOHANG)) > 0) {
  }
  return pid == 0;
}

}  // namespace

void serve_plugin(const char* file, const char* folder, int socket, const Questions& questions,
                  Exchange& exchange) {
  constexpr unsigned long max_file = 1ul << 24;  // limits what it prints, too
  become_plain_process(folder ? SpokenCommand::max_file : max_file);
  // Processes that a session leaves behind are reparented to this one, which so learns of them.
  if (!folder) prctl(PR_SET_CHILD_SUBREAPER, 1);

  LoadedPlugin plugin;
  const auto refuse = [&](const char* why) {
    copy_text(why, exchange.text);
    reply(socket, Reply::refused, 0, 0);
    _exit(1);
  };
  try {
    plugin = folder ? load(file, folder) : load(file);
  } catch (const std::exception& e) {
    refuse(e.what());
  } catch (...) {
    refuse("threw something that is no exception");
  }
  reply(socket, Reply::described, 0, static_cast<int>(plugin.descriptions.size()));
  for (const Description& d : plugin.descriptions) send(socket, &d, sizeof d);
  const rlim_t loaded = address_space();  // every session begins with this much
  for (;;) {
    const SessionCommand command = receive(socket);
    if (command.kind != SessionCommand::begin) continue;  // meant for a session that has died
    const auto serve = [&] {
      if (!plugin.spoken) bound_memory(loaded + command.memory);
      if (plugin.after_fork) plugin.after_fork();
      if (plugin.spoken && command.warm) plugin.spoken->warm_up(command.parameter);
      serve_session(plugin.candidates[static_cast<std::size_t>(command.index)], plugin.roundings,
                    plugin.spoken.get(), command, socket, questions, exchange);
    };
    if (plugin.descriptions[0].unforked) serve();
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // if this process dies first, receive() ends the session
      setpgid(0, 0);
      serve();
    }
    if (pid < 0) {
      reply(socket, Reply::began, command.ticket, -1);
      continue;
    }
    const int status = wait_for(pid);
    reply(socket, Reply::ended, command.ticket, status, others_run());
  }
}

}  // namespace touchstone
