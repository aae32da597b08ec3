#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reports/report_members.hpp"
#include "reports/stability/stability.hpp"

namespace touchstone {

// What the parts of stability.json consist of (json_members.hpp). docs/stability.schema.json says
// what each member means. Numbers are as tables show them, and are written only.

/// Two significant digits (short_number).
struct ShortNumber {
  double value;
};
nlohmann::json to_json(ShortNumber number);
inline std::optional<ShortNumber> shortened(const std::optional<double>& x) {
  return x ? std::optional(ShortNumber{*x}) : std::nullopt;
}
inline std::optional<double> rounded_up(const std::optional<double>& ratio) {
  return ratio ? std::optional(rounded_up(*ratio)) : std::nullopt;
}
inline ByAmplitude<std::optional<double>> rounded_up(ByAmplitude<std::optional<double>> ratios) {
  for (auto& ratio : ratios) ratio = rounded_up(ratio);
  return ratios;
}
inline auto shortened(const ByAmplitude<std::optional<double>>& values) {
  ByAmplitude<std::optional<ShortNumber>> result;
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = shortened(values[i]);
  return result;
}

void members(OfFiles auto& a, Amplification::Row& r) {
  a.named("pair", r.pair, rule::pair);
  a.named("class", r.pose_class);
  a.named("candidate", r.candidate);
  a.named("amplification", rounded_up(r.amplification), rule::not_negative);
  a.named("jump", shortened(r.jump));
  a.named("hull_excess", shortened(r.hull_excess));
  a.named("regret", shortened(r.regret));
  a.named("points_changed", r.points_changed, rule::not_negative);
  a.named("missed", r.missed, rule::not_negative);
  a.named("unanswered", r.unanswered, rule::not_negative);
}
void members(OfFiles auto& a, Amplification::TruthRow& r) {
  a.named("pair", r.pair, rule::pair);
  a.named("class", r.pose_class);
  a.named("amplification", rounded_up(r.amplification), rule::not_negative);
}
void members(OfFiles auto& a, Amplification::WorstStep& w) {
  a.named("pair", w.pair, rule::pair);
  a.named("class", w.pose_class);
  a.named("candidate", w.candidate);
  constexpr Rule measure{.one_of = [] {
    return std::vector<std::string>{"amplification", "hull_excess"};
  }};
  a.named("measure", w.measure, measure);
  a.named("value", w.value);
  a.named("from", w.from);
  a.named("to", w.to);
}
void members(OfFiles auto& a, Amplification& x) {
  ByAmplitude<double> amplitudes;
  for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] = amplitude(i).value();
  a.named("amplitudes", amplitudes, rule::positive);
  a.named("seed", x.seed);
  a.named("count", x.count);
  a.named("results", x.results);
  a.named("truth", x.truth);
  a.named("worst", x.worst);
}

/// "289." for 289 dots, "3m2." for mmm..
std::string run_lengths(const std::string& letters);

void members(OfFiles auto& a, FailureMaps::Picture& p) {
  a.named("candidate", p.candidate);
  std::vector<std::string> maps;
  for (const std::string& letters : p.letters) maps.push_back(run_lengths(letters));
  a.named("maps", maps);
}
void members(OfFiles auto& a, FailureMaps::Pose& p) {
  a.named("pose", p.name);
  a.named("description", p.description);
  a.named("pair", p.pair, rule::pair);
  a.named("columns", p.columns);
  a.named("rows", p.rows);
  a.named("results", p.pictures);
}
void members(OfFiles auto& a, FailureMaps& m) {
  a.named("reach", map_reach, rule::not_negative);
  a.named("stride", m.stride, rule::from_one);
  std::vector<std::string> zooms;
  for (const Decade& zoom : m.zooms) zooms.push_back(zoom.name());
  a.named("zooms", zooms);
  constexpr Rule meanings{.one_of = [] {
    std::vector<std::string> all;
    for (const MapLetter& l : map_letters) all.emplace_back(l.meaning);
    return all;
  }};
  std::map<char, std::string> letters;
  for (const MapLetter& l : map_letters) letters[l.letter] = l.meaning;
  a.named("letters", letters, meanings);
  a.named("poses", m.poses);
}

void members(OfFiles auto& a, Sequences::Peak& p) {
  a.named("value", ShortNumber{p.value});
  a.named("step", p.step, rule::not_negative);
}
void members(OfFiles auto& a, Sequences::Row& r) {
  a.named("candidate", r.candidate);
  a.named("amplification", rounded_up(r.amplification), rule::not_negative);
  a.named("jump", r.jump);
  a.named("hull", r.hull);
  a.named("hull_excess", r.hull_excess);
  a.named("points_changed", r.points_changed, rule::not_negative);
  a.named("missed", r.missed, rule::not_negative);
  a.named("wrong", r.wrong, rule::not_negative);
  a.named("unanswered", r.unanswered, rule::not_negative);
}
struct LargestTrueChanges {
  ShortNumber depth, patch;
};
void members(OfFiles auto& a, LargestTrueChanges& t) {
  a.named("depth", t.depth);
  a.named("patch", t.patch);
}
void members(OfFiles auto& a, Sequences::Course& c) {
  a.named("motion", c.motion);
  a.named("description", c.description);
  a.named("pair", c.pair, rule::pair);
  a.named("displacement", ShortNumber{c.displacement});
  a.named("truth", LargestTrueChanges{{c.true_depth_change}, {c.true_patch_movement}});
  a.named("results", c.results);
}
void members(OfFiles auto& a, Sequences& s) {
  a.named("steps", s.steps, rule::not_negative);
  a.named("motions", s.motions);
}

void members(OfFiles auto& a, Stability& s) {
  a.named("candidates", s.candidates);
  a.named("tolerance", s.tolerance, rule::positive);
  a.named("threshold", s.threshold, rule::not_negative);
  a.named("amplification", s.amplification, When::filled);
  a.named("maps", s.maps, When::filled);
  a.named("sequences", s.sequences, When::filled);
}

}  // namespace touchstone
