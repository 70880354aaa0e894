// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/loop_closing/loop_detector.hpp"
#include "core/backend/loop_closing/place_hypotheses.hpp"
#include "core/backend/loop_closing/place_search.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/pose_graph/keyframe_graph.hpp"

namespace swiftlet {

/// Why it is not known where the newest travel lies in the earlier map.
enum class UnplacedBy : std::uint8_t {
  kRestart,        ///< the vehicle's estimate began anew
  kSilence,        ///< nothing was received, but the estimate ran on
  kContradiction,  ///< what was seen contradicts the earlier map
};

struct LoopCloserCounters {
  std::uint64_t submaps = 0;
  std::uint64_t candidates_matched = 0;  ///< submaps searched
  std::uint64_t closures_dropped = 0;
};

/// Builds submaps, looks for loops, and adds closures to the graph: confirmed matches at once, those with
/// what lies before a break once the place is decided. Behind a restart the place is weighed on until it is
/// beyond doubt: another may replace it, or what is seen refute it. One thread at a time; allocates.
class LoopCloser {
 public:
  /// The travel since older ground was met again, which closures tell.
  struct Contact {
    KeyframeId since{};
    Pose2 T_map_since;      ///< as the graph had it before the first closure
    double newest_m = 0.0;  ///< the travel at the newest closure
  };

  /// Views its arguments, which must outlive it.
  LoopCloser(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain);

  /// Builds the submaps that end at the newest keyframe.
  void add_keyframe(const Keyframe& made, const KeyframePoses& T_local_keyframe);
  /// What was seen since this keyframe contradicts the earlier map: where the travel from there lies is to be
  /// found. Loops go on being closed as the graph has it. `log_odds`: the evidence. A doubt that ended not
  /// long before without a place goes on.
  void doubt_since(KeyframeId keyframe, double log_odds);
  /// What is seen agrees with the earlier map again.
  void end_doubt();
  /// Looks for loops from the newest keyframe. Returns how many closures were accepted.
  std::uint32_t close_loops(const KeyframePoses& T_local_keyframe, KeyframeGraph& graph);
  /// After each scan, while it is not known where the vehicle is: looks elsewhere, in one submap, or weighs
  /// one place that was found.
  void search_elsewhere(const KeyframePoses& T_local_keyframe, const PoseGraph& graph);
  /// The newest contact, if it is new and has moved the map.
  [[nodiscard]] std::optional<Contact> contact_that_moved(const PoseGraph& graph) const;
  /// Its closures no longer count.
  void drop_contact(KeyframeGraph& graph);
  /// Takes over what DCS makes of each closure.
  void take_scales(const PoseGraph& graph);
  /// Drops the closure that DCS scales down most, if any lies below config.drop_scale. False: none does.
  bool drop_worst(KeyframeGraph& graph);
  /// Drops all that lie off a map which was found without them: there DCS scales them below
  /// config.drop_scale.
  void drop_those_off(const KeyframePoses& T_map_keyframe, KeyframeGraph& graph);
  /// Submaps go with the keyframe that is their frame, closures with either end; places that are weighed are
  /// forgotten.
  void erase(const IdRanges<KeyframeId>& pruned);

