// How good is the net? Asks a library of routines in which a fault may be planted, and stops at the
// first answer that is wrong (verification/mutation/mutation_score.py).
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
#include <map>
#include <stdexcept>
#include <sys/time.h>

#include "verification/mutation/judge.hpp"

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

/// Hostile configurations of each pair with a search that are asked without their truths.
constexpr int first_pair_with_search = 2, pair_count = 6;

/// Calls visit(case, whether it has its truth) until that is false: the cases of the file, then
/// `more` of each pair without truths.
template <class Visit>
void visit_cases(const char* file, std::uint64_t more, double pair, Visit visit) {
  CaseReader reader(file);
  for (Case c; reader.next(c);) {
    if (!visit(c, true)) return;
  }
  for (std::uint64_t i = 0; i < more; ++i) {
    for (int p = first_pair_with_search; p < pair_count; ++p) {
      if (pair >= 0 && p != pair) continue;
      if (!visit(without_truth(p, i), false)) return;
    }
  }
}

Findings judged(const Case& c, bool has_truth, const Routines& routines) {
  return has_truth ? judge(c, routines) : judge_agreement(c, routines);
}

int write_baseline(const Routines& routines, const char* cases_file, const char* known_file,
                   std::uint64_t more) {
  std::FILE* known = std::fopen(known_file, "w");
  if (!known) throw std::runtime_error(std::string("cannot open ") + known_file);
  std::size_t wrong[check_count] = {}, count = 0, with_any = 0;
  visit_cases(cases_file, more, -1, [&](const Case& c, bool has_truth) {
    const Findings findings = judged(c, has_truth, routines);
    ++count;
    if (findings.none()) return true;
    std::fprintf(known, "%s %s\n", findings.to_string().c_str(), c.identity.c_str());
    ++with_any;
    for (std::size_t check = 0; check < check_count; ++check) {
      bool any = false;
      for (std::size_t i = 0; i < max_variants; ++i) any |= findings[check * max_variants + i];
      wrong[check] += any;
    }
    return true;
  });
  if (std::fclose(known) != 0) throw std::runtime_error(std::string("cannot write ") + known_file);
  std::printf("%zu configurations; without a fault some check fails on %zu:", count, with_any);
  for (int check = 0; check < check_count; ++check) {
    if (wrong[check] > 0) std::printf(" %s %zu", check_name(check), wrong[check]);
  }
  std::printf("\n");
  if (judge_refusals(routines).any()) throw std::runtime_error("refusals are wrong");
  return 0;
}

std::map<std::string, Findings> read_known(const char* file) {
  std::FILE* f = std::fopen(file, "r");
  if (!f) throw std::runtime_error(std::string("cannot open ") + file);
  std::map<std::string, Findings> known;
  char bits[Findings().size() + 1], identity[400];
  static_assert(Findings().size() == 144);
  while (std::fscanf(f, "%144s %399s", bits, identity) == 2) known[identity] = Findings(bits);
  std::fclose(f);
  return known;
}

/// Whether it is answered wrongly without any fault: other wrong answers tell nothing then.
bool is_wrong_anyway(const Findings& known) {
  constexpr Check answers[] = {Check::finite,   Check::distance,  Check::regret,
                               Check::overlaps, Check::threshold, Check::clearance,
                               Check::exchange, Check::agreement};
  for (const Check check : answers) {
    for (std::size_t i = 0; i < max_variants; ++i) {
      if (known[static_cast<std::size_t>(check) * max_variants + i]) return true;
    }
  }
  return false;
}

int ask(const Routines& routines, const char* cases_file, const char* known_file,
        std::uint64_t more, double pair) {
  const auto known = read_known(known_file);
  expect_an_end();
  if (const Findings findings = judge_refusals(routines); findings.any()) {
    print(findings, "refusals");
    return 1;
  }
  int result = 0;
  visit_cases(cases_file, more, pair, [&](const Case& c, bool has_truth) {
    if (pair >= 0 && c.raw.pair != pair) return true;
    expect_an_end();
    Findings findings;
    try {
      findings = judged(c, has_truth, routines);
    } catch (const std::exception& error) {
      std::printf("exception (%s) %s\n", error.what(), c.identity.c_str());
      result = 1;
      return false;
    }
    if (findings.none()) return true;
    if (const auto found = known.find(c.identity); found != known.end()) {
      if (is_wrong_anyway(found->second)) return true;
      findings &= ~found->second;
    }
    if (findings.none()) return true;
    print(findings, c.identity);
    result = 1;
    return false;
  });
  return result;
}

int run(int count, char** words) {
  const auto is = [&](const char* command, int wanted) {
    return count >= wanted && std::strcmp(words[1], command) == 0;
  };
  const auto number = [&](int i) { return std::strtoull(words[i], nullptr, 10); };
  if (is("cases", 5)) {
    write_cases(words[4], words[2], number(3));
    return 0;
  }
  if (is("baseline", 6)) return write_baseline(load(words[2]), words[3], words[4], number(5));
  if (is("ask", 7)) {
    return ask(load(words[2]), words[3], words[4], number(5), std::atof(words[6]));
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
