// What solvers of any kind write beside contact points: rows of a system, derivatives of gaps, barrier, penalty,
// friction, colours. It is made of inline functions on the report; nothing of the engine includes it. They are as exact
// as they say if they are compiled without -ffast-math.
//
//     Eigen::Matrix3Xd x = ...;                             // the vertices of all bodies, those that move first
//     for (const tact::solver::Stencil& stencil : tact::solver::stencils(world.detect(), first_rows)) {
//       const tact::solver::Term term = tact::solver::projected(
//           tact::solver::barrier_term(stencil, tact::solver::gather(stencil, x), reach));
//       tact::solver::add_gradient(stencil, term.gradient, gradient);
//       tact::solver::append_triplets(stencil, term.hessian, moving, triplets);
//     }
#pragma once

#include <tact/solver/coloring.h>
#include <tact/solver/distance.h>
#include <tact/solver/friction.h>
#include <tact/solver/impacts.h>
#include <tact/solver/potential.h>
#include <tact/solver/projection.h>
#include <tact/solver/scatter.h>
#include <tact/solver/stencil.h>
#include <tact/solver/within_reach.h>
#include <tact/world.h>
