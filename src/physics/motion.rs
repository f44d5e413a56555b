//! Flight and impact: the one impact law.