  [[nodiscard]] const IdMap<ClosureId, LoopClosure>& closures() const { return closures_; }
  /// Where the oldest submap begins that is not yet complete.
  [[nodiscard]] std::optional<KeyframeId> open_since() const;
  [[nodiscard]] const LoopCloserCounters& counters() const { return counters_; }
  /// Complete ones, in the order of their ends.
  [[nodiscard]] std::span<const std::shared_ptr<const Submap>> submaps() const { return submaps_; }
  /// Of those, the ones that begin there or later.
  [[nodiscard]] std::span<const std::shared_ptr<const Submap>> submaps_since(KeyframeId since) const {
    return submaps().subspan(submaps_before(since).size());
  }
  /// From there on the motion is known, and nothing has placed it in the earlier map yet.
  [[nodiscard]] std::optional<KeyframeId> unplaced_since() const { return unplaced_since_; }
  /// With unplaced_since().
  [[nodiscard]] UnplacedBy unplaced_by() const { return unplaced_by_; }
  /// The travel from this restart on was placed, and may yet lie elsewhere.
  [[nodiscard]] std::optional<KeyframeId> provisional_since() const;
  /// The travel is unplaced or provisional.
  [[nodiscard]] bool weighs_places() const { return unplaced_since_ || provisional_; }
  /// Places that are weighed then, the one without any move included.
  [[nodiscard]] std::size_t places_weighed() const { return places_.size(); }
  /// PlaceHypotheses::lead(); 0 without any place.
  [[nodiscard]] double place_lead() const { return places_.size() > 0 ? places_.lead() : 0.0; }

 private:
  /// Travel that was placed, and may yet lie elsewhere.
  struct Provisional {
    KeyframeId since{};
    KeyframeId moved_since{};       ///< with the place
    KeyframePoses T_path_keyframe;  ///< as if it had not been placed
  };
  [[nodiscard]] std::span<const std::shared_ptr<const Submap>> submaps_before(KeyframeId since) const;
  [[nodiscard]] std::optional<ScanRange> recent_scans() const;
  [[nodiscard]] KeyframeId watched_since() const;
  [[nodiscard]] KeyframeId travel_since() const;
  [[nodiscard]] const KeyframePoses& path_of_travel(const KeyframePoses& T_local_keyframe,
                                                    const PoseGraph& graph) const;
  void begin_break(const Keyframe& made);
  void finish_oldest(KeyframeId end, const KeyframePoses& T_local_keyframe);
  void finish_open(KeyframeId end, const KeyframePoses& T_local_keyframe);
  void search_across_silence();
  void suspend_doubt();
  [[nodiscard]] bool resume_doubt();
  void stop_searching();
  void forget_places(const IdRanges<KeyframeId>& pruned = {});
  void place_travel(std::span<const LoopClosure> matches, const KeyframePoses& T_local_keyframe,
                    KeyframeGraph& graph);
  void drop_closures_to_place(KeyframeGraph& graph);
  void withdraw_place(KeyframeGraph& graph);
  void search_anew(const IdRanges<KeyframeId>& pruned = {});
  void weigh_on(const KeyframePoses& T_local_keyframe, KeyframeGraph& graph);
  void note_contact(KeyframeId query, const PoseGraph& graph);
  void drop(LoopClosure& closure, KeyframeGraph& graph);
  void accept(LoopClosure closure, KeyframeGraph& graph);
  void replace_place(std::span<const LoopClosure> decided, KeyframeGraph& graph);
  bool accept_place(std::span<const LoopClosure> decided, KeyframeGraph& graph);
  [[nodiscard]] bool is_closed(const LoopClosure& match) const;

  const BackendConfig* config_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
  LoopDetector detector_;
  PlaceSearch elsewhere_;
  PlaceHypotheses places_;
  std::vector<LoopClosure> proposed_;     // to places_
  std::vector<KeyframeId> open_submaps_;  // where those being travelled begin
  std::vector<std::shared_ptr<const Submap>> submaps_;
  IdMap<ClosureId, LoopClosure> closures_;
  std::optional<Contact> contact_;            // the newest
  std::optional<KeyframeId> unplaced_since_;  // motion to there is not known, and no place is decided
  UnplacedBy unplaced_by_ = UnplacedBy::kRestart;
  std::optional<KeyframeId> unjoined_since_;  // the newest break, until a place is accepted behind it
  bool place_is_refused_ = false;             // by the graph, since the newest query
  std::optional<Provisional> provisional_;
  std::optional<KeyframeId> suspended_since_;  // a doubt that ended without a place: its unplaced_since_ ...
  double suspended_at_m_ = 0.0;                // ... and the travel at its end
  LoopCloserCounters counters_;
};

}  // namespace swiftlet
