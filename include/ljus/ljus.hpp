#pragma once

/// \file ljus/ljus.hpp
/// \brief The headers for a first program: common shapes, lights and materials, scenes,
/// cameras, the renderers and PNG files. Other features have their own headers.

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/isosurface.hpp"
#include "ljus/geometry/metaballs.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/triangle.hpp"

#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"

#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/rough_diffuse.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/materials/textured.hpp"

#include "ljus/scene/camera.hpp"
#include "ljus/scene/lens_camera.hpp"
#include "ljus/scene/make_scene.hpp"

#include "ljus/render/distributed.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"

#include "ljus/inspect/survey.hpp"
#include "ljus/io/png.hpp"

#ifdef LJUS_CORE // the program is linked with ljus::core
#include "ljus/core.hpp"
#endif
