#include "reports/test_data/test_data.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/files/bytes.hpp"

namespace touchstone {

AnswerLimits answer_limits(const Configuration& c, const oracle::Truth& truth, const Bar& bar) {
  const double size = error_size(c, bar), slack = bar.tolerance * size;
  const double distance = truth.signed_distance.midpoint();
  using Contact = AnswerLimits::Contact;
  const Contact contact = distance < -slack                  ? Contact::required
                          : distance > bar.threshold + slack ? Contact::forbidden
                                                             : Contact::optional;
  return {contact, distance - slack, distance + slack, slack, -(bar.threshold + slack)};
}

const char* contact_name(AnswerLimits::Contact contact) {
  constexpr std::array names = {"required", "optional", "forbidden"};
  return names[static_cast<std::size_t>(contact)];
}

double midpoint_error(const oracle::Enclosure& e) {
  const mpq_class middle(e.midpoint());
  const mpq_class error = std::max<mpq_class>(e.hi - middle, middle - e.lo);
  const double rounded = error.get_d();  // towards zero
  if (mpq_class(rounded) == error) return rounded;
  return std::nextafter(rounded, std::numeric_limits<double>::infinity());
}

Campaign suite_1() {
  Campaign c;
  c.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
  c.coverage = Coverage::suite_1;
  c.count = 3;
  c.everyday_times = 5;
  c.seed = 1;
  return c;
}

std::vector<Identity> identities(const Campaign& campaign) {
  std::vector<Identity> result;
  for (const PoseClass& cell : cells(campaign)) {
    for (std::uint64_t i = 0; i < count_of(campaign, cell); ++i) {
      result.push_back({cell, campaign.seed, i});
    }
  }
  return result;
}

namespace {

oracle::Truth truth_of(const Identity& identity, const Configuration& c) {
  try {
    return oracle::truth(c, truth_width);
  } catch (const std::exception& e) {
    throw std::runtime_error(to_string(identity) + ": " + e.what());
  }
}

}  // namespace

void make_test_data(const Campaign& campaign, const std::function<void(const TestDatum&)>& take) {
  const std::vector<Identity> all = identities(campaign);
  constexpr std::uint64_t unit = 32;
  Progress progress("configurations", all.size());
  std::uint64_t next = 0;
  const auto last_of = [&](std::uint64_t first) {
    return std::min<std::uint64_t>(first + unit, all.size());
  };
  const auto take_unit = [&](const std::string& bytes) {
    BytesIn in(bytes);
    for (const std::uint64_t last = last_of(next); next < last; ++next) {
      const auto c = in.next<Configuration>();
      const auto truth = in.next<oracle::Truth>();
      take({all[next], c, truth, answer_limits(c, truth, campaign.bar)});
    }
    progress.update(next);
  };
  const auto make_unit = [&](std::uint64_t number) {
    BytesOut out;
    for (std::uint64_t i = number * unit; i < last_of(number * unit); ++i) {
      const Configuration c = make_configuration(all[i]);
      out(c, truth_of(all[i], c));
    }
    return out.take();
  };
  stream_in_order((all.size() + unit - 1) / unit, campaign.workers, make_unit,
                  [&](std::uint64_t number) { return to_string(all[number * unit]); }, take_unit,
                  [] { return !interrupted(); });
}

}  // namespace touchstone
