// Enumerates the sites of critical directions and drops those that double intervals exclude.
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <optional>

#include "oracle/critical_direction.hpp"
#include "oracle/curve_search.hpp"

namespace touchstone::oracle {
namespace {

using Kind = CriticalSite::Kind;

/// Index of the disc that is not perpendicular to this segment and no point, if there is one.
std::optional<unsigned> tilted_disc(const Difference& difference, unsigned segment) {
  for (unsigned i = 0; i < difference.discs.size(); ++i) {
    const Difference::Disc& disc = difference.discs[i];
    if (disc.radius == 0) continue;
    if (!parallel(disc.frame.axis, difference.segments[segment].frame.axis)) return i;
  }
  return std::nullopt;
}

class Search {
 public:
  Search(const Difference& difference, double slack);
  std::vector<CriticalSite> run();

 private:
  void search_directions();
  void search_rim_vertices();
  void search_radial();
  void search_curves();
  void search_hull();
  void search_vertices();
  void search_edges(const std::vector<IntervalVector>& normals);
  void close_pieces();
  std::vector<CriticalSite> curve_sites() const;
  void isolate(const CriticalSite& site, std::vector<CriticalSite>& out);
  bool isolate_line(const CriticalSite& site);
  bool isolate_rims(const CriticalSite& site);

  const Difference& exact_;
  CGAL::Protect_FPU_rounding<true> rounding_;
  IntervalDifference difference_;
  GapThreshold threshold_;
  struct Direction {
    CriticalSite site;
    Interval gap;
  };
  // One disc axis, six crossings of four segments, and sixteen vertices; or two disc axes and one
  // crossing; or those of a hull.
  boost::container::small_vector<Direction, 24> directions_;

