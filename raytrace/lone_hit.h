// SPDX-License-Identifier: MIT
// Hits at which nothing but the surface itself lies near, for certain. There what else would have to be searched for is
// known: no other surface is crossed together with this one (media.h), none stands in the way of rays that leave
// (place.h), and a refracted ray passes the surface that it starts at, and no other.
#pragma once

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

class Clearings;

// Within what distance of a hit, along each axis, nothing else may be for it to be lone: of a ray that met it `way` from
// its origin, `reach` being Prepared::reach_from.
double room_for(double reach, double way);

// Whether a hit is lone and, as locate() has it, whether its ray comes from the outward side; `clear`: it is lone, as
// is_clear() tells, and not on a solid, so that nobody asks for the side.
enum class Lone : std::uint8_t { unknown, entering, leaving, clear };

// Of any hit of any ray. `unknown` also where the ray grazes the surface. A solid that is lone there is crossed once.
// With `clearings`, which may know of nothing near, there is less to search for.
Lone lone_hit(const Prepared& prepared, const Ray& ray, const Hit& hit, Isa isa = best_isa(),
              Clearings* clearings = nullptr);

// Whether at a hit of any ray, a grazing one too, nothing else is known to lie near, by `clearings` alone.
bool is_clear(const Prepared& prepared, const Ray& ray, const Hit& hit, Clearings& clearings,
              Isa isa = best_isa());

// Whether for certain there is nothing else in a ball, nor within a quarter of its radius around it: a ray inside meets
// its far side next, and any hit on it is as good as lone. To be prepared (Prepared::secluded), as it asks anew.
bool is_secluded(const Prepared& prepared, std::uint32_t sphere);

// Whether a ray in this unit direction is steep enough at the surface, Nv being `facing`, for what was found of a lone
// hit to hold for it: it starts at point + clearance * Nv.
bool is_steep(const glm::dvec3& direction, const glm::dvec3& facing);

}  // namespace sidelight::raytrace
