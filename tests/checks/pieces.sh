#!/usr/bin/env bash
# The table of chapters/one_piece.md: each call compiles as it stands there, with a vector
# type of one's own, and gives the type that the table says; each header brings as many
# headers of ours as it says.
. "$(dirname "$0")/common.sh"
page=$LJUS_ROOT/chapters/one_piece.md
status=0
rows=$scratch/rows
# The rows as HEADER TAB CALL TAB TYPE TAB COUNT, without their backticks.
sed -n 's/^| [^|]*<br>`\(ljus[^`]*\)` | `\(.*\)`<br>`\([^|]*\)` | \([0-9]*\) |$/\1\t\2\t\3\t\4/p' \
    "$page" >"$rows"
[ "$(wc -l <"$rows")" -ge 20 ] || { echo "the table has fewer than 20 rows"; status=1; }
[ "$(wc -l <"$rows")" -eq "$(($(grep -c '^|' "$page") - 2))" ] ||
    { echo "a row is not of the form | text<br>\`header\` | \`call\`<br>\`type\` | number |"; status=1; }

while IFS=$'\t' read -r header _ _ count; do
    found=$(reached "$include" "$header" | wc -w)
    [ "$found" -eq "$count" ] || { echo "$header brings $found headers, not $count"; status=1; }
done <"$rows"

{
    cut -f 1 "$rows" | sort -u | sed 's/.*/#include "&"/'
    cat <<'END'
#include <concepts>
#include "own_vector.hpp"
using reader::Vector;
void all(ljus::Ray ray, ljus::Sphere sphere, ljus::Triangle triangle, ljus::SurfacePoint point,
         ljus::SurfacePoint light, Vector d, Vector n, Vector x, Vector wo, Vector wi,
         ljus::Vec2 u, float t, float n1, float n2, float cosine, float radius, float x2,
         ljus::FrameT<float> frame, ljus::OrenNayar clay, ljus::RandomStream stream,
         ljus::Pattern pattern, std::uint64_t seed, std::uint64_t path, std::uint64_t key,
         int i, int n_rays, int width, int height, std::vector<ljus::Box> boxes,
         std::vector<ljus::Vec3> positions, ljus::Bvh bvh, ljus::KdTree8 tree, ljus::PhotonMap map,
         ljus::DensityEstimateSettings gather, std::vector<ljus::Neighbor> found,
         ljus::Image image) {
    const auto visit = [](std::uint32_t, double) {};
    const auto ask = [=](std::uint32_t, const ljus::Ray& rest) { return intersect(rest, triangle); };
END
    while IFS=$'\t' read -r _ call type _; do
        printf '    static_assert(std::same_as<decltype(%s), %s>);\n' "$call" "$type"
        printf '    (void)[&] { (void)(%s); };\n' "$call"
    done <"$rows"
    echo '}'
} >"$scratch/calls.cpp"
# shellcheck disable=SC2086
"$LJUS_CXX" -std=c++20 -fsyntax-only $LJUS_PACKAGE_FLAGS -I "$include" \
    -I "$LJUS_ROOT/examples" "$scratch/calls.cpp" || status=1
[ $status -ne 0 ] || echo "$(wc -l <"$rows") calls compile as they stand in the table"
exit $status
