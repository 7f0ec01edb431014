// Bodies whose positions are known for every frame: what tact and its rivals are measured on. Each workload is made
// from a few numbers and a seed, has the same bits on every platform, and repeats without a jump: frame 0 follows the
// last.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tact::bench {

struct WorkloadBody {
  Eigen::Matrix3Xi facets{3, 0};
  Surface surface = Surface::closed;
  std::vector<Eigen::Matrix3Xd> frames = {};  // 3 x V metres, one a frame; a single one: the body is fixed
  std::uint32_t mask = 0xffffffffu;           // see BodyDefinition
  double margin = 0.0;                        // that a scene gave it, metres; 0: it has none of its own
  bool self_contact = false;                  // it is held against itself, by those who do that

  bool fixed() const { return frames.size() == 1; }
  const Eigen::Matrix3Xd& positions(int frame) const { return frames[fixed() ? 0 : static_cast<std::size_t>(frame)]; }
};

struct Workload {
  int frames = 0;
  std::vector<WorkloadBody> bodies;

  std::size_t facet_count() const;
};

// Where in the period a frame is, 0 <= phase < 1.
inline double phase_of(int frame, int frames) { return static_cast<double>(frame) / frames; }

// A sheet of `cells` x `cells` squares, 4 m wide, that falls on a fixed sphere of radius 1 m, drapes over it and is
// lifted off again. Its wrinkles cross the sphere in patches.
Workload cloth(int cells, int frames);

// What follows are surfaces that lie on each other over most of their area.

// `moving`: the body swells and sways, and what lies on it with it.
enum class BodyMotion { still, moving };

// A sheet of `cells` x `cells` squares, 2.3 m wide, all of it on a sphere of 20 * frequency² facets and radius 1 m.
// Fine wrinkles wander over it and cross the sphere in patches.
Workload draped_densely(int cells, int frequency, BodyMotion motion, int frames);

// The same sheet and sphere at rest: every vertex of the sheet moves in every frame, by less than a thousandth of an
// edge.
Workload resting_drape(int cells, int frequency, int frames);

// A figure of five capsules that walks, and a dress, a tube of cloth, that is drawn over its torso and thighs; about
// `facets` facets in all, half of them the dress's.
Workload garment(int facets, int frames);

// `count` sheets of 2 * cells² facets at rest on each other, 2 mm apart, each crossing the next in places. Every vertex
// moves in every frame, by less than a thousandth of an edge.
Workload sheet_stack(int count, int cells, int frames);

// A tube of cloth of 2 * around² facets that is pulled through a funnel of as many: near everywhere, and nothing meets.
Workload funnel(int around, int frames);

// What follows is close to each other over most of its area without lying on it: rods about each other, of random
// pitch; a field of side² figures that sink together, of about so many facets each; the cloth of funnel(), of which a
// quarter of the facets have no area.
Workload twisted_rods(int count, int around, int bands, int frames);
Workload folding_figures(int side, int facets, int frames);
Workload drawn_funnel(int around, int frames);

// Two tubes across each other and across all axes, of 2 * around facets each, as long as the tube.
Workload slivers(int around, int frames);

// A scene of the command line program, of this --size: after `settled` steps of its simulation as many as make `frames`
// frames there and back. Bodies as the engine saw them. The same bits wherever the C library's sines are the same.
Workload recorded(const std::string& scene, int size, int settled, int frames);

// Bodies of other kinds.

// `count` blobs of 20 * frequency² facets and radius about 1 m, packed on a loose cubic grid so that each overlaps its
// neighbours, six inside the pile, shallowly; dents wander over them and they jostle.
Workload pile(int count, int frequency, int frames);

// The same in a column of 8 x 8 x height blobs: its neighbours per blob hardly depend on the height.
Workload pile_column(int height, int frequency, int frames);

// A bent organ of 500 facets that breathes, and a rod of 100 that moves in and out of it.
Workload organ_and_tool(int frames);

// `count` blobs of 80 facets at random places, so thinly that few touch.
Workload scattered(int count, int frames);

// Two blobs of 20 * frequency² facets each in shallow overlap.
Workload large_pair(int frequency, int frames);

enum class Pose {
  aligned,  // all face coordinates are whole numbers of 1/64 m and equal where bricks touch
  rotated,  // the same turned by a rotation, another in every frame: what touches hangs on the last bit
};

// A wall of `courses` layers of `side` x `side` bricks in running bond, every brick resting exactly on others. It moves
// as a whole.
Workload brick_wall(int side, int courses, Pose pose, int frames);

// Bodies that meet themselves; each alone.

// The sheet of cloth(), without the sphere. It does not cross itself.
Workload cloth_alone(int cells, int frames);

// A sheet of `cells` x `cells` squares, 2 m long, that is rolled up two and a half times and unrolled again to half a
// turn. Waves in it make each turn cross the next.
Workload rolled_cloth(int cells, int frames);

// The soft toy of ../shared/data/seq_toy_poses, 13,334 facets, from pose to pose and back, or a part of the way;
// none where it is missing.
Workload toy_figure(int frames, double part_of_way = 1.0);

// What solvers ask in small substeps: with margins of their own, and held against themselves.

// A sheet of side x side vertices, 1.6 m wide, after so many substeps of 1/720 s of its fall onto a ball, and `frames`
// more, there and back.
Workload cloth_on_ball(int side, int settled, int frames);

// `count` sheets of side x side vertices, 1 m wide, 8 mm apart, in a wave that hardly moves, with margins of 5 mm.
Workload waving_sheets(int count, int side, int frames);

// What follows was made after the engine, of other kinds of bodies: no constant was chosen by it.

// `count` blobs of 320 facets, side by side on a fixed height field of 2 * cells² facets, a little sunk in.
Workload terrain(int cells, int count, int frames);

// `count` wavy sheets of 2 * cells² facets, one on the other so closely that waves in them make neighbours cross.
Workload layers(int count, int cells, int frames);

// Two spheres of 20 * frequency² facets, one in the other: near everywhere, and nothing meets.
Workload shells(int frequency, int frames);

// Rings of 1,024 facets that are linked: their hulls overlap deeply, and nothing meets.
Workload chain(int links, int frames);

// side³ thin rods of 304 facets at random places, in all directions, so densely that each crosses some others.
Workload crossed_rods(int side, int frames);

// Two boxes that cross: the smallest scene.
Workload two_boxes(int frames);

// A row of the table: a workload and what has to be reached on it.
struct NamedWorkload {
  std::string name;
  std::string description;
  double required_factor = 1.0;  // how many times faster than the fastest rival tact is to be
  std::function<Workload()> make;
};

enum class Size { full, small };

// The rows, in order; small ones are of the same kinds and made and solved in milliseconds.
std::vector<NamedWorkload> rival_workloads(Size size);

}  // namespace tact::bench
