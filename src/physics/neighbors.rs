//! Which spheres can touch at all: cells, as soon as the scene has many.
