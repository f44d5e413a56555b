//! Resting contacts: which hold, what they carry, and how the spheres that they connect move on together.
//!
//! `resting` keeps them, with the islands that they form; `settling` is what events do to islands, and solves those that
//! have changed once no contact is left at an instant; `equilibrium` solves one island; `loads` is what contacts carry;
//! `releases` finds those that let go again and again; `covered` adds the walls
//! that share a contact's point, and keeps the edges that say no more than the face beside them.

pub(super) mod covered;
pub(super) mod equilibrium;
pub(super) mod loads;
mod releases;
pub(super) mod resting;
pub(super) mod settling;
