#!/usr/bin/env bash
# Checks that types that are not a shape, a material or a light, or are not listed, give a
# short message at the caller's line.
. "$(dirname "$0")/common.sh"
status=0
longest=24

# short_error CODE [PATTERN]: CODE is refused in few lines, one of which names the
# caller's line and one of which matches PATTERN.
short_error() {
    local code=$1 pattern=$2 output lines
    printf '%s\n' '#include "ljus/lights/point_light.hpp"' \
        '#include "ljus/materials/lambertian.hpp"' \
        '#include "ljus/materials/mirror.hpp"' '#include "ljus/scene/make_scene.hpp"' \
        'using namespace ljus;' 'struct Torus { float radius; };' \
        "int main() { $code }" >"$scratch/caller.cpp"
    # shellcheck disable=SC2086
    if output=$("$LJUS_CXX" -std=c++20 $LJUS_PACKAGE_FLAGS -I "$include" \
        -fsyntax-only "$scratch/caller.cpp" 2>&1); then
        echo "this compiles, and must not: $code"
        status=1
        return
    fi
    lines=$(printf '%s\n' "$output" | wc -l)
    if [ "$lines" -gt $longest ] || ! grep -qE "$pattern" <<<"$output" ||
        ! grep -q 'caller.cpp:7' <<<"$output"; then
        echo "$lines lines, at most $longest are short; '$pattern' must be there: $code"
        printf '%s\n' "$output"
        status=1
    else
        printf '%3d lines: %s\n' "$lines" "$code"
    fi
}

short_error 'Scene<Shapes<Sphere, Torus>, Materials<Lambertian>> s;' 'Shape'
short_error 'Scene<Shapes<Sphere>, Materials<Torus>> s;' 'Material'
short_error 'Scene<Shapes<Sphere>, Materials<Lambertian>> s; s.add(Mirror{});' \
    'Neither a light nor listed'
short_error 'Scene<Shapes<Sphere>, Materials<Lambertian>> s; s.add(Torus{});' \
    'Neither a light nor listed'
short_error 'Scene<Shapes<Sphere>, Materials<Lambertian>> s; s.add(PointLightT<double>{});' \
    'List the light'
short_error 'Scene<Shapes<Sphere>, Materials<Lambertian>> s; s.add(Quad{}, MaterialId{});' \
    'List the shape'
short_error 'Scene<Shapes<Sphere, Sphere>, Materials<Lambertian>> s;' \
    'A scene lists each type once'
short_error 'Scene<Shapes<Sphere>, Materials<>> s;' 'at least one type of material'
short_error 'Scene<Shapes<SphereT<double>>, Materials<Lambertian>> s;' \
    'must have the precision of its shapes'
short_error 'auto s = make_scene(Sphere{});' 'ScenePart'
short_error 'auto s = make_scene(PointLight{});' 'PlacedPart'
short_error 'auto s = make_scene(placed(Sphere{}, Torus{}));' 'Material|constraints not satisfied'
short_error 'auto s = make_scene(placed(Torus{}, Lambertian{}));' 'Shape|constraints not satisfied'
exit $status
