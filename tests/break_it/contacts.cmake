# A ray that leaves glass on a floor meets the air between.
ljus_break_it(NAME contacts-first HEADER scene/world.hpp TEST contacts
    FROM "hit = place_of(world, ray, *hit).met;"
    TO   "(void)0;"
    CASES "contacts: glass that rests on a floor*")

# Glass against water has the boundary of water against air.
ljus_break_it(NAME contacts-index HEADER path/next_vertex.hpp TEST contacts
    FROM "relative_to(here, vertex.outside)"
    TO   "relative_to(here, T(1))"
    CASES "contacts: slabs of glass and water in contact*")

# Of two bodies in contact the path meets the one that it leaves.
ljus_break_it(NAME contacts-into HEADER scene/world.hpp TEST contacts
    FROM "place.met = into;"
    TO   ";"
    CASES "contacts: slabs of glass and water in contact*")

# Glass covers a lamp, and a ceiling hides it.
ljus_break_it(NAME contacts-lamp HEADER scene/contacts.hpp TEST contacts
    FROM "!is_black(object.emission)"
    TO   "false"
    CASES "contacts: a lamp in the plane*")

# The one that was added first is met.
ljus_break_it(NAME contacts-order HEADER scene/world.hpp TEST contacts
    FROM "object.key < met->key"
    TO   "object.key[15] < met->key[15]"
    CASES "contacts: no order of a list*")

# A rug is hidden by the floor on which it lies.
ljus_break_it(NAME contacts-area HEADER scene/contacts.hpp TEST contacts
    FROM "key[8] = covered"
    TO   "key[8] = -covered"
    CASES "contacts: which of two*")

# Tiles that share an edge are in contact.
ljus_break_it(NAME contacts-edge HEADER geometry/touching.hpp TEST contacts
    FROM ">= -distance) return true;"
    TO   "> distance) return true;"
    CASES "contacts: what only shares an edge*")

# Planes at a right angle are in contact.
ljus_break_it(NAME contacts-plane HEADER geometry/touching.hpp TEST contacts
    FROM "!(std::abs(low) <= distance && std::abs(high) <= distance) ||"
    TO   ""
    CASES "contacts: what only shares an edge*")

# The search takes the look of a node's first part for that of all.
ljus_break_it(NAME contacts-looks HEADER scene/contacts.hpp TEST contacts
    FROM "below_[i] = several;"
    TO   ";"
    CASES "contacts: a search among thousands*")

# The search among objects goes through all of them.
ljus_break_it(NAME contacts-tree HEADER scene/contacts.hpp TEST contacts
    FROM "below_[at] == looks_[i] || !overlap(box, boxes_[i])"
    TO   "false"
    CASES "contacts: the neighbours*")

# A path that begins in a stack of bodies skips where one ends on the next.
ljus_break_it(NAME contacts-medium HEADER path/next_vertex.hpp TEST contacts
    FROM "if (place.left == no_body && place.entered == no_body)"
    TO   ""
    CASES "contacts: a path that begins in a stack*")

# The survey is silent about contacts.
ljus_break_it(NAME contacts-remark HEADER inspect/scene_remarks.hpp TEST contacts
    FROM "    detail::add_contact_remarks(world.contacts(), type_of, remarks);"
    TO   ""
    CASES "contacts: the survey says*")

# A disc in the plane of a floor is met or not, by the order of the list.
ljus_break_it(NAME contacts-disc HEADER scene/contacts.hpp TEST contacts
    FROM "is_disc<G> || is_tube<G> ||"
    TO   "is_tube<G> ||"
    CASES "contacts: a disc*")

# A rug that is pulled over the floor is met or not, by the order of the list.
ljus_break_it(NAME contacts-slides HEADER scene/contacts.hpp TEST contacts
    FROM "return piece_count(shape.shape);"
    TO   "return 0;"
    CASES "contacts: what slides*")

# The places that what slides comes to are left out.
ljus_break_it(NAME contacts-way HEADER geometry/touching.hpp TEST contacts
    FROM "if (way != glm::dvec3(0)) other.facet = around_way(other.facet, way);"
    TO   ""
    CASES "contacts: cylinders and moving balls*")

# Water in a tube of glass is met or not, by the order of the list.
ljus_break_it(NAME contacts-tube HEADER scene/contacts.hpp TEST contacts
    FROM "is_tube<G> || is_ball<G>"
    TO   "is_ball<G>"
    CASES "contacts: water in a tube*")

# Two rods end to end share more than an edge.
ljus_break_it(NAME contacts-end-to-end HEADER geometry/touching.hpp TEST contacts
    FROM "!(last - first > (tubes ? distance : -distance))"
    TO   "false"
    CASES "contacts: cylinders and moving balls*")

# What moves together is compared where it was first.
ljus_break_it(NAME contacts-together HEADER geometry/touching.hpp TEST contacts
    FROM "time * piece.displacement"
    TO   "0.0 * time * piece.displacement"
    CASES "contacts: balls that move together*")
