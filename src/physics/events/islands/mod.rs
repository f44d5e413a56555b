pub(super) mod equilibrium;
pub(super) mod loads;
pub(super) mod resting;
pub(super) mod settling;
