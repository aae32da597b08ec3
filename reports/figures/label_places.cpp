#include "reports/figures/label_places.hpp"

#include <algorithm>
#include <numeric>

namespace touchstone {
namespace {

struct Rectangle {
  double left, bottom, right, top;
  bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && bottom < o.top && o.bottom < top;
  }
};

constexpr LabelPlace choices[] = {{true, 1, 0},      {false, -1, 0},     {true, 0.6, 0.8},
                                  {true, 0.6, -0.8}, {false, -0.6, 0.8}, {false, -0.6, -0.8}};

Rectangle text_at(const Label& l, const LabelPlace& p) {
  const double end = l.x + p.dx, other = end + (p.rightwards ? l.length : -l.length);
  return {std::min(end, other), l.y + p.dy - 0.5, std::max(end, other), l.y + p.dy + 0.5};
}

}  // namespace

std::vector<std::optional<LabelPlace>> label_places(const std::vector<Label>& labels, double width,
                                                    double height) {
  const Rectangle chart{0, -0.5, width, height + 1.5};  // a line more, below the title
  std::vector<Rectangle> taken;
  for (const Label& l : labels) taken.push_back({l.x - 0.7, l.y - 0.35, l.x + 0.7, l.y + 0.35});
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return labels[i].important; });
  std::vector<std::optional<LabelPlace>> result(labels.size());
  for (const std::size_t i : order) {
    // How bad a place is: what it lies on, and what of it is cut off.
    const auto badness = [&](const LabelPlace& p) {
      const Rectangle text = text_at(labels[i], p);
      const auto hits = std::count_if(taken.begin(), taken.end(),
                                      [&](const Rectangle& r) { return r.meets(text); });
      const bool cut = text.left < chart.left || text.right > chart.right ||
                       text.bottom < chart.bottom || text.top > chart.top;
      return hits + (cut ? 100 : 0);
    };
    const LabelPlace* best = std::min_element(
        std::begin(choices), std::end(choices),
        [&](const LabelPlace& a, const LabelPlace& b) { return badness(a) < badness(b); });
    if (badness(*best) > 0 && !labels[i].important) continue;
    result[i] = *best;
    taken.push_back(text_at(labels[i], *best));
  }
  return result;
}

}  // namespace touchstone
