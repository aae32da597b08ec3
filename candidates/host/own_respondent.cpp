#include "candidates/host/own_respondent.hpp"

#include <algorithm>
#include <array>
#include <dlfcn.h>
#include <stdexcept>

#include "candidates/host/respondent.hpp"
#include "candidates/host/routine.hpp"

namespace touchstone {
namespace {

const ts_plugin& load(const Candidate& candidate) {
  const Candidate::Plugin& plugin = *candidate.plugin();
  void* const library = dlopen(plugin.file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = library ? dlsym(library, "touchstone_plugin") : nullptr;
  if (!entry) throw std::runtime_error(dlerror());
  return *reinterpret_cast<decltype(&touchstone_plugin)>(entry)();
}

class OwnRespondent : public Respondent {
 public:
  OwnRespondent(const Candidate& candidate, const ts_plugin& plugin)
      : routine_(plugin.candidates[candidate.plugin()->index], plugin.roundings, candidate.value) {}
  ~OwnRespondent() override { routine_.release_all(); }
  OwnRespondent(const OwnRespondent&) = delete;
  OwnRespondent& operator=(const OwnRespondent&) = delete;

  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool /*release*/,
                              std::span<std::optional<Answer>> answers) override {
    for (std::size_t i = 0; i < asked.size(); ++i) {
      Answer& answer = answers[i].emplace();
      routine_.ask(question_of(asked[i]), answer).copy_to(answer);
    }
    return std::nullopt;
  }
  void end_session() override { routine_.release_all(); }

 private:
  Routine routine_;
};

}  // namespace

bool is_own(const Candidate& candidate) {
  constexpr std::array own = {"touchstone-reference.so", "touchstone-simplified.so",
                              "touchstone-box-parts.so"};
  const Candidate::Plugin* const plugin = candidate.plugin();
  return plugin && !candidate.added && plugin->file.parent_path() == standard_folder() &&
         std::ranges::find(own, plugin->file.filename()) != own.end();
}

Candidate asked_here(const Candidate& candidate) {
  Candidate here = candidate;
  here.origin = [candidate](const Limits&) -> std::unique_ptr<Respondent> {
    return std::make_unique<OwnRespondent>(candidate, load(candidate));
  };
  return here;
}

}  // namespace touchstone
