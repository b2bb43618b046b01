// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recognises places that a run has seen before, and states them as constraints between keyframes. It measures
// and moves nothing: the graph does (map/epochs.h).
//
// A keyframe that leaves the window is remembered, and looked up among those long before it. What is proved
// of a pair of views (place_match.h) is believed if the path agrees, as far as it is known at all; if no
// other place matches as well; and if the places of three keyframes in a row agree with each other.
//
// Of a segment that lies nowhere yet, in the past of the run or in a map that was kept, keyframes are looked
// up as soon as they are in the window. What that says is withdrawn when keyframes that have left it say it
// better.
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/map_log.h"
#include "edgevo/places/place_index.h"
#include "edgevo/places/place_match.h"
#include "edgevo/places/place_params.h"
#include "edgevo/places/place_store.h"
#include "edgevo/places/stated_place.h"

namespace edgevo {

/// What became of the keyframes that were looked up.
struct PlaceCounts {
  /// Keyframes looked up, and the candidates for them.
  int queries = 0, candidates = 0;
  /// Keyframes that were not looked up, so that the others were in time.
  int skipped = 0;
  /// Pairs of views that were proved to show one place; of these, those that the path contradicts, and those
  /// of keyframes that match places apart.
  int proved = 0, beyond_drift = 0, ambiguous = 0;
  /// Places stated as constraints: within the run, and in the map that was kept.
  int stated = 0, in_kept_map = 0;
};

/// Follows a run, and adds constraints between its keyframes to the log of its events. For one thread.
/// Memory: about 130 kB a keyframe. Cost: some 20 ms a keyframe at 1241x376, and 15 ms more where places are
/// recognised.
class PlaceMemory {
 public:
  /// `rectification`: from the images as they were taken to those that are worked on; `log`, not null: that
  /// whose events are followed. `kept`: a map of the same pinhole, all of one unit, whose places are looked
  /// for, too: they are stated from the world, which is its frame, to a keyframe of the run. Null: none.
  PlaceMemory(const Rectification& rectification, std::shared_ptr<MapLog> log, const PlaceParams& params = {},
              std::shared_ptr<const PlaceStore> kept = nullptr);

  /// Takes the next event of the run.
  void apply(const MapEvent& event);
  /// Takes a keyframe with its view as one that has left the window: of a map that was kept. Ids ascend, and
  /// were announced.
  void remember(StoredKeyframe keyframe);
  /// Calls `follow` with each keyframe that is remembered from now on, and with those remembered once more
  /// when the camera is corrected; in the thread of apply().
  void on_stored(std::function<void(const StoredKeyframe&)> follow) { on_stored_ = std::move(follow); }
  /// Calls `follow` with each sure keyframe while it is in the window: as soon as it is there, and once more
  /// with the next keyframe after the map has moved. That of on_stored() replaces it, or says by
  /// `record->is_doubtful` that it is none.
  void on_young(std::function<void(const StoredKeyframe&)> follow) { on_young_ = std::move(follow); }
  /// Calls `follow` with each place that is stated in the kept map, as a constraint from the keyframe there
  /// to that of the run, by their ids; in the thread of apply().
  void on_found(std::function<void(const Constraint&)> follow) { on_found_ = std::move(follow); }
  /// Whether keyframes in the window are looked up in the kept map all along, not only until the segment is
  /// found: the newest pose then rests on what the camera sees now. Each costs a look-up more.
  void look_up_young(bool all_along) { looks_up_young_ = all_along; }
  /// Whether keyframes are looked up from now on, or only remembered: where they would come too late.
  void look_up_too(bool looks_up) { looks_up_ = looks_up; }
  /// The run has no more keyframes: those that waited for the ones after them are looked up.
  void finish();
  /// What was found so far.
  const PlaceCounts& counts() const { return counts_; }

 private:
  struct Proved : StatedPlace {
    PlaceEvidence evidence;
    bool is_stated = false;
    int constraint = -1;  // its number, if it may be withdrawn
  };
  // Keyframes that are looked up one after the other.
  struct Row {
    const PlaceStore* store = nullptr;
    PlaceVotes votes;
    std::deque<std::vector<Proved>> recent;  // of the last ones, the newest last
    std::multimap<int, int> stated;  // by keyframe, numbers of the constraints that are withdrawn later
  };
  // Places to be looked up: of this run, or of a map that was kept.
  struct Known {
    const PlaceStore* store = nullptr;
    PlaceIndex index;
    std::vector<size_t> keyframe_of;  // by number of the view in the index
    Row finished, young;              // keyframes that have left the window, and those in it
    bool is_sought = false;           // whether those in the window are looked up here

    void add(const StoredKeyframe& keyframe, size_t position);
  };

  void handle(const SegmentPlaced& e);
  void handle(const EpochBegan& e);
  void handle(const KeyframeMarginalised& e);
  void handle(const WindowAdjusted& e);
  void handle(const MapMoved& e);
  template <class Other>
  void handle(const Other&) {}

  void begin_young();
  int epoch_of(int keyframe) const;
  std::shared_ptr<const RememberedView> view_of(int id, const std::shared_ptr<const FramePyramid>& pyramid);
  void pass_on_young(const WindowAdjusted& e);
  void take_young(const WindowAdjusted::Active& active);
  void look_up(size_t query);
  void look_up(size_t query, Known* known, Row* row);
  void add_places_before(size_t query);
  bool is_known_already(const Proved& p) const;
  std::optional<PlaceMatch> match(size_t place, size_t query, const Known& known, const Row& row) const;
  void prove_anew(Known* known, Row* row);
  std::vector<Proved> prove(size_t query, const std::vector<int>& views, const Known& known, const Row& row);
  bool is_on_path(const Proved& p) const;
  std::vector<Proved> possible(std::vector<Proved> found, const Known& known, const Row& row);
  static std::vector<Proved*> agreeing_with(Proved* newest, const Known& known, Row* row);
  void state(Proved* p, Known* known, Row* row);
  void withdraw(int up_to_keyframe, Row* young);

  const Rectification rectification_;
  const std::shared_ptr<MapLog> log_;
  const PlaceParams params_;
  const std::shared_ptr<const PlaceStore> kept_store_;
  PlaceStore store_;
  PlaceStore young_;  // keyframes of the segment in use, as they were in the window last
  int young_segment_ = -1;
  struct YoungView {
    std::weak_ptr<const FramePyramid> of;
    std::shared_ptr<const RememberedView> view;
  };
  std::map<int, YoungView> views_;   // of keyframes in the window, by id
  std::set<int> passed_on_;          // of these: those on_young_ knows as they are
  std::set<int> first_of_epoch_{0};  // ids of the first keyframes
  std::deque<size_t> waiting_;       // positions of those that are not far enough back yet to be places
  Known own_, kept_;
  PlaceCounts counts_;
  bool looks_up_ = true, looks_up_young_ = false;
  std::function<void(const StoredKeyframe&)> on_stored_ = [](const StoredKeyframe&) {};
  std::function<void(const StoredKeyframe&)> on_young_;
  std::function<void(const Constraint&)> on_found_ = [](const Constraint&) {};
};

}  // namespace edgevo