  // Curves: the circle perpendicular to each segment or the arc of each edge of a hull, then the
  // rim pairs at each vertex.
  boost::container::small_vector<LineSearch, max_segments> lines_;
  boost::container::static_vector<RimSearch, 4> rims_;
  struct OpenPiece {
    Piece piece;
    LineSearch::Open vertices;  // of a line
  };
  // Enough for poses without a degeneracy.
  boost::container::small_vector<OpenPiece, 256> pieces_, next_;
  std::vector<SlopeBracket> brackets_;  // of one site
};

Search::Search(const Difference& difference, double slack)
    : exact_(difference),
      difference_(difference),
      threshold_(Interval(slack) * difference_.metre) {}

void Search::search_directions() {
  const auto add = [&](const CriticalSite& site, const IntervalVector& n) {
    const auto [forth, back] = exact_.hull ? difference_.gaps_of_hull(n) : difference_.gaps(n);
    threshold_.raise(forth);
    threshold_.raise(back);
    directions_.push_back({site, max(forth, back)});
  };
  for (unsigned i = 0; i < difference_.discs.size(); ++i) {
    add({Kind::disc_axis, i}, difference_.discs[i].frame.axis);
  }
  const auto& segments = difference_.segments;
  for (unsigned i = 0; i < segments.size(); ++i) {
    for (unsigned j = 0; j < i; ++j) {
      add({Kind::crossing, j, i}, cross(segments[j].frame.axis, segments[i].frame.axis));
    }
  }
}

void Search::search_rim_vertices() {
  if (difference_.discs.size() != 1) return;
  const auto& disc = difference_.discs.front();
  for (unsigned signs = 0; signs < 1U << difference_.segments.size(); ++signs) {
    const IntervalVector q = reduced_point(difference_, signs);
    const IntervalVector across = off_axis(q, disc.frame);
    const Interval length = norm(across);
    if ((length - disc.radius).sup() < 0) continue;
    const IntervalVector n = q - (disc.radius / length) * across;
    const Interval gap = difference_.gaps(n).forth;
    threshold_.raise(gap);
    directions_.push_back({{Kind::rim_vertex, 0, 0, signs}, gap});
  }
}

constexpr int first_pieces = 4;  // per turn of a curve
constexpr int max_splits = 5;

/// With a single segment the only disc is perpendicular to it: no curve needs to be searched.
void Search::search_radial() {
  const IntervalVector n = off_axis(difference_.d, difference_.segments.front().frame);
  const Interval gap = difference_.gaps(n).forth;
  threshold_.raise(gap);
  directions_.push_back({{Kind::radial, 0}, gap});
}

void Search::search_curves() {
  for (unsigned i = 0; i < difference_.segments.size(); ++i) {
    lines_.emplace_back(difference_, exact_, i, tilted_disc(exact_, i));
  }
  if (difference_.discs.size() == 2) {
    for (unsigned signs = 0; signs < 4; ++signs) rims_.emplace_back(difference_, signs);
  }
  const auto add = [&](unsigned curve) {
    for (unsigned turn = 0; turn < 2; ++turn) {
      for (int i = 0; i < first_pieces; ++i) {
        constexpr double width = 2.0 / first_pieces;
        pieces_.push_back({{curve, turn, -1 + i * width, -1 + (i + 1) * width}, {1, 1}});
      }
    }
  };
  // Two turns of a line: the other two are opposite.
  for (unsigned i = 0; i < lines_.size() + rims_.size(); ++i) add(i);
  close_pieces();
}

/// Splits what stays open of the curves' pieces.
void Search::close_pieces() {
  for (int split = 0;; ++split) {
    next_.clear();
    for (OpenPiece& open : pieces_) {
      const Piece& piece = open.piece;
      if (piece.curve < lines_.size()) {
        open.vertices = lines_[piece.curve].open_vertices(piece, open.vertices, threshold_);
        if (open.vertices.forth == 0 && open.vertices.back == 0) continue;
      } else if (!rims_[piece.curve - lines_.size()].is_open(piece, threshold_)) {
        continue;
      }
      next_.push_back(open);
    }
    pieces_.clear();
    if (split == max_splits) break;
    for (const OpenPiece& open : next_) {
      const auto& [curve, turn, lo, hi] = open.piece;
      const double middle = (lo + hi) / 2;
      pieces_.push_back({{curve, turn, lo, middle}, open.vertices});
      pieces_.push_back({{curve, turn, middle, hi}, open.vertices});
    }
  }
}

/// The normals of the hull's faces, and what its vertices and edges have as normals.
void Search::search_hull() {
  const Difference::Hull& hull = *exact_.hull;
  std::vector<IntervalVector> normals;
  for (unsigned i = 0; i < hull.body.faces().size(); ++i) {
    const IntervalVector& n =
        normals.emplace_back(scaled_direction(face_normal(hull, static_cast<int>(i))));
    const int corner = hull.body.faces()[i].vertices.front();
    const Interval gap = difference_.gap_of_vertex(difference_.vertices[corner], n);
    threshold_.raise(gap);
    directions_.push_back({{Kind::face, i}, gap});
  }
  search_vertices();
  search_edges(normals);
  close_pieces();
}

/// The sides and the rims of A towards each vertex, where no neighbour of it is higher.
void Search::search_vertices() {
  const auto& vertices = difference_.vertices;
  std::vector<std::vector<int>> neighbours(vertices.size());
  for (const Convex::Edge& edge : exact_.hull->body.edges()) {
    const auto& [from, to] = edge.vertices;
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
  const auto add = [&](const CriticalSite& site, const IntervalVector& n) {
    const IntervalVector& vertex = vertices[site.second];
    const Interval gap = difference_.gap_of_vertex(vertex, n);
    if (threshold_.is_above(gap)) return;
    bool is_highest = true;
    for (const int other : neighbours[site.second]) {
      const Interval above = dot(vertex - vertices[other], n);
      if (above.sup() < 0) return;
      is_highest = is_highest && above.inf() >= 0;
    }
    if (is_highest) threshold_.raise(gap);
    directions_.push_back({site, gap});
  };
  const auto& disc = difference_.discs.front();
  const auto& side = difference_.segments.front();
  for (unsigned i = 0; i < vertices.size(); ++i) {
    const IntervalVector q = difference_.d - vertices[i], across{q.x, q.y, 0};
    const Interval length = norm(across);
    add({Kind::radial, 0, i}, across);
    if ((length - disc.radius).sup() < 0) continue;
    for (const unsigned signs : {0U, 1U}) {
      const Interval end = signs == 1 ? side.half_length : -side.half_length;
      const IntervalVector n = q - end * side.frame.axis - (disc.radius / length) * across;
      add({Kind::rim_vertex, 0, i, signs}, n);
    }
  }
}

/// The crossing of A's axis with each edge, and the pieces of its arc.
void Search::search_edges(const std::vector<IntervalVector>& normals) {
  const Difference::Hull& hull = *exact_.hull;
  for (unsigned i = 0; i < hull.body.edges().size(); ++i) {
    const Convex::Edge& edge = hull.body.edges()[i];
    const IntegerVector along = edge_vector(hull, static_cast<int>(i));
    if (along.x == 0 && along.y == 0) continue;  // the radial directions of its vertices
    const IntervalVector& vertex = difference_.vertices[edge.vertices[0]];
    const auto curve_of_edge = static_cast<unsigned>(lines_.size());
    const LineSearch& line = lines_.emplace_back(difference_, exact_, i, along,
                                                 exact_.d - hull.vertices[edge.vertices[0]],
                                                 normals[edge.faces[0]], normals[edge.faces[1]]);
    const IntervalVector crossing = scaled_direction({-along.y, along.x, 0});
    for (unsigned turn = 0; turn < 4; ++turn) {
      const auto [curve, of_turn, lo, hi] = line.in_arc(turn);
      if (!(lo <= hi)) continue;
      if (turn % 2 == 0 && lo <= 0 && 0 <= hi) {
        const Interval gap = difference_.gap_of_vertex(vertex, turn == 0 ? crossing : -crossing);
        directions_.push_back({{Kind::crossing, 0, i}, gap});
      }
      const int pieces = hi - lo > 0.5 ? first_pieces : 1;
      for (int k = 0; k < pieces; ++k) {
        const double width = (hi - lo) / pieces, from = lo + k * width;
        pieces_.push_back(
            {{curve_of_edge, turn, from, k + 1 == pieces ? hi : from + width}, {1, 0}});
      }
    }
  }
}

/// Inserts a zero bit for `segment` into the signs of the other segments.
unsigned all_signs(unsigned others, unsigned segment) {
  const unsigned below = others & ((1U << segment) - 1);
  return below | (others & ~((1U << segment) - 1)) << 1;
}

/// The inverse: removes the bit of `segment`.
unsigned other_signs(unsigned signs, unsigned segment) {
  const unsigned below = signs & ((1U << segment) - 1);
  return below | (signs >> 1 & ~((1U << segment) - 1));
}

/// The open pieces of curves as sites; adjacent ones of one curve at one vertex become one site.
std::vector<CriticalSite> Search::curve_sites() const {
  std::vector<CriticalSite> sites;
  const auto extend = [&](const CriticalSite& site) {
    for (auto& known : sites) {
      if (known.kind == site.kind && known.first == site.first && known.signs == site.signs &&
          known.turn == site.turn && known.hi == site.lo) {
        known.hi = site.hi;
        return;
      }
    }
    sites.push_back(site);
  };
  const auto add = [&](const Piece& piece, unsigned turn, unsigned long vertices) {
    const LineSearch& line = lines_[piece.curve];
    for (unsigned v = 0; v < 1U << line.others(); ++v) {
      if (!(vertices >> v & 1UL)) continue;
      // Of a hull, A's axis is the only segment.
      const unsigned signs = exact_.hull ? v : all_signs(v, piece.curve);
      if (line.tilted_disc()) {
        extend({Kind::rim_line, line.line(), *line.tilted_disc(), signs, turn, piece.lo, piece.hi,
                line.heading()});
      } else {
        // One rational direction serves the whole circle.
        extend({Kind::radial, line.line(), 0, signs});
      }
    }
  };
  for (unsigned curve = 0; curve < lines_.size(); ++curve) {
    for (const auto& [piece, vertices] : next_) {
      if (piece.curve == curve) add(piece, piece.turn, vertices.forth);
    }
    for (const auto& [piece, vertices] : next_) {
      if (piece.curve == curve) add(piece, piece.turn + 2, vertices.back);
    }
  }
  for (const auto& [piece, vertices] : next_) {
    if (piece.curve < lines_.size()) continue;
    const auto signs = static_cast<unsigned>(piece.curve - lines_.size());
    extend({Kind::rim_rim, 0, 1, signs, piece.turn, piece.lo, piece.hi});
  }
  return sites;
}

bool Search::isolate_line(const CriticalSite& site) {
  const LineSearch& line = *std::find_if(
      lines_.begin(), lines_.end(), [&](const LineSearch& l) { return l.line() == site.first; });
  const unsigned vertex = exact_.hull ? site.signs : other_signs(site.signs, site.first);
  for (const int branch : {1, -1}) {
    if (!isolate_slope_roots(line.slope(vertex, branch), branch,
                             {site.first, site.turn, site.lo, site.hi}, brackets_)) {
      return false;
    }
  }
  std::erase_if(brackets_, [&](const SlopeBracket& b) {
    return !line.reaches({site.first, site.turn, b.lo, b.hi}, threshold_);
  });
  return true;
}

bool Search::isolate_rims(const CriticalSite& site) {
  return isolate_slope_roots(rims_[site.signs].slope(1), 1,
                             {site.first, site.turn, site.lo, site.hi}, brackets_);
}

/// Replaces a piece of a curve by brackets of the roots in it that reach the threshold, if double
/// intervals separate all of them.
void Search::isolate(const CriticalSite& site, std::vector<CriticalSite>& out) {
  brackets_.clear();
  const bool is_line = site.kind == Kind::rim_line, is_rims = site.kind == Kind::rim_rim;
  if (!(is_line && isolate_line(site)) && !(is_rims && isolate_rims(site))) {
    out.push_back(site);
    return;
  }
  std::sort(brackets_.begin(), brackets_.end(),
            [](const SlopeBracket& a, const SlopeBracket& b) { return a.lo + a.hi < b.lo + b.hi; });
  for (const SlopeBracket& bracket : brackets_) {
    CriticalSite root = site;
    root.lo = bracket.lo;
    root.hi = bracket.hi;
    root.branch = bracket.branch;
    root.rising = bracket.rising;
    out.push_back(root);
  }
}

std::vector<CriticalSite> Search::run() {
  search_directions();
  if (exact_.hull) {
    search_hull();
  } else {
    search_rim_vertices();
    if (difference_.segments.size() == 1) {
      search_radial();
    } else {
      search_curves();
    }
  }

  std::vector<CriticalSite> sites;
  for (const auto& [site, gap] : directions_) {
    if (!threshold_.is_above(gap)) sites.push_back(site);
  }
  for (const CriticalSite& site : curve_sites()) isolate(site, sites);
  return sites;
}

}  // namespace

std::vector<CriticalSite> critical_sites(const Difference& difference, double slack) {
  return Search(difference, slack).run();
}

}  // namespace touchstone::oracle
