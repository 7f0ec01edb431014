// Worlds over many ranks against one world: in each step the sums over all contacts, events and impacts are the same,
// whoever owns which body.   usage: mpirun -n N test_mpi [--full] [--bodies N] [--steps N] [--many-only] [NAME]
//   --full       1,000 bodies and 500 steps
//   --many-only  without the one world: the digests are to be those of other counts of ranks
//   NAME         the cases whose name holds this text
#include <mpi.h>
#include <tact/mpi/world.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/mpi/blobs.h"
#include "tests/mpi/churn.h"
#include "tests/mpi/exclusions.h"
#include "tests/mpi/one_and_many.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {
namespace {

struct Size {
  int bodies, steps;
};

using Owner = std::function<int(int body)>;
using BeforeStep = std::function<void(Both& both, int step)>;

void run_pile(const std::string& name, Size size, const mpi::Settings& settings, const Owner& owner,
              const BeforeStep& before) {
  Both both(name, settings);
  const int across = across_of(size.bodies);
  const double wide = 1.55 * across + 2.0;
  BodyDefinition floor = definition_of(box({-2.0, -2.0, -1.0}, {wide, wide, 0.0}), 1, 0.05);
  floor.motion = Motion::fixed;
  for (int i = 0; i < size.bodies; ++i) both.add(definition_of(blob_at(i, 0, across), key_of(i), 0.05), owner(i));
  both.add(floor, 0, true);  // in another slot on each rank
  for (int step = 0; step < size.steps; ++step) {
    before(both, step);
    for (int i = 0; i < size.bodies; ++i) {
      if (step % 16 > 12 || fraction(9, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(step)) < 0.3)
        continue;
      both.on_owner(key_of(i), [&](auto& world, auto body) {
        const Mesh mesh = blob_at(i, step, across);
        world.set_positions(body, mesh.positions);
      });
    }
    if (step % 5 == 2) both.detect_motion(static_cast<Impacts>(step % 3));
    both.detect();
  }
}

void nothing(Both&, int) {}

Owner blocks(int bodies) {
  return [=](int i) { return i * count_of_ranks() / bodies; };
}
Owner random_owner() {
  return [](int i) { return drawn(77, static_cast<std::uint64_t>(i), 0, count_of_ranks()); };
}

void pile(Size size) { run_pile("pile", size, all_outputs(), blocks(size.bodies), nothing); }
void random_owners(Size size) { run_pile("random owners", size, all_outputs(), random_owner(), nothing); }
void one_place(Size size) {
  run_pile(
      "one place", size, all_outputs(), [](int) { return count_of_ranks() - 1; }, nothing);
}
void all_moved(Size size) {
  run_pile("all moved", size, all_outputs(), random_owner(), [](Both& both, int) {
    for (const Key key : both.many.bodies()) both.many.set_owner(key, (rank_of_all() + 1) % count_of_ranks());
    both.many.move_bodies();
  });
}
void some_moved(Size size) {
  run_pile("some moved", size, all_outputs(), random_owner(), [](Both& both, int step) {
    for (const Key key : both.many.bodies()) {
      if (drawn(5, key, static_cast<std::uint64_t>(step), 4) == 0)
        both.many.set_owner(key, drawn(6, key, static_cast<std::uint64_t>(step), count_of_ranks()));
    }
    both.many.move_bodies();
  });
}
void rebalanced(Size size) {
  for (const mpi::Partitioner partitioner : {mpi::Partitioner::rcb, mpi::Partitioner::hsfc}) {
    run_pile(partitioner == mpi::Partitioner::rcb ? "rebalanced, rcb" : "rebalanced, hsfc", size,
             all_outputs(partitioner), random_owner(), [](Both& both, int step) {
               if (step % 6 == 3) both.many.rebalance();
             });
  }
}
void rebalanced_by_itself(Size size) {
  mpi::Settings settings = all_outputs();
  settings.rebalance_above = 1.05;
  run_pile(
      "rebalanced by itself", size, settings, [](int) { return 0; }, nothing);
}
// Bodies gather on rank 0, the others have none.
void emptied(Size size) {
  run_pile("emptied", size, all_outputs(), random_owner(), [](Both& both, int step) {
    for (const Key key : both.many.bodies()) both.many.set_owner(key, step % 4 < 2 ? 0 : count_of_ranks() - 1);
    both.many.move_bodies();
  });
}

void churn(Size size) {
  Churn("churn", size.bodies, size.steps).run([](Both&, int, There&) {});
}

// A body is removed that touches itself; another in its slot, which does too, leaves in the same step.
void reused_slots(Size) {
  Both both("reused slots", all_outputs());
  MeshBuilder builder;
  builder.triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  builder.triangle({0.2, 0.2, -1.0}, {0.2, 0.3, 1.0}, {0.3, 0.2, 1.0});
  const Mesh crossed = builder.mesh();
  const auto add = [&](Key key, double x, int owner) {
    BodyDefinition definition = definition_of(translated(crossed, {x, 0.0, 0.0}), key, 0.01);
    definition.surface = Surface::sheet;
    definition.self_contact = true;
    both.add(definition, owner);
  };
  const int last = count_of_ranks() - 1;
  add(1, 0.0, 0);
  add(2, 0.25, last);
  both.detect();
  both.remove(1);
  add(3, 0.125, 0);
  if (both.many.owns(3)) both.many.set_owner(3, last);
  both.many.move_bodies();
  both.detect();
  both.on_owner(3, [&](auto& world, auto body) {
    world.set_positions(body, translated(crossed, {0.5, 0.0, 0.0}).positions);
  });
  both.detect_motion(Impacts::all);
  both.detect();
}

// A body is removed, another comes with its key, and bodies change ranks, before the next step tells what ended.
void keys_that_return(Size) {
  const int last = count_of_ranks() - 1;
  const Mesh ball = icosphere(1);
  for (int owners = 0; owners < 32; ++owners) {
    const auto owner = [&](int i) { return (owners >> i & 1) != 0 ? last : 0; };
    Both both("keys that return, " + std::to_string(owners), all_outputs());
    both.add(definition_of(ball, 1, 0.1), owner(0));
    both.add(definition_of(translated(ball, {1.8, 0.0, 0.0}), 2, 0.1), owner(1));
    both.detect();
    both.remove(2);
    both.add(definition_of(translated(ball, {100.0, 0.0, 0.0}), 2, 0.1), owner(2));
    for (const Key key : both.many.bodies()) both.many.set_owner(key, owner(key == 1 ? 3 : 4));
    both.many.move_bodies();
    both.detect();
    both.on_owner(2, [&](auto& world, auto body) {
      world.set_positions(body, translated(ball, {-100.0, 0.0, 0.0}).positions);
    });
    both.detect_motion(Impacts::all);
  }
}

// Space is cut while nobody has a body.
void nobody(Size) {
  for (const mpi::Partitioner partitioner : {mpi::Partitioner::rcb, mpi::Partitioner::hsfc}) {
    mpi::World world(MPI_COMM_WORLD, all_outputs(partitioner));
    const Key own = 5 + static_cast<Key>(rank_of_all());
    const Mesh ball = translated(icosphere(1), {1.8 * rank_of_all(), 0.0, 0.0});
    for (int i = 0; i < 3; ++i) {
      world.add_body(definition_of(ball, own, 0.1));
      world.rebalance();
      std::uint64_t counted = 0;
      for (const mpi::Contact& contact : world.detect().contacts()) counted += contact.bodies.counted ? 1u : 0u;
      MPI_Allreduce(MPI_IN_PLACE, &counted, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
      expect(counted == static_cast<std::uint64_t>(count_of_ranks() - 1),
             "contacts are missing after nobody had a body");
      for (const Key key : world.bodies()) world.remove_body(key);
      world.rebalance();
    }
  }
}

// States are saved amid all that, and gone back to, by other ranks than those that saved them.
void restored(Size size) {
  There saved;
  std::map<Key, std::byte> states;
  const auto byte_of = [](Key key) { return static_cast<std::byte>(key % 251); };
  Churn("restored", size.bodies, size.steps).run([&](Both& both, int step, There& there) {
    if (step == 0)
      both.many.set_body_state(
          {.pack = [&](Key key) { return std::vector<std::byte>{byte_of(key)}; },
           .unpack = [&](Key key, std::span<const std::byte> bytes) { states[key] = bytes.front(); },
           .drop = [&](Key key) { states.erase(key); }});
    if (step % 7 == 2) {
      both.save();
      saved = there;
    } else if (step % 7 == 2 + step / 7 % 3) {
      both.restore(step % 2 == 0 ? Both::Shares::in_turn : Both::Shares::one_rank, step);
      there = saved;
      for (const Key key : both.many.bodies())
        expect(states.contains(key) && states[key] == byte_of(key), "a body's state did not come back");
    }
    if (step % 7 == 2 && step / 7 % 3 == 0) both.restore(Both::Shares::in_turn, 1);
  });
}

Eigen::Matrix3d turn(double sine, double cosine) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = matrix(1, 1) = cosine;
  matrix(0, 1) = -sine, matrix(1, 0) = sine;
  return matrix;
}

// A cloth, which is tested against itself, sinks over balls that are rigid and turn; one ball is fixed now and then.
void cloth(Size size) {
  Both both("cloth", all_outputs());
  const int cells = size.bodies > 200 ? 48 : 20, balls = 9;
  const Mesh flat = sheet(cells, cells, 6.0, 6.0);
  const auto at_step = [&](int step) {
    return mapped(flat, [&](Vec3 p) {
      const double t = 0.02 * step, x = p.x * p.x + p.y * p.y;
      return Vec3{p.x * (1.0 - 0.3 * std::min(t, 1.0)), p.y, 1.15 - t + 0.05 * x * t};
    });
  };
  BodyDefinition definition = definition_of(at_step(0), 1000, 0.04);
  definition.surface = Surface::sheet;
  definition.self_contact = true;
  both.add(definition, count_of_ranks() - 1);
  for (int i = 0; i < balls; ++i) {
    const Mesh mesh = icosphere(2);
    BodyDefinition ball = definition_of(mesh, static_cast<Key>(i), 0.04);
    ball.motion = Motion::rigid;
    both.add(ball, i % count_of_ranks());
  }
  for (int step = 0; step < size.steps; ++step) {
    const Mesh mesh = at_step(step % 60);
    both.on_owner(1000, [&](auto& world, auto body) { world.set_positions(body, mesh.positions); });
    for (int i = 0; i < balls; ++i) {
      if (step > 0 && (step + i) % 3 == 0) continue;
      const double angle = 0.1 * step;
      const Eigen::Matrix3d rotation =
          turn(2.0 * angle / (1.0 + angle * angle), (1.0 - angle * angle) / (1.0 + angle * angle));
      const Eigen::Vector3d place(2.05 * (i % 3 - 1), 2.05 * (i / 3 - 1), 0.01 * (step % 7));
      both.on_owner(static_cast<Key>(i), [&](auto& world, auto body) {
        using Update = std::conditional_t<std::is_same_v<decltype(body), BodyId>, PoseUpdate, mpi::PoseUpdate>;
        world.set_motion(body, Motion::rigid);
        if (step % 2 == 0) world.set_pose(body, rotation, place);
        if (step % 2 != 0) world.set_poses(std::array{Update{body, rotation, place}});
        if ((step + i) % 11 == 0) world.set_motion(body, Motion::fixed);
      });
    }
    if (step % 7 == 3) both.many.rebalance();
    if (step % 4 == 2) both.detect_motion(Impacts::all);
    both.detect();
  }
}

// A failure of one rank is one of all, and they go on as if nothing had been called.
void failures_of_one(Size size) {
  const int last = count_of_ranks() - 1;
  bool throws = false;
  const std::function<void(Both&)> set_state = [&](Both& both) {
    both.many.set_body_state({.pack = [](Key) { return std::vector<std::byte>(3); },
                              .unpack =
                                  [&](Key, std::span<const std::byte> bytes) {
                                    expect(bytes.size() == 3, "other bytes of a body's state");
                                    if (throws) throw std::runtime_error("no room for a body");
                                  },
                              .drop = [](Key) {}});
  };
  run_pile("failures", size, all_outputs(), random_owner(), [&](Both& both, int step) {
    if (step == 0) set_state(both);
    if (step % 4 == 1) {
      for (const Key key : both.many.bodies()) both.many.set_owner(key, last);
      const std::size_t count = both.many.body_count();
      throws = rank_of_all() == last;
      const std::string found = caught([&] { both.many.move_bodies(); });
      throws = false;
      expect_on_all(found, last == 0 ? "nothing" : "invalid_argument: no room for a body");
      expect(both.many.body_count() == count, "bodies moved though a rank failed");
    }
    if (step % 4 == 3) {
      if (rank_of_all() == last) fail_allocation(40 * step, false);
      const std::string found = caught([&] { both.many.detect(); });
      const bool failed = stop_failing();
      expect(!failed || found.starts_with("out_of_memory"), "a rank without memory threw '" + found + "'");
      int worked = found == "nothing" ? 1 : 0, all_worked = 0;
      MPI_Allreduce(&worked, &all_worked, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
      expect(all_worked == 0 || all_worked == count_of_ranks(), "only some ranks failed");
      all_worked != 0 ? both.detect_of_one() : both.fail();
    }
  });
}

void wrong_use(Size) {
  expect_on_all(caught([&] { mpi::World bad(MPI_COMM_WORLD, {.world = {.threads = rank_of_all() == 0 ? -1 : 1}}); }),
                "bad_settings: threads is -1, not 0 to 1024");
  mpi::World world(MPI_COMM_WORLD, all_outputs());
  const Mesh mesh = icosphere(0);
  world.add_body(definition_of(mesh, 5 + static_cast<Key>(rank_of_all()), 0.0));
  expect_on_all(caught([&] { world.add_body({.positions = mesh.positions, .facets = mesh.facets}); }),
                "invalid_argument: a body over many ranks is named by its key: it has none");
  world.detect();
  const std::vector<std::byte> share = world.save();
  const std::span<const std::byte> twice[] = {share, share};
  expect_on_all(caught([&] { world.restore(std::span(twice).first(rank_of_all() == 0 ? 2 : 1)); }),
                "bad_state: the ranks were not given each share of one save once");
  expect_on_all(caught([&] { world.restore({}); }), "bad_state: no rank was given a share");
  std::vector<std::byte> damaged = share;
  if (rank_of_all() == 0) damaged[damaged.size() / 2] ^= std::byte{4};
  const std::span<const std::byte> one[] = {damaged};
  expect_on_all(caught([&] { world.restore(one); }), "bad_state: a share is damaged: its checksum is another");
  world.restore(std::span(twice).first(1));
  expect(world.owns(5 + static_cast<Key>(rank_of_all())) && world.body_count() == 1, "a body did not come back");
  const std::vector<int> vertices(static_cast<std::size_t>(mesh.vertex_count()), 0);
  const MeshUpdate update{.positions = mesh.positions, .facets = mesh.facets, .vertex_map = vertices};
  const std::string found_on_the_way = caught([&] { world.set_facets(5 + static_cast<Key>(rank_of_all()), update); });
  expect(found_on_the_way.starts_with("wrong_order"), "facets changed on the way");
  world.detect();
  expect(caught([&] { world.set_margin(4, 1.0); }).starts_with("stale_body"), "a body that is nowhere was set");
  const Key own = 5 + static_cast<Key>(rank_of_all());
  const auto excluding = [&](const mpi::LabelPair& labels) {
    return caught([&] { world.set_excluded_labels(labels, true); });
  };
  expect(excluding({.key_a = own, .label_a = 1, .key_b = own}).starts_with("invalid_argument"), "a label 0");
  expect(excluding({.key_a = 3, .label_a = 1, .key_b = 4, .label_b = 1}).starts_with("stale_body"), "labels of nobody");
  world.add_plane({.key = 98});
  expect(excluding({.key_a = 98, .label_a = 1, .key_b = own, .label_b = 1}).starts_with("invalid_argument"),
         "labels of a plane");
  world.remove_body(98);
  if (count_of_ranks() == 1) return;
  expect_on_all(caught([&] { mpi::World bad(MPI_COMM_WORLD, {.rebalance_above = rank_of_all() == 0 ? 2.0 : 3.0}); }),
                "bad_settings: the ranks have different settings");
  for (int i = 0; i < 2; ++i) {
    if (rank_of_all() == i) world.add_plane({.key = 98});
    expect_on_all(caught([&] { world.detect(); }),
                  "invalid_argument: the ranks hold different bodies that every rank should hold");
    if (rank_of_all() == i) world.remove_body(98);
    world.detect();
  }
  if (rank_of_all() == 0) world.set_excluded(6, 5, true);
  world.detect();
  if (rank_of_all() == 1) world.add_body(definition_of(mesh, 99, 0.0));
  world.detect();
  // A copy of a body of this key may be here: then the rank knows at once.
  std::string found = "nothing";
  if (rank_of_all() == 0) found = caught([&] { world.add_body(definition_of(translated(mesh, {9, 9, 9}), 100, 0.0)); });
  if (rank_of_all() == 1) found = caught([&] { world.add_body(definition_of(translated(mesh, {5, 9, 9}), 100, 0.0)); });
  expect_on_all(found, "nothing");
  for (int i = 0; i < 2; ++i) {
    found = caught([&] { world.detect(); });
    expect(found.starts_with("invalid_argument: ranks ") && found.ends_with("each own a body of key 100"), found);
  }
  if (rank_of_all() == 1) world.remove_body(100);
  world.detect();
  expect_on_all(caught([&] { world.set_settings({.rebalance_above = rank_of_all() == 0 ? 0.5 : 2.0}); }),
                "bad_settings: rebalance_above is 0.500000, not 0 or at least 1");
}

// A body that is refused, of the key of a copy that is here: the copy stays. Where a message throws its owner sends it
// anew.
void refused_additions(Size) {
  mpi::World world(MPI_COMM_WORLD, {.world = {.outputs = {.points = true}, .on_message = [](const Message&) {
                                                throw std::runtime_error("not this one");
                                              }}});
  const Mesh mesh = icosphere(1);
  const auto ball_at = [&](int rank, double z) { return translated(mesh, {1.5 * rank, 0.0, z}); };
  const Key own = 5 + static_cast<Key>(rank_of_all());
  const auto move = [&](double z) {
    const Mesh there = ball_at(rank_of_all(), z);
    world.set_positions(own, there.positions);
  };
  world.add_body(definition_of(ball_at(rank_of_all(), 0.0), own, 0.1));
  world.detect();
  const Eigen::MatrixXd flat = Eigen::MatrixXd::Zero(2, mesh.vertex_count());
  Mesh open = mesh;
  open.facets.conservativeResize(3, open.facets.cols() - 1);
  for (const Key key : {own - 1, own + 1}) {
    const std::string found = caught([&] { world.add_body({.positions = flat, .facets = mesh.facets, .key = key}); });
    expect(found.starts_with("wrong_size"), "a flat matrix was taken: " + found);
    move(0.01);
    expect(world.detect().stats().shape_bytes == 0, "a refused body cost a copy");
    try {
      world.add_body(definition_of(open, key, 0.0));
      expect(false, "what a message threw did not come out");
    } catch (const std::runtime_error& thrown) {
      expect(thrown.what() == std::string("not this one"), thrown.what());
    }
    expect(!world.owns(key) && world.body_count() == 1, "a refused body was added");
    move(0.02);
    world.detect();
  }
  const std::vector<int> vertices(static_cast<std::size_t>(mesh.vertex_count()), 0);
  expect(caught([&] {
           world.set_facets(own, {.positions = flat, .facets = mesh.facets, .vertex_map = vertices});
         }).starts_with("wrong_size"),
         "facets with a flat matrix were taken");
  const auto contacts = static_cast<int>(world.detect().contacts().size());
  const int neighbors = (rank_of_all() > 0 ? 1 : 0) + (rank_of_all() + 1 < count_of_ranks() ? 1 : 0);
  expect(contacts == neighbors, "contacts are missing after a refused body");
  if (count_of_ranks() == 1) return;
  world.set_owner(own, (rank_of_all() + 1) % count_of_ranks());
  world.move_bodies();
  const auto exchange = [&] {
    world.exchange([](Key) { return std::vector<std::byte>(); }, [](Key, std::span<const std::byte>) {});
  };
  expect_on_all(caught(exchange),
                "wrong_order: bodies have other owners: exchange() goes by the contacts of a detect() since");
  world.detect();
  exchange();
}

// At rest nothing is sent of positions; velocities of partners come.
void rest(Size size) {
  mpi::World world(MPI_COMM_WORLD, all_outputs());
  const int across = across_of(size.bodies);
  const Owner owner = random_owner();
  for (int i = 0; i < size.bodies; ++i) {
    const Mesh mesh = blob_at(i, 0, across);
    if (owner(i) == rank_of_all()) world.add_body(definition_of(mesh, key_of(i), 0.05));
  }
  world.rebalance();
  constexpr Key kAlone = 1;
  const auto alone_at = [&](double x) { return translated(blob_at(0, 0, across), {x, 0.0, 0.0}); };
  if (rank_of_all() == 0) world.add_body(definition_of(alone_at(-90.0), kAlone, 0.05));
  const std::uint64_t first_hash = world.detect().hash_sum();
  if (rank_of_all() == 0) world.set_positions(kAlone, alone_at(-91.0).positions);
  const std::vector<std::uint32_t> labels(static_cast<std::size_t>(blob_at(0, 0, across).vertex_count()), 7);
  for (const Key key : world.bodies()) world.set_feature_settings(key, {.vertex_labels = labels});
  expect(world.detect().hash_sum() == first_hash, "by labels contacts changed");
  const std::uint64_t hash = world.detect().hash_sum();
  const mpi::Statistics& stats = world.detect().stats();
  expect(stats.positions_bytes == 0 && stats.bytes == 0 && stats.messages == 0, "bytes were sent at rest");
  expect(world.detect().hash_sum() == hash, "at rest contacts changed");
  std::map<Key, int> partners, taken;
  for (const mpi::Contact& contact : world.detect().contacts()) {
    if (contact.bodies.rank_a != contact.bodies.rank_b)
      ++partners[contact.bodies.rank_a == rank_of_all() ? contact.bodies.key_b : contact.bodies.key_a];
  }
  world.exchange([](Key key) { return std::vector<std::byte>(key % 5 + 1); },
                 [&](Key key, std::span<const std::byte> bytes) {
                   expect(bytes.size() == key % 5 + 1, "other bytes of a partner");
                   ++taken[key];
                 });
  for (const auto& [key, count] : partners) expect(taken[key] == 1, "a partner's bytes did not come");
  expect(partners.size() == taken.size(), "bytes came of a body that is no partner");
}

struct Case {
  const char* name;
  void (*run)(Size);
};
constexpr Case kCases[] = {{"pile", pile},
                           {"random_owners", random_owners},
                           {"one_place", one_place},
                           {"all_moved", all_moved},
                           {"some_moved", some_moved},
                           {"refused_additions", refused_additions},
                           {"rebalanced", rebalanced},
                           {"rebalanced_by_itself", rebalanced_by_itself},
                           {"emptied", emptied},
                           {"churn", churn},
                           {"reused_slots", reused_slots},
                           {"keys_that_return", keys_that_return},
                           {"nobody", nobody},
                           {"excluded_labels", [](Size) { excluded_labels(); }},
                           {"exclusions", [](Size) { exclusions(); }},
                           {"restored", restored},
                           {"cloth", cloth},
                           {"failures", failures_of_one},
                           {"wrong_use", wrong_use},
                           {"rest", rest}};

int run(int argc, char** argv) {
  Size size{40, 16};
  const char* name = "";
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--full") == 0) {
      size = {1000, 500};
    } else if (std::strcmp(argv[i], "--many-only") == 0) {
      has_one_world = false;
    } else if (std::strcmp(argv[i], "--bodies") == 0 && i + 1 < argc) {
      size.bodies = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--steps") == 0 && i + 1 < argc) {
      size.steps = std::atoi(argv[++i]);
    } else {
      name = argv[i];
    }
  }
  for (const Case& one : kCases) {
    if (std::strstr(one.name, name) == nullptr) continue;
    const int before = failures;
    digest = {};
    try {
      one.run(size);
    } catch (const std::exception& error) {
      expect(false, std::string(one.name) + " threw: " + error.what());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Allreduce(MPI_IN_PLACE, &failures, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (rank_of_all() == 0)
      std::printf("%s of %d bodies, %d steps on %d ranks: %s, digest %016" PRIx64 "\n", one.name, size.bodies,
                  size.steps, count_of_ranks(), failures == before ? "good" : "WRONG", digest.value());
    std::fflush(stdout);
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tact::tests

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int status = tact::tests::run(argc, argv);
  MPI_Finalize();
  return status;
}
