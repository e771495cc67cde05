#include <algorithm>
#include <cmath>

#include "events/catalogue/fault_geometry.hpp"
#include "events/catalogue/fsp/fsp.hpp"

namespace slipfront::catalogue::fsp {
namespace {

/// Whether positions are those of upper edges. The depth of the upper edge of the segment decides. If it does not, the
/// text of the file decides. Files that give neither have centres.
bool are_tops(const FaultSegment& segment, std::optional<double> top, std::optional<bool> stated) {
  const double half = *segment.cell_width / 2 * std::sin(radians(*segment.dip));
  double shallowest = HUGE_VAL;
  for (const FaultPatch& p : segment.patches) shallowest = std::fmin(shallowest, p.depth);
  if (top && half > 2 * least_gap) {
    const double below = (shallowest - m_per_km * *top) / half;
    if (std::fabs(below) < 0.25) return true;
    if (std::fabs(below - 1) < 0.25) return false;
  }
  return stated.value_or(false);
}

/// Whether latitude and longitude contradict `east` and `north`, and agree if these two are exchanged. Most older files
/// of SRCMOD have the titles X==NS and Y==EW over columns that are the other way round.
bool are_exchanged(const std::vector<FaultPatch>& patches) {
  const FaultPatch& first = patches.front();
  double as_titled = 0, exchanged = 0;
  for (const FaultPatch& p : patches) {
    const double x = p.east - first.east, y = p.north - first.north;
    const double north = m_per_degree * (p.latitude - first.latitude);
    const double east =
        m_per_degree * std::cos(radians(p.latitude)) * std::remainder(p.longitude - first.longitude, 360);
    as_titled += std::hypot(x - east, y - north);
    exchanged += std::hypot(y - east, x - north);
  }
  return exchanged < 0.5 * as_titled;
}

std::optional<double> size(const std::optional<double>& km) {
  return km ? std::optional(m_per_km * *km) : std::nullopt;
}

}  // namespace

FaultSegment SubfaultTables::geometry_of(const Segment& table, const Header& header, bool exchanged) {
  FaultSegment segment;
  segment.line = table.line;
  segment.strike = table.strike ? table.strike : header.strike;
  segment.dip = table.dip ? table.dip : header.dip;
  segment.patches = table.patches;
  if (exchanged)
    for (FaultPatch& p : segment.patches) std::swap(p.east, p.north);
  segment.down_dip = segment.strike ? sort_into_rows(segment.patches, *segment.strike) : 0;
  if (segment.down_dip > 0) segment.along_strike = segment.patches.size() / segment.down_dip;
  const bool outlined = table.length && table.width;
  if (table.dx && table.dz) {
    segment.cell_length = size(table.dx), segment.cell_width = size(table.dz);
  } else if (outlined && segment.down_dip > 0) {
    segment.cell_length = m_per_km * *table.length / static_cast<double>(segment.along_strike);
    segment.cell_width = m_per_km * *table.width / static_cast<double>(segment.down_dip);
  } else if (!outlined) {
    segment.cell_length = size(header.dx), segment.cell_width = size(header.dz);
  }
  return segment;
}

void SubfaultTables::fill(const Header& header, FaultModel& out) const {
  std::size_t moved = 0, contradictions = 0;
  std::vector<FaultPatch> patches;
  for (const Segment& table : segments_) patches.insert(patches.end(), table.patches.begin(), table.patches.end());
  const bool exchanged = !patches.empty() && are_exchanged(patches);
  if (exchanged) out.notes.push_back("latitude and longitude show that the titles of columns X and Y are exchanged");
  for (const Segment& table : segments_) {
    if (table.patches.empty()) continue;
    FaultSegment& segment = out.segments.emplace_back(geometry_of(table, header, exchanged));
    if (!segment.strike || !segment.dip || !segment.cell_width) continue;
    const auto top = table.top || segments_.size() > 1 ? table.top : header.top;
    const bool tops = are_tops(segment, top, header.positions_are_tops);
    if (header.positions_are_tops && tops != *header.positions_are_tops) ++contradictions;
    if (tops) move_to_centres(segment), ++moved;
  }
  const bool all = moved == out.segments.size();
  out.notes.push_back(moved == 0 ? "positions in the file are those of centres"
                                 : std::string("positions in the file are those of upper edges") +
                                       (all ? "" : " on " + std::to_string(moved) + " segments") +
                                       ": moved down dip to the centres");
  if (contradictions > 0)
    out.notes.push_back("the depth of the upper edge, not the text of the file, decides what the positions are");
}

}  // namespace slipfront::catalogue::fsp
