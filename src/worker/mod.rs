//! The thread that owns a simulation: commands in, latest snapshot out.
