// Points, directions and normals on their way between the world and the space of an instanced object.
// Here are the maps alone: traverse.glsl walks into instances, interaction.glsl comes back from a hit.

vec3 timesRows(vec3 row0, vec3 row1, vec3 row2, vec3 v)
{
    return vec3(dot3(row0, v), dot3(row1, v), dot3(row2, v));
}

/// The translation is taken off first: near the instance that loses nothing, however far it is from
/// the origin of the world.
vec3 pointToObject(READ(ObjectInstance) instance, vec3 p)
{
    vec3 v = p - instance.translation;
    return flushed3(timesRows(instance.toObject0, instance.toObject1, instance.toObject2, v));
}

/// Not scaled to length 1, so that distances along a ray are the same numbers in both spaces.
vec3 directionToObject(READ(ObjectInstance) instance, vec3 d)
{
    return flushed3(timesRows(instance.toObject0, instance.toObject1, instance.toObject2, d));
}

vec3 pointToWorld(READ(ObjectInstance) instance, vec3 q)
{
    return timesRows(instance.toWorld0, instance.toWorld1, instance.toWorld2, q) + instance.translation;
}

/// Normals go by the transpose of the inverse, whatever the length that comes out. A normal on the
/// viewer's side stays there, mirrored or not: n . (toObject d) and (transposed toObject n) . d are the
/// same sum.
vec3 normalToWorld(READ(ObjectInstance) instance, vec3 n)
{
    return (instance.toObject0 * n.x + instance.toObject1 * n.y) + instance.toObject2 * n.z;
}
