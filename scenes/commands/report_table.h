// Reports as text for people.
#pragma once

#include <tact/motion.h>
#include <tact/report.h>
#include <tact/world.h>

#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace tact::scenes {

// Prints the bodies, then a line a candidate pair and frame, then what each pair did over the frames. Of many pairs it
// prints the first and says how many it left out.
class TableReport {
 public:
  // Prints the bodies. `out` must outlive the report.
  TableReport(std::ostream& out, const World& world);
  // `motion` is what met since the frame before, or null.
  void add_frame(int frame, const Report& report, const MotionReport* motion = nullptr);
  // Prints the summary.
  void finish();

 private:
  // Two bodies by index.
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  // What a pair did so far. Frames are -1 before they come.
  struct History {
    int candidate_frames = 0;
    int overlap_frames = 0;
    int first_overlap = -1;
    int touching_frames = 0;
    int first_touching = -1;
    double deepest = 0.0;  // metres
    int deepest_frame = -1;
    double largest_turn = 0.0;  // of the direction from one overlapping frame to the next, degrees
    int last_overlap = -1;
    Eigen::Vector3d last_direction = Eigen::Vector3d::Zero();
  };

  void print_motion(const MotionReport& motion);
  void print_self(const Contact& contact);
  void print_pair(const CandidatePair& pair, const Contact* contact);
  void note_contact(int frame, const Contact& contact, History& history);
  void print_history(const Pair& pair, const History& history);
  std::string body_text(std::uint32_t index) const;

  std::ostream& out_;
  bool has_facets_;
  std::vector<std::string> names_;
  int name_width_ = 0;
  int frames_ = 0;
  double total_ms_ = 0.0;
  std::map<Pair, History> histories_;
};

}  // namespace tact::scenes
