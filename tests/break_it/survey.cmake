# A roughness in degrees goes unnoticed.
ljus_break_it(NAME survey-degrees HEADER inspect/scene_remarks.hpp TEST survey
    FROM "material.sigma > decltype(material.sigma)(1.6)"
    TO   "material.sigma > decltype(material.sigma)(100)"
    CASES "survey: a sigma*")

# The digits of the largest thing, and not of the one that has fewest.
ljus_break_it(NAME survey-digits HEADER inspect/scene_remarks.hpp TEST survey
    FROM "if (!(ratio > most)) return;"
    TO   "if (ratio > most) return;"
    CASES "survey: where float stops*")

# Every gloss is called a mirror.
ljus_break_it(NAME survey-narrow HEADER inspect/scene_remarks.hpp TEST survey
    FROM "next->pdf > T(1000)"
    TO   "next->pdf > T(0)"
    CASES "survey: a lobe that*")

# Ten times as narrow before anybody is warned.
ljus_break_it(NAME survey-narrower HEADER inspect/scene_remarks.hpp TEST survey
    FROM "> T(1000)"
    TO   "> T(10000)"
    CASES "survey: a lobe*")

# The settings of what is skipped are taken as they come.
ljus_break_it(NAME survey-skip-unchecked HEADER render/photon_mapping_settings.hpp
    TEST final_gathering
    FROM "    check(settings.skip);"
    TO   ""
    CASES "final gathering: settings that give*")

# How far a scene reaches, along one axis alone.
ljus_break_it(NAME survey-reach HEADER inspect/scene_remarks.hpp TEST survey
    FROM "std::max(reach, max_component(far))"
    TO   "std::max(reach, far.x)"
    CASES "survey: lengths whose squares*")

# Gloss is a mirror to those who send indirect rays, too.
ljus_break_it(NAME survey-gloss HEADER render/passes.hpp TEST survey
    FROM "caustic && general && looked_up && found.narrow > 0"
    TO   "caustic && general && found.narrow > 0"
    CASES "survey: narrow gloss*")

# Lamps are taken for lights that no path meets, and suns for lamps.
ljus_break_it(NAME survey-never-met HEADER inspect/scene_remarks.hpp TEST survey
    FROM "never_met += world.can_be_met(i) ? 0 : 1;"
    TO   "never_met += world.can_be_met(i) ? 1 : 0;"
    CASES "survey: the light that no path carries*")

# A wrapper may hide what its base can do.
ljus_break_it(NAME survey-hidden-hook HEADER materials/material.hpp TEST survey
    FROM "all &= own[i].provided ||"
    TO   "all &= true || own[i].provided ||"
    CASES "survey: a wrapper that hides*" COMPILED)
