// Nine ways to test a segment against one triangle, as their sources have them, under one concept: prepare, then test.
//
//     const auto stored = pierce::kernels::bloom.prepare(a, b, c);          // a, b, c: Eigen::Vector3f or Vector3d
//     if (const auto hit = pierce::kernels::bloom.test(stored, from, to))    // hit->fraction, hit->u, hit->v
//
// For when you have your own structure around triangles. All but `exact` round as they go: what each then gets wrong is
// said where it is declared. Read kernels/concept.h first.
#pragma once

#include <pierce/kernels/baldwin_weber.h>
#include <pierce/kernels/bloom.h>
#include <pierce/kernels/concept.h>
#include <pierce/kernels/cramer.h>
#include <pierce/kernels/exact.h>
#include <pierce/kernels/mcguire.h>
#include <pierce/kernels/moller_trumbore.h>
#include <pierce/kernels/triangle_fan.h>
#include <pierce/kernels/watertight.h>
