//! How deep now? Gaps, degrees, normals of spheres with walls and each other.
