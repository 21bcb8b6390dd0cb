#pragma once

/// \file support/rooms_core.hpp
/// \brief A list of templates that rooms.cpp instantiates once for all tests with a
/// room, like ljus/core.hpp for programs.

#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "support/rooms.hpp"

#ifndef LJUS_TEST_ROOMS_EXTERN
#define LJUS_TEST_ROOMS_EXTERN extern
#endif

LJUS_TEST_ROOMS_EXTERN template class ljus::World<ljus_test::BallRoom>;
LJUS_TEST_ROOMS_EXTERN template ljus_test::ClosedRoom
ljus_test::make_room<float>(Ball, Lamp, int);

namespace ljus {

LJUS_TEST_ROOMS_EXTERN template class PhotonMapper<ljus_test::ClosedRoom>;
LJUS_TEST_ROOMS_EXTERN template TracedPhotonsT<float>
trace_photons(const ljus_test::ClosedRoom&, MapType, const PhotonPassSettings&);
LJUS_TEST_ROOMS_EXTERN template Rgb radiance(const PathTracer<ljus_test::ClosedRoom>&,
                                             const Ray&, Context<RandomStream>&);
LJUS_TEST_ROOMS_EXTERN template Rgb radiance(const PhotonMapper<ljus_test::ClosedRoom>&,
                                             const Ray&, Context<RandomStream>&);
LJUS_TEST_ROOMS_EXTERN template Rgb
radiance(const PhotonMapper<ljus_test::ClosedRoom>&, const Ray&,
         Context<RandomStream, const NoLog, detail::CausticsBatch<float>>&);

} // namespace ljus
