// How good is the net? Asks a library of routines in which a fault may be planted, and stops at the
// first answer that is wrong (reference/mutation/mutation_score.py).
//
//   mutation_probe cases NET COUNT FILE          configurations and their truths, once
//   mutation_probe baseline LIBRARY FILE KNOWN   what is wrong without a fault, left out from then
//   on mutation_probe ask LIBRARY FILE KNOWN        "CHECK IDENTITY" of the first finding, exit
//   code 1
//
// NET is "classes" (COUNT of each pose class of the default report) or "hostile" (COUNT of each
// pair). A fault without an end is ended by SIGVTALRM.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <stdexcept>
#include <sys/time.h>

#include "reference/mutation/judge.hpp"

namespace touchstone::mutation {
namespace {

const Routines& load(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  using Entry = const Routines* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "touchstone_routines"));
  if (!entry) throw std::runtime_error(std::string(file) + " has no touchstone_routines");
  return *entry();
}

/// Ends this process unless it is called again within a second of its own time.
void expect_an_end() {
  const itimerval second{{0, 0}, {1, 0}};
  setitimer(ITIMER_VIRTUAL, &second, nullptr);
}

void print(const Findings& findings, const std::string& identity) {
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!findings[i]) continue;
    std::printf("%s/%d %s\n", check_name(static_cast<int>(i) / max_variants),
                static_cast<int>(i) % max_variants, identity.c_str());
    return;
  }
}

int write_baseline(const Routines& routines, const char* cases_file, const char* known_file) {
  std::FILE* known = std::fopen(known_file, "w");
  if (!known) throw std::runtime_error(std::string("cannot open ") + known_file);
  std::size_t wrong[check_count] = {}, with_any = 0;
  const auto cases = read_cases(cases_file);
  for (const Case& c : cases) {
    const Findings findings = judge(c, routines);
    std::fprintf(known, "%s %s\n", findings.to_string().c_str(), c.identity.c_str());
    with_any += findings.any();
    for (std::size_t check = 0; check < check_count; ++check) {
      bool any = false;
      for (std::size_t i = 0; i < max_variants; ++i) any |= findings[check * max_variants + i];
      wrong[check] += any;
    }
  }
  if (std::fclose(known) != 0) throw std::runtime_error(std::string("cannot write ") + known_file);
  std::printf("%zu configurations; without a fault some check fails on %zu:", cases.size(),
              with_any);
  for (int check = 0; check < check_count; ++check) {
    if (wrong[check] > 0) std::printf(" %s %zu", check_name(check), wrong[check]);
  }
  std::printf("\n");
  if (judge_refusals(routines).any()) throw std::runtime_error("refusals are wrong");
  return 0;
}

int ask(const Routines& routines, const char* cases_file, const char* known_file, double pair) {
  const auto cases = read_cases(cases_file);
  std::FILE* known = std::fopen(known_file, "r");
  if (!known) throw std::runtime_error(std::string("cannot open ") + known_file);
  expect_an_end();
  if (const Findings findings = judge_refusals(routines); findings.any()) {
    print(findings, "refusals");
    return 1;
  }
  for (const Case& c : cases) {
    char bits[Findings().size() + 1], identity[400];
    if (std::fscanf(known, "%128s %399s", bits, identity) != 2 || c.identity != identity) {
      throw std::runtime_error(std::string(known_file) + " is of other cases: make it again");
    }
    if (pair >= 0 && c.raw.pair != pair) continue;
    expect_an_end();
    const Findings findings = judge(c, routines) & ~Findings(bits);
    if (!findings.any()) continue;
    print(findings, c.identity);
    return 1;
  }
  return 0;
}

int run(int count, char** words) {
  const auto is = [&](const char* command, int wanted) {
    return count >= wanted && std::strcmp(words[1], command) == 0;
  };
  if (is("cases", 5)) {
    write_cases(words[4], make_cases(words[2], std::strtoull(words[3], nullptr, 10)));
    return 0;
  }
  if (is("baseline", 5)) return write_baseline(load(words[2]), words[3], words[4]);
  if (is("ask", 5)) {
    return ask(load(words[2]), words[3], words[4], count > 5 ? std::atof(words[5]) : -1);
  }
  std::fprintf(stderr, "usage: see the head of probe.cpp\n");
  return 2;
}

}  // namespace
}  // namespace touchstone::mutation

int main(int count, char** words) {
  try {
    return touchstone::mutation::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mutation_probe: %s\n", error.what());
    return 2;
  }
}
