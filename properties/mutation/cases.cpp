#include "properties/mutation/cases.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/numbers.hpp"

namespace touchstone::mutation {
namespace {

Numbers3 numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

RawConfiguration raw(const Configuration& configuration) {
  const touchstone::Numbers n = numbers_of(configuration);
  RawConfiguration r;
  r.pair = static_cast<double>(n.pair);
  std::copy(n.sizes.begin(), n.sizes.end(), r.sizes.begin());
  r.position_a = numbers(n.position_a), r.position_b = numbers(n.position_b);
  const auto wxyz = [](const Eigen::Quaterniond& q) {
    return Numbers4{q.w(), q.x(), q.y(), q.z()};
  };
  r.orientation_a = wxyz(n.orientation_a), r.orientation_b = wxyz(n.orientation_b);
  r.normal = numbers(n.normal);
  r.displacement = n.displacement;
  return r;
}

namespace {

void add_patch(Case& result, const oracle::ContactPatch& patch, const Vec3& n, double leans) {
  KnownPatch known{numbers(n), leans, {}};
  const std::vector<Vec3> outline = patch.outline();
  constexpr std::size_t enough = 32;
  const std::size_t step = leans != 0 ? 1 + outline.size() / enough : 1;
  for (std::size_t i = 0; i < outline.size(); i += step) {
    known.outline.push_back(numbers(outline[i]));
  }
  result.patches.push_back(std::move(known));
}

/// What the manifold's points are to hold of bodies that lean: what lies well within its slack
/// (reference/manifold.hpp).
void add_leaning_patch(Case& result, const Configuration& c, const Vec3& n) {
  const double size_a = largest_half_extent(c.a), size_b = largest_half_extent(c.b);
  const double smaller = size_b > 0 ? std::min(size_a, size_b) : size_a;  // a plane has no size
  const double room =
      leaning_threshold * smaller_size(c) - static_cast<double>(result.signed_distance);
  const double slack = std::min(1e-3 * smaller, room);
  if (!(slack > 1e-6 * smaller)) return;
  const oracle::ContactPatch patch = oracle::contact_patch(c, n, slack / 8);
  if (patch.perimeter() < 0.1 * smaller_size(c)) return;
  add_patch(result, patch, n, 1);
}

Case make_case(const Identity& id) {
  using oracle::ContactPatch;
  const Configuration c = make_configuration(id);
  Case result{to_string(id), raw(c), 0, {}, {}};
  const oracle::Truth truth = oracle::truth(c);
  const mpq_class middle = (truth.signed_distance.lo + truth.signed_distance.hi) / 2;
  const double high = middle.get_d();
  const mpq_class rest = middle - high;
  result.signed_distance = static_cast<long double>(high) + rest.get_d();
  constexpr std::size_t max_normals = 4;
  for (const oracle::OptimalNormal& normal : truth.normals) {
    if (result.normals.size() == max_normals) break;
    result.normals.push_back(numbers(normal.n));
    const ContactPatch patch = oracle::contact_patch(c, normal);
    if (patch.kind() != ContactPatch::Kind::point) {
      add_patch(result, patch, normal.n, 0);
    } else if (truth.ties == oracle::Ties::unique) {
      add_leaning_patch(result, c, normal.n);
    }
  }
  return result;
}

// A flat row of doubles: numbers of all kinds, a string as its length and characters.
class Writer {
 public:
  explicit Writer(std::FILE* file) : file_(file) {}
  void add(double x) { std::fwrite(&x, sizeof x, 1, file_); }
  template <std::size_t n>
  void add(const std::array<double, n>& all) {
    for (const double x : all) add(x);
  }
  template <class Range>
  void add_all(const Range& range) {
    add(static_cast<double>(range.size()));
    for (const auto& x : range) add(x);
  }

 private:
  std::FILE* file_;
};

class Reader {
 public:
  explicit Reader(std::FILE* file) : file_(file) {}
  bool read(double& x) { return std::fread(&x, sizeof x, 1, file_) == 1; }
  double number() {
    double x = 0;
    if (!read(x)) throw std::runtime_error("the file of truths ends early: make it again");
    return x;
  }
  template <std::size_t n>
  void read(std::array<double, n>& all) {
    for (double& x : all) x = number();
  }
  std::vector<Numbers3> vectors() {
    std::vector<Numbers3> all(static_cast<std::size_t>(number()));
    for (Numbers3& v : all) read(v);
    return all;
  }

 private:
  std::FILE* file_;
};

std::FILE* opened(const std::string& file, const char* mode) {
  std::FILE* f = std::fopen(file.c_str(), mode);
  if (!f) throw std::runtime_error("cannot open " + file);
  return f;
}

void write(Writer& out, const Case& c) {
  out.add_all(c.identity);
  const RawConfiguration& r = c.raw;
  out.add(r.pair), out.add(r.sizes), out.add(r.position_a), out.add(r.position_b);
  out.add(r.orientation_a), out.add(r.orientation_b), out.add(r.normal), out.add(r.displacement);
  const auto high = static_cast<double>(c.signed_distance);
  out.add(high), out.add(static_cast<double>(c.signed_distance - high));
  out.add_all(c.normals);
  out.add(static_cast<double>(c.patches.size()));
  for (const KnownPatch& p : c.patches) {
    out.add(p.normal), out.add(p.leans), out.add_all(p.outline);
  }
}

constexpr std::uint64_t seed = case_seed;

}  // namespace

void write_cases(const std::string& file, const std::string& net, std::uint64_t count) {
  std::FILE* f = opened(file, "wb");
  Writer out(f);
  for (std::uint64_t i = 0; i < count; ++i) {
    for (const Pair pair : all_pairs) {
      if (net == "hostile") {
        const bool has_search = pair != Pair::plane && pair != Pair::sphere;
        if (has_search || i % 8 == 0) write(out, make_case({pair, "hostile", seed, i}));
        continue;
      }
      for (const std::string& name : pose_classes(pair)) {
        write(out, make_case({pair, name, seed, i}));
      }
    }
  }
  if (std::fclose(f) != 0) throw std::runtime_error("cannot write " + file);
}

CaseReader::CaseReader(const std::string& file) : file_(opened(file, "rb")) {}

bool CaseReader::next(Case& c) {
  Reader in(file_);
  double length = 0;
  if (!in.read(length)) return false;
  c = Case{};
  for (int i = 0; i < length; ++i) c.identity += static_cast<char>(in.number());
  RawConfiguration& r = c.raw;
  r.pair = in.number();
  in.read(r.sizes), in.read(r.position_a), in.read(r.position_b);
  in.read(r.orientation_a), in.read(r.orientation_b), in.read(r.normal);
  r.displacement = in.number();
  const long double high = in.number();
  c.signed_distance = high + in.number();
  c.normals = in.vectors();
  c.patches.resize(static_cast<std::size_t>(in.number()));
  for (KnownPatch& p : c.patches) {
    in.read(p.normal), p.leans = in.number(), p.outline = in.vectors();
  }
  return true;
}

}  // namespace touchstone::mutation
