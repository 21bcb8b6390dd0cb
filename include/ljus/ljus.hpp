#pragma once

/// \file ljus/ljus.hpp
/// \brief Everything, but the headers that need a package of their own (load_json.hpp).

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "ljus/geometry/transform.hpp"
#include "ljus/image/color.hpp"
#include "ljus/image/hdr.hpp"
#include "ljus/image/image.hpp"
#include "ljus/image/metrics.hpp"
#include "ljus/image/pfm.hpp"
#include "ljus/image/png.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/math/sum.hpp"
#include "ljus/optics/schlick.hpp"
#include "ljus/parallel.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
